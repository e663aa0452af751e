# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program sunload, for what it knows better than a script."""

import json
import os
import shutil
import subprocess

from reading import InputError


class Program:
    """None where it is not found: `path` is empty then."""

    def __init__(self, named=None):
        built = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../build/io/sunload")
        self.path = named or os.environ.get("SUNLOAD") or (built if os.access(built, os.X_OK) else shutil.which("sunload"))
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
            raise InputError("the program sunload, which compares what results have in common, is neither in build/io "
                             "nor on PATH; name it with --sunload")
        if (base, variant) not in self._compared:
            self._compared[base, variant] = json.loads(self.run("compare", base, variant, "--json"))
        return self._compared[base, variant]


def add_program(p):
    p.add_argument("--sunload", metavar="PROGRAM", help="the program (default: $SUNLOAD, that of build/io, or that on PATH)")
