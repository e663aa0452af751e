#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against samples: what results of one study with more and more lines per patch state of their error.

Results whose variants differ by lines_per_patch alone (study key matrix) are one line, with the slope of a straight fit to
the logarithms and its own error. Random samples have the slope -0.5. --errors adds what samplers_bench has written."""

import interpreter  # noqa: F401  first: finds a Python that has the other packages

import csv
import os
import re

import numpy as np
from matplotlib.ticker import NullFormatter

import drawing
import fonts
from drawing import plt
from reading import InputError, Result

LEAST_RESULTS = 3  # of a line with a slope and its error


def error_of(result, quantity):
    """Root mean square over the area (of sensors: over their number) of the standard error, as share of the mean."""
    place = result.dims(quantity)[-1] if result.has(quantity) else "patch"
    area = result.numbers(place + "_area") if result.has(place + "_area") else np.ones(result.numbers(quantity).shape[-1])
    mean = (area * result.numbers(quantity)).sum() / area.sum()
    if not mean > 0:
        raise InputError(f"{result.path}: {quantity} is 0 everywhere; name another --quantity")
    errors = result.need(quantity + "_se", "the error of what is drawn")[...]
    return float(np.sqrt((area * errors**2).sum() / area.sum()) / mean)


def slope(samples, errors):
    """Of the logarithms, with its standard error by the scatter about the line."""
    x, y = np.log(samples), np.log(errors)
    x = x - x.mean()
    value = (x * y).sum() / (x * x).sum()
    scatter = y - y.mean() - value * x
    return float(value), float(np.sqrt((scatter**2).sum() / (len(x) - 2) / (x * x).sum()))


def lines_of_results(results, quantity):
    """{name: [(lines per patch, error)]}"""
    lines = {}
    for result in results:
        name = re.sub(r"_?lines_per_patch-\d+", "", result.attribute("variant")).strip("_") or "lines"
        count = int(result.file.attrs["lines_per_patch"])
        lines.setdefault(name, []).append((count, error_of(result, quantity)))
    return lines


def lines_of_file(path):
    """{what: {name: [(samples, error)]}}"""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            rows = [(row["what"], row["sampler"], int(row["samples"]), float(row["error"])) for row in csv.DictReader(file)]
    except (KeyError, ValueError, TypeError) as error:
        raise InputError(f"{path}: is not what samplers_bench writes ({error})") from error
    lines = {}
    for what, sampler, samples, error in rows:
        lines.setdefault(what, {}).setdefault(sampler, []).append((samples, error))
    return lines


def panel(axes, title, lines):
    axes.set_title(title)
    rows = []
    for k, (name, points) in enumerate(lines.items()):
        points = sorted(points)
        samples, errors = (np.array(column, float) for column in zip(*points))
        if len(set(samples)) < LEAST_RESULTS:
            raise InputError(f"{title}, {name}: {len(set(samples))} counts of samples; a slope with its error needs "
                             f"{LEAST_RESULTS}: give results of more values of lines_per_patch")
        if not (errors > 0).all():
            raise InputError(f"{title}, {name}: an error of 0 has no logarithm; name another --quantity")
        value, off = slope(samples, errors)
        colour = drawing.LINE_COLOURS[k % len(drawing.LINE_COLOURS)]
        axes.loglog(samples, 100 * errors, "o-", color=colour, markersize=3, linewidth=1.2,
                    label=f"{name}: {value:.2f} ± {off:.3f}")
        rows += [[title, name, int(n), float(e), value, off] for n, e in zip(samples, errors)]
    counts = sorted({n for points in lines.values() for n, _ in points})
    axes.set_xticks(counts[::-(-len(counts) // 6)], [str(n) for n in counts[::-(-len(counts) // 6)]])
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlabel("samples of a patch")
    axes.grid(True)
    axes.legend(fontsize=8)
    return rows


def draw(results, arguments):
    first = f"{arguments.quantity.replace('_', ' ')}, by transport"
    panels = {first: lines_of_results(results, arguments.quantity)}
    if arguments.errors:
        panels |= lines_of_file(arguments.errors)
    figure, all_axes = plt.subplots(1, len(panels), figsize=(max(3.4 * len(panels), 5.6), 3.6), squeeze=False)
    rows = []
    for axes, (title, lines) in zip(all_axes[0], panels.items()):
        rows += panel(axes, title, lines)
    all_axes[0][0].set_ylabel("error [% of the mean]")
    figure.suptitle(f"{results[0].attribute('study')}: error against samples, slopes beside the names", x=0.01, ha="left",
                    fontsize=10.5)
    return figure, [["what", "name", "samples", "error_share", "slope", "slope_se"]] + rows


def main(argv):
    p = drawing.parser(__doc__, results="RESULT", many=True)
    p.add_argument("--quantity", default="light_load_reflected", help="a total with a standard error (default: %(default)s)")
    p.add_argument("--errors", metavar="CSV", help="what samplers_bench has written")
    arguments = p.parse_args(argv)
    results = [Result(path) for path in arguments.results]
    fonts.serve(results)
    figure, rows = draw(results, arguments)
    if arguments.csv:
        drawing.write_csv(arguments.csv, rows)
    output = arguments.output or os.path.join(os.path.dirname(results[0].path), "samples.png")
    drawing.save(figure, output, arguments.dpi)


if __name__ == "__main__":
    drawing.run(main)
