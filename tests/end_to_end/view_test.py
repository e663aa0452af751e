#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`sunload view` in headless Chromium: colours, clicks and times are those of the result file.

view_test.py SUNLOAD SOURCE_FOLDER PACKAGES_OF_THE_VIEWER
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile

from skip import skip
from small_study import SQUARE

# A name that would be a program, were it not escaped.
EVIL = "house</script><img/src=x/onerror=console.error(1)>"
STUDY = """format: sunload-study-1
name: square
site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}
period: {days: [2026-03-21, 2026-06-21], from: "06:00", to: "18:00", step_min: 60}
light: {source: clear_sky}
scene:
  files: [square.obj]
  materials: {paving: {diffuse: 0.3}, plaster: {diffuse: 0.6}, glass: {diffuse: 0.05, mirror: 0.85}}
mesh: {max_edge_m: 3, oracle: none}
solver: {lines_per_patch: 64, batch_suns: 8}
sensors: {points: [{position_m: [-8, -6, 2], normal: [0, 0, 1]}, {position_m: [0, 0, 1], normal: [0, -1, 0]}]}
variants:
  - {name: baseline}
  - {name: bright, scene: {materials: {plaster: {diffuse: 0.9}}}}
  - {name: fine, mesh: {max_edge_m: 1.8}}
  - {name: raised, scene: {edit: [{object: "house*", raise: {by_m: 2}}]}}
  - {name: bare, scene: {edit: [{object: square, remove: true}]}}
"""
# Of 255: the palette's texture and the legend's rounding are one each.
COLOUR_STEPS = 2
# Half a unit of the third digit, at worst of 1.00...
THREE_DIGITS = 5.5e-3


def missing(packages):
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if not chromium:
        return "chromium is not installed"
    if not shutil.which("node"):
        return "node is not installed"
    if not os.path.isdir(os.path.join(packages, "node_modules/playwright-core")):
        return "npm has not installed the viewer's packages (see the build's output)"
    return ""


def run(words, **options):
    ran = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
    assert ran.returncode == 0, f"{words}: {ran.returncode}\n{ran.stdout}{ran.stderr}"
    return ran.stdout


def write(folder, texts):
    for name, text in texts.items():
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)


class Pictures:
    def __init__(self, folder):
        self.folder = folder

    def __getitem__(self, name):
        import matplotlib.image
        return np.round(matplotlib.image.imread(os.path.join(self.folder, name + ".png"))[..., :3] * 255)

    def at(self, name, patches):
        picture = self[name]
        return np.array([picture[int(p["y"]), int(p["x"])] for p in patches])


def wanted_colours(kind, values, limit):
    import drawing
    colours = np.round(255 * drawing.palette(kind)(np.arange(256))[:, :3])
    return colours[np.floor(np.clip(np.asarray(values) / limit, 0, 1) * 255 + 0.5).astype(int)]


def assert_colours(pictures, name, patches, kind, values, limit):
    apart = np.abs(pictures.at(name, patches) - wanted_colours(kind, values, limit)).max(axis=1)
    # A value halfway between two steps of the palette may have either; the steps are 1 or 2 apart.
    assert (apart <= 2 * COLOUR_STEPS).all(), f"{name}: {apart.max()} of 255 beside the value's colour"


def number(text):
    return float(text.split()[0])


