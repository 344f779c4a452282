"""What the configuration of a study asks for: scenes, files, jobs and figures."""

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from itertools import chain, pairwise
from pathlib import Path
from typing import Any

from springblock.accuracy.conventions import SCENES
from springblock.continuum import PARTS as CELLS
from springblock.io.identity import name_of
from springblock.mechanism.surfaces import TABLES
from springblock.model.blockmap import Cut
from springblock.model.scene import Scene
from springblock.plotting import figures
from springblock.plotting.declaration import Declaration, file_name, having
from springblock.plotting.lines import axes
from springblock.provenance import digest, digest_of_data
from springblock.solver.integrators import INTEGRATORS
from springblock.study import configuration as read
from springblock.study import cost
from springblock.study.stale import remove_others

#: Figures that show the surfaces which are filmed, by group.
_FILMED = {"flat": "figure_3", "pillars": "figure_5", "grooves": "figure_8"}
#: Groups whose realisations test the statements.
_CLAIMED = ["flat", "pillars", "small_pillars", "grooves", "angles", "third_level", "loading"]
_CLAIMED += ["scatter", "repetitions", "one_level", "square", "ungrooved"]


class Plan:
    """Scenes, files and figures of a checked configuration."""

    def __init__(self, configuration: Mapping[str, Any]) -> None:
        self.configuration = configuration
        self.results = str(Path(configuration["results"]))  # without a slash at the end
        self.own = read.is_own(configuration)
        self.groups = read.ensembles(configuration)
        self.seeds = dict(chain.from_iterable(each.items() for each in self.groups.values()))
        self.scenes = {name_of(scene, digest("simulate")): scene for scene in self.seeds}
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
    def claimed(self) -> list[Scene]:
        """Return the scenes that test the paper's statements."""
        return self.members(_CLAIMED)

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
        return sorted(INTEGRATORS if self.configuration["accuracy"] else used)

    @property
    def periodic(self) -> bool:
        """Whether surfaces have periodic edges, as the unit cells of the continuum have."""
        return "continuum" in self.held or any(scene.is_periodic for scene in self.seeds)

    def memory(self, job: Any) -> int:
        """Return MB to request for the wildcards of a job."""
        return cost.memory(self.scenes[job.scene], _runs(job))

    def minutes(self, job: Any) -> int:
        """Return minutes to request for the wildcards of a job."""
        return cost.minutes(self.scenes[job.scene], _runs(job))

    @property
    def measured(self) -> dict[str, list[str]]:
        """Return the parts of each table that needs no realisations of the study."""
        kinds = ("reference", "paired") if self.configuration["verification"] else ("reference",)
        return {
            "work_precision": [f"{kind}-{scene}" for kind in kinds for scene in SCENES],
            "production": [f"production-{scene}" for scene in SCENES],
            "stability": ["stability"],
            **{table: [f"mechanism-{part}" for part in TABLES[table]] for table in TABLES},
            "continuum": [f"continuum-{part}" for part in CELLS],
        }

    def step(self, name: str) -> str:
        """Return the step whose code makes such a table or part of one."""
        chapter = name.replace("_", "-").partition("-")[0]
        return chapter if chapter in ("mechanism", "continuum") else "accuracy"

    @property
    def held(self) -> list[str]:
        """Return those of these tables that belong to the study."""
        errors = ["work_precision", "production", "stability"]
        models = {"sizes": ["mechanism"], "all": [*TABLES, "continuum"]}
        asked = self.configuration
        return [*(errors if asked["accuracy"] else []), *models.get(asked["mechanism"], [])]

    @property
    def pages(self) -> dict[str, list[str]]:
        """Return the tables from which each page of the study is written."""
        every = {
            "claims": ["claims"],
            "accuracy": ["work_precision", "stability", "realisations", "production"],
            "continuum": ["continuum"],
            "mechanism": [*TABLES, "sensitivities"],
        }
        known = {*self.held, "realisations"} | (set() if self.own else {"claims"})
        known |= {"sensitivities"} if self.groups.get("sensitivities") else set()
        return {page: tables for page, tables in every.items() if {*tables} <= known}

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
    def figures(self) -> dict[str, Declaration]:
        """Return the figures whose groups of scenes and tables the study has, by name."""
        chapters = {
            "Figures": not self.own,
            "Accuracy": self.configuration["accuracy"],
            "Mechanism": self.configuration["mechanism"],
            "Continuum": self.configuration["mechanism"] == "all",
        }
        return {
            name: figure
            for name, figure in figures.FIGURES.items()
            if figure.is_part_of(self.drawn) and chapters.get(figure.category, True)
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
        lengths: Mapping[str, Any] = self.configuration["figures"].get(figure, {})
        return lengths

    def needed(self, figure: str) -> Iterator[str]:
        """Yield the files of a figure; refuse lengths that no scene has."""
        if figure in self.sweeps:
            yield from self.batches(self.members(self.sweeps[figure]["groups"]))
            return
        lengths, declared = self._lengths(figure), self.figures[figure]
        shown = lengths.items() if declared.groups else ()
        scenes = chain.from_iterable(self.drawn[group] for group in declared.groups)
        if shown and not any(shown <= scene.lengths.items() for scene in scenes):
            wanted = ", ".join(f"{name} = {length}" for name, length in shown)
            raise ValueError(
                f"figures.{figure}: no scene of {' or '.join(declared.groups)} has {wanted}"
            )
        for table, scene, number in declared.needs(self.drawn, lengths):
            if scene is None:
                yield f"{self.results}/tables/{table}.parquet"
            else:
                yield from self.batches([scene])[:number]

    def remove_others(self, dryrun: bool) -> None:
        """Remove tables of another configuration, which are then made again."""
        tables = ("realisations", "correlation", "correlation_length", "claims", "sensitivities")
        files = [f"{self.results}/tables/{name}.parquet" for name in tables]
        remove_others(files, self.digest, dryrun)

    def command(self, figure: str) -> str:
        """Return the command that draws a figure, without its files."""
        if figure in self.sweeps:
            of = [f"--of {observable}" for observable in self.sweeps[figure].get("of", [])]
            return " ".join(["plot", "--over", self.sweeps[figure]["over"], *of])
        lengths, declared = self._lengths(figure), self.figures[figure]
        return f"figure {figure} {declared.options(self.configuration['n_blocks'], lengths)}"


def _runs(job: Any) -> int:
    """Return the number of runs of a job; a prelude counts as one."""
    return int(job.last) - int(job.first) + 1 if hasattr(job, "last") else 1
