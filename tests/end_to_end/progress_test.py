#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What --progress tells: a bar on a terminal, JSON as docs/cluster.md says, few lines for logs, or warnings alone.

progress_test.py SUNLOAD SOURCE_FOLDER
"""

import fcntl
import json
import os
import pty
import re
import struct
import subprocess
import sys
import tempfile
import termios
import time

from small_study import write_study

WIDE, NARROW = 100, 40
SUNS = 12
STAGES = ["trace lines", "sun positions"]
LINE_PAUSE_S = 10


def run(sunload, folder, style):
    begin = time.monotonic()
    ran = subprocess.run([sunload, "run", "square.yaml", "--overwrite", "--progress", style], cwd=folder,
                         stderr=subprocess.PIPE, text=True)
    assert ran.returncode == 0, ran.stderr
    return ran.stderr.splitlines(), time.monotonic() - begin


def on_terminal(words, folder, columns):
    """Everything that a program writes to its terminal, and its exit code."""
    process, terminal = pty.fork()
    if process == 0:
        fcntl.ioctl(2, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        os.chdir(folder)
        os.execv(words[0], words)
    seen = b""
    while True:
        try:
            piece = os.read(terminal, 4096)
        except OSError:  # how Linux says that the other end is closed
            break
        if not piece:
            break
        seen += piece
    return seen.decode(), os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])


def check_bar(sunload, folder, columns):
    seen, code = on_terminal([sunload, "run", "square.yaml", "--overwrite"], folder, columns)
    assert code == 0, seen
    drawings = re.findall("\r([^\r\n]*)\033\\[K", seen)
    assert drawings, "no bar on a terminal\n" + seen
    too_wide = [text for text in drawings if len(text) >= columns]
    assert not too_wide, f"wider than the terminal: {too_wide}"
    for stage in STAGES:
        assert any(text.startswith(f"baseline {stage} ") for text in drawings), f"{stage}: {drawings}"
    last = drawings[-1]
    # The bar has its own line: what follows it does not begin in its midst.
    assert seen[seen.rindex(last) + len(last):].startswith("\033[K\r\n"), repr(seen[-400:])
    if columns == WIDE:
        whole = rf"baseline sun positions \[=+\] 100 %  {SUNS}/{SUNS} suns, [0-9.]+ Mrays/s, 0:00 left, [0-9]+ MiB"
        assert re.fullmatch(whole, last), last
    print(f"bar: {len(drawings)} drawings, the last: {last}")


def documented_keys(source):
    with open(os.path.join(source, "docs/cluster.md")) as file:
        return [list(json.loads(line)) for line in file if line.startswith("{") and line.rstrip().endswith("}")]


def check_json(sunload, folder, source):
    lines, _ = run(sunload, folder, "json")
    objects = [json.loads(line) for line in lines]
    documented = documented_keys(source)
    assert len(documented) == 2, documented
    unknown = [found for found in objects if list(found) not in documented]
    assert not unknown, f"not as documented: {unknown}"
    states = [found for found in objects if "stage" in found]
    assert [found for found in objects if "message" in found], "no messages"
    stages = [stage for stage in dict.fromkeys(found["stage"] for found in states) if stage != "refine mesh"]
    assert stages == STAGES, states
    for stage in STAGES:
        shares = [found["share"] for found in states if found["stage"] == stage]
        assert shares == sorted(shares) and 0 <= shares[0] and shares[-1] == 1, shares
    last = states[-1]
    assert (last["suns_done"], last["suns"], last["left_s"]) == (SUNS, SUNS, 0), last
    assert last["rays_per_s"] > 0 and last["memory_bytes"] > 2**20 and last["elapsed_s"] > 0, last
    print(f"json: {len(objects)} objects with the documented keys")


def check_lines(sunload, folder):
    lines, seconds = run(sunload, folder, "lines")
    told = [line for line in lines if re.match("baseline: (refine mesh|trace lines|skies and suns|sun positions) ", line)]
    assert len(told) <= seconds / LINE_PAUSE_S, f"{len(told)} lines within {seconds} s: {told}"
    warnings = [line for line in lines if "warning: " in line]
    assert warnings, "the study has something to warn of, or the next check means nothing"
    quiet, _ = run(sunload, folder, "none")
    assert quiet == warnings, quiet


def main():
    sunload, source = os.path.abspath(sys.argv[1]), sys.argv[2]
    with tempfile.TemporaryDirectory() as folder:
        write_study(folder, max_edge_m=2, batch_suns=5)
        for columns in (WIDE, NARROW):
            check_bar(sunload, folder, columns)
        check_json(sunload, folder, source)
        check_lines(sunload, folder)


if __name__ == "__main__":
    main()