def test_page(seen, pictures, path, other):
    assert seen["errors"] == [], seen["errors"]
    assert seen["requests"] == [], f"the page wants {seen['requests']}"
    patches = seen["patches"]
    assert len(patches) >= 15, f"only {len(patches)} patches can be seen"
    ids = [p["patch"] for p in patches]
    with h5py.File(path) as result, h5py.File(other) as bright:
        load = result["light_load"][...]
        assert_colours(pictures, "light_load", patches, "false", load[ids], seen["limit"])
        assert_colours(pictures, "grey", patches, "grey", load[ids], seen["limit"])
        # The planted fault: values of the neighbours in the file.
        try:
            assert_colours(pictures, "light_load", patches, "false", np.roll(load, 7)[ids], seen["limit"])
        except AssertionError:
            pass
        else:
            raise AssertionError("the comparison of colours sees nothing")
        for k, said in seen["times"].items():
            assert_colours(pictures, f"time-{k}", patches, "false", result["irradiance"][int(k)][ids], said["limit"])
        last = max(seen["times"], key=int)
        assert seen["userLimit"] == 123
        assert_colours(pictures, "limit", patches, "false", result["irradiance"][int(last)][ids], 123)
        test_ends(seen, result, bright)
        test_clicks(seen, result, bright, int(seen["dayTime"]))
        test_sensor(seen, pictures, result)
        test_materials(seen, pictures, patches, result)
        test_difference(seen, pictures, patches, bright["light_load"][...][ids] - load[ids])
    test_drawings(seen, pictures)


def rounded_up(value):
    power = 10 ** np.floor(np.log10(value))
    return next(d * power for d in (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10) if d * power >= value * (1 - 1e-9))


def scale_end(values, area):
    """Value that 99.5 % of the area do not exceed."""
    known = np.isfinite(values)
    order = np.argsort(values[known])
    below = np.cumsum(area[known][order])
    return values[known][order][np.searchsorted(below, 0.995 * below[-1])]


def test_ends(seen, result, bright):
    """One end for all times, of light and of differences; it opens where there is most light."""
    area, series = result["patch_area"][...], [file["irradiance"][...] for file in (result, bright)]
    wanted = rounded_up(max(scale_end(row, area) for one in series for row in one))
    assert all(np.isclose(said["limit"], wanted) for said in seen["times"].values()), (seen["times"], wanted)
    wanted = rounded_up(max(scale_end(np.abs(row), area) for row in series[1] - series[0]))
    assert np.isclose(seen["differenceLimitOfSeries"], wanted), (seen["differenceLimitOfSeries"], wanted)
    assert seen["dayTime"] == np.argmax(result["ghi"][...]), seen["dayTime"]


def test_clicks(seen, result, bright, k):
    for click in seen["clicks"]:
        rows = {row[0] or row[1]: row[1:] for row in click["rows"]}
        assert int(rows["patch"][1]) == click["patch"], rows
        names = [row[0] for row in click["rows"] if row[0]]
        assert {"light_load", "light_load_se", "sun_hours", "power_load", "irradiance"} <= set(names), names
        for name in names:
            for file, text in zip((result, bright), rows[name][1:]):
                stored = file[name][k][click["patch"]] if name == "irradiance" else file[name][click["patch"]]
                assert abs(number(text) - stored) <= THREE_DIGITS * abs(stored) + 1e-12, (name, text, stored)
        assert rows["object"][1] in (EVIL, "square"), rows["object"]
    assert any(EVIL in str(click["rows"]) for click in seen["clicks"]), seen["clicks"]


def test_sensor(seen, pictures, result):
    rows = {row[0]: row[2] for row in seen["sensor"]["rows"] if row[0]}
    [position] = [row[2] for row in seen["sensor"]["rows"] if row[1] == "position [m]"]
    assert position == "-8, -6, 2", position
    for name, data in (("light_load", "sensor_light_load"), ("sun_hours", "sensor_sun_hours"), ("irradiance", "sensor_irradiance")):
        value = result[data][0] if result[data].ndim == 1 else result[data][int(seen["dayTime"]), 0]
        assert abs(number(rows[name]) - value) <= THREE_DIGITS * value, (name, rows[name], value)
    place = [{"x": seen["sensor"]["x"], "y": seen["sensor"]["y"]}]
    assert_colours(pictures, "sensor", place, "false", [result["sensor_light_load"][0]], seen["limit"])


