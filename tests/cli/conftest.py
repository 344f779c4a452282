"""Batches of small surfaces for the command line to work on."""

import pytest


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
