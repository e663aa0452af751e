# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A random study: one seed, one folder with the study file and everything that it names."""

import copy
import json
import os
import random as random_numbers

from random_light import RandomLight
from random_scene import RandomScene

PARTS = ["total", "direct", "sky", "mirror", "lamps", "reflected"]
PATCHES_PER_SQUARE = 5  # longest edge²: what bisection leaves
MEASURABLE_PATCHES = 30000  # of a study that takes seconds


def random_mesh(random, area_m2, patches, extent):
    """About so many patches, at the least."""
    longest = max(0.001, round((PATCHES_PER_SQUARE * area_m2 / patches) ** 0.5, 6))
    mesh = {"max_edge_m": longest, "oracle": random.choice(["none", "none", "none", "default", "historic"])}
    if mesh["oracle"] == "default":
        mesh["light_tolerance"] = random.choice([0.3, 0.5, 1])
    if mesh["oracle"] == "historic":
        mesh["light_threshold_m2"] = min(1e6, area_m2 / patches / 4)
    # Refinement has an end in small scenes.
    mesh["min_area_m2"] = min(1e6, max(1e-9, area_m2 / patches / 30))
    if random.random() < 0.2:
        mesh["t_vertices"] = "keep"
    if random.random() < 0.3:
        mesh["link_threshold"] = random.choice([0, 2, 50])
    return mesh


def random_solver(random, transport):
    realizations = random.choice([2, 3, 4, 8, 8, 16])
    solver = {"transport": transport, "realizations": realizations, "seed": random.choice([0, 1, 2 ** 63 - 1, random.randrange(1000)]),
              "lines_per_patch": realizations * random.choice([1, 2, 3, 5, 8, 16]),
              "direct_samples": realizations * random.choice([1, 1, 2, 3]),
              "bounces": random.choice([0, 1, 2, 5, 5, 12]), "batch_suns": random.choice([1, 2, 3, 7, 16, 17, 64])}
    optional = {"unshot": [0, 1e-3, 0.1], "unfollowed": ["estimate", "leave"], "mirror_depth": [0, 1, 3, 8],
                "sun_samples_per_interval": ["auto", 2, 3]}
    solver.update({key: random.choice(values) for key, values in optional.items() if random.random() < 0.3})
    if transport == "shoot":
        solver["jacobi"] = random.choice(["incremental", "incremental", "regular"])
        if solver["bounces"] == 12:
            solver["bounces"] = 6  # every sun is shot anew
    if random.random() < 0.06:
        solver["accuracy"] = random.choice([{"light_load_relative": 0.2}, {"irradiance_relative": 0.3}])
        solver["max_lines_per_patch"] = 4 * max(solver["lines_per_patch"], solver["direct_samples"])
    return solver


def random_variants(random, study):
    """The study as it is, and with one change."""
    names = [name for name in study["scene"].get("materials", {}) if name != "panel"]
    changes = [{"light": {"far_ground_albedo": 0.5}}, {"solver": {"seed": 77}}, {"solver": {"bounces": 2}},
               {"mesh": {"max_edge_m": 2 * study["mesh"]["max_edge_m"]}}]
    if names:
        matt = dict.fromkeys(study["scene"]["materials"][names[0]])
        matt.update(diffuse=0.33)
        changes += [{"scene": {"materials": {names[0]: matt}}}] * 2
        changes.append({"scene": {"assign": [{"object": "*1", "material": names[-1]}]}})
    return [{"name": "baseline"}, {"name": "changed", **random.choice(changes)}]


def add_seasons(random, study):
    """One material or two are others for a part of the year."""
    materials = {name: m for name, m in study["scene"].get("materials", {}).items() if name != "panel"}
    sides = random.choice([m.get("sides") for m in materials.values()])
    alike = [name for name, m in materials.items() if m.get("sides") == sides]
    months = sorted(random.sample(range(1, 13), random.randint(1, 6)))
    dates = [f"{random.randint(1, 12):02}-{day}" for day in ("07", "21")]
    study["seasons"] = {"first": months, "second": dates}
    for name in alike[:2]:
        materials[name]["seasons"] = {random.choice(["first", "second"]): random.choice(alike)}


def join_short_intervals(random, study):
    """Where nothing is asked of each of them, in some studies, with a draw of its own."""
    solver, output, period = study["solver"], study["output"], study["period"]
    asks_for_each = (solver["transport"] == "shoot" or output.get("standard_error") == "instants"
                     or "irradiance_relative" in solver.get("accuracy", {}))
    if asks_for_each or not {"days", "start", "year_of"} & set(period) or random.random() > 0.3:
        return
    output["series"] = "none"
    solver["short_intervals"] = "together"


