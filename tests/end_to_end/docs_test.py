#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages are true: links lead somewhere, commands of the tutorial run, so do the Python blocks; and they are short.

docs_test.py SUNLOAD SOURCE_FOLDER links|tutorial|python
"""

import glob
import os
import re
import subprocess
import sys
import tempfile

from skip import skip
from small_year import wea

MOST_WORDS = 1500
# Of a table: what is to be read at a glance. Longer notes go below it.
LONGEST_ROW = 300
# Tables of keys and datasets, made from the schema or held against the program, are looked up, not read.
REFERENCES = {"docs/study-file.md", "docs/validation.md", "docs/result-file.md", "docs/materials.md",
              "docs/developer/dependencies.md", "docs/developer/design.md", "docs/developer/method.md", "docs/developer/how-to-add.md"}


def pages(source):
    names = [name for pattern in ("*.md", "docs/*.md", "docs/developer/*.md") for name in
             glob.glob(os.path.join(source, pattern))]
    assert len(names) > 15, names
    return sorted(names)


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def without_code(text):
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL))


def anchors(text):
    """As a repository's pages have them."""
    headings = re.findall(r"^#+ (.*)$", without_code(re.sub(r"`", "", text)), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(page):
    folder, broken = os.path.dirname(page), []
    for target in re.findall(r"\]\(([^)\s]+)\)", without_code(text_of(page))):
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        path = os.path.normpath(os.path.join(folder, name)) if name else page
        if not os.path.exists(path):
            broken.append(target)
        elif anchor and path.endswith(".md") and anchor not in anchors(text_of(path)):
            broken.append(target)
    return broken


def expect_links(source):
    broken = {os.path.relpath(page, source): broken_links(page) for page in pages(source)}
    broken = {page: links for page, links in broken.items() if links}
    assert not broken, f"links that lead nowhere: {broken}"
    for page in pages(source):
        name = os.path.relpath(page, source)
        words = len(without_code(text_of(page)).split())
        rows = [line for line in text_of(page).splitlines() if line.startswith("|")]
        assert max(map(len, rows), default=0) <= LONGEST_ROW, f"{name}: {max(rows, key=len)}"
        if name.startswith("docs/") and name not in REFERENCES:
            assert words <= MOST_WORDS, f"{name}: {words} words"
    with tempfile.TemporaryDirectory() as folder:  # a fault that must be seen
        fault = os.path.join(folder, "page.md")
        with open(fault, "w", encoding="utf-8") as file:
            file.write("# One\n[a](none.md) [b](#one) [c](#two) `[d](none.md)`\n")
        assert broken_links(fault) == ["none.md", "#two"]


def blocks(path, language):
    return re.findall(rf"^```{language}\n(.*?)^```", text_of(path), re.MULTILINE | re.DOTALL)


def run(words, folder, environment):
    ran = subprocess.run(words, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                         encoding="utf-8")
    assert ran.returncode == 0, f"{words[-1]}\n{ran.stdout[-3000:]}"
    return ran.stdout


def expect_tutorial(source, environment):
    commands = blocks(os.path.join(source, "docs/tutorial.md"), "sh")
    assert len(commands) >= 8
    with tempfile.TemporaryDirectory() as folder:
        run(["bash", "-euc", "".join(commands)], folder, environment)
        for name in ("town.png", "town.html", "facades.csv", "bright.csv", "bright.html", "shared/town/bright.h5"):
            assert os.path.getsize(os.path.join(folder, "tutorial", name)) > 0, name


def expect_python(source, environment):
    probe = "import h5netcdf, matplotlib, pandas, xarray"
    if subprocess.run(["/usr/bin/python3", "-c", probe], stderr=subprocess.DEVNULL, check=False).returncode != 0:
        skip("xarray, h5netcdf, pandas or matplotlib is missing")
    environment = dict(environment, PYTHONPATH=os.path.join(source, "io/python"), MPLBACKEND="Agg")
    probe = "import sunload.native; sunload.native.module()"
    if subprocess.run(["/usr/bin/python3", "-B", "-c", probe], stderr=subprocess.DEVNULL, env=environment,
                      check=False).returncode != 0:
        skip("this build has no module for Python (packages pybind11-dev, python3-dev)")
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, "configs"))
        study = text_of(os.path.join(source, "configs/street.yaml"))
        # The same street, coarse: the blocks are tested, not its light.
        study, changes = re.subn(r"^(mesh|solver):.*\n(?:[ #].*\n)*", "", study, flags=re.MULTILINE)
        assert changes == 2
        study += "\nmesh: {max_edge_m: 4, oracle: none}\nsolver: {lines_per_patch: 64}\n"
        with open(os.path.join(folder, "configs/street.yaml"), "w", encoding="utf-8") as file:
            file.write(study)
        for page in ("docs/python.md", "README.md"):
            found = blocks(os.path.join(source, page), "python")
            assert found, page
            run(["/usr/bin/python3", "-B", "-c", "\n".join(found)], folder, environment)
        assert os.path.getsize(os.path.join(folder, "map.png")) > 0
    expect_recipes(source, environment)


def expect_recipes(source, environment):
    """Files of other tools, in and out."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("weather.wea", wea()), ("grid.pts", "6 0 1.5 1 0 0\n0 -6 1.5 0 -1 0\n-6 -6 0 0 0 1\n")):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        found = blocks(os.path.join(source, "docs/recipes.md"), "python")
        assert len(found) >= 5
        run(["/usr/bin/python3", "-B", "-c", "\n".join(found)], folder, environment)
        lines = lambda name: text_of(os.path.join(folder, name)).splitlines()
        matrix = lines("grid.mtx")
        assert matrix[1:3] == ["NROWS=3", "NCOLS=8760"] and [len(row.split()) for row in matrix[6:]] == 3 * [8760]
        rows = lines("facades.csv")
        assert len(rows) == 8761 and rows[1].startswith("1,1,1,") and rows[-1].startswith("12,31,24,")
        hours = lines("annual_irradiance/results/total/sun-up-hours.txt")
        values = lines("annual_irradiance/results/total/grid.ill")
        assert len(values) == 3 and {len(row.split()) for row in values} == {len(hours)}
        # Level ground at noon of 21 June: the sun of the weather, and its sky.
        noon = float(values[2].split()[hours.index(f"{(171 * 24) + 12.5}")])
        assert 700 < noon < 950, noon
        assert len(lines("shading.csv")) == 8761


def main():
    program, source, what = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3]
    environment = dict(os.environ, SUNLOAD=program,
                       PATH=os.path.dirname(program) + os.pathsep + os.environ.get("PATH", ""))
    if what == "links":
        expect_links(source)
    else:
        {"tutorial": expect_tutorial, "python": expect_python}[what](source, environment)


main()
