"""An unfinished run in a file, to go on from as if nothing had stopped it."""

import hashlib
import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.files import read_arrays, whole_file
from springblock.provenance import digest
from springblock.simulation.checks import check_positive
from springblock.solver.lattice import Samples, State

Array = NDArray[np.float64]


def belonging(surface: str, friction: Sequence[Array], **asked: object) -> dict[str, str]:
    """What an unfinished run belongs to, by the names under which another is refused.

    `surface` is what `prelude.conditions` returns. The number of cores and the prelude are not
    part of it, since they change no bit.
    """
    coefficients = b"".join(mu.tobytes() for mu in friction)
    return {
        "scene or setup": _digest(surface.encode()),
        "friction coefficients": _digest(coefficients),
        **{name: repr(value) for name, value in asked.items()},
        "code": digest("simulate"),
    }


def check_belonging(path: Path, theirs: dict[str, Any], ours: dict[str, Any]) -> None:
    """Refuse a file that was kept for another run, naming what differs."""
    other = ", ".join(name for name in ours | theirs if theirs.get(name) != ours.get(name))
    if other:
        raise ValueError(f"{path} belongs to a run of other {other}; remove it first")


@dataclass
class Checkpoint:
    """Where an unfinished run is kept, and how often.

    Raises
    ------
    TypeError, ValueError
        Where the interval is not a positive number.
    """

    path: Path
    interval: float  #: wall-clock seconds between two checkpoints
    belongs: dict[str, str]  #: see `belonging`
    written: float = field(default_factory=monotonic)  #: s, the last time

    def __post_init__(self) -> None:
        check_positive("checkpoint_interval", self.interval)

    @property
    def is_due(self) -> bool:
        """Whether it was last written long enough ago."""
        return monotonic() - self.written >= self.interval

    def save(self, state: State, taken: Iterable[Samples], snapshots: Sequence[Array]) -> None:
        """Write a run as it stands between two samples, whole or not at all."""
        samples = [np.concatenate(parts) for parts in zip(*taken, strict=True)]
        arrays: dict[str, Any] = {
            "belongs": json.dumps(self.belongs),
            "snapshots": np.array(snapshots),
            **dict(zip(Samples._fields, samples, strict=True)),
            **{f"field_{i}": values for i, values in enumerate(_fields(state))},
        }
        with whole_file(self.path) as partial, partial.open("wb") as file:
            np.savez(file, **arrays)
        self.written = monotonic()

    def restore(self, state: State) -> tuple[Samples, list[Array]]:
        """Move `state`, at rest so far, on to where it was saved; return samples and snapshots.

        Raises
        ------
        ValueError
            Where the file keeps another run, naming what differs, or is none.
        """
        kept = _read(self.path)
        check_belonging(self.path, json.loads(str(kept["belongs"])), self.belongs)
        for i, values in enumerate(_fields(state)):
            values[:] = kept[f"field_{i}"]
        return Samples(*(kept[name] for name in Samples._fields)), list(kept["snapshots"])


def _read(path: Path) -> dict[str, Any]:
    try:
        kept = read_arrays(path)
    except ValueError as error:
        raise ValueError(f"{path} is no checkpoint: {error}") from error
    if "belongs" not in kept:
        raise ValueError(f"{path} is no checkpoint: it holds {', '.join(kept)}")
    return kept


def _fields(state: State) -> list[NDArray[Any]]:
    """All that a run goes on from; what it works in is filled anew."""
    of_law = [part for part in state.law or () if isinstance(part, np.ndarray)]
    return [*state.blocks, *state.work, state.ledger, *of_law]


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
