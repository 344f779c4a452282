"""Questions beyond the paper, one module each, and the page of their answers.

The page states each question and its method. The function `answers` of a module yields the answer
and the tables behind it, from realisations by scene. The surfaces are those of Costagliola, Bosia
& Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""
