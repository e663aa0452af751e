# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Good results, each broken in one place: the soak must see every fault, and none in the good ones."""

import copy
import json
import os
import shutil
import stat
import tempfile
import types

import h5py
import numpy as np

import estimates
import invariants
import other_ways
import scene_files
import shapes
from commands import is_csv
from program import DONE, Program
from result import read_result

# Boxes on a plate, a sensor, a spring day with its night.
STUDY = {
    "format": "sunload-study-1", "name": "good",
    "site": {"latitude_deg": 49.7475, "longitude_deg": 13.3776, "timezone": "Europe/Prague"},
    "period": {"days": ["2026-03-21"], "step_min": 120}, "light": {"source": "clear_sky"},
    "scene": {"files": ["good.obj"], "materials": {"light": {"diffuse": 0.6}, "dark": {"diffuse": 0.2}}},
    "mesh": {"max_edge_m": 4, "oracle": "none"},
    "solver": {"realizations": 16, "lines_per_patch": 1024, "direct_samples": 32, "unshot": 0},
    "sensors": {"points": [{"position_m": [9, 9, 1.5], "normal": [0, 0, 1]}]}, "output": {"standard_error": "instants"}}
LEDGERS = 1000
KINDS = {"gathered": {}, "shot": {"transport": "shoot"}, "bands": {"bands": "rgb"}}


def good_results(program, folder):
    """By kind: path of the result."""
    model = [("plate", [("dark", *face) for face in shapes.plate(40, 40)]),
             *[(f"box_{k}", [("light", *face) for face in shapes.placed(shapes.box(6, 5, 8), 20, 0, (9 * k - 4, 0, 0.0))]) for k in range(2)]]
    scene_files.write_obj(os.path.join(folder, "good.obj"), model)
    paths = {}
    for kind, solver in KINDS.items():
        tree = {**STUDY, "solver": {**STUDY["solver"], **solver}}
        with open(os.path.join(folder, f"{kind}.yaml"), "w", encoding="utf-8") as file:
            file.writelines(f"{key}: {json.dumps(value)}\n" for key, value in tree.items())
        ran = program.run("run", f"{kind}.yaml", "--output", kind, "--progress", "none")
        assert not list(ran.problems(DONE)), ran.err
        paths[kind] = os.path.join(folder, kind, "good", "baseline.h5")
    return paths


def scaled(name, factor, at=0):
    """A fault: the value at that place of the flat dataset, or all where `at` is None."""
    def fault(r):
        values = r.data[name] = np.array(r[name])
        if at is None:
            values *= factor
        else:
            values.flat[at] *= factor
    return fault


def put(name, value, at=0):
    def fault(r):
        values = r.data[name] = np.array(r[name])
        values.flat[at] = value
    return fault


def brightest(name):
    """Place of the largest value of the gathered result's dataset."""
    return lambda r: int(np.argmax(r[name]))


def of_brightest(name, factor):
    return lambda r: scaled(name, factor, brightest(name)(r))(r)


def light_in_the_dark(r):
    dni, dhi, _ = r.falls_in
    r["irradiance_sky"][np.flatnonzero((dni == 0) & (dhi == 0))[0], 3] = 1e-6


def sun_at_night(r):
    r["irradiance_direct"][np.flatnonzero(r["dni"] == 0)[0], 3] = 1e-6


def sun_too_bright(r):
    row = int(np.argmax(r["dni"]))
    r["irradiance_direct"][row, 0] = 1.001 * r["dni"][row]


def open_ledger(share):
    """Of what came in, in the sums over time."""
    def fault(r):
        came = sum(r.of_data[f"power_{term}"]["time_sum_kwh"] for term in invariants.IN)
        r.of_data["power_residual"] = {**r.of_data["power_residual"], "time_sum_kwh": share * came}
    return fault


def open_rows(share):
    return lambda r: r.data.update(power_residual=share * sum(r[f"power_{term}"] for term in invariants.IN))


def wrong_time_sum(r):
    r.of_data["power_sky"] = {**r.of_data["power_sky"], "time_sum_kwh": 1.001 * r.of_data["power_sky"]["time_sum_kwh"]}


def turned_round(r):
    r["patch_normal"][2] *= -1


