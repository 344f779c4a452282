"""Files of fields, read by other libraries than the one of this project."""

import numpy as np
import pytest
import xarray
from scipy.io import netcdf_file

from springblock import Material, Pattern, Setup, Surface, simulate
from springblock.io.fields import read_fields, write_fields

SURFACE = Pattern.flat(8, 4).pillared(2, 2)
TIMES = (1e-6, 2e-6)
VECTORS = {"displacement": "m", "velocity": "m s-1", "stress": "Pa"}
UNITS = {f"{name}_{axis}": unit for name, unit in VECTORS.items() for axis in "xy"}
UNITS |= {"time": "s", "x": "m", "y": "m", "slip": "m", "state": "1"}


@pytest.fixture(scope="module")
def fields():
    """Fields of a surface of 4 rows and 8 columns, some of whose blocks slide at the end."""
    fast = Material(slider_velocity=3e-1)
    pulled = Surface.draw(SURFACE.contact, seed=1)
    return simulate(pulled, Setup(fast), snapshot_times=TIMES, duration=3e-6).fields


@pytest.fixture
def file(fields, tmp_path):
    write_fields(fields, tmp_path / "run.nc", scene="eight by four, ü ≈ µ", gamma=5e3)
    return tmp_path / "run.nc"


def test_xarray_finds_coordinates_and_missing_values(fields, file):
    with xarray.open_dataset(file) as data:
        assert dict(data.sizes) == {"time": 2, "y": 4, "x": 8}
        assert set(data.coords) == {"time", "x", "y"}
        assert {name: data[name].attrs["units"] for name in data.variables} == UNITS
        there = data.velocity_x.sel(x=2.6e-5, y=1.4e-5, time=2e-6, method="nearest")
        assert float(there) == fields.velocity[1, 0, 1, 2]
        assert int(data.slip.count()) == 2 * np.count_nonzero(SURFACE.contact)


def test_fields_are_read_back_to_the_bit(fields, file):
    again, attributes = read_fields(file)
    assert attributes["scene"] == "eight by four, ü ≈ µ"
    for name in ("time", "displacement", "velocity", "stress", "slip", "state", "contact"):
        assert getattr(again, name).tobytes() == getattr(fields, name).tobytes()
    assert again.spacing == fields.spacing


def test_a_file_of_other_variables_is_refused(tmp_path):
    with netcdf_file(tmp_path / "run.nc", "w") as other:
        other.createDimension("time", 1)
        other.createVariable("time", "f8", ("time",))[:] = 0.0
    with pytest.raises(ValueError, match="holds no fields of springblock"):
        read_fields(tmp_path / "run.nc")


def test_what_cannot_be_written_is_refused(fields, tmp_path):
    without = simulate(Surface(SURFACE.contact, 1.0, 0.6), duration=1e-6).fields
    for some, name, more, sentence in (
        (without, "run.nc", {}, "no fields to write"),
        (fields, "run.h5", {}, "to a file of type .nc"),
        (fields, "run.nc", {"mode": "slow"}, "no attribute of a NetCDF file can be called 'mode'"),
    ):
        with pytest.raises(ValueError, match=sentence):
            write_fields(some, tmp_path / name, **more)
    assert list(tmp_path.iterdir()) == []
