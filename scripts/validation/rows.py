# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What validation finds: rows of a reference beside our value, and what is said of them."""

import dataclasses
import math


@dataclasses.dataclass
class Row:
    """`limit`: how far off it may be, None where nothing decides; `error`: standard error, or None."""

    section: str
    case: str
    reference: float
    ours: float
    error: float | None
    limit: float | None

    @property
    def off(self):
        return self.ours - self.reference

    @property
    def z(self):
        """Off in standard errors; None without them, or where they are roundings."""
        if not self.error or self.error < 1e-9 * abs(self.reference):
            return None
        return self.off / self.error

    @property
    def share_of_limit(self):
        if self.limit is None:
            return 0.0
        return abs(self.off) / self.limit if self.limit > 0 else math.inf * (self.off != 0)

    @property
    def holds(self):
        return self.limit is None or abs(self.off) <= self.limit


@dataclasses.dataclass
class Section:
    """One line of the summary. `passed`: of what is judged otherwise than by rows; `said`: a sentence."""

    name: str
    source: str
    rows: list
    passed: bool = True
    said: str = ""
    checks: int = 0  # further ones, each passed or not as `passed` says
    skipped: str = ""

    @property
    def verdict(self):
        if self.skipped:
            return "not run"
        if not self.passed or not all(row.holds for row in self.rows):
            return "**FAILS**"
        return "holds" if self.checks or any(row.limit is not None for row in self.rows) else "told"
