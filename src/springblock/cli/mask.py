"""springblock mask: a contact mask from a measured surface."""

from pathlib import Path
from typing import Any

import click
import numpy as np

from springblock.cli.options import INPUT, Output, defaulted
from springblock.files import whole_file
from springblock.model.blockmap import TRENDS, Cut
from springblock.model.material import Material


@click.command("mask")
@click.argument("topography", type=INPUT)
@click.option("--bearing-area", type=float, help="Share of blocks in contact, the highest ones.")
@click.option("--height", type=float, help="Height that blocks in contact reach, m.")
@defaulted("--spacing", type=float, default=Material().spacing, help="Lattice spacing, m.")
@click.option("--channel", help="Channel of heights.  [default: the reader's]")
@click.option("--detrend", type=click.Choice(list(TRENDS)), help="Trend to subtract first.")
@click.option(
    "--size", type=float, help="Side of the map along x, in the unit of the file, if it has none."
)
@click.option("--unit", help="Unit of the lengths in the file, if it has none: um, nm, ...")
@click.option("--output", type=Output(".npy"), required=True, help="NumPy array (.npy).")
def mask(topography: Path, output: Path, **cut: Any) -> None:
    """Cut a measured TOPOGRAPHY into a contact mask.

    Give --bearing-area or --height. Other commands take the result as --mask.
    """
    contact = Cut(topography, **cut).mask()
    with whole_file(output) as partial, partial.open("wb") as file:
        np.save(file, contact)
    rows, columns = contact.shape
    click.echo(f"{output}: {rows} x {columns} blocks, {contact.mean():.1%} in contact")
