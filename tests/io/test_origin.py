"""A file of a scene lies where its content says, in whatever part of a study."""

from pathlib import Path

import pytest

from springblock.io.origin import results_of

SCENE = "n_blocks-12/level-0/direction-x"


@pytest.mark.parametrize("part", ["", "beyond/", "more/"])
def test_correlations_of_each_part_belong_to_their_scene(part):
    file = Path("/study/results/correlations", part, SCENE, "correlation.parquet")
    assert results_of(file, f"{SCENE}/correlation.parquet") == Path("/study/results")
    with pytest.raises(ValueError, match="holds what belongs in n_blocks-24"):
        results_of(file, "n_blocks-24/level-0/direction-x/correlation.parquet")


def test_a_file_outside_a_study_belongs_anywhere():
    assert results_of(Path("/elsewhere/run.parquet"), f"{SCENE}/run.parquet") is None
