"""A tiny study in a folder of its own: configured, run by Snakemake, and looked at."""

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import yaml

ROOT = Path(__file__).parents[1]
PARTS = ("Snakefile", "environment.lock", "workflow", "config", "profiles")
PAPER = yaml.safe_load((ROOT / "config/config.yaml").read_text())
SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
GROOVES = {"n_p": [5], "n_s": [7], "n_p2": [1], "n_s2": [1]}
#: Each kind of surface, in seven batches of at most two realisations; null leaves a group out.
TINY = {
    "n_blocks": 12,
    "realisations_per_job": 2,
    "parts": [],
    "first_seed": 0,
    "material": {**PAPER["material"], "slider_velocity": 5e-3},  # so that runs are short
    "scenes": dict.fromkeys(PAPER["scenes"])
    | {
        "flat": {"seeds": 3, "duration": 2e-5},
        "pillars": {"n_p": [3, 6], "seeds": [2, 3]},
        "again": {"n_p": [6], "n_s": [6], "direction": ["x"], "seeds": 1},
        "grooves": GROOVES | {"direction": ["x", "y"], "seeds": 1},
    },
    "figures": {
        "figure_4": {"n_p": 3, "n_s": 3},
        "figure_5": {"n_p": 3},
        "figure_7": {"n_p": 6},
        "figure_8": {"n_p": 5, "n_s": 7, "n_p2": 1, "n_s2": 1},
    },
}


#: Of each kind of surface one scene, where the figures of the others do not matter.
FEWER = {
    "scenes": dict.fromkeys(PAPER["scenes"])
    | {
        "flat": {"seeds": 3, "duration": 2e-5},
        "pillars": {"n_p": [6], "seeds": 3},
        "grooves": GROOVES | {"direction": ["x"], "seeds": 1},
    },
    "figures": TINY["figures"] | {"figure_5": {"n_p": 6}},
}


@dataclass(frozen=True)
class Study:
    """A folder with the workflow and a configuration, `tiny.yaml`."""

    folder: Path
    options: tuple[str, ...] = ()  #: of every start of Snakemake
    targets: tuple[str, ...] = ()  #: what is made unless others are named

    @classmethod
    def begun(cls, folder: Path, **changes: Any) -> "Study":
        """Copy the workflow into a folder, and configure it; nothing is run."""
        folder.mkdir(parents=True, exist_ok=True)
        for part in PARTS:
            copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy
            copy(ROOT / part, folder / part)
        study = cls(folder)
        study.write("tiny.yaml", {**TINY, **changes})
        return study

    def copied(self, folder: Path) -> "Study":
        """Copy the study with its time stamps."""
        return replace(self, folder=Path(shutil.copytree(self, folder)))

    @property
    def results(self) -> Path:
        return self / "results"

    def __truediv__(self, path: str | Path) -> Path:
        return self.folder / path

    def __fspath__(self) -> str:
        return str(self.folder)

    @property
    def configuration(self) -> dict[str, Any]:
        return yaml.safe_load((self / "tiny.yaml").read_text())

    def configure(self, **changes: Any) -> None:
        """Give keys of the configuration other values."""
        self.write("tiny.yaml", {**self.configuration, **changes})

    def write(self, name: str, configuration: dict[str, Any]) -> None:
        """Write a configuration."""
        (self / name).write_text(yaml.safe_dump(configuration))

    def edit(self, module: str, old: str = "", new: str = "\n# another line\n") -> None:
        """Replace a piece of a module, or add a comment, in a package of the study's own."""
        if not (self / "src").exists():
            shutil.copytree(ROOT / "src", self / "src")
        file = self / "src/springblock" / module
        content = file.read_text()
        assert old in content
        file.write_text(content.replace(old, new, 1) if old else content + new)

    @property
    def environment(self) -> dict[str, str]:
        """As if activated, with the study's own package or else that of this repository."""
        own = self / "src"
        sources = [own if own.exists() else ROOT / "src", os.environ.get("PYTHONPATH")]
        programs = [Path(sys.executable).parent, os.environ["PATH"]]
        paths = {"PYTHONPATH": sources, "PATH": programs}
        joined = {name: os.pathsep.join(map(str, filter(None, paths[name]))) for name in paths}
        return {**os.environ, **joined}

    def command(
        self,
        *options: str,
        configuration: tuple[str, ...] = ("tiny.yaml",),
        targets: tuple[str, ...] = (),
    ) -> list[str]:
        """Return the words that follow `snakemake`."""
        words = ["--max-jobs-per-timespan", "100/1s"]  # so that it ends without a wait
        words += ["--configfile", *configuration, *self.options, *options]
        return [*words, *(("--", *named) if (named := targets or self.targets) else ())]

    def start(self, *options: str, **how: Any) -> subprocess.Popen[str]:
        """Start Snakemake as a user does, in a process group of its own; `stdout` goes to Popen."""
        into = {"stdout": how.pop("stdout", subprocess.PIPE), "stderr": subprocess.STDOUT}
        command = [sys.executable, "-m", "snakemake", *self.command(*options, **how)]
        return subprocess.Popen(
            command, cwd=self, env=self.environment, text=True, start_new_session=True, **into
        )

    def run(self, *options: str, refused: bool = False, **how: Any) -> str:
        """Run Snakemake to its end, which is success unless `refused`; returns what it says."""
        if (self / "src").exists():  # another package than the one that is imported here
            process = self.start(*options, **how)
            said, status = process.communicate()[0], process.returncode
        else:
            from forked import snakemake  # `tests.slurm` does not have it

            words = self.command(*options, **how)
            status, said = snakemake(str(self.folder), self.environment, words)
        assert (status != 0) == refused, said
        return said

    def planned(self, *options: str, **how: Any) -> dict[str, int]:
        """Jobs that a dry run announces, by rule."""
        said = self.run("--dry-run", *options, **how)
        table = re.search(r"job +count\n-+  -+\n(.*?)\n\n", said, re.DOTALL)
        rows = [row.split() for row in table[1].splitlines()] if table else []
        return {name: int(count) for name, count in rows if name != "total"}

    def numbers(self, results: str = "results", files: str = "tables/*.parquet") -> dict[str, str]:
        """All numbers of these files to the last bit, as text: NaN are alike."""
        found = sorted((self / results).glob(files))
        return {
            str(file.relative_to(self / results)): repr(pq.read_table(file).to_pylist())
            for file in found
        }
