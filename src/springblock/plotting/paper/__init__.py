"""Figures numbered as printed in Costagliola, Bosia & Pugno 2022.

Int. J. Solids Struct. 243, 111525, doi:10.1016/j.ijsolstr.2022.111525.
"""
