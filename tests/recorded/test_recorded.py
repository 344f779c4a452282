"""No number, command or plan that the study derives from given data changes unnoticed.

The data are those made up for other tests; no simulation is involved, so that the numbers do not
depend on the processor (but for stiff cases, which are simulated for their closed forms).
`PYTHONPATH=src:tests python tests/recorded/test_recorded.py` records all texts again, after an
intended change.
"""

import re
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import yaml
from click.testing import CliRunner
from matplotlib.axes import Axes
from matplotlib.patches import FancyArrowPatch
from matplotlib.text import Text
from matplotlib.ticker import FixedLocator
from scipy.io import netcdf_file

import precision
from springblock import Pattern, Setup, Surface
from springblock.__main__ import main
from springblock.cli.simulate import batch_table
from springblock.io.identity import identity
from springblock.io.parquet import write
from springblock.io.records import Record
from springblock.io.rows import Row
from springblock.io.schemas import SUMMARY
from springblock.model.scene import Scene
from springblock.simulation.fields import Fields
from springblock.study import configuration as study
from springblock.study.accuracy import production, work_precision
from springblock.study.accuracy.conventions import SAMPLE_INTERVAL, SCENES
from springblock.study.accuracy.page import values
from springblock.study.accuracy.solutions import Small
from springblock.study.accuracy.stability import all_cases
from springblock.study.claims import STATEMENTS
from springblock.study.claims.table import rows as judged
from springblock.study.mechanism import page as mechanism
from springblock.study.mechanism.surfaces import PARTS
from springblock.study.pages import rendered
from studies import ROOT, TINY, Study
from study.claims import paper
from study.mechanism import chapter
from study.test_every_figure import DRAWINGS, drawn

RECORDED = Path(__file__).parent
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
ORIGIN = {"code_version": "1.0", "configuration": "{}", "configuration_digest": "0"}


@cache
def evidence() -> tuple[list[Record], list[Row]]:
    """Realisations of all surfaces that the statements need, and the table `claims`."""
    records = paper.realisations()
    return records, judged(STATEMENTS, paper.evidence(records))


def findings() -> str:
    """All columns of the table `claims` but the titles of the statements."""
    return written(pd.DataFrame(evidence()[1]).drop(columns=["claim", "section", "form"]))


def written(table: pd.DataFrame) -> str:
    return table.to_csv(index=False, float_format="%.9g")


def pages() -> str:
    """Numbers in the rows of tables on pages; their words may change."""
    lines = [
        f"{name},{' '.join(NUMBER.findall(line))}"
        for name, page in PAGES.items()
        for line in page().splitlines()
        if line.startswith("|") and NUMBER.search(line)
    ]
    return "\n".join(lines) + "\n"


def uneven(rows: list[Row], *columns: str) -> list[Row]:
    """Rows whose numbers in these columns differ, each by up to a fifth."""
    factors = 1.0 + 0.2 * np.sin(np.arange(1.0, 1.0 + len(rows)))
    return [
        row | {name: row[name] * factor for name in columns}
        for row, factor in zip(rows, factors, strict=True)
    ]


def accuracy() -> str:
    """The page on errors."""
    single = uneven(precision.precision_rows(), "error", "ci_low", "ci_high")
    cases = [("size", "agrees"), ("size", "unstable"), ("step", "agrees"), ("damping", "refused")]
    stability = [{"family": name, "expected": word, "outcome": word} for name, word in cases]
    errors = {-3.0: Scene(12), 1.0: Scene(12), 2.0: Scene(12), 700.0: Scene(12, gamma=1e7)}
    realisations = [identity(scene) | {"energy_error": 1e-6 * e} for e, scene in errors.items()]
    columns = ("value", "scale", "deviation", "bias", "bias_error", "ci_low", "ci_high")
    whole = uneven(precision.production_rows(), *columns)
    return rendered("accuracy/page.md", **values(single, stability, realisations, whole))


def made_up(surface: Surface, step: float, sample_interval: float, order: float) -> Any:
    """A run whose times and force have an error of this order, and a part that falls slowly."""
    late = 1.0 + 0.2 * (step / 8e-8) ** order * np.sin(np.arange(surface.mu_static.size))
    t_det = 1e-4 * surface.mu_static * late.reshape(surface.mu_static.shape)
    time = np.arange(0.0, 2e-4, sample_interval)
    force = np.exp(-(((time - np.nanmean(t_det)) / 1e-5) ** 2)) * (1.0 + 1e5 * step)
    run = Record(
        scene=Scene(12),
        seed=0,
        time=time,
        force=force,
        t_det=t_det,
        contact=surface.contact,
        normal_force=1.2,
        detachments=time,
        switches=time,
    )
    object.__setattr__(run, "steps", round(2e-4 / (step or 1.0)))  # of a computed run
    return run


