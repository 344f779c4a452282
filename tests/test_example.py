"""The example of one's own surface: planned as it is, and from end to end with another mask."""

import shutil
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
import yaml
from PIL import Image

from springblock.surfaces import BlockMap
from springblock.tables import read_records
from test_workflow import TINY, planned, snakemake

ROOT = Path(__file__).parents[1]
ISLANDS = "config/examples/islands.yaml"
