"""Fields of one run as a NetCDF file that follows the CF conventions.

The classic format, with 64-bit offsets: xarray, netCDF4, ncdump and ParaView open it.
"""

from pathlib import Path
from typing import Any

import numpy as np

from springblock.files import whole_file
from springblock.simulation.fields import DIMENSIONS, VARIABLES, BlockState, Fields

_ABOUT = {
    "Conventions": "CF-1.11",
    "title": "Fields of a spring-block model of the onset of frictional sliding",
    "references": "https://doi.org/10.1016/j.ijsolstr.2022.111525",
}
#: Exceptions that scipy raises on a truncated file, one of another format or of impossible sizes.
_UNREADABLE = (AttributeError, LookupError, MemoryError, OSError, TypeError, ValueError)

_COMMENTS = {
    "stress": "force per l^2: the motive force of a stuck block, the friction force of a sliding "
    "one; missing where the block has no contact",
    "slip": "zero until the first detachment; missing where the block has no contact",
}


def write_fields(fields: Fields, path: str | Path, **attributes: object) -> None:
    """Write fields whole or not at all, as a NetCDF file.

    Coordinates and vectors are in SI units; `attributes` describe the run, as numbers or text.

    Raises
    ------
    ValueError
        Where there are no fields, or the file is not of type .nc.
    """
    from scipy.io import netcdf_file  # slow to load

    check_name(Path(path))
    if not len(fields.time):
        raise ValueError("there are no fields to write: the run was given no snapshot_times")
    columns = fields.variables()
    with whole_file(Path(path)) as partial, netcdf_file(partial, "w", version=2) as file:
        for name, value in (_ABOUT | attributes).items():
            if hasattr(file, name):  # scipy's object uses the name
                raise ValueError(f"no attribute of a NetCDF file can be called {name!r}")
            # scipy would store a float in single precision, and text as Latin-1
            stored = np.float64(value) if isinstance(value, float) else str(value).encode()
            setattr(file, name, stored)
        for name in DIMENSIONS:
            file.createDimension(name, len(columns[name]))
        for name, (unit, meaning) in VARIABLES.items():
            placed = (name,) if name in DIMENSIONS else DIMENSIONS
            variable = file.createVariable(name, columns[name].dtype, placed)
            variable[:] = columns[name]
            for key, value in _attributes(name, unit, meaning).items():
                setattr(variable, key, value)


def check_name(path: Path) -> None:
    """Refuse a file whose type is not .nc."""
    if path.suffix != ".nc":
        raise ValueError(f"fields are written to a file of type .nc, not to {path}")


def _attributes(name: str, unit: str, meaning: str) -> dict[str, Any]:
    """Return the attributes of a variable, of the types that CF asks for."""
    known: dict[str, Any] = {"long_name": meaning, "units": unit}
    if name == "state":
        values = np.array([each.value for each in BlockState], np.int8)
        names = " ".join(each.name.lower() for each in BlockState)
        return known | {"flag_values": values, "flag_meanings": names}
    comment = _COMMENTS.get(name.partition("_")[0])
    return known | ({"comment": comment, "_FillValue": np.float64(np.nan)} if comment else {})


def read_fields(path: Path) -> tuple[Fields, dict[str, Any]]:
    """Return the fields in a file of `write_fields`, and its attributes.

    A file that was not written by `write_fields`, or is truncated, is a ValueError.
    """
    from scipy.io import netcdf_file

    try:
        with netcdf_file(path, "r", mmap=False) as file:
            values = {name: np.array(file.variables[name].data, float) for name in VARIABLES}
            attributes = {
                name: value.decode() if isinstance(value, bytes) else value
                for name, value in file._attributes.items()
            }
        vectors = {
            name: np.stack([values[f"{name}_x"], values[f"{name}_y"]], axis=1)
            for name in ("displacement", "velocity", "stress")
        }
        contact = values["state"][0] != BlockState.FREE
        spacing = float(values["x"][0]) * 2.0
    except _UNREADABLE as error:
        raise ValueError(f"{path} holds no fields of springblock, or is cut short") from error
    vectors["stress"] = np.where(contact, vectors["stress"], 0.0)
    return Fields(time=values["time"], contact=contact, spacing=spacing, **vectors), attributes
