"""Files of fields, written and read by xarray."""

import numpy as np
import pytest
import xarray

from springblock import Material, Pattern, Setup, Surface, simulate
from springblock.simulation.fields import BlockState, Fields

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
    data = fields.to_xarray().assign_attrs(scene="eight by four, ü ≈ µ", gamma=5e3)
    data.to_netcdf(tmp_path / "run.nc", engine="scipy")
    return tmp_path / "run.nc"


def test_coordinates_units_and_missing_values_are_in_the_file(fields, file):
    with xarray.open_dataset(file) as data:
        assert (data.attrs["Conventions"], data.attrs["gamma"]) == ("CF-1.11", 5e3)
        assert data.state.attrs["flag_meanings"].split() == ["free", "stuck", "sliding"]
        assert list(data.state.attrs["flag_values"]) == list(BlockState)
        assert "missing where the block has no contact" in data.stress_x.attrs["comment"]
        assert dict(data.sizes) == {"time": 2, "y": 4, "x": 8}
        assert set(data.coords) == {"time", "x", "y"}
        assert {name: data[name].attrs["units"] for name in data.variables} == UNITS
        assert data.stress_x.dims == ("time", "y", "x")
        there = data.sel(x=2.6e-5, y=1.4e-5, time=2e-6, method="nearest")
        for name in VECTORS:
            found = [float(there[f"{name}_{axis}"]) for axis in "xy"]
            assert found == getattr(fields, name)[1, :, 1, 2].tolist()
        assert int(data.slip.count()) == 2 * np.count_nonzero(SURFACE.contact)


def test_fields_are_read_back_to_the_bit(fields, file):
    with xarray.open_dataset(file) as data:
        again = Fields.from_xarray(data)
    assert data.attrs["scene"] == "eight by four, ü ≈ µ"
    for name in ("time", "displacement", "velocity", "stress", "slip", "state", "contact"):
        assert getattr(again, name).tobytes() == getattr(fields, name).tobytes()
    assert again.spacing == fields.spacing
