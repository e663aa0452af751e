#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""No more statistical tests run than share the suite's budget of false alarms (tests/support/statistics.h).

budget.py begin FOLDER                 empties the folder that every process writes its count to
budget.py end FOLDER SOURCE_FOLDER     adds them up
"""

import pathlib
import re
import shutil
import sys


def begin(folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)


def end(folder, source):
    header = (source / "tests/support/statistics.h").read_text(encoding="utf-8")
    declared = int(re.search(r"declared_statistical_tests = (\d+);", header).group(1))
    count = sum(int(file.read_text(encoding="utf-8")) for file in folder.iterdir())
    print(f"{count} statistical tests ran, {declared} are declared")
    return f"raise declared_statistical_tests to {count}" if count > declared else 0


if __name__ == "__main__":
    paths = [pathlib.Path(word) for word in sys.argv[2:]]
    sys.exit(begin(*paths) if sys.argv[1] == "begin" else end(*paths))
