"""What the configuration of a study asks for: scenes, files, jobs and figures."""

import fnmatch
import sys
from collections.abc import Iterable, Mapping
from functools import cached_property
from itertools import chain, pairwise
from pathlib import Path
from typing import Any

from springblock.io.identity import name_of
from springblock.io.parquet import load, origin_of
from springblock.model.blockmap import Cut
from springblock.model.scene import Scene
from springblock.plotting.lines import axes
from springblock.provenance import ANALYSE, COMPILE, MASK, SIMULATE, digest, digest_of_data, planned
from springblock.solver.integrators import INTEGRATORS
from springblock.study import configuration as read
from springblock.study import cost
from springblock.study.results import (
    FIGURES,
    PAGES,
    PARTS,
    TABLES,
    Figure,
    Page,
    Table,
    file_name,
    having,
)

#: Figures that show the surfaces which are filmed, by group.
_FILMED = {"flat": "figure_3", "pillars": "figure_5", "grooves": "figure_8"}


class Plan:
    """Scenes, files and figures of a checked configuration."""

    def __init__(self, configuration: Mapping[str, Any]) -> None:
        self.configuration = configuration
        self.results = str(Path(configuration["results"]))  # without a slash at the end
        self.own = read.is_own(configuration)
        self.groups = read.ensembles(configuration)
        self.seeds = dict(chain.from_iterable(each.items() for each in self.groups.values()))
        self.scenes = {name_of(scene, digest(SIMULATE)): scene for scene in self.seeds}
        self.names = {scene: name for name, scene in self.scenes.items()}

    def members(self, groups: Iterable[str]) -> list[Scene]:
        """Return the scenes of those groups that the study has, each once."""
        return list(dict.fromkeys(chain.from_iterable(self.groups.get(g, ()) for g in groups)))

    def batches(self, scenes: Iterable[Scene]) -> list[str]:
        """Return the files of the realisations of scenes.

        A batch ends before a multiple of `realisations_per_job`, so that all but the last of a
        growing study remain as they are.
        """
        size, start = self.configuration["realisations_per_job"], self.configuration["first_seed"]
        files = []
        for scene in scenes:
            end, folder = start + self.seeds[scene], f"{self.results}/realisations"
            firsts = start, *range(start - start % size + size, end, size), end
            names = (f"{first}-{after - 1}.parquet" for first, after in pairwise(firsts))
            files += [f"{folder}/{self.names[scene]}/{name}" for name in names]
        return files

    @cached_property
    def digest(self) -> str:
        """Return the digest of the study: of the names of the files of all its realisations."""
        return digest_of_data(self.batches(self.names))

    @property
    def with_sides(self) -> list[Scene]:
        """Return scenes with several seeds on pillars that have sides, for correlations."""
        found = self.members(group for group in self.groups if group != "sensitivities")
        return [each for each in found if each.sides and self.seeds[each] > 1 and not self.own]

    @property
    def with_fields(self) -> list[str]:
        """Return the names of scenes whose fields are stored."""
        return [name for name, scene in self.scenes.items() if scene.snapshot_times]

    @property
    def cuts(self) -> dict[str, Cut]:
        """Return the cuts of measured surfaces by the name of the mask."""
        masks = (scene.mask for scene in self.seeds)
        return {mask.name: mask.cut for mask in masks if mask and mask.cut}

    @property
    def laws(self) -> list[str]:
        """Return the laws of friction, by name or file."""
        return sorted({str(getattr(scene.law, "file", scene.law)) for scene in self.seeds})

    @property
    def integrators(self) -> list[str]:
        """Return the integrators of all scenes; errors are measured with each."""
        used = {scene.integrator for scene in self.seeds}
        is_each = any(table.chapter == "accuracy" for table in self.measured)
        return sorted(INTEGRATORS if is_each else used)

    @property
    def periodic(self) -> bool:
        """Whether surfaces have periodic edges, as the unit cells of some tables have."""
        cells = any(table.is_periodic for table in self.measured)
        return cells or any(scene.is_periodic for scene in self.seeds)

    def memory(self, job: Any) -> int:
        """Return MB to request for the wildcards of a job."""
        return cost.memory(self.scenes[job.scene], _runs(job))

    def minutes(self, job: Any) -> int:
        """Return minutes to request for the wildcards of a job."""
        return cost.minutes(self.scenes[job.scene], _runs(job))

    @cached_property
    def measured(self) -> dict[Table, list[str]]:
        """Return the parts of tables that the configuration names, by table."""
        chosen: dict[Table, list[str]] = {}
        for pattern in self.configuration["parts"]:
            if not (named := fnmatch.filter(PARTS, pattern)):
                raise ValueError(f"parts: no part is {pattern!r}; choose from {', '.join(PARTS)}")
            for part in named:
                chosen.setdefault(PARTS[part], []).append(part)
        return {table: list(dict.fromkeys(parts)) for table, parts in chosen.items()}

    @cached_property
    def tables(self) -> dict[str, str]:
        """Return the files of all tables by name."""
        correlations = ["correlation", "correlation_length"] if self.with_sides else []
        names = ["realisations", *correlations, *self.of_chapters]
        return {name: f"{self.results}/tables/{name}.parquet" for name in names}

    @property
    def of_chapters(self) -> dict[str, Table]:
        """Return the tables that the chapters compute, of parts or of groups of scenes, by name."""
        every = [*self.measured, *(() if self.own else TABLES.values())]
        return {t.name: t for t in every if t in self.measured or self.members(t.groups)}

    def sources(self, table: Table) -> list[str]:
        """Return the files from which a table is made: its parts, or batches and tables."""
        if table in self.measured:
            return [f"{self.results}/parts/{part}.parquet" for part in self.measured[table]]
        batches = self.batches(self.members(table.groups))
        return batches + [self.tables[name] for name in table.tables if name in self.tables]

    @property
    def pages(self) -> dict[str, list[str]]:
        """Return the files of tables from which each page of the study is written."""
        held = [page for page in PAGES.values() if self.has(page)]
        return {page.name: [self.tables[name] for name in page.tables] for page in held}

    def has(self, result: Page | Figure) -> bool:
        """Return whether the study has the tables, and their parts, that a result shows."""
        parts = {*chain.from_iterable(self.measured.values())}
        return {*result.tables} <= self.tables.keys() and {*result.parts} <= parts

    def sampled(self, part: str) -> str:
        """Return seeds and finest step of ensembles that measure errors, as options."""
        kind, _, scene = part.partition("-")
        given = self.configuration["production"]
        told = f"--seeds {given.get(scene)} --finest-step {given['finest_step']}"
        return told if kind == "production" else ""

    @cached_property
    def drawn(self) -> dict[str, list[Scene]]:
        """Return the scenes from which figures are drawn, by group."""
        return read.for_figures(self.configuration, self.groups)

    @cached_property
    def figures(self) -> dict[str, Figure]:
        """Return the figures whose groups of scenes and tables the study has, by name."""
        return {
            name: figure
            for name, figure in FIGURES.items()
            if all(self.drawn.get(group) for group in figure.groups)
            and self.has(figure)
            and not (self.own and figure.draws in ("nothing", "pattern"))
        }

    @cached_property
    def sweeps(self) -> dict[str, Mapping[str, Any]]:
        """Return sweeps whose groups the study has; an own study has one for each that varies."""
        over = axes(self.seeds) if self.own else []
        usual = {axis: {"groups": list(self.groups), "over": axis} for axis in over}
        return {
            f"sweep_{name}": sweep
            for name, sweep in self.configuration["figures"].get("sweeps", usual).items()
            if all(self.groups.get(group) for group in sweep["groups"])
        }

    @cached_property
    def films(self) -> dict[str, Scene]:
        """Return the scenes that are filmed: on surfaces that figures show, or one's own."""
        if self.own:  # each surface, in the first of its directions
            return {file_name(each): each for each in reversed(self.drawn["surfaces"])}
        return {
            group: scene
            for group, figure in _FILMED.items()
            for scene in having(self._lengths(figure), self.drawn.get(group, []))[:1]
        }

    def _lengths(self, figure: str) -> Mapping[str, Any]:
        return self.configuration["figures"].get(figure, {})

    def needed(self, figure: str) -> list[str]:
        """Return the files of a figure; refuse lengths that no scene has."""
        if figure in self.sweeps:
            return self.batches(self.members(self.sweeps[figure]["groups"]))
        lengths, declared = self._lengths(figure), self.figures[figure]
        scenes = chain.from_iterable(self.drawn[group] for group in declared.groups)
        if declared.groups and not having(lengths, scenes):
            wanted = ", ".join(f"{name} = {length}" for name, length in lengths.items())
            raise ValueError(
                f"figures.{figure}: no scene of {' or '.join(declared.groups)} has {wanted}"
            )
        drawn = declared.scenes(self.drawn, lengths)
        files = chain.from_iterable(self.batches([scene])[: declared.batches] for scene in drawn)
        tables = (*declared.tables, *(self.tables.keys() & declared.also))
        return [*files, *(self.tables[name] for name in tables)]

    def for_jobs(self) -> str:
        """Return the plan that jobs compare with their code, see `provenance.planned`."""
        library = (COMPILE, MASK, SIMULATE, ANALYSE)
        return planned(self.digest, [*library, *(t.code for t in TABLES.values() if t.made)])

    def remove_others(self, dryrun: bool) -> None:
        """Remove tables that keep the digest of another study than this, and say so.

        They are made again from realisations, whatever Snakemake remembers of them or is told to
        ignore: lost metadata, `--touch` and `--rerun-triggers` cannot hide them. A dry run removes
        nothing.
        """
        names = sorted(table.name for table in TABLES.values() if not table.parts)
        files = [Path(self.results, "tables", f"{name}.parquet") for name in names]
        others = [file for file in files if file.exists() and _study_of(file) != self.digest]
        for file in [] if dryrun else others:
            file.unlink()
        if others:
            print(f"{len(others)} tables are of another configuration: made again", file=sys.stderr)

    def code(self, figure: str) -> str:
        """Return the digest of the code, and words, of a figure or sweep."""
        return digest((*ANALYSE, "plotting")) if figure in self.sweeps else FIGURES[figure].digest

    def command(self, figure: str) -> str:
        """Return the command that draws a figure or sweep, without its files."""
        if figure in self.sweeps:
            of = [f"--of {observable}" for observable in self.sweeps[figure].get("of", [])]
            return " ".join(["plot", "--over", self.sweeps[figure]["over"], *of])
        lengths, declared = self._lengths(figure), self.figures[figure]
        return f"figure {figure} {declared.options(self.configuration['n_blocks'], lengths)}"


def _runs(job: Any) -> int:
    """Return the number of runs of a job; a prelude counts as one."""
    return int(job.last) - int(job.first) + 1 if hasattr(job, "last") else 1


def _study_of(table: Path) -> str:
    """Return the digest of the study that a table keeps; "" without one."""
    try:
        return origin_of(load(table, columns=[])).get("study", "")
    except ValueError:
        return "damaged"
