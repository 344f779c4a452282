"""Damaged files of every kind: the reader's result, or one sentence that names the file."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from springblock import Pattern, Prelude, Surface, compute_prelude, read
from springblock.model.blockmap import BlockMap

PATTERN = Pattern.pillars(6, 2, 1)
READERS: dict[str, Callable[[Path], object]] = {
    "batch.parquet": read,
    "prelude.npz": Prelude.read,
    "mask.npy": BlockMap.mask,
    "mask.png": BlockMap.mask,
    "mask.bmp": BlockMap.mask,
    "coefficients.npy": BlockMap.coefficients,
}
#: A place in the file, often in its header; a new byte, or minus the number of bytes to remove.
DAMAGE = st.tuples(
    st.one_of(st.integers(0, 127), st.integers(0, 10**5)),
    st.one_of(st.integers(0, 255), st.integers(-8, -1)),
)


@pytest.fixture
def whole(springblock, tmp_path) -> Path:
    """A folder with a whole file of each kind."""
    springblock(
        "simulate", "--n-blocks", 6, "--duration", 1e-6, "--output", tmp_path / "batch.parquet"
    )
    surface = Surface.draw(PATTERN.contact, seed=1)
    compute_prelude(PATTERN.contact).save(tmp_path / "prelude.npz")
    np.save(tmp_path / "mask.npy", PATTERN.contact)
    np.save(tmp_path / "coefficients.npy", surface.mu_static)
    for kind in ("png", "bmp"):
        Image.fromarray(PATTERN.contact).save(tmp_path / f"mask.{kind}")
    return tmp_path


@pytest.mark.parametrize("name", READERS)
def test_a_damaged_file_is_read_or_refused_in_one_sentence(name, whole):
    file = whole / name
    content = file.read_bytes()

    @settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
    @given(st.lists(DAMAGE, min_size=1, max_size=8))
    def damage(places):
        damaged = bytearray(content)
        for place, byte in places:
            place %= len(damaged)
            damaged[place : place + max(1, -byte)] = bytes([byte] if byte >= 0 else [])
        file.write_bytes(damaged)
        refusal = None
        try:
            READERS[name](file)
        except ValueError as error:
            refusal = str(error)
        assert refusal is None or (str(file) in refusal and "\n" not in refusal)

    damage()
