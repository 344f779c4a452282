"""Ensembles in tables of realisations: their means, and changes between two tables."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from springblock.analysis.statistics import Interval, difference_interval, mean_interval
from springblock.io.rows import Row, scene_of
from springblock.model.asperities import DRAWN
from springblock.model.direction import degrees
from springblock.model.material import LAWS
from springblock.model.scene import Scene, differing
from springblock.simulation.resolution import lattice

#: Observables of a realisation, in the order of the tables.
OBSERVABLES = (
    *("static_friction", "dynamic_friction", "t_max", "t_avg", "t_first"),
    *("prominence", "t_quiet", "t_width"),
)
#: Columns that determine, with the seed, the friction coefficients of a run.
_THRESHOLDS = {"n_blocks", "n_rows", "edges", "mu_static_field", "mu_dynamic_field", *DRAWN}

Names = Mapping[str, object]  #: `Scene.values` of an ensemble, or some of them


class Ensemble(NamedTuple):
    """Realisations of one scene with the same constants."""

    names: Names
    rows: list[Row]  #: in ascending order of seeds

    @property
    def seeds(self) -> list[int]:
        """Seeds of the realisations."""
        return [row["seed"] for row in self.rows]

    def values(self, observable: str) -> np.ndarray:
        """Value of each seed, (k,); NaN where it is undefined.

        Realisations of the same seed, whose coefficients may be the same, count as one, their mean.
        """
        by_seed: dict[int, list[float]] = {}
        for row in self.rows:
            by_seed.setdefault(row["seed"], []).append(row[observable])
        return np.array([_known(np.array(values)).mean() for values in by_seed.values()])


class Change(NamedTuple):
    """Change from one ensemble to another that shares these `names`."""

    names: Names
    first: Ensemble
    second: Ensemble
    paired: bool  #: whether differences are taken between runs of the same seed

    def of(self, observable: str) -> Interval:
        """Second minus first, with the 95 % interval of the mean difference."""
        one, other = self.first.values(observable), self.second.values(observable)
        if self.paired:
            return mean_interval(_known(other - one))
        return difference_interval(_known(other), _known(one))


def _known(values: np.ndarray) -> np.ndarray:
    known = values[np.isfinite(values)]
    return known if known.size else np.array([np.nan])


def ensembles(rows: Iterable[Row], by: Sequence[str] = ()) -> list[Ensemble]:
    """Group rows of the table `realisations` by scene and constants, or by the names `by` only.

    Repeated realisations count once. Different ones with the same names and seed, and an unknown
    name in `by`, are a ValueError.
    """
    once: dict[tuple[Scene, int], Row] = {}
    for row in rows:
        key = scene_of(row), row["seed"]
        _refuse_other(*key, once.setdefault(key, row), row)
    found: dict[tuple[object, ...], Ensemble] = {}
    for (scene, _), row in sorted(once.items(), key=lambda each: each[0][1]):
        every = scene.values
        for name in by:
            if name not in every:
                raise ValueError(f"by: unknown name {name!r}; choose from {', '.join(every)}")
        names = {name: value for name, value in every.items() if not by or name in by}
        found.setdefault(tuple(names.items()), Ensemble(names, [])).rows.append(row)
    members = list(found.values())
    apart = differing(each.names for each in members)
    return sorted(members, key=lambda each: [_order(name, each.names.get(name)) for name in apart])


def _refuse_other(scene: Scene, seed: int, first: Row, row: Row) -> None:
    """Refuse a run that differs from the first of its scene and seed."""
    for name in (*OBSERVABLES, "steps"):
        one, other = first[name], row[name]
        if one != other and not (one != one and other != other):  # NaN
            raise ValueError(
                f"two runs of {scene}, seed {seed}, differ: {name} is {one!r} and {other!r}; "
                "leave out one file. A law may not draw random numbers"
            )


def _order(name: str, value: object) -> tuple[float, str]:
    """Return a key that sorts numbers by size, directions by angle, and Coulomb's law first."""
    if name == "direction":
        return degrees(str(value)), ""
    if isinstance(value, int | float):
        return float(value), ""
    return (float([*LAWS].index(str(value))) if value in LAWS else np.inf), str(value)


def mean(ensemble: Ensemble, observable: str) -> Interval:
    """Mean over seeds with its 95 % interval; its limits are NaN for a single seed."""
    with np.errstate(invalid="ignore"):
        return mean_interval(_known(ensemble.values(observable)))


def doubts(members: Iterable[Ensemble]) -> list[str]:
    """Return warnings that friction of patterned surfaces depends on the lattice, each once."""
    scenes = (scene_of(row) for each in members for row in each.rows)
    told = (lattice(scene.material) for scene in scenes if scene.level)
    return [*dict.fromkeys(filter(None, told))]


def constants(members: Sequence[Ensemble]) -> dict[str, object]:
    """Return the names that have the same value in all ensembles, with that value."""
    apart = set(differing(each.names for each in members))
    return {name: value for name, value in members[0].names.items() if name not in apart}


def from_first(members: Sequence[Ensemble]) -> Iterator[tuple[str, object, object, Change]]:
    """Yield the changes from the first value of each name that differs to each of the others.

    Each with the name and both values, among the ensembles that have this name.
    """
    for name in differing(each.names for each in members):
        having = [each for each in members if name in each.names]
        values = {each.names[name] for each in having}
        first, *others = sorted(values, key=partial(_order, name))
        for other in others:
            pair = ([each for each in having if each.names[name] == end] for end in (first, other))
            for change in changes(*pair)[1]:
                yield name, first, other, change


def changes(
    first: Sequence[Ensemble], second: Sequence[Ensemble]
) -> tuple[dict[str, tuple[object, object]], list[Change]]:
    """Return the constants in which two tables differ, and the changes of their ensembles.

    A constant that no ensemble of one table has, as that of another law, is None there.
    """
    one, other = constants(first), constants(second)
    both = [{name for each in members for name in each.names} for members in (first, second)]
    own = [known.keys() - theirs for known, theirs in ((one, both[1]), (other, both[0]))]
    apart = [name for name in one if name in other and one[name] != other[name]]
    differ = {name: (one.get(name), other.get(name)) for name in (*apart, *own[0], *own[1])}
    same = both[0] & both[1] - differ.keys()

    def shared(ensemble: Ensemble) -> tuple[tuple[str, object], ...]:
        return tuple(pair for pair in ensemble.names.items() if pair[0] in same)

    matches: dict[object, list[Ensemble]] = {}
    for theirs in second:
        matches.setdefault(shared(theirs), []).append(theirs)
    found = []
    for ours in first:
        correlated = {"spacing"} if ours.names.get("correlation_length") else set()
        drawn = (_THRESHOLDS | correlated) & differ.keys()
        for theirs in matches.get(shared(ours), []):
            names = {**theirs.names, **ours.names}
            told = {name: value for name, value in names.items() if name not in differ}
            found.append(Change(told, ours, theirs, not drawn and ours.seeds == theirs.seeds))
    return differ, found
