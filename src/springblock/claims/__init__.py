"""The claims of the paper that the study can test, each with the statistic that tests it.

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525. Where the paper compares in
words ("similar", "uniform", "the same"), the claimed range says how close is close enough.
"""

from springblock.claims import (
    correlation,
    flat,
    grooves,
    lengths,
    loading,
    model,
    pillars,
    sizes,
    stress,
)

_CHAPTERS = (model, loading, stress, flat, pillars, sizes, correlation, grooves, lengths)

#: By the section of the paper that makes them.
CLAIMS = tuple(
    sorted((claim for chapter in _CHAPTERS for claim in chapter.CLAIMS), key=lambda c: c.section)
)
