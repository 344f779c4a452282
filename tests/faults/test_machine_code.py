"""Machine code that is damaged, or that cannot be kept."""

import pytest

from kernels import COMPILING, run_kernels


@pytest.mark.parametrize("harm", ["emptied", "truncated", "flipped", "foreign"])
def test_damaged_machine_code_is_never_run(tmp_path, harm):
    run_kernels(tmp_path / "kept")
    (file,) = tmp_path.glob("kept/*/*.twice-*")
    whole = file.read_bytes()
    flipped = bytearray(whole)
    flipped[len(whole) // 2] ^= 1
    harmed = {"emptied": b"", "truncated": whole[:-1], "flipped": flipped, "foreign": b"\x7fELF"}
    file.write_bytes(harmed[harm])
    assert run_kernels(tmp_path / "kept") == (["0", "1"], [COMPILING], 0)
    assert run_kernels(tmp_path / "kept") == (["1", "1"], [], 0)


def test_what_cannot_be_kept_is_compiled_all_the_same(tmp_path):
    (tmp_path / "kept").write_text("a file where a folder should be")
    hits, said, code = run_kernels(tmp_path / "kept")
    assert (hits, said[0], code) == (["0", "0"], COMPILING, 0)
    (why,) = said[1:]
    assert why.startswith("machine code cannot be kept for the next time in ")
    assert str(tmp_path / "kept") in why
