# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Furnaces: where the radiance is the same from everywhere, no body changes what is received, whatever reflects and how."""

import itertools
import math

import numpy as np

from cases import obj
from rows import Row, Section

GLOW = 100.0  # what every surface must receive [W m-2]
LIMIT = 0.002  # of it
TRANSPORTS = ("gather", "shoot", "matrix")

# What a surface keeps of the light it sends on again as its own, so that radiance stays what it is.
MATERIALS = {
    "white": "diffuse: 1",
    "grey": f"diffuse: 0.3, emission_w_m2: {0.7 * GLOW}",
    "mirror": "mirror: 1",
    "half mirror": f"diffuse: 0.2, mirror: 0.5, emission_w_m2: {0.3 * GLOW}",
    "leaves": f"diffuse: 0.3, transmittance: 0.5, sides: two, emission_w_m2: {0.2 * GLOW}",
}
# (kind of furnace, materials, transports). The matrix knows no mirrors.
FURNACES = [
    ("open", ("white",), TRANSPORTS),
    ("open", ("grey",), TRANSPORTS),
    ("open", ("mirror", "white"), TRANSPORTS[:2]),
    ("open", ("half mirror", "grey"), TRANSPORTS[:2]),
    ("open", ("leaves", "grey"), TRANSPORTS[:2]),
    ("closed", ("grey",), TRANSPORTS),
    ("closed", ("half mirror",), TRANSPORTS[:2]),
]
GLOSS = [(0.6, 0.2, 2), (0.5, 0.0, 20), (0.3, 0.5, 80)]  # glossy, diffuse, exponent

STUDY = """site: {{north_deg: 0}}
period: {{positions: [{{azimuth_deg: 180, elevation_deg: 30}}]}}
light: {{source: fixed, dni_w_m2: 0, dhi_w_m2: {sky}, sky: uniform, far_ground_albedo: {ground}}}
scene:
  files: [{model}.obj]
  ground: none
  orient: keep
  materials: {{{materials}}}
mesh: {{oracle: none, max_edge_m: 1}}
solver: {{bounces: 60, mirror_depth: 40, lines_per_patch: 1024, realizations: 16}}
output: {{series: [total]}}
variants: [{variants}]
"""


def box(low, high, inward=False):
    x, y, z = zip(low, high)
    corners = [(x[i], y[j], z[k]) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return [[corners[k] for k in (face[::-1] if inward else face)] for face in faces]


SHAPES = {
    "open": [box((0, 0, 0), (4, 1, 1)), box((0, 0, 1.5), (1, 1, 4)), box((0, 1.7, -1), (3, 3, 3))],
    "closed": [box((0, 0, 0), (3, 4, 2.5), inward=True)],
    "one": [box((0, 0, 0), (2, 2, 2))],
}


def run(program, name, kind, materials, transports):
    words = {material: material.replace(" ", "_") for material in materials}
    by_turns = itertools.cycle(words.values())
    program.write(f"{name}.obj", obj([(f"body_{k}", next(by_turns), body) for k, body in enumerate(SHAPES[kind])]))
    dark = kind == "closed"
    return program.results(name, STUDY.format(
        sky=0 if dark else GLOW, ground=0 if dark else 1, model=name,
        materials=", ".join(f"{words[key]}: {{{keys}}}" for key, keys in materials.items()),
        variants=", ".join(f"{{name: {transport}, solver: {{transport: {transport}}}}}" for transport in transports)))


def received(result):
    """Mean irradiance of each realization [W m-2]."""
    size, watts = result["patch_area"][:], 1000
    return watts * (result["light_load_realization"][:] * size).sum(axis=1) / size.sum()


def lobe_albedo(exponent):
    """Share of diffuse light that the lobe sends on (its own quadrature; geo and solver have another): the mean over
    cosine-weighted directions of (n + 2)/(2π) ∫ max(0, r·w)^n cosθ dω."""
    c, weight = np.polynomial.legendre.leggauss(200)
    c, weight = (c + 1) / 2, weight / 2
    turn = (np.arange(400) + 0.5) * math.pi / 400
    s = np.sqrt(1 - c**2)
    cosine = np.maximum(0, c[:, None, None] * c[None, :, None] + s[:, None, None] * s[None, :, None] * np.cos(turn))
    of_angle = ((exponent + 2) / (2 * math.pi) * 2 * math.pi * ((cosine**exponent).mean(axis=2) * c * weight).sum(axis=1))
    return float((2 * c * weight * of_angle).sum())


def gloss_rows(section, program):
    for number, (glossy, diffuse, exponent) in enumerate(GLOSS):
        keys = f"diffuse: {diffuse}, glossy: {glossy}, glossy_exponent: {exponent}"
        result = run(program, f"gloss_{number}", "one", {"gloss": keys}, TRANSPORTS[:1])["gather"]
        truth = GLOW * (1 - diffuse - glossy * lobe_albedo(exponent))
        size = result["patch_area"][:].sum()
        error = 1000 * float(result["power_absorbed_se"][()]) / size
        yield Row(section, f"a body with gloss {glossy:g} (exponent {exponent}) and {diffuse:g} diffuse: absorbed, W/m2", truth,
                  float(result["power_absorbed"][0]) / size, error, LIMIT * GLOW)


def sections(program, tell):
    name = "furnaces, by every model of reflection"
    tell(name)
    rows = []
    for number, (kind, materials, transports) in enumerate(FURNACES):
        results = run(program, f"furnace_{number}", kind, {m: MATERIALS[m] for m in materials}, transports)
        for transport, result in results.items():
            means = received(result)
            rows.append(Row(name, f"{kind}, {' and '.join(materials)}, {transport}: received, W/m2", GLOW, means.mean(),
                            means.std(ddof=1) / math.sqrt(len(means)), LIMIT * GLOW))
    rows += gloss_rows(name, program)
    yield Section(name, "the same radiance from everywhere", rows,
                  said="Bodies of these materials side by side and above each other in a world of one radiance, or a room whose walls "
                  "glow: every surface must receive the same. Emission stands for what is absorbed. Gloss sends on less of slanting "
                  "light: what one body keeps, by a quadrature of the lobe. Limit: 0.2 %.")
