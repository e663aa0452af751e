#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sun-path diagram with the hours at which a patch or facade is lit.

Plan of the sky: north is up, east is right, the horizon is the circle, the
zenith its middle (stereographic). Without --facade or --patch it is drawn for
the facade that receives most of the sun (most light, where none is in the sun).
Every interval of the study is a dot at its sun, coloured by what arrives straight
from the sun, hollow where nothing does; the sun is behind the surface in the grey
part. For a facade the colour is the share of its area in the sun. The far hills of
the study (site.horizon) are brown: their file is looked for where the study lay, two
folders above the result, or is named with --horizon."""

import interpreter  # first: finds a Python that has the other packages

import numpy as np

import drawing
from drawing import plt
from hills import hills_of
from reading import InputError

MOST_DAYS_JOINED = 12
# Between suns further apart the path is not known well enough for marks of hours.
LONGEST_STEP_S = 3700
# Of the direct normal irradiance: less is a sun in the very plane of the surface (rounding).
LEAST_COSINE = 1e-4
# Between the highest suns of two days: numbers of their hours would lie on each other.
LEAST_DEGREES_BETWEEN_LABELS = 6
# Those of `sunload sun --image`.
HILLS_COLOUR, HILLS_LINE = (0.87, 0.85, 0.80), (0.45, 0.38, 0.28)


def place(azimuth_deg, elevation_deg):
    """Point of the diagram: x to the east, y to the north; the horizon at 1."""
    radius = np.tan(np.radians(90 - np.asarray(elevation_deg)) / 2)
    azimuth = np.radians(azimuth_deg)
    return radius * np.sin(azimuth), radius * np.cos(azimuth)


def direct_series(result):
    return "illuminance_direct" if result.has("illuminance_direct") else "irradiance_direct"


def lit_share(result, target):
    """Share of the target's area that the sun reaches straight, for each interval: of each patch what it receives of
    what it would in full sun."""
    dataset = result.need(direct_series(result), "the diagram shows what the sun lights straight; add direct to "
                          "the study's output.series")
    first, last = int(target.patches.min()), int(target.patches.max()) + 1
    weight = np.zeros(last - first)
    weight[target.patches - first] = target.area / target.area.sum()
    rows, shares = dataset.chunks[0] if dataset.chunks else 64, []
    beam = result.numbers("direct_normal_illuminance" if result.has("illuminance_direct") else "dni")
    normal, to_sun = result.numbers("patch_normal")[first:last], result.numbers("sun_direction")
    for k in range(0, dataset.shape[0], rows):
        block, of_block = dataset[k:k + rows, first:last], slice(k, k + rows)
        is_missing = np.isnan(block).any(axis=1, where=weight > 0)
        # Where several suns stand for an interval some may shine from beyond the surface's horizon.
        cosine = np.maximum(to_sun[of_block] @ normal.T, LEAST_COSINE)
        full = np.maximum(beam[of_block, None] * cosine, np.finfo(float).tiny)
        lit = np.where(block > LEAST_COSINE * beam[of_block, None], np.minimum(block / full, 1), 0)
        shares.append(np.where(is_missing, np.nan, lit @ weight))
    return np.concatenate(shares)


def scene_north_deg(result):
    """Azimuth of the scene's +y axis, from a sun that is not in the zenith."""
    direction, azimuth = result.numbers("sun_direction"), result.numbers("sun_azimuth")
    k = int(np.argmin(np.abs(direction[:, 2])))
    return azimuth[k] - np.degrees(np.arctan2(direction[k, 0], direction[k, 1]))


def normal_of(result, target):
    """Unit normal, area-weighted, in the scene frame."""
    normal = np.average(result.numbers("patch_normal")[target.patches], axis=0, weights=target.area)
    length = np.linalg.norm(normal)
    return normal / length if length > 1e-3 else None


def draw_frame(axes):
    angle = np.radians(np.arange(361))
    for elevation in (0, 15, 30, 45, 60, 75):
        radius = place(0, elevation)[1]
        axes.plot(radius * np.sin(angle), radius * np.cos(angle), color="black" if elevation == 0 else "#cccccc",
                  linewidth=1.2 if elevation == 0 else 0.6, zorder=1)
        if elevation:
            axes.text(0.01, radius, f"{elevation}°", fontsize=7, color="#777777", va="bottom")
    for azimuth in range(0, 360, 30):
        x, y = place(azimuth, 0)
        axes.plot([0, x], [0, y], color="#dddddd", linewidth=0.6, zorder=1)
        word = {0: "N", 90: "E", 180: "S", 270: "W"}.get(azimuth)
        axes.text(1.07 * x, 1.07 * y, word or f"{azimuth}°", ha="center", va="center",
                  fontsize=11 if word else 7, fontweight="bold" if word else "normal")
    axes.set(xlim=(-1.15, 1.15), ylim=(-1.15, 1.15), aspect="equal")
    axes.axis("off")