def random_sensors(random, folder, scene):
    def point():
        at = [round(random.uniform(scene.low[k], scene.high[k]), 3) for k in range(3)]
        return {"position_m": at, "normal": random.choice([[0, 0, 1], [0, 0, -2], [1, 0, 0], [0.1, -0.7, 0.4]])}

    points = [point() for _ in range(random.choice([1, 3, 8]))]
    if random.random() < 0.7:
        return {"points": points}
    with open(os.path.join(folder, "sensors.csv"), "w", encoding="utf-8") as file:
        file.writelines(",".join(map(str, p["position_m"] + p["normal"])) + "\n" for p in points)
    return {"file": "sensors.csv"}


def broken(random, study):
    """One thing is wrong: the program must say so with exit code 2."""
    wrong = copy.deepcopy(study)
    breaks = [
        lambda: wrong.update(colour="blue"),
        lambda: wrong["solver"].update(lines_per_patch=wrong["solver"]["realizations"] * 3 + 1),
        lambda: wrong["mesh"].update(max_edge_m=-1),
        lambda: wrong["light"].update(sky="green"),
        lambda: wrong["scene"].update(files=["not_there.obj"], builtin=None),
        lambda: wrong["scene"].update(materials={"odd": {"diffuse": 0.7, "mirror": 0.7}}),
        lambda: wrong["scene"].update(assign=[{"surface": "wall", "material": "never_defined"}]),
        lambda: wrong.update(variants=[{"name": "twin"}, {"name": "Twin"}]),
        lambda: wrong.update(period={"days": ["2026-06-21"], "from": "06:00", "to": "07:00", "step_min": 59}),
        lambda: wrong.update(period={"days": ["2026-02-30"]}),
        lambda: wrong.pop("period"),
        lambda: wrong["scene"].pop("files", None) or wrong["scene"].pop("builtin", None),
        lambda: wrong.update(format="sunload-study-2")]
    random.choice(breaks)()
    return wrong


class RandomStudy:
    """`tree`: the study as written; `variants`: their names; `is_wrong`: the program must refuse it;
    `is_measurable`: it takes long enough that the estimates can be held against it; `is_sound`: what is
    said of random_scene, and no coarse links, which cost the ledger its balance."""

    def __init__(self, seed, folder):
        random = random_numbers.Random(seed)
        self.folder, self.name, self.random = folder, "soak", random
        transport = random.choice(["gather", "gather", "gather", "shoot"])
        bands = transport == "gather" and random.random() < 0.15
        illuminance = not bands and random.random() < 0.12
        self.is_wrong = random.random() < 0.04
        self.is_measurable = not self.is_wrong and random.random() < 0.03
        allowed = {"bands"} if bands else set()
        allowed.add("lumens" if illuminance else "emission")
        scene = RandomScene(random, folder, allowed)
        if illuminance and random.random() < 0.5:
            scene.luminaires()
        self.city, self.is_sound = scene.city, scene.is_sound
        light = RandomLight(random, folder, scene.crs, 64 if self.is_measurable else 24)
        patches = MEASURABLE_PATCHES if self.is_measurable else 10 ** random.uniform(1.3, 2.8)
        if light.is_of_weather_file:
            patches = min(patches, 150)
        study = {"format": "sunload-study-1", "name": self.name, **light.sections, "scene": scene.section,
                 "mesh": random_mesh(random, scene.area_m2, patches, scene.extent),
                 "solver": random_solver(random, transport), "output": self.random_output()}
        self.is_sound &= study["mesh"].get("link_threshold", 0) <= 0.5
        if bands:
            study["solver"]["bands"] = "rgb"
            study["light"]["colour"] = random.choice(["sky", "white"])
        if illuminance:
            study["light"]["quantity"] = "illuminance"
        if self.is_measurable:
            study["solver"].update(lines_per_patch=study["solver"]["realizations"] * 8)
            study["mesh"]["oracle"] = "none"
            for key in ("accuracy", "max_lines_per_patch"):
                study["solver"].pop(key, None)
        if random.random() < 0.15:
            study["sensors"] = random_sensors(random, folder, scene)
        if random.random() < 0.25 and not self.is_measurable:
            study["variants"] = random_variants(random, study)
        if random.random() < 0.15 and "positions" not in study["period"] and study["scene"].get("materials"):
            add_seasons(random, study)
        if not self.is_measurable:
            join_short_intervals(random_numbers.Random(f"short intervals of {seed}"), study)
        self.tree = broken(random, study) if self.is_wrong else study
        self.variants = [v["name"] for v in self.tree.get("variants", [{"name": "baseline"}])]
        self.path = self.write("study.yaml", self.tree)

    def random_output(self):
        random = self.random
        output = {"standard_error": random.choice(["none", "totals", "totals", "instants"]),
                  "compression": random.choice([0, 1, 4, 4, 9])}
        if random.random() < 0.3:
            output["series"] = random.sample(PARTS, random.randint(1, len(PARTS)))
        return output

    def write(self, name, tree):
        """One section a line: YAML that JSON's values are, too."""
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.writelines(f"{key}: {json.dumps(value)}\n" for key, value in tree.items())
        return path
