# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/validate."""

import argparse
import os
import sys
import time

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
sys.path.append(os.path.join(ROOT, "scripts", "plot"))

import interpreter  # noqa: E402,F401  goes on with a Python that has h5py and numpy

import boxes  # noqa: E402
import cases  # noqa: E402
import furnaces  # noqa: E402
import measured  # noqa: E402
import meshes  # noqa: E402
import methods  # noqa: E402
import page  # noqa: E402
import pairs  # noqa: E402
import reference_tests  # noqa: E402
import seeds  # noqa: E402
from program import Program  # noqa: E402

KINDS = ("reference", "cases", "furnaces", "boxes", "methods", "meshes", "seeds", "pairs", "measured")


def main():
    parser = argparse.ArgumentParser(prog="scripts/validate")
    parser.add_argument("--only", action="append", choices=KINDS, help="leave the others out")
    parser.add_argument("-o", "--output", default=os.path.join(ROOT, "docs"), help="folder of the page")
    arguments = parser.parse_args()
    build = os.path.join(ROOT, "build")
    begin = time.monotonic()

    def tell(what):
        print(f"{time.monotonic() - begin:6.0f} s  {what}", file=sys.stderr, flush=True)

    program = Program(os.path.join(build, "io", "sunload"), arguments.output)
    sections = []
    for kind in arguments.only or KINDS:
        if kind == "reference":
            sections += reference_tests.all_sections(build, tell)
        else:
            made = {"cases": cases, "furnaces": furnaces, "boxes": boxes, "methods": methods, "meshes": meshes,
                    "seeds": seeds, "pairs": pairs, "measured": measured}[kind]
            sections += made.sections(program, tell)
    page.write(sections, os.path.join(arguments.output, "validation.md"),
               os.path.join(arguments.output, "validation.csv"))
    failed = [s.name for s in sections if "FAILS" in s.verdict]
    tell("written: " + os.path.join(arguments.output, "validation.md"))
    for name in failed:
        print(f"does not hold: {name}", file=sys.stderr)
    return 1 if failed else 0


sys.exit(main())
