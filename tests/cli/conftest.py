"""The command line as a function, and batches of small surfaces for it to work on."""

import pytest
from click.testing import CliRunner

from springblock.cli import main


@pytest.fixture(scope="session")
def springblock():
    """Call `springblock` with these words; return what it says, or its refusal of bad input."""

    def call(*words, refused=False):
        outcome = CliRunner().invoke(main, [str(word) for word in words])
        assert (outcome.exit_code != 0) == refused, outcome.output
        assert outcome.exception is None or isinstance(outcome.exception, SystemExit)
        return outcome.output.splitlines()[-1] if refused else outcome.output

    return call


@pytest.fixture(scope="session")
def batch(springblock, tmp_path_factory):
    """Write a batch of realisations, and return its file."""
    folder = tmp_path_factory.mktemp("batches")

    def simulated(first, last, *scene):
        file = folder / f"{first}-{last}{'-'.join(map(str, scene))}.parquet"
        if not file.exists():
            seeds = ["--first-seed", first, "--last-seed", last]
            springblock("simulate", "--n-blocks", 12, *scene, *seeds, "--output", file)
        return file

    return simulated


@pytest.fixture(scope="session")
def pillars(batch):
    """Two batches of one scene whose pillars have sides."""
    scene = ("--n-p", 6, "--n-s", 6)
    return batch(0, 1, *scene), batch(2, 2, *scene)
