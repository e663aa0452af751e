#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses the page of `sunload view` in headless Chromium: panels, names, charts, address, pictures, keys, touch.

view_use_test.py SUNLOAD SOURCE_FOLDER PACKAGES_OF_THE_VIEWER
"""

import json
import os
import shutil
import sys
import tempfile

from skip import skip
from small_study import SQUARE
import view_test
from view_test import THREE_DIGITS, missing, number, run

STUDY = """format: sunload-study-1
name: square
site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}
period: {days: [2026-03-21, 2026-03-22, 2026-06-21], from: "06:00", to: "18:00", step_min: 40}
light: {source: clear_sky}
scene:
  files: [square.obj]
  materials: {paving: {diffuse: 0.3}, plaster: {diffuse: 0.6}, glass: {diffuse: 0.05, mirror: 0.85}}
mesh: {max_edge_m: 2, oracle: none}
solver: {lines_per_patch: 64}
output: {series: [SERIES], totals: [month, day]}
variants:
  - {name: baseline}
  - {name: bright, scene: {materials: {plaster: {diffuse: 0.9}}}}
"""
KWH_PER_J = 1 / 3.6e6
# Values travel as floats.
FLOATS = 2e-7
# Boxes of a page are rounded to its pixels.
PIXEL = 1.0
# Of 255, as in the shader: products are rounded once.
SHADE_STEPS = 2
DEEPEST_SHADE = 0.22


def overlaps(boxes):
    """Pairs of boxes with an area in common."""
    names = sorted(boxes)
    return [(a, b) for i, a in enumerate(names) for b in names[:i]
            if min(boxes[a][2], boxes[b][2]) - max(boxes[a][0], boxes[b][0]) > PIXEL
            and min(boxes[a][3], boxes[b][3]) - max(boxes[a][1], boxes[b][1]) > PIXEL]


def test_layouts(seen):
    assert overlaps(seen["onPicture"]), "the search for overlaps sees nothing"
    for layout in seen["layouts"]:
        boxes, where = layout["boxes"], f"{layout['width']} × {layout['height']}, {layout['name']}"
        assert not overlaps(boxes), f"{where}: {overlaps(boxes)} {boxes}"
        for name, (left, top, right, bottom) in boxes.items():
            assert left >= -PIXEL and top >= -PIXEL and right <= layout["width"] + PIXEL and bottom <= layout["height"] + PIXEL, (where, name, boxes)
        pictures = [box for name, box in boxes.items() if name.startswith("picture")]
        captions = [box for name, box in boxes.items() if name.startswith("caption")]
        assert len(pictures) == len(captions) == {"side": 2, "kinds": 2, "all": 3, "chosen": 1}.get(layout["name"], len(pictures)), where
        for picture, caption in zip(pictures, captions):
            assert abs(caption[1] - picture[3]) <= PIXEL, f"{where}: a caption is not below its picture"
        share = sum((b[2] - b[0]) * (b[3] - b[1]) for b in pictures) / layout["width"] / layout["height"]
        # Folded panels leave the window to the picture; with all of them open it still is what one sees first.
        assert share > (0.8 if layout["name"] == "folded" and layout["height"] > 500 else 0.1), f"{where}: the picture has {share:.2f} of the window"


def test_found(seen, result, facade):
    assert seen["near"][0].startswith("no such name") and any(row.startswith("house") for row in seen["near"]), seen["near"]
    wanted = [name for name in result["facade_name"].asstr() if name.startswith("house/s")]
    assert [row for row in seen["pattern"] if row.endswith("facade")] == [name + "facade" for name in wanted], seen["pattern"]
    assert seen["chosen"] == f"facade {facade}", seen["chosen"]
    flown = seen["flown"]
    assert flown["inside"] == flown["patches"] > 0 and flown["met"] >= 0.9 * flown["patches"], flown


def test_values(seen, files, facade):
    rows = {row[0]: row[1:] for row in seen["rows"]}
    for k, file in enumerate(files):
        of = list(file["facade_name"].asstr()).index(facade)
        load, area = file["facade_light_load"][of], file["facade_area"][of]
        for name, value in (("light_load", load), ("light_load_se", file["facade_light_load_se"][of]), ("energy", load * area)):
            assert abs(number(rows[name][k]) - value) <= THREE_DIGITS * value, (name, rows[name], value)


def test_charts(seen, files, facade):
    import datetime
    import zoneinfo
    zone = zoneinfo.ZoneInfo("Europe/Prague")
    for k, file in enumerate(files):
        of = list(file["facade_name"].asstr()).index(facade)
        begin, end = file["time_bounds"][...].T
        power, seconds = file["facade_irradiance"][:, of].astype(float), end - begin
        stamps = [datetime.datetime.fromtimestamp(t, zone) for t in begin]
        for kind, pattern in (("days", "%Y-%m-%d"), ("months", "%Y-%m")):
            wanted = {}
            for stamp, energy in zip(stamps, power * seconds * KWH_PER_J):
                wanted[stamp.strftime(pattern)] = wanted.get(stamp.strftime(pattern), 0) + energy
            assert seen["charts"][kind]["names"] == list(wanted), seen["charts"][kind]
            assert np.allclose(seen["charts"][kind]["values"][k], list(wanted.values()), rtol=THREE_DIGITS), (kind, seen["charts"][kind], wanted)
            assert "kWh/m²" in seen["charts"][kind]["says"], seen["charts"][kind]
        # Every minute in its hour.
        sums = np.zeros((24, 2))
        for stamp, value, length in zip(stamps, power, seconds):
            for minute in range(round(length / 60)):
                sums[(stamp + datetime.timedelta(minutes=minute)).hour] += (value, 1)
        hours = np.flatnonzero(sums[:, 1])
        chart = seen["charts"]["hours"]
        assert chart["names"] == [str(h) for h in hours], chart
        assert np.allclose(chart["values"][k], sums[hours, 0] / sums[hours, 1], rtol=THREE_DIGITS), (chart, sums)


def picture(folder, name):
    return np.round(matplotlib.image.imread(os.path.join(folder, name + ".png"))[..., :3] * 255)


def part_of(image, box):
    left, top, right, bottom = (int(round(x)) for x in box)
    return image[top:bottom, left:right]


def test_parts(seen, files):
    """Stored totals of months and days are what the file has."""
    for k, file in enumerate(files):
        house = list(file["object_name"].asstr()).index("house")
        own, area, months = file["patch_object"][...] == house, file["patch_area"][...], file["light_load_by_month"][...]
        wanted = (months[:, own] * area[own]).sum(axis=1) / area[own].sum()
        assert seen["months"]["names"] == list(file["month"].asstr()) == ["2026-03", "2026-06"], seen["months"]
        assert np.allclose(seen["months"]["values"][k], wanted, rtol=FLOATS), (seen["months"], wanted)
    assert np.allclose(seen["june"]["values"], files[1]["light_load_by_month"][1], rtol=FLOATS)
    assert "bright: light load, 2026-06" in seen["june"]["caption"] or "baseline: light load, 2026-06" in seen["june"]["caption"], seen["june"]["caption"]
    assert len(seen["june"]["days"]) == 3, seen["june"]["days"]


def test_address(seen, folder):
    """The view that was sent is the view that is received, region by region."""
    sent, received = (picture(folder, name) for name in ("sent", "received"))
    for name, box in seen["regions"].items():
        a, b = part_of(sent, box), part_of(received, box)
        # Camera places travel in millimetres: some pixels along edges differ by that.
        apart = (np.abs(a - b).max(axis=2) > 8).mean()
        assert apart < (0.01 if name.startswith("picture") else 0.002), f"{name}: {apart:.4f} of its pixels differ"
        assert a.std() > 1, f"{name} is empty"
    boxes = [box for name, box in seen["regions"].items() if name.startswith("picture")]
    value, other = part_of(sent, boxes[0]), part_of(sent, boxes[2])
    width = min(value.shape[1], other.shape[1])
    assert (np.abs(value[:, :width] - other[:, :width]) > 8).mean() > 0.02, "the difference looks like the values"
    assert seen["nonsense"] == {"view": "all", "quantity": "light_load", "scale": "log"}, seen["nonsense"]


def test_saved(seen, folder):
    """The PNG holds title, the scene as it is on the page, captions and the legend's colours."""
    import drawing
    assert seen["file"].startswith("square-") and seen["file"].endswith("-light_load.png"), seen["file"]
    saved, page = picture(folder, "saved"), picture(folder, "sent")
    boxes = [box for name, box in seen["regions"].items() if name.startswith("picture")]
    left, top = boxes[0][:2]
    title = next(y for y in range(80) if np.abs(saved[y, 5] - 255).max() > 4)
    for box in boxes:
        shifted = (box[0] - left, box[1] - top + title, box[2] - left, box[3] - top + title)
        apart = (np.abs(part_of(saved, shifted) - part_of(page, box)).max(axis=2) > 8).mean()
        assert apart < 0.002, f"{apart:.4f} of the picture's pixels differ"
    foot = saved[int(title + boxes[0][3] - top):]
    colours = np.round(255 * drawing.palette("false")(np.arange(256))[:, :3])
    for colour in colours[[20, 128, 235]]:
        assert (np.abs(foot - colour).max(axis=2) <= 3).any(), f"the legend lacks {colour}"
    assert (saved[:title].min(axis=2) < 100).any() and (foot[:24].min(axis=2) < 100).any(), "no title, or no caption"


