"""The report on a study of one's own scenes: means, changes, figures, films and a table."""

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import pyarrow as pa

from springblock.analysis.ensembles import Ensemble, constants, ensembles, extremes, mean, telling
from springblock.beyond.question import number
from springblock.io.parquet import load
from springblock.io.schemas import SCENE, SETUP
from springblock.model.material import Material
from springblock.plotting.style import MICRO
from springblock.report import markup, media
from springblock.report.page import origin, rendered

_UNITS = {
    field.name: unit
    for field in (*SCENE, *SETUP)
    if (unit := field.metadata[b"unit"].decode()) != "1" and not pa.types.is_string(field.type)
}
#: Columns of the table of means: observable, heading, and factor from SI units.
_MEANS = (
    ("static_friction", "static friction", 1.0),
    ("t_max", "t_max (µs)", MICRO),
    ("t_avg", "t_avg (µs)", MICRO),
)


def page(table: Path, pictures: Iterable[Path], films: Mapping[Path, Path]) -> str:
    """Write the page from the table of realisations, pictures, and films with their runs."""
    realisations = load(table)
    members = ensembles(realisations.to_pylist())
    head, means = _means(members)
    return rendered(
        "own.html",
        runs=realisations.num_rows,
        head=head,
        means=means,
        changes=list(_changes(members)),
        common=_common(members),
        figures=[media.picture(file) for file in pictures],
        films=[media.moving(file, batch) for file, batch in films.items()],
        tables=[markup.shown(table.stem, realisations)],
        files={table.stem: media.embedded(table)},
        origin=origin({"realisations": realisations}),
    )


def _means(members: list[Ensemble]) -> tuple[list[str], list[list[str]]]:
    """Return the headings, and per ensemble its own parameters, number of runs and means."""
    apart = telling(each.names for each in members)
    head = [*map(_with_unit, apart), "realisations", *(name for _, name, _ in _MEANS)]
    rows = [
        [
            *(str(each.names.get(name, "")) for name in apart),
            str(len(each.rows)),
            *(number(mean(each, key), factor=factor) for key, _, factor in _MEANS),
        ]
        for each in members
    ]
    return head, rows


def _changes(members: list[Ensemble]) -> Iterator[list[str]]:
    """Yield the changes of static friction from the lowest to the highest value of each parameter.

    Each row has the parameter and both values, the other parameters of the ensembles, and the mean
    difference with its interval.
    """
    apart = telling(each.names for each in members)
    for name, low, high, change in extremes(members):
        others = {key: change.names[key] for key in apart if key in change.names}
        where = ", ".join(f"{key} = {value}" for key, value in others.items())
        difference = number(change.of("static_friction"))
        yield [_with_unit(name), f"{low} to {high}", where or "–", difference]


def _with_unit(name: str) -> str:
    return f"{name} ({_UNITS[name]})" if name in _UNITS else name


def _common(members: list[Ensemble]) -> list[str]:
    """Name the parameters that all ensembles share and that are not the paper's."""
    paper = dict(Material().items())
    shared = {name: value for name, value in constants(members).items() if value}
    return [
        f"{name} = {value} {_UNITS.get(name, '')}".strip()
        for name, value in shared.items()
        if value != paper.get(name)
    ]
