"""The tiny study whose tables must survive faults, made on one core."""

import shutil
import subprocess
from pathlib import Path

import studies

TARGETS = ("aggregate", "correlations")


class Study(studies.Study):
    """A folder with a study, of which these targets are made."""

    @property
    def results(self) -> Path:
        return self / "results"

    def command(self, *options: str, **how) -> list[str]:
        return super().command("--cores", "1", *options, **how)

    def start(
        self, *options: str, targets: tuple[str, ...] = TARGETS, **how
    ) -> subprocess.Popen[str]:
        return super().start(*options, "--", *targets, **how)


def copy(study: Study, folder: Path) -> Study:
    """Copy a study with its time stamps."""
    return Study(Path(shutil.copytree(study, folder)))
