"""What goes beyond the paper: a module per question, and the page that says what was learnt.

The page has each question and how it is measured; a module's `answers` finds the answer, its other
functions what it rests on, from realisations by scene. The surfaces are those of Costagliola, Bosia
& Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""
