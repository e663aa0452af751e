#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars of the light load of variants and of their differences to the first result.

Whiskers are 95 % confidence intervals from the realizations (Student's t).
Where two results carry the same pairing_id, differences are taken realization
by realization, as `sunload compare` does; otherwise both errors add up (Welch)."""

import interpreter  # first: finds a Python that has the other packages

import fnmatch
import sys

import numpy as np

import drawing
from drawing import plt, student_t
from reading import InputError, Result

# More of them would make a picture that no reader of PNG opens.
MOST_GROUPS = 400


class Groups:
    """Area-weighted means of the light load of the whole, or by facade, object or surface."""

    def __init__(self, result, by):
        self.result = result
        if by == "whole":
            self.names = ["whole"]
        elif by == "surface":
            attributes = result.file["patch_surface"].attrs
            words = attributes["flag_meanings"]
            self.names = (words.decode() if isinstance(words, bytes) else words).split()
        else:
            self.names = result.names(by + "_name")
        member = np.zeros(len(result.numbers("patch_area")), int) if by == "whole" else \
            result.numbers(f"patch_{by}").astype(int)
        weight = np.where(member >= 0, result.numbers("patch_area"), 0)
        self.area = np.bincount(np.maximum(member, 0), weight, len(self.names))

        def mean(values):
            sums = np.bincount(np.maximum(member, 0), weight * values, len(self.names))
            return sums / np.where(self.area > 0, self.area, np.nan)

        self.load = mean(result.need("light_load", "it is what is compared")[...])
        self.realizations = np.array([mean(row[...]) for row in result.file["light_load_realization"]]) \
            if result.has("light_load_realization") else np.empty((0, len(self.names)))
        self.place = {name: k for k, name in enumerate(self.names) if self.area[k] > 0}

    def whisker(self, k):
        count = len(self.realizations)
        return student_t(count - 1) * self.realizations[:, k].std(ddof=1) / np.sqrt(count) if count > 1 else np.nan


def are_paired(base, variant):
    pairing = base.result.attribute("pairing_id")
    return bool(pairing) and pairing == variant.result.attribute("pairing_id") and \
        len(base.realizations) == len(variant.realizations) > 1


def difference(base, variant, name):
    """Difference, its standard error, and the half width of its confidence interval."""
    b, v = base.place[name], variant.place[name]
    value = float(variant.load[v] - base.load[b])
    if min(len(base.realizations), len(variant.realizations)) < 2:
        return value, np.nan, np.nan
    if are_paired(base, variant):
        apart = variant.realizations[:, v] - base.realizations[:, b]
        error, degrees = apart.std(ddof=1) / np.sqrt(len(apart)), len(apart) - 1
    else:
        parts = [(g.realizations[:, k].var(ddof=1) / len(g.realizations), len(g.realizations) - 1)
                 for g, k in ((base, b), (variant, v))]
        error = np.sqrt(sum(part for part, _ in parts))
        degrees = sum(part for part, _ in parts) ** 2 / max(sum(p**2 / n for p, n in parts), 1e-300)
    return value, float(error), float(error * student_t(max(degrees, 1)))


def chosen_names(base, variants, patterns, by):
    """Groups that all results have: those named, or all; those that change most first."""
    common = [name for name in base.place if all(name in variant.place for variant in variants)]
    if patterns:
        common = [name for name in common if any(fnmatch.fnmatchcase(name, p) for p in patterns)]
    if not common:
        raise InputError(f"no {by} is in all of the results" + (f" and matches {', '.join(patterns)}" if patterns
                                                                 else "; choose another --by"))
    change = {name: max(abs(v.load[v.place[name]] - base.load[base.place[name]]) for v in variants)
              for name in common}
    return sorted(common, key=lambda name: -change[name])[:MOST_GROUPS], len(common)


def draw(results, arguments):
    base, *variants = (Groups(result, arguments.by) for result in results)
    units = {result.units("light_load") for result in results}
    if len(units) > 1:
        raise InputError(f"the light loads have the units {' and '.join(sorted(units))}: they cannot be compared")
    names, of_all = chosen_names(base, variants, arguments.group, arguments.by)
    figure, (left, right) = plt.subplots(1, 2, sharey=True, figsize=(11, 1.9 + max(1.2, 0.14 * len(names) * (len(results) + 0.6))))
    thick = 0.8 / len(results)
    whiskers = {"ecolor": "black", "elinewidth": 0.9, "capsize": 2}
    lines = []
    labels = legend_words(results)
    for k, groups in enumerate((base, *variants)):
        y = np.arange(len(names)) + (k - (len(results) - 1) / 2) * thick
        colour = "#999999" if k == 0 else drawing.LINE_COLOURS[(k - 1) % 7]
        loads = [groups.load[groups.place[name]] for name in names]
        left.barh(y, loads, thick, color=colour, label=labels[k],
                  xerr=[groups.whisker(groups.place[name]) for name in names], error_kw=whiskers)
        if k > 0:
            apart = [difference(base, groups, name) for name in names]
            right.barh(y, [d for d, _, _ in apart], thick, color=colour, xerr=[w for _, _, w in apart],
                       error_kw=whiskers)
            lines += [[groups.result.attribute("variant"), name, float(base.area[base.place[name]]),
                       float(base.load[base.place[name]]), float(groups.load[groups.place[name]]), d, se, w,
                       str(are_paired(base, groups)).lower()] for name, (d, se, w) in zip(names, apart)]
    left.set_yticks(range(len(names)), names)
    left.set_ylim(len(names) - 0.4, -0.6)
    left.set_xlabel(f"light load [{results[0].units('light_load')}]")
    right.set_xlabel(f"difference to {base.result.attribute('variant')} [{units.pop()}]")
    right.axvline(0, color="black", linewidth=0.8)
    for axes in (left, right):
        axes.grid(True, axis="x")
    right.legend(*left.get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(1, 1))
    drawing.heading(figure, results[0], heading_words(base, variants, len(names), of_all, arguments))
    header = ["variant", "name", "area_m2", "base_kwh_m2", "variant_kwh_m2", "difference_kwh_m2", "se_kwh_m2",
              "whisker_kwh_m2", "paired"]
    return figure, [header] + lines


def have_one_period(results):
    return len({result.period() for result in results}) == 1


def legend_words(results):
    """Variants, with their periods where these are not the same."""
    names = [result.attribute("variant") for result in results]
    return names if have_one_period(results) else \
        [f"{name}\n{result.period()}" for name, result in zip(names, results)]


def heading_words(base, variants, shown, of_all, arguments):
    paired = [are_paired(base, variant) for variant in variants]
    how = "paired realizations" if all(paired) else "independent realizations" if not any(paired) else \
        "realizations paired where pairing_id agrees"
    which = f"; the {shown} of {of_all} that change most" if shown < of_all else ""
    period = base.result.period() if have_one_period([base.result, *(v.result for v in variants)]) else "periods differ"
    return f"light load by {arguments.by}, {period}{which}\nwhiskers: 95 % confidence, {how}"


def main(argv):
    p = drawing.parser(__doc__, results="RESULT", many=True)
    p.add_argument("--by", choices=("facade", "object", "surface"), default="facade",
                   help="what is compared (default: %(default)s)")
    p.add_argument("--group", action="append", default=[], metavar="NAME",
                   help="only these, by name or pattern, e.g. 'house_1/*' (repeatable)")
    arguments = p.parse_args(argv)
    if len(arguments.results) < 2:
        raise InputError("only one result: there is nothing to compare; give the base and at least one variant")
    results = [Result(path) for path in arguments.results]
    figure, rows = draw(results, arguments)
    if arguments.csv:
        drawing.write_csv(arguments.csv, rows)
    output = arguments.output or drawing.default_output(results[0], "compare")
    drawing.save(figure, output, arguments.dpi)
    print(f"wrote {output}", file=sys.stderr)


if __name__ == "__main__":
    drawing.run(main)
