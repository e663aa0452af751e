#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study costs: fits the cost model of docs/scaling.md to measured runs.

scaling.py measure SUNLOAD -o RUNS.json    runs the studies, one thread each (some minutes)
scaling.py fit RUNS.json                   constants, errors of the runs held back, a prediction
scaling.py blind SUNLOAD                   `check` on sizes that nothing was fitted to, in units of one known run

Costs are processor time [s]: what other work on the machine costs is not counted.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

STUDY = """format: sunload-study-1
name: scaling
site: {{latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}}
period: {{start: 2026-06-01, end: 2026-06-{end:02d}, step_min: {step}}}
light: {{source: clear_sky}}
scene: {{builtin: {{name: street, house_3: {house}}}}}
mesh: {{max_edge_m: {edge}}}
solver: {{lines_per_patch: {lines}}}
"""

# max_edge_m, days, step_min, lines per patch, house 3; along each axis of the work.
FIT = [(4.0, 20, 60, 256, "brick"), (2.4, 8, 60, 256, "brick"), (1.4, 1, 60, 256, "brick"),
       (1.4, 6, 60, 256, "brick"), (1.4, 3, 60, 64, "brick"), (0.8, 1, 60, 128, "brick"),
       (0.5, 1, 240, 64, "brick"), (2.0, 4, 60, 256, "glazed"), (1.2, 1, 60, 256, "glazed")]
HELD_BACK = [(3.0, 12, 60, 128, "brick"), (1.7, 3, 60, 256, "brick"), (0.9, 1, 120, 256, "brick")]

# A blind check: one size that was fitted tells the speed of this machine, the others were chosen before they were run.
REFERENCE = (2.4, 2, 60, 256, "brick")
BLIND = [(1.9, 2, 60, 192, "brick"), (3.4, 9, 60, 256, "brick"), (1.0, 1, 120, 128, "glazed")]

FACING = 0.62  # of a sun's rays that need be cast: the street's share
BOUNCES, SAMPLES, BATCH = 5, 16, 64


def cpu_run(words, folder):
    """Processor time [s] and largest memory [bytes] of a program."""
    process = subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    said = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    if os.waitstatus_to_exitcode(status) != 0:
        sys.exit(said.decode())
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def measure_one(sunload, case, folder):
    import h5py
    edge, days, step, lines, house = case
    with open(os.path.join(folder, "scaling.yaml"), "w") as file:
        file.write(STUDY.format(edge=edge, end=1 + days, step=step, lines=lines, house=house))
    said = subprocess.run([sunload, "check", "scaling.yaml", "--json", "--threads", "1"], cwd=folder,
                          stdout=subprocess.PIPE, check=True).stdout
    row = json.loads(said)["variants"][0]
    seconds, memory = cpu_run([sunload, "run", "scaling.yaml", "--overwrite", "--threads", "1",
                               "--progress", "none", "--keep-batches"], folder)
    path = os.path.join(folder, "results/scaling/baseline.h5")
    with h5py.File(path) as file:
        stages = {name[len("runtime_"):-2]: float(value) for name, value in file.attrs.items()
                  if name.startswith("runtime_")}
        rays = {name: int(file.attrs[name]) for name in ("line_rays", "direct_rays", "mirror_rays")}
    disk = sum(os.path.getsize(os.path.join(at, name))
               for at, _, names in os.walk(os.path.join(folder, "results")) for name in names)
    subprocess.run(["rm", "-rf", os.path.join(folder, "results")], check=True)
    return {"case": case, "patches": row["patches"], "intervals": row["intervals"], "lit": row["lit"],
            "batches": row["batches"], "lines": row["lines"], "seconds": seconds, "memory_bytes": memory,
            "disk_bytes": disk, "estimated": {k: row[k] for k in ("seconds", "memory_bytes", "disk_bytes")},
            "stages": stages, **rays}


def work_of(run):
    """The amounts of work that a study's cost is linear in."""
    links = run["lines"] * BOUNCES
    # Neighbours in memory become farther apart: the log of the patches stands for it.
    depth = math.log2(run["patches"] / 1e4)
    return {"start": 1.0,
            "patch": run["patches"],
            "line": run["lines"], "line_depth": run["lines"] * depth,
            "lit_share": run["patches"] * run["lit"] * FACING, "direct_ray": run["direct_rays"],
            "mirror_ray": run["mirror_rays"],
            "link_sun": links * run["lit"], "link_depth": links * run["lit"] * depth,
            "link_batch": links * run["batches"],
            "patch_sun": run["patches"] * run["lit"],
            "value": run["patches"] * run["intervals"]}


# Which constants a stage is made of, and the stage's time in the result file.
STAGES = {"lines": ("line", "line_depth"), "direct": ("lit_share", "direct_ray"),
          "mirror": ("mirror_ray",), "solve": ("link_sun", "link_depth", "patch_sun"), "realizations": ("link_batch",),
          "rest": ("start", "patch", "value")}


def stage_seconds(run, stage):
    """Processor time of a stage: its share of the clock's time, which others may have stretched."""
    known = sum(run["stages"].values())
    rest = max(run["seconds"] - known, 0.02 * run["seconds"])
    if stage == "rest":
        return rest
    return run["stages"].get(stage, 0) * (run["seconds"] - rest) / known