def errors_measured() -> str:
    """The tables of errors on three small surfaces, of made-up runs, without CPU times."""

    def simulated(surface: Surface, setup: Setup, **_: Any) -> Any:
        order = 1.0 if setup.integrator == "rk4" else 2.0
        return made_up(surface, setup.step, setup.sample_interval, order)

    def exact(scene: str) -> Any:
        surfaces = map(small.surface, range(small.seeds))
        return [made_up(each, 0.0, SAMPLE_INTERVAL, 1.0) for each in surfaces]

    def plain(surface: Surface, duration: float, step: float, sample_interval: float) -> Any:
        return made_up(surface, step, sample_interval, 0.1)

    pattern = Pattern.pillars(12, 9, 3)
    small = Small(pattern, 2e-4, 3)
    with pytest.MonkeyPatch.context() as changed:
        for module in (production, work_precision):
            changed.setattr(module, "simulate", simulated)
        changed.setattr(work_precision, "solutions", exact)
        changed.setattr(work_precision.plain_rk4, "solve", plain)
        for scene in SCENES:
            changed.setitem(production.PATTERNS, scene, pattern)
            changed.setitem(work_precision.ENSEMBLES, scene, (pattern, 5))
            changed.setitem(work_precision.SMALL, scene, small)
        full_size = pd.DataFrame(production.measure("production-pillared", 4, 5e-9))
        small = pd.DataFrame(
            chain.from_iterable(
                work_precision.measure(f"{kind}-pillared") for kind in ("reference", "paired")
            )
        )
    timed = {"cpu_seconds", "prelude_seconds"}
    return "\n".join(written(table.drop(columns=timed & {*table})) for table in (full_size, small))


def cases() -> str:
    """All stiff and extreme cases, and their closed forms."""
    names = ("family", "name", "parameter", "quantity", "expected")
    rows = [
        {name: getattr(each, name) for name in names} | {"closed_form": each.outcome().closed_form}
        for each in all_cases()
    ]
    return written(pd.DataFrame(rows))


def fields() -> str:
    """Variables, attributes and values of a file of fields."""
    rng, vectors = np.random.default_rng(0), (2, 2, 2, 3)
    moving = np.array([[[[False]]], [[[True]]]])
    made = Fields(
        time=np.array([1e-5, 2e-5]),
        spacing=1e-5,
        contact=np.array([[True, True, False], [True, False, True]]),
        displacement=rng.standard_normal(vectors),
        velocity=np.where(moving, rng.standard_normal(vectors), 0.0),
        stress=rng.standard_normal(vectors),
    )
    with tempfile.TemporaryDirectory() as name:
        data = made.to_xarray().assign_attrs(gamma=5e3)
        data.to_netcdf(file := Path(name) / "fields.nc", engine="scipy")
        with netcdf_file(file, mmap=False) as held:
            parts = {"file": held} | dict(held.variables)
            lines = [f"{each}: {dict(part._attributes)}" for each, part in parts.items()]
            lines += [
                f"{each}: {part.data.ravel().tolist()}" for each, part in held.variables.items()
            ]
    return "\n".join(lines) + "\n"


def reasons() -> str:
    """Values of the page on the mechanism."""
    found = mechanism.values(
        *(getattr(chapter, name)() for name in ("rows", "damped", "springs", "grooves", "settings"))
    )
    return "\n".join(f"| {name} | {value}" for name, value in found.items()) + "\n"


def plans() -> str:
    """Every ensemble of the quick and the full study, and every surface of the mechanism."""
    lines = []
    for name in ("quick", "full"):
        config = {}
        for file in dict.fromkeys(("config", name)):
            config = merged(config, yaml.safe_load((ROOT / f"config/{file}.yaml").read_text()))
        whole = study.completed(config)
        groups, first = study.ensembles(whole), whole["first_seed"]
        for group, members in groups.items():
            lines.append(f"# {name}, {group}, runs: {len(members)} scenes")
            for scene, seeds in members.items():
                last = first + seeds - 1
                lines.append(f"{scene.folder}: {scene}; seeds {first} to {last}")
        for group, some in study.for_figures(whole, groups).items():
            lines.append(f"# {name}, {group}, drawn: {len(some)} scenes")
    for part, scenes in PARTS.items():
        lines.append(f"# {part}: {len(scenes)} surfaces")
        lines += [f"{scene.folder}: {scene}" for scene in scenes]
    return "\n".join(lines) + "\n"


