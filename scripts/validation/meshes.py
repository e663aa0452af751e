# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesh's own error: facades on coarser meshes against those on a fine one, with the same seed."""

import os

import numpy as np

from rows import Row, Section

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
CITY = os.path.join(ROOT, "..", "shared", "data", "city", "lod2_100_buildings_v11_epsg3068.city.json")
SCENES = {
    "street": "site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}\n"
              "scene: {builtin: {name: street}}\n",
    "100 houses": "site: {timezone: Europe/Berlin}\n"
                  f"scene: {{files: [{CITY}], ground: {{margin_m: 10}}, materials: {{stone: {{diffuse: 0.35}}}}, "
                  "assign: [{material: stone}]}\n",
}
STUDY = """period: {days: [2026-03-08], from: "07:00", to: "17:00", step_min: 60}
light: {source: clear_sky, linke_turbidity: 3}
solver: {lines_per_patch: 256, direct_samples: 64, realizations: 8}
variants:
  - {name: fine, mesh: {oracle: none, max_edge_m: 1}}
  - {name: edges_of_8_m, mesh: {oracle: none, max_edge_m: 8}, solver: {lines_per_patch: 2048}}
  - {name: edges_of_4_m, mesh: {oracle: none, max_edge_m: 4}, solver: {lines_per_patch: 2048}}
  - {name: edges_of_2_m, mesh: {oracle: none, max_edge_m: 2}, solver: {lines_per_patch: 1024}}
  - {name: default_mesh}
"""
SHARES = {"edges_of_8_m": 0.10, "edges_of_4_m": 0.10, "edges_of_2_m": 0.05, "default_mesh": 0.05}  # of reflected light
COVERED = 0.9  # of the facades within twice the error that is told


def facades(result):
    """By name: load, its part that is reflected, its standard error [kWh m-2]."""
    of, area = result["patch_facade"][:], result["patch_area"][:]
    on = of >= 0
    count = len(result["facade_name"])
    reflected = np.bincount(of[on], (area * result["light_load_reflected"][:])[on], count)
    reflected /= np.bincount(of[on], area[on], count)
    loads = zip(result["facade_light_load"][:], reflected, result["facade_light_load_se"][:])
    return dict(zip(result["facade_name"][:], loads))


def sections(program, tell):
    name = "the mesh's own error: facades on coarse meshes"
    rows = []
    for scene, text in SCENES.items():
        if scene == "100 houses" and not os.path.exists(CITY):
            continue
        tell(f"{name}: {scene}")
        results = program.results("mesh_" + scene.split()[-1], text + STUDY)
        fine = facades(results["fine"])
        for mesh, share in SHARES.items():
            pairs = np.array([(*fine[facade], *values) for facade, values in facades(results[mesh]).items()
                              if facade in fine])
            off, reflected = pairs[:, 3] - pairs[:, 0], pairs[:, 4]
            noise = np.hypot(pairs[:, 2], pairs[:, 5])
            covered = np.mean(np.abs(off) <= 2 * np.hypot(share * reflected, noise))
            mesh_words = mesh.replace("_", " ")
            patches = results[mesh]["patch_area"].shape[0]
            rows.append(Row(name, f"{scene}, {mesh_words}, {patches} patches: facades within twice {100 * share:.0f} % of their "
                            "reflected light, share", 1.0, covered, None, 1 - COVERED))
            direct = off - (reflected - pairs[:, 1])
            for what, values in (("load", off), ("reflected light", reflected - pairs[:, 1]), ("direct and sky light", direct)):
                rows.append(Row(name, f"{scene}, {mesh_words}: {what} of facades off by, rms, % of the mean load", 0.0,
                                100 * np.sqrt(np.mean(values**2)) / pairs[:, 0].mean(),
                                100 * np.sqrt(np.mean(noise**2)) / pairs[:, 0].mean(), None))
    yield Section(name, "edges of 1 m", rows,
                  said="Direct light and the sky's are sampled over each patch: on every mesh they are off by noise alone. "
                  "Reflected light is constant on each patch, and is what a mesh puts off.")
