"""Figures of the study: which function draws them, from which data.

Their words are in `captions.toml`. This module loads neither matplotlib nor pandas: a dry run of
the study starts quickly. Figures 1 to 9 are numbered as in Costagliola, Bosia & Pugno, Int. J.
Solids Struct. 243, 111525 (2022), doi:10.1016/j.ijsolstr.2022.111525.
"""

import tomllib
from pathlib import Path
from typing import Any

from springblock.plotting.declaration import Declaration

SINGLE = 20  #: largest number of runs of an ensemble that are drawn one by one
#: Keys of grooved pillars.
PATTERN = ("n_p2", "n_s2", "n_p3", "n_s3", "along_3", "direction")

_WORDS = tomllib.loads((Path(__file__).parent / "captions.toml").read_text(encoding="utf-8"))
SWEEP = " ".join(_WORDS.pop("sweep")["caption"].split())  #: caption of a sweep
_SHARED = _WORDS.pop("shared") | {"single": SINGLE}


def _figure(name: str, module: str, **data: Any) -> Declaration:
    words = {key: text.format(**_SHARED) for key, text in _WORDS[name].items()}
    return Declaration(name=name, module=module, **words, **data)


#: By name: `springblock figure NAME` draws one; the report sorts them by name.
FIGURES = {
    figure.name: figure
    for figure in (
        _figure("figure_1", "paper_surfaces", draws="nothing"),
        _figure("figure_2", "paper_results", groups=("flat",)),
        _figure("figure_3", "paper_results", groups=("flat",), batches=1),
        _figure("figure_4", "paper_surfaces", draws="pattern"),
        _figure("figure_5", "paper_results", groups=("pillars",)),
        _figure(
            "figure_6",
            "paper_results",
            groups=("flat", "pillars"),
            also=("small_pillars",),
            keys=("n_p",),
        ),
        _figure(
            "figure_7",
            "paper_results",
            draws="correlations",
            groups=("pillars",),
            tables=("correlation", "correlation_length"),
        ),
        _figure("figure_8", "paper_surfaces", draws="pattern"),
        _figure("figure_9", "paper_results", groups=("grooves",), keys=PATTERN),
        _figure("supplement_levels", "supplement", groups=("third_level",), keys=PATTERN),
        _figure("surfaces", "supplement", groups=("surfaces",), keys=("folder",)),
        _figure(
            "work_precision", "accuracy", draws="tables", tables=("work_precision", "production")
        ),
        _figure("stability", "accuracy", draws="tables", tables=("stability",)),
        _figure("mechanism_friction", "mechanism", draws="tables", tables=("mechanism",)),
        _figure("continuum_friction", "continuum", draws="tables", tables=("continuum",)),
        _figure(
            "mechanism_sensitivities",
            "mechanism",
            groups=("sensitivities",),
            draws="tables",
            tables=("sensitivities",),
        ),
    )
}
