"""Fields of all blocks at chosen times of a run."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from springblock.model.notebook import Shown, in_words
from springblock.model.numbers import Array

if TYPE_CHECKING:
    import xarray

_ABOUT = {
    "Conventions": "CF-1.11",
    "title": "Fields of a spring-block model of the onset of frictional sliding",
    "references": "https://doi.org/10.1016/j.ijsolstr.2022.111525",
}
_COMMENTS = {
    "stress": "force per l^2: the motive force of a stuck block, the friction force of a sliding "
    "one; missing where the block has no contact",
    "slip": "zero until the first detachment; missing where the block has no contact",
}


class BlockState(IntEnum):
    """State of a block at one instant."""

    FREE = 0  #: not in contact with the substrate
    STUCK = 1  #: in contact and at rest
    SLIDING = 2  #: in contact and moving


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Fields(Shown):
    """Fields of a run in SI units; vectors are (k, 2, N_y, N_x), [time, component, y, x]."""

    time: Array  #: (k,) s
    displacement: Array  #: m, from the position without strain
    velocity: Array  #: m/s
    #: Pa, shear stress of the blocks on the substrate: F_mot/l² of a block at rest, the friction
    #: force over l² of one that slides, along its velocity; 0 without contact.
    stress: Array
    contact: NDArray[np.bool_]  #: (N_y, N_x) blocks in contact with the substrate
    spacing: float  #: l, m

    @property
    def slip(self) -> Array:
        """Distance of blocks in contact from their initial positions, (k, N_y, N_x) m.

        Zero until the first detachment; NaN without contact.
        """
        return np.where(self.contact, _magnitude(self.displacement), np.nan)

    @property
    def shear_stress(self) -> Array:
        """Magnitude of the stress, (k, N_y, N_x) Pa; NaN without contact."""
        return np.where(self.contact, _magnitude(self.stress), np.nan)

    @property
    def state(self) -> NDArray[np.int8]:
        """`BlockState` of each block, (k, N_y, N_x)."""
        moving = self.velocity.any(axis=1)
        in_contact = np.where(moving, BlockState.SLIDING, BlockState.STUCK)
        return np.where(self.contact, in_contact, BlockState.FREE).astype(np.int8)

    def to_xarray(self) -> "xarray.Dataset":
        """Return all fields with coordinates, units and the attributes of the CF conventions.

        Its `to_netcdf(file, engine="scipy")` writes a file that ncdump and ParaView open, too.
        """
        y, x = (self.spacing * (np.arange(n) + 0.5) for n in self.contact.shape)
        vectors = (
            ("displacement", self.displacement, "m", "displacement"),
            ("velocity", self.velocity, "m s-1", "velocity"),
            (
                "stress",
                np.where(self.contact, self.stress, np.nan),
                "Pa",
                "shear stress on the substrate",
            ),
        )
        # without the attribute `axis`: ParaView would take X and Y for longitude and latitude
        every = ("time", "y", "x")
        data = dataset(
            [
                (["time"], "time", self.time, "s", "time since the slider began to move"),
                (["y"], "y", y, "m", "position of the block centre along y, free of strain"),
                (["x"], "x", x, "m", "position of the block centre along x, free of strain"),
                *(
                    (every, f"{name}_{axis}", values[:, i], unit, f"{meaning} along {axis}")
                    for i, axis in enumerate("xy")
                    for name, values, unit, meaning in vectors
                ),
                (
                    every,
                    "slip",
                    self.slip,
                    "m",
                    "distance from the initial position on the substrate",
                ),
                (every, "state", self.state, "1", "state of the block"),
            ]
        ).assign_attrs(_ABOUT)
        for name in data.data_vars:
            if comment := _COMMENTS.get(str(name).partition("_")[0]):
                data[name].attrs["comment"] = comment
        data.state.attrs["flag_values"] = np.array(list(BlockState), np.int8)
        data.state.attrs["flag_meanings"] = " ".join(each.name.lower() for each in BlockState)
        return data

    @classmethod
    def from_xarray(cls, data: "xarray.Dataset") -> "Fields":
        """Return the fields in a dataset of `to_xarray`, to the bit."""
        vectors = {
            name: np.stack([data[f"{name}_{axis}"] for axis in "xy"], axis=1)
            for name in ("displacement", "velocity", "stress")
        }
        contact = data.state.values[0] != BlockState.FREE
        vectors["stress"] = np.where(contact, vectors["stress"], 0.0)
        spacing = 2.0 * float(data.x[0])
        return cls(time=data.time.values, contact=contact, spacing=spacing, **vectors)

    def __repr__(self) -> str:
        return f"<fields at {len(self.time)} times: {in_words(self.contact)}>"


def dataset(variables: Sequence[tuple[Sequence[str], str, Any, str, str]]) -> "xarray.Dataset":
    """Return variables as xarray's `Dataset`: dimensions, name, values, unit and meaning of each.

    Those that have the name of a dimension are coordinates.
    """
    data = import_xarray().Dataset(
        {
            name: (dimensions, values, {"units": unit, "long_name": meaning})
            for dimensions, name, values, unit, meaning in variables
        }
    )
    for coordinate in data.coords.values():
        coordinate.encoding["_FillValue"] = None  # CF: coordinates have no missing values
    return data


def import_xarray() -> Any:
    """Return the module xarray; a ModuleNotFoundError says how to install it."""
    try:
        import xarray
    except ModuleNotFoundError:
        raise ModuleNotFoundError("xarray is missing: pip install xarray") from None
    return xarray


def _magnitude(vectors: Array) -> Array:
    return np.hypot(vectors[:, 0], vectors[:, 1])
