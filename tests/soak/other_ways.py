# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The same study in other ways: threads, shards, kills, batches of other sizes give the same data, the
other transport the same light within the errors."""

import copy
import math
import os
import signal

import numpy as np
from same_data import different_data

import student
from invariants import FALSE_ALARMS, SERIES
from program import DONE, UNFINISHED
from result import read_result

MOST_KILLS = 4
LEAST_HITS = 10  # of an object, by samples of one realization, on the mean


def result_path(study, folder, variant):
    return os.path.join(study.folder, folder, study.name, f"{variant}.h5")


def left_over(study, folder):
    """Yields what lies beside finished results."""
    top = os.path.join(study.folder, folder)
    found = {os.path.relpath(os.path.join(at, name), top) for at, folders, files in os.walk(top) for name in folders + files}
    wanted = {study.name} | {os.path.join(study.name, f"{v}.h5") for v in study.variants}
    if found != wanted:
        yield f"in {folder}: {sorted(found - wanted)} left over, {sorted(wanted - found)} missing"


def same(study, folder):
    """Yields where the results in `folder` differ from those of the plain run."""
    yield from left_over(study, folder)
    for variant in study.variants:
        if os.path.exists(other := result_path(study, folder, variant)):
            if different := different_data(result_path(study, "results", variant), other):
                yield f"{folder}: {variant}: other data: {', '.join(different)}"


def with_threads(program, study, random):
    ran = program.run("run", "study.yaml", "--output", "threads", "--threads", str(random.choice([2, 3, 5])), "--progress", "none")
    yield from ran.problems(DONE)
    yield from same(study, "threads")


def in_shards(program, study, random):
    """One after the other, or all at the same time."""
    count = random.choice([2, 3, 5])
    order = random.sample(range(count), count)
    at_once = random.random() < 0.3
    # As the scripts for schedulers do: a shard may begin when the others have finished all there is.
    words = [("run", "study.yaml", "--output", "shards", "--shard", f"{i}/{count}", "--resume", "--progress", "none") for i in order]
    if at_once:
        processes = [program.start(*w) for w in words]
        shards = [program.finish(p) for p in processes]
    else:
        shards = [program.run(*words[0])]
        # What others owe is listed, to which all may belong; or the first shard was all there is.
        yield from program.run("merge", "study.yaml", "--output", "shards").problems(DONE, UNFINISHED)
        yield from program.run("merge", "study.yaml", "--output", "shards", "--partial").problems(DONE, UNFINISHED)
        shards += [program.run(*w) for w in words[1:]]
    for ran in shards:
        yield from ran.problems(DONE)
    if random.random() < 0.3:
        yield from program.run("merge", "study.yaml", "--output", "shards").problems(DONE)
    yield from same(study, "shards")


def killed(program, study, random, whole_s):
    """kill -9 or SIGTERM at random moments, then --resume."""
    kills = random.randint(1, MOST_KILLS)
    for k in range(kills + 1):
        process = program.start("run", "study.yaml", "--output", "killed", "--resume", "--progress", "none")
        how = random.choice([signal.SIGKILL, signal.SIGTERM])
        ran = program.finish(process, random.uniform(0, whole_s) if k < kills else None, how)
        # While its libraries are loaded a program does not listen: SIGTERM ends it as any other.
        yield from ran.problems(*((DONE, UNFINISHED, -signal.SIGKILL, -signal.SIGTERM) if k < kills else (DONE,)))
    yield from same(study, "killed")


def by_and_by(program, study, random):
    """One variant after the other, and with a limit of time that comes at once."""
    for variant in random.sample(study.variants, len(study.variants)):
        words = ("run", "study.yaml", "--output", "parts", "--variant", variant, "--progress", "none")
        yield from program.run(*words, "--time-limit", "1e-6").problems(DONE, UNFINISHED)
        yield from program.run(*words, "--resume").problems(DONE)
    yield from same(study, "parts")


def in_other_batches(program, study, random):
    """Gathered series are the same bits, totals but for the order in which they are added."""
    if study.tree["solver"]["transport"] == "shoot" or "accuracy" in study.tree["solver"]:
        return  # a block of suns shares its samples; an accuracy may look at blocks
    tree = copy.deepcopy(study.tree)
    tree["solver"]["batch_suns"] = random.choice([b for b in (1, 4, 5, 16, 32, 100) if b != tree["solver"]["batch_suns"]])
    study.write("batches.yaml", tree)
    ran = program.run("run", "batches.yaml", "--output", "batches", "--progress", "none")
    yield from ran.problems(DONE)
    if ran.code != DONE:
        return
    for variant in study.variants:
        for one, other in zip(read_result(result_path(study, "results", variant)), read_result(result_path(study, "batches", variant))):
            for name in one.data:
                a, b = one[name], other.get(name)
                if not isinstance(a, np.ndarray) or a.dtype.kind != "f" or name.endswith("_se") or name == "power_residual":
                    continue
                if name.startswith(("irradiance", "sensor_irradiance")):
                    if not np.array_equal(a, b):
                        yield f"batch_suns {tree['solver']['batch_suns']}: {variant}: {name} has other bits"
                elif b is None or not np.allclose(a, b, rtol=SERIES, atol=SERIES * np.abs(a).max(initial=0)):
                    yield f"batch_suns {tree['solver']['batch_suns']}: {variant}: {name} differs by more than rounding"


def object_means(result):
    """Load of every object and of the whole, one row per realization, and of the pooled lines [kWh m-2]; its
    share of all area."""
    area, objects = result["patch_area"], result["patch_object"]
    count = int(objects.max()) + 1
    groups = np.zeros((count + 1, len(area)))
    groups[objects, np.arange(len(area))] = area
    groups[-1] = area
    groups = groups[groups.sum(axis=1) > 0]
    areas = groups.sum(axis=1, keepdims=True)
    groups /= areas
    return groups @ result["light_load_realization"].T, groups @ result["light_load"], areas[:, 0] / area.sum()


def by_other_transport(program, study, random, comparisons):
    """Gathered and shot light agree, on every object and on the whole, as one of so many comparisons.

    Nothing is left to what the two know differently: no early stop, no estimate of what is not followed,
    no links to more than a patch and no second reflection, from which on gathering reuses its lines.
    """
    tree = copy.deepcopy(study.tree)
    for key in ("variants", "sensors"):
        tree.pop(key, None)
    solver = tree["solver"]
    for key in ("accuracy", "max_lines_per_patch", "jacobi", "bands", "short_intervals"):
        solver.pop(key, None)
    tree["light"].pop("colour", None)
    tree["output"] = {"series": ["total"]}
    tree["mesh"]["link_threshold"] = 0
    solver.update(unshot=0, unfollowed="leave", bounces=1, realizations=16, lines_per_patch=16 * 32, direct_samples=32)
    results = []
    for transport in ("gather", "shoot"):
        solver["transport"] = transport
        study.write(f"{transport}.yaml", tree)
        ran = program.run("run", f"{transport}.yaml", "--output", transport, "--progress", "none")
        yield from ran.problems(DONE)
        if ran.code != DONE:
            return
        results.append(read_result(result_path(study, transport, "baseline"))[0])
    yield from disagreements(*results, comparisons)


def disagreements(gathered, shot, comparisons):
    """Objects whose loads differ by more than chance, as one of so many comparisons."""
    (rows_a, a, _), (rows_b, b, shares) = object_means(gathered), object_means(shot)
    variance_a, variance_b = (rows.var(axis=1, ddof=1) / rows.shape[1] for rows in (rows_a, rows_b))
    # An object that next to no sample of a realization hits has the same light in most of them, and now and
    # then much more: their spread is no error. (A house of 0.8 m2 on land of 10 000 m2.)
    hits = shares * shot.attributes["samples_shot"] / shot.realizations
    for k in range(len(a)):
        if hits[k] < LEAST_HITS:
            continue
        error = math.sqrt(variance_a[k] + variance_b[k])
        # Welch (1947), never more degrees of freedom than the fewer realizations have.
        freedom = min(rows_a.shape[1], rows_b.shape[1]) - 1
        most = student.bound(FALSE_ALARMS / comparisons, freedom) * error + SERIES * max(a[k], b[k])
        if not abs(a[k] - b[k]) <= most:
            where = "the whole" if k == len(a) - 1 else f"object {k}"
            yield (f"{where} has {a[k]:.6g} kWh/m2 gathered, {b[k]:.6g} shot: {abs(a[k] - b[k]) / max(error, 1e-300):.1f} "
                   f"standard errors ({error:.2g})")
