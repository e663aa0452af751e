# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Method against method: random small cities, solved by transports that share no random number."""

import math
import statistics

import numpy as np

from rows import Row, Section

CITIES = 20
FAMILY_WISE = 0.01
REALIZATIONS = 16
SURFACES = ("wall", "roof", "ground")
PAIRS = (("gather", "shoot"), ("gather", "matrix"), ("shoot", "matrix"))


def city(number):
    """An OBJ of houses on a plate of 60 m: one box for each cell of a grid that chance leaves filled."""
    chance = np.random.default_rng(number)
    vertices, faces = [], []

    def quad(corners):
        vertices.extend(corners)
        faces.append([len(vertices) - 3 + k for k in range(4)])

    quad([(-30, -30, 0), (30, -30, 0), (30, 30, 0), (-30, 30, 0)])
    lines = ["o ground"]
    for column in range(3):
        for row in range(3):
            if chance.random() < 0.25:
                continue
            x, y = -20 + 20 * column + chance.uniform(-3, 3), -20 + 20 * row + chance.uniform(-3, 3)
            a, b, h = chance.uniform(3, 6), chance.uniform(3, 6), chance.uniform(4, 25)
            foot = [(x - a, y - b), (x + a, y - b), (x + a, y + b), (x - a, y + b)]
            for k in range(4):
                p, q = foot[k], foot[(k + 1) % 4]
                quad([(*p, 0), (*q, 0), (*q, h), (*p, h)])
            quad([(*p, h) for p in foot])
    lines += ["v %.6f %.6f %.6f" % v for v in vertices]
    lines += ["f " + " ".join(map(str, face)) for face in faces[:1]] + ["o houses"]
    lines += ["f " + " ".join(map(str, face)) for face in faces[1:]]
    return "\n".join(lines) + "\n"


STUDY = """site: {{latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}}
period: {{days: [2026-0{month}-21], from: "08:00", to: "16:00", step_min: 120}}
light: {{source: clear_sky}}
scene:
  files: [{{file: {city}, material: wall}}]
  ground: none
  materials: {{wall: {{diffuse: {albedo}}}}}
mesh: {{max_edge_m: 8, oracle: none}}
solver: {{lines_per_patch: 256, realizations: 16, direct_samples: 32}}
variants:
  - {{name: gather}}
  - {{name: shoot, solver: {{transport: shoot, seed: 2}}}}
  - {{name: matrix, solver: {{transport: matrix, seed: 3}}}}
"""


def group_means(result, surface):
    """Light load of the patches of that kind, mean by area, of each realization [kWh m-2]."""
    level = result["patch_normal"][:, 2] > 0.5
    high = result["patch_centroid"][:, 2] > result["patch_centroid"][:, 2].min() + 1
    chosen = {"ground": level & ~high, "roof": level & high, "wall": ~level}[surface]
    area = result["patch_area"][:][chosen]
    return (result["light_load_realization"][:][:, chosen] * area).sum(axis=1) / area.sum()


def t_quantile(p, freedom):
    """Of Student's distribution, by Abramowitz & Stegun 26.7.5 (four terms)."""
    z = statistics.NormalDist().inv_cdf(p)
    return (z + (z**3 + z) / (4 * freedom) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * freedom**2)
            + (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / (384 * freedom**3)
            + (79 * z**9 + 776 * z**7 + 1482 * z**5 - 1920 * z**3 - 945 * z) / (92160 * freedom**4))


def sections(program, tell):
    name = f"{CITIES} random cities: three transports"
    tell(name)
    tests = CITIES * len(SURFACES) * len(PAIRS)
    each = 1 - (1 - FAMILY_WISE) ** (1 / tests)  # Šidák
    accepted = t_quantile(1 - each / 2, 2 * (REALIZATIONS - 1))
    rows = []
    for number in range(CITIES):
        model = f"city_{number}.obj"
        program.write(model, city(number))
        albedo = 0.2 + 0.5 * number / CITIES
        results = program.results(f"city_{number}", STUDY.format(city=model, albedo=albedo, month=3 + number % 4))
        for surface in SURFACES:
            means = {transport: group_means(result, surface) for transport, result in results.items()}
            for one, other in PAIRS:
                a, b = means[one], means[other]
                error = math.sqrt((a.var(ddof=1) + b.var(ddof=1)) / REALIZATIONS)
                rows.append(Row(name, f"city {number}, {surface}, {other} against {one}, kWh/m2", a.mean(), b.mean(),
                                error, accepted * error))
    yield Section(name, "each other; family-wise 1 %", rows,
                  said="Seeds differ, so that the transports share no random number.")
