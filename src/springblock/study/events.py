"""What happens beside the jobs of a run of Snakemake; the workflow alone imports this module."""

import logging
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Mapping
from itertools import chain
from pathlib import Path
from typing import Any

from snakemake.common import NOTHING_TO_BE_DONE_MSG
from snakemake.exceptions import WorkflowError
from snakemake.settings.types import RerunTrigger
from snakemake_interface_logger_plugins.common import LogEvent

from springblock.study import record


class Events(logging.Filter):
    """Acts on events, also of a module of another workflow, where `onstart` is not called.

    `contents` has what the record keeps of the results, see `record.begin`.
    """

    def __init__(
        self,
        workflow: Any,
        configuration: Mapping[str, Any],
        contents: Callable[[], Mapping[str, Any]],
    ) -> None:
        super().__init__()
        self.workflow, self.configuration = workflow, configuration
        self.results = Path(configuration["results"])
        self.contents = contents
        self.begun = time.time()
        self.tables = 0

    def filter(self, record: Any) -> bool:
        """Return whether Snakemake shall print the record of an event."""
        event = getattr(record, "event", None)
        try:
            if event == LogEvent.WORKFLOW_STARTED:
                self._start()
            elif event == LogEvent.RUN_INFO or record.msg == NOTHING_TO_BE_DONE_MSG:
                self._planned(event == LogEvent.RUN_INFO)
        except (OSError, ValueError) as error:
            raise WorkflowError(f"The study cannot be run: {error}.") from None
        return self.tables < 2 or event != LogEvent.RUN_INFO

    def tell_errors(self) -> None:
        """Print the last error in each log of this run, which the quiet profile does not show."""
        for file in sorted(self.results.joinpath("logs").rglob("*.log")):
            said = file.read_text(errors="replace") if file.stat().st_mtime >= self.begun else ""
            for line in [line for line in said.splitlines() if "Error" in line][-1:]:
                print(f"{file}: {line}", file=sys.stderr)

    def _start(self) -> None:
        """Refuse results that may be of another configuration, and read targets."""
        compared = set(RerunTrigger.all()) <= set(self.workflow.rerun_triggers)
        self._refuse("" if compared else "--rerun-triggers leaves such changes out")
        settings = self.workflow.dag_settings
        settings.targets = list(chain.from_iterable(map(self._meant, settings.targets)))

    def _refuse(self, unseen: str) -> None:
        record.refuse_unknown(self.results, self.configuration, unseen)

    def _meant(self, target: str) -> Iterable[str]:
        """Return what a target stands for: all files of a rule that has wildcards."""
        rule = self.workflow.get_rule(target) if self.workflow.is_rule(target) else None
        if rule is None or not rule.has_wildcards():
            return [target]
        contents = self.contents()
        files = [str(self.results / name) for name in (*contents["files"], *contents["spare"])]
        return [file for file in files if rule.is_producer(file)] or [target]

    def _planned(self, has_jobs: bool) -> None:
        """Record a run before its first job."""
        self.tables += 1
        if self.workflow.touch and has_jobs:
            self._refuse("--touch does not compare them")
        if not self.workflow.dryrun:
            _refuse_orphans()
            if not self._repairs():
                remembers = self.workflow.execution_settings.keep_metadata
                record.begin(self.results, self.configuration, self.contents(), remembers)

    def _repairs(self) -> bool:
        """Whether the only target is `repair`, which compares with what is recorded."""
        targets = self.workflow.dag_settings.targets
        return len(targets) == 1 and targets[0].endswith("repair")


def _refuse_orphans() -> None:
    """Refuse to start beside Slurm's jobs of a killed run of this folder: they write its files."""
    if not shutil.which("squeue"):
        return
    command = ["squeue", "--me", "--noheader", "--format=%j|%Z"]
    listed = subprocess.run(command, capture_output=True, text=True).stdout
    jobs = [line.split("|", 1) for line in listed.splitlines()]
    names = {name for name, folder in jobs if Path(folder) == Path.cwd()}
    orphans = sorted(name for name in names if name.startswith("springblock_"))
    if orphans:
        raise WorkflowError(
            "Slurm still has jobs of a run of this folder that was killed. "
            f"Wait until they end, or cancel them: scancel --name={','.join(orphans)}"
        )
