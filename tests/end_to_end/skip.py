# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that cannot run here: the test runner tells them as skipped (SKIP_RETURN_CODE)."""

import os
import subprocess
import sys

SKIPPED = 77


def skip(why):
    """Ends the test; scripts/not-run holds the reason against tests/may_not_run.txt."""
    print(f"NOT RUN: {why}")
    sys.exit(SKIPPED)


def skip_where_not_preloaded(program, library):
    """Builds with sanitizers do not start with another library before theirs."""
    ran = subprocess.run([program, "--version"], env=dict(os.environ, LD_PRELOAD=library), capture_output=True)
    if ran.returncode != 0:
        skip("this build does not start with a preloaded library")
