"""What goes beyond the paper: a module per question, and the page that says what was learnt.

A module's `QUESTION` says what is asked and how it is measured; its functions take realisations
by scene and find the answer. The surfaces are those of Costagliola, Bosia & Pugno 2022,
doi:10.1016/j.ijsolstr.2022.111525.
"""

from springblock.beyond import clusters, friction, lattice, peaks, scatter, sliding, variance

_MODULES = (lattice, peaks, friction, sliding, clusters, scatter, variance)
QUESTIONS = tuple(module.QUESTION for module in _MODULES)
