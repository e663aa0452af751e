# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Boxes on a plate, on which dtcc-solar was checked by its authors: faces as they are in the files, against shadows cut
out exactly and rays told by the boxes' six planes."""

import math
import os

import numpy as np

from methods import FAMILY_WISE, t_quantile
from rows import Row, Section

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
CITY = os.path.join(ROOT, "..", "shared", "data", "city")
HEIGHT = 10.0
# In plan: from, to [m].
CUBES = {
    "one cube, 1664 faces": ("dtcc_box_sharp_f1664.obj", [((-5, -5), (5, 5))]),
    "four cubes, 5248 faces": ("dtcc_boxes_sharp_f5248.obj",
                               [((x, y), (x + 10, y + 10)) for x in (-15, 5) for y in (-15, 5)]),
}
SUNS = ((120, 20), (170, 40), (250, 30))  # azimuth, elevation [°]
DNI, DHI = 800.0, 100.0
POINTS, RAYS, REPEATS = 3, 16, 8  # of a face: points and rays to a side of a square, and how often anew
ROUNDING = 1e-4  # of a share: positions in single precision, and the clearance above faces

STUDY = """site: {{north_deg: 0}}
period: {{positions: [{suns}]}}
light: {{source: fixed, dni_w_m2: {dni}, dhi_w_m2: {dhi}, sky: uniform, far_ground_albedo: 0}}
scene: {{files: [{model}], ground: none, materials: {{black: {{diffuse: 0}}}}, assign: [{{material: black}}]}}
mesh: {{oracle: none}}
solver: {{lines_per_patch: 1024, realizations: 16}}
output: {{series: [direct]}}
"""


def direction(azimuth, elevation):
    a, e = math.radians(azimuth), math.radians(elevation)
    return np.array([math.sin(a) * math.cos(e), math.cos(a) * math.cos(e), math.sin(e)])


# ---- Shadows: convex polygons in the plane of a face, cut out of it one after the other.


def side_of(p, a, b):
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def area(polygon):
    return 0.5 * sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(polygon, polygon[1:] + polygon[:1]))


def half(polygon, a, b, sign):
    """Its part left (sign 1) or right (-1) of the line from a to b."""
    kept = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        at_p, at_q = sign * side_of(p, a, b), sign * side_of(q, a, b)
        if at_p >= 0:
            kept.append(p)
        if at_p * at_q < 0:
            t = at_p / (at_p - at_q)
            kept.append((p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])))
    return kept


def without(polygon, hole):
    """Convex pieces of a polygon outside of a convex hole, both counter-clockwise."""
    pieces = []
    for a, b in zip(hole, hole[1:] + hole[:1]):
        outside = half(polygon, a, b, -1)
        if len(outside) > 2:
            pieces.append(outside)
        polygon = half(polygon, a, b, 1)
        if len(polygon) < 3:
            break
    return pieces


def hull(points):
    """Counter-clockwise convex hull (Andrew 1979)."""
    def chain(sorted_points):
        out = []
        for p in sorted_points:
            while len(out) > 1 and side_of(p, out[-2], out[-1]) <= 1e-12:
                out.pop()
            out.append(p)
        return out[:-1]
    points = sorted({(round(x, 9), round(y, 9)) for x, y in points})
    return chain(points) + chain(points[::-1])


