#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/not-run on what ctest itself writes: skipped tests are named, those on no list fail.

not_run_test.py SOURCE_FOLDER
"""

import os
import re
import subprocess
import sys
import tempfile

from skip import SKIPPED

ALLOWED = {"io/Sun.Table": "data/city of the real models is not here", "end_to_end/slurm": "slurmctld is not installed",
           "solver/surface/Every/RayCasterOn.Leaks/avx512": "avx512 is missing on this processor",
           "end_to_end/Shards.RanksThatAreStoppedGoOn": "no mpirun (package openmpi-bin)",
           "end_to_end/view": "node is not installed", "end_to_end/view_use": "chromium is not installed"}
WRONG = {"end_to_end/export": "python3-h5py is not installed", "io/Sun.Other": "", "end_to_end/exportXvtk": "python3-vtk9 is not installed"}


def listed(folder, tests):
    """A folder of tests that are skipped: as googletest is, and as scripts are."""
    with open(os.path.join(folder, "CTestTestfile.cmake"), "w", encoding="utf-8") as file:
        file.write('add_test(fine "true")\n')
        for k, (name, why) in enumerate(tests.items()):
            said = f"a.cpp:3: Skipped\\nNOT RUN: {why}\\n[  SKIPPED ] a\\n" if why else "[  SKIPPED ] a\\n"
            code = SKIPPED if k % 2 else 0
            file.write(f'add_test("{name}" "sh" "-c" [=[printf \'{said}\'; exit {code}]=])\n')
            how = f'SKIP_RETURN_CODE {SKIPPED}' if code else r'SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]"'
            file.write(f'set_tests_properties("{name}" PROPERTIES {how})\n')


def judged(source, tests):
    with tempfile.TemporaryDirectory(prefix="sunload-not-run-") as folder:
        listed(folder, tests)
        ran = subprocess.run(["ctest", "--output-junit", "all.xml"], cwd=folder, stdout=subprocess.PIPE, encoding="utf-8")
        assert ran.returncode == 0 and len(re.findall(r"\*Skipped", ran.stdout)) == len(tests), ran.stdout
        ran = subprocess.run([os.path.join(source, "scripts/not-run"), os.path.join(folder, "all.xml")],
                             stdout=subprocess.PIPE, encoding="utf-8")
    return ran.returncode, ran.stdout


def main():
    source = os.path.abspath(sys.argv[1])
    assert judged(source, {}) == (0, "")
    code, said = judged(source, ALLOWED)
    assert code == 0 and all(f"{name}: {why}\n" in said for name, why in ALLOWED.items()), said
    code, said = judged(source, {**ALLOWED, **WRONG})
    assert code == 1 and said.count("<- must run") == len(WRONG), said
    assert all(re.search(rf"{re.escape(name)}: .*<-", said) for name in WRONG), said
    ran = subprocess.run([os.path.join(source, "scripts/not-run"), os.path.join(source, "LICENSE")], stderr=subprocess.DEVNULL)
    assert ran.returncode == 2, "no results, no verdict"


if __name__ == "__main__":
    main()
