#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars of the light load of variants and of their differences to the first result.

Differences are those of `sunload compare`: of the surfaces that both have, with its
errors, paired realization by realization where results carry the same pairing_id and
independent (Welch, with degrees of freedom by the means of all that each has) elsewhere.
Whiskers are 95 % confidence intervals (Student's t); those of differences are longer by what
unlike meshes may put them off (`mesh` of `sunload compare`)."""

import interpreter  # first: finds a Python that has the other packages

import fnmatch
import sys

import numpy as np

import drawing
import fonts
from drawing import plt, student_t
from program import Program, add_program
from reading import InputError, Result

# More of them would make a picture that no reader of PNG opens.
MOST_GROUPS = 400
# Of names beside the bars and of results: longer ones would leave the bars no room.
NAME_LETTERS = 30
# Higher pictures have their numbers above, too.
TALL_IN = 8


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


class NothingInCommon(InputError):
    """No group is in all of the results."""


def is_of_both(row):
    return all(value is not None for key, value in row.items() if key.startswith(("base_", "variant_")))


class Differences:
    """What `sunload compare` tells of a variant against the base."""

    def __init__(self, program, base, variant, by):
        self.base, self.variant = base, variant
        told = program.compared(base.result.path, variant.result.path)
        self.notes = told["notes"]
        # What one of the two has alone has rows of its own, without a difference.
        self.rows = {row["name"]: row for row in told["rows"]
                     if row["group"] == by and is_of_both(row)}

    def number(self, name, word):
        """Of a group: "base", "variant", "difference", "se" [unit of the results], "area"."""
        row = self.rows[name]
        found = [value for key, value in row.items() if key.startswith(word + "_") and not key.endswith("_percent")]
        return float(found[0]) if found and found[0] is not None else np.nan

    def is_paired(self):
        return all(row["paired"] for row in self.rows.values())

    def whisker(self, name):
        """Half width of the confidence interval, and what unlike meshes may put the difference off."""
        counts = [len(groups.realizations) for groups in (self.base, self.variant)]
        if min(counts) < 2:
            return np.nan
        degrees = counts[0] - 1 if self.rows[name]["paired"] else self.welch_degrees(name)
        return self.number(name, "se") * student_t(degrees) + self.mesh_error(name)

    def mesh_error(self, name):
        return np.nan_to_num(self.number(name, "mesh_error"))

    def welch_degrees(self, name):
        parts = [(groups.realizations[:, groups.place[name]].var(ddof=1) / len(groups.realizations),
                  len(groups.realizations) - 1) for groups in (self.base, self.variant)]
        return max(sum(part for part, _ in parts) ** 2 / max(sum(p**2 / n for p, n in parts), 1e-300), 1)


def chosen_names(base, differences, patterns, by):
    """Groups that all results have: those named, or all; those that change most first."""
    common = [name for name in base.place
              if all(name in one.rows and name in one.variant.place for one in differences)]
    if patterns:
        common = [name for name in common if any(fnmatch.fnmatchcase(name, p) for p in patterns)]
    if not common:
        raise NothingInCommon(f"no {by} is in all of the results" + (f" and matches {', '.join(patterns)}" if patterns
                                                                 else "; choose another --by"))
    change = {name: max(abs(np.nan_to_num(one.number(name, "difference"))) for one in differences) for name in common}
    return sorted(common, key=lambda name: -change[name])[:MOST_GROUPS], len(common)


def draw(results, arguments, program):
    base, *variants = (Groups(result, arguments.by) for result in results)
    units = {result.units("light_load") for result in results}
    if len(units) > 1:
        raise InputError(f"the light loads have the units {' and '.join(sorted(units))}: they cannot be compared")
    differences = [Differences(program, base, variant, arguments.by) for variant in variants]
    names, of_all = chosen_names(base, differences, arguments.group, arguments.by)
    for note in dict.fromkeys(note for one in differences for note in one.notes):
        print(f"note: {note}", file=sys.stderr)
    figure, (left, right) = plt.subplots(1, 2, sharey=True, figsize=(11, 1.9 + max(1.2, 0.14 * len(names) * (len(results) + 0.6))))
    thick = 0.8 / len(results)
    labels = legend_words(results)
    for k, groups in enumerate((base, *variants)):
        y = np.arange(len(names)) + (k - (len(results) - 1) / 2) * thick
        look = {**bar_look(k), "height": thick, "error_kw": {"ecolor": "black", "elinewidth": 0.9, "capsize": 2}}
        left.barh(y, [groups.load[groups.place[name]] for name in names], label=labels[k],
                  xerr=[groups.whisker(groups.place[name]) for name in names], **look)
        if k > 0:
            right.barh(y, [differences[k - 1].number(name, "difference") for name in names],
                       xerr=[differences[k - 1].whisker(name) for name in names], **look)
    left.set_yticks(range(len(names)), [drawing.shortened(name, NAME_LETTERS) for name in names])
    left.set_ylim(len(names) - 0.4, -0.6)
    right.axvline(0, color="black", linewidth=0.8)
    unit = units.pop()
    name_axis(left, f"light load\n[{unit}]")
    name_axis(right, f"difference to {drawing.shortened(base.result.attribute('variant'), NAME_LETTERS)}\n"
                     f"where both are [{unit}]")
    right.legend(*left.get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(1, 1))
    drawing.heading(figure, results[0], heading_words(base, differences, len(names), of_all, arguments))
    return figure, rows(differences, names)


def name_axis(axes, words):
    """Below, and of tall pictures above, where they are looked at first."""
    axes.grid(True, axis="x")
    axes.set_xlabel(words)
    axes.xaxis.get_major_locator().set_params(nbins=6)
    if axes.figure.get_figheight() > TALL_IN:
        axes.tick_params(top=True, labeltop=True)
        axes.set_title(words, loc="center", fontsize=9)


def bar_look(k):
    """Grey for the base; from the ninth result on colours come again, hatched."""
    if k == 0:
        return {"color": "#999999"}
    return {"color": drawing.LINE_COLOURS[(k - 1) % 7], "hatch": ("", "////", "....", "xxxx")[(k - 1) // 7 % 4],
            "edgecolor": "white", "linewidth": 0}


def rows(differences, names):
    units = "klx_h" if "lx" in differences[0].base.result.units("light_load") else "kwh_m2"
    yield ["variant", "name", "area_m2", *(f"{word}_{units}" for word in ("base", "variant", "difference", "se", "mesh_error", "whisker")),
           "paired"]
    for one in differences:
        for name in names:
            yield [one.variant.result.attribute("variant"), name] + \
                [one.number(name, word) for word in ("area", "base", "variant", "difference", "se")] + \
                [float(one.mesh_error(name)), float(one.whisker(name)), str(one.rows[name]["paired"]).lower()]


def have_one_period(results):
    return len({result.period() for result in results}) == 1


def legend_words(results):
    """Variants, with their periods where these are not the same."""
    names = [drawing.shortened(result.attribute("variant"), NAME_LETTERS) for result in results]
    return names if have_one_period(results) else \
        [f"{name}\n{result.period()}" for name, result in zip(names, results)]


def heading_words(base, differences, shown, of_all, arguments):
    paired = [one.is_paired() for one in differences]
    how = "paired realizations" if all(paired) else "independent realizations" if not any(paired) else \
        "realizations paired where pairing_id agrees"
    which = f"; the {shown} of {of_all} that change most" if shown < of_all else ""
    results = [base.result, *(one.variant.result for one in differences)]
    period = base.result.period() if have_one_period(results) else "periods differ"
    mesh = "; of differences longer by what unlike meshes may put them off" \
        if any(one.mesh_error(name) > 0 for one in differences for name in one.rows) else ""
    return f"light load by {arguments.by}, {period}{which}\nwhiskers: 95 % confidence, {how}{mesh}"


def main(argv):
    p = drawing.parser(__doc__, results="RESULT", many=True)
    p.add_argument("--by", choices=("facade", "object", "surface"), default="facade",
                   help="what is compared (default: %(default)s)")
    p.add_argument("--group", action="append", default=[], metavar="NAME",
                   help="only these, by name or pattern, e.g. 'house_1/*' (repeatable)")
    add_program(p)
    arguments = p.parse_args(argv)
    if len(arguments.results) < 2:
        raise InputError("only one result: there is nothing to compare; give the base and at least one variant")
    results = [Result(path) for path in arguments.results]
    fonts.serve(results)
    figure, listed = draw(results, arguments, Program(arguments.sunload))
    if arguments.csv:
        drawing.write_csv(arguments.csv, listed)
    output = arguments.output or drawing.default_output(results[0], "compare")
    drawing.save(figure, output, arguments.dpi)
    print(f"wrote {output}", file=sys.stderr)


if __name__ == "__main__":
    drawing.run(main)
