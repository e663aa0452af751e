#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A first picture of somebody's own model within a minute: init, check, run, render, view of real models of every
kind and weather of several continents, as init's last lines tell them. Prints the table of docs/first-studies.md.

first_studies.py SUNLOAD SHARED_FOLDER [FOLDER_TO_KEEP]

Seconds are of the clock, and of two processors: what all threads spent together, halved. The latter are judged.
"""

import glob
import json
import os
import re
import resource
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

from skip import skip

MOST_SECONDS = 60
CHARACTERS_PER_SECOND = 200 / 60  # forty words a minute
STEPS = ("init", "check", "run", "render", "view")

CITY, MESHES, VRML, STUDIES, WEATHER = ("data/" + name for name in ("city", "meshes", "vrml/castle", "studies", "weather"))
SQUARE = f"{STUDIES}/gothenburg_gustav_adolfs"

# Words after init; those that name files are relative to the shared folder, `plan.*` are made here.
STARTS = (
    (f"{CITY}/delft_lod1_v20.city.json",),
    (f"{CITY}/rotterdam_delfshaven_v20.city.json",),
    (f"{CITY}/3dbag_tile_5870_v11.city.jsonl", "--rule", "en17037"),
    (f"{CITY}/3dbag_sub_v10.city.json",),
    (f"{CITY}/zurich_subset_lod2_v11.city.json", f"{WEATHER}/zurich_sma_2016_leap.epw"),
    (f"{CITY}/dtcc_city_yup.obj", "--at", "57.7 11.9"),
    (f"{CITY}/dtcc_boxes_sharp_f5248.obj", f"{WEATHER}/WD300_santiago.epw"),
    (f"{CITY}/dtcc_city_surface_s.stl", f"{WEATHER}/chicago_tmy3.epw"),
    (f"{SQUARE}/DSM_GA.tif", f"{WEATHER}/gothenburg_tmyx.epw", "--terrain", f"{SQUARE}/DEM_GA.tif", "--canopy",
     f"{SQUARE}/CDSM_GA.tif"),
    (f"{STUDIES}/gothenburg_kronenhuset/DSM_KR.tif",),
    (f"{VRML}/shadow_maps/castle_with_trees/castle_with_trees.wrl",),
    (f"{VRML}/lights_materials/raytracer/office.wrl", f"{WEATHER}/san_francisco_10min.wea"),
    (f"{MESHES}/trimesh_no_indices_3storybuilding.glb", f"{WEATHER}/munich_iwec.epw"),
    (f"{MESHES}/trimesh_bunny.ply",),
    ("plan.geojson", f"{WEATHER}/munich_iwec.epw"),
    ("plan.gpkg", "--rule", "bre_209_vsc"),
    ("plan.shp",),
)


def write_plan(shared, folder):
    """Footprints with heights of a CityJSON model, as GeoJSON and, where GDAL's ogr2ogr is, of other formats."""
    with open(os.path.join(shared, CITY, "rotterdam_delfshaven_v20.city.json"), encoding="utf-8") as file:
        city = json.load(file)
    scale, shift = city["transform"]["scale"], city["transform"]["translate"]
    point = lambda index: [v * s + t for v, s, t in zip(city["vertices"][index], scale, shift)]
    features = []
    for name, thing in city["CityObjects"].items():
        for geometry in thing.get("geometry", []):
            kinds = [surface["type"] for surface in geometry["semantics"]["surfaces"]]
            of = geometry["semantics"]["values"]
            heights = [point(index)[2] for face in geometry["boundaries"] for ring in face for index in ring]
            grounds = [face for face, kind in zip(geometry["boundaries"], of) if kind is not None and kinds[kind] == "GroundSurface"]
            for face in grounds[:1]:
                rings = [[point(index)[:2] for index in (*ring, ring[0])] for ring in face]
                features.append({"type": "Feature", "properties": {"name": name, "height": round(max(heights) - min(heights), 2)},
                                 "geometry": {"type": "Polygon", "coordinates": rings}})
    assert len(features) > 500, len(features)
    plan = {"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::28992"}},
            "features": features}
    with open(os.path.join(folder, "plan.geojson"), "w", encoding="utf-8") as file:
        json.dump(plan, file)
    for ending in ("gpkg", "shp"):
        try:
            subprocess.run(["ogr2ogr", os.path.join(folder, "plan." + ending), os.path.join(folder, "plan.geojson")], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        except (FileNotFoundError, subprocess.CalledProcessError):
            print(f"plan.{ending} is left out: no ogr2ogr (package gdal-bin)")


def spent():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def timed(words, folder):
    """Output, seconds of the clock and of two processors."""
    begin, before = time.monotonic(), spent()
    ran = subprocess.run(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8", check=False)
    assert ran.returncode == 0, f"{shlex.join(words)}: {ran.returncode}\n{ran.stdout[-3000:]}"
    return ran.stdout, time.monotonic() - begin, (spent() - before) / 2


def begun(sunload, shared, words, folder):
    """Runs init and the commands that it prints. A row of the table."""
    # People stand in a folder beside their files.
    names = []
    for word in words:
        source = os.path.join(shared, word)
        if word.startswith("data/"):
            names.append(os.path.basename(word))
            os.symlink(source, os.path.join(folder, names[-1]))
        else:
            names.append(word)
    typed = len(shlex.join(["sunload", "init", *names])) + 1
    text, wall, cpu = timed([sunload, "init", *names], folder)
    commands = [shlex.split(line) for line in re.findall(r"^  (sunload .*)$", text, re.MULTILINE)]
    assert [command[1] for command in commands[:4]] == list(STEPS[1:]), text
    times = {"init": (wall, cpu)}
    for command in commands:
        _, wall, cpu = timed([sunload, *command[1:]], folder)
        times[command[1]] = (wall, cpu)
    told, _, _ = timed([sunload, "info", commands[2][2]], folder)
    patches = re.search(r"^scene +(\d+) patches", told, re.MULTILINE).group(1)
    error = re.search(r"^accuracy[^\n]*?([\d.]+) ?%", told, re.MULTILINE).group(1)
    return names, typed, times, f"{int(patches):,} | {error} %".replace(",", " ")


def main():
    sunload, shared = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    if not os.path.isdir(os.path.join(shared, CITY)):
        skip("data/city of the real models is not here")
    keep = sys.argv[3] if len(sys.argv) > 3 else None
    with tempfile.TemporaryDirectory() as made:
        root = os.path.abspath(keep or made)
        os.makedirs(root, exist_ok=True)
        write_plan(shared, made)
        print("| start | typed | init | check | run | render | view | to the picture | patches | error |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
        slow = []
        for number, words in enumerate(STARTS):
            folder = os.path.join(root, f"{number + 1:02}")
            os.makedirs(folder)
            if words[0].startswith("plan."):
                if not os.path.exists(os.path.join(made, words[0])):
                    continue
                for name in glob.glob(os.path.join(made, "plan.*")):
                    shutil.copy(name, folder)
            names, typed, times, told = begun(sunload, shared, words, folder)
            picture = [sum(times[step][i] for step in STEPS[:4]) for i in (0, 1)]
            cells = [f"{times[step][0]:.1f} ({times[step][1]:.1f})" for step in STEPS]
            print(f"| `{shlex.join(names)}` | {typed / CHARACTERS_PER_SECOND:.0f} s | {' | '.join(cells)} | "
                  f"{picture[0]:.1f} ({picture[1]:.1f}) | {told} |", flush=True)
            if picture[1] > MOST_SECONDS or typed / CHARACTERS_PER_SECOND > MOST_SECONDS:
                slow.append((names, picture, typed))
        assert not slow, f"more than a minute: {slow}"


main()
