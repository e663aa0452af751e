#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What pages say is typed, runs: every indented command of README.md and docs/, as it stands, and every block of YAML as
a part of a study, beside coarse copies of the studies that come with the program. What other tests run is left to them.

pages_test.py SUNLOAD SOURCE_FOLDER
"""

import glob
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile

from skip import skip
from small_year import epw

try:
    import yaml
except ImportError:
    skip("python3-yaml is not installed")

# Pages whose commands another test runs.
ELSEWHERE = {"gallery.md": "gallery_test.py", "plots.md": "plots_test.py", "tutorial.md": "docs_test.py", "cluster.md": "slurm_test.py",
             "install.md": "install_test.py"}
# Lines that want what is not here; each has its own test.
NOT_HERE = {"horizon dem.tif --at": "tests/io/scene/land_horizon_test.cpp", "configs/delft_day.yaml": "a model to be had elsewhere"}
COARSE = "\nmesh: {max_edge_m: 5, oracle: none}\nsolver: {lines_per_patch: 16, direct_samples: 8, realizations: 4}\n"


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def run(command, folder, environment):
    ran = subprocess.run(["bash", "-euc", command], cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                         encoding="utf-8", check=False)
    assert ran.returncode == 0, f"{command}: {ran.returncode}\n{ran.stdout[-3000:]}"
    return ran.stdout


def coarse(study):
    """The same study with few patches and lines: commands are tested, not light."""
    return re.sub(r"^(mesh|solver):.*\n(?:[ #].*\n)*", "", study, flags=re.MULTILINE) + COARSE


def plan(city):
    """Footprints with heights, on the map of the town."""
    low = city["transform"]["translate"]
    square = lambda x, y: [[low[0] + x + a, low[1] + y + b] for a, b in ((0, 0), (12, 0), (12, 10), (0, 10), (0, 0))]
    houses = [{"type": "Feature", "properties": {"id": f"house_{n}", "bldg_h": 9, "levels": 3, "ground_z": 300.0},
               "geometry": {"type": "Polygon", "coordinates": [square(30 * n, 0)]}} for n in range(3)]
    return json.dumps({"type": "FeatureCollection", "name": "buildings", "features": houses,
                       "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25833"}}})


def trees(city):
    """Points with heights and crowns, one of which has none, on the map of the town."""
    low = city["transform"]["translate"]
    points = [{"type": "Feature", "properties": {"HOEHE": 9 + n, "KRONE": 5 if n else None},
               "geometry": {"type": "Point", "coordinates": [low[0] + 20 + 10 * n, low[1] + 20]}} for n in range(3)]
    return json.dumps({"type": "FeatureCollection", "name": "trees", "features": points,
                       "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25833"}}})


def terrain(city):
    """Land about the town that rises to the south, as GeoTIFF: one strip of 32 bit numbers."""
    low, cells, size = city["transform"]["translate"], 40, 100.0
    heights = struct.pack(f"<{cells * cells}f", *(300.0 + 2 * row for row in range(cells) for _ in range(cells)))
    keys = (1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 25833)  # projected, cells are areas, UTM 33 north
    scale = struct.pack("<3d", size, size, 0)
    tie = struct.pack("<6d", 0, 0, 0, low[0] - cells * size / 2, low[1] + cells * size / 2, 0)
    geo = struct.pack(f"<{len(keys)}H", *keys)
    begin = 8  # of the parts behind the header
    places = [begin, begin + len(heights), begin + len(heights) + len(scale), begin + len(heights) + len(scale) + len(tie)]
    short, long, double = 3, 4, 12
    tags = [(256, short, 1, cells), (257, short, 1, cells), (258, short, 1, 32), (259, short, 1, 1), (262, short, 1, 1),
            (273, long, 1, places[0]), (277, short, 1, 1), (278, short, 1, cells), (279, long, 1, len(heights)),
            (339, short, 1, 3), (33550, double, 3, places[1]), (33922, double, 6, places[2]), (34735, short, len(keys), places[3])]
    directory = struct.pack("<H", len(tags)) + b"".join(struct.pack("<HHII", *tag) for tag in tags) + struct.pack("<I", 0)
    return struct.pack("<2sHI", b"II", 42, places[3] + len(geo)) + heights + scale + tie + geo + directory


def make_desk(source, folder, environment):
    """What the pages speak of, in the folder of somebody who reads them."""
    shutil.copytree(os.path.join(source, "configs"), os.path.join(folder, "configs"))
    os.symlink(os.path.join(source, "scripts"), os.path.join(folder, "scripts"))
    for path in glob.glob(os.path.join(folder, "configs/*.yaml")):
        write(path, coarse(text_of(path)))
    city = os.path.join(folder, "configs/models/town.city.json")
    shutil.copy(city, os.path.join(folder, "town.city.json"))
    with open(city, encoding="utf-8") as file:
        model = json.load(file)
    write(os.path.join(folder, "weather.epw"), epw())
    write(os.path.join(folder, "plan.gpkg"), plan(model))
    write(os.path.join(folder, "trees.gpkg"), trees(model))
    with open(os.path.join(folder, "dem.tif"), "wb") as file:
        file.write(terrain(model))
    street = text_of(os.path.join(folder, "configs/street.yaml"))
    street, count = re.subn(r"^period:.*$", "period: {days: [2026-03-08, 2026-06-21], step_min: 60}", street, flags=re.MULTILINE)
    assert count == 1
    # Form factors of all patches are made of few.
    write(os.path.join(folder, "street.yaml"), street.replace("max_edge_m: 5", "max_edge_m: 30"))
    run("sunload init town.city.json", folder, environment)
    town = coarse(text_of(os.path.join(folder, "town.yaml"))) + "seasons: {winter: [12, 1, 2]}\noutput: {totals: [month, season, day]}\n"
    write(os.path.join(folder, "town.yaml"), town)
    for study in ("street.yaml", "town.yaml"):
        run(f"sunload run {study} --progress none", folder, environment)
    for name in ("base.h5", "variant.h5"):
        shutil.copy(os.path.join(folder, "results/town/baseline.h5"), os.path.join(folder, name))
    write(os.path.join(folder, "hills.csv"), "azimuth_deg,elevation_deg\n0,2\n180,5\n")


def commands_of(text):
    """Indented lines that call the program or a script of ours, without what is usage: words in capitals."""
    lines = [line.strip() for line in re.findall(r"^    ((?:sunload|scripts/planning/check) .*)$", text, re.MULTILINE)]
    return [re.sub(r"\s{2,}#.*$", "", line) for line in lines if not re.search(r"\b(MODEL|STUDY|RESULT|WEATHER|FILE)\b", line)]


def box_of(city, name, corner, size):
    """Adds a building to the town: walls, a roof, and in the south a window from edge to edge."""
    begin = len(city["vertices"])
    low, high = corner, [c + s for c, s in zip(corner, size)]
    city["vertices"] += [[round(1000 * v) for v in (x, y, z)] for z in (low[2], high[2])
                         for x, y in ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))]
    faces = [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    surfaces = [{"type": kind} for kind in ("GroundSurface", "RoofSurface", "Window", "WallSurface")]
    city["CityObjects"][name] = {"type": "Building", "geometry": [{
        "type": "Solid", "lod": "2", "boundaries": [[[[begin + v for v in face]] for face in faces]],
        "semantics": {"surfaces": surfaces, "values": [[0, 1, 2, 3, 3, 3]]}}]}


def make_model_of_variants(folder):
    """What docs/variants.md edits: the town with two sheds and a kiosk, plots and a house by somebody else."""
    with open(os.path.join(folder, "town.city.json"), encoding="utf-8") as file:
        city = json.load(file)
    box_of(city, "shed_1", (86, 44, 0), (4, 3, 2.5))
    box_of(city, "shed", (96, 44, 0), (4, 3, 2.5))
    box_of(city, "kiosk", (50, 50, 0), (3, 3, 3))
    write(os.path.join(folder, "town.city.json"), json.dumps(city))
    square = lambda x, y, size: json.dumps({
        "type": "Polygon", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25833"}},
        "coordinates": [[[383000 + x + a * size, 5511800 + y + b * size] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))]]})
    write(os.path.join(folder, "plots.geojson"), square(110, 40, 18))
    write(os.path.join(folder, "block.geojson"), square(60, 44, 6))
    write(os.path.join(folder, "design.obj"), "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nv 0 0 8\nv 9 0 8\nv 9 9 8\nv 0 9 8\n"
          "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")


def merged(base, other):
    """As variants are: maps are merged, all else is replaced."""
    both = dict(base)
    for key, value in other.items():
        both[key] = merged(both[key], value) if isinstance(value, dict) and isinstance(both.get(key), dict) else value
    return both


def expect_blocks(source, desk, environment):
    """How many blocks of YAML are parts of a study that passes its check."""
    make_model_of_variants(desk)
    pages = sorted(glob.glob(os.path.join(source, "docs/*.md"))) + [os.path.join(source, "README.md")]
    blocks = [(os.path.basename(page), block) for page in pages
              for block in re.findall(r"^```yaml\n(.*?)^```", text_of(page), re.MULTILINE | re.DOTALL)
              if os.path.basename(page) != "planning-check.md"]  # it is of a build server
    quick = yaml.safe_load(COARSE)
    site = {"timezone": "Europe/Prague"}
    town = merged({"format": "sunload-study-1", "name": "town", "site": site, "period": {"days": ["2026-01-15"], "step_min": 120},
                   "light": {"source": "clear_sky", "linke_turbidity": 3},
                   "scene": {"files": ["town.city.json"], "ground": {"margin_m": 30, "material": "paving"},
                             "materials": {"glass": {"diffuse": 0.1, "mirror": 0.2}, "lawn": {"diffuse": 0.2}},
                             "assign": [{"surface": "wall", "material": "plaster"}, {"surface": "roof", "material": "roof_tile"},
                                        {"surface": "window", "material": "glass"}, {"object": "lime_*", "material": "crown"}]}}, quick)
    street = merged(yaml.safe_load(text_of(os.path.join(desk, "street.yaml"))), quick)
    edits = next(yaml.safe_load(block) for page, block in blocks if page == "variants.md")["scene"]["edit"]
    for number, (page, block) in enumerate(blocks):
        part = yaml.safe_load(block)
        base = street if page in ("README.md", "measures.md") else town
        if "matrix" in part:  # of the edits above it
            base = merged(town, {"scene": {"edit": edits}})
        study = part if "format" in part else merged(base, part)
        if page == "init.md":
            study["scene"] = dict(part["scene"], ground="none")
        write(os.path.join(desk, f"block_{number}.yaml"), json.dumps(study, default=str))
        try:
            run(f"sunload check block_{number}.yaml --no-refine --progress none", desk, environment)
        except AssertionError as error:
            raise AssertionError(f"{page}, a block of YAML: {error}\n{block}") from error
    return len(blocks)


def expect_commands(name, text, desk, environment):
    """How many have run, in a copy of the desk where nothing is there that the page itself makes."""
    commands = [line for line in commands_of(text) if not any(words in line for words in NOT_HERE)]
    with tempfile.TemporaryDirectory() as made:
        folder = os.path.join(made, "desk")
        shutil.copytree(desk, folder, symlinks=True)
        for line in commands:
            for study in re.findall(r"^sunload run (\S+\.yaml)", line):
                named = re.search(r'^name: "?([\w.-]+)', text_of(os.path.join(folder, study)), re.MULTILINE).group(1)
                shutil.rmtree(os.path.join(folder, "results", named), ignore_errors=True)
            for model in re.findall(r"^sunload init (\w+)\.", line):
                if os.path.exists(os.path.join(folder, model + ".yaml")):
                    os.remove(os.path.join(folder, model + ".yaml"))
        for line in commands:
            try:
                # A check of planning rules may find that one fails: that is what it is for.
                run(line + (" || test $? = 1" if line.startswith("scripts/planning/check") else ""), folder, environment)
            except AssertionError as error:
                raise AssertionError(f"{name}: {error}") from error
    return len(commands)


def main():
    program, source = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    environment = dict(os.environ, SUNLOAD=program, PATH=os.path.dirname(program) + os.pathsep + os.environ.get("PATH", ""))
    with tempfile.TemporaryDirectory() as desk:
        make_desk(source, desk, environment)
        count, faults = 0, []
        for page in [os.path.join(source, "README.md"), *sorted(glob.glob(os.path.join(source, "docs/*.md")))]:
            name = os.path.basename(page)
            if name in ELSEWHERE:
                continue
            try:
                count += expect_commands(name, text_of(page), desk, environment)
            except AssertionError as error:
                faults.append(str(error))
        try:
            count += expect_blocks(source, desk, environment)
        except AssertionError as error:
            faults.append(str(error))
        assert not faults, "\n\n".join(faults)
        assert count > 60, count
        print(f"{count} commands and blocks of pages have run")


main()
