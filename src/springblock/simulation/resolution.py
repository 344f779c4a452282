"""Whether friction depends on the lattice, and whether blocks slip only once before the peak."""

import math
from collections.abc import Iterator

import numpy as np

from springblock.model.direction import heading
from springblock.model.material import Material
from springblock.model.surface import Surface
from springblock.simulation.run import Run

#: Least number of blocks in the process zone and in the decay length, from the errors in
#: `docs/continuum.md`.
ZONE, DECAY = 6, 5
#: M/(k l_z²) along the sliding direction and across it, of a layer with the model's K_s, nu = 1/3.
STIFFNESS = {"x": 1.5, "y": 0.5}
#: Laws whose static friction on patterns depends on the lattice, however fine it is.
_WITHOUT_LENGTH = ("coulomb", "velocity_weakening")
#: Switches to sliding per block that has slipped, above which blocks slip more than once.
_SWITCHES = 1.05


def kappa(material: Material, fraction: float) -> float:
    """Return k d_c/Delta, with k = K_s/l² and Delta = (mu_s - mu_d) P/fraction.

    `fraction` is the contact fraction. Infinite without a drop.
    """
    drop = (material.mu_static - material.mu_dynamic) * material.pressure / fraction
    stiffness = material.k_s / material.spacing**2
    return stiffness * material.slip_distance / drop if drop > 0.0 else math.inf


def process_zone(decay: float, kappa: float) -> float:
    """Return the length over which friction falls at a front, in the unit of `decay`.

    (pi/2) lambda/sqrt(1/kappa - 1); without bound from kappa = 1 on.
    """
    return math.pi / 2.0 * decay * math.sqrt(kappa / (1.0 - kappa)) if kappa < 1.0 else math.inf


def coarsest(material: Material, decay: float, fraction: float) -> float:
    """Return the largest spacing, m, that resolves fronts from edges with this lambda, m."""
    return min(process_zone(decay, kappa(material, fraction)) / ZONE, decay / DECAY)


def least_decay(surface: Surface, direction: str | float) -> float:
    """Return the least lambda behind the edges of a surface, over l_z.

    Without edges it is that across the sliding direction: fronts may then run in any direction.
    """
    contact = np.pad(surface.contact, 1, mode="wrap" if surface.periodic else "constant")
    normals = zip((1, 0), heading(direction), strict=True)
    cosines = (abs(cosine) for axis, cosine in normals if np.diff(contact, axis=axis).any())
    along, across = STIFFNESS.values()
    return math.sqrt(across + (along - across) * min(cosines, default=0.0) ** 2)


def lattice(material: Material) -> str:
    """Return a warning that friction of patterned surfaces depends on the lattice, or ""."""
    if material.law not in _WITHOUT_LENGTH:
        return ""
    finest = math.sqrt(STIFFNESS["y"]) * material.thickness / DECAY
    return (
        f"under the law {material.law} static friction of patterned surfaces depends on the "
        "spacing of the lattice; under slip_weakening it converges, from spacing = "
        f"{finest:.2g} m down with thickness = {material.thickness:g} m, or finer where "
        "slip_distance is short; compare spacings with `springblock refine` (docs/continuum.md)"
    )


def doubts(surface: Surface, material: Material, direction: str | float, run: Run) -> Iterator[str]:
    """Yield where slip weakening depends on the lattice or on healing."""
    if material.law != "slip_weakening" or surface.contact.size == 1:  # which has no front
        return
    decay = least_decay(surface, direction) * material.thickness
    finest = coarsest(material, decay, surface.contact.mean())
    if material.spacing > finest * (1.0 + 1e-9):
        yield (
            f"spacing = {material.spacing:g} m does not resolve fronts with slip_distance = "
            f"{material.slip_distance:g} m and thickness = {material.thickness:g} m; choose at "
            f"most {finest:.2g} m (docs/continuum.md)"
        )
    last = int(np.argmax(run.force[run.onset])) + 1
    again = run.switches[:last].sum() > _SWITCHES * run.detachments[:last].sum()
    if again and material.healing == "instant":
        yield (
            f"with gamma = {material.gamma:g} 1/s and slip_distance = {material.slip_distance:g} m "
            "blocks stop, heal and slip again before the force peaks; compare with healing: none"
        )
