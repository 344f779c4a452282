"""A Slurm of one node on this machine, from Debian's packages and without systemd."""

import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

#: Where Debian's Slurm looks; Snakemake's plugin takes SLURM_CONF out of the environment.
CONFIGURATION = Path("/etc/slurm/slurm.conf")
_PATIENCE = 60.0  #: s until the node is ready, or the daemon back

#: What a job may ask for is counted, but not enforced: that takes control groups.
_SETTINGS = """\
ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
EnforcePartLimits=ALL
AccountingStorageType=accounting_storage/none
MinJobAge=3600
ReturnToService=2
MpiDefault=none
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} RealMemory={memory}
PartitionName=all Nodes=ALL Default=YES MaxTime=1-0
"""
#: Stands for accounts, which this Slurm does not keep, and which the plugin asks after an outage.
_SACCT = """\
#!/bin/sh
while [ $# -gt 0 ]; do [ "$1" = --name ] && name=$2; shift; done
[ -z "$name" ] || exec squeue --states=all --noheader --format='%i|%T' --name "$name"
"""


class Failed(Exception):
    """Why there is no Slurm here, or what a test has found."""


@dataclass
class Cluster:
    """A running Slurm."""

    folder: Path
    daemons: dict[str, subprocess.Popen[bytes]] = field(default_factory=dict)

    def start(self, *command: str) -> None:
        """Start a daemon that stays in the foreground."""
        log = (self.folder / f"{Path(command[0]).name}.out").open("ab")
        # A session of its own: what ends the daemon ends the jobs that it has started, too
        self.daemons[command[0]] = subprocess.Popen(
            command, stdout=log, stderr=subprocess.STDOUT, start_new_session=True
        )

    def kill(self, daemon: str) -> None:
        """Kill one daemon, as a crash would."""
        self.daemons[daemon].kill()
        self.daemons.pop(daemon).wait()

    def start_controller(self) -> None:
        """Start slurmctld; it finds the state that an earlier one has left."""
        self.start("slurmctld", "-D", "-f", str(CONFIGURATION))
        wait("slurmctld to answer", lambda: asked("sinfo", "--noheader", "--format=%T") != "")

    def jobs(self, *options: str) -> list[str]:
        """Lines of squeue."""
        return asked("squeue", "--noheader", *options).splitlines()

    def stop(self) -> None:
        """End all jobs and daemons."""
        if self.jobs():
            subprocess.run(["scancel", "--full", "--user=root"], check=False, timeout=_PATIENCE)
            wait("jobs to end", lambda: not self.jobs("--states=R,PD,CG"))
        for daemon in reversed(self.daemons.values()):
            os.killpg(daemon.pid, signal.SIGKILL)
            daemon.wait()


def asked(*command: str) -> str:
    """What a command of Slurm writes; nothing where it fails."""
    try:
        return subprocess.run(command, capture_output=True, text=True, timeout=30).stdout
    except subprocess.TimeoutExpired:
        return ""


def wait(what: str, done: Callable[[], bool], patience: float = _PATIENCE) -> None:
    """Wait until something is done; raises Failed after `patience`, s."""
    end = time.monotonic() + patience
    while not done():
        if time.monotonic() > end:
            raise Failed(f"Waited {patience:.0f} s for {what}")
        time.sleep(0.2)


@contextmanager
def one_node() -> Iterator[Cluster]:
    """Start a Slurm of one node, and stop it at the end; raises Failed."""
    if os.geteuid():
        raise Failed("Slurm's daemons must be started by root")
    if os.path.lexists(CONFIGURATION):
        raise Failed(f"{CONFIGURATION} is there already: this machine has a Slurm of its own")
    folder = Path(tempfile.mkdtemp(prefix="springblock-slurm-"))
    cluster = Cluster(folder)
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") * 9 // 10 // 2**20
    values = {"host": socket.gethostname().split(".")[0], "cores": os.cpu_count()}
    (folder / "slurm.conf").write_text(_SETTINGS.format(folder=folder, memory=memory, **values))
    for name in ("state", "spool"):
        (folder / name).mkdir()
    sacct = folder / "bin/sacct"
    sacct.parent.mkdir()
    sacct.write_text(_SACCT)
    sacct.chmod(0o755)
    os.environ["PATH"] = os.pathsep.join([str(sacct.parent), os.environ["PATH"]])
    CONFIGURATION.symlink_to(folder / "slurm.conf")
    try:
        _start(cluster)
        yield cluster
    finally:
        cluster.stop()
        CONFIGURATION.unlink()
        shutil.rmtree(folder, ignore_errors=True)


def _start(cluster: Cluster) -> None:
    folder = cluster.folder
    key = folder / "munge.key"
    key.write_bytes(os.urandom(128))
    key.chmod(0o400)
    files = {"socket": "munge.socket", "key-file": key.name, "log-file": "munge.log"}
    files |= {"pid-file": "munge.pid", "seed-file": "munge.seed"}
    options = [f"--{option}={folder / file}" for option, file in files.items()]
    folder.chmod(0o755)
    cluster.start("munged", "--foreground", "--force", *options)
    wait("munged", (folder / "munge.socket").exists)
    cluster.start_controller()
    cluster.start("slurmd", "-D", "-f", str(CONFIGURATION))
    wait("the node", lambda: asked("sinfo", "--noheader", "--format=%T").strip() == "idle")
