"""springblock mask: a contact mask from a measured surface."""

from pathlib import Path

import click
import numpy as np

from springblock.cli.options import INPUT, OUTPUT, one_sentence
from springblock.files import whole_file
from springblock.model.blockmap import Cut
from springblock.model.material import Material


@click.command("mask")
@click.argument("topography", type=INPUT)
@click.option(
    "--bearing-area", type=float, help="Share of the blocks in contact, the highest ones."
)
@click.option("--height", type=float, help="Height from which on blocks are in contact, m.")
@click.option(
    "--spacing", type=float, default=Material().spacing, show_default=True, help="Of blocks, m."
)
@click.option("--output", type=OUTPUT, required=True, help="Array of NumPy (.npy).")
def mask(
    topography: Path, bearing_area: float | None, height: float | None, spacing: float, output: Path
) -> None:
    """Cut TOPOGRAPHY at a bearing area or height, and write the contact mask, for --mask."""
    with one_sentence():
        contact = Cut(topography, spacing, bearing_area, height).mask()
        with whole_file(output) as partial, partial.open("wb") as file:
            np.save(file, contact)
        rows, columns = contact.shape
        click.echo(f"{output}: {rows} x {columns} blocks, {contact.mean():.1%} in contact")
