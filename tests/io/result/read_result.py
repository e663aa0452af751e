# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a result as its users do; exits 0 where all is as promised."""
import sys

import h5py
import numpy as np
import xarray

path, intervals, patches = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])

with h5py.File(path) as file:
    for name, data in file.items():
        is_scale = data.attrs.get("CLASS") == b"DIMENSION_SCALE"
        for axis in range(0 if is_scale else data.ndim):
            assert len(data.dims[axis]) == 1, f"{name}: axis {axis} has no dimension scale"
        if is_scale and name != "time":
            continue
        assert "long_name" in data.attrs, name
        if data.dtype.kind == "i":
            assert "_FillValue" not in data.attrs, name
        if h5py.check_string_dtype(data.dtype):
            assert h5py.check_string_dtype(data.dtype) == ("utf-8", None), name
        elif data.dtype.kind == "f":
            assert data.attrs["units"], name
    assert file["patch_vertices"].dtype == np.int32
    assert file["time"].dtype == np.float64
    assert file["irradiance"].dtype == np.float32
    assert file["irradiance"].shuffle and file["irradiance"].compression == "gzip"
    assert file["irradiance"].chunks == (min(64, intervals), min(4096, patches))
    assert file["patch_surface"].attrs["flag_meanings"] == "other wall roof ground window floor"
    assert list(file["patch_surface"].attrs["flag_values"]) == list(range(6))
    assert file["study_yaml"][()].decode() == "name: Škola\n"
    assert list(file["vertex_position"].attrs["origin"]) == [1e6, 2e6, 300]
    assert file.attrs["Conventions"] == "CF-1.10 UGRID-1.0"
    assert file.attrs["sunload_format"] == "sunload-result-1"
    assert file.attrs["seed"] == 7
    hours = 0.25 * intervals
    mean = 1000 + (intervals - 1) / 2
    assert np.isclose(file["power_sun"].attrs["time_sum_kwh"], mean * hours / 1000, rtol=1e-12)
    assert file["power_sun"].attrs["time_sum_se_kwh"] == 0.25
    expected = np.arange(intervals)[:, None] + np.arange(patches)[None, :] / np.float32(8192)
    expected[:, ::3] = 0
    assert np.array_equal(file["irradiance"][()], expected.astype(np.float32))

result = xarray.open_dataset(path, engine="h5netcdf")
assert result.irradiance.dims == ("time", "patch")
assert result.irradiance.shape == (intervals, patches)
assert result.time.dtype.kind == "M" and str(result.time.values[0]) == "2026-03-21T00:07:30.000000000"
assert result.time_bounds.dims == ("time", "bounds")
assert result.sun_hours.dtype.kind == "f", "hours must not become a time span"
assert result.object_name.values[0] == "Škola č. 3"
assert result.light_load_realization.dims == ("realization", "patch")
assert result.light_load_realization.attrs["pairing_id"] == "p"
assert result.patch_object.dtype == np.int32
assert result.mesh.attrs["cf_role"] == "mesh_topology"
assert str(result.study_yaml.values) == "name: Škola\n"
assert int(result.irradiance.isnull().sum()) == 0
np.testing.assert_array_equal(result.irradiance.isel(time=1).values[1:3], expected[1, 1:3].astype("f4"))
result.load()
print("read by h5py", h5py.__version__, "and xarray")
