#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/planning/check fails where a rule fails, names the place, and does not pass where it looks at nothing.

planning_test.py SUNLOAD SOURCE_FOLDER
"""

import csv
import os
import subprocess
import sys
import tempfile

from skip import skip
from small_study import write_study

# The house of the square: its front looks south (the whole day of sun on 21 March), its back north (nearly none).
# A wall before it takes the sun from the front, and keeps some from the sides. It has no surface `window`.
CASES = """
measures:
  front: {rule: sun_hours, date: 2026-03-21, least_h: 6, of: {facade: "house/south_1"}}
  all: {rule: sun_hours, date: 2026-03-21, least_h: 6, of: {facade: "*"}}
  nothing: {rule: sun_hours, date: 2026-03-21, least_h: 6, of: {surface: window}}
  told: {rule: sun_hours, date: 2026-03-21, of: {facade: "*"}}
variants:
  - {name: baseline}
  - {name: walled, scene: {edit: [{add: {box: {position_m: [0, 1.5], size_m: [24, 0.5, 14]}, material: plaster, name: screen}}]}}
"""


def check(program, source, folder, *words):
    environment = dict(os.environ, SUNLOAD=program)
    ran = subprocess.run(["/usr/bin/python3", "-B", os.path.join(source, "scripts/planning/check"), "square.yaml", *words],
                         cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
    print(words, ran.returncode, ran.stdout, ran.stderr)
    return ran


def rows(folder, name):
    with open(os.path.join(folder, "planning", name), encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def main():
    program, source = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    probe = subprocess.run(["/usr/bin/python3", "-c", "import h5netcdf, pandas, xarray"], stderr=subprocess.DEVNULL, check=False)
    if probe.returncode != 0:
        skip("xarray, h5netcdf or pandas is missing")
    with tempfile.TemporaryDirectory() as folder:
        write_study(folder, max_edge_m=4, batch_suns=64)
        with open(os.path.join(folder, "square.yaml"), "a", encoding="utf-8") as study:
            study.write(CASES)

        both = check(program, source, folder, "--measure", "all")
        assert both.returncode == 1
        failing = {(row["variant"], row["name"]) for row in rows(folder, "failures.csv")}
        assert {variant for variant, _ in failing} == {"baseline", "walled"}
        assert len(rows(folder, "measures.csv")) > len(failing)

        # What is dark already is no failure of the wall; the front is.
        new = check(program, source, folder, "--measure", "all", "--against", "baseline")
        assert new.returncode == 1
        made_dark = {row["name"] for row in rows(folder, "failures.csv") if row["name"].startswith("house/")}
        assert made_dark and not {("baseline", name) for name in made_dark} & failing, made_dark
        assert "FAIL walled: all of facade house/" in new.stdout
        page = os.path.join(folder, "planning/walled.html")
        assert os.path.exists(page) or "no page" in new.stderr

        # Without the wall the same measure passes: the verdict is of the model, not of the script.
        study = os.path.join(folder, "square.yaml")
        with open(study, encoding="utf-8") as file:
            text = file.read()
        with open(study, "w", encoding="utf-8") as file:
            file.write(text[:text.index("  - {name: walled")])
        passed = check(program, source, folder, "--measure", "front", "--group", "whole")
        assert passed.returncode == 0 and rows(folder, "failures.csv") == []

        for words in (["--measure", "none"], ["--measure", "told"], ["--measure", "nothing"], [], ["--against", "none"], ["--against", "baseline"]):
            refused = check(program, source, folder, *words)
            assert refused.returncode == 2 and refused.stderr and "Traceback" not in refused.stderr, words
            assert "Warning" not in refused.stderr, words


main()