def test_shades(seen, folder):
    plain, shaded = picture(folder, "plain"), picture(folder, "shaded")
    assert len(seen["shades"]) > 10
    kinds = set()
    for at in seen["shades"]:
        own, dark = plain[at["y"], at["x"]], shaded[at["y"], at["x"]]
        is_level = at["rises"] > 0.999
        kinds.add(is_level)
        least = own if is_level else own * (1 - DEEPEST_SHADE)
        assert (dark >= least - SHADE_STEPS).all() and (dark <= own + SHADE_STEPS).all(), (at, own, dark)
        assert is_level or (dark < own - 1).any(), f"{at} is not shaded"
    assert kinds == {True, False}


def test_logarithmic(seen, folder, result):
    """Three powers of ten below the limit, as in `sunload render --scale log`; differences stay as they are."""
    said, limit = seen["logarithmic"], seen["logarithmic"]["limit"]
    assert said["focus"] == "scale" and said["pressed"] == "true" and "scale=log" in said["address"], said
    assert len(said["ticks"]) in (9, 10, 11), said["ticks"]
    assert max(said["ticks"])[0] == limit and -min(said["ofDifference"]["ticks"]) == max(said["ofDifference"]["ticks"]) == said["ofDifference"]["limit"], said
    for value, place in said["ticks"]:
        if value == limit:
            continue
        digit = value / 10 ** np.floor(np.log10(value) + 1e-9)
        assert min(abs(digit - d) for d in (1, 2, 5)) < 1e-9 and abs(place - (3 + np.log10(value / limit)) / 3) < 1e-6, (value, place, limit)
    values = np.array([result["light_load"][at["patch"]] for at in seen["shades"]])
    share = np.clip((3 + np.log10(np.maximum(values, 1e-30) / limit)) / 3, 0, 1)
    assert ("first colour" in said["says"]) == (result["light_load"][...] < limit / 1000).any(), said["says"]
    pictures = view_test.Pictures(folder)
    # The helper wants a value and what it ends at: places on the scale are their own values.
    view_test.assert_colours(pictures, "logarithmic", seen["shades"], "false", share, 1)
    view_test.assert_colours(pictures, "linear", seen["shades"], "false", values, limit)
    try:
        view_test.assert_colours(pictures, "logarithmic", seen["shades"], "false", values, limit)
    except AssertionError:
        pass
    else:
        raise AssertionError("logarithmic colours are the linear ones")
    assert said["ofDifference"]["switches"] == 0 and min(said["ofDifference"]["ticks"]) < 0, said["ofDifference"]
    assert said["after"] == "linear"


