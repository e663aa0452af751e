#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""sunload.solve: what has a formula, what a study of the same mesh has, the same bits for any number of threads, all
errors of the input at once, Ctrl-C.

solve_test.py SUNLOAD SOURCE_FOLDER
"""

import math
import os
import signal
import sys
import tempfile
import threading
import time
import warnings

from raised import raised
from skip import skip

try:
    import numpy as np
    import pandas
    import xarray  # noqa: F401
except ImportError as error:
    skip(f"{error.name} is missing")

FALSE_ALARMS = 1e-3  # of the whole test; the seeds are always the same
COMPARISONS = 100  # at most
REALIZATIONS = 16

PLANE = ([[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]], [[0, 1, 2], [0, 2, 3]])
WALL = ([[0, 0, 0], [0, 10, 0], [0, 10, 10], [0, 0, 10]], [[0, 1, 2], [0, 2, 3]])  # faces east


def differs(values, errors, truth):
    """Whether values differ from the truth by more than chance and the rounding of a float allow."""
    accepted = t_quantile(1 - FALSE_ALARMS / COMPARISONS / 2, REALIZATIONS - 1)
    return bool((np.abs(values - truth) > accepted * errors + 1e-5 * np.abs(truth)).any())


def expect_near(result, part, truth, fault):
    """`part` of the light of one sun; `fault` is a truth that must be refused."""
    values, errors = (result["light_load" + part + end].values * 1000 for end in ("", "_se"))
    assert not differs(values, errors, truth), (part, values, errors, truth)
    assert differs(values, errors, fault), (part, values, errors, fault)


def expect_open_plane(sunload):
    elevation, dni, dhi = 40.0, 800.0, 120.0
    direct = dni * math.sin(math.radians(elevation))
    result = sunload.solve(*PLANE, 0.3, [[135, elevation, dni], [0, -5, dni]], dhi, realizations=REALIZATIONS,
                           standard_error="instants")
    assert result.irradiance.dims == ("sun", "patch") and result.irradiance.shape == (2, 2)
    assert np.allclose(result.irradiance_direct[0], direct, rtol=1e-6)
    assert not differs(result.irradiance[0].values, result.irradiance_se[0].values, direct + dhi)
    assert differs(result.irradiance[0].values, result.irradiance_se[0].values, dni + dhi)  # a cosine forgotten
    assert not result.irradiance_direct[1].any() and not differs(  # a sun below the horizon
        result.irradiance[1].values, result.irradiance_se[1].values, dhi)
    assert np.allclose(result.patch_area, 50) and np.allclose(result.patch_normal, [0, 0, 1])
    assert np.allclose(result.patch_centroid.mean("patch"), [5, 5, 0]) and list(result.patch_input_triangle) == [0, 1]
    assert np.allclose(result.light_load * 1000, result.irradiance.sum("sun"), rtol=1e-5)
    assert list(result.sun_hours) == [1, 1]
    assert np.isclose(result.sunload.mean("irradiance").sel(sun=0), result.irradiance[0].mean())
    told = raised(ValueError, lambda: result.sunload.mean("irradiance", surface_of="wall"))
    assert "surface_of" in told and "choose by material_of" in told, told
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        night = sunload.solve(*PLANE, 0.3, [[135, 10, 500], [0, -5, 1], [0, 0, 2]], 0, realizations=REALIZATIONS)
        sunload.solve(*PLANE, 0.3, [[135, 10, 500], [0, -5, 0]], 0, realizations=REALIZATIONS)
    assert len(caught) == 1 and "2 with dni_w_m2 above 0 not above the horizon, the first at [1]" in str(
        caught[0].message) and caught[0].filename == __file__, [str(one.message) for one in caught]
    assert not night.irradiance[1:].values.any()


def expect_half_sky(sunload):
    dhi, albedo = 200.0, 0.25
    result = sunload.solve(*WALL, 0.3, [[90, 30, 0]], {"dhi_w_m2": dhi, "sky": "uniform"}, far_ground_albedo=albedo,
                           realizations=REALIZATIONS, lines=4096, hours=1)
    expect_near(result, "_sky", dhi / 2, dhi / 1.9)
    expect_near(result, "_reflected", albedo * dhi / 2, albedo * dhi / 1.9)


def wall_under(patches, radiance):
    """Irradiance of a plane that faces east, of radiances of (low, high) elevations and azimuths [degrees]: the mean of
    max(0, w_x) over each patch by midpoints of equal solid angle."""
    n, total = 60, 0.0
    middle = (np.arange(n) + 0.5) / n
    for (low, high, west, east), of_patch in zip(patches, radiance):
        bottom, top = np.sin(np.radians([low, high]))
        up, azimuth = np.meshgrid(bottom + (top - bottom) * middle, np.radians(west + (east - west) * middle))
        facing = np.maximum(0, np.sqrt(1 - up**2) * np.sin(azimuth))
        total += of_patch * facing.mean() * math.radians(east - west) * (top - bottom)
    return total


def tregenza():
    patches = [(12 * row, 12 * row + 12, (i - 0.5) * 360 / count, (i + 0.5) * 360 / count)
               for row, count in enumerate((30, 30, 24, 24, 18, 12, 6)) for i in range(count)]
    return patches + [(84, 90, 0, 360)]


def expect_radiances(sunload):
    patches = tregenza()
    radiance = np.random.default_rng(7).uniform(5, 200, len(patches))
    wall = sunload.solve(*WALL, 0.3, [[90, 30, 0]], radiance[np.newaxis], realizations=REALIZATIONS, lines=4096)
    truth = wall_under(patches, radiance)
    expect_near(wall, "_sky", truth, wall_under(patches, np.roll(radiance, 15)))
    cells = sunload.solve(*PLANE, 0.3, [[90, 30, 0]], np.full((1, 4096), 50.0), realizations=REALIZATIONS)
    expect_near(cells, "_sky", 50 * math.pi, 50 * 3)


def facing_squares(side, distance):
    """Form factor of two squares face to face (Howell, catalog of configuration factors, C-11)."""
    x = side / distance
    y = 1 + x * x
    return 2 / (math.pi * x * x) * (math.log(y / math.sqrt(1 + 2 * x * x)) + 2 * x * math.sqrt(y) * math.atan(
        x / math.sqrt(y)) - 2 * x * math.atan(x))


def expect_facing_planes(sunload):
    side, distance, exitance, rho = 10.0, 8.0, 100.0, 0.6
    low = np.array(PLANE[0], dtype=float)
    vertices = np.vstack([low, low[::-1] + [0, 0, distance]])
    triangles = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]
    result = sunload.solve(vertices, triangles, [{"diffuse": rho, "name": "floor"}, {"emission_w_m2": exitance}],
                           [[0, -90, 0]], triangle_material=[0, 0, 1, 1], realizations=REALIZATIONS, lines=8192, bounces=3)
    factor = facing_squares(side, distance)
    floor, lamp = result.isel(patch=slice(0, 2)), result.isel(patch=slice(2, 4))
    assert list(floor.material_of.values) == ["floor"] * 2 and np.allclose(lamp.patch_normal, [0, 0, -1])
    expect_near(floor, "_lamps", factor * exitance, facing_squares(side, 1.1 * distance) * exitance)
    # What comes back to the lamp, which is black: constant radiosity of each triangle of the floor, equal by symmetry.
    expect_near(lamp, "_reflected", rho * factor**2 * exitance, 0.9 * rho * factor**2 * exitance)


# Ground, two walls that face each other, a roof between them; a material of every kind.
STREET = np.array([[-6, -6, 0], [6, -6, 0], [6, 6, 0], [-6, 6, 0], [-4, -6, 0], [-4, 6, 0], [-4, 6, 5], [-4, -6, 5],
                   [4, 6, 0], [4, -6, 0], [4, -6, 7.25], [4, 6, 7.25], [-4, -3, 5], [4, -3, 5], [4, 3, 5], [-4, 3, 5]],
                  dtype=float)
STREET_TRIANGLES = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7], [8, 9, 10], [8, 10, 11], [12, 13, 14], [12, 14, 15]]
STREET_MATERIALS = [{"name": "paving", "diffuse": 0.3}, {"name": "wet", "diffuse": 0.2, "glossy": 0.3, "glossy_exponent": 20},
                    {"name": "plaster", "diffuse": 0.6, "sides": "two"}, {"name": "mirror", "diffuse": 0.05, "mirror": 0.85},
                    {"name": "panes", "refractive_index": 1.5, "panes": 2, "thickness_m": 0.006, "absorption_per_m": 20},
                    {"name": "metal", "diffuse": 0.1, "refractive_index": 1.2, "extinction_coefficient": 7},
                    {"name": "screen", "diffuse": 0.2, "transmittance": 0.4, "sides": "two"},
                    {"name": "glass", "diffuse": 0.1, "mirror": 0.08, "normal_transmittance": 0.7, "emission_w_m2": 30}]
KINDS = (STREET, STREET_TRIANGLES, STREET_MATERIALS)
COURT = (np.array([[0, 0, 0], [8, 0, 0], [8, 8, 0], [0, 8, 0], [0, 8, 4], [8, 8, 4]], dtype=float),
         [[0, 1, 2], [0, 2, 3], [3, 2, 5], [3, 5, 4]], [{"name": "paving", "diffuse": 0.3}] * 2 +
         [{"name": "plaster", "diffuse": 0.6}] * 2)
POSITIONS = [(100.0, 20.0), (170.0, 45.5), (250.0, 30.0)]


def solved(sunload, model, positions=tuple(POSITIONS), skies=110.0, **changes):
    options = {"max_edge_m": 4, "lines": 64, "seed": 5, "hours": 0.5, **changes}
    return sunload.solve(*model, [(*place, 700.0) for place in positions], skies, **options)


def same_bits(one, other):
    return one.dtype == other.dtype and one.shape == other.shape and one.tobytes() == other.tobytes()


def study_of(materials, positions, sky, standard_error):
    table = {m["name"]: {key: value for key, value in m.items() if key != "name"} for m in materials}
    return {"name": "street",
            "period": {"positions": [{"azimuth_deg": a, "elevation_deg": e, "interval_min": 30} for a, e in positions]},
            "light": {"source": "fixed", "dni_w_m2": 700, "dhi_w_m2": 110, **sky},
            "scene": {"files": ["street.obj"], "repair": "none", "orient": "keep", "ground": "none", "materials": table},
            "mesh": {"max_edge_m": 4, "oracle": "none", "min_area_m2": 0},
            "solver": {"lines_per_patch": 64, "seed": 5}, "output": {"standard_error": standard_error}}


def expect_study(sunload, model, positions, sky, standard_error="totals"):
    """The same bits as the program's for a study of the same mesh; returns what `solve` gives."""
    ours = solved(sunload, model, positions, {"dhi_w_m2": 110, **sky}, standard_error=standard_error)
    vertices, triangles, materials = model
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "street.obj"), "w", encoding="utf-8") as file:
            file.write("o mesh\n" + "".join("v {!r} {!r} {!r}\n".format(*map(float, row)) for row in vertices))
            for corners, material in zip(triangles, materials):
                file.write("usemtl {}\nf {} {} {}\n".format(material["name"], *(v + 1 for v in corners)))
        study = sunload.Study(study_of(materials, positions, sky, standard_error), folder)
        with study.run()["baseline"] as result:
            names = {name for name in ours.data_vars if "patch" in ours[name].dims} - {"patch_vertices"}
            assert names <= set(result.variables), names - set(result.variables)
            assert {"irradiance", "light_load_se", "light_load_reflected_se", "sun_hours"} <= names
            for name in names:
                assert same_bits(ours[name].values, result[name].values), (name, sky)
            assert (ours.material_of.values == result.material_of.values).all()
            assert ours.attrs.get("year_suns") == result.attrs.get("year_suns")
    return ours


