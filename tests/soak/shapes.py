# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of bodies and sheets as lists of faces [m].

A face is (kind of surface, corners), corners counter-clockwise seen from its front.
"""

import math


def prism(foot, height):
    """Upright over a polygon of (x, y), counter-clockwise seen from above; stands on z = 0."""
    low = [(x, y, 0.0) for x, y in foot]
    high = [(x, y, height) for x, y in foot]
    after = [*range(1, len(foot)), 0]
    walls = [("wall", [low[k], low[n], high[n], high[k]]) for k, n in enumerate(after)]
    return [("floor", low[::-1]), ("roof", high), *walls]


def rectangle(width, depth):
    return [(-width / 2, -depth / 2), (width / 2, -depth / 2), (width / 2, depth / 2), (-width / 2, depth / 2)]


def box(width, depth, height):
    return prism(rectangle(width, depth), height)


def tower(radius, height, sides):
    turns = [2 * math.pi * k / sides for k in range(sides)]
    return prism([(radius * math.cos(t), radius * math.sin(t)) for t in turns], height)


def gabled(width, depth, eaves, ridge):
    """A house with a saddle roof, its ridge along x at the height `ridge`."""
    low = [(x, y, 0.0) for x, y in rectangle(width, depth)]
    top = [(x, y, eaves) for x, y, _ in low]
    a, b = (-width / 2, 0.0, ridge), (width / 2, 0.0, ridge)
    return [("floor", low[::-1]),
            ("wall", [low[0], low[1], top[1], top[0]]), ("wall", [low[2], low[3], top[3], top[2]]),
            ("wall", [low[1], low[2], top[2], b, top[1]]), ("wall", [low[3], low[0], top[0], a, top[3]]),
            ("roof", [top[0], top[1], b, a]), ("roof", [top[2], top[3], a, b])]


def court(width, depth, height, share):
    """Four wings about a yard that takes `share` of width and depth."""
    outer, inner = rectangle(width, depth), rectangle(share * width, share * depth)
    faces = []
    for k, n in enumerate((1, 2, 3, 0)):
        (ox, oy), (px, py), (ix, iy), (jx, jy) = outer[k], outer[n], inner[k], inner[n]
        faces += [("wall", [(ox, oy, 0.0), (px, py, 0.0), (px, py, height), (ox, oy, height)]),
                  ("wall", [(jx, jy, 0.0), (ix, iy, 0.0), (ix, iy, height), (jx, jy, height)]),
                  ("roof", [(ox, oy, height), (px, py, height), (jx, jy, height), (ix, iy, height)]),
                  ("floor", [(ix, iy, 0.0), (jx, jy, 0.0), (px, py, 0.0), (ox, oy, 0.0)])]
    return faces


def crown(radius, height):
    """An octahedron whose lowest corner is at z = 0."""
    ring = [(radius, 0.0, height / 2), (0.0, radius, height / 2), (-radius, 0.0, height / 2), (0.0, -radius, height / 2)]
    faces = []
    for k, n in enumerate((1, 2, 3, 0)):
        faces += [("other", [ring[k], ring[n], (0.0, 0.0, height)]), ("other", [ring[n], ring[k], (0.0, 0.0, 0.0)])]
    return faces


def tetrahedron(size):
    a, b, c, d = (0.0, 0.0, 0.0), (size, 0.0, 0.0), (0.3 * size, size, 0.0), (0.4 * size, 0.4 * size, size)
    return [("other", list(f)) for f in ((a, c, b), (a, b, d), (b, c, d), (c, a, d))]


def plate(width, depth):
    """A level sheet that faces up."""
    return [("ground", [(x, y, 0.0) for x, y in rectangle(width, depth)])]


def screen(width, height):
    """An upright sheet that faces south."""
    return [("wall", [(-width / 2, 0.0, 0.0), (width / 2, 0.0, 0.0), (width / 2, 0.0, height), (-width / 2, 0.0, height)])]


def land(size, cells, height_at):
    """A square of terrain in triangles; `height_at(x, y)`."""
    step = size / cells
    at = lambda i, j: (x := i * step - size / 2, y := j * step - size / 2, height_at(x, y))
    faces = []
    for i in range(cells):
        for j in range(cells):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            faces += [("ground", [a, b, c]), ("ground", [a, c, d])]
    return faces


def soup(random, count, size):
    """Triangles anywhere in a cube that stands on z = 0."""
    corner = lambda: tuple(random.uniform(-0.5, 0.5) * size + (size / 2 if axis == 2 else 0) for axis in range(3))
    return [("other", [corner() for _ in range(3)]) for _ in range(count)]


def placed(faces, turn_deg=0.0, tilt_deg=0.0, move=(0.0, 0.0, 0.0)):
    """Tilted about the x axis, turned about z, then moved."""
    cos, sin = math.cos(math.radians(turn_deg)), math.sin(math.radians(turn_deg))
    up, out = math.cos(math.radians(tilt_deg)), math.sin(math.radians(tilt_deg))

    def at(p):
        x, y, z = p[0], up * p[1] - out * p[2], out * p[1] + up * p[2]
        return (cos * x - sin * y + move[0], sin * x + cos * y + move[1], z + move[2])

    return [(kind, [at(p) for p in corners]) for kind, corners in faces]


def area(corners):
    """Of a polygon, by the length of its vector area [m2]."""
    total = [0.0, 0.0, 0.0]
    for p, q in zip(corners, corners[1:] + corners[:1]):
        for axis in range(3):
            i, j = (axis + 1) % 3, (axis + 2) % 3
            total[axis] += (p[i] - corners[0][i]) * (q[j] - corners[0][j]) - (p[j] - corners[0][j]) * (q[i] - corners[0][i])
    return math.hypot(*total) / 2