def test_beyond(seen):
    """What lies beyond a scale of differences is told on both sides."""
    said = seen["beyond"]
    assert said["least"] < -1e-9 and said["most"] > 1e-9, said
    for words, value in (("larger values, up to ", said["most"]), ("smaller values, down to ", said["least"])):
        told = float(said["some"].split(words)[1].split(",")[0])
        assert abs(told - value) <= 1e-3 * abs(value), (said, value)


def test_keys(seen):
    keys = seen["keys"]
    assert keys["3"] == "side" and keys["."] == keys[","] + 1, keys
    assert keys[" "] is False and keys["h"] == [] and keys["w"] == "walk" and keys["o"] == "orbit", keys
    assert keys["/"] == "find" and keys["0"] is False, keys
    assert seen["outdoors"], "walking begins within a house"
    assert seen["tapped"] == "object house" and seen["stands"], seen["tapped"]


def test_study(seen, folder):
    study = seen["study"]
    assert study["quantities"] == ["surfaces", "materials", "preview"] and study["quantity"] == "surfaces", study
    assert study["views"] == ["baseline", "bright"] and study["title"].startswith("square"), study
    assert study["suns"] == 18, study  # of the day of the slider
    assert {"paving", "plaster", "glass"} <= set(study["materials"]) and len(study["kinds"]) > 1, study
    assert "area" in study["chosen"] and "light" not in study["chosen"], study
    assert not [name for name in os.listdir(folder) if ".part-" in name], "scenes are left beside the page"


