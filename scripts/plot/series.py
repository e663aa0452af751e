#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time series of facades, patches or sensors in the civil time of the site.

A facade is the area-weighted mean of its patches. Steps are the study's
intervals; periods without intervals are cut out. Without --facade, --patch or
--sensor the largest facades are drawn."""

import interpreter  # first: finds a Python that has the other packages

import matplotlib.dates as dates
import numpy as np
from matplotlib.ticker import MaxNLocator

import drawing
from drawing import plt
from reading import InputError

MOST_PANELS = 8
# Longer periods are drawn by the day: single hours could not be seen.
MOST_DAYS_OF_INTERVALS = 14
DAY_S = 86400
# Days further apart are not joined by a line: nothing is known of those between.
MOST_DAYS_JOINED = 7
# Of names beside the plot: longer ones would leave it no room.
LABEL_LETTERS = 40


def runs_of_time(bounds):
    """Ranges of intervals without gaps between them."""
    cuts = np.flatnonzero(bounds[1:, 0] > bounds[:-1, 1] + 1) + 1
    edges = [0, *cuts, len(bounds)]
    return list(zip(edges[:-1], edges[1:]))


def by_day(result, values, units):
    """Bounds [s] of the civil days and their time sums [day, target] (means where sums have no meaning)."""
    bounds, hours = result.bounds(), result.hours()
    days = [result.civil(s).date() for s in bounds.mean(axis=1)]
    starts = [k for k in range(len(days)) if k == 0 or days[k] != days[k - 1]]
    sums = np.add.reduceat(values * hours[:, None], starts, axis=0)
    last = np.append(starts[1:], len(days)) - 1
    scale = 1000 if units in drawing.TIME_SUMS else np.add.reduceat(hours, starts)[:, None]
    return np.stack([bounds[starts, 0], bounds[last, 1]], axis=1), sums / scale


def whole_days(bounds, values):
    """The same without a first or last day of which less than half is there: sums of it would look like darkness, as of
    the hour in which a year of standard time reaches into the next one of the clock."""
    lengths = bounds[:, 1] - bounds[:, 0]
    is_kept = np.full(len(bounds), True)
    if len(bounds) > 2:
        is_kept[[0, -1]] = lengths[[0, -1]] >= np.median(lengths) / 2
    return bounds[is_kept], values[is_kept], not is_kept.all()


def torn_apart(days, values):
    """The same with an empty point wherever days lie so far apart that no line joins them."""
    gaps = np.flatnonzero(np.diff(days) > MOST_DAYS_JOINED) + 1
    return np.insert(days, gaps, np.nan), np.insert(values.astype(float), gaps, np.nan)


def stairs(axes, edges, values, **style):
    """Steps that stand for means over intervals."""
    x = np.repeat(edges, 2)[1:-1]
    axes.plot(x, np.repeat(values, 2), **style)


def draw(result, arguments):
    quantity = arguments.quantity or result.main_series()
    targets = result.targets(arguments.facade, arguments.patch, arguments.sensor, most=6)
    values, bounds, units = result.series(quantity, targets), result.bounds(), result.units(quantity)
    caption, what = result.caption(quantity), "means over " + (f"steps: {result.series_step}" if result.series_step
                                                               else "intervals")
    is_long = len(runs_of_time(bounds)) > MOST_PANELS or result.hours().sum() > 24 * MOST_DAYS_OF_INTERVALS
    if result.series_step == "month" and arguments.step == "day":
        raise InputError(f"{result.path}: its series are means over months, which say nothing of days; "
                         "leave --step away")
    has_days = not result.is_synthetic and result.series_step != "month"
    is_daily = has_days and (arguments.step == "day" or arguments.step == "auto" and is_long)
    if is_daily:
        bounds, values, is_cut = whole_days(*by_day(result, values, units))
        what = "sums" if units in drawing.TIME_SUMS else "means"
        what += " over the intervals of each civil day" + (", but a first or last one cut short" if is_cut else "")
        caption = f"light load of the day [{drawing.TIME_SUMS[units]}]" if units in drawing.TIME_SUMS else caption
    pieces = [(0, len(bounds))] if result.is_synthetic or is_daily else runs_of_time(bounds)
    lengths = [bounds[end - 1, 1] - bounds[begin, 0] for begin, end in pieces]

    figure, row = plt.subplots(1, len(pieces), sharey=True, squeeze=False, figsize=(10, 4.6),
                               gridspec_kw={"width_ratios": lengths})
    for axes, (begin, end) in zip(row[0], pieces):
        draw_piece(axes, result, targets, bounds[begin:end], values[begin:end], is_daily, max(2, 8 // len(pieces)))
    row[0][0].set_ylabel(caption)
    row[0][0].set_ylim(bottom=min(0.0, np.nanmin(values)))
    middle = "intervals in the order of the file" if result.is_synthetic else f"civil time, {result.offsets()}"
    figure.supxlabel(middle, fontsize=9)
    row[0][-1].legend(loc="upper left", bbox_to_anchor=(1, 1), fontsize=8)
    drawing.heading(figure, result, f"{quantity.replace('_', ' ')}, {what}")
    return figure, rows(result, targets, bounds, values, quantity)


def draw_piece(axes, result, targets, bounds, values, is_daily, most_ticks):
    # Matplotlib's dates are days since 1970 in UTC; the locator gives them the zone.
    edges = np.append(bounds[:, 0], bounds[-1, 1]) / DAY_S
    if result.is_synthetic:
        edges = np.arange(len(bounds) + 1) + 0.5
    for k, target in enumerate(targets):
        style = {"color": drawing.LINE_COLOURS[k % 8], "linestyle": drawing.LINE_STYLES[k // 8 % 4],
                 "linewidth": 1.4, "label": drawing.shortened(target.label, LABEL_LETTERS)}
        if is_daily:   # days without intervals in between: points joined, no steps
            days, of_days = torn_apart(bounds.mean(axis=1) / DAY_S, values[:, k])
            axes.plot(days, of_days, marker="." if len(bounds) < 60 else "", **style)
        else:
            stairs(axes, edges, values[:, k], **style)
    axes.grid(True)
    if result.is_synthetic:
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        return
    locator = dates.AutoDateLocator(tz=result.zone, minticks=min(3, most_ticks), maxticks=min(7, most_ticks + 1))
    axes.xaxis.set_major_locator(locator)
    if bounds[-1, 1] - bounds[0, 0] < 2 * DAY_S:
        axes.xaxis.set_major_formatter(dates.DateFormatter("%H:%M", tz=result.zone))
        axes.set_title(result.civil(bounds[0, 0]).strftime("%a %d %b %Y"))
    else:
        axes.xaxis.set_major_formatter(dates.ConciseDateFormatter(locator, tz=result.zone))


def rows(result, targets, bounds, values, quantity):
    yield ["begin", "end"] + [f"{quantity} of {target.name}" for target in targets]
    for (begin, end), line in zip(bounds, values):
        stamps = [result.civil(s).isoformat() for s in (begin, end)]
        yield stamps + [float(value) for value in line]


def main(argv):
    p = drawing.parser(__doc__)
    p.add_argument("--quantity", help="series (default: irradiance, or illuminance where that is stored)")
    drawing.add_targets(p)
    p.add_argument("--step", choices=("auto", "interval", "day"), default="auto",
                   help="what is drawn: intervals, or sums over days (default: days where intervals are too many)")
    drawing.draw_one(p.parse_args(argv), "series", draw)


if __name__ == "__main__":
    drawing.run(main)
