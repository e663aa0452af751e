#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Carpets: a series by day (across) and hour of the civil day (up) in false colour.

One carpet for each facade, patch or sensor; a facade is the area-weighted mean
of its patches. White lines are sunrise and sunset as the intervals show them."""

import interpreter  # first: finds a Python that has the other packages

import datetime

import matplotlib.dates as dates
import numpy as np
from matplotlib.collections import PolyCollection

import drawing
from drawing import plt
from reading import InputError


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


def sunrise_lines(result, places):
    """Columns, and the first and last hour with the sun above the horizon; NaN where the day's
    intervals do not begin or end in the dark."""
    rise, fall = {}, {}
    is_up, bounds = result.numbers("sun_elevation") > 0, result.bounds()
    for k in np.flatnonzero(is_up[1:] != is_up[:-1]) + 1:
        if bounds[k, 0] > bounds[k - 1, 1] + 1:
            continue
        at = result.civil(bounds[k, 0])
        (rise if is_up[k] else fall)[at.date()] = at.hour + at.minute / 60
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
        lay_axes(axes, result, places, together)
    for axes in grid[:, 0]:
        axes.set_ylabel(f"hour of the day, {result.zone_name}")
    drawing.colour_bar(figure, carpet, grid, result.caption(
        ("sensor_" if targets[0].kind == "sensor" else "") + quantity), values, end)
    drawing.heading(figure, result, f"{quantity.replace('_', ' ')} by day and hour of civil time, "
                                    f"{result.offsets()}; grey: not computed")
    return figure, rows(result, targets, values, quantity)


def lay_axes(axes, result, places, together):
    x = np.array(sorted(places.values()))
    axes.tick_params(labelbottom=True)
    axes.set(xlim=(x.min(), x.max() + 1), ylim=(0, 24), yticks=range(0, 25, 3))
    lines, rise_set = sunrise_lines(result, places)
    if together:
        for hours in rise_set.T:
            # Near the midnight sun the sun sets at 23:50 one day and at 0:10 the next: no line between.
            for part in np.split(np.arange(len(hours)), np.flatnonzero(np.abs(np.diff(hours)) > 12) + 1):
                axes.step([*(lines[k] for k in part), lines[part[-1]] + 1], [*hours[part], hours[part[-1]]],
                          where="post", color="white", linewidth=0.8)
        locator = dates.AutoDateLocator(minticks=4, maxticks=12)
        axes.xaxis.set_major_locator(locator)
        axes.xaxis.set_major_formatter(dates.ConciseDateFormatter(locator))
        return
    for column, hours in zip(lines, rise_set):
        for hour in hours:
            axes.plot([column, column + 1], [hour, hour], color="white", linewidth=0.8)
    step = -(-len(places) // 14)
    axes.set_xticks(x[::step] + 0.5, [f"{day:%d %b\n%Y}" for day in sorted(places)][::step])


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
