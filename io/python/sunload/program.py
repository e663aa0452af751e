# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Starts the program; its exit codes become exceptions with its words."""

from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
from typing import Callable, Optional, Sequence


class ProgramError(RuntimeError):
    """The program ended otherwise than done; its message, and its exit code in `code`."""

    def __init__(self, message: str, code: int):
        super().__init__(message)
        self.code = code


class InputError(ProgramError):
    """The study, a model, weather or an argument is wrong (exit code 2): every problem, a line each."""


class MachineError(ProgramError):
    """The machine is at a limit: disk, memory, a folder that cannot be written (exit code 3)."""


class Unfinished(ProgramError):
    """Stopped before the end (exit code 75): run again with resume=True."""


ERRORS = {2: InputError, 3: MachineError, 75: Unfinished}


def program() -> str:
    """Path of the program. Raises MachineError where there is none."""
    named = os.environ.get("SUNLOAD")
    if named:
        return os.path.abspath(named) if os.path.dirname(named) else named
    here = pathlib.Path(__file__).resolve()
    # Installed below PREFIX/lib/…, or in the sources that it was built in.
    for parent in here.parents:
        for place in (parent / "bin" / "sunload", parent / "build" / "io" / "sunload"):
            if place.is_file() and os.access(place, os.X_OK):
                return str(place)
    found = shutil.which("sunload")
    if found is None:
        raise MachineError("the program `sunload` is neither on PATH nor beside this package; install it, or name it "
                           "by the environment variable SUNLOAD", 3)
    return found


def _started(words: Sequence[str], folder: Optional[str]) -> subprocess.Popen:
    if folder is not None and not os.path.isdir(folder):
        raise InputError(f"{folder}: is no folder; make it first, or name another", 2)
    try:
        return subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                cwd=folder, encoding="utf-8", errors="replace")
    except OSError as error:
        hint = "set the environment variable SUNLOAD, which names it, to the program `sunload`, or unset it" \
            if os.environ.get("SUNLOAD") else "name the program `sunload` by the environment variable SUNLOAD"
        raise MachineError(f"{words[0]}: cannot be started ({error.strerror}); {hint}", 3) from error


def run(words: Sequence[str], folder: Optional[str] = None, line: Optional[Callable[[str], bool]] = None) -> str:
    """Standard output of `sunload WORDS`, started in `folder`. `line` gets each line of the standard error as it comes
    and tells whether it is of no interest for messages. Raises ProgramError where the exit code is not 0."""
    with _started([program(), *words], folder) as process:
        if line is None:
            out, err = process.communicate()
        else:
            kept = []
            try:
                for text in process.stderr:
                    if not line(text):
                        kept.append(text)
            except BaseException:  # the caller's own, Ctrl-C: the program keeps what is finished
                process.terminate()
                raise
            out, err = process.stdout.read(), "".join(kept)
            process.wait()
    if process.returncode != 0:
        error = ERRORS.get(process.returncode, ProgramError)
        raise error(err.strip() or f"sunload ended with code {process.returncode}", process.returncode)
    return out
