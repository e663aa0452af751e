# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that cannot run here: the test runner tells them as skipped (SKIP_RETURN_CODE)."""

import sys

SKIPPED = 77


def skip(why):
    """Ends the test; scripts/not-run holds the reason against tests/may_not_run.txt."""
    print(f"NOT RUN: {why}")
    sys.exit(SKIPPED)
