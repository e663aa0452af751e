# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads result files of sunload (docs/result-file.md): quantities, facades, civil time."""

import datetime
import fnmatch
import re
import zoneinfo
from dataclasses import dataclass

import h5py
import numpy as np

import bands

# One block of a series that is in memory at a time: values, not bytes.
BLOCK_VALUES = 16_000_000
# More stretches of days than these are told by their number.
MOST_RUNS_NAMED = 4
DATASETS = (h5py.Dataset, bands.MeanOfBands)
COMPONENTS = ("direct", "sky", "mirror", "lamps", "reflected")
SHOWN_UNITS = {"W m-2": "W/m²", "kWh m-2": "kWh/m²", "degree": "°", "1": "", "lx": "lx",
               "klx h": "klx h", "m2": "m²"}


class InputError(Exception):
    """What is wrong, why, and what to try: the user's to mend (exit code 2)."""


@dataclass
class Target:
    """Something that has a time series: a facade, patch or sensor, or all patches together."""

    kind: str             # facade | patch | sensor | scene
    index: int            # in the file; -1: all patches
    name: str
    azimuth_deg: float    # of the outward normal, clockwise from north; NaN: none
    patches: np.ndarray   # indices of its patches (none for sensors)
    area: np.ndarray      # of its patches [m²]

    @property
    def label(self):
        if not np.isfinite(self.azimuth_deg):
            return self.name
        return f"{self.name} (faces {compass(self.azimuth_deg)}, {round(self.azimuth_deg) % 360}°)"


def compass(azimuth_deg):
    """Nearest of the sixteen points of the compass."""
    points = "N NNE NE ENE E ESE SE SSE S SSW SW WSW W WNW NW NNW".split()
    return points[round(azimuth_deg / 22.5) % 16]


def listed(names, most=12):
    names = [str(name) for name in names]
    return ", ".join(names[:most]) + (f", … ({len(names)} in all)" if len(names) > most else "")


def fixed_offset(name):
    """The zone of an offset such as +01:00; None where it is a name."""
    written = re.fullmatch(r"([+-])(\d{1,2})(?::?(\d{2}))?", name)
    if not written:
        return None
    sign, hours, minutes = written.groups()
    offset = datetime.timedelta(hours=int(hours), minutes=int(minutes or 0))
    return datetime.timezone(-offset if sign == "-" else offset, name)


