"""Checkpoints: files from which unfinished runs continue, with the same result to the bit."""

import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.files import read_arrays, whole_file
from springblock.model.numbers import Array, check_real
from springblock.provenance import digest
from springblock.simulation.motion import Motion
from springblock.solver.lattice import Lattice, Samples


def belonging(surface: str, friction: Sequence[Array], **asked: object) -> dict[str, str]:
    """Return what determines a run, as text or digest, by the names used in error messages.

    `surface` comes from `prelude.conditions`. The number of cores and the prelude are left out,
    since results do not depend on them.
    """
    coefficients = b"".join(mu.tobytes() for mu in friction)
    return {
        "scene, material, integrator, step or sample_interval": surface,
        "friction coefficients": hashlib.sha256(coefficients).hexdigest(),
        **{name: repr(value) for name, value in asked.items()},
        "code": digest("simulate"),
    }


@dataclass
class Checkpoint:
    """Checkpoint file of a run and the interval at which it is written."""

    path: Path
    interval: float  #: wall-clock seconds between two checkpoints
    belongs: dict[str, str]  #: see `belonging`
    written: float = field(default_factory=monotonic)  #: s, time of the last checkpoint

    def __post_init__(self) -> None:
        check_real("checkpoint_interval", self.interval)

    @property
    def is_due(self) -> bool:
        """Whether the interval since the last checkpoint has passed."""
        return monotonic() - self.written >= self.interval

    def save(self, motion: Motion, snapshots: Sequence[Array]) -> None:
        """Write the state of a run between two samples, whole or not at all."""
        arrays: dict[str, Any] = {
            "belongs": np.array(json.dumps(self.belongs)),
            "snapshots": np.array(snapshots),
            **motion.recorded()._asdict(),
            **{f"field_{i}": values for i, values in enumerate(_fields(motion.state))},
        }
        arrays["digest"] = _digest(arrays)
        with whole_file(self.path) as partial, partial.open("wb") as file:
            np.savez(file, **arrays)
        self.written = monotonic()

    def resume(self, motion: Motion) -> list[Array]:
        """Continue from the file, if there is one; return the snapshots up to then.

        Files that are no checkpoint, and those of another run, are refused with a ValueError.
        """
        if not self.path.exists():
            return []
        try:
            kept = read_arrays(self.path)
            if kept.pop("digest") != _digest(kept):
                raise ValueError
            belongs = json.loads(str(kept["belongs"]))
        except (KeyError, ValueError):
            raise ValueError(
                f"{self.path} is not a checkpoint, or damaged; remove it first"
            ) from None
        other = [name for name, own in self.belongs.items() if belongs.get(name) != own]
        if other:
            raise ValueError(
                f"{self.path} belongs to a run with other {', '.join(other)}; remove it first"
            )
        for i, values in enumerate(_fields(motion.state)):
            values[:] = kept[f"field_{i}"]
        taken = Samples(*(kept[name] for name in Samples._fields))
        motion.samples, motion.record = len(taken.force_x) - 1, [taken]
        return list(kept["snapshots"])


def _digest(arrays: dict[str, NDArray[Any]]) -> str:
    """Return the digest of arrays: an edited file may still be a valid one of its type."""
    content = hashlib.sha256()
    for name, values in sorted(arrays.items()):
        content.update(f"{name} {values.dtype} {values.shape}".encode() + values.tobytes())
    return content.hexdigest()


def _fields(state: Lattice) -> list[NDArray[Any]]:
    """Return all fields that determine the rest of a run."""
    of_law = [part for part in state.law or () if isinstance(part, np.ndarray)]
    return [*state.blocks, state.ledger, *of_law]
