# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results as xarray, with names as coordinates and the accessor `.sunload`."""

from __future__ import annotations

import builtins
import json
import os
import warnings
from typing import Any, Optional, Sequence, Union

import numpy as np
import pandas
import xarray

from . import program
from .checks import nearest

ROWS_AT_ONCE = 256  # as many as a chunk of a series has


def _zone(result: xarray.Dataset) -> str:
    zone = result.attrs.get("timezone") or "UTC"
    return "UTC" if zone == "Z" else zone


def open(path: Union[str, os.PathLike]) -> xarray.Dataset:  # pylint: disable=redefined-builtin
    """A result file (docs/result-file.md), read as it is asked for. Beside what the file has, patches have the
    coordinates `object_of`, `facade_of`, `material_of`, `surface_of`: names, '' for none. Raises InputError where the
    file is no result."""
    path = os.path.abspath(os.fspath(path))
    try:
        with warnings.catch_warnings():  # of NaN among times, which are NaT then: measures without any sun
            warnings.filterwarnings("ignore", "invalid value encountered in cast", RuntimeWarning)
            result = xarray.open_dataset(path, engine="h5netcdf", decode_timedelta=False)
    except (OSError, ValueError) as error:
        raise _no_result(path, _why_unreadable(path)) from error
    if not str(result.attrs.get("sunload_format", "")).startswith("sunload-result-"):
        result.close()
        raise _no_result(path, "is no result of sunload")
    names = {"object_of": ("patch_object", "object"), "facade_of": ("patch_facade", "facade"),
             "material_of": ("patch_material", "material")}
    coordinates = {}
    for name, (index, axis) in names.items():
        if index in result and axis in result:
            coordinates[name] = ("patch", _named(result[index].values, result[axis].values))
    if "patch_surface" in result:
        surface = result["patch_surface"]
        words = np.array(str(surface.attrs["flag_meanings"]).split(), dtype=object)
        values = np.asarray(surface.attrs["flag_values"])
        order = np.argsort(values)
        place = order[np.searchsorted(values[order], surface.values.astype(int))]
        coordinates["surface_of"] = ("patch", words[place])
    result = result.assign_coords(coordinates)
    result.encoding.update(source=path, sizes=dict(result.sizes))
    return result


def _no_result(path: str, what: str) -> program.InputError:
    return program.InputError(f"{path}: {what}; name a file that `sunload run` has written", 2)


def _why_unreadable(path: str) -> str:
    """In the system's words where it does not let the file be read; those of HDF5 tell of its own."""
    try:
        with builtins.open(path, "rb") as file:
            is_hdf5 = file.read(8) == b"\x89HDF\r\n\x1a\n"
    except OSError as error:
        return f"cannot be read ({error.strerror})"
    return "is no result of sunload, or a damaged one" if is_hdf5 else "is no result of sunload"


def _rows(text: str) -> pandas.DataFrame:
    """The rows of a listing in JSON, which keeps names as they are; what is not known is NaN."""
    rows = json.loads(text)["rows"]
    table = pandas.DataFrame(rows, columns=list(dict.fromkeys(key for row in rows for key in row)))
    words = {"group", "name", "verdict"}
    numbers = [column for column in table.columns if column not in words and table[column].dtype == object]
    for column in numbers:
        if not table[column].map(lambda value: isinstance(value, (str, bool))).any():
            table[column] = table[column].astype(float)
    return table


def _named(index: np.ndarray, names: np.ndarray) -> np.ndarray:
    """Names by index; '' for -1."""
    return np.append(names.astype(object), "")[index.astype(int)]


