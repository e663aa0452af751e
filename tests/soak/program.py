# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program as a process: what it said, what it took."""

import os
import re
import signal
import subprocess
import tempfile
import time

DONE, WRONG_INPUT, MACHINE_LIMIT, BUG, UNFINISHED = 0, 2, 3, 70, 75
# What no user may ever read.
CRASHES = re.compile(r"bug in sunload|terminate called|[Aa]ssertion|Sanitizer|runtime error|HDF5-DIAG|std::|\bnan\b")
LONGEST_S = 600  # on the clock, of studies that take a second of a processor: it hangs


class Ran:
    """`wall_s` on the clock, `cpu_s` of processors."""

    def __init__(self, words, code, out, err, wall_s, cpu_s, peak_bytes):
        self.words, self.code, self.out, self.err = words, code, out, err
        self.wall_s, self.cpu_s, self.peak_bytes = wall_s, cpu_s, peak_bytes

    def problems(self, *codes):
        """What is wrong where the exit code must be one of `codes`."""
        what = " ".join(self.words)
        if self.code not in codes:
            yield f"sunload {what}: exit code {self.code}, not {' or '.join(map(str, codes))}: {self.err.strip()[-600:]}"
        if found := CRASHES.search(self.err):
            yield f"sunload {what}: says '{found.group()}': {self.err.strip()[-600:]}"
        if self.code == WRONG_INPUT and not self.err.strip():
            yield f"sunload {what}: refuses without a word"


def peak_bytes_of(process):
    """Largest memory so far; of a child, wait4 would count what it had as a fork of this one, too."""
    try:
        with open(f"/proc/{process}/status", encoding="utf-8") as file:
            return next((1024 * int(line.split()[1]) for line in file if line.startswith("VmHWM:")), 0)
    except OSError:
        return 0


class Program:
    """Runs in `folder`, with one thread unless told otherwise: estimates of time are then those of one."""

    def __init__(self, path, folder):
        self.path, self.folder = path, folder
        self.environment = {**os.environ, "SUNLOAD_THREADS": "1"}

    def start(self, *words, **environment):
        """A process, its files of output beside it."""
        out, err = tempfile.TemporaryFile(), tempfile.TemporaryFile()
        process = subprocess.Popen([self.path, *words], cwd=self.folder, stdout=out, stderr=err, stdin=subprocess.DEVNULL,
                                   env={**self.environment, **environment})
        process.files, process.words = (out, err), words
        return process

    def finish(self, process, kill_after_s=None, kill_with=signal.SIGKILL):
        """Waits; ends it after that time, with that signal."""
        begin, pause, peak = time.monotonic(), 0.001, 0
        while True:
            peak = max(peak, peak_bytes_of(process.pid))
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            passed = time.monotonic() - begin
            if kill_after_s is not None and passed > kill_after_s:
                os.kill(process.pid, kill_with)  # send_signal would wait for it, and know its status alone
                kill_after_s = None
            if passed > LONGEST_S:
                os.kill(process.pid, signal.SIGKILL)
            time.sleep(pause)
            pause = min(0.01, 1.5 * pause)
        process.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for file in process.files:
            file.seek(0)
            texts.append(file.read().decode("utf-8", errors="replace"))
            file.close()
        wall_s = time.monotonic() - begin
        return Ran(process.words, process.returncode, *texts, wall_s, usage.ru_utime + usage.ru_stime, peak)

    def run(self, *words, **environment):
        return self.finish(self.start(*words, **environment))
