#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every error that a result states is the spread of other seeds: the study of `scripts/validate`, with few seeds.

error_bars_test.py SUNLOAD SOURCE_FOLDER
"""

import math
import os
import sys

SEEDS = {"gather": 12, "shoot": 12}
FALSE_ALARMS = 1e-3  # of the whole test; the seeds are always the same
KINDS = ("patches", "facades", "sensors", "patches, mirror light", "patches, an instant", "sensors, an instant",
         "patches, a day", "facades, an hour of day", "ledger's terms", "ledger's terms, an instant",
         "difference of variants, patches", "difference of variants, facades", "difference of variants, sensors")


def refused(spread, accepted):
    """Off by more than the claim and what chance does, as a factor: errors that are all four times too large or too
    small have the same relative error of their ratio. Few seeds know it badly: Student's t."""
    ratio, error, _ = spread.ratio()
    return abs(math.log(ratio)) > math.log(1 + seeds.CLAIM) + accepted * error / ratio


def with_errors(spread, factor):
    other = seeds.Spread()
    for values, errors in zip(spread.values, spread.errors):
        other.add(values, factor * errors)
    return other


def main():
    program = Program(sys.argv[1])
    program.write("court.obj", seeds.court())
    each = FALSE_ALARMS / (len(KINDS) * len(SEEDS))
    for transport, count in SEEDS.items():
        accepted = t_quantile(1 - each / 2, count - 1)
        found = seeds.spreads(program, transport, count)
        for kind in KINDS:
            assert not refused(found[kind], accepted), (transport, kind, found[kind].ratio())
            # Planted: the deviation of one realization in place of the error of their mean, and too small as often.
            for fault in (math.sqrt(seeds.REALIZATIONS), 1 / math.sqrt(seeds.REALIZATIONS)):
                assert refused(with_errors(found[kind], fault), accepted), (transport, kind, fault)


sys.path.append(os.path.join(sys.argv[2], "scripts", "validation"))
import seeds  # noqa: E402
from methods import t_quantile  # noqa: E402
from program import Program  # noqa: E402

if __name__ == "__main__":
    main()
