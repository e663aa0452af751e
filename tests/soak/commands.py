# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every other command of the program on a study and its result: exit codes, and files that are what they are called."""

import csv
import datetime
import io
import json
import os
import re
import sqlite3
import xml.etree.ElementTree as xml

from invariants import FALSE_ALARMS
from other_ways import result_path
from program import DONE, MACHINE_LIMIT, WRONG_INPUT

NOT_A_NUMBER = re.compile(r"\b-?(nan|inf)\b")
PNG = b"\x89PNG\r\n\x1a\n"


def is_csv(text, rows=None):
    table = list(csv.reader(io.StringIO(text)))
    if len(table) < 1 or any(len(row) != len(table[0]) for row in table):
        yield "is no table"
    elif rows is not None and len(table) != rows + 1:
        yield f"has {len(table) - 1} rows, not {rows}"


def is_picture(path):
    with open(path, "rb") as file:
        if file.read(8) != PNG:
            yield "is no PNG"


class Commands:
    """`first` is the result of the study's first variant, in all its bands; `tests`: how many tests by
    chance the soak makes."""

    def __init__(self, program, study, first, random, tests):
        self.program, self.study, self.random, self.tests = program, study, random, tests
        self.result = first[0]
        self.bands = ["red", "green", "blue"] if len(first) > 1 else []
        self.path = os.path.relpath(result_path(study, "results", study.variants[0]), study.folder)

    def said(self, ran, *codes, check=None):
        """Problems of a command; `check` looks at what it printed where it was done."""
        yield from ran.problems(*codes)
        if found := NOT_A_NUMBER.search(ran.out):
            yield f"sunload {' '.join(ran.words)}: prints '{found.group()}'"
        if ran.code == DONE and check:
            yield from (f"sunload {' '.join(ran.words)}: {problem}" for problem in check(ran.out))

    def wrote(self, name, *words, codes=(DONE,), refusal=None, check=None):
        """The same of a command that writes a file, which is there if and only if it was done. It may be
        refused in the words of `refusal`."""
        ran = self.program.run(*words)
        if refusal and refusal in ran.err:
            codes = (*codes, WRONG_INPUT)
        path = os.path.join(self.study.folder, name)
        yield from self.said(ran, *codes)
        if os.path.exists(path) != (ran.code == DONE):
            yield f"sunload {' '.join(words)}: exit code {ran.code}, the file {'is' if os.path.exists(path) else 'is not'} there"
        elif ran.code == DONE:
            if check:
                yield from (f"sunload {' '.join(words)}: {name} {problem}" for problem in check(path))
            os.remove(path)

    def band(self):
        return ["--band", self.random.choice(self.bands)] if self.bands and self.random.random() < 0.5 else []

    def time(self):
        """An instant of the period, in UTC."""
        second = int(self.random.choice(list(self.result["time"])))
        return (datetime.datetime(1970, 1, 1) + datetime.timedelta(seconds=second)).strftime("%Y-%m-%dT%H:%M:%SZ")

    def quantity(self):
        """A dataset to draw, with a time where it has times."""
        name = self.random.choice([n for n in self.result.names("irradiance", "light_load", "sun_hours", "sky_view", "power_load")
                                   if self.result.dims[n] in (("patch",), ("time", "patch"))])
        at = ["--time", self.time()] if self.result.dims[name][0] == "time" else []
        return ["--quantity", name.replace("irradiance", self.stem()), *at]

    def stem(self):
        return "illuminance" if "direct_normal_illuminance" in self.result else "irradiance"

    def info(self):
        yield from self.said(self.program.run("info", self.path, *self.band()), DONE)
        patches = len(self.result["patch_area"])
        yield from self.said(self.program.run("info", self.path, "--patches", *self.band()), DONE, check=lambda t: is_csv(t, patches))

    def compare(self):
        """With itself nothing differs; with another variant whatever comes is told."""
        ran = self.program.run("compare", self.path, self.path, "--json", *self.band())
        yield from self.said(ran, DONE)
        if ran.code == DONE:
            told = [v for key, v in every_value(json.loads(ran.out)) if key.startswith("difference_") or key == "significant"]
            if not told or any(told):
                yield "a result differs from itself, or nothing is compared"
        yield from self.said(self.program.run("compare", self.path, self.path, "--csv"), DONE, check=is_csv)
        if len(self.study.variants) > 1:
            yield from self.other_seed()
            yield from self.said(self.program.run("compare", "study.yaml", *self.study.variants), DONE)
            yield from self.wrote("differences.h5", "compare", "study.yaml", *self.study.variants, "--hdf5", "differences.h5")

    def other_seed(self):
        """Where another seed is all that a variant has, nothing differs by more than chance."""
        if list(self.study.tree["variants"][1].get("solver", {})) != ["seed"]:
            return
        ran = self.program.run("compare", "study.yaml", *self.study.variants, "--json")
        yield from self.said(ran, DONE)
        chances = [p for key, p in every_value(json.loads(ran.out)) if key == "p_corrected" and p is not None]
        if chances and min(chances) < FALSE_ALARMS / self.tests:
            yield f"another seed makes a difference that has a chance of {min(chances):.2g}"

    def export(self):
        forms = {"csv": None, "vtk": begins(b"# vtk DataFile"), "xdmf": lambda p: xml.parse(p) and (), "glb": begins(b"glTF"),
                 "vrml": begins(b"#VRML V2.0"), "ply": begins(b"ply\n"), "cityjson": is_json, "gpkg": is_geopackage,
                 "energyplus": None}
        form = self.random.choice(list(forms))
        # Only whole years go to EnergyPlus, and XDMF has no bands.
        codes = (DONE, WRONG_INPUT) if form == "energyplus" or (form == "xdmf" and self.bands) else (DONE,)
        words = ["--quantity", "series"] if form == "csv" and self.random.random() < 0.3 else []
        if form == "cityjson" and self.study.city and self.random.random() < 0.7:
            words = ["--model", self.study.city]
        if form in ("glb", "vrml", "ply", "vtk") and self.random.random() < 0.5:
            words = self.quantity()
        yield from self.wrote(f"out.{form}", "export", self.path, "--to", form, "-o", f"out.{form}", *words, *self.band(),
                              codes=codes, check=forms[form])

    def render(self):
        random = self.random
        words = random.choice([[], ["--camera", "top"], ["--camera", "overview", "--projection", "parallel"], ["--mesh", "--interpolate"],
                               ["--colour", "hue"], ["--sky", "first"]])
        if len(self.result.get("facade_name", [])) and random.random() < 0.3:
            words = ["--facade", text(self.result["facade_name"][0])]
        if self.bands and random.random() < 0.5:
            words = ["--colour", "rgb"]
        elif random.random() < 0.7:
            words = [*words, *self.quantity(), *self.band()]
        refusal = "other things hide it" if "--facade" in words else None
        yield from self.wrote("out.png", "render", self.path, "-o", "out.png", "--size", "320x320", *words, refusal=refusal,
                              check=is_picture)

    def view(self):
        yield from self.wrote("out.html", "view", self.path, "-o", "out.html", *self.band(), codes=(DONE, MACHINE_LIMIT))

    def sun(self):
        yield from self.said(self.program.run("sun", "study.yaml"), DONE, check=lambda t: is_csv(t, len(self.result["time"])))
        if self.random.random() < 0.3:
            yield from self.wrote("sun.png", "sun", "study.yaml", "--image", "sun.png", check=is_picture)

    def sky(self):
        words = ["sky", "study.yaml", "--time", self.time()]
        cells = self.random.choice(["cells", "tregenza", "mf2", "mf4"])
        yield from self.said(self.program.run(*words, "--subdivision", cells), DONE, check=is_csv)
        if self.random.random() < 0.3:
            colour = self.random.choice(["false", "rgb"])
            yield from self.wrote("sky.png", *words, "--image", "sky.png", "--colour", colour, check=is_picture)

    def check(self):
        yield from self.said(self.program.run("check", "study.yaml"), DONE)
        yield from self.said(self.program.run("check", "study.yaml", "--no-refine", "--intersections"), DONE)

    def again(self):
        """A result that is there is left alone."""
        yield from self.said(self.program.run("run", "study.yaml"), WRONG_INPUT)
        yield from self.said(self.program.run("run", "study.yaml", "--resume"), DONE)
        yield from self.said(self.program.run("merge", "study.yaml"), DONE)

    def shown(self):
        """Commands that need no study."""
        yield from self.said(self.program.run("materials"), DONE)
        name = self.random.choice(["street", "room", "city", "cylinder"])
        yield from self.wrote("built.obj", "scene", name, "-o", "built.obj")

    def some(self, count):
        """Problems of so many commands, drawn by lot."""
        every = [self.info, self.compare, self.export, self.export, self.render, self.view, self.sun, self.sky, self.check,
                 self.again, self.shown]
        for command in self.random.sample(every, count):
            yield from command()


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def every_value(tree):
    """Keys and values of all maps of a JSON text."""
    if isinstance(tree, dict):
        for key, value in tree.items():
            yield key, value
            yield from every_value(value)
    elif isinstance(tree, list):
        for value in tree:
            yield from every_value(value)


def begins(magic):
    def check(path):
        with open(path, "rb") as file:
            if not file.read(len(magic)) == magic:
                yield f"does not begin with {magic!r}"
    return check


def is_json(path):
    with open(path, encoding="utf-8") as file:
        if json.load(file)["type"] != "CityJSON":
            yield "is no CityJSON"


def is_geopackage(path):
    with sqlite3.connect(path) as base:
        if base.execute("PRAGMA integrity_check").fetchone()[0] != "ok":
            yield "is damaged"