def shade_behind(axes, result, normal):
    """The part of the sky from which the sun cannot see the front."""
    x, y = np.meshgrid(np.linspace(-1, 1, 501), np.linspace(-1, 1, 501))
    radius = np.hypot(x, y)
    elevation, azimuth = np.pi / 2 - 2 * np.arctan(radius), np.arctan2(x, y) - np.radians(scene_north_deg(result))
    cosine = (normal[0] * np.cos(elevation) * np.sin(azimuth) + normal[1] * np.cos(elevation) * np.cos(azimuth) +
              normal[2] * np.sin(elevation))
    behind = np.where((cosine < 0) & (radius <= 1), 1.0, np.nan)
    axes.imshow(behind, extent=(-1, 1, -1, 1), origin="lower", cmap="Greys", vmin=0, vmax=8, zorder=0,
                interpolation="nearest")


def draw_hills(axes, hills):
    """From the horizon up to their line."""
    azimuth = np.arange(0, 360.25, 0.5)
    foot, top = place(azimuth, np.zeros_like(azimuth)), place(azimuth, np.maximum(hills.at(azimuth), 0))
    axes.fill(*(np.append(outer, inner[::-1]) for outer, inner in zip(foot, top)), color=HILLS_COLOUR, linewidth=0, zorder=0.5)
    axes.plot(*top, color=HILLS_LINE, linewidth=1, zorder=1.5)


