# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The line of far hills of a study (site.horizon), whose file results name and do not hold."""

import os
import re

import numpy as np

from reading import InputError

# Header of the two columns: azimuth and elevation [degrees], and what azimuths begin at (PVGIS: south).
HEADERS = (("azimuth_deg", "elevation_deg", 0.0), ("A", "H_hor", 180.0))
LEAST_POINTS = 2


class Hills:
    """Elevation of the line by azimuth, straight between the points of the file."""

    def __init__(self, azimuth_deg, elevation_deg):
        self.azimuth_deg, self.elevation_deg = np.asarray(azimuth_deg) % 360, np.asarray(elevation_deg)

    def at(self, azimuth_deg):
        return np.interp(azimuth_deg, self.azimuth_deg, self.elevation_deg, period=360)

    def hide(self, azimuth_deg, elevation_deg):
        """Which suns above the horizon stand behind them."""
        elevation_deg = np.asarray(elevation_deg)
        return (elevation_deg > 0) & (elevation_deg <= self.at(azimuth_deg))


def read_hills(path):
    """A file as `sunload horizon` writes it, or a table of PVGIS."""
    try:
        with open(path, encoding="utf-8-sig") as file:
            lines = [re.split(r"[\s,;]+", line.strip()) for line in file]
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: is no text ({error})") from error
    for k, fields in enumerate(lines):
        for azimuth, elevation, turn in HEADERS:
            if azimuth in fields and elevation in fields:
                return points_below(path, lines[k + 1:], fields.index(azimuth), fields.index(elevation), turn)
    raise InputError(f"{path}: is no horizon file: it has no columns azimuth_deg and elevation_deg, or A and H_hor")


def points_below(path, lines, azimuth, elevation, turn_deg):
    """Rows up to the first empty line."""
    points = []
    for fields in lines:
        if fields == [""] and points:
            break
        if fields != [""]:
            try:
                points.append((float(fields[azimuth]) + turn_deg, float(fields[elevation])))
            except (ValueError, IndexError) as error:
                raise InputError(f"{path}: '{' '.join(fields)}' is no azimuth and elevation in degrees") from error
    if len(points) < LEAST_POINTS:
        raise InputError(f"{path}: has too few points for a horizon; at least two are needed")
    return Hills(*zip(*points))


def name_in(study):
    """What a study writes as site.horizon; None where it does not, or where variants have several."""
    words = re.sub(r"(?m)(^|\s)#.*$", "", study)
    names = {name.strip("\"'") for name in re.findall(r"""\bhorizon["']?\s*:\s*("[^"]*"|'[^']*'|[^\s,}]+)""", words)}
    return names.pop() if len(names) == 1 else None


def found_beside(result, name):
    """The study's folder is the one with results/<study>, where the study says nothing else."""
    folder = os.path.dirname(os.path.abspath(result.path))
    paths = (os.path.normpath(os.path.join(folder, up, os.path.expanduser(name))) for up in ("../..", ".", ".."))
    return next((path for path in paths if os.path.isfile(path)), None)


def hills_of(result, named=None):
    """Those of a file that the user names, or of the study; what a picture says where they are not found."""
    if named:
        return read_hills(named), ""
    study = result.file["study_yaml"][()] if result.has("study_yaml") else ""
    study = study.decode() if isinstance(study, bytes) else study
    name = name_in(study)
    if not name:
        return None, ""
    path = found_beside(result, name)
    return (read_hills(path), "") if path else (None, f"far hills are not drawn: {name} is not found (--horizon)")
