# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `check` foretold, against what a run took."""

import os
import shutil

from program import DONE

FACTOR = 3
# Below, the start of the program and the clock's grain are what is measured.
LEAST_S, LEAST_BYTES = 1.0, 50e6


def within(what, foretold, took, least):
    """Yields where one is more than three times the other, and either is large enough to be told."""
    if max(foretold, took) >= least and not took / FACTOR <= foretold <= took * FACTOR:
        yield f"{what}: {foretold:.3g} foretold, {took:.3g} taken"


def of_run(program, told):
    """A run in one thread that keeps its batches; `told`: what `check --json` said of it."""
    ran = program.run("run", "study.yaml", "--output", "measured", "--keep-batches", "--progress", "none")
    yield from ran.problems(DONE)
    folder = os.path.join(program.folder, "measured")
    there = sum(os.path.getsize(os.path.join(at, name)) for at, _, names in os.walk(folder) for name in names)
    shutil.rmtree(folder, ignore_errors=True)
    variants = told["variants"]
    yield from within("seconds", sum(v["seconds"] for v in variants), ran.cpu_s, LEAST_S)
    yield from within("bytes of memory", max(v["memory_bytes"] for v in variants), ran.peak_bytes, LEAST_BYTES)
    yield from within("bytes on the disk", sum(v["disk_bytes"] for v in variants), there, LEAST_BYTES)
