# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error bars against the spread of seeds: the same small study with another seed many times. Of everything that is
printed with an error, the spread over the seeds is divided by the error that the runs state."""

import math
import statistics

import numpy as np

from rows import Row, Section

# Solving a matrix anew takes three times as long.
SEEDS = {"gather": 100, "shoot": 40, "matrix": 16}
REALIZATIONS = 16
CLAIM = 0.1  # spread / stated error is 1 within this, besides what chance does to it
FAMILY_WISE = 0.01
ROUNDING = 3e-7  # of a float: an error below it is none
# Light below this share of the largest says nothing of the accuracy, as `info` has it.
LEAST_SHARE = 0.01

# A court: two houses on a plate, askew, so that shadows cut the strata of the samples at all angles; the front of one
# is a mirror, or black, in the other variant.
COURT = """v -12 -12 0\nv 12 -12 0\nv 12 12 0\nv -12 12 0\no ground\nusemtl ground\nf 1 2 3 4\n"""

STUDY = """site: {{latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague, north_deg: 17}}
period: {{days: [2026-03-08, 2026-06-21], from: "07:00", to: "13:00", step_min: 120}}
light: {{source: clear_sky}}
scene:
  files: [court.obj]
  ground: none
  materials: {{ground: {{diffuse: 0.3}}, wall: {{diffuse: 0.5}}, front: {{diffuse: 0.5}}}}
mesh: {{max_edge_m: 3, oracle: none}}
solver: {{lines_per_patch: 512, realizations: {realizations}, direct_samples: 64, seed: {seed},
  transport: {transport}}}
sensors: {{points: [{sensors}]}}
output: {{standard_error: {errors}, series: [total], totals: [day, hour_of_day], compression: 1}}
variants:
  - {{name: base}}
  - {{name: other, scene: {{materials: {{front: {{diffuse: 0.1{mirror}}}}}}}}}
