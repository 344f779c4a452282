"""springblock predict: static friction by the theory of a layer."""

import click
import numpy as np

from springblock.cli.options import Read, defaulted, material_options, print_columns
from springblock.model.material import Material
from springblock.theory import predict as theory

_HEADS = ("width (µm)", "static friction", "slipped (µm)", "kappa", "coarsest spacing (µm)")


def _lengths(text: str) -> list[float]:
    """Read A,B,C, or FIRST:LAST:COUNT, spaced evenly by ratio."""
    if ":" not in text:
        return [float(each) for each in text.split(",")]
    first, last, count = text.split(":")
    return [float(each) for each in np.geomspace(float(first), float(last), int(count))]


@click.command("predict")
@defaulted("--shape", type=click.Choice(theory.SHAPES), default="square", help="Pattern.")
@click.option(
    "--widths", type=Read("lengths", _lengths), help="Widths in m: A,B,C or FIRST:LAST:COUNT."
)
@defaulted("--ratio", type=float, default=1.0, help="Width of the gaps over that of the pillars.")
@material_options
def predict(shape: str, widths: list[float] | None, ratio: float, material: Material) -> None:
    """Predict static friction of stripes or square pillars, and the width where it is lowest.

    Under slip weakening without healing, whatever --law says: give --slip-distance.
    Disorder and inertia are left out; docs/continuum.md compares the theory with simulations.
    """
    best = theory.best(material, shape, ratio)
    rows = [*theory.predictions(material, shape, widths or (), ratio), best]
    lines = [
        (
            f"{1e6 * row.width:.4g}",
            f"{row.static_friction:.4f}",
            "" if np.isnan(row.slipped) else f"{1e6 * row.slipped:.3g}",
            f"{row.kappa:.3g}",
            f"{1e6 * row.spacing:.2g}",
        )
        for row in rows
    ]
    print_columns([_HEADS, *lines])
    click.echo("The last line is that of lowest static friction, for widths of 2 to 30 l_z.")
