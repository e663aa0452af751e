# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies of a fraction of a second for scripts that run the program many times."""

import os

SQUARE = """o square
usemtl paving
v -15 -15 0
v 15 -15 0
v 15 15 0
v -15 15 0
f 1 2 3 4
o house
usemtl plaster
v -4 3 0.01
v 4 3 0.01
v 4 9 0.01
v -4 9 0.01
v -4 3 7
v 4 3 7
v 4 9 7
v -4 9 7
f 6 7 11 10
f 7 8 12 11
f 8 5 9 12
f 9 10 11 12
f 8 7 6 5
usemtl glass
f 5 6 10 9
"""

STUDY = """format: sunload-study-1
name: square
site: {{latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}}
period: {{days: [2026-03-21], from: "06:00", to: "18:00", step_min: 60}}
light: {{source: clear_sky}}
scene:
  files: [square.obj]
  materials: {{paving: {{diffuse: 0.3}}, plaster: {{diffuse: 0.6}}, glass: {{diffuse: 0.05, mirror: 0.85}}}}
mesh: {{max_edge_m: {max_edge_m}}}
solver: {{lines_per_patch: 64, batch_suns: {batch_suns}}}
"""

RESULT = "results/square/baseline.h5"


def write_study(folder, max_edge_m, batch_suns):
    with open(os.path.join(folder, "square.obj"), "w") as file:
        file.write(SQUARE)
    with open(os.path.join(folder, "square.yaml"), "w") as file:
        file.write(STUDY.format(max_edge_m=max_edge_m, batch_suns=batch_suns))
