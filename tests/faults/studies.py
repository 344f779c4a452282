"""A tiny study, and what can be done with it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pyarrow.parquet as pq
import yaml

ROOT = Path(__file__).parents[2]
PAPER = yaml.safe_load((ROOT / "config/config.yaml").read_text())
GROOVES = {"n_p": [5], "n_s": [7], "n_p2": [1], "n_s2": [1]}
TINY = {
    "n_blocks": 12,
    "realisations_per_job": 2,
    "accuracy": False,
    "material": {**PAPER["material"], "slider_velocity": 5e-3},  # soon over
    "scenes": dict.fromkeys(PAPER["scenes"])
    | {
        "flat": {"seeds": 2, "duration": 2e-5},
        "pillars": {"n_p": [6], "seeds": 3},
        "grooves": {
            "n_p": [5],
            "n_s": [7],
            "n_p2": [1],
            "n_s2": [1],
            "direction": ["x"],
            "seeds": 1,
        },
    },
}
TARGETS = ("aggregate", "correlations")


class Study(NamedTuple):
    """A folder with a study."""

    folder: Path

    @property
    def results(self) -> Path:
        return self.folder / "results"

    def file(self, pattern: str) -> Path:
        """The only file, or the first, that fits."""
        return sorted(self.results.glob(pattern))[0]

    def command(self, *options: str, targets: tuple[str, ...] = TARGETS) -> list[str]:
        files = ["--configfile", "tiny.yaml"]
        return [sys.executable, "-m", "snakemake", *files, "--cores", "1", *options, "--", *targets]

    @property
    def environment(self) -> dict[str, str]:
        """With the sources of all, which need not be compiled again, or with edited ones."""
        own = self.folder / "src"
        source = str(own if own.exists() else ROOT / "src")
        others = os.environ.get("PYTHONPATH", "")
        return {**os.environ, "PYTHONPATH": os.pathsep.join([source, others])}

    def start(
        self, *options: str, targets: tuple[str, ...] = TARGETS, **how
    ) -> subprocess.Popen[str]:
        """Begin a run, in a process group of its own."""
        return subprocess.Popen(
            self.command(*options, targets=targets),
            cwd=self.folder,
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
            **how,
        )

    def run(self, *options: str, refused: bool = False, **how) -> str:
        """Run Snakemake to its end, and return what it says."""
        process = self.start(*options, **how)
        said, _ = process.communicate()
        assert (process.returncode != 0) == refused, said
        return said

    def configure(self, **changes) -> None:
        """Change the configuration."""
        (self.folder / "tiny.yaml").write_text(yaml.safe_dump({**TINY, **changes}))

    @property
    def configuration(self) -> dict:
        return yaml.safe_load((self.folder / "tiny.yaml").read_text())

    def edit(self, module: str, old: str = "", new: str = "# another line\n") -> None:
        """Change the code: replace a piece of a module, or add a comment."""
        shutil.copytree(ROOT / "src", self.folder / "src", dirs_exist_ok=True)
        file = self.folder / "src/springblock" / module
        content = file.read_text()
        assert old in content
        file.write_text(content.replace(old, new, 1) if old else content + new)

    @property
    def tables(self) -> dict[str, str]:
        """All numbers of all tables, as text: NaN are alike."""
        return self.tables_in("results")

    def tables_in(self, results: str) -> dict[str, str]:
        files = sorted((self.folder / results / "tables").glob("*.parquet"))
        return {file.name: repr(pq.read_table(file).to_pylist()) for file in files}


def copy(study: Study, folder: Path) -> Study:
    """Copy a study with its time stamps."""
    return Study(Path(shutil.copytree(study.folder, folder)))