def fitted(runs):
    """Constants that make the relative errors least, none of them negative."""
    import numpy
    constants = {}
    for stage, names in STAGES.items():
        names, rows, weights = list(names), [], []
        used = [run for run in runs if stage_seconds(run, stage) > 0]
        while used and names:
            rows = numpy.array([[work_of(run)[name] / stage_seconds(run, stage) for name in names] for run in used])
            values = numpy.linalg.lstsq(rows, numpy.ones(len(used)), rcond=None)[0]
            if min(values) >= 0:
                break
            del names[int(numpy.argmin(values * rows.mean(axis=0)))]
        constants.update(zip(names, values) if used else {})
    return constants


def predicted(constants, work):
    return sum(constants.get(name, 0) * amount for name, amount in work.items())


def table(runs, constants, title):
    print(f"\n| {title}: patches | lit intervals | lines per patch | measured s | model s | error % | check s |")
    print("|---|---|---|---|---|---|---|")
    worst = 0
    for run in runs:
        model = predicted(constants, work_of(run))
        error = 100 * (model / run["seconds"] - 1)
        worst = max(worst, abs(error))
        print(f"| {run['patches']} | {run['lit']} | {run['lines'] / run['patches']:.0f} | {run['seconds']:.1f} "
              f"| {model:.1f} | {error:+.0f} | {run['estimated']['seconds']:.1f} |")
    return worst


def district(constants, nodes=100, cores=64):
    """10 million patches, hourly for a year, no mirrors: one rank per node."""
    patches, intervals, lit = 10_000_000, 8760, 4440
    run = {"patches": patches, "intervals": intervals, "lit": lit, "batches": math.ceil(intervals / BATCH),
           "lines": patches * 256, "direct_rays": int(patches * lit * SAMPLES * FACING), "mirror_rays": 0}
    work = work_of(run)
    once = predicted(constants, {name: work[name] for name in ("start", "patch", "line", "line_depth")})
    total = predicted(constants, work)
    batch = (total - once) / run["batches"]
    rounds = math.ceil(run["batches"] / nodes)
    return {"core_hours": total / 3600, "lines_core_hours": once / 3600,
            "lines_s_on_a_node": once / cores, "batch_s_on_a_node": batch / cores,
            "all_batches_s": once / cores + rounds * batch / cores}


def fit(runs):
    constants = fitted(runs["fit"])
    print("| constant | processor time |\n|---|---|")
    for name, value in constants.items():
        print(f"| {name} | {value:.3g} s |")
    table(runs["fit"], constants, "fitted")
    worst = table(runs["held_back"], constants, "held back")
    print(f"\nLargest error of the runs held back: {worst:.0f} %")
    every = runs["fit"] + runs["held_back"]
    for what in ("seconds", "memory_bytes", "disk_bytes"):
        ratios = [run["estimated"][what] / run[what] for run in every]
        print(f"check: estimated / measured {what}: {min(ratios):.2f} ... {max(ratios):.2f}")
    print("district:", {name: round(value, 1) for name, value in district(constants).items()})


def blind(sunload):
    """Errors of `check` where the machine's speed is known from one run."""
    with tempfile.TemporaryDirectory() as folder:
        reference = measure_one(sunload, REFERENCE, folder)
        speed = reference["seconds"] / reference["estimated"]["seconds"]
        print(f"this machine: {speed:.2f} times the time that check says\n")
        print("| patches | lit intervals | lines per patch | measured s | check s, this machine | error % |")
        print("|---|---|---|---|---|---|")
        worst = 0
        for case in BLIND:
            run = measure_one(sunload, case, folder)
            said = run["estimated"]["seconds"] * speed
            error = 100 * (said / run["seconds"] - 1)
            worst = max(worst, abs(error))
            print(f"| {run['patches']} | {run['lit']} | {run['lines'] / run['patches']:.0f} | {run['seconds']:.1f} "
                  f"| {said:.1f} | {error:+.0f} |", flush=True)
        print(f"\nLargest error: {worst:.0f} %")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    measuring = commands.add_parser("measure")
    measuring.add_argument("sunload")
    measuring.add_argument("-o", "--output", required=True)
    fitting = commands.add_parser("fit")
    fitting.add_argument("runs")
    checking = commands.add_parser("blind")
    checking.add_argument("sunload")
    options = parser.parse_args()
    if options.command == "blind":
        blind(os.path.abspath(options.sunload))
    elif options.command == "measure":
        runs = {}
        with tempfile.TemporaryDirectory() as folder:
            for name, cases in (("fit", FIT), ("held_back", HELD_BACK)):
                runs[name] = []
                for case in cases:
                    runs[name].append(measure_one(os.path.abspath(options.sunload), case, folder))
                    print(case, round(runs[name][-1]["seconds"], 1), "s", file=sys.stderr, flush=True)
        with open(options.output, "w") as file:
            json.dump(runs, file, indent=1)
    else:
        with open(options.runs) as file:
            fit(json.load(file))


if __name__ == "__main__":
    main()
