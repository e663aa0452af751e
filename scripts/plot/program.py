# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program sunload, for what it knows better than a script."""

import json
import os
import shutil
import subprocess

from reading import InputError


# From the folder of these scripts: as built, and as installed (PREFIX/share/sunload/scripts/plot).
BESIDE = ("../../build/io/sunload", "../../../../bin/sunload")
NOWHERE = "neither in build/io, nor installed with this script, nor on PATH"


def beside():
    """The program that belongs to these scripts, or None."""
    folder = os.path.dirname(os.path.realpath(__file__))
    programs = (os.path.normpath(os.path.join(folder, path)) for path in BESIDE)
    return next((path for path in programs if os.path.isfile(path) and os.access(path, os.X_OK)), None)


class Program:
    """None where it is not found: `path` is empty then."""

    def __init__(self, named=None):
        self.path = named or os.environ.get("SUNLOAD") or beside() or shutil.which("sunload")
        self._compared = {}

    def run(self, *words):
        """Its standard output."""
        try:
            ran = subprocess.run([self.path, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
        except OSError as error:
            raise InputError(f"{self.path}: {error.strerror}; name the program sunload with --sunload") from error
        if ran.returncode != 0:
            raise InputError(ran.stderr.strip() or f"{self.path} {words[0]} ended with {ran.returncode}")
        return ran.stdout

    def compared(self, base, variant):
        """What `compare --json` tells of two results; it is asked once."""
        if not self.path:
            raise InputError(f"the program sunload, which compares what results have in common, is {NOWHERE}; "
                             "name it with --sunload")
        if (base, variant) not in self._compared:
            self._compared[base, variant] = json.loads(self.run("compare", base, variant, "--json"))
        return self._compared[base, variant]


def add_program(p):
    p.add_argument("--sunload", metavar="PROGRAM", help="the program (default: $SUNLOAD, that of build/io or "
                   "installed with this script, or that on PATH)")
