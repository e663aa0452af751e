#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Monthly light load of facades, patches or sensors as bars, divided into its parts.

Months are those of civil time. Bars are sums of the series over the intervals
that the study has: months that it covers only in part are marked, and titles
have the sums of all. A few hours that reach into one more month have no bar, and
are told. Where a result has no such series its stored totals of months are drawn
(output.totals), direct light apart. Whiskers: 95 % confidence of the month,
where the result has errors of months."""

import interpreter  # first: finds a Python that has the other packages

import calendar
import datetime

import numpy as np

import drawing
from drawing import plt
from reading import InputError


def month_shares(result):
    """Months (year, month) and hours [month, interval] that each interval has in them."""
    pairs = [(k, result.civil(begin), result.civil(end)) for k, (begin, end) in enumerate(result.bounds())]
    months = sorted({(t.year, t.month) for k, begin, end in pairs
                     for t in (begin, end - datetime.timedelta(seconds=1))})
    place = {month: m for m, month in enumerate(months)}
    hours = np.zeros((len(months), len(pairs)))
    for k, begin, end in pairs:
        if (begin.year, begin.month) == ((end - datetime.timedelta(seconds=1)).year,
                                         (end - datetime.timedelta(seconds=1)).month):
            hours[place[begin.year, begin.month], k] = (result.bounds()[k, 1] - result.bounds()[k, 0]) / 3600
            continue
        for month in months:
            first, last = month_span(result, month)
            shared = min(last, result.bounds()[k, 1]) - max(first, result.bounds()[k, 0])
            hours[place[month], k] = max(0.0, shared) / 3600
    return months, hours


def month_span(result, month):
    """Begin and end of a civil month [s since 1970]."""
    year, number = month
    first = datetime.datetime(year, number, 1, tzinfo=result.zone)
    last = datetime.datetime(year + number // 12, number % 12 + 1, 1, tzinfo=result.zone)
    return first.timestamp(), last.timestamp()


# What the stored parts leave of the whole below this share of it is rounding of floats.
ROUNDING_SHARE = 1e-4
REST = "other parts, not stored"
# Of the hours of the other months: a year in UTC reaches 14 hours into another one by the clock.
STRAY_SHARE = 0.02


def parts_of(result, quantity, targets, hours):
    """Names of the parts, and their sums [part, month, target]: W/m² times h, in thousands. What
    the file does not have apart is a part of its own, so that bars are always the whole."""
    def sums_of(name):
        return hours @ result.series(name, targets) / 1000
    whole = sums_of(quantity)
    parts = result.components(quantity, targets)
    sums = [sums_of(part) for part in parts]
    if not parts:
        return [quantity], np.array([whole])
    rest = whole - np.sum(sums, axis=0)
    if np.nansum(np.abs(rest)) > max(ROUNDING_SHARE, result.rounding(quantity)) * np.nansum(whole):
        parts, sums = parts + [REST], sums + [rest]
    return parts, np.array(sums)


def stored_months(result, targets):
    """The same from the totals of months: direct light, and all other."""
    whole, direct = (np.asarray(result.parts_of_period("month", total, targets), dtype=float)
                     for total in ("light_load", "light_load_direct"))
    return ["direct", "other light"], np.array([direct, whole - direct])


def confidence(result, months, targets):
    """Half widths of 95 % intervals [month, target]; None where months have no errors, or others than here."""
    if not result.has("light_load_by_month_realization") or \
            result.names("month") != [f"{year:04}-{month:02}" for year, month in months]:
        return None
    realizations = result.file["light_load_by_month_realization"].shape[1]
    return drawing.student_t(realizations - 1) * result.errors_of_parts("month", targets)


def draw(result, arguments):
    if result.is_synthetic:
        raise InputError(f"{result.path}: its suns have no dates (period.positions), so that there are no months")
    targets = result.targets(arguments.facade, arguments.patch, arguments.sensor, most=4)
    months, hours = month_shares(result)
    main_series = result.stored_main_series
    whiskers = None
    if arguments.quantity or main_series or not result.has("light_load_by_month"):
        quantity = arguments.quantity or result.main_series()
        parts, sums = parts_of(result, quantity, targets, hours)
        units = drawing.TIME_SUMS.get(result.units(quantity))
        if quantity == main_series:
            whiskers = confidence(result, months, targets)
    else:
        quantity = "light_load"
        parts, sums = stored_months(result, targets)
        units = result.units("light_load")
        whiskers = confidence(result, months, targets)
    if not np.isfinite(sums).all():
        raise InputError(f"{result.path}: {quantity} is not known of all its time: is the result complete?")
    if units is None:
        raise InputError(f"{result.path}: sums over time of {quantity} [{result.units(quantity)}] have no meaning "
                         "here; choose an irradiance or illuminance")

    drawn = months_worth_a_bar(hours)
    table = rows(months, hours, targets, parts, sums)  # all of them
    totals, note = sums.sum(axis=(0, 1)), words_of_stray(months, hours, drawn)
    months, hours, sums = [months[m] for m in drawn], hours[drawn], sums[:, drawn]
    whiskers = None if whiskers is None else whiskers[drawn]

    across = 2 if len(targets) > 1 else 1
    down = -(-len(targets) // across)
    figure, grid = plt.subplots(down, across, squeeze=False, sharex=True, sharey=True,
                                figsize=(10, 1.8 + 2.8 * down))
    is_whole = [hours[m].sum() * 3600 >= month_span(result, month)[1] - month_span(result, month)[0] - 1
                for m, month in enumerate(months)]
    for k, axes in enumerate(grid.ravel()):
        if k >= len(targets):
            axes.axis("off")
            continue
        draw_bars(axes, months, is_whole, sums[:, :, k], parts, quantity)
        if whiskers is not None:
            axes.errorbar(range(len(months)), sums[:, :, k].sum(axis=0), whiskers[:, k], fmt="none", ecolor="black",
                          elinewidth=0.8, capsize=2)
        axes.set_title(f"{drawing.shortened(targets[k].label, 80) if across == 1 else drawing.shortened(targets[k].name, 32)}: {drawing.number(totals[k], 4)} {units}")
    # One scale for all panels, which the highest bar of all decides.
    tops = sums.sum(axis=0) + (0 if whiskers is None else np.nan_to_num(whiskers))
    grid[0, 0].set_ylim(0, 1.05 * max(np.nanmax(tops), 1e-12))
    for axes in grid[:, 0]:
        axes.set_ylabel(f"{load_words(quantity)} of the month [{units}]")
    if len(parts) > 1:
        handles, labels = grid[0, 0].get_legend_handles_labels()
        grid[0, -1].legend(handles[::-1], labels[::-1], loc="upper left", bbox_to_anchor=(1, 1))
    note = ("" if all(is_whole) else "; * only part of the month is in the study") + note
    drawing.heading(figure, result, f"{load_words(quantity)} by civil month, {result.zone_name}{note}")
    return figure, table


def months_worth_a_bar(hours):
    """All but a first or last one that is a stray rest of the others, as the hour in which a year of standard time reaches
    into the next one of the clock."""
    of_month = hours.sum(axis=1)
    is_stray = np.full(len(of_month), False)
    if len(of_month) > 2:
        is_stray[[0, -1]] = of_month[[0, -1]] < STRAY_SHARE * np.median(of_month)
    return np.flatnonzero(~is_stray)


def words_of_stray(months, hours, drawn):
    """What has no bar is told."""
    strays = [f"{hours[m].sum():.3g} h of {year}-{month:02}" for m, (year, month) in enumerate(months) if m not in drawn]
    return f"; without a bar, but in the sums: {', '.join(strays)}" if strays else ""


def load_words(quantity):
    """What a sum over time of a series is called: "light load, direct" of irradiance_direct."""
    for series in ("irradiance", "illuminance", "light_load"):
        if quantity.startswith(series):
            part = quantity.removeprefix(series).strip("_")
            return "light load" + (f", {part.replace('_', ' ')}" if part else "")
    return quantity.replace("_", " ")


def draw_bars(axes, months, is_whole, sums, parts, quantity):
    bottom = np.zeros(len(months))
    for part, values in zip(parts, sums):
        name = part.removeprefix(quantity + "_")
        axes.bar(range(len(months)), values, bottom=bottom, label=name, width=0.75,
                 color=drawing.COMPONENT_COLOURS.get(name, drawing.LINE_COLOURS[0]))
        bottom += values
    axes.set_xticks(range(len(months)), [
        calendar.month_abbr[month] + ("" if whole else "*") + (f"\n{year}" if m == 0 or year != months[m - 1][0]
                                                              else "")
        for m, ((year, month), whole) in enumerate(zip(months, is_whole))])
    axes.tick_params(labelbottom=True)
    axes.set_xlim(-0.6, max(len(months), 3) - 0.4)
    axes.grid(True, axis="y")


def rows(months, hours, targets, parts, sums):
    yield ["month", "hours_covered", "target"] + parts + ["sum"]
    for m, (year, month) in enumerate(months):
        for k, target in enumerate(targets):
            yield [f"{year}-{month:02}", float(hours[m].sum()), target.name] + \
                [float(value) for value in sums[:, m, k]] + [float(sums[:, m, k].sum())]


def main(argv):
    p = drawing.parser(__doc__)
    p.add_argument("--quantity", help="series that is summed (default: irradiance or illuminance)")
    drawing.add_targets(p)
    drawing.draw_one(p.parse_args(argv), "months", draw)


if __name__ == "__main__":
    drawing.run(main)