"""

# Matrices have no mirrors.
MIRROR = {"gather": ", mirror: 0.6", "shoot": ", mirror: 0.6", "matrix": ""}


def court():
    text, count = COURT, 4
    for name, (cx, cy), (a, b, h) in (("house", (-5, 3), (3, 4, 9)), ("front", (5, 1), (2.5, 5, 6))):
        c, s = math.cos(0.3), math.sin(0.3)
        foot = [(cx + c * x - s * y, cy + s * x + c * y) for x, y in ((-a, -b), (a, -b), (a, b), (-a, b))]
        text += "".join(f"v {x:.6f} {y:.6f} {z}\n" for z in (0.01, h) for x, y in foot) + f"o {name}\n"
        faces = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6, 7), (3, 2, 1, 0)]
        for k, face in enumerate(faces):
            material = "front" if name == "front" and k == 3 else "wall"
            text += f"usemtl {material}\nf " + " ".join(str(count + 1 + i) for i in face) + "\n"
        count += 8
    return text


def sensors():
    places = np.random.default_rng(5).uniform((-11, -11), (11, -6), (24, 2))
    return ", ".join(f"{{position_m: [{x:.3f}, {y:.3f}, 1.1], normal: [{n}]}}" for (x, y), n in
                     zip(places, ["0, 0, 1", "0.3, -1, 0.4", "1, 0.2, 0.1"] * 8))


SAID = ("The root of the mean over the items (patches, facades …) of the variance over the seeds by the mean "
        "square of the stated errors; its own error over the seeds. Limit: 0.1, and what chance does, family-wise 1 %. "
        "Too small are errors of a patch whose shadow runs along the strata of its few samples: intervals of 95 % then "
        "hold the truth in some 85 % (direct_samples raises it); shadows here run askew.")


class Spread:
    """Values and stated errors, [seed, item]."""

    def __init__(self):
        self.values, self.errors = [], []

    def add(self, values, errors):
        self.values.append(np.ravel(np.asarray(values, np.float64)))
        self.errors.append(np.ravel(np.asarray(errors, np.float64)))

    def told(self):
        """Items whose error is more than rounding, of all that are not nearly dark."""
        values, errors = np.array(self.values), np.array(self.errors)
        size, square = np.abs(values).mean(axis=0), (errors**2).mean(axis=0)
        return (square > (ROUNDING * size)**2) & (size >= LEAST_SHARE * size.max())

    def ratio(self):
        """Spread over stated error, its standard error over the seeds, and of how many items: root of the mean over
        items of variance by mean square of the errors, so that each item weighs the same."""
        told = self.told()
        values, errors = np.array(self.values)[:, told], np.array(self.errors)[:, told]
        seeds, square = len(values), (errors**2).mean(axis=0)
        off = (values - values.mean(axis=0))**2 * seeds / (seeds - 1)
        spread, stated = (off / square).mean(axis=1), (errors**2 / square).mean(axis=1)
        found = math.sqrt(spread.mean())
        # A ratio of means, linearised.
        error = np.std(spread - found**2 * stated, ddof=1) / math.sqrt(seeds) / (2 * found)
        return found, float(error), values.shape[1]


LABEL = {"light_load": "patches", "facade_light_load": "facades", "sensor_light_load": "sensors"}
TERMS = ("sun", "sky", "ground", "absorbed", "escaped", "unshot", "estimated", "residual")


def ledger(result, when, value):
    """`value` of a dataset: its sum over time, or each row. A residual that is rounding (shooting) has no spread."""
    coming = np.sum([value(result[f"power_{term}"]) for term in TERMS[:3]])
    for term in TERMS:
        error = result[f"power_{term}_se"][()]
        if term != "residual":
            yield "ledger's terms" + when, np.ravel(value(result[f"power_{term}"])), np.ravel(error)
        elif np.max(error) > ROUNDING * coming:
            yield "ledger's residual" + when, np.ravel(value(result[f"power_{term}"])), np.ravel(error)


def totals(result):
    """(What, values, errors) of all that has an error in a result without instants."""
    for name, label in LABEL.items():
        yield label, result[name][:], result[name + "_se"][:]
        yield label + ", a day", result[name + "_by_day"][:], result[name + "_by_day_se"][:]
        yield label + ", an hour of day", result[name + "_by_hour_of_day"][:], result[name + "_by_hour_of_day_se"][:]
        for part in ("direct", "sky", "mirror", "reflected"):
            if f"{name}_{part}_se" in result and result[f"{name}_{part}_se"][:].any():
                yield f"{label}, {part} light", result[f"{name}_{part}"][:], result[f"{name}_{part}_se"][:]
    yield from ledger(result, "", lambda power: power.attrs["time_sum_kwh"])


def differences(base, other):
    """As `compare` has them: of realizations that share their random numbers."""
    for name, label in LABEL.items():
        each = other[name + "_realization"][:] - base[name + "_realization"][:]
        yield (f"difference of variants, {label}", other[name][:] - base[name][:],
               each.std(axis=0, ddof=1) / math.sqrt(len(each)))


def instants(result):
    yield "patches, an instant", result["irradiance"][:], result["irradiance_se"][:]
    yield "sensors, an instant", result["sensor_irradiance"][:], result["sensor_irradiance_se"][:]
    yield from ledger(result, ", an instant", lambda power: power[:])


def gathered(found):
    """{what: [values, errors]} of one run; lines of one name are one list of items."""
    together = {}
    for what, values, errors in found:
        pair = together.setdefault(what, ([], []))
        pair[0].append(np.ravel(values))
        pair[1].append(np.ravel(errors))
    return {what: [np.concatenate(each) for each in pair] for what, pair in together.items()}


def spreads(program, transport, seeds):
    kept = {}
    for seed in range(1, seeds + 1):
        found = []
        for errors in ("totals", "instants"):
            name = f"seeds_{transport}_{errors}_{seed}"
            results = program.results(name, STUDY.format(
                seed=seed, errors=errors, sensors=sensors(), realizations=REALIZATIONS, transport=transport,
                mirror=MIRROR[transport]))
            if errors == "totals":
                found += [*totals(results["other"]), *differences(results["base"], results["other"])]
            else:
                found += instants(results["other"])
            for result in results.values():
                result.close()
            program.forget(name)
        for what, (values, errors) in gathered(found).items():
            kept.setdefault(what, Spread()).add(values, errors)
    # The sun is a point: a sensor sees it or not, without an error.
    return {what: spread for what, spread in kept.items() if spread.told().any()}


def sections(program, tell):
    program.write("court.obj", court())
    found = {}
    for transport, seeds in SEEDS.items():
        tell(f"{seeds} seeds, {transport}")
        found[transport] = [(what, *spread.ratio()) for what, spread in spreads(program, transport, seeds).items()]
    tests = sum(map(len, found.values()))
    accepted = statistics.NormalDist().inv_cdf(1 - FAMILY_WISE / tests / 2)
    for transport, kinds in found.items():
        name = f"error bars against {SEEDS[transport]} seeds, {transport}"
        yield Section(name, "the spread itself", [
            Row(name, f"{what}: spread / stated error, {items} of them", 1, ratio, error, CLAIM + accepted * error)
            for what, ratio, error, items in kinds], said=SAID)
