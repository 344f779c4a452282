"""springblock mask: a contact mask from a measured surface."""

from pathlib import Path
from typing import Any

import click
import numpy as np

from springblock.cli.options import INPUT, OUTPUT, defaulted
from springblock.files import whole_file
from springblock.model.blockmap import TRENDS, Cut
from springblock.model.material import Material


@click.command("mask")
@click.argument("topography", type=INPUT)
@click.option(
    "--bearing-area", type=float, help="Share of the blocks in contact, the highest ones."
)
@click.option("--height", type=float, help="Height from which on blocks are in contact, m.")
@defaulted("--spacing", type=float, default=Material().spacing, help="Of blocks, m.")
@click.option("--channel", help="Name of the channel of heights.  [default: the reader's]")
@click.option(
    "--detrend", type=click.Choice(list(TRENDS)), help="Trend to subtract before the cut."
)
@click.option("--output", type=OUTPUT, required=True, help="Array of NumPy (.npy).")
def mask(topography: Path, output: Path, **cut: Any) -> None:
    """Cut TOPOGRAPHY at a bearing area or height, and write the contact mask, for --mask."""
    contact = Cut(topography, **cut).mask()
    with whole_file(output) as partial, partial.open("wb") as file:
        np.save(file, contact)
    rows, columns = contact.shape
    click.echo(f"{output}: {rows} x {columns} blocks, {contact.mean():.1%} in contact")