def merged(first: Any, second: Any) -> Any:
    """Merge configurations as Snakemake does with several files."""
    if not (isinstance(first, dict) and isinstance(second, dict)):
        return second
    return first | {key: merged(first.get(key), value) for key, value in second.items()}


def summary(run: Record) -> Row:
    """Columns of a realisation whose energy does not quite close."""
    scene = replace(run.scene, sample_interval=1e-6, snapshot_times=run.snapshot_times)
    computed = {name: getattr(run, name, 0.0) for name in SUMMARY.names} | identity(scene)
    own = {"seed": run.seed, "energy_error": 1e-6 * (run.seed - 2), "steps": 15_000 + run.seed}
    return {name: (computed | own)[name] for name in SUMMARY.names}


def batch(file: Path, runs: list[Record]) -> Path:
    """Write a file of realisations with their curves and maps."""
    rows = [
        summary(run)
        | {name: getattr(run, name) for name in ("force", "detachments", "switches")}
        | {name: getattr(run, name) for name in ("normal_force", "onset_end")}
        | {name: getattr(run, name).ravel() for name in ("t_det", "contact", "snapshots")}
        for run in runs
    ]
    write(batch_table(rows), file, ORIGIN)
    return file


def commands() -> str:
    """What commands print and write that read realisations."""
    values = (5e-5, 1e4, 0.02), (5e-3, 2e5, 0.3)
    names = "slider_velocity", "pressure", "mu_static_std"
    pairs = [pair for each in values for pair in zip(names, each, strict=True)]
    varied = [paper.surface(paper.N, **{name: value}) for name, value in pairs]
    scenes = [*paper.SCENES, *varied]
    few = {scene: [paper.record(scene, seed) for seed in range(5)] for scene in scenes}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        none = {"snapshot_times": np.empty(0)}
        flat = batch(folder / "flat.parquet", [replace(r, **none) for r in few[paper.FLAT]])
        small = batch(folder / "pillars-6.parquet", few[paper.PILLARS[1]])
        large = batch(folder / "pillars-24.parquet", few[paper.PILLARS[2]][:4])
        others = [batch(folder / f"{i}.parquet", few[scene]) for i, scene in enumerate(varied)]
        kept = {"snapshot_times": np.array([1e-5]), "snapshots": np.zeros((1, 2, paper.N, paper.N))}
        grooved = batch(folder / "grooves.parquet", [replace(r, **kept) for r in few[paper.ALONG]])
        said = [
            ("table", flat, small, large),
            ("table", flat, small, "--by", "n_p", "--of", "dynamic_friction", "--of", "t_first"),
            ("table", flat, *others, "--changes", "--output", folder / "changes.csv"),
            ("compare", flat, others[0]),
            ("compare", small, large, "--of", "t_avg", "--output", folder / "compared.csv"),
            ("compare", folder, flat),
            ("info", grooved),
            ("compare", small, small),
            ("aggregate", small, flat, *correlated(folder / "all.parquet")),
            ("correlation", small, *correlated(folder / "small")),
            ("correlation", grooved, *correlated(folder / "grooved")),
            ("plot", flat, *others, "--over", "slider_velocity", "--output", folder / "plot.png"),
            ("plot", small, "--seed", 9, "--output", folder / "plot.png"),
        ]
        lines = [each for words in said for each in printed([str(word) for word in words])]
        for file in sorted(folder.glob("*.csv")):
            lines += [f"# {file.name}", file.read_text()]
        for file in ("all.parquet", "small-c", "small-l", "grooved-c", "grooved-l"):
            lines += [f"# {file}", written(pd.read_parquet(folder / file).T.reset_index())]
        return "\n".join(lines).replace(str(folder), "FOLDER") + "\n"


def correlated(file: Path) -> list[Any]:
    if file.suffix:
        return [f"--output={file}"]
    return [f"--output-correlation={file}-c", f"--output-length={file}-l"]


def printed(words: list[str]) -> Iterator[str]:
    """Yield a command and what it prints."""
    yield f"$ springblock {' '.join(words)}"
    yield CliRunner().invoke(main, words).output


def jobs() -> str:
    """The commands of all jobs of a tiny study."""
    with tempfile.TemporaryDirectory() as name:
        everything = {"parts": ["*"]}
        watched = {"flat": TINY["scenes"]["flat"] | {"snapshot_times": [1e-5]}}
        sensitive = {"sensitivities": {"n_p2": [4], "n_s2": [2], "direction": ["x"], "seeds": 2}}
        scenes = TINY["scenes"] | watched | sensitive
        tiny = Study.begun(Path(name) / "study", scenes=scenes, **everything)
        said = tiny.run("--dry-run", "--printshellcmds", "--quiet", "host")
    found = re.findall(r"^Shell command: (.*(?:\n {4,}.*)*)", said, re.MULTILINE)
    return "\n".join(sorted({anywhere(command) for command in found})) + "\n"


