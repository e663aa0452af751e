#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Facades of a result as unrolled pictures in false colour.

Every facade is drawn as seen from outside, upright and to scale, those of one
object side by side in the order in which one walks around it. Without --facade
the largest ones are drawn, but none of less than a fiftieth of the largest one
(chimneys and dormers)."""

import interpreter  # first: finds a Python that has the other packages

import numpy as np
from matplotlib.collections import PolyCollection

import drawing
from drawing import plt
from reading import InputError, compass

MOST_FACADES = 24
# Of the largest facade: smaller ones are drawn where they are named.
LEAST_AREA_SHARE = 0.02
GAP_M = 1.5
WIDTH_IN = 11.0
LABEL_LETTERS = 20
# The height of the picture without its heading, and steps to a smaller scale until it is kept.
TALLEST_IN, SCALE_STEP = 13.0, 1.1
# Of its rectangle a facade with openings, gables or covered parts leaves more than this.
FULL_SHARE = 0.999


def seen_from_outside(vertices, normal):
    """Coordinates right and up [m] of points [n, 3] for one who looks against a normal."""
    right = np.cross([0.0, 0.0, 1.0], normal)
    # A level sheet has no right: scene east then, so that up is scene north.
    right = right / np.linalg.norm(right) if np.linalg.norm(right) > 1e-6 else np.array([1.0, 0.0, 0.0])
    up = np.cross(normal, right)
    return vertices @ np.stack([right, up], axis=1)


class Panel:
    """One facade: its triangles in its own plane, from its lower left corner."""

    def __init__(self, result, index, values):
        self.facade = result.facade(index)
        self.owner = self.facade.name.split("/")[0]
        patches = self.facade.patches
        self.values = values[patches]
        normal = np.average(result.numbers("patch_normal")[patches], axis=0, weights=self.facade.area)
        corners = result.numbers("vertex_position")[result.numbers("patch_vertices")[patches]]
        flat = seen_from_outside(corners.reshape(-1, 3), normal / np.linalg.norm(normal)).reshape(-1, 3, 2)
        self.corner = flat.min(axis=(0, 1))
        self.triangles = flat - self.corner
        # What stands out is drawn last, over what it hides.
        self.order = np.argsort(corners.mean(axis=1) @ normal, kind="stable")
        self.width, self.height = self.triangles.max(axis=(0, 1))
        self.mean = float(np.average(self.values, weights=self.facade.area))

    def words(self, letters):
        return (f"{drawing.shortened(self.facade.name, letters)}\n{compass(self.facade.azimuth_deg)} {round(self.facade.azimuth_deg) % 360}°, "
                f"{self.facade.area.sum():.0f} m²\nmean {self.mean:.3g}")


def walking_order(panel):
    """Who looks at a wall has the wall of the next smaller azimuth to the right."""
    return panel.owner, -panel.facade.azimuth_deg, panel.facade.name


def laid_out(panels, width, letter_m):
    """Lower left corners of the panels in rows of a width [m]; the height of all."""
    places, row, x, y, tops = [], 0, 0.0, 0.0, []
    label_width, label_height = LABEL_LETTERS * letter_m, 7.0 * letter_m
    for k, panel in enumerate(panels):
        wide = max(panel.width, label_width)
        if x > 0 and (x + wide > width or panel.owner != panels[k - 1].owner and x + wide > 0.6 * width):
            row, x = row + 1, 0.0
        if row == len(tops):
            tops.append(0.0)
        places.append((x, row))
        tops[row] = max(tops[row], panel.height)
        x += wide + max(GAP_M, letter_m)
    starts = []
    for top in tops:
        y += top + letter_m
        starts.append(-y)
        y += label_height
    return [(x, starts[row]) for x, row in places], y


def facades_by_area(result):
    """The largest, without those that are small beside them."""
    largest = result.largest_facades(MOST_FACADES)
    area = result.numbers("facade_area") if largest else []
    return [i for i in largest if area[i] >= LEAST_AREA_SHARE * max(area)]


def letter_size(width):
    """Of the labels, 7 points high, in a picture of a width [m]."""
    return width / (WIDTH_IN * 0.86 * 72 / 4.2)


def inches_high(width, height):
    return WIDTH_IN * 0.86 * height / (width + 2 * letter_size(width))


def scale_of(panels):
    """Width [m] of the picture: about three quarters as high as wide, and never too high, as of towers."""
    area = sum((max(p.width, 5) + GAP_M) * (p.height + 4) for p in panels)
    width = max(max(p.width for p in panels), min(np.sqrt(area / 0.7), sum(p.width + GAP_M for p in panels)), 12)
    while inches_high(width, laid_out(panels, width, letter_size(width))[1]) > TALLEST_IN:
        width *= SCALE_STEP
    return width


def draw(result, arguments):
    quantity = arguments.quantity
    interval = result.interval_at(arguments.time) if arguments.time else None
    values = result.per_patch(quantity, interval)
    chosen = result.facades_named(arguments.facade) if arguments.facade else facades_by_area(result)
    if not chosen:
        raise InputError(f"{result.path}: has no facades (no upright faces); draw it with `sunload render`")
    panels = sorted((Panel(result, i, values) for i in chosen), key=walking_order)

    width = scale_of(panels)
    letter_m = letter_size(width)
    places, height = laid_out(panels, width, letter_m)

    drawn_area = np.concatenate([p.facade.area for p in panels])
    drawn = np.concatenate([p.values for p in panels])
    end = drawing.scale_end(drawn, drawn_area, arguments.max)
    tall = max(inches_high(width, height) + 0.9, 3.0)
    figure, axes = plt.subplots(figsize=(WIDTH_IN, tall))
    collection = PolyCollection(
        np.concatenate([p.triangles[p.order] + np.array(place) for p, place in zip(panels, places)]),
        array=np.ma.masked_invalid(np.concatenate([p.values[p.order] for p in panels])),
        cmap=drawing.palette(arguments.colour), clim=(0, end), antialiased=False, linewidths=0, rasterized=True, snap=False)
    axes.add_collection(collection)
    for panel, (x, y) in zip(panels, places):
        letters = int(max(panel.width / letter_m, LABEL_LETTERS))
        axes.text(x, y - 0.8 * letter_m, panel.words(letters), va="top", fontsize=7, linespacing=1.25)
    axes.set(xlim=(-letter_m, width + letter_m), ylim=(-height - 3 * letter_m, letter_m), aspect="equal")
    axes.axis("off")
    scale_bar(axes, width, -height - 1.5 * letter_m, letter_m)
    drawing.colour_bar(figure, collection, axes, result.caption(quantity), drawn, end)
    drawing.heading(figure, result, heading_words(result, quantity, interval, panels))
    return figure, rows(panels, quantity, result)


def heading_words(result, quantity, interval, panels):
    is_series = result.dims(quantity)[0] == "time"
    shown = result.brightest() if interval is None else interval
    when = result.interval_words(shown) if is_series else result.period()
    of_all = len(result.names("facade_name"))
    which = "" if len(panels) == of_all else f"; {len(panels)} of {of_all} facades"
    has_gaps = any(p.facade.area.sum() < FULL_SHARE * p.width * p.height for p in panels)
    gaps = "; white between its parts: openings, roofs, and what is covered" if has_gaps else ""
    unknown = "; grey: not computed" if any(np.isnan(p.values).any() for p in panels) else ""
    return f"{quantity.replace('_', ' ')}, {when}{which}; seen from outside, to scale{gaps}{unknown}"


def scale_bar(axes, width, y, letter_m):
    length = drawing.rounded_up(width / 12)
    axes.plot([0, length], [y, y], color="black", linewidth=2, solid_capstyle="butt")
    axes.text(length + letter_m, y, f"{length:g} m", va="center", fontsize=7)


def rows(panels, quantity, result):
    yield ["facade", "azimuth_deg", "patch", "right_m", "up_m", "area_m2", quantity]
    for panel in panels:
        middle = panel.triangles.mean(axis=1)
        for k, patch in enumerate(panel.facade.patches):
            yield [panel.facade.name, panel.facade.azimuth_deg, int(patch), float(middle[k, 0]),
                   float(middle[k, 1]), float(panel.facade.area[k]), float(panel.values[k])]


def main(argv):
    p = drawing.parser(__doc__)
    p.add_argument("--quantity", default="light_load", help="dataset per patch (default: %(default)s)")
    p.add_argument("--time", help="instant of a series, e.g. 2026-06-21T12:00 (default: the brightest)")
    p.add_argument("--facade", action="append", default=[], metavar="NAME",
                   help="facade by name or pattern, e.g. 'house_3/*' (repeatable)")
    drawing.add_colours(p)
    drawing.draw_one(p.parse_args(argv), "facade_map", draw)


if __name__ == "__main__":
    drawing.run(main)
