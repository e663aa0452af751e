#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Carpets: a series by day (across) and hour of the civil day (up) in false colour.

One carpet for each facade, patch or sensor; a facade is the area-weighted mean
of its patches. White lines are sunrise and sunset."""

import interpreter  # first: finds a Python that has the other packages

import datetime

import matplotlib.dates as dates
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.transforms import ScaledTranslation

import drawing
from drawing import plt
from reading import InputError

DAY_S = 86400
# The sun's centre is seen on the horizon when it stands there: refraction (The Astronomical Almanac: 34').
RISING_DEG = -34 / 60
SUN_LINE = {"color": "white", "linewidth": 0.8}
# Days whose names stand beside each other below a carpet of the whole width.
MOST_DAYS_NAMED = 24
TITLE_IN = 0.26


def boxes(result, days_of_columns):
    """Rectangles [day column, hour] of the intervals; an interval over midnight has two."""
    shapes, owner = [], []
    for k, (begin, end) in enumerate(result.bounds()):
        start, stop = result.civil(begin), result.civil(end)
        hour = (start.hour + start.minute / 60 + start.second / 3600)
        length = (end - begin) / 3600
        day = start.date()
        while length > 1e-9:
            part = min(length, 24 - hour)
            x = days_of_columns[day]
            shapes.append([(x, hour), (x + 1, hour), (x + 1, hour + part), (x, hour + part)])
            owner.append(k)
            hour, length, day = 0.0, length - part, day + datetime.timedelta(days=1)
            if day > stop.date():
                break
    return np.array(shapes), np.array(owner)


def columns(result):
    """Place of every civil day: its date number where the days follow each other, else 0, 1, 2, …"""
    days = sorted({result.civil(s).date() for s in np.concatenate(
        [result.bounds()[:, 0], result.bounds()[:, 1] - 1])})
    together = (days[-1] - days[0]).days + 1 == len(days) and len(days) > 7
    return {day: dates.date2num(day) if together else k for k, day in enumerate(days)}, together


def sunrise_and_sunset(latitude_deg, time, azimuth_deg, elevation_deg):
    """When [s] the sun of a day comes up and goes down, from one place of it high above the horizon; NaN where it
    does not. The declination stays as it is then, which puts neither off by more than some two minutes below the
    polar circles."""
    latitude, azimuth, elevation = np.radians([latitude_deg, azimuth_deg, elevation_deg])
    sine = np.sin(latitude) * np.sin(elevation) + np.cos(latitude) * np.cos(elevation) * np.cos(azimuth)
    cosine = np.sqrt(1 - sine**2)
    hour_angle = np.arctan2(-np.sin(azimuth) * np.cos(elevation) * np.cos(latitude), np.sin(elevation) - np.sin(latitude) * sine)
    half = (np.sin(np.radians(RISING_DEG)) - np.sin(latitude) * sine) / (np.cos(latitude) * cosine)
    half = np.arccos(half) if abs(half) < 1 else np.nan
    return [time + (at - hour_angle) * DAY_S / (2 * np.pi) for at in (-half, half)]


def sunrise_lines(result, places):
    """Columns, and the hours of sunrise and sunset; NaN where there is none."""
    highest, latitude = {}, result.attribute("latitude_deg", np.nan)
    elevation, time = result.numbers("sun_elevation"), result.numbers("time")
    for k in np.flatnonzero(elevation > 0):
        day = result.civil(time[k]).date()
        if elevation[k] > elevation[highest.get(day, k)] or day not in highest:
            highest[day] = k
    rise, fall = {}, {}
    for k in highest.values():
        for of_day, seconds in zip((rise, fall), sunrise_and_sunset(
                latitude, time[k], result.numbers("sun_azimuth")[k], elevation[k])):
            if np.isfinite(seconds):
                at = result.civil(seconds)
                of_day[at.date()] = at.hour + at.minute / 60 + at.second / 3600
    days = sorted(places)
    return [places[d] for d in days], np.array([[rise.get(d, np.nan), fall.get(d, np.nan)] for d in days])


def draw(result, arguments):
    if result.is_synthetic:
        raise InputError(f"{result.path}: its suns have no dates (period.positions), so that there is no day "
                         "and hour; use series.py")
    if result.has_long_steps:
        raise InputError(f"{result.path}: its series are means over steps: {result.series_step}, which say nothing of "
                         "hours; use series.py or months.py, or run the study with output.series_step: 60 min")
    quantity = arguments.quantity or result.main_series()
    targets = result.targets(arguments.facade, arguments.patch, arguments.sensor, most=4)
    values = result.series(quantity, targets)
    places, together = columns(result)
    shapes, owner = boxes(result, places)
    weights = np.repeat(result.hours(), len(targets))
    lit = np.nan_to_num(values.ravel(), nan=-1) > 0
    end = drawing.scale_end(np.where(lit, values.ravel(), np.nan), weights, arguments.max) if lit.any() else 1.0

    across = 2 if len(targets) > 1 else 1
    down = -(-len(targets) // across)
    figure, grid = plt.subplots(down, across, squeeze=False, sharex=True, sharey=True,
                                figsize=(10, 1.6 + 3.1 * down))
    for k, axes in enumerate(grid.ravel()):
        if k >= len(targets):
            axes.axis("off")
            continue
        axes.set_facecolor(drawing.NO_DATA)
        carpet = PolyCollection(shapes, array=np.ma.masked_invalid(values[owner, k]), clim=(0, end),
                                cmap=drawing.palette(arguments.colour), edgecolors="face", linewidths=0.2,
                                rasterized=True)
        axes.add_collection(carpet)
        axes.set_title(drawing.shortened(targets[k].label, 90 // across))
        lay_axes(axes, result, places, together, MOST_DAYS_NAMED // across)
    lay_key(grid[0, min(across, len(targets)) - 1])
    for axes in grid[:, 0]:
        axes.set_ylabel(f"hour of the day, {result.zone_name}")
    drawing.colour_bar(figure, carpet, grid, result.caption(
        ("sensor_" if targets[0].kind == "sensor" else "") + quantity), values, end)
    drawing.heading(figure, result, f"{quantity.replace('_', ' ')} by day and hour of civil time, "
                                    f"{result.offsets()}; grey: not computed")
    return figure, rows(result, targets, values, quantity)


def lay_key(axes):
    """What the white lines are, where there are any, above the title of the panel at the right."""
    if not any(np.isfinite(line.get_ydata()).any() for line in axes.lines):
        return
    above = ScaledTranslation(0, TITLE_IN, axes.figure.dpi_scale_trans)
    key = axes.legend([plt.Line2D([], [], **SUN_LINE)], ["sunrise, sunset"], loc="lower right", bbox_to_anchor=(1, 1),
                      bbox_transform=axes.transAxes + above, borderaxespad=0, fontsize=8, labelcolor="white",
                      frameon=True, fancybox=False, framealpha=1)
    key.get_frame().set(facecolor=drawing.palette("false")(0), linewidth=0)


def lay_axes(axes, result, places, together, most_named):
    x = np.array(sorted(places.values()))
    axes.tick_params(labelbottom=True)
    axes.set(xlim=(x.min(), x.max() + 1), ylim=(0, 24), yticks=range(0, 25, 3))
    lines, rise_set = sunrise_lines(result, places)
    if together:
        for hours in rise_set.T:
            # Near the midnight sun the sun sets at 23:50 one day and at 0:10 the next: no line between.
            for part in np.split(np.arange(len(hours)), np.flatnonzero(np.abs(np.diff(hours)) > 12) + 1):
                axes.step([*(lines[k] for k in part), lines[part[-1]] + 1], [*hours[part], hours[part[-1]]],
                          where="post", **SUN_LINE)
        locator = dates.AutoDateLocator(minticks=4, maxticks=12)
        axes.xaxis.set_major_locator(locator)
        axes.xaxis.set_major_formatter(dates.ConciseDateFormatter(locator))
        return
    for column, hours in zip(lines, rise_set):
        for hour in hours:
            axes.plot([column, column + 1], [hour, hour], **SUN_LINE)
    step = -(-len(places) // most_named)
    axes.set_xticks(x[::step] + 0.5, day_words(sorted(places)[::step]), fontsize=8)


def day_words(days):
    """Narrow ones; the year where it is another one."""
    return [f"{day:%d}\n{day:%b}" + (f"\n{day:%Y}" if k == 0 or day.year != days[k - 1].year else "")
            for k, day in enumerate(days)]


def rows(result, targets, values, quantity):
    yield ["day", "begin_hour", "hours"] + [f"{quantity} of {target.name}" for target in targets]
    for (begin, _), hours, line in zip(result.bounds(), result.hours(), values):
        start = result.civil(begin)
        yield [start.date().isoformat(), start.hour + start.minute / 60 + start.second / 3600,
               float(hours)] + [float(value) for value in line]


def main(argv):
    p = drawing.parser(__doc__)
    p.add_argument("--quantity", help="series (default: irradiance, or illuminance where that is stored)")
    drawing.add_targets(p)
    drawing.add_colours(p)
    drawing.draw_one(p.parse_args(argv), "carpet", draw)


if __name__ == "__main__":
    drawing.run(main)
