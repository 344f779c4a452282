# What a run of Snakemake sees to before its first job and while jobs end.

import fcntl
import logging
import platform
import shutil
import subprocess
import time
from contextlib import suppress
from datetime import datetime, timedelta

from snakemake.logging import logger
from snakemake_interface_logger_plugins.common import LogEvent


def unlock():
    """Remove the lock of a run that was killed on this machine; hold up a hand for our own.

    The kernel lets go of a file of a process that ends, whatever ended it. A lock that Snakemake
    keeps while nobody holds the file is nobody's.
    """
    os.makedirs(".snakemake", exist_ok=True)
    hand, locks = open(".snakemake/alive", "a+"), [*Path(".snakemake/locks").glob("*.lock")]
    try:
        fcntl.flock(hand, fcntl.LOCK_EX | fcntl.LOCK_NB)
        hand.seek(0)
        if not locks or hand.read() == platform.node():
            for lock in locks:
                lock.unlink(missing_ok=True)
            hand.truncate(0)
            hand.write(platform.node())
            hand.flush()
    except OSError:  # another run holds it, or the file system knows no such thing
        pass
    with suppress(OSError):
        fcntl.flock(hand, fcntl.LOCK_SH | fcntl.LOCK_NB)
    return hand


ALIVE = unlock() if workflow.is_main_process else None


def refuse_orphans():
    """Stop while Slurm holds jobs that a killed run of this folder has left; both would write the same files."""
    if not shutil.which("squeue"):
        return
    listed = subprocess.run(
        ["squeue", "--me", "--noheader", "--format=%j|%Z"], capture_output=True, text=True
    )
    jobs = [line.split("|", 1) for line in listed.stdout.splitlines()]
    names = {name for name, folder in jobs if Path(folder) == Path.cwd()}
    orphans = sorted(name for name in names if name.startswith("springblock_"))
    if orphans:
        raise WorkflowError(
            "Slurm still holds jobs of a run of this folder that was killed. "
            f"Wait for their end, or cancel them: scancel --name={','.join(orphans)}"
        )


class Pace(logging.Handler):
    """Says once a minute, as jobs end, when all will have ended."""

    def __init__(self):
        super().__init__()
        self.begun = self.said = time.monotonic()

    def emit(self, record):
        now = time.monotonic()
        if getattr(record, "event", None) != LogEvent.PROGRESS or now < self.said + 60:
            return
        self.said = now
        left = timedelta(
            seconds=round((now - self.begun) * (record.total - record.done) / record.done)
        )
        logger.info(f"At this pace the rest takes {left}, until {datetime.now() + left:%a %H:%M}")


logger.addHandler(Pace())