def expect_studies(sunload):
    ours = expect_study(sunload, KINDS, POSITIONS, {}, "instants")
    assert {"irradiance_mirror", "irradiance_lamps", "irradiance_se"} <= set(ours)
    other = solved(sunload, KINDS, seed=6)  # a fault that must be seen
    assert not same_bits(ours.irradiance.values, other.irradiance.values)
    expect_study(sunload, COURT, POSITIONS, {"sky": "cie_general", "sky_type": 4})
    # So many that few solutions serve all of them.
    many = [(100 + 160 * k / 599, 15 + 30 * math.sin(math.pi * k / 599)) for k in range(600)]
    assert expect_study(sunload, COURT, many, {}).attrs["year_suns"] > 0


def expect_same_bits(sunload):
    first = solved(sunload, KINDS, threads=1)
    for threads in (2, 3):
        again = solved(sunload, KINDS, threads=threads)
        for name in first.variables:
            if first[name].dtype != object:
                assert same_bits(first[name].values, again[name].values), (name, threads)


def expect_other_forms(sunload):
    """By directions, one sky for each, one material by its index, and far from the origin, as in a national grid."""
    vertices, triangles, materials = COURT
    place = np.array([3512345.0, 5812345.0, 120.0])
    azimuth, elevation = np.radians(POSITIONS).T
    suns = {"direction": np.column_stack([np.cos(elevation) * np.sin(azimuth), np.cos(elevation) * np.cos(azimuth),
                                          np.sin(elevation)]), "dni_w_m2": [700, 700, 700]}
    moved = sunload.solve(vertices + place, triangles, [materials[3], materials[0]], suns, [110.0] * 3,
                          triangle_material=[1, 1, 0, 0], max_edge_m=4, lines=2048, hours=0.5)
    here = solved(sunload, COURT, lines=2048)
    assert np.allclose(moved.sun_azimuth, [a for a, _ in POSITIONS])
    assert np.allclose(moved.patch_centroid, here.patch_centroid + place)
    assert (moved.material_of.values == here.material_of.values).all()
    error = np.hypot(moved.light_load_se, here.light_load_se).values
    accepted = t_quantile(1 - FALSE_ALARMS / COMPARISONS / 2 / error.size, 14)
    apart = np.abs(moved.light_load - here.light_load).values
    assert (apart < accepted * error + 1e-5 * here.light_load.values).all(), (apart / error, accepted)
    table = pandas.DataFrame({"time": ["a", "b", "c"], "azimuth_deg": azimuth, "elevation_deg": elevation,
                              "dni_w_m2": 700.0, "dhi_w_m2": 110.0, "ghi_w_m2": 0.0})
    table[["azimuth_deg", "elevation_deg"]] = POSITIONS
    listed = sunload.solve(vertices, triangles, [0.3, 0.3, 0.6, 0.6], table, table, max_edge_m=4, lines=2048, hours=0.5,
                           seed=5)
    assert same_bits(listed.irradiance.values, here.irradiance.values)