def sunlit_share(corners, normal, cubes, sun):
    """Of a face, 0 … 1. No cube lies on both sides of a face's plane."""
    if normal @ sun <= 0:
        return 0.0
    axis = int(np.argmax(np.abs(normal)))
    u, v = [k for k in range(3) if k != axis]
    face = [(p[u], p[v]) for p in corners]
    if area(face) < 0:
        face.reverse()
    pieces = [face]
    for (x0, y0), (x1, y1) in cubes:
        cube = np.array([(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (0, HEIGHT)])
        height = (cube - corners[0]) @ normal
        if height.max() <= 1e-9:
            continue
        at = cube - np.outer(height / (normal @ sun), sun)
        shadow = hull([(p[u], p[v]) for p in at])
        pieces = [rest for piece in pieces for rest in without(piece, shadow)]
    return sum(map(area, pieces)) / area(face)


# ---- Rays against the planes of the boxes (slabs), from many points of every face at once.


def is_hidden(origins, rays, cubes):
    hidden = np.zeros(np.broadcast_shapes(origins.shape, rays.shape)[:-1], dtype=bool)
    with np.errstate(divide="ignore", invalid="ignore"):
        for low, high in cubes:
            a = (np.array([*low, 0]) - origins) / rays
            b = (np.array([*high, HEIGHT]) - origins) / rays
            enters, leaves = np.fmin(a, b).max(axis=-1), np.fmax(a, b).min(axis=-1)
            hidden |= (leaves > np.maximum(enters, 0) + 1e-9)
    return hidden


def sky_shares(corners, normal, cubes, chance):
    """Sky view factors of faces: [REPEATS][face]."""
    count = POINTS**2 * RAYS**2
    cell = np.arange(RAYS * POINTS)
    grid = np.stack(np.meshgrid(cell, cell), axis=-1).reshape(-1, 2)
    means = []
    first = np.where(np.abs(normal[:, 2:]) > 0.5, [[1.0, 0, 0]], [[0, 0, 1.0]])
    second = np.cross(normal, first)
    for _ in range(REPEATS):
        of_faces = np.empty(len(corners))
        for k, (p, n) in enumerate(zip(corners, normal)):
            on_disk = (grid + chance.random((count, 2))) / (RAYS * POINTS)
            at = (chance.permutation(grid) + chance.random((count, 2))) / (RAYS * POINTS)
            root = np.sqrt(at[:, :1])
            origins = p[0] * (1 - root) + p[1] * root * (1 - at[:, 1:]) + p[2] * root * at[:, 1:]
            radius, turn = np.sqrt(on_disk[:, :1]), 2 * math.pi * on_disk[:, 1:]
            rays = (radius * np.cos(turn) * first[k] + radius * np.sin(turn) * second[k]
                    + np.sqrt(1 - radius**2) * n)
            sees = (rays[:, 2] > 0) & ~is_hidden(origins + 1e-6 * n, rays, cubes)
            of_faces[k] = sees.mean()
        means.append(of_faces)
    return np.array(means)


def groups(normal, centroid):
    level = normal[:, 2] > 0.5
    yield "ground", level & (centroid[:, 2] < 1e-6)
    yield "roofs", level & (centroid[:, 2] > 1e-6)
    for name, axis in (("north", (0, 1, 0)), ("east", (1, 0, 0)), ("south", (0, -1, 0)), ("west", (-1, 0, 0))):
        yield f"walls to the {name}", normal @ np.array(axis) > 0.5


def mean_over(values, size, chosen):
    return (values[..., chosen] * size[chosen]).sum(axis=-1) / size[chosen].sum()


def sky_rows(section, model, result, faces, accepted):
    corners, normal, size, chosen, cubes = faces
    reference = sky_shares(corners, normal, cubes, np.random.default_rng(1))
    watts = 1000
    sky = (result["light_load_realization"][:] - result["light_load_direct"][:]) * watts / (DHI * len(SUNS))
    for name, of in chosen.items():
        truth, ours = mean_over(reference, size, of), mean_over(sky, size, of)
        error = math.sqrt(sum(v.var(ddof=1) / len(v) for v in (truth, ours)))
        yield Row(section, f"{model}: sky view factor, {name}", truth.mean(), ours.mean(), error,
                  accepted * error + ROUNDING)


def sun_rows(section, model, result, faces, number):
    corners, normal, size, chosen, cubes = faces
    sun = direction(*SUNS[number])
    cosine = normal @ sun
    lit = cosine > 1e-9
    truth = np.array([sunlit_share(c, n, cubes, sun) for c, n in zip(corners, normal)])
    ours = np.where(lit, result["irradiance_direct"][number] / (DNI * np.where(lit, cosine, 1)), 0)
    at = f"{model}, sun at azimuth %g°, elevation %g°" % SUNS[number]
    for name, of in chosen.items():
        if (lit & of).any():
            yield Row(section, f"{at}: sunlit share, {name}", mean_over(truth, size, of), mean_over(ours, size, of),
                      None, ROUNDING)
    yield Row(section, f"{at}: sunlit share, face farthest off", 0.0, np.abs(ours - truth).max(), None, 10 * ROUNDING)
    one_ray = lit & ~is_hidden(corners.mean(axis=1) + 1e-6 * normal, sun[None], cubes)
    yield Row(section, f"{at}: sunlit share by one ray from each centroid, rms over faces", 0.0,
              math.sqrt(np.mean((one_ray - truth)[lit] ** 2)), None, None)


def sections(program, tell):
    name = "the boxes of dtcc-solar: sun and sky on every face"
    tell(name)
    models = {model: of for model, of in CUBES.items() if os.path.exists(os.path.join(CITY, of[0]))}
    if not models:
        yield Section(name, "", [], skipped="needs the shared data beside the project")
        return
    suns = ", ".join("{azimuth_deg: %g, elevation_deg: %g}" % sun for sun in SUNS)
    rows = []
    for number, (model, (file, cubes)) in enumerate(models.items()):
        study = STUDY.format(suns=suns, dni=DNI, dhi=DHI, model=os.path.join(CITY, file))
        result = program.results(f"boxes_{number}", study)["baseline"]
        corners = result["vertex_position"][:][result["patch_vertices"][:]]
        normal = np.round(result["patch_normal"][:])
        faces = corners, normal, result["patch_area"][:], dict(groups(normal, corners.mean(axis=1))), cubes
        tests = len(models) * len(faces[3])
        rows += sky_rows(name, model, result, faces, t_quantile(1 - FAMILY_WISE / tests / 2, REPEATS - 1))
        for k in range(len(SUNS)):
            rows += sun_rows(name, model, result, faces, k)
    one_ray = [row.ours for row in rows if "one ray" in row.case]
    farthest = max(row.ours for row in rows if "farthest off" in row.case)
    yield Section(name, "shadows cut out of faces; rays against six planes", rows,
                  said="Meshes on which dtcc-solar was checked (data/validation of its repository), faces as they are. Of sunlit shares "
                  f"the face that is farthest off is so by {farthest:.0e}; one ray from the middle of each face, which is how that "
                  f"program and others decide, is off by {min(one_ray):.3f} … {max(one_ray):.3f} (root mean square over faces).")