def test_materials(seen, pictures, patches, result):
    """Each material has a colour of its own, shaded by the turn of the patch."""
    ids = [p["patch"] for p in patches]
    normal, material = result["patch_normal"][...][ids], result["patch_material"][...][ids]
    names = list(result["material_name"].asstr())
    assert set(seen["materials"]) == {names[k] for k in np.unique(result["patch_material"][...])} | {"sensors"}, seen["materials"]
    shade = 0.5 + 0.2 * normal[:, 2] + 0.3 * np.maximum(0, normal @ [0.4, -0.6, 0.7])
    base = pictures.at("materials", patches) / shade[:, None]
    middles = {k: np.median(base[material == k], axis=0) for k in np.unique(material)}
    for k, colour in middles.items():
        # Half a step of 255 is rounded, and the shade is at least a quarter.
        assert np.abs(base[material == k] - colour).max() <= 4, f"material {names[k]} has several colours"
    colours = list(middles.values())
    assert all(np.abs(a - b).max() > 30 for i, a in enumerate(colours) for b in colours[:i]), colours


def test_difference(seen, pictures, patches, difference):
    """Blue where less, orange where more, near white where the same."""
    assert seen["unmatchedShare"] == 0 and seen["differenceLimit"] > 0
    colour = pictures.at("difference", patches)
    share = difference / seen["differenceLimit"]
    warm = colour[:, 0] - colour[:, 2]
    assert (warm[share > 0.1] > 0).all() and (warm[share < -0.1] < 0).all(), (share, warm)
    assert (share > 0.1).any(), "nothing differs"
    assert (np.abs(warm[np.abs(share) < 0.003]) < 12).all(), (share, warm)


def test_drawings(seen, pictures):
    first, last = sorted(seen["times"], key=int)
    assert seen["times"][first]["clock"] != seen["times"][last]["clock"]

    def apart(one, other):
        return (np.abs(pictures[one] - pictures[other]).max(axis=2) > 4).mean()

    for one, other, least in ((f"time-{first}", f"time-{last}", 0.05), ("smooth", "limit", 0.02),
                              ("mesh-after", f"time-{last}", 0.01), ("preview", "light_load", 0.05),
                              ("orbit", "light_load", 0.001), ("walk", "orbit", 0.2), ("side", "light_load", 0.05)):
        assert apart(one, other) > least, f"{one} and {other} are the same picture"
    lines = [apart(f"mesh-{which}", f"time-{last}") for which in ("before", "after")]
    assert 0 < lines[0] < lines[1], f"lines before and after refinement: {lines}"
    start, end = (np.array(place) for place in seen["walked"])
    assert np.hypot(*(end - start)[:2]) > 0.3 and abs(end[2] - start[2]) < 8, seen["walked"]
    assert seen["played"][0] != seen["played"][1]


def test_match(probe, folder, sunload):
    """Patches of other sizes: what a result brings onto the patches of the other keeps its energy."""
    coarse, fine = (os.path.join(folder, f"results/square/{name}.h5") for name in ("baseline", "fine"))
    for one, other in ((coarse, fine), (fine, coarse)):
        page = os.path.join(folder, "match.html")
        run([sunload, "view", one, other, "-o", page])
        seen = json.loads(run([*probe, page, folder, "match"]))
        with h5py.File(one) as first, h5py.File(other) as second:
            assert len(first["patch_area"]) != len(second["patch_area"])
            whole = (second["light_load"][...] * second["patch_area"][...]).sum()
        assert seen["unmatchedShare"] == 0 and abs(seen["matchedKwh"] - whole) < 1e-5 * whole, (seen, whole)


TWO_HOUSES = """v 0 0 0
v 8 0 0
v 8 8 0
v 0 8 0
v 0 0 6
v 8 0 6
v 8 8 6
v 0 8 6
v 28 0 0
v 36 0 0
v 36 8 0
v 28 8 0
v 28 0 6
v 36 0 6
v 36 8 6
v 28 8 6
o west
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
o east
f 9 12 11 10
f 13 14 15 16
f 9 10 14 13
f 10 11 15 14
f 11 12 16 15
f 12 9 13 16
"""