def test_without_series(seen, folder):
    """Facades have series of their own where patches have none; objects have charts of stored totals then."""
    with h5py.File(os.path.join(folder, "bare/square/baseline.h5")) as file:
        assert "irradiance" not in file
    bare, whole = seen["bare"], seen["charts"]["days"]
    assert bare["names"] == whole["names"] and np.allclose(bare["values"][0], whole["values"][0], rtol=THREE_DIGITS), (bare, whole)
    assert seen["bareObject"] == ["days", "months"], seen["bareObject"]


def test_part(seen):
    """A part of the period and a band are told wherever something is of them, or is not."""
    part, outside, series = seen["part"], seen["outside"], seen["series"]
    assert part["title"].endswith("baseline; red band, hours 8-10"), part
    assert part["what"] == "light load, hours 8-10: 2026-03-21 … 2026-03-22, 2026-06-21; not of the slider's time", part
    assert part["clock"].startswith("2026-06-21 09:") and "outside" not in part["clock"], part
    assert "outside of hours 8-10" in outside["clock"] and outside["clock"].startswith("2026-03-21 06:00"), outside
    assert "not of hours 8-10 alone" in part["chart"] and part["months"] == [f"light load, 2026-{m} (all of it)" for m in ("03", "06")], part
    assert series["what"] == "irradiance at the time of the slider", series


def test_looked_from(seen):
    """A whole view is of the sides that get most light: south and west of a day, south and east of a morning, north and west in the south."""
    wanted = {"day": 225, "morning": 135, "south": 315}
    assert all(abs(seen["lookedFrom"][name] - bearing) < 0.5 for name, bearing in wanted.items()), seen["lookedFrom"]


def test_refusals(sunload, folder):
    import subprocess
    for words, says in ((["square.yaml", "--variant", "none"], "baseline, bright"), (["square.yaml", "square.yaml"], "alone"),
                        (["results/square/bright.h5", "--variant", "bright"], "--variant"), (["square.yaml", "-o", "square.yaml"], "square.yaml")):
        ran = subprocess.run([sunload, "view", "-o", "no.html", *words] if "-o" not in words else [sunload, "view", *words],
                             stderr=subprocess.PIPE, text=True, cwd=folder)
        assert ran.returncode == 2 and says in ran.stderr, (words, ran.returncode, ran.stderr)


