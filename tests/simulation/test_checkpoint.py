"""A stopped run continues from its checkpoint to the same bits."""

import numpy as np
import pytest

from specimens import bits, drawn
from springblock import Material, Pattern, Realisation, Setup, compute_prelude, simulate
from springblock.provenance import digest
from springblock.simulation.checkpoint import Checkpoint

PILLARS = Pattern.pillars(12, 4, 2)
LONG = 1.6e-4  #: s, 80 pauses; blocks slide from 126 µs on
TAKEN = 70  #: pauses before the run is stopped, at 140 µs
WHAT = "scene, material, integrator, step or sample_interval"
EACH_PAUSE = 1e-9  #: s between two writings


class Stopped(BaseException):
    """As sudden as a signal."""


@pytest.fixture
def saved(monkeypatch):
    """Times that a checkpoint was written."""
    times, save = [], Checkpoint.save

    def counted(self, *run):
        save(self, *run)
        times.append(len(times))
        if len(times) == TAKEN:
            raise Stopped

    monkeypatch.setattr(Checkpoint, "save", counted)
    return times


@pytest.fixture
def stopped(saved, tmp_path):
    """Stop a run with these options; return the file it has left behind."""

    def left_behind(**options):
        with pytest.raises(Stopped):
            pull(checkpoint=tmp_path / "run.npz", **options)
        saved.clear()
        return tmp_path / "run.npz"

    return left_behind


def pull(seed=1, pattern=PILLARS, setup=Setup(), slide=1.0, **options) -> Realisation:  # noqa: B008
    """Pull a surface whose mu_dynamic is `slide` times as large as drawn."""
    how, surface = {"duration": LONG, "checkpoint_interval": EACH_PAUSE}, drawn(pattern, seed)
    surface.mu_dynamic *= slide
    return simulate(surface, setup, **how | options)


@pytest.mark.parametrize(
    ("integrator", "material"),
    [
        ("leapfrog", Material()),
        ("rk4", Material(law="slip_weakening", slip_distance=5e-8)),
        ("leapfrog", Material(law="slip_weakening", slip_distance=5e-8, healing="none")),
        ("leapfrog", Material(law="config/examples/exponential_weakening.py")),
    ],
    ids=["leapfrog", "rk4", "no healing", "law from a file"],
)
def test_a_continued_run_equals_the_uninterrupted_one(stopped, saved, integrator, material):
    setup, times = Setup(material, integrator), (4e-6, 1.2e-4, 1.41e-4, 1.5e-4)
    how = {"setup": setup, "snapshot_times": times}
    whole = pull(**how)
    assert whole.t_first < 1.4e-4  # there are detachments before it is stopped and after
    assert np.nanmax(whole.t_det) > 1.4e-4
    file = stopped(**how)
    assert bits(pull(**how, checkpoint=file)) == bits(whole)
    assert len(saved) == 80 - TAKEN  # and no more was computed
    assert not file.exists()
    saved.clear()
    open_ended = how | {"duration": None}
    assert bits(pull(**open_ended, checkpoint=stopped(**open_ended))) == bits(pull(**open_ended))


@pytest.mark.parametrize("kept", [True, False])
def test_it_may_continue_without_its_prelude_and_on_more_cores(stopped, kept):
    prelude = compute_prelude(PILLARS.contact)
    how = {"checkpoint": stopped(prelude=prelude, duration=3e-4), "duration": 3e-4, "cores": 2}
    assert bits(pull(**how, prelude=prelude if kept else None)) == bits(pull(duration=3e-4))


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"seed": 2}, "friction coefficients"),
        ({"slide": 0.9}, "friction coefficients"),
        ({"pattern": Pattern.pillars(12, 2, 1)}, f"{WHAT}, friction coefficients"),
        ({"direction": "y"}, WHAT),
        ({"setup": Setup(step=1e-8)}, WHAT),
        ({"duration": 2e-4}, "duration"),
        ({"snapshot_times": (2e-6,)}, "snapshot_times"),
    ],
)
def test_the_checkpoint_of_another_run_is_refused_and_kept(stopped, change, named):
    file = stopped()
    content = file.read_bytes()
    with pytest.raises(
        ValueError, match=rf"run.npz belongs to a run with other {named}; remove it"
    ):
        pull(checkpoint=file, **change)
    assert file.read_bytes() == content


def test_the_checkpoint_of_other_code_is_refused(stopped, monkeypatch):
    file = stopped()
    other = {"compile": digest("compile")}  # the solver is the same
    monkeypatch.setattr(
        "springblock.simulation.checkpoint.digest", lambda step: other.get(step, "0123")
    )
    with pytest.raises(ValueError, match="belongs to a run with other code; remove it"):
        pull(checkpoint=file)


def test_other_files_are_refused(stopped, tmp_path):
    file = stopped()
    whole = file.read_bytes()
    compute_prelude(PILLARS.contact).save(tmp_path / "prelude.npz")
    prelude = (tmp_path / "prelude.npz").read_bytes()
    for content in (b"", whole[: len(whole) // 2], prelude):
        file.write_bytes(content)
        with pytest.raises(ValueError, match=r"run.npz is not a checkpoint, or damaged"):
            pull(checkpoint=file)


def test_an_edited_file_is_refused(stopped):
    file = stopped()
    with np.load(file) as kept:
        arrays = dict(kept)
    for edited in ({"field_0": 1.5 * arrays["field_0"]}, {"belongs": np.array("[]")}):
        np.savez(file, **arrays | edited)
        with pytest.raises(ValueError, match=r"run.npz is not a checkpoint, or damaged"):
            pull(checkpoint=file)


def test_it_is_written_once_per_interval(monkeypatch, tmp_path):
    kept = Checkpoint(tmp_path / "run.npz", 100.0, {}, written=1000.0)
    for now, due in ((1099.0, False), (1101.0, True)):
        monkeypatch.setattr("springblock.simulation.checkpoint.monotonic", lambda now=now: now)
        assert kept.is_due == due


def test_a_short_run_leaves_nothing_behind(tmp_path):
    pull(checkpoint=tmp_path / "run.npz", checkpoint_interval=3600.0, duration=1e-5)
    assert list(tmp_path.iterdir()) == []