def test_pairs(probe, folder, sunload):
    """Of a house that is raised the walls have differences where `sunload compare` has them, and the same."""
    base, raised = (os.path.join(folder, f"results/square/{name}.h5") for name in ("baseline", "raised"))
    for one, other in ((base, raised), (raised, base)):
        page, compared = (os.path.join(folder, name) for name in ("pairs.html", "pairs.h5"))
        run([sunload, "view", one, other, "-o", page])
        run([sunload, "compare", one, other, "--hdf5", compared])
        seen = json.loads(run([*probe, page, folder, "match"]))
        with h5py.File(compared) as file:
            wanted, names = file["light_load_difference"][...], file["object_name"].asstr()[...][file["patch_object"][...]]
        own = np.array([np.nan if value is None else value for value in seen["differences"]])
        assert 0 < seen["unmatchedShare"] < 0.5 and (np.isnan(own) == np.isnan(wanted)).all(), (seen["unmatchedShare"], np.isnan(own).sum(), np.isnan(wanted).sum())
        assert np.isfinite(own[names == EVIL]).any(), "no wall of the house is compared"
        assert np.allclose(own, wanted, rtol=1e-4, atol=1e-5, equal_nan=True), np.nanmax(np.abs(own - wanted))


def test_names_of_materials(probe, folder, sunload):
    """A material has one colour in both results, whatever its number in each, and one place in the legend."""
    bare, base = (os.path.join(folder, f"results/square/{name}.h5") for name in ("bare", "baseline"))
    page = os.path.join(folder, "bare.html")
    run([sunload, "view", bare, base, "-o", page])
    seen = json.loads(run([*probe, page, folder, "match"]))
    with h5py.File(bare) as first, h5py.File(base) as second:
        lists = [list(file["material_name"].asstr()) for file in (first, second)]
    assert any(lists[0].index(name) != lists[1].index(name) for name in set(lists[0]) & set(lists[1])), lists
    for names, colours in zip(lists, seen["coloursOfMaterials"]):
        for name, colour in zip(names, colours):
            assert colour == dict(zip(lists[0], seen["coloursOfMaterials"][0])).get(name, colour), (lists, seen["coloursOfMaterials"])
    assert sorted(seen["legend"]) == sorted({*lists[0], *lists[1], "sensors"}), seen["legend"]


def test_frames(probe, folder, sunload):
    """Of a place on a map without one of its houses: the frame's origin is elsewhere, what is left is not."""
    study = STUDY.replace("name: square", "name: town").replace("fine, mesh: {max_edge_m: 1.8}", "east, scene: {edit: [{object: west, remove: true}]}")
    study = study.replace("files: [square.obj]", "files: [{file: town.obj, position_m: [345000, 6297000, 0]}]")
    study = "".join(line for line in study.splitlines(True) if not line.startswith(("sensors", "  materials")) and "bright" not in line and "raised" not in line and "bare" not in line)
    write(folder, {"town.obj": TWO_HOUSES, "town.yaml": study})
    run([sunload, "run", "town.yaml"], cwd=folder)
    both, east = (os.path.join(folder, f"results/town/{name}.h5") for name in ("baseline", "east"))
    page = os.path.join(folder, "town.html")
    run([sunload, "view", east, both, "-o", page])
    seen = json.loads(run([*probe, page, folder, "match"]))
    with h5py.File(east) as first, h5py.File(both) as second:
        assert (first.attrs["origin"] != second.attrs["origin"]).any()
        of_east = second["object_name"].asstr()[...][second["patch_object"][...]] == "east"
        whole = (second["light_load"][...] * second["patch_area"][...])[of_east].sum()
    assert seen["unmatchedShare"] == 0 and abs(seen["matchedKwh"] - whole) < 1e-5 * whole, (seen, whole)


