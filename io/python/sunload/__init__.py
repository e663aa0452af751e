# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sun and sky light on every patch of a city, from Python.

    import sunload
    results = sunload.Study("street.yaml").check().run()
    results["glazed"].sunload.facades()

Without files, of arrays in memory: `sunload.solve(vertices, triangles, materials, suns, skies)`.

Studies run in the program `sunload` (of PATH, of the environment variable SUNLOAD, or beside this package); results are
`xarray.Dataset`s with names as coordinates and an accessor `.sunload`.
"""

from .arrays import solve
from .program import InputError, MachineError, ProgramError, Unfinished
from .results import Accessor, open
from .studies import Report, Study

__version__ = "0.1.0"  # of the program that it comes with

__all__ = ["Accessor", "InputError", "MachineError", "ProgramError", "Report", "Study", "Unfinished", "open", "solve"]
