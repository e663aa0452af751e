# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for any program: models as OBJ, points and expected numbers as CSV, in tests/validation. They are written from
the references that our own tests hold, and the page has what our program makes of the same files.

    scripts/validation/cases.py            writes them
    scripts/validation/cases.py --check    code 1 where the files are not what would be written
"""

import csv
import io
import json
import math
import os
import statistics
import sys

from rows import Row, Section

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
FOLDER = os.path.join(ROOT, "tests", "validation")
REFERENCE = os.path.join(ROOT, "tests", "reference", "07_cie171_bestest", "cie171_style.json")
FAMILY_WISE = 0.01
# What stands for infinitely wide [m], and what the reference asks of programs that sample.
FAR = 200
SHARE, POINTS = 0.01, 0.02

HEADER = ["case", "model", "sky", "sun_azimuth_deg", "sun_elevation_deg", "dni_w_m2", "dhi_w_m2", "ground_albedo",
          "surface_reflectance", "reflections", "x", "y", "z", "nx", "ny", "nz", "expected_w_m2", "tolerance_w_m2"]


def holed(corner, across, up, width, height, hole):
    """Rectangles of a wall with a rectangular hole (from, to across; from, to up)."""
    a, b, c, d = hole
    for x0, x1, y0, y1 in ((0, width, 0, c), (0, width, d, height), (0, a, c, d), (b, width, c, d)):
        if x1 > x0 and y1 > y0:
            yield [tuple(corner[k] + across[k] * x + up[k] * y for k in range(3))
                   for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]


def room(opening):
    """Rectangles of a room of 4 x 4 x 3 m; fronts look inward. `opening`: side of the one in the roof, or None: a
    window in the east wall."""
    yield [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    yield [(0, 0, 0), (0, 0, 3), (4, 0, 3), (4, 0, 0)]
    yield [(0, 4, 0), (4, 4, 0), (4, 4, 3), (0, 4, 3)]
    yield [(0, 0, 0), (0, 4, 0), (0, 4, 3), (0, 0, 3)]
    if opening:
        low, high = 2 - opening / 2, 2 + opening / 2
        yield [(4, 0, 0), (4, 0, 3), (4, 4, 3), (4, 4, 0)]
        yield from holed((0, 0, 3), (0, 1, 0), (1, 0, 0), 4, 4, (low, high, low, high))
    else:
        yield [(0, 0, 3), (0, 4, 3), (4, 4, 3), (4, 0, 3)]
        yield from holed((4, 0, 0), (0, 0, 1), (0, 1, 0), 3, 4, (1, 2, 1, 3))


MODELS = {
    "roof_1": lambda: [*room(1)],
    "roof_4": lambda: [*room(4)],
    "facade": lambda: [*room(None)],
    "overhang": lambda: [*room(None), [(4, -FAR, 2), (5, -FAR, 2), (5, FAR, 2), (4, FAR, 2)]],
    "vertical_mask": lambda: [*room(None), [(9, -FAR, 0), (9, FAR, 0), (9, FAR, 4), (9, -FAR, 4)]],
    "rectangle_4": lambda: [[(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]],
    "rectangle_2": lambda: [[(1, 1, 0), (3, 1, 0), (3, 3, 0), (1, 3, 0)]],
}


def obj(rectangles):
    lines = ["o surfaces", "usemtl surface"] + ["v %g %g %g" % p for r in rectangles for p in r]
    lines += ["f %d %d %d %d" % tuple(4 * k + 1 + i for i in range(4)) for k in range(len(rectangles))]
    return "\n".join(lines) + "\n"


def references():
    with open(REFERENCE, encoding="utf-8") as file:
        return json.load(file)["cases"]


def rows_of(case):
    """Rows of a case of the reference: one for each point."""
    name, common = case["id"], {"case": case["id"]}
    if name.startswith("diffuse_reflection"):
        common |= {"model": "rectangle_%d" % (case["rectangle"][2] - case["rectangle"][0]), "sky": "uniform",
                   "sun_azimuth_deg": 0, "sun_elevation_deg": 90, "dni_w_m2": case["E"], "dhi_w_m2": 0,
                   "ground_albedo": 0, "surface_reflectance": case["rho"], "reflections": 1}
        expected = case["irradiance"]
    else:
        ground = case.get("ground_reflectance", 0)
        model = next((m for m in MODELS if name.startswith(m)), "facade")
        common |= {"model": model, "sky": case.get("sky", "uniform"), "sun_azimuth_deg": case.get("sun_azimuth_deg", 0),
                   "sun_elevation_deg": 90 - case.get("sun_zenith_deg", 0), "dni_w_m2": 0, "dhi_w_m2": 100,
                   "ground_albedo": ground, "surface_reflectance": 0, "reflections": 0}
        expected = case.get("sky_component_percent") or case["external_component_percent"]
    for k, at in enumerate(case["points"]):
        normal = case["normal"] if "normal" in case else case["normals"][k]
        yield common | dict(zip(HEADER[10:], (*at, *normal, expected[k], round(SHARE * expected[k] + POINTS, 8))))


def all_rows():
    kinds = ("roof_", "facade", "overhang", "vertical_mask", "ground_reflected", "diffuse_reflection")
    return [row for case in references() if case["id"].startswith(kinds) for row in rows_of(case)]


def files():
    """{name: text} of what lies in the folder, but its README."""
    text = io.StringIO()
    table = csv.DictWriter(text, HEADER, lineterminator="\n")
    table.writeheader()
    table.writerows(all_rows())
    return {"points.csv": text.getvalue()} | {f"{name}.obj": obj(made()) for name, made in MODELS.items()}


def sky_keys(word):
    if word.startswith("cie"):
        return f"sky: cie_general, sky_type: {word[3:]}"
    return "sky: " + {"overcast": "cie_overcast", "kittler": "cie_clear"}.get(word, word)


# The room looks inward, and so do the fronts of its faces.
STUDY = """site: {{north_deg: 0}}
period: {{positions: [{{azimuth_deg: {sun_azimuth_deg}, elevation_deg: {sun_elevation_deg}}}]}}
light: {{source: fixed, dni_w_m2: {dni_w_m2}, dhi_w_m2: {dhi_w_m2}, {sky}, far_ground_albedo: {ground_albedo}}}
scene:
  files: [{model}.obj]
  ground: none
  orient: keep
  materials: {{surface: {{diffuse: {surface_reflectance}, sides: two}}}}
