"""The report on a study of one's own scenes: means, changes, figures, films and a table."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from springblock.analysis.ensembles import Ensemble, constants, ensembles
from springblock.io.parquet import load
from springblock.model.material import Material
from springblock.report import markup, media
from springblock.report.means import UNITS, changes_over_ends, in_words, means
from springblock.report.page import origin, rendered


def page(table: Path, pictures: Iterable[Path], films: Mapping[Path, Path]) -> str:
    """Write the page from the table of realisations, pictures, and films with their runs."""
    realisations = load(table)
    members = ensembles(realisations.to_pylist())
    changes = changes_over_ends(members, ["static_friction"])
    return rendered(
        "own.html",
        runs=realisations.num_rows,
        means=in_words(means(members, ["static_friction", "t_max", "t_avg"])),
        changes=in_words(changes) if changes else (),
        common=_common(members),
        figures=[media.picture(file) for file in pictures],
        films=[media.moving(file, batch) for file, batch in films.items()],
        tables=[markup.shown(table.stem, realisations)],
        files={table.stem: media.embedded(table)},
        origin=origin({"realisations": realisations}),
    )


def _common(members: list[Ensemble]) -> list[str]:
    """Name the parameters that all ensembles share and that are not the paper's."""
    paper = dict(Material().items())
    shared = {name: value for name, value in constants(members).items() if value}
    return [
        f"{name} = {value} {UNITS.get(name, '')}".strip()
        for name, value in shared.items()
        if value != paper.get(name)
    ]
