# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Imported first by every script: goes on with a Python that has the packages of plots.

The python3 that stands first on PATH may be one without them, as in a virtual environment. Then the
others of PATH and the system's own are asked, and the first that has all of them takes over."""

import glob
import importlib
import os
import re
import subprocess
import sys

PACKAGES = ("numpy", "h5py", "matplotlib")
DEBIAN = {"numpy": "python3-numpy", "h5py": "python3-h5py", "matplotlib": "python3-matplotlib"}
LEAST_VERSION = (3, 9)  # zoneinfo
SYSTEM = ("/usr/bin/python3", "/usr/local/bin/python3")
# Set for the one that takes over: none looks twice.
CHOSEN = "SUNLOAD_PLOT_PYTHON"
PROBE = """
import sys
missing = []
for name in sys.argv[1:]:
    try:
        __import__(name)
    except Exception:
        missing.append(name)
print(" ".join(missing), "%d.%d" % sys.version_info[:2], sep=";")
"""


def missing_here():
    """Packages that this interpreter lacks."""
    missing = []
    for name in PACKAGES:
        try:
            importlib.import_module(name)
        except ImportError:
            missing.append(name)
    return missing


def identity(python):
    """What tells interpreters apart: the file at the end of links; of a virtual environment, which has packages of
    its own, the link."""
    is_environment = os.path.exists(os.path.join(os.path.dirname(python), "..", "pyvenv.cfg"))
    return os.path.abspath(python) if is_environment else os.path.realpath(python)


def others():
    """Other interpreters, as they stand on PATH, each once."""
    folders = [folder for folder in os.environ.get("PATH", "").split(os.pathsep) if folder]
    names = [name for folder in folders for name in sorted(glob.glob(os.path.join(glob.escape(folder), "python3*")))
             if re.fullmatch(r"python3(\.\d+)?", os.path.basename(name))]
    seen, found = {identity(sys.executable)}, []
    for name in [*names, *SYSTEM]:
        if identity(name) not in seen and os.access(name, os.X_OK):
            seen.add(identity(name))
            found.append(name)
    return found


def missing_in(python):
    """Packages that another interpreter lacks; None where it does not start."""
    try:
        answer = subprocess.run([python, "-c", PROBE, *PACKAGES], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                encoding="utf-8", timeout=60, check=True).stdout
        missing, version = answer.strip().split(";")
    except (OSError, ValueError, subprocess.SubprocessError):
        return None
    if tuple(int(part) for part in version.split(".")) < LEAST_VERSION:
        return [f"Python 3.9 or newer (is {version})"]
    return missing.split()


def go_on():
    """Returns where all packages are here; else another interpreter takes over, or the exit code is 3."""
    lacking = {sys.executable: missing_here()}
    if not lacking[sys.executable]:
        return
    if not os.environ.get(CHOSEN):
        for python in others():
            missing = missing_in(python)
            if missing is None:
                continue
            lacking[python] = missing
            if not missing:
                os.environ[CHOSEN] = python
                os.execv(python, [python, *sys.argv])
    for python, packages in lacking.items():
        print(f"{python}: lacks {', '.join(packages)}", file=sys.stderr)
    needed = [DEBIAN[name] for name in PACKAGES if all(name in packages for packages in lacking.values())]
    print(f"plots need {', '.join(PACKAGES)} (Debian: apt install {' '.join(needed or DEBIAN.values())}; "
          f"or: {sys.executable} -m pip install {' '.join(PACKAGES)})", file=sys.stderr)
    sys.exit(3)


go_on()
