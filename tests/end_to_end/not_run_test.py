#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/not-run: tests that could not run are named, and those that are on no list fail.

not_run_test.py SOURCE_FOLDER
"""

import os
import subprocess
import sys
import tempfile


def judged(source, *missed):
    with tempfile.NamedTemporaryFile("w", suffix=".log", encoding="utf-8") as log:
        log.write("1/2 Testing: x\nsome output\n" + "".join(f"NOT RUN: {line}\n" for line in missed))
        log.flush()
        ran = subprocess.run([os.path.join(source, "scripts/not-run"), log.name], stdout=subprocess.PIPE, encoding="utf-8")
    return ran.returncode, ran.stdout


def main():
    source = os.path.abspath(sys.argv[1])
    assert judged(source) == (0, "")
    allowed = ("Sun.Table: reference/01_sun/spa.csv is missing", "end_to_end/slurm: slurmctld is not installed",
               "avx512 is missing on this processor", "ranks of MPI that are stopped: no mpirun (package openmpi-bin)")
    code, said = judged(source, *allowed)
    assert code == 0 and all(line in said for line in allowed), said
    for wrong in ("end_to_end/export: python3-h5py is not installed", "Sun.Table: skipped", "end_to_end/exportXvtk: python3-vtk9 is not installed"):
        code, said = judged(source, allowed[0], wrong)
        assert code == 1 and f"{wrong}   <-" in said, said


if __name__ == "__main__":
    main()
