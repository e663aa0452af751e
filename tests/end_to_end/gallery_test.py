#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/gallery.md is what scripts/gallery writes: studies and pictures are there, small enough, and runs still say what
the page says of them.

gallery_test.py SUNLOAD SOURCE_FOLDER quick|all
"""

import csv
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

from skip import skip

# Runs of some seconds all together.
QUICK = ["minimal", "sensors", "mcrad/low_reflectance", "mcrad/sun_by_hand"]
LEAST_STUDIES = 10
MOST_BYTES = 40_000
MOST_BYTES_OF_ALL = 700_000
# Of a light load: pages tell three digits, and random numbers may be drawn in another order one day.
TOLERANCE = 0.02


def gallery(source, *words):
    return subprocess.run([os.path.join(source, "scripts/gallery"), *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          encoding="utf-8", check=False)


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def rows_of(docs):
    with open(os.path.join(docs, "gallery/facts.csv"), encoding="utf-8", newline="") as file:
        return {row["study"]: row for row in csv.DictReader(file)}


def expect_page(source):
    page = text_of(os.path.join(source, "docs/gallery.md"))
    studies = re.findall(r"^\[configs/(\S+)\.yaml\]", page, re.MULTILINE)
    assert len(studies) == len(set(studies)) >= LEAST_STUDIES, studies
    assert set(studies) == set(rows_of(os.path.join(source, "docs"))), "a run of the page has no row of facts, or the other way round"
    for study in studies:
        assert os.path.exists(os.path.join(source, "configs", study + ".yaml")), study
    shown = re.findall(r"^!\[[^\]]+\]\(gallery/(\S+\.png)\)", page, re.MULTILINE)
    assert len(shown) == len(studies), shown
    pictures = glob.glob(os.path.join(source, "docs/gallery/*.png"))
    assert sorted(shown) == sorted(os.path.basename(picture) for picture in pictures), "a picture is missing, or is of no study"
    sizes = [os.path.getsize(picture) for picture in pictures]
    assert max(sizes) <= MOST_BYTES and sum(sizes) <= MOST_BYTES_OF_ALL, (max(sizes), sum(sizes))
    assert gallery(source, "--check").returncode == 0, "docs/gallery.md is not what scripts/gallery writes"


def expect_faults_seen(source, folder):
    """Facts or a sentence that were typed."""
    copy = os.path.join(folder, "docs")
    shutil.copytree(os.path.join(source, "docs/gallery"), os.path.join(copy, "gallery"))
    page, facts = os.path.join(copy, "gallery.md"), os.path.join(copy, "gallery/facts.csv")
    original = text_of(os.path.join(source, "docs/gallery.md"))
    for path, text in ((page, original.replace(" kWh/m²", "0 kWh/m²", 1)), (facts, text_of(facts).replace("minimal,baseline,1", "minimal,baseline,7"))):
        shutil.copy(os.path.join(source, "docs/gallery.md"), page)
        assert gallery(source, "--check", "-o", copy).returncode == 0
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        assert gallery(source, "--check", "-o", copy).returncode == 1, path
    ran = gallery(source, "no_such_study")
    assert ran.returncode == 2 and "minimal" in ran.stdout, ran.stdout


def expect_runs(sunload, source, studies, folder):
    out = os.path.join(folder, "out")
    ran = gallery(source, "-o", out, "--results", os.path.join(folder, "results"), "--sunload", sunload, *studies)
    assert ran.returncode == 0, ran.stdout
    told, found = rows_of(os.path.join(source, "docs")), rows_of(out)
    assert set(found) == set(studies or told), found
    import matplotlib.image
    for study, row in found.items():
        own = {name: told[study][name] for name in ("shown", "variants", "suns")}
        load = float(told[study]["light_load"])
        assert own == {name: row[name] for name in own} and abs(float(row["light_load"]) - load) <= TOLERANCE * load, (
            f"{study}: {row}, and the page says {told[study]}; run scripts/gallery {study}")
        picture = matplotlib.image.imread(os.path.join(out, "gallery", study.replace("/", "-") + ".png"))
        assert picture.std() > 0.02 and picture.shape[1] > 500, study
    assert "](gallery/minimal.png)" in text_of(os.path.join(out, "gallery.md"))


def main():
    sunload, source, what = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3]
    probe = "import h5py, matplotlib, PIL"
    with tempfile.TemporaryDirectory(prefix="sunload-gallery-") as folder:
        expect_page(source)
        expect_faults_seen(source, folder)
        if subprocess.run(["/usr/bin/python3", "-c", probe], stderr=subprocess.DEVNULL, check=False).returncode != 0:
            skip("h5py or matplotlib is missing")
        expect_runs(sunload, source, QUICK if what == "quick" else [], folder)


main()
