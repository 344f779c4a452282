"""Snakemake in processes that need not import it again, which is half of what a dry run takes."""

import multiprocessing
import os
import sys
from collections.abc import Mapping
from tempfile import NamedTemporaryFile

_CONTEXT = multiprocessing.get_context("forkserver")
_CONTEXT.set_forkserver_preload(
    ["snakemake.cli", "snakemake.report.html_reporter", "springblock.cli", "springblock.study.plan"]
)


def snakemake(folder: str, environment: Mapping[str, str], words: list[str]) -> tuple[int, str]:
    """Run Snakemake in a folder; returns its exit status and what it says."""
    with NamedTemporaryFile("r") as log:
        process = _CONTEXT.Process(target=_main, args=(folder, environment, words, log.name))
        process.start()
        process.join()
        return process.exitcode, log.read()


def _main(folder: str, environment: Mapping[str, str], words: list[str], log: str) -> None:
    from snakemake.cli import main

    os.chdir(folder)
    os.environ.update(environment)
    with open(log, "a") as said:  # noqa: PTH123
        for stream in (1, 2):
            os.dup2(said.fileno(), stream)
    sys.argv = ["snakemake", *words]
    main(words)