def expect_others_run(sunload):
    """Python goes on meanwhile, and calls of several threads wait for each other."""
    results, beats, done = {}, [], threading.Event()

    def beat():
        while not done.wait(0.002):
            beats.append(time.monotonic())

    def work(seed):
        begin = time.monotonic()
        results[seed] = (solved(sunload, COURT, seed=seed, max_edge_m=0.3, threads=1), begin, time.monotonic())

    heart = threading.Thread(target=beat)
    heart.start()
    workers = [threading.Thread(target=work, args=(seed,)) for seed in (5, 6)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    done.set()
    heart.join()
    for seed, (result, begin, end) in results.items():
        assert sum(begin < at < end for at in beats) > 10, "other threads stood still"
        assert same_bits(result.irradiance.values, solved(sunload, COURT, seed=seed, max_edge_m=0.3).irradiance.values)


def expect_interruption(sunload):
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    raised(KeyboardInterrupt, lambda: solved(sunload, COURT, max_edge_m=0.05, lines=2048))
    # Whole, it takes minutes; it ends at the next thousand patches. Enough for a machine that is busy with other tests.
    assert time.monotonic() - begin < 20, time.monotonic() - begin
    assert solved(sunload, COURT).irradiance.values.any()


def expect_refusals(sunload):
    message = raised(ValueError, lambda: sunload.solve(
        [[0, 0, 0], [1, 0, 0], [1, 1, math.nan]], [[0, 1, 3]], [{"difuse": 0.3}, {"diffuse": 0.8, "mirror": 0.4}],
        [[0, 95, 3000]], -3, lines=100, threads=0))
    for words in ("vertices: 1 value not finite, the first at [2, 2]", "3 at [0, 2] (they count the rows",
                  "unknown key 'difuse'; did you mean 'diffuse'?", "materials[1]: diffuse + mirror = 1.2 is above 1",
                  "give triangle_material", "outside of [0, 2000], the first 3000", "did azimuth and elevation",
                  "skies: dhi_w_m2: 1 value outside", "threads = 0"):
        assert words in message, (words, message)
    plain = [*PLANE, 0.3, [[90, 30, 500]], 100]

    def refused(words, place, value, **options):
        arguments = list(plain)
        if place is not None:
            arguments[place] = value
        told = raised(ValueError, lambda: sunload.solve(*arguments, **options))
        assert words in told, told

    refused("vertices: shape [3] (wanted: [n, 3])", 0, [0, 1, 2])
    refused("vertices: not an array of numbers", 0, "mesh")
    refused("without area, the first is number 0 (irradiance is light per area); leave them out", 1, [[0, 1, 1]])
    refused("triangles: there are none", 1, np.zeros((0, 3), int))
    refused("not whole numbers", 1, [[0, 1, 1.5]])
    refused("0.3, not 30", 2, [30, 40])
    refused("materials: shape [3]", 2, [0.1, 0.2, 0.3])
    refused("cannot stand with refractive_index", 2, {"refractive_index": 1.5, "mirror": 0.1})
    refused("1.018 normal_transmittance = 1.018 is above 1", 2, {"normal_transmittance": 1})
    refused("no dni_w_m2", 3, {"azimuth_deg": [1], "elevation_deg": [1]})
    refused("not of length 1", 3, [[1, 1, 1, 100]])
    refused("suns: there are none", 3, np.zeros((0, 3)))
    refused("wanted: [1, 145] or [1, 577]", 4, [[1.0] * 10])
    refused("did you mean 'uniform'", 4, {"dhi_w_m2": 1, "sky": "unifrom"})
    refused("lines = 100 (cannot be shared by 8 realizations)", None, None, lines=100)
    refused("known: totals, instants", None, None, standard_error="all")
    refused("must lie in [2, 1024]", None, None, realizations=1)
    refused("hours: 1 value outside of (0, 8784]", None, None, hours=0)
    refused("the mesh is 1e+07 m wide", 0, np.array(PLANE[0]) * 1e6)
    # What the solver alone can tell.
    refused("patches", None, None, max_edge_m=1e-6)


def expect_missing_module(sunload):
    """Where pybind11 was not there when it was built."""
    program = os.environ["SUNLOAD"]
    os.environ["SUNLOAD"] = "/nowhere/sunload"
    told = raised(sunload.MachineError, lambda: sunload.solve(*PLANE, 0.3, [[0, 45, 100]]))
    os.environ["SUNLOAD"] = program
    assert "install pybind11-dev and python3-dev" in told, told


def main():
    os.environ["SUNLOAD"], source = os.path.abspath(sys.argv[1]), sys.argv[2]
    sys.path.insert(0, os.path.join(source, "io/python"))
    import sunload
    expect_missing_module(sunload)
    try:
        sunload.native.module()
    except sunload.MachineError:
        skip("this build has no module for Python (packages pybind11-dev, python3-dev)")
    expect_refusals(sunload)
    expect_open_plane(sunload)
    expect_half_sky(sunload)
    expect_radiances(sunload)
    expect_facing_planes(sunload)
    expect_same_bits(sunload)
    expect_other_forms(sunload)
    expect_others_run(sunload)
    expect_interruption(sunload)
    expect_studies(sunload)


sys.path.append(os.path.join(sys.argv[2], "scripts", "validation"))
from methods import t_quantile  # noqa: E402

if __name__ == "__main__":
    main()
