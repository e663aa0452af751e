#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every write fails once, a kill comes before every one, and a disk becomes full: exit code 3, a message,
nothing lost, nothing left over.

faults.py SUNLOAD FAIL_WRITES_SO [--every N]     every N-th of the program's calls (default: each)
faults.py SUNLOAD FAIL_WRITES_SO --full-disk     the disk alone
"""

import argparse
import errno
import os
import signal
import subprocess
import sys
import tempfile

from same_data import different_data
from skip import skip, skip_where_not_preloaded
from small_study import RESULT, write_study

ERRORS = (errno.ENOSPC, errno.EIO, errno.EDQUOT)
MACHINE_LIMIT = 3


class Faults:
    def __init__(self, sunload, library, folder):
        self.sunload, self.library, self.folder = sunload, library, folder
        write_study(folder, max_edge_m=8, batch_suns=4)
        assert self.run("run", "square.yaml", "--output", "alone").returncode == 0
        self.alone = self.path(RESULT.replace("results", "alone"))

    def path(self, name):
        return os.path.join(self.folder, name)

    def run(self, *arguments, **fault):
        environment = dict(os.environ, **{name: str(value) for name, value in fault.items()})
        if fault:
            environment.update(LD_PRELOAD=self.library, FAIL_BELOW=self.path("results"),
                               FAIL_COUNT=self.path("count"))
        return subprocess.run([self.sunload, *arguments], cwd=self.folder, env=environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)

    def start_afresh(self):
        subprocess.run(["rm", "-rf", self.path("results")], check=True)

    def calls(self, arguments):
        """How often a run that nothing disturbs changes a file."""
        self.start_afresh()
        ran = self.run(*arguments, FAIL_AT=0)
        assert ran.returncode == 0, ran.stdout
        with open(self.path("count")) as file:
            return int(file.read())

    def check_resumed(self, shards, what):
        for shard in shards:
            ran = self.run("run", "square.yaml", "--resume", *shard)
            assert ran.returncode == 0, f"{what}: resuming ended with {ran.returncode}\n{ran.stdout}"
        different = different_data(self.alone, self.path(RESULT))
        assert different == [], f"{what}: other data: {different}"
        left = [name for _, folders, names in os.walk(self.path("results")) for name in folders + names]
        assert left == ["square", "baseline.h5"], f"{what}: left over: {left}"

    def check(self, arguments, shards, every):
        """Lets the calls of a run fail, one run for each."""
        count = self.calls(arguments)
        # A fault may hit what need not succeed (flushing a folder, a file that another one replaces).
        survived = 0
        for k in range(1, count + 1, every):
            number = ERRORS[k // every % len(ERRORS)]
            stays = k // every % 2
            what = f"call {k} of {count} fails with {errno.errorcode[number]}" + (" and all after it" if stays else "")
            self.start_afresh()
            ran = self.run(*arguments, FAIL_AT=k, FAIL_WITH=number, FAIL_ON=stays)
            assert ran.returncode in (0, MACHINE_LIMIT), f"{what}: exit code {ran.returncode}\n{ran.stdout}"
            said = "cannot" in ran.stdout and os.strerror(number) in ran.stdout
            # Without the file of the lines, which only saves work, the run goes on and says so.
            survived += ran.returncode == 0 and not said
            assert ran.returncode == 0 or said, f"{what}: does not say so\n{ran.stdout}"
            self.check_resumed(shards, what)
        print(f"{' '.join(arguments)}: {len(range(1, count + 1, every))} of {count} calls failed, "
              f"{survived} of them without a word")
        assert survived * 20 <= count, "faults go unnoticed"

    def check_kills(self, arguments, shards, every):
        """Kills a run before each of its calls, removals too: the next one leaves the result and nothing else."""
        self.start_afresh()
        assert self.run(*arguments, FAIL_AT=0, FAIL_KILL=1).returncode == 0
        with open(self.path("count")) as file:
            count = int(file.read())
        for k in range(1, count + 1, every):
            self.start_afresh()
            ran = self.run(*arguments, FAIL_AT=k, FAIL_KILL=1)
            assert ran.returncode == -signal.SIGKILL, f"call {k}: exit code {ran.returncode}\n{ran.stdout}"
            self.check_resumed(shards, f"killed before call {k} of {count}")
        print(f"{' '.join(arguments)}: killed before {len(range(1, count + 1, every))} of {count} calls, nothing left over")


def check_full_disk(sunload):
    """Tmpfs of growing size: the run fits into the last of them."""
    with tempfile.TemporaryDirectory() as folder:
        if os.geteuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "none", folder],
                                               stderr=subprocess.DEVNULL).returncode != 0:
            skip("mounting a tmpfs needs root")
        try:
            write_study(folder, max_edge_m=3, batch_suns=2)
            codes = []
            for size in (64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384):
                subprocess.run(["mount", "-o", f"remount,size={size}k", folder], check=True)
                ran = subprocess.run([sunload, "run", "square.yaml", "--resume"], cwd=folder,
                                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
                codes.append(ran.returncode)
                assert ran.returncode in (0, MACHINE_LIMIT), ran.stdout
                if ran.returncode == 0:
                    break
                assert "space" in ran.stdout, ran.stdout
            assert codes[-1] == 0 and codes[0] == MACHINE_LIMIT, codes
            with tempfile.TemporaryDirectory() as other:
                write_study(other, max_edge_m=3, batch_suns=2)
                subprocess.run([sunload, "run", "square.yaml"], cwd=other, check=True, stderr=subprocess.DEVNULL)
                different = different_data(os.path.join(folder, RESULT), os.path.join(other, RESULT))
            assert different == [], different
            print(f"full disk: {len(codes) - 1} runs out of space, then the same bits")
        finally:
            subprocess.run(["umount", folder], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sunload")
    parser.add_argument("library")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--full-disk", action="store_true")
    options = parser.parse_args()
    if options.full_disk:
        check_full_disk(os.path.abspath(options.sunload))
        return
    sunload, library = os.path.abspath(options.sunload), os.path.abspath(options.library)
    skip_where_not_preloaded(sunload, library)
    with tempfile.TemporaryDirectory() as folder:
        faults = Faults(sunload, library, folder)
        faults.check(["run", "square.yaml"], [[]], options.every)
        halves = [["--shard", "0/2"], ["--shard", "1/2"]]
        faults.check(["run", "square.yaml", "--shard", "0/2"], halves, options.every)
        faults.check_kills(["run", "square.yaml"], [[]], options.every)
        faults.check_kills(["run", "square.yaml", "--shard", "0/2"], halves, options.every)


if __name__ == "__main__":
    main()
