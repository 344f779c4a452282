"""Files of fields, read by other libraries than the one of this project."""

import os

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


def test_units_coordinates_and_numbers_are_as_scipy_reads_them(fields, file):
    with netcdf_file(file, mmap=False) as found:
        assert {name: each.units.decode() for name, each in found.variables.items()} == UNITS
        values = {name: np.array(each.data) for name, each in found.variables.items()}
        described = found.variables["state"]
        assert described.flag_meanings == b"free stuck sliding"
        np.testing.assert_array_equal(described.flag_values, [0, 1, 2])
        assert (found.scene, found.gamma) == ("eight by four, ü ≈ µ".encode(), 5e3)
        assert found.Conventions.startswith(b"CF-")
    np.testing.assert_allclose(values["time"], TIMES, rtol=1e-15)
    np.testing.assert_allclose(values["x"], 1e-5 * (np.arange(8) + 0.5), rtol=1e-15)
    np.testing.assert_allclose(values["y"], 1e-5 * (np.arange(4) + 0.5), rtol=1e-15)
    np.testing.assert_array_equal(values["velocity_y"], fields.velocity[:, 1])
    assert set(np.unique(values["state"])) == {0, 1, 2}
    assert (np.isnan(values["stress_x"]) == (values["state"] == 0)).all()
    moved = np.hypot(values["displacement_x"], values["displacement_y"])
    np.testing.assert_array_equal(values["slip"][:, SURFACE.contact], moved[:, SURFACE.contact])


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


def test_the_same_fields_give_the_same_bytes(fields, file, tmp_path):
    write_fields(fields, tmp_path / "again.nc", scene="eight by four, ü ≈ µ", gamma=5e3)
    assert (tmp_path / "again.nc").read_bytes() == file.read_bytes()


@pytest.mark.parametrize("length", [0, 2, 100, 1000, -1])
def test_a_file_that_is_cut_short_is_refused(file, length):
    content = file.read_bytes()
    file.write_bytes(content[:length])
    with pytest.raises(ValueError, match=r"run.nc holds no fields of springblock, or is cut short"):
        read_fields(file)


def test_so_is_one_of_other_variables(tmp_path):
    with netcdf_file(tmp_path / "run.nc", "w") as other:
        other.createDimension("time", 1)
        other.createVariable("time", "f8", ("time",))[:] = 0.0
    with pytest.raises(ValueError, match="holds no fields of springblock"):
        read_fields(tmp_path / "run.nc")


def test_nothing_is_left_where_there_is_nothing_to_write_or_no_room(fields, tmp_path, monkeypatch):
    without = simulate(Surface(SURFACE.contact, 1.0, 0.6), duration=1e-6).fields
    with pytest.raises(ValueError, match="no fields to write: the run was given no snapshot_times"):
        write_fields(without, tmp_path / "run.nc")
    with pytest.raises(ValueError, match=r"to a file of type .nc, not to .*run.h5"):
        write_fields(fields, tmp_path / "run.h5")

    with pytest.raises(ValueError, match="no attribute of a NetCDF file can be called 'mode'"):
        write_fields(fields, tmp_path / "run.nc", mode="slow")

    def full(*arguments):
        raise OSError(28, os.strerror(28))

    monkeypatch.setattr(netcdf_file, "flush", full)
    with pytest.raises(OSError, match="No space left"):
        write_fields(fields, tmp_path / "run.nc")
    assert list(tmp_path.iterdir()) == []
