#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""On a file system without locks runs and shards have their results, and a word of warning.

no_locks.py SUNLOAD NO_LOCKS_SO
"""

import os
import subprocess
import sys
import tempfile

from same_data import different_data
from skip import skip_where_not_preloaded
from small_study import RESULT, write_study


def main():
    sunload, library = (os.path.abspath(path) for path in sys.argv[1:3])
    without_locks = dict(os.environ, LD_PRELOAD=library)
    skip_where_not_preloaded(sunload, library)
    with tempfile.TemporaryDirectory() as folder:
        write_study(folder, max_edge_m=8, batch_suns=4)

        def run(*arguments, environment=without_locks):
            ran = subprocess.run([sunload, "run", "square.yaml", *arguments], cwd=folder, env=environment, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60)
            assert ran.returncode == 0, ran.stdout
            return ran.stdout

        def same_as_alone(output):
            different = different_data(os.path.join(folder, RESULT.replace("results", "alone")),
                                       os.path.join(folder, RESULT.replace("results", output)))
            assert different == [], different
            left = sorted(os.listdir(os.path.join(folder, output)))
            assert left == ["square"], left

        assert "no locks" not in run("--output", "alone", environment=os.environ)
        said = run("--output", "whole")
        assert "no locks" in said, said
        same_as_alone("whole")
        for shard in ("0/2", "1/2"):
            said = run("--output", "shards", "--shard", shard)
        assert "no locks" in said, said
        same_as_alone("shards")
        print("a run and two shards without locks: the same bits")


if __name__ == "__main__":
    main()
