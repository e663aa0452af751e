#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Large scenes load and are prepared within bounds of memory: a city of a million triangles as OBJ
and as CityJSON, terrain of ten million as PLY. Times are printed, not judged.

large_scenes.py SUNLOAD [TRIANGLES_OF_CITY TRIANGLES_OF_TERRAIN]"""
import json
import os
import subprocess
import sys
import tempfile
import time

# To read and prepare; and of each triangle for the tree of the ray caster, with which `check` tries the machine.
MOST_BYTES, TREE_BYTES = 3e9, 100

STUDY = """\
format: sunload-study-1
name: large
site: {{latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}}
period: {{days: [2026-06-21], from: "12:00", to: "13:00", step_min: 60}}
scene: {{files: [{file}], repair: {repair}, ground: none}}
mesh: {{oracle: none}}
"""


def run(command, expected=0):
    """Output, seconds (on the clock, of processors) and the most memory of a program."""
    begin = time.monotonic()
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    output = child.stdout.read()
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    assert child.returncode == expected, f"{command}: {child.returncode}\n{output}"
    seconds = time.monotonic() - begin, usage.ru_utime + usage.ru_stime
    return output, seconds, usage.ru_maxrss * 1024


def check(sunload, folder, file, repair, at_least):
    study = os.path.join(folder, "large.yaml")
    with open(study, "w") as text:
        text.write(STUDY.format(file=file, repair=repair))
    output, seconds, memory = run([sunload, "check", study, "--json"])
    # After what it warns of, which may have braces as well.
    variant = json.loads(output[("\n" + output).index("\n{"):])["variants"][0]
    print(f"{file:16} repair {repair:5} {variant['patches']:9} patches {seconds[0]:6.1f} s "
          f"({seconds[1]:.1f} s of processors) {memory / 1e9:5.2f} GB", flush=True)
    assert variant["patches"] >= at_least, variant
    assert memory <= MOST_BYTES + TREE_BYTES * variant["patches"], f"{file}: {memory / 1e9:.2f} GB"


def search(sunload, folder, file):
    """Intersections of the study that was checked last."""
    _, seconds, memory = run([sunload, "check", os.path.join(folder, "large.yaml"), "--intersections"])
    print(f"{file:16} with the search for intersections     {seconds[0]:6.1f} s "
          f"({seconds[1]:.1f} s of processors) {memory / 1e9:5.2f} GB", flush=True)
    assert memory <= MOST_BYTES, f"{file}: {memory / 1e9:.2f} GB"


def write_terrain(path, triangles):
    """Binary PLY: a square grid of waves."""
    import numpy  # comes with h5py

    side = int((triangles / 2) ** 0.5) + 1
    x, y = numpy.meshgrid(numpy.arange(side), numpy.arange(side))
    points = numpy.empty(side * side, dtype=[("p", "<f4", 3)])
    points["p"] = numpy.stack([x, y, 5 * numpy.sin(x / 30) * numpy.cos(y / 40)], -1).reshape(-1, 3)
    corner = (numpy.arange(side - 1)[:, None] * side + numpy.arange(side - 1)).ravel()
    faces = numpy.empty(2 * corner.size, dtype=[("n", "u1"), ("v", "<i4", 3)])
    faces["n"] = 3
    faces["v"][0::2] = numpy.stack([corner, corner + 1, corner + side + 1], -1)
    faces["v"][1::2] = numpy.stack([corner, corner + side + 1, corner + side], -1)
    with open(path, "wb") as ply:
        ply.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {points.size}\n"
                  "property float x\nproperty float y\nproperty float z\n"
                  f"element face {faces.size}\nproperty list uchar int vertex_indices\n"
                  "end_header\n".encode())
        points.tofile(ply)
        faces.tofile(ply)
    return faces.size


def main():
    sunload = sys.argv[1]
    city, terrain = (int(float(n)) for n in sys.argv[2:4] or (1e6, 1e7))
    with tempfile.TemporaryDirectory(prefix="sunload_large_") as folder:
        for file in ("city.obj", "city.city.json"):
            path = os.path.join(folder, file)
            run([sunload, "scene", "city", "--set", f"triangles={city}", "-o", path])
            for repair in ("safe", "all"):
                # Floors and what the plots bury are no patches.
                check(sunload, folder, file, repair, city // 3)
            search(sunload, folder, file)
            os.remove(path)
        faces = write_terrain(os.path.join(folder, "terrain.ply"), terrain)
        check(sunload, folder, "terrain.ply", "safe", faces)


if __name__ == "__main__":
    main()