# Invariant, kind of result, fault.
FAULTS = [
    ("finite_and_not_negative", "gathered", put("irradiance", np.nan, 40)),
    ("finite_and_not_negative", "gathered", put("light_load_se", -1e-9)),
    ("finite_and_not_negative", "gathered", put("power_absorbed", -1.0, 6)),
    ("finite_and_not_negative", "bands", put("sensor_light_load", np.inf)),
    ("parts_make_the_whole", "gathered", of_brightest("irradiance_sky", 1.0001)),
    ("parts_make_the_whole", "bands", of_brightest("light_load_reflected", 1.001)),
    ("parts_make_the_whole", "shot", of_brightest("sensor_irradiance_sky", 1.001)),
    ("loads_are_time_sums", "gathered", of_brightest("light_load_direct", 1.00001)),
    ("loads_are_time_sums", "shot", of_brightest("sensor_light_load", 1.00001)),
    ("maximum_is_of_the_series", "gathered", of_brightest("irradiance_max", 1.000001)),
    ("dark_is_dark", "gathered", light_in_the_dark),
    ("dark_is_dark", "shot", sun_at_night),
    ("no_brighter_than_the_sun", "gathered", sun_too_bright),
    ("shares_are_shares", "gathered", put("sky_view_factor", 1.001)),
    ("shares_are_shares", "shot", put("sun_hours", 24.01)),
    ("facades_are_means", "gathered", of_brightest("facade_light_load", 1.00001)),
    ("facades_are_means", "bands", of_brightest("facade_irradiance", 1.00001)),
    ("facades_are_means", "gathered", scaled("facade_area", 1.00001)),
    ("errors_are_of_realizations", "gathered", of_brightest("light_load_se", 1.0001)),
    ("errors_are_of_realizations", "shot", scaled("light_load_realization", 1.001, None)),
    ("ledger_adds_up", "gathered", open_rows(0.01)),
    ("ledger_adds_up", "shot", wrong_time_sum),
    ("ledger_closes", "gathered", open_ledger(0.02)),
    ("ledger_closes", "bands", open_ledger(0.06)),
    ("ledger_closes", "shot", open_rows(1e-5)),
    ("reflects_no_more_than_it_receives", "gathered", of_brightest("power_load", 3)),
    ("shape_is_sound", "gathered", scaled("patch_area", 1.00001)),
    ("shape_is_sound", "gathered", turned_round),
    ("shape_is_sound", "gathered", put("patch_material", 99)),
    ("times_are_in_order", "gathered", put("time", 4e9)),
    ("times_are_in_order", "gathered", put("sun_direction", 0.5, 20)),
]


def all_problems(results):
    return [*invariants.problems(results), *invariants.ledger_closes(results, LEDGERS)]


def missed_in_results(paths):
    """Faults of results that nobody sees, and problems of the good ones."""
    good = {kind: read_result(path) for kind, path in paths.items()}
    for kind, results in good.items():
        yield from (f"good, {kind}: {problem}" for problem in all_problems(results))
    for name, kind, fault in FAULTS:
        broken = copy.deepcopy(good[kind])
        fault(broken[0])
        if not any(problem.startswith(name) for problem in all_problems(broken)):
            yield f"{name} does not see fault {FAULTS.index((name, kind, fault))} in what is {kind}"
    tested = {name for name, _, _ in FAULTS}
    yield from (f"no fault for {f.__name__}" for f in (*invariants.EVERY, invariants.ledger_closes) if f.__name__ not in tested)


def missed_in_transports(paths):
    """One light brighter by some per cent than the other."""
    gathered, shot = (read_result(paths[kind])[0] for kind in ("gathered", "shot"))
    for name in ("light_load", "light_load_realization"):
        shot.data[name] = 1.1 * shot[name]
    if not list(other_ways.disagreements(gathered, shot, 1000)):
        yield "a tenth more light by one transport goes unseen"


def missed_in_files(paths, folder):
    """One bit of a dataset, a file that should not be there, one that is missing."""
    study = types.SimpleNamespace(folder=folder, name="good", variants=["baseline"])
    shutil.copytree(os.path.dirname(paths["gathered"]), os.path.join(folder, "results", "good"))
    shutil.copytree(os.path.join(folder, "results"), os.path.join(folder, "other"))
    yield from (f"good: {problem}" for problem in other_ways.same(study, "other"))
    with h5py.File(other_ways.result_path(study, "other", "baseline"), "r+") as file:
        file["irradiance"][4, 5] = np.nextafter(file["irradiance"][4, 5], np.float32(1e9))
    if not any("irradiance" in problem for problem in other_ways.same(study, "other")):
        yield "one bit of a series goes unseen"
    open(os.path.join(folder, "other", "good", "baseline.h5.part-1"), "w", encoding="utf-8").close()
    if not any("left over" in problem for problem in other_ways.left_over(study, "other")):
        yield "a file that is left over goes unseen"
    os.remove(other_ways.result_path(study, "other", "baseline"))
    if not any("baseline.h5'] missing" in problem for problem in other_ways.left_over(study, "other")):
        yield "a missing result goes unseen"


def missed_in_processes(folder):
    """Exit codes, words of a crash, estimates, tables."""
    path = os.path.join(folder, "program")
    for script, what in (("exit 70", "exit code 70"), ("echo 'bug in sunload: x' >&2", "a bug"), ("kill -SEGV $$", "a crash"),
                         ("echo 'dni is nan' >&2", "a nan")):
        scene_files.write(path, f"#!/bin/sh\n{script}\n")
        os.chmod(path, stat.S_IRWXU)
        if not list(Program(path, folder).run("run").problems(DONE)):
            yield f"{what} goes unseen"
    if not list(estimates.within("seconds", 10, 3, 1)) or list(estimates.within("seconds", 4, 2, 1)):
        yield "an estimate that is off by more than three goes unseen, or one that is not does not pass"
    if not list(is_csv("a,b\n1\n")) or not list(is_csv("a,b\n1,2\n", 2)):
        yield "a table that lacks something goes unseen"


def main(sunload):
    with tempfile.TemporaryDirectory(prefix="soak-") as folder:
        paths = good_results(Program(sunload, folder), folder)
        missed = [*missed_in_results(paths), *missed_in_transports(paths), *missed_in_files(paths, folder), *missed_in_processes(folder)]
    print("\n".join(missed) if missed else f"{len(FAULTS)} faults of results and those of files and processes: all of them seen")
    return 1 if missed else 0
