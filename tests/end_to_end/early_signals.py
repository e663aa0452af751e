#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A signal that comes before `main` begins, when libraries are still being set up, ends a run with
exit code 75 all the same, so that a scheduler starts it again; other commands end by the signal.

early_signals.py SUNLOAD EARLY_SIGNAL_SO
"""

import os
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from skip import skip_where_not_preloaded
from small_study import RESULT, write_study

UNFINISHED = 75


def call(program, library, number, words, folder, before=None):
    environment = dict(os.environ, LD_PRELOAD=library, EARLY_SIGNAL=str(int(number)))
    return subprocess.run([program, *words], cwd=folder, env=environment, preexec_fn=before,
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def ignore_hangup():
    signal.signal(signal.SIGHUP, signal.SIG_IGN)


def main():
    program, library = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        write_study(folder, 2, 4)
        skip_where_not_preloaded(program, library)
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1, signal.SIGHUP):
            ran = call(program, library, number, ["run", "square.yaml"], folder)
            if ran.returncode != UNFINISHED or number.name not in ran.stderr:
                problems.append(f"{number.name}: run ends with {ran.returncode}: {ran.stderr}")
            ran = call(program, library, number, ["check", "square.yaml"], folder)
            if ran.returncode != -number:
                problems.append(f"{number.name}: check ends with {ran.returncode}: {ran.stderr}")
        # As started by nohup.
        ran = call(program, library, signal.SIGHUP, ["run", "square.yaml"], folder, ignore_hangup)
        if ran.returncode != 0 or not os.path.exists(os.path.join(folder, RESULT)):
            problems.append(f"an ignored SIGHUP ends a run with {ran.returncode}: {ran.stderr}")
    print("\n".join(problems) or "all early signals end as they should")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
