# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reference values: the tests that hold them print each comparison, and are read here."""

import re
import subprocess

from rows import Row, Section

# Name, executable, googletest filter, source of the numbers.
SECTIONS = [
    ("place of the sun, sunrise, clocks", "geo_sun_tests", "Sun.*:SunEvents.*:SunPath.*:Distance.*",
     "ERFA 2.0.0; NREL/TP-560-34302; Meeus 1998; USNO"),
    ("air mass, clear skies, decompositions", "geo_sky_tests",
     "AirMass.*:Pressure.*:Extraterrestrial.*:ClearSky.*:Decomposition.*", "pvlib-python's tests; NREL's Bird"),
    ("skies", "geo_sky_tests", "CieGeneral.*:Perez.*:Preetham.*:TraditionalSkies.*:Sky.*",
     "ISO 15469; Perez et al. 1993; Preetham et al. 1999"),
    ("form factors by lines", "statistical_tests", "FormFactors.*", "Howell's catalogue"),
    ("form factors of what is curved", "physics_tests", "Disks.*:Spheres.*:Cylinders.*:Rooms.*",
     "Howell's catalogue"),
    ("boxes of six unknowns and converged", "physics_tests", "BoxOfSixUnknowns.*:ConvergedBox.*:*WhiteFurnace*",
     "own quadrature and closed form"),
    ("bodies within bodies", "physics_tests", "Concentric.*:IntegratingCube.*", "closed form"),
    ("shadows, sun hours, energy of a day", "physics_tests", "Shadows.*:ClearDay.*:FixedDeclination.*",
     "clipping; ERFA; Duffie & Beckman"),
    ("glass", "physics_tests", "Glass.*", "after CIE 171; Fresnel; Rivero"),
    ("mirrors", "physics_tests", "MirrorRoom.*:FacingMirrors.*:SunInAMirror.*:LampInMirrors.*:CornerCube.*:Periscope.*",
     "images; closed form"),
    ("scale, slivers, hidden emitters", "physics_tests", "Emission.*:Scale.*:Slivers.*:LargeExtent.*",
     "after Smits & Jensen 2000"),
    ("points: form factors, sky, ground, lamps, mirrors", "physics_tests", "Sensor*",
     "Howell's catalogue; own quadrature, after CIE 171"),
    ("shooting", "physics_tests", "Shooting.*", "closed form; gathering"),
    ("the year by modes against each hour", "physics_tests", "YearOfTheSquare.*", "the same solved for each hour"),
    ("error bars: 600 runs of each kind", "statistical_tests", "Coverage.*", "binomial law"),
]

LINE = re.compile(
    r"^(?P<case>.*?):? ?(?:n \d+, mean|value) (?P<ours>\S+), truth (?P<truth>\S+), off by \S+"
    r"(?:, SE (?P<se>\S+))?, limit (?P<limit>[-+0-9.e]+)")
COVERAGE = re.compile(r"^(?P<case>.+): (?P<held>\d+) of (?P<all>\d+) intervals hold the truth, accepted (?P<low>\d+)"
                      r" to (?P<high>\d+)")


def row_of(section, test, line):
    """The comparison that a line tells, or None."""
    if found := COVERAGE.match(line):
        low, high = int(found["low"]), int(found["high"])
        middle = (low + high) / 2
        return Row(section, f"{found['case']}: intervals of 95 % that hold the truth, of {found['all']}", middle,
                   int(found["held"]), None, (high - low) / 2)
    if not (found := LINE.match(line)):
        return None
    case = found["case"].strip().strip('"') or test
    if not found["se"]:
        case = f"{test.split('.')[-1]}: {case}"
    error = float(found["se"]) if found["se"] else None
    return Row(section, case, float(found["truth"]), float(found["ours"]), error, float(found["limit"]))


def run_section(folder, name, executable, tests, source):
    done = subprocess.run([f"{folder}/tests/{executable}", f"--gtest_filter={tests}"], capture_output=True, text=True)
    rows, test, checks = [], "", 0
    for line in done.stdout.splitlines():
        if line.startswith("[ RUN      ]"):
            test = line[13:].strip()
            checks += 1
        elif row := row_of(name, test, line):
            rows.append(row)
    if checks == 0:
        raise SystemExit(f"validate: no test of {executable} is named {tests}")
    return Section(name, source, rows, done.returncode == 0, checks=checks)


def all_sections(folder, tell):
    for section in SECTIONS:
        tell(section[0])
        yield run_section(folder, *section)


def executables():
    return sorted({section[1] for section in SECTIONS})
