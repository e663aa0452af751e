#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A real Slurm array of 4 tasks, one killed and one out of time, against a run in one process.

slurm_test.py SUNLOAD SOURCE_FOLDER
"""

import glob
import os
import subprocess
import sys
import tempfile

from same_data import different_data
from skip import skip
from small_slurm import SmallSlurm, missing

STUDY = """format: sunload-study-1
name: street
site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}
period: {days: [2026-03-21, 2026-06-21], from: "06:00", to: "18:00", step_min: 15}
light: {source: clear_sky}
scene: {builtin: {name: street, house_3: brick}}
mesh: {max_edge_m: 2, oracle: none}
solver: {batch_suns: 4, lines_per_patch: 64}
variants:
  - {name: baseline}
  - {name: glazed, scene: {builtin: {house_3: glazed}}}
"""
TASKS = 4
VARIANTS = ("baseline", "glazed")


def run(words, **options):
    ran = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
    assert ran.returncode == 0, f"{words}: {ran.returncode}\n{ran.stdout}{ran.stderr}"
    return ran.stdout


def batches(work):
    return glob.glob(os.path.join(work, "results/street/.work/*/*.batch"))


def read_logs(work):
    return "".join(f"--- {path}\n" + open(path, errors="replace").read()
                   for path in sorted(glob.glob(os.path.join(work, "*.log"))))


def kill_and_requeue(slurm, task, work):
    """Kills a task in the middle of its share and sends it back to the queue."""
    slurm.wait_for(lambda: slurm.state(task) == "RUNNING" and len(batches(work)) >= TASKS,
                   "work of task " + task, 120)
    assert slurm.state(task) == "RUNNING", "the study is too small to kill a task of it"
    run(["scancel", "--signal=KILL", task], env=slurm.environment)
    slurm.wait_for(lambda: slurm.state(task) == "CANCELLED", "the end of task " + task)
    print(f"killed task {task} with {len(batches(work))} batches finished by all")
    # While it is completing Slurm refuses to requeue it.
    slurm.wait_for(lambda: subprocess.run(["scontrol", "requeue", task], env=slurm.environment,
                                          stderr=subprocess.DEVNULL).returncode == 0, "requeueing")


def warn_of_time_limit(slurm, task):
    """What Slurm does 60 s before the limit of array.sbatch; the task requeues itself."""
    assert slurm.state(task) == "RUNNING", "the study is too small to warn a task of it"
    run(["scancel", "--batch", "--signal=USR1", task], env=slurm.environment)
    slurm.wait_for(lambda: restarts(slurm, task) == 1, "the restart of task " + task)
    print(f"warned task {task} of its time limit: it requeued itself")


def restarts(slurm, task):
    return int(slurm.ask("scontrol", "show", "job", task).split("Restarts=")[1].split()[0])


def test(sunload, source, folder):
    work = os.path.join(folder, "work")
    os.makedirs(work)
    with open(os.path.join(work, "street.yaml"), "w") as file:
        file.write(STUDY)
    with SmallSlurm(os.path.join(folder, "slurm"), processors=TASKS) as slurm:
        slurm.environment["SUNLOAD"] = sunload
        said = run([os.path.join(source, "scripts/slurm/submit"), "street.yaml", "--tasks", str(TASKS),
                    "--cpus", "1"], cwd=work, env=slurm.environment)
        print(said, end="")
        array, merge = said.splitlines()[-1].replace("array ", "").replace("merge ", "").split(", ")
        kill_and_requeue(slurm, array + "_1", work)
        warn_of_time_limit(slurm, array + "_2")
        ended = ("COMPLETED", "FAILED", "CANCELLED", "TIMEOUT")
        try:
            slurm.wait_for(lambda: slurm.state(merge) in ended, "the merge", 400)
            states = [slurm.state(f"{array}_{task}") for task in range(TASKS)] + [slurm.state(merge)]
            started_again = [restarts(slurm, f"{array}_{task}") for task in range(TASKS)]
        except Exception:
            print(read_logs(work), slurm.ask("squeue"))
            raise
    assert states == ["COMPLETED"] * (TASKS + 1), f"{states}\n{read_logs(work)}"
    assert started_again == [0, 1, 1, 0], started_again
    table = read_logs(work)
    assert "house_3" in table, "merge.sbatch did not compare the variants\n" + table
    run([sunload, "run", "street.yaml", "--output", "alone"], cwd=work)
    for variant in VARIANTS:
        one, other = (os.path.join(work, f"{place}/street/{variant}.h5") for place in ("alone", "results"))
        assert different_data(one, other) == [], different_data(one, other)
    assert different_data(one, one.replace(VARIANTS[1], VARIANTS[0])), "the comparison sees nothing"
    assert not os.path.exists(os.path.join(work, "results/street/.work")) or not batches(work)
    print(f"{TASKS} tasks, one killed, one out of time: the same bits as one process")


def main():
    why = missing()
    if not why:
        try:
            import h5py  # noqa: F401
        except ImportError:
            why = "python3-h5py is not installed"
    if why:
        skip(why)
    # Sockets have short names: no deep folder of the build.
    with tempfile.TemporaryDirectory(prefix="sunload-slurm-") as folder:
        os.makedirs(os.path.join(folder, "slurm"))
        test(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), folder)


if __name__ == "__main__":
    main()