def figures() -> str:
    """Texts, and sums over the points of each kind in each panel, weighted by their order."""
    return written(pd.DataFrame(chain.from_iterable(map(sums, DRAWINGS))))


def sums(name: str) -> Iterator[Row]:
    picture = drawn(name)
    beside = [
        text.get_text()
        for part in (*picture.legends, *picture.texts)
        for text in part.findobj(Text)
    ]
    yield {"figure": name, "kind": " | ".join(filter(None, dict.fromkeys(beside)))}
    for panel, ax in enumerate(drawn(name).axes):
        kinds: dict[str, list[np.ndarray]] = {}
        for kind, points in shown(ax):
            kinds.setdefault(kind, []).append(points)
        for kind, several in kinds.items():
            points = np.concatenate(several)
            places = np.linspace(0.5, 1.0, len(points))[:, None]
            x, y = np.nansum(places * points, axis=0)
            row = {"figure": name, "panel": panel, "kind": kind, "points": len(points)}
            yield row | {"x": x, "y": y}
        texts = [*ax.texts, ax.title, ax.xaxis.label, ax.yaxis.label]
        texts += (ax.get_legend() or ax).findobj(Text) if ax.get_legend() else []
        said = dict.fromkeys(text.get_text().replace("\n", " ") for text in texts)
        yield {"figure": name, "panel": panel, "kind": " | ".join(filter(None, said))}


def shown(ax: Axes) -> Iterator[tuple[str, np.ndarray]]:
    """Yield the points, (n, 2), of axes, texts, lines, symbols, bands, bars, arrows and images."""
    limits = (ax.get_xlim(), ax.get_autoscalex_on()), (ax.get_ylim(), ax.get_autoscaley_on())
    for axis, (ends, automatic), column in zip(
        (ax.xaxis, ax.yaxis), limits, np.eye(2), strict=True
    ):
        locator = axis.get_major_locator()  # what is automatic depends on matplotlib's version
        chosen = locator.locs if isinstance(locator, FixedLocator) else []
        yield "axes", np.outer([*chosen, *([] if automatic else ends)], column)
    for text in ax.texts:
        yield "texts", np.array([text.get_position()], dtype=float)
    for line in ax.lines:
        yield "lines", np.array(line.get_xydata(), dtype=float)
    for patch in ax.patches:
        if isinstance(patch, FancyArrowPatch):
            yield "arrows", patch.get_path().vertices[:1].round(1)  # the rest is in pixels
        else:
            yield "patches", patch.get_patch_transform().transform(patch.get_path().vertices)
    for collection in ax.collections:
        yield "collections", np.asarray(collection.get_offsets(), dtype=float)
        for path in collection.get_paths():
            yield "collections", path.vertices
    for image in ax.images:
        values = np.ma.filled(image.get_array().astype(float), np.nan).ravel()
        yield "images", np.stack([values, np.arange(values.size)], axis=1)
        yield "images", np.reshape(image.get_extent(), (2, 2))


PAGES = {"accuracy": accuracy, "mechanism": reasons}
TEXTS: dict[str, Callable[[], str]] = {
    "accuracy.csv": errors_measured,
    "cases.csv": cases,
    "claims.csv": findings,
    "commands.txt": commands,
    "fields.txt": fields,
    "figures.csv": figures,
    "jobs.txt": jobs,
    "pages.csv": pages,
    "plans.txt": plans,
}


def anywhere(text: str) -> str:
    """Return the text without digests of code and files."""
    in_folders, whole = r"(?<=-)[0-9a-f]{8}(?=[/.])", r"(?<!\.)\b(?=\d*[a-f])[0-9a-f]{16,}\b"
    return re.sub(f"{in_folders}|{whole}", "...", text)


@pytest.mark.parametrize("name", TEXTS)
def test_texts_are_those_recorded(name, monkeypatch):
    """Words to the letter, numbers to a millionth."""
    monkeypatch.undo()  # as many resamples as usual
    now, before = anywhere(TEXTS[name]()), (RECORDED / name).read_text(encoding="utf-8")
    assert NUMBER.sub("#", now).splitlines() == NUMBER.sub("#", before).splitlines()
    values = [np.array(NUMBER.findall(text), float) for text in (now, before)]
    np.testing.assert_allclose(*values, rtol=1e-6, atol=1e-12)


if __name__ == "__main__":
    for name, text in TEXTS.items():
        (RECORDED / name).write_text(anywhere(text()), encoding="utf-8")