def test_flight(probe, folder, sunload):
    """Before a wall behind a higher house most of it is seen, not its middle alone."""
    obj = "\n".join(" ".join({"28": "18", "36": "26"}.get(word, word) for word in line.split()) for line in TWO_HOUSES.splitlines())
    # Of the height from which the wall's middle is seen from 30° up, and its lower part is not.
    for corner in ("18 0", "26 0", "26 8", "18 8"):
        obj = obj.replace(f"v {corner} 6", f"v {corner} 8.5")
    study = "".join(line for line in STUDY.splitlines(True) if not line.startswith(("sensors", "  materials", "variants", "  - ")))
    write(folder, {"tower.obj": obj, "tower.yaml": study.replace("square.obj", "tower.obj").replace("max_edge_m: 3", "max_edge_m: 1")})
    page = os.path.join(folder, "tower.html")
    run([sunload, "view", "tower.yaml", "-o", page], cwd=folder)
    seen = json.loads(run([*probe, page, folder, "fly"]))
    assert len(seen["flights"]) == 8, seen["flights"]
    for name, share in seen["flights"].items():
        assert share >= 0.65, seen["flights"]


def test_refusals(sunload, folder, path, probe):
    page = os.path.join(folder, "no.html")
    for words, code, says in ((["missing.h5", "-o", page], 2, "missing.h5"), ([path, path, path, "-o", page], 2, "two"),
                              ([path, "-o", os.path.join(folder, "no/such/page.html")], 3, "page.html"),
                              ([path], 2, "--output")):
        ran = subprocess.run([sunload, "view", *words], stderr=subprocess.PIPE, text=True, cwd=folder)
        assert ran.returncode == code and says in ran.stderr, f"{words}: {ran.returncode} {ran.stderr}"
    assert not os.path.exists(page)
    ran = subprocess.run([sunload, "view", path, "-o", page, "--step", "5"], stderr=subprocess.PIPE, text=True)
    assert ran.returncode == 0 and "5" in ran.stderr, "intervals are left out silently"
    seen = json.loads(run([*probe, page, folder, "one"]))
    assert seen["errors"] == [] and seen["slider"] == "4", seen  # of 24 intervals the 0th, 5th, … 20th
    with h5py.File(path) as result:
        values = result["light_load"][...][[p["patch"] for p in seen["patches"]]]
    assert_colours(Pictures(folder), "one", seen["patches"], "false", values, seen["limit"])


def test(sunload, source, packages, folder):
    sys.path.insert(0, os.path.join(source, "scripts/plot"))
    sys.dont_write_bytecode = True
    write(folder, {"square.obj": SQUARE.replace("o house", "o " + EVIL), "square.yaml": STUDY})
    run([sunload, "run", "square.yaml"], cwd=folder)
    path, other = (os.path.join(folder, f"results/square/{name}.h5") for name in ("baseline", "bright"))
    page = os.path.join(folder, "page.html")
    run([sunload, "view", path, other, "-o", page])
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    probe = ["node", os.path.join(os.path.dirname(os.path.abspath(__file__)), "view_probe.mjs"), packages, chromium]
    seen = json.loads(run([*probe, page, folder]))
    test_page(seen, Pictures(folder), path, other)
    test_match(probe, folder, sunload)
    test_pairs(probe, folder, sunload)
    test_names_of_materials(probe, folder, sunload)
    test_frames(probe, folder, sunload)
    test_flight(probe, folder, sunload)
    test_refusals(sunload, folder, path, probe)
    print(f"{len(seen['patches'])} patches have the colours of their values, {len(seen['clicks'])} clicks told them; "
          f"{seen['framesPerSecond']:.0f} frames/s")


def main():
    sunload, source, packages = (os.path.abspath(word) for word in sys.argv[1:4])
    why = lacking or missing(packages)
    if why:
        skip(why)
    with tempfile.TemporaryDirectory(prefix="sunload-view-") as folder:
        test(sunload, source, packages, folder)


try:
    import h5py
    import matplotlib  # noqa: F401
    import numpy as np
    lacking = ""
except ImportError as error:
    lacking = f"{error.name} is not installed (python3-h5py, python3-matplotlib)"

if __name__ == "__main__":
    main()
