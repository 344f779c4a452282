"""springblock plot, animate and show."""

import pytest

from springblock.plotting import film, style


@pytest.fixture(autouse=True)
def quicker(monkeypatch):
    monkeypatch.setitem(style.JOURNAL, "savefig.dpi", 72)
    monkeypatch.setattr(film, "FRAMES", 20)


def test_a_run_is_plotted_with_its_caption(springblock, batch, tmp_path):
    springblock("plot", batch(0, 1), "--output", tmp_path / "run.pdf")
    assert b"Friction force over the normal force" in (tmp_path / "run.pdf").read_bytes()


def test_the_seed_chooses_the_run(springblock, batch, tmp_path):
    pictures = [tmp_path / f"{name}.svg" for name in ("first", "0", "1")]
    for picture, seed in zip(pictures, ([], ["--seed", 0], ["--seed", 1]), strict=True):
        springblock("plot", batch(0, 1), *seed, "--output", picture)
    first, zero, one = (picture.read_text() for picture in pictures)
    assert first == zero != one


def test_fields_are_mapped_alone(springblock, tmp_path):
    fields, picture = tmp_path / "run.nc", tmp_path / "run.svg"
    short = ("--n-blocks", 6, "--duration", 4e-6, "--snapshot-times", 2e-6, "--fields", fields)
    springblock("simulate", *short, "--output", tmp_path / "run")
    springblock("plot", fields, "--output", picture)
    assert "magnitude of the shear stress" in picture.read_text(encoding="utf-8")
    for words in ([fields], ["--seed", 0], ["--over", "n_p"], ["--of", "t_max"]):
        said = springblock("plot", fields, *words, "--output", tmp_path / "a.png", refused=True)
        assert said.endswith("run.nc holds fields of one run: plot it alone, without an option")
    (tmp_path / "short.nc").write_bytes(fields.read_bytes()[:1000])
    said = springblock("plot", tmp_path / "short.nc", "--output", tmp_path / "a.png", refused=True)
    assert said.endswith("short.nc holds no fields of springblock, or is cut short")
    assert not (tmp_path / "a.png").exists()


def test_a_surface_is_shown(springblock, tmp_path):
    surface = ("--n-blocks", 12, "--n-p", 4, "--n-s", 2, "--direction", 30)
    springblock("show", *surface, "--output", tmp_path / "surface.svg")
    text = (tmp_path / "surface.svg").read_text(encoding="utf-8")
    assert "64 of 144 blocks in contact, 44.4 %" in text
    assert "n_blocks = 12, n_p = 4, n_s = 2, direction = 30" in text
