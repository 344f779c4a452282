"""The statements of the paper that the study can test, each with its statistics.

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525. Where the paper compares in
words ("similar", "uniform", "the same"), the claimed range gives the tolerance.
"""

from operator import attrgetter

from springblock.claims import flat, grooves, load_peaks, pillars, sides, stress
from springblock.claims.rule import Claim

_CHAPTERS = stress, flat, pillars, sides, grooves, load_peaks
_MADE = [made for chapter in _CHAPTERS for made in vars(chapter).values()]

#: In the order of the paper's sections and, within a section, of the chapters.
CLAIMS = sorted((made for made in _MADE if isinstance(made, Claim)), key=attrgetter("section"))
