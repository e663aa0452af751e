# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A result file in memory, one band at a time."""

import h5py
import numpy as np


def dimensions(data):
    """Names of the axes of a dataset; of a scale its own."""
    if data.ndim == 1 and h5py.h5ds.is_scale(data.id):
        return (data.name.lstrip("/"),)
    return tuple(data.dims[k][0].name.lstrip("/") if len(data.dims[k]) else "" for k in range(data.ndim))


class Result:
    """Datasets by name, as doubles where they are numbers; of a result in bands those of one band.

    Names of illuminance are those of irradiance here: `irradiance_sky` is what the file calls so or
    `illuminance_sky`. Of attributes of datasets there are those of sums over time.
    """

    def __init__(self, data, dims, attributes, of_data, band):
        self.data, self.dims, self.attributes, self.of_data, self.band = data, dims, attributes, of_data, band

    def __contains__(self, name):
        return name in self.data

    def __getitem__(self, name):
        return self.data[name]

    def get(self, name, otherwise=None):
        return self.data.get(name, otherwise)

    @property
    def shoots(self):
        return self.attributes["transport"] == "shoot"

    @property
    def realizations(self):
        return int(self.attributes["realizations"])

    @property
    def lengths_s(self):
        return self["time_bounds"][:, 1] - self["time_bounds"][:, 0]

    @property
    def falls_in(self):
        """Direct normal, diffuse horizontal, global horizontal light."""
        if "direct_normal_illuminance" in self:
            return [self[f"{name}_illuminance"] for name in ("direct_normal", "diffuse_horizontal", "global_horizontal")]
        return [self[name] for name in ("dni", "dhi", "ghi")]

    def names(self, *beginnings):
        return sorted(name for name in self.data if name.startswith(beginnings))


def without_band(array, dims, band):
    return (array.take(band, axis=dims.index("band")), tuple(d for d in dims if d != "band")) if "band" in dims else (array, dims)


def read_result(path):
    """A list: the result, or one of each band."""
    data, dims, of_data = {}, {}, {}
    with h5py.File(path, "r") as file:
        attributes = dict(file.attrs)
        for name, item in file.items():
            values = item[()]
            if isinstance(values, np.ndarray) and values.dtype.kind == "f":
                values = values.astype(np.float64)
            our = name.replace("illuminance", "irradiance") if not name.endswith("l_illuminance") else name
            data[our], dims[our] = values, dimensions(item)
            of_data[our] = {key: value for key, value in item.attrs.items() if key.startswith("time_sum")}
    bands = [b.decode() if isinstance(b, bytes) else b for b in data["band"]] if "band" in data else [""]
    results = []
    for k, band in enumerate(bands):
        own = {name: without_band(values, dims[name], k) for name, values in data.items() if name != "band"}
        attributes_of = {name: {key: value[k] if band and np.shape(value) == (len(bands),) else value
                                for key, value in own_attributes.items()} for name, own_attributes in of_data.items()}
        results.append(Result({n: v for n, (v, _) in own.items()}, {n: d for n, (_, d) in own.items()},
                              attributes, attributes_of, band))
    return results
