# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the compiled module: beside this package where it is installed, beside the program where it was built."""

from __future__ import annotations

import glob
import importlib
import importlib.machinery
import importlib.util
import os
from types import ModuleType

from . import program

NAME = "_native"


def module() -> ModuleType:
    """The module. Raises MachineError where there is none, or none that this Python can load."""
    folders = [os.path.dirname(os.path.abspath(__file__))]
    try:
        folders.append(os.path.join(os.path.dirname(os.path.realpath(program.program())), "python"))
    except program.MachineError:
        pass  # the module may be there without the program
    why = "it is part of builds that find pybind11 and Python's headers"
    for folder in folders:
        for suffix in importlib.machinery.EXTENSION_SUFFIXES:
            path = os.path.join(folder, NAME + suffix)
            if os.path.exists(path):
                try:
                    return _loaded(path)
                except ImportError as error:
                    why = f"{path} does not load: {error}"
        others = glob.glob(os.path.join(folder, NAME + ".*.so"))
        if others and not any(others[0].endswith(suffix) for suffix in importlib.machinery.EXTENSION_SUFFIXES):
            why = f"{others[0]} is for another version of Python"
    raise program.MachineError(f"the compiled module of sunload.solve is not here ({why}); install pybind11-dev and "
                               "python3-dev and build again with this Python, or run a study: sunload.Study", 3)


def _loaded(path: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"{__package__}.{NAME}", path)
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded
