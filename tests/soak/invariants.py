# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What must hold of every result, whatever the study.

Each function takes a result (of one band) and yields what is wrong with it, in words. `EVERY` lists
them; planted_faults.py breaks each of them.
"""

import math

import numpy as np

import student

PARTS = ("direct", "sky", "mirror", "lamps", "reflected")
IN, OUT = ("sun", "sky", "ground", "emitted"), ("absorbed", "transmitted", "escaped", "unshot")
# A float has 24 bits: what a stored value of a series may be off by, relative.
FLOAT = 2.0 ** -24
# Floats next to 0 are so far apart: at dusk some values have no digits left. Of two of them.
DUSK = 2 * 2.0 ** -149
# Sums in double over patches and intervals, 10^6 terms at the most.
DOUBLE = 1e-10
# A value of a series is made of some hundred float terms (docs/developer/design.md, Tests).
SERIES = 1e-5
J_PER_KWH = 3.6e6
# Of all ledgers of a soak together: how often one may be told off that is right.
FALSE_ALARMS = 1e-3


def differs(name, found, wanted, allowed):
    """Yields where |found − wanted| is above `allowed` (and what floats next to 0 are apart); NaN is."""
    found, wanted, allowed = np.broadcast_arrays(found, wanted, allowed + DUSK)
    wrong = ~(np.abs(found - wanted) <= allowed)
    if wrong.any():
        at = tuple(int(i) for i in np.argwhere(wrong)[0])
        yield (f"{name}{list(at) if at else ''} is {found[at]!r}, not {wanted[at]!r} "
               f"(allowed {allowed[at]:.3g}; {int(wrong.sum())} of {wrong.size})")


def finite_and_not_negative(r):
    """Light, energy, errors and geometry are numbers; only residuals may be below 0."""
    powers = sum(np.abs(r[f"power_{term}"]) for term in IN) if "power_sun" in r else 0
    for name, values in r.data.items():
        if not isinstance(values, (np.ndarray, np.floating)) or np.asarray(values).dtype.kind != "f":
            continue
        if not np.isfinite(values).all():
            yield f"{name} is not finite at {np.argwhere(~np.isfinite(np.atleast_1d(values)))[0]}"
        of_light = name.startswith(("irradiance", "light_load", "facade_irradiance", "facade_light", "sensor_irradiance",
                                    "sensor_light", "power_", "sun_hours", "sensor_sun_hours", "patch_area", "facade_area",
                                    "dni", "dhi", "ghi")) and name != "power_residual"
        # What is not followed is a difference of two solutions: in floats, or each with noise of its own.
        if name == "power_unshot" and r.shoots:
            continue
        least = -FLOAT * powers if name.startswith("power_") and not name.endswith(("_se", "_load")) else 0
        if of_light and (np.asarray(values) < least).any():
            yield f"{name} is {np.min(values)!r}"


def parts_make_the_whole(r):
    """Of series and loads, of patches and sensors; series where all parts are stored."""
    for prefix in ("", "sensor_"):
        for stem, of_parts in ((f"{prefix}irradiance", FLOAT), (f"{prefix}light_load", FLOAT)):
            total = r.get(stem)
            parts = [part for part in PARTS if f"{prefix}light_load_{part}" in r]
            if total is None or not parts or any(f"{stem}_{part}" not in r for part in parts):
                continue
            whole = sum(r[f"{stem}_{part}"] for part in parts)
            # Every addition rounds, and so does storing every part.
            yield from differs(f"{stem}, against its parts,", total, whole, 2 * (len(parts) + 1) * of_parts * whole)


def loads_are_time_sums(r):
    """Of the series that are stored, as floats."""
    for name in r.names("irradiance", "sensor_irradiance", "facade_irradiance"):
        load = name.replace("irradiance", "light_load")
        if name.endswith(("_se", "_max")) or load not in r:
            continue
        sums = np.tensordot(r.lengths_s, r[name], axes=(0, 0)) / J_PER_KWH
        yield from differs(load, r[load], sums, (2 * FLOAT + DOUBLE) * sums)


def maximum_is_of_the_series(r):
    for prefix in ("", "sensor_"):
        if f"{prefix}irradiance" in r and f"{prefix}irradiance_max" in r:
            yield from differs(f"{prefix}irradiance_max", r[f"{prefix}irradiance_max"], r[f"{prefix}irradiance"].max(axis=0), 0)


def dark_is_dark(r):
    """No direct light without sun; nothing at all where nothing falls in and nothing shines by itself."""
    dni, dhi, ghi = r.falls_in
    dark = (dni == 0) & (dhi == 0) & (ghi == 0)
    shines = "irradiance_lamps" in r or "light_load_lamps" in r or (r["power_emitted"] > 0).any()
    for name in r.names("irradiance", "sensor_irradiance", "facade_irradiance"):
        if r.dims[name][0] != "time":
            continue
        if not shines and r[name][dark].any():
            yield f"{name} is {r[name][dark].max()!r} in the dark"
        if name.endswith("_direct") and r[name][dni == 0].any():
            yield f"{name} is {r[name][dni == 0].max()!r} without sun"
    if (r["dni"][r["sun_elevation"] < 0] > 0).any():
        yield "there is direct light from below the horizon"


def no_brighter_than_the_sun(r):
    """Direct light is DNI times a cosine."""
    dni = r.falls_in[0]
    # In bands the sun has the colour that its elevation gives it, up to three times the mean in one.
    most = dni * (3 if r.band else 1)
    for name in ("irradiance_direct", "sensor_irradiance_direct"):
        if name in r and (r[name] > most[:, None] * (1 + 4 * FLOAT)).any():
            yield f"{name} is up to {(r[name] / np.maximum(most[:, None], 1e-300)).max()!r} of the DNI"


def shares_are_shares(r):
    """Of the sky, and of the hours of the period."""
    for name in ("sky_view_factor", "sensor_sky_view_factor"):
        if name in r and ((r[name] < 0) | (r[name] > 1 + SERIES)).any():
            yield f"{name} is between {r[name].min()!r} and {r[name].max()!r}"
    hours = r.lengths_s.sum() / 3600
    for name in ("sun_hours", "sensor_sun_hours"):
        if name in r and (r[name] > hours * (1 + DOUBLE)).any():
            yield f"{name} is up to {r[name].max()!r} h in {hours} h"


def facades_are_means(r):
    """Area-weighted, of their patches."""
    count = len(r.get("facade_name", []))
    if not count:
        return
    facade, area = r["patch_facade"], r["patch_area"]
    inside = facade >= 0
    sums = lambda values: np.stack([np.bincount(facade[inside], (row * area)[inside], count) for row in np.atleast_2d(values)])
    areas = sums(np.ones_like(area))[0]
    yield from differs("facade_area", r["facade_area"], areas, DOUBLE * areas)
    for of_facade, of_patch, rounding in (("facade_light_load", "light_load", DOUBLE), ("facade_irradiance", "irradiance", 2 * FLOAT),
                                          ("facade_light_load_realization", "light_load_realization", DOUBLE)):
        if of_facade in r and of_patch in r:
            means = sums(r[of_patch]) / areas
            means = means[0] if r[of_facade].ndim == 1 else means
            yield from differs(of_facade, r[of_facade], means, rounding * np.abs(means))


def errors_are_of_realizations(r):
    """s/√R; and where power is shot the result is the mean of its realizations."""
    for prefix in ("", "facade_", "sensor_"):
        name = f"{prefix}light_load"
        if f"{name}_realization" not in r:
            continue
        rows = r[f"{name}_realization"]
        if len(rows) != r.realizations:
            yield f"{name}_realization has {len(rows)} rows, not {r.realizations}"
            continue
        mean = rows.mean(axis=0)
        if f"{name}_se" in r:
            error = rows.std(axis=0, ddof=1) / math.sqrt(r.realizations)
            yield from differs(f"{name}_se", r[f"{name}_se"], error, 1e-6 * error + DOUBLE * mean)
        if r.shoots and name in r:
            yield from differs(f"{name}, against its realizations,", r[name], mean, SERIES * mean)


def ledger_adds_up(r):
    """The residual is in − out, sums over time are those of the rows."""
    if "power_sun" not in r:
        return
    came = sum(r[f"power_{term}"] for term in IN)
    residual = came - sum(r[f"power_{term}"] for term in OUT)
    yield from differs("power_residual", r["power_residual"], residual, DOUBLE * came)
    for name in r.names("power_"):
        attributes = r.of_data[name]
        for key in ("time_sum_kwh", "time_sum_klm_h"):
            if key in attributes:
                energy = (np.abs(r[name]) * r.lengths_s).sum() / J_PER_KWH
                yield from differs(f"{name}:{key}", attributes[key], (r[name] * r.lengths_s).sum() / J_PER_KWH, DOUBLE * energy)


def ledger_tests(results):
    """Of gathered results, one for all bands: residual without the known bias of reused lines, its
    standard error [kWh], the energy that came in."""
    r = results[0]
    if r.shoots or "power_sun" not in r:
        return None
    unit = "klm_h" if "time_sum_klm_h" in r.of_data["power_sun"] else "kwh"
    sums = lambda name, key="time_sum_": np.mean([band.of_data[f"power_{name}"][f"{key}{unit}"] for band in results])
    if math.isnan(error := float(sums("residual", "time_sum_se_"))):
        return None
    bias, R = float(r.attributes[f"residual_reuse_bias_{unit}"]), r.realizations
    # The bias is an estimate from the same realizations: (mean − pooled)/(R − 1). Pooled minus bias has
    # at most (R + 1)/(R − 1) of the error of their mean. Errors of bands are added: they share lines.
    return float(sums("residual")) - bias, error * (R + 1) / (R - 1), sum(float(sums(term)) for term in IN)


def ledger_closes(results, ledgers):
    """Where no two fronts lie in one place. Shot: to rounding. Gathered: within its own error, as one of
    so many ledgers."""
    r = results[0]
    for band in results if r.shoots else []:
        came = sum(band[f"power_{term}"] for term in IN)
        yield from differs("ledger_closes: power_residual of what is shot", band["power_residual"], 0, 1e-6 * came)
    if test := ledger_tests(results):
        residual, error, came = test
        most = student.bound(FALSE_ALARMS / ledgers, r.realizations - 1) * error + SERIES * came
        if not abs(residual) <= most:
            yield (f"ledger_closes: open by {residual:.3g} of {came:.3g}: {abs(residual) / max(error, 1e-300):.1f} standard errors "
                   f"of {r.realizations} realizations, {most:.3g} allowed")


def reflects_no_more_than_it_receives(r):
    """Unless it shines by itself."""
    if "power_load" in r and not (r["power_emitted"] > 0).any():
        most = r["light_load"] * (1 + SERIES)
        if (r["power_load"] > most).any():
            k = int(np.argmax(r["power_load"] - most))
            yield f"power_load[{k}] is {r['power_load'][k]!r}, light_load {r['light_load'][k]!r}"


def shape_is_sound(r):
    """Areas, normals and middles are those of the corners, indices point to something."""
    corners = r["vertex_position"][r["patch_vertices"]]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(cross, axis=1) / 2
    largest = np.abs(r["vertex_position"]).max(initial=0)
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).sum(axis=1)
    # Coordinates are relative to the origin: what their rounding makes of an area is the perimeter times it.
    yield from differs("patch_area", r["patch_area"], areas, 1e-9 * areas + 1e-15 * largest * sides)
    yield from differs("patch_centroid", r["patch_centroid"], corners.mean(axis=1), 1e-12 * max(largest, 1e-3))
    yield from differs("|patch_normal|", np.linalg.norm(r["patch_normal"], axis=1), 1, 1e-6)
    turned = (cross * r["patch_normal"]).sum(axis=1)
    yield from differs("patch_normal, by its corners,", turned, 2 * areas, 1e-6 * areas + 1e-15 * largest * sides)
    for name, into in (("patch_object", "object_name"), ("patch_facade", "facade_name"), ("patch_material", "material_name"),
                       ("patch_input_triangle", "input_triangle_vertices"), ("patch_vertices", "vertex_position")):
        if name in r and r[name].size and not (-1 <= r[name].min() and r[name].max() < len(r.get(into, []))):
            yield f"{name} points beyond {into}"


def times_are_in_order(r):
    begin, end = r["time_bounds"].T
    if not ((begin <= r["time"]) & (r["time"] <= end) & (begin < end)).all():
        yield "an interval does not hold its time"
    if (np.diff(r["time"]) <= 0).any():
        yield "times do not increase"
    north = math.radians(float(r.attributes["north_deg"]))
    azimuth, height = np.radians(r["sun_azimuth"]) - north, np.radians(r["sun_elevation"])
    wanted = np.stack([np.sin(azimuth) * np.cos(height), np.cos(azimuth) * np.cos(height), np.sin(height)], axis=1)
    yield from differs("sun_direction", r["sun_direction"], wanted, 1e-9)


EVERY = (finite_and_not_negative, parts_make_the_whole, loads_are_time_sums, maximum_is_of_the_series, dark_is_dark,
         no_brighter_than_the_sun, shares_are_shares, facades_are_means, errors_are_of_realizations, ledger_adds_up,
         reflects_no_more_than_it_receives, shape_is_sound, times_are_in_order)


def problems(results):
    """Of all bands of a result, each with the name of its invariant; but for ledgers that are to close."""
    found = []
    for r in results:
        where = f" ({r.band})" if r.band else ""
        for invariant in EVERY:
            found += [f"{invariant.__name__}{where}: {problem}" for problem in invariant(r)]
    return found
