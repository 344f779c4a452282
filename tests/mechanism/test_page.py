"""The page on the mechanism has the numbers of its tables."""

import pandas as pd
import pytest

from mechanism.chapter import rows, variants
from springblock.mechanism.page import page


@pytest.mark.parametrize(
    "number",
    [
        "20 (or 6)",
        "0.3 % for n_p up to 6",
        "8.3 %",
        "0.30",
        # what all models share from seed to seed leaves no interval of their differences
        "| 6 | -8.3 [-8.3, -8.3] | -8.3 [-8.3, -8.3] | 0.2 [0.2, 0.2] |",
        # on the thin layer the full model is lowest at 20 blocks, and only stress alone is there
        "| l_z = 5 µm | 2, 6, 20 | 6 (0.30) | 20 | 6 | 6 | 20 (or 6) | 16.7 [16.6, 16.7] | -7.1 ",
        "2.4 [2.4, 2.4] %",  # mean of -0.3, -0.2 and 7.7 %
        "0.800 [0.798, 0.802]",
    ],
)
def test_the_page_has_the_numbers_of_its_tables(number):
    assert number in page(pd.DataFrame(rows()), pd.DataFrame(variants()))