mesh: {{oracle: none}}
solver: {{bounces: {reflections}, unfollowed: leave, lines_per_patch: 65536, realizations: 16}}
output: {{series: [total]}}
sensors: {{points: [{points}]}}
"""


def sections(program, tell):
    name = "points under skies, by files that any program reads"
    tell(name)
    for file, text in files().items():
        program.write(file, text)
    together = {}
    for row in all_rows():
        together.setdefault(row["case"], []).append(row)
    accepted = statistics.NormalDist().inv_cdf(1 - FAMILY_WISE / len(all_rows()) / 2)
    rows = []
    for case, points in together.items():
        places = ", ".join("{position_m: [%r, %r, %r], normal: [%r, %r, %r]}" % tuple(p[k] for k in HEADER[10:16])
                           for p in points)
        study = STUDY.format(**(points[0] | {"sky": sky_keys(points[0]["sky"]), "points": places}))
        result = program.results("case_" + case.replace(".", "_"), study)["baseline"]
        watts = 1000  # of a light load of an hour
        for k, point in enumerate(points):
            error = watts * float(result["sensor_light_load_se"][k])
            rows.append(Row(name, f"{case} {k + 1}, W/m2", point["expected_w_m2"],
                            watts * float(result["sensor_light_load"][k]), error,
                            point["tolerance_w_m2"] + accepted * error))
    yield Section(name, "own quadrature, after CIE 171 5.5 to 5.14", rows,
                  said="Inputs and expected numbers: tests/validation. The tables of CIE 171 itself are not public.")


def main():
    written = files()
    if sys.argv[1:] == ["--check"]:
        stale = []
        for name, text in written.items():
            path = os.path.join(FOLDER, name)
            if not os.path.exists(path) or open(path, encoding="utf-8").read() != text:
                stale.append(path)
        for path in stale:
            print(f"{path}: not what scripts/validation/cases.py writes", file=sys.stderr)
        return 1 if stale else 0
    os.makedirs(FOLDER, exist_ok=True)
    for name, text in written.items():
        with open(os.path.join(FOLDER, name), "w", encoding="utf-8") as file:
            file.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