def draw_paths(axes, result, days, elevation, xy):
    """Joins the suns of a day (few days), or those of the same hour of UTC (many days)."""
    keys = days
    if len(set(days)) > MOST_DAYS_JOINED:
        keys = [int(s % 86400) // 60 for s in result.bounds()[:, 0]]
    for key in sorted(set(keys)):
        mine = np.array([k for k, other in enumerate(keys) if other == key and elevation[k] > 0], dtype=int)
        for part in np.split(mine, np.flatnonzero(np.diff(mine) > max(1, len(keys) // 3)) + 1 if len(mine) else []):
            axes.plot(xy[0][part], xy[1][part], color="#999999", linewidth=0.7, zorder=2)


def noon_elevation(time, elevation):
    """Of the suns of a day, whichever hours they have: sin(elevation) = a + b cos(t) + c sin(t)."""
    if len(time) < 3:
        return elevation.max()
    turn = 2 * np.pi * (time - time[0]) / 86400
    a, b, c = np.linalg.lstsq(np.column_stack([np.ones_like(turn), np.cos(turn), np.sin(turn)]),
                              np.sin(np.radians(elevation)), rcond=None)[0]
    return np.degrees(np.arcsin(min(1.0, a + np.hypot(b, c))))


def label_hours(axes, result, days):
    """Full hours of civil time on the longest and the shortest path of the sun, between its dots."""
    time, azimuth, elevation = (result.numbers(n) for n in ("time", "sun_azimuth", "sun_elevation"))
    up = {}
    for k in np.flatnonzero(elevation > 0):
        up.setdefault(days[k], []).append(k)
    highest = {day: noon_elevation(time[members], elevation[members]) for day, members in up.items()}
    longest, shortest = max(sorted(highest), key=highest.get), min(sorted(highest), key=highest.get)
    is_apart = highest[longest] - highest[shortest] > LEAST_DEGREES_BETWEEN_LABELS
    for day in [longest, shortest] if is_apart else [longest]:
        members = np.array(up[day])
        turned = np.degrees(np.unwrap(np.radians(azimuth[members])))
        for hour in np.arange(np.ceil(time[members[0]] / 3600) * 3600, time[members[-1]] + 1, 3600):
            near = np.searchsorted(time[members], hour)
            if time[members[min(near, len(members) - 1)]] - time[members[max(near - 1, 0)]] > LONGEST_STEP_S:
                continue
            x, y = place(np.interp(hour, time[members], turned), np.interp(hour, time[members], elevation[members]))
            axes.plot(x, y, marker="+", color="black", markersize=8, markeredgewidth=0.8, zorder=5)
            axes.text(0.93 * x, 0.93 * y, f"{result.civil(hour):%H}".lstrip("0") or "0", fontsize=8, zorder=6,
                      ha="center", va="center")
        x, y = place(azimuth[members[0]], elevation[members[0]])
        axes.annotate(f"{day:%d %b}", (x, y), xytext=(6, 4), textcoords="offset points", fontsize=8,
                      fontweight="bold")


def sunniest_facade(result):
    """The facade that receives most energy straight from the sun, or of all light where none is in the sun; and why."""
    facade, area = result.numbers("patch_facade"), result.numbers("patch_area")
    for load, why in (("light_load_direct", "most sun"), ("light_load", "most light")):
        if result.has(load):
            energy = np.where(facade >= 0, result.numbers(load) * area, 0)
            sums = np.bincount(np.maximum(facade, 0), energy, len(result.names("facade_name")))
            if sums.max() > 0:
                break
    return int(np.argmax(sums)), f"of {len(sums)} facades the one with {why}" if len(sums) > 1 else ""


def chosen_target(result, arguments):
    """What is drawn, and why it, where nobody chose it."""
    if len(arguments.facade) + len(arguments.patch) > 1:
        raise InputError("one facade or one patch at a time: call the script once for each")
    if not arguments.facade + arguments.patch and result.names("facade_name"):
        facade, why = sunniest_facade(result)
        return result.facade(facade), why
    found = result.targets(arguments.facade, arguments.patch, most=1)
    if len(found) > 1:
        raise InputError(f"{result.path}: {arguments.facade[0]} matches {len(found)} facades; name one")
    return found[0], ""


def draw_suns(axes, xy, is_up, is_hidden, share, shown, largest):
    """A dot of each; those that are coloured."""
    size = 42 if is_up.sum() < 300 else 16
    unlit = is_up & (share == 0) & ~is_hidden
    for those, face, edge, word in ((unlit, "white", "#555555", "no direct sun"),
                                    (is_hidden, HILLS_COLOUR, HILLS_LINE, "behind far hills")):
        if those.any():
            axes.scatter(xy[0][those], xy[1][those], s=size * 0.6, facecolors=face, edgecolors=edge, linewidths=0.7,
                         zorder=3, label=word)
    lit = is_up & (share > 0)
    return axes.scatter(xy[0][lit], xy[1][lit], c=shown[lit], s=size, cmap=drawing.palette("false"), vmin=0,
                        vmax=largest, edgecolors="black", linewidths=0.3, zorder=4, label="in the sun" if lit.any() else None)


def draw(result, arguments):
    if result.series_step:
        raise InputError(f"{result.path}: its series are means over steps: {result.series_step}, for which no one sun "
                         "stands; run the study with output.series_step: interval")
    target, why = chosen_target(result, arguments)
    hills, lacking = hills_of(result, arguments.horizon)
    azimuth, elevation = result.numbers("sun_azimuth"), result.numbers("sun_elevation")
    is_up = elevation > 0
    if not is_up.any():
        raise InputError(f"{result.path}: the sun is below the horizon in all intervals")
    is_patch = target.kind == "patch"
    share = lit_share(result, target)
    shown = result.series(direct_series(result), [target])[:, 0] if is_patch else 100 * share
    xy = place(azimuth, elevation)

    figure, axes = plt.subplots(figsize=(8.2, 7.6))
    draw_frame(axes)
    normal = normal_of(result, target)
    if normal is not None:
        shade_behind(axes, result, normal)
    if hills:
        draw_hills(axes, hills)
    lit, is_hidden = is_up & (share > 0), hills.hide(azimuth, elevation) if hills else np.zeros_like(is_up)
    largest = drawing.rounded_up(np.nanmax(shown[lit])) if lit.any() and is_patch else 100.0
    dots = draw_suns(axes, xy, is_up, is_hidden & ~lit, share, shown, largest)
    if not result.is_synthetic:
        days = [result.civil(s).date() for s in result.numbers("time")]
        draw_paths(axes, result, days, elevation, xy)
        label_hours(axes, result, days)
    figure.colorbar(dots, ax=axes, shrink=0.7, aspect=30,
                    label=result.caption(direct_series(result)) if is_patch else "area in the sun [%]")
    axes.legend(loc="lower left", fontsize=8)
    drawing.heading(figure, result, heading_words(result, target, why, is_up, is_hidden if hills else None, lacking))
    return figure, rows(result, target, shown, share)


def heading_words(result, target, why, is_up, is_hidden, lacking):
    hours = result.hours()
    lit = np.average(result.numbers("sun_hours")[target.patches], weights=target.area)
    clock = "" if result.is_synthetic else f"; hours: {result.offsets()}"
    above = "" if is_hidden is None else f", above the far hills in those of {hours[is_up & ~is_hidden].sum():.4g} h"
    return (f"{target.label}{': ' if why else ''}{why}\n{result.period()}\n"
            f"{lit:.4g} h in the sun, which is up in intervals of {hours[is_up].sum():.4g} h{above}\n"
            f"plan of the sky, stereographic; grey: behind the surface{clock}" + (f"\n{lacking}" if lacking else ""))


def rows(result, target, shown, share):
    yield ["time", "azimuth_deg", "elevation_deg", "lit_share",
           direct_series(result) if target.kind == "patch" else "lit_percent"]
    for k, seconds in enumerate(result.numbers("time")):
        yield [result.civil(seconds).isoformat(), float(result.numbers("sun_azimuth")[k]),
               float(result.numbers("sun_elevation")[k]), float(share[k]), float(shown[k])]


def main(argv):
    p = drawing.parser(__doc__)
    drawing.add_targets(p, sensors=False)
    p.add_argument("--horizon", metavar="FILE", help="line of far hills (default: that of the study, where it is found)")
    drawing.draw_one(p.parse_args(argv), "sun_path", draw)


if __name__ == "__main__":
    drawing.run(main)
