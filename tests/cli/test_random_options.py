"""Random options, of all magnitudes: each run is made, or refused in one sentence."""

import random
from collections import Counter

import pytest
from click.testing import CliRunner

from springblock import Material, read
from springblock.cli import main

CONSTANTS = [name for name, value in Material().items() if isinstance(value, float)]
#: Without constants that other laws need, which have kernels of their own.
CONSTANTS = [name for name in CONSTANTS if name not in ("slip_distance", "speed_scale")]
OPTIONS = ["--step", "--sample-interval", "--duration", "--snapshot", "--direction"]
COUNTS = ["--n-blocks", "--n-rows", "--n-p", "--n-s", "--first-seed", "--last-seed", "--cores"]
WORDS = ["nan", "inf", "-1", "0", "-0.0", "1e400", "5e-324", "2e-7", str(2**63), "9" * 30, "x", ""]


def number(draw):
    """A number so large or small that no run is merely long, or what is none."""
    large, small = 10.0 ** draw.uniform(5, 308), 10.0 ** draw.uniform(-320, -30)
    return draw.choice([*WORDS, repr(large), repr(small)])


def drawn(draw):
    """One odd option of a short run of few blocks."""
    kind = draw.choice(["constant", "constant", "option", "count"])
    if kind == "constant":
        name = draw.choice(CONSTANTS)
        return name, [draw.choice(["--material", "--vary"]), f"{name}={number(draw)}"]
    name = draw.choice(OPTIONS if kind == "option" else COUNTS)
    value = number(draw) if kind == "option" else draw.choice([*WORDS, "1", "2", "10000000"])
    return name, [name, value]


def naming(name):
    """What one of must be in the sentence that refuses an option."""
    if name in CONSTANTS:  # or what follows from it
        return [name, "--material", "Material.", "step = ", "seed 0: at t = "]
    plain = name.removeprefix("--").replace("-", "_")
    return [name, plain, "N ", "seed"] if name in COUNTS else [name, plain]


@pytest.mark.parametrize("seed", range(2))
def test_random_options_run_or_are_refused_by_name(tmp_path, seed):
    draw, outcomes = random.Random(seed), Counter()
    usual = ["simulate", "--n-blocks", "4", "--duration", "2e-6"]
    for _ in range(75):
        name, words = drawn(draw)
        output = tmp_path / f"{sum(outcomes.values())}.parquet"
        outcome = CliRunner().invoke(main, [*usual, *words, "--output", str(output)])
        assert outcome.exception is None or isinstance(outcome.exception, SystemExit), words
        if outcome.exit_code == 0:
            assert read(output)[0].force.size >= 2, words
            outcomes["run"] += 1
        else:
            sentence = outcome.output.splitlines()[-1]
            assert sentence.startswith("Error: "), words
            assert any(word in sentence for word in naming(name)), (words, sentence)
            assert not output.exists()
            outcomes["refused"] += 1
    assert min(outcomes["run"], outcomes["refused"]) > 10