class Result:
    """An open result file; datasets are read when they are asked for."""

    def __init__(self, path):
        self.path = str(path)
        try:
            self.file = bands.broadband(h5py.File(self.path, "r"))
        except OSError as error:
            raise InputError(f"{path}: cannot be read as HDF5 ({error}); "
                             "give a result file of sunload, e.g. results/street/baseline.h5") from error
        form = self.attribute("sunload_format")
        if not form.startswith("sunload-result-"):
            raise InputError(f"{path}: is no result of sunload (attribute sunload_format: '{form}'); "
                             "give a file that `sunload run` has written")
        try:
            self.zone = fixed_offset(self.zone_name) or zoneinfo.ZoneInfo(self.zone_name)
        except zoneinfo.ZoneInfoNotFoundError as error:
            raise InputError(f"{path}: unknown time zone {self.zone_name}; install tzdata") from error

    def attribute(self, name, default=""):
        value = self.file.attrs.get(name, default)
        return value.decode() if isinstance(value, bytes) else value

    @property
    def zone_name(self):
        return self.attribute("timezone") or "UTC"

    @property
    def series_step(self):
        """What rows of series are means over where these are steps: 60 min, day, month; else empty."""
        return self.attribute("series_step")

    @property
    def has_long_steps(self):
        return self.series_step in ("day", "month")

    @property
    def title(self):
        return f"{self.attribute('study') or self.attribute('title')} — {self.attribute('variant')}" \
               + (", mean of the bands" if self.attribute("bands") else "")

    # Datasets.

    def has(self, name):
        return name in self.file

    def need(self, name, why):
        """The dataset, or an error that says what it was wanted for."""
        if name not in self.file:
            raise InputError(f"{self.path}: has no dataset {name} ({why})")
        return self.file[name]

    def numbers(self, name):
        return self.need(name, "every result should have it")[...]

    def names(self, name):
        return [text.decode() for text in self.file[name][...]] if self.has(name) else []

    def dims(self, name):
        dataset = self.file[name]
        return tuple(dim[0].name.rpartition("/")[2] if len(dim) else "" for dim in dataset.dims)

    def units(self, name):
        units = self.file[name].attrs.get("units", "")
        units = units.decode() if isinstance(units, bytes) else units
        return SHOWN_UNITS.get(units, units)

    def caption(self, name):
        """'light load [kWh/m²]'."""
        units = self.units(name)
        return name.replace("_", " ") + (f" [{units}]" if units else "")

    def quantities(self, dims):
        """Numbers with these dimensions that have a unit: what can be drawn."""
        return [name for name, item in self.file.items()
                if isinstance(item, DATASETS) and item.dtype.kind == "f" and len(item.shape) == len(dims)
                and "units" in item.attrs and self.dims(name) == dims]

    @property
    def stored_main_series(self):
        """irradiance, or what stands in its place (illuminance); None where neither is stored."""
        return next((name for name in ("irradiance", "illuminance") if self.has(name)), None)

    def main_series(self):
        """The same, or an error that says how to get it."""
        if self.stored_main_series:
            return self.stored_main_series
        raise InputError(f"{self.path}: has neither the series irradiance nor illuminance; "
                         "name one with --quantity or ask for it in the study's output.series")

    def wanted(self, name, *allowed):
        """Checks that a quantity has one of the dimensions that a picture can draw."""
        if self.has(name) and isinstance(self.file[name], DATASETS) and self.dims(name) in allowed:
            return name
        known = [quantity for dims in allowed for quantity in self.quantities(dims)]
        has = f"has the dimensions {', '.join(self.dims(name))}" if self.has(name) else "is not in the file"
        raise InputError(f"{self.path}: quantity {name} {has}; choose one of {listed(known, 40)}")

    # Time.

    @property
    def is_synthetic(self):
        """Sun positions without dates: `time` only counts."""
        return bool(self.file["time"].attrs.get("time_is_synthetic", 0))

    def bounds(self):
        """Begin and end of the intervals [s since 1970, UTC]."""
        return np.asarray(self.numbers("time_bounds"), dtype=float)

    def hours(self):
        bounds = self.bounds()
        return (bounds[:, 1] - bounds[:, 0]) / 3600

    def civil(self, seconds):
        """Civil time of the site."""
        return datetime.datetime.fromtimestamp(float(seconds), datetime.timezone.utc).astimezone(self.zone)

    def offsets(self):
        """The zone with its offsets in the period: 'Europe/Prague (UTC+01:00, UTC+02:00)'."""
        seconds = np.unique(self.bounds())
        step = max(1, len(seconds) // 400)
        found = sorted({self.civil(s).strftime("%z") for s in np.append(seconds[::step], seconds[-1])})
        return f"{self.zone_name} ({', '.join(f'UTC{o[:3]}:{o[3:]}' for o in found)})"

    def interval_at(self, text):
        """Index of the interval that holds a time as studies write it."""
        try:
            when = datetime.datetime.fromisoformat(text.replace("Z", "+00:00"))
        except ValueError as error:
            raise InputError(f"--time {text}: no time (ISO 8601); write e.g. 2026-06-21T12:00") from error
        when = when if when.tzinfo else when.replace(tzinfo=self.zone)
        bounds, seconds = self.bounds(), when.timestamp()
        held = np.flatnonzero((bounds[:, 0] <= seconds) & (seconds < bounds[:, 1]))
        if len(held) == 0 and seconds == bounds[-1, 1]:
            return len(bounds) - 1
        if len(held) == 0:
            raise InputError(f"{self.path}: no interval holds {text} (the result covers {self.period()}, "
                             "with its gaps); choose a time within")
        return int(held[0])

    def brightest(self):
        """Interval of the largest global irradiance, of those that are there where batches are missing."""
        ghi = np.array(self.numbers("ghi"), dtype=float)
        if "power_sun" in self.file:
            lacking = np.isnan(self.numbers("power_sun")).reshape(len(ghi), -1).any(axis=1)
            if not lacking.all():
                ghi[lacking] = np.nan
        return int(np.nanargmax(ghi))

    def period(self):
        if self.is_synthetic:
            return f"{len(self.bounds())} positions of the sun without dates"
        bounds = self.bounds()
        if np.any(bounds[1:, 0] > bounds[:-1, 1]):
            return f"{self.days()} {self.zone_name}"
        begin, end = (self.civil(s) for s in (bounds.min(), bounds.max()))
        return f"{begin:%Y-%m-%d %H:%M} … {end:%Y-%m-%d %H:%M} {self.zone_name}"

    def days(self):
        """The days that are in the study: '2026-06-21, 2026-12-21', '12 days of 2026-01-21 … 2026-12-21'."""
        bounds = self.bounds()
        days = sorted({self.civil(s).date() for s in np.concatenate((bounds[:, 0], bounds[:, 1] - 1))})
        runs = []
        for day in days:
            if runs and (day - runs[-1][1]).days == 1:
                runs[-1][1] = day
            else:
                runs.append([day, day])
        if len(runs) > MOST_RUNS_NAMED:
            return f"{len(days)} days of {days[0]} … {days[-1]}"
        return ", ".join(f"{first}" if first == last else f"{first} … {last}" for first, last in runs)

    def interval_words(self, index):
        if self.is_synthetic:
            return f"sun at azimuth {self.numbers('sun_azimuth')[index]:.0f}°, " \
                   f"elevation {self.numbers('sun_elevation')[index]:.0f}°"
        begin, end = (self.civil(s) for s in self.bounds()[index])
        if self.has_long_steps:
            return f"mean of {begin:%Y-%m-%d %H:%M} … {end:%Y-%m-%d %H:%M} {self.zone_name}"
        return f"{begin:%Y-%m-%d %H:%M} … {end:%H:%M} {self.zone_name} (UTC{begin:%z})"

    # Facades, patches, sensors.

    def facade(self, index):
        patches = np.flatnonzero(self.numbers("patch_facade") == index)
        return Target("facade", index, self.names("facade_name")[index],
                      float(self.numbers("facade_azimuth")[index]), patches, self.numbers("patch_area")[patches])

    def patch(self, index):
        count = len(self.numbers("patch_area"))
        if not 0 <= index < count:
            raise InputError(f"{self.path}: no patch {index} (they are 0 … {count - 1})")
        facade = int(self.numbers("patch_facade")[index])
        owner = self.names("facade_name")[facade] if facade >= 0 else \
            self.names("object_name")[int(self.numbers("patch_object")[index])]
        azimuth = float(self.numbers("facade_azimuth")[facade]) if facade >= 0 else np.nan
        return Target("patch", index, f"patch {index} of {owner}", azimuth, np.array([index]),
                      self.numbers("patch_area")[[index]])

    def sensor(self, index):
        if not self.has("sensor_position"):
            raise InputError(f"{self.path}: has no sensors (the study has no section sensors)")
        count = len(self.file["sensor_position"])
        if not 0 <= index < count:
            raise InputError(f"{self.path}: no sensor {index} (they are 0 … {count - 1})")
        return Target("sensor", index, f"sensor {index}", np.nan, np.array([], int), np.array([]))

    def scene(self):
        area = self.numbers("patch_area")
        return Target("scene", -1, "all patches", np.nan, np.arange(len(area)), area)

    def facades_named(self, patterns):
        """Indices of the facades that match a name or a pattern such as 'house_3/*'."""
        names, found = self.names("facade_name"), []
        for pattern in patterns:
            matches = [i for i, name in enumerate(names) if fnmatch.fnmatchcase(name, pattern)]
            if not matches:
                raise InputError(f"{self.path}: no facade matches '{pattern}'; there are {listed(names)}")
            found += [i for i in matches if i not in found]
        return found

    def largest_facades(self, most):
        """Indices of the facades with the largest areas, in the order of the file."""
        area = self.numbers("facade_area") if self.has("facade_area") else np.array([])
        return sorted(int(i) for i in np.argsort(-area, kind="stable")[:most])

    def targets(self, facades=(), patches=(), sensors=(), most=4):
        """What the user named; without names the largest facades, or all patches."""
        chosen = [self.facade(i) for i in self.facades_named(facades)]
        chosen += [self.patch(i) for i in patches] + [self.sensor(i) for i in sensors]
        if not chosen:
            chosen = [self.facade(i) for i in self.largest_facades(most)]
        return chosen or [self.scene()]

    # Values.

    def per_patch(self, quantity, interval=None):
        """Values of the patches: of a quantity without time, or of a series at one interval."""
        self.wanted(quantity, ("patch",), ("time", "patch"))
        if self.dims(quantity) == ("patch",):
            return np.asarray(self.file[quantity][...], dtype=float)
        return np.asarray(self.file[quantity][self.brightest() if interval is None else interval], dtype=float)

    def series(self, quantity, targets):
        """Values [time, target]: of patches and sensors, area-weighted means of facades."""
        values = np.full((len(self.numbers("time")), len(targets)), np.nan)
        for k, target in enumerate(targets):
            if target.kind == "sensor":
                name = self.wanted("sensor_" + quantity, ("time", "sensor"))
                values[:, k] = self.file[name][:, target.index]
        of_patches = [k for k, target in enumerate(targets) if target.kind != "sensor"]
        if of_patches:
            values[:, of_patches] = self._patch_series(quantity, [targets[k] for k in of_patches])
        return values

    def parts_of_period(self, kind, total, targets):
        """Stored totals of months, days, … [part, target]: of patches and sensors, area-weighted means of facades.
        `total`: light_load, light_load_direct or sun_hours."""
        return self._of_targets(f"{total}_by_{kind}", targets)

    def errors_of_parts(self, kind, targets):
        """Standard errors of the light load [part, target], from its realizations; nan where there are none."""
        name = f"light_load_by_{kind}_realization"
        if not self.has(name):
            return np.full((len(self.file[kind]), len(targets)), np.nan)
        values = self._of_targets(name, targets)
        return values.std(axis=1, ddof=1) / np.sqrt(values.shape[1])

    def _of_targets(self, name, targets):
        columns = []
        for target in targets:
            if target.kind == "sensor":
                dataset = self.need("sensor_" + name, "of sensors")
                columns.append(dataset[(slice(None),) * (len(dataset.shape) - 1) + (target.index,)])
                continue
            dataset = self.file[name]
            first, last = int(target.patches.min()), int(target.patches.max()) + 1
            values = dataset[(slice(None),) * (len(dataset.shape) - 1) + (slice(first, last),)]
            columns.append(values[..., target.patches - first] @ (target.area / target.area.sum()))
        return np.stack(columns, axis=-1)

    def _patch_series(self, quantity, targets):
        dataset = self.file[self.wanted(quantity, ("time", "patch"))]
        values = np.empty((dataset.shape[0], len(targets)))
        for k, target in enumerate(targets):
            first, last = int(target.patches.min()), int(target.patches.max()) + 1
            weight = np.zeros(last - first)
            weight[target.patches - first] = target.area / target.area.sum()
            # Whole rows of chunks: a chunk is unpacked once.
            deep = dataset.chunks[0] if dataset.chunks else 64
            rows = max(deep, BLOCK_VALUES // (last - first) // deep * deep)
            inside = weight > 0
            for begin in range(0, dataset.shape[0], rows):
                block = dataset[begin:begin + rows, first:last]
                # Only what belongs to the target: a neighbour without a value must not spoil it.
                values[begin:begin + rows, k] = block[:, inside].astype(float) @ weight[inside]
        return values

    def rounding(self, quantity):
        """How far sums of series of patches may be apart that are rounded to some bits
        (output.significant_bits), as a share."""
        bits = self.file[quantity].attrs.get("_QuantizeBitRoundNumberOfSignificantBits") if self.has(quantity) else None
        return 0.0 if bits is None else 2.0 ** -int(bits)

    def components(self, quantity, targets):
        """The series that add up to a quantity, those that the file has for all of the targets."""
        prefixes = {"sensor_" if target.kind == "sensor" else "" for target in targets}
        return [f"{quantity}_{part}" for part in COMPONENTS
                if all(self.has(f"{prefix}{quantity}_{part}") for prefix in prefixes)]
