#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""kill -9 at random moments: the result of the resumed run is that of an undisturbed one.

kills.py SUNLOAD [--count N] [--seed S]     N kills (default 10), a new study after each finished run
"""

import argparse
import glob
import os
import random
import signal
import subprocess
import sys
import tempfile
import time

from same_data import different_data
from small_study import RESULT, write_study

BATCHES = 12


def start(sunload, folder):
    return subprocess.Popen([sunload, "run", "square.yaml", "--resume", "--progress", "none"], cwd=folder,
                            stderr=subprocess.PIPE, text=True)


def batches(folder):
    return {name: os.stat(name).st_mtime_ns
            for name in glob.glob(os.path.join(folder, "results/square/.work/*/*.batch"))}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sunload")
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    sunload = os.path.abspath(options.sunload)
    moments = random.Random(options.seed)
    with tempfile.TemporaryDirectory() as folder:
        write_study(folder, max_edge_m=0.7, batch_suns=1)
        begin = time.monotonic()
        assert subprocess.run([sunload, "run", "square.yaml", "--output", "alone"], cwd=folder,
                              stderr=subprocess.DEVNULL).returncode == 0
        whole_s = time.monotonic() - begin
        kills = rounds = with_some_finished = 0
        while kills < options.count:
            rounds += 1
            subprocess.run(["rm", "-rf", os.path.join(folder, "results")], check=True)
            code = None
            while code != 0:
                before = batches(folder)
                process = start(sunload, folder)
                if kills < options.count:
                    time.sleep(moments.uniform(0, whole_s))
                    process.send_signal(signal.SIGKILL)
                said = process.communicate()[1]
                code = process.returncode
                assert code in (0, -signal.SIGKILL), f"exit code {code}\n{said}"
                if code != 0:
                    kills += 1
                    after = batches(folder)
                    with_some_finished += bool(after)
                    # What was finished stays as it is: nothing is lost, nothing is done again.
                    lost = {name for name in before if after.get(name) != before[name]}
                    merged = os.path.exists(os.path.join(folder, RESULT))
                    assert merged or not lost, f"finished batches lost or computed again: {lost}"
            alone = os.path.join(folder, RESULT.replace("results", "alone"))
            different = different_data(alone, os.path.join(folder, RESULT))
            assert different == [], f"after {kills} kills: {different}"
        assert with_some_finished * 4 >= kills, "the kills came too early to mean anything"
    print(f"{kills} kills in {rounds} runs of {BATCHES} batches ({with_some_finished} with some finished): "
          "the same bits, no finished batch lost or done again")


if __name__ == "__main__":
    main()