def test(sunload, source, packages, folder):
    sys.path.insert(0, os.path.join(source, "scripts/plot"))
    sys.dont_write_bytecode = True
    for name, text in (("square.obj", SQUARE), ("square.yaml", STUDY.replace("SERIES", "total")), ("bare.yaml", STUDY.replace("SERIES", "direct"))):
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)
    run([sunload, "view", "square.yaml", "-o", "study.html"], cwd=folder)
    run([sunload, "run", "square.yaml", "--overwrite"], cwd=folder)
    rgb = STUDY.replace("SERIES", "total").replace("lines_per_patch: 64", "lines_per_patch: 64, bands: rgb")
    with open(os.path.join(folder, "rgb.yaml"), "w") as file:
        file.write(rgb.replace("max_edge_m: 2", "max_edge_m: 4"))
    run([sunload, "run", "rgb.yaml", "--variant", "baseline", "--output", "rgb", "--overwrite"], cwd=folder)
    run([sunload, "view", "rgb/square/baseline.h5", "--hours", "8-10", "--band", "red", "-o", "part.html"], cwd=folder)
    with open(os.path.join(folder, "south.yaml"), "w") as file:
        file.write(STUDY.replace("SERIES", "total").replace("latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague", "latitude_deg: -33.9, longitude_deg: 151.2, timezone: Australia/Sydney"))
    run([sunload, "view", "south.yaml", "--variant", "baseline", "-o", "south.html"], cwd=folder)
    bare_page = os.path.join(folder, "bare.html")
    run([sunload, "run", "bare.yaml", "--variant", "baseline", "--output", "bare", "--overwrite"], cwd=folder)
    run([sunload, "view", "bare/square/baseline.h5", "-o", bare_page], cwd=folder)
    paths = [os.path.join(folder, f"results/square/{name}.h5") for name in ("baseline", "bright")]
    page = os.path.join(folder, "page.html")
    run([sunload, "view", *paths, "-o", page])
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    with h5py.File(paths[0]) as base, h5py.File(paths[1]) as bright:
        facade = next(name for name in base["facade_name"].asstr() if name.startswith("house/south"))
        probe = os.path.join(os.path.dirname(os.path.abspath(__file__)), "view_use_probe.mjs")
        seen = json.loads(run(["node", probe, packages, chromium, page, folder, facade, os.path.join(folder, "study.html"), bare_page,
                               os.path.join(folder, "part.html"), os.path.join(folder, "south.html")]))
        assert seen["errors"] == [] and seen["requests"] == [], (seen["errors"], seen["requests"])
        test_layouts(seen)
        test_found(seen, base, facade)
        test_values(seen, (base, bright), facade)
        test_charts(seen, (base, bright), facade)
        test_parts(seen, (base, bright))
        test_logarithmic(seen, folder, base)
    test_address(seen, folder)
    test_saved(seen, folder)
    test_shades(seen, folder)
    test_beyond(seen)
    test_keys(seen)
    test_study(seen, folder)
    test_without_series(seen, folder)
    test_part(seen)
    test_looked_from(seen)
    test_refusals(sunload, folder)
    print(f"{len(seen['layouts'])} layouts without overlaps, {len(seen['regions'])} regions as they were sent")


def main():
    sunload, source, packages = (os.path.abspath(word) for word in sys.argv[1:4])
    why = view_test.lacking or missing(packages)
    if why:
        skip(why)
    keep = os.environ.get("SUNLOAD_VIEW_PICTURES")
    if keep:
        return test(sunload, source, packages, keep)
    with tempfile.TemporaryDirectory(prefix="sunload-view-use-") as folder:
        return test(sunload, source, packages, folder)


if not view_test.lacking:
    import h5py
    import matplotlib.image
    import numpy as np

if __name__ == "__main__":
    main()