@xarray.register_dataset_accessor("sunload")
class Accessor:
    """What people do with results."""

    def __init__(self, result: xarray.Dataset):
        self._result = result

    @property
    def path(self) -> str:
        """Of the file that the result was opened from. Raises ValueError where it was computed otherwise."""
        path = self._result.encoding.get("source")
        if not path:
            raise ValueError("this dataset was not opened by sunload.open")
        return path

    def _whole(self) -> str:
        """The same, for what is asked of the program. Raises ValueError where a part was chosen since: it would answer
        for all that is in the file."""
        path, sizes = self.path, self._result.encoding.get("sizes", {})
        cut = [dim for dim in ("patch", "time") if dim in sizes and self._result.sizes.get(dim) != sizes[dim]]
        if cut:
            raise ValueError(f"this dataset is a part ({', '.join(cut)}) of {path}, which the program reads as a whole; "
                             "take what sunload.open gave")
        return path

    def facades(self) -> pandas.DataFrame:
        """Facades by name: azimuth_deg, area_m2, light_load_kwh_m2 and its standard error, … (docs/tables.md)."""
        return self._group_table("facades").set_index("name")

    def objects(self) -> pandas.DataFrame:
        """The same of objects."""
        return self._group_table("objects").set_index("name")

    def _group_table(self, table: str) -> pandas.DataFrame:
        return _rows(program.run(["info", self._whole(), "--" + table, "--json"]))

    def mean(self, quantity: str = "light_load", **by: Union[str, Sequence[str]]) -> xarray.DataArray:
        """Area-weighted mean over patches, for instance mean("irradiance", surface_of="wall"), or of several kinds:
        surface_of=["wall", "roof"]. Patches that light cannot reach (patch_covered) do not count. Raises ValueError where
        no patch is left, for a value that no patch has, and for what the result does not have of its patches: those of
        `sunload.solve` have no objects, facades and kinds of surface, but `material_of`."""
        result = self._result
        chosen = np.ones(result.sizes["patch"], dtype=bool)
        if "patch_covered" in result:
            chosen &= result["patch_covered"].values == 0
        for name, value in by.items():
            chosen &= self._chosen(name, value)
        if not chosen.any():
            raise ValueError(f"no patch with {by}")
        values, kept = self._of_patches(quantity), np.flatnonzero(chosen)
        area = result["patch_area"].isel(patch=kept)

        def mean_of(rows: xarray.DataArray) -> xarray.DataArray:
            return rows.load().isel(patch=kept).weighted(area).mean("patch", keep_attrs=True)

        rows = values.dims[0]
        if rows == "patch" or values.sizes[rows] <= ROWS_AT_ONCE:
            return mean_of(values.copy(deep=False))
        # A year of a city does not fit into memory.
        return xarray.concat([mean_of(values.isel({rows: slice(first, first + ROWS_AT_ONCE)}))
                              for first in range(0, values.sizes[rows], ROWS_AT_ONCE)], rows)

    def _chosen(self, name: str, value: Union[str, Sequence[str]]) -> np.ndarray:
        """Patches that have one of the values. Raises ValueError for a value that none has."""
        values, asked = self._of_patches(name).values, [value] if np.isscalar(value) else list(value)
        chosen = np.zeros(len(values), dtype=bool)
        for one in asked:
            has = values == one
            if not has.any():
                known = sorted({str(word) for word in values if str(word)})
                few = ", ".join(known[:8]) + (", …" if len(known) > 8 else "")
                raise ValueError(f"no patch with {name} {one!r}; {nearest(str(one), known) or 'there are ' + few}")
            chosen |= has
        return chosen

    def _of_patches(self, name: str) -> xarray.DataArray:
        result = self._result
        if name in result and "patch" in result[name].dims:
            return result[name]
        known = sorted(str(key) for key in result.variables if "patch" in result[key].dims and not str(key).endswith("_of"))
        hint = nearest(name, known) or "there are " + ", ".join(known)
        if name in ("object_of", "facade_of", "surface_of"):
            hint = "a mesh given to sunload.solve has materials alone: name them, and choose by material_of"
        raise ValueError(f"{name}: the result has no such values of its patches; {hint}")

    def months(self, quantity: str = "light_load") -> xarray.DataArray:
        """Totals of months per facade (area-weighted means of patches), dims (month, facade), of a result in bands (month,
        band, facade). Raises ValueError where the result has no such totals: a study of several months has them, or
        output.totals: [month]; one of sun positions without dates cannot."""
        result, name = self._result, quantity + "_by_month"
        if name not in result:
            known = sorted(str(key)[:-len("_by_month")] for key in result
                           if str(key).endswith("_by_month") and "patch" in result[key].dims)
            raise ValueError(f"{self.path}: has no {name}; " + (
                "its suns have no dates (period.positions)" if result.attrs.get("time_is_synthetic", 0) else
                "months have " + ", ".join(known) if known else "write output: {totals: [month]} and run it again"))
        facade, area = result["patch_facade"].values.astype(int), result["patch_area"].values
        values, count = result[name].values, result.sizes["facade"]
        counts = facade >= 0
        weight = np.bincount(facade[counts], area[counts], count)
        with np.errstate(invalid="ignore"):
            sums = np.apply_along_axis(lambda row: np.bincount(facade[counts], (row * area)[counts], count) / weight, -1,
                                       values)
        dims = (*result[name].dims[:-1], "facade")
        return xarray.DataArray(sums, dims=dims, name=name, attrs=dict(result[name].attrs),
                                coords={dim: result[dim].values for dim in dims})

    def compare(self, other: Union[xarray.Dataset, str, os.PathLike], quantity: str = "light_load") -> pandas.DataFrame:
        """Differences of `other` to this result per facade, object and surface, of the light load with errors and
        significance: the rows of `sunload compare --json` (docs/variants.md), which beside those of
        `--csv` have degrees_of_freedom and mesh_error_kwh_m2."""
        path = other.sunload._whole() if isinstance(other, xarray.Dataset) else os.fspath(other)
        return _rows(program.run(["compare", self._whole(), path, "--quantity", quantity, "--json"]))

    def _interval_at(self, time: Any) -> int:
        """The interval that holds a time in UTC."""
        bounds, when = self._result["time_bounds"].values, pandas.Timestamp(getattr(time, "values", time)).to_datetime64()
        held = np.flatnonzero((bounds[:, 0] <= when) & (when < bounds[:, 1]))
        if not len(held) and when == bounds[-1, 1]:
            return len(bounds) - 1
        if not len(held):
            raise ValueError(f"{when} (UTC) is in no interval of the result: it has {bounds.min()} ... {bounds.max()}")
        return int(held[0])

    def _brightest(self) -> int:
        """The interval of the largest global irradiance, of those that are there where batches are missing."""
        ghi = self._result["ghi"].values.astype(float)
        if "power_sun" in self._result:
            lacking = np.isnan(self._result["power_sun"].values).reshape(len(ghi), -1).any(axis=1)
            ghi = ghi if lacking.all() else np.where(lacking, np.nan, ghi)
        return int(np.nanargmax(ghi))

    def _when(self, time: Any) -> str:
        """An interval's instant in civil time of the site; of steps that are means of many intervals begin and end."""
        result = self._result

        def civil(at: Any) -> str:
            return f"{pandas.Timestamp(at).tz_localize('UTC').tz_convert(_zone(result)).floor('s'):%Y-%m-%d %H:%M:%S%z}"
        if not result.attrs.get("series_step"):
            return civil(time)
        return " … ".join(civil(at) for at in result["time_bounds"].sel(time=time).values)

    def plot_map(self, quantity: str = "light_load", time: Optional[Any] = None, ax: Optional[Any] = None,
                 **options: Any) -> Any:
        """A map of what is seen from above, higher patches over lower ones, by matplotlib; returns its axes. `time`: of
        a series, in UTC as all times of the dataset: the interval that holds it, the brightest where left out; the title
        tells it in civil time of the site. Of light in bands the mean of these. `ax`: the current axes while they are
        empty, else new ones. Options go to PolyCollection. Raises ValueError for a time in no interval, and for one of a
        total."""
        from matplotlib import pyplot  # needed here alone
        from matplotlib.collections import PolyCollection
        result = self._result
        values = self._of_patches(quantity)
        if "time" in values.dims:
            values = values.isel(time=self._brightest() if time is None else self._interval_at(time))
        elif time is not None:
            raise ValueError(f"{quantity} is of the whole period: it has no time")
        if "band" in values.dims:
            values = values.mean("band", keep_attrs=True)
        if values.dims != ("patch",):
            raise ValueError(f"{quantity} has the dimensions {values.dims}; a map is of patches")
        corners = result["vertex_position"].values[result["patch_vertices"].values.astype(int)]
        seen = np.flatnonzero(result["patch_normal"].values[:, 2] > 1e-6)
        seen = seen[np.argsort(corners[seen, :, 2].max(axis=1), kind="stable")]
        if ax is None:
            ax = pyplot.gca()
            if ax.has_data():
                ax = pyplot.figure().add_subplot()
        drawn = ax.add_collection(PolyCollection(corners[seen][:, :, :2], array=values.values[seen],
                                                 **{"cmap": "inferno", "edgecolors": "face", **options}))
        ax.set_aspect("equal")
        ax.autoscale_view()
        ax.set_xlabel("x [m]")
        ax.set_ylabel("y [m]")
        if "time" in values.coords and not result.attrs.get("time_is_synthetic", 0):
            ax.set_title(self._when(values["time"].values))
        units = values.attrs.get("units", "")
        ax.figure.colorbar(drawn, ax=ax, label=f"{quantity} [{units}]" if units else quantity)
        return ax
