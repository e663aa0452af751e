#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the models of the example studies, a small town that does not exist, into this folder:

    configs/models/make.py           town.city.json, square_{surface,terrain,canopy}.asc
    configs/models/make.py --check   exit 1 where the files are not what would be written

The town lies on a map as real ones do (EPSG:25833, at Pilsen): rows of gabled houses around a
square with a town hall, a tower and lime trees. The rasters are the same town in cells of 2 m.
"""

import json
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
CRS = "EPSG:25833"
ORIGIN = (383000.0, 5511800.0, 310.0)  # of the town's south-west corner [m]
SIZE = (132.0, 116.0)                  # [m]
CELL = 2.0                             # of the rasters [m]


def houses():
    """Name, west, south, east, north, eaves, ridge [m]; ridge 0: a flat roof."""
    rows = []
    for k in range(9):  # two rows along the north, two along the south: ridges from west to east
        west, depth = 6 + 13.2 * k, 10 + k % 3
        for row, south in (("a", 96), ("b", 78), ("c", 24), ("d", 6)):
            tall = 6.0 + (5 * k + ord(row)) % 4 * 1.1
            rows.append((f"house_{row}{k + 1}", west, south, west + 12.2, south + depth, tall, tall + 4 + k % 2))
    for k in range(2):  # the sides of the square
        for side, west in (("west", 6), ("east", 113)):
            south = 42 + 16 * k
            rows.append((f"house_{side}_{k + 1}", west, south, west + 13, south + 13, 8.4 + k, 0))
    return rows + [("town_hall", 54, 58, 78, 70, 11, 17), ("tower", 82, 60, 88, 66, 32, 0)]


def trees():
    """Place of the trunk, radius and height of the crown's middle, height of its top [m]."""
    return [(34 + 9.0 * k, 46, 2.6, 5.0, 8.0 + k % 2) for k in range(8)]


class City:
    def __init__(self):
        self.vertices, self.index, self.objects = [], {}, {}

    def corner(self, x, y, z):
        at = tuple(round(1000 * v) for v in (x, y, z))
        if at not in self.index:
            self.index[at] = len(self.vertices)
            self.vertices.append(list(at))
        return self.index[at]

    def add(self, name, kind, faces, lod="2"):
        """`faces`: pairs of a semantic surface (or None) and corners, counter-clockwise from outside."""
        geometry = {"type": "Solid", "lod": lod, "boundaries": [[[[self.corner(*p) for p in ring]] for _, ring in faces]]}
        kinds = [kind for kind in ("GroundSurface", "RoofSurface", "WallSurface") if kind in {f[0] for f in faces}]
        if kinds:
            geometry["semantics"] = {"surfaces": [{"type": kind} for kind in kinds],
                                     "values": [[kinds.index(kind) for kind, _ in faces]]}
        self.objects[name] = {"type": kind, "geometry": [geometry]}

    def house(self, name, west, south, east, north, eaves, ridge):
        foot = [(west, south, 0), (east, south, 0), (east, north, 0), (west, north, 0)]
        top = [(x, y, eaves) for x, y, _ in foot]
        faces = [("GroundSurface", foot[::-1])]
        faces += [("WallSurface", [foot[k], foot[(k + 1) % 4], top[(k + 1) % 4], top[k]]) for k in (0, 2)]
        if ridge:
            middle = (south + north) / 2
            a, b = (west, middle, ridge), (east, middle, ridge)
            faces += [("WallSurface", [foot[1], foot[2], top[2], b, top[1]]),
                      ("WallSurface", [foot[3], foot[0], top[0], a, top[3]]),
                      ("RoofSurface", [top[0], top[1], b, a]), ("RoofSurface", [top[2], top[3], a, b])]
        else:
            faces += [("WallSurface", [foot[k], foot[(k + 1) % 4], top[(k + 1) % 4], top[k]]) for k in (1, 3)]
            faces.append(("RoofSurface", top))
        self.add(name, "Building", faces)

    def tree(self, name, x, y, radius, middle, top):
        """A crown of two pyramids of six sides."""
        ring = [(x + radius * math.cos(k * math.pi / 3), y + radius * math.sin(k * math.pi / 3), middle) for k in range(6)]
        high, low = (x, y, top), (x, y, 2 * middle - top)
        faces = [(None, [ring[k], ring[(k + 1) % 6], high]) for k in range(6)]
        faces += [(None, [ring[(k + 1) % 6], ring[k], low]) for k in range(6)]
        self.add(name, "SolitaryVegetationObject", faces)

    def text(self):
        head = {"type": "CityJSON", "version": "2.0",
                "metadata": {"title": "A town that does not exist, written by configs/models/make.py of sunload",
                             "referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/" + CRS.split(":")[1]},
                "transform": {"scale": [0.001, 0.001, 0.001], "translate": list(ORIGIN)}}
        compact = {"separators": (",", ":")}
        objects = ",\n".join(json.dumps(name) + ":" + json.dumps(o, **compact) for name, o in self.objects.items())
        return (json.dumps(head, **compact)[:-1] + ',\n"CityObjects":{\n' + objects + '},\n"vertices":'
                + json.dumps(self.vertices, **compact) + "}\n")


def city():
    model = City()
    for house in houses():
        model.house(*house)
    for k, tree in enumerate(trees()):
        model.tree(f"lime_{k + 1}", *tree)
    return model.text()


def terrain(_x, y):
    """The ground of the rasters falls by a metre from north to south."""
    return ORIGIN[2] + y / SIZE[1]


def surface(x, y):
    for _, west, south, east, north, eaves, ridge in houses():
        if west <= x < east and south <= y < north:
            rise = max(0, ridge - eaves) * (1 - abs(2 * y - south - north) / (north - south))
            return terrain(x, y) + eaves + rise
    return terrain(x, y)


def canopy(x, y):
    """Height of crowns above the ground, 0 where there are none."""
    return next((top for a, b, radius, _, top in trees() if math.hypot(x - a, y - b) < radius), 0)


def raster(value):
    columns, rows = (round(length / CELL) for length in SIZE)
    lines = [f"ncols {columns}", f"nrows {rows}", f"xllcorner {ORIGIN[0]:.0f}",
             f"yllcorner {ORIGIN[1]:.0f}", f"cellsize {CELL:g}", "NODATA_value -9999"]
    for row in reversed(range(rows)):
        lines.append(" ".join(f"{value((column + 0.5) * CELL, (row + 0.5) * CELL):.2f}" for column in range(columns)))
    return "\n".join(lines) + "\n"


def main():
    files = {"town.city.json": city(), "square_surface.asc": raster(surface),
             "square_terrain.asc": raster(terrain), "square_canopy.asc": raster(canopy)}
    if sys.argv[1:] == ["--check"]:
        wrong = [name for name, text in files.items() if (FOLDER / name).read_text(encoding="utf-8") != text]
        sys.exit(f"not as make.py writes them: {', '.join(wrong)}" if wrong else 0)
    for name, text in files.items():
        (FOLDER / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
