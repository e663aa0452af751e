#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package: studies from dicts, errors with the program's words, results with names.

python_test.py SUNLOAD SOURCE_FOLDER
"""

import json
import os
import sys
import tempfile

from raised import raised
from skip import skip
from small_study import SQUARE

try:
    import matplotlib
    import numpy as np
    import pandas  # noqa: F401
    import xarray  # noqa: F401
except ImportError as error:
    skip(f"{error.name} is missing")
matplotlib.use("Agg")


def study(**changes):
    base = {"name": "square", "site": {"latitude_deg": 49.7, "longitude_deg": 13.4, "timezone": "Europe/Prague"},
            "period": {"days": ["2026-03-21", "2026-04-21"], "from": "09:00", "to": "15:00", "step_min": 180},
            "light": {"source": "clear_sky"},
            "scene": {"files": ["square.obj"], "materials": {"paving": {"diffuse": 0.3}, "plaster": {"diffuse": 0.6},
                                                             "glass": {"diffuse": 0.05, "mirror": 0.85}}},
            "mesh": {"max_edge_m": 3, "oracle": "none"}, "solver": {"lines_per_patch": 64},
            "variants": [{"name": "baseline"},
                         {"name": "dark", "scene": {"materials": {"plaster": {"diffuse": 0.2}}}}]}
    return {**base, **changes}


def expect_errors(sunload, folder):
    wrong = raised(sunload.InputError, lambda: sunload.Study(study(name="wrong", colour=1), folder).check())
    assert "unknown key 'colour'" in wrong and "wrong.yaml" in wrong, wrong
    # A slip is mended under the same name; numbers of numpy are numbers.
    rules = {"lines_per_patch": np.int64(64), "unshot": np.float32(0.001)}
    mended = sunload.Study(study(name="wrong", solver=rules, sensors={"points": [
        {"position_m": np.array([0.0, -5.0, 1.5]), "normal": [0, -1, 0]}]}), folder).check()
    assert mended.report["variants"][0]["patches"] > 0
    assert "another study" in raised(sunload.InputError, lambda: sunload.Study(study(name="wrong"), folder))
    assert "letters, digits" in raised(sunload.InputError, lambda: sunload.Study(study(name="a b"), folder))
    assert "another study" in raised(sunload.InputError, lambda: sunload.Study(study(mesh={"max_edge_m": 9}), folder))
    assert "run` has written" in raised(sunload.InputError, lambda: sunload.open(os.path.join(folder, "square.obj")))
    for name in ("square.obj", "none.h5", "."):
        told = raised(sunload.InputError, lambda: sunload.open(os.path.join(folder, name)))  # noqa: B023
        assert "errno" not in told and "file signature" not in told, told


def expect_program_named(sunload, folder):
    """What SUNLOAD names and cannot be started is told; the version is the program's."""
    named = os.environ["SUNLOAD"]
    assert program_of(sunload).run(["--version"]).split()[1] == sunload.__version__
    try:
        for wrong in (os.path.join(folder, "none"), os.path.join(folder, "square.obj")):
            os.environ["SUNLOAD"] = wrong
            told = raised(sunload.MachineError, lambda: program_of(sunload).run(["--version"]))
            assert wrong in told and "SUNLOAD" in told, told
    finally:
        os.environ["SUNLOAD"] = named


def program_of(sunload):
    return sys.modules[sunload.InputError.__module__]


def expect_own_folder(sunload, folder):
    """Name and folder are those that the program reads, in whatever order they stand."""
    path = os.path.join(folder, "order.yaml")
    rest = study(name="order", output={"folder": "elsewhere"})
    del rest["variants"]
    text = {"format": "sunload-study-1", "variants": [{"name": "first"}], **rest}
    with open(path, "w", encoding="utf-8") as file:
        json.dump(text, file)
    ran = sunload.Study(path, folder)
    assert ran.name == "order"
    assert ran.run().paths == {"first": os.path.join(folder, "elsewhere", "order", "first.h5")}
    assert os.path.exists(ran.run().paths["first"])
    there = ran.run(output="there").paths["first"]
    assert there == os.path.join(folder, "there", "order", "first.h5") and os.path.exists(there)


def expect_result(sunload, result):
    assert set(result.surface_of.values) >= {"wall", "roof"}, set(result.surface_of.values)
    walls = result.sunload.mean("light_load", surface_of="wall")
    by_hand = result.surface_of.values == "wall"
    area = result.patch_area.values[by_hand]
    assert np.isclose(walls, np.sum(result.light_load.values[by_hand] * area) / area.sum(), rtol=1e-6)
    facades = result.sunload.facades()
    assert list(facades.index) == list(result.facade.values)
    value = [column for column in facades.columns if column.startswith("light_load")][0]
    assert np.allclose(facades[value], result.facade_light_load.values, rtol=1e-5), facades
    months = result.sunload.months()
    assert months.dims == ("month", "facade")
    assert np.allclose(months.sum("month"), result.facade_light_load, rtol=1e-5)
    assert "months have light_load, " in raised(ValueError, lambda: result.sunload.months("power_load"))
    assert "water" in raised(ValueError, lambda: result.sunload.mean("light_load", surface_of="water"))
    assert "did you mean 'wall'" in raised(ValueError, lambda: result.sunload.mean("light_load", surface_of="walls"))
    roofs = result.sunload.mean("light_load", surface_of="roof")
    of_roofs = result.patch_area.values[result.surface_of.values == "roof"].sum()
    both = result.sunload.mean("light_load", surface_of=["wall", "roof"])
    assert np.isclose(both, (walls * area.sum() + roofs * of_roofs) / (area.sum() + of_roofs), rtol=1e-6)
    south = result.isel(patch=np.arange(3))
    assert south.sunload.mean("light_load").shape == ()
    assert "is a part (patch)" in raised(ValueError, south.sunload.facades)
    assert "did you mean 'light_load'" in raised(ValueError, lambda: result.sunload.mean("light_lode"))
    assert "facade_of" not in raised(ValueError, lambda: result.sunload.mean("glare"))
    ax = result.sunload.plot_map()
    assert len(ax.collections[0].get_paths()) == int((result.patch_normal.values[:, 2] > 1e-6).sum())
    assert result.sunload.plot_map() is not ax
    assert "has no time" in raised(ValueError, lambda: result.sunload.plot_map(time=result.time.values[0]))
    bounds = result.time_bounds.values
    # The last interval's end is its own.
    seen = np.sort(result.irradiance.values[-1][result.patch_normal.values[:, 2] > 1e-6])
    for before in (1, 0):
        time = bounds[-1][1] - np.timedelta64(before, "s")
        last = result.sunload.plot_map("irradiance", time=time).collections[0].get_array()
        assert np.array_equal(np.sort(last), seen), (before, last, seen)
    after = bounds[-1][1] + np.timedelta64(1, "s")
    assert "in no interval" in raised(ValueError, lambda: result.sunload.plot_map("irradiance", time=after))


def main():
    os.environ["SUNLOAD"], source = sys.argv[1:3]
    sys.path.insert(0, os.path.join(source, "io/python"))
    import sunload
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "square.obj"), "w", encoding="utf-8") as file:
            file.write(SQUARE)
        told = []
        checked = sunload.Study(study(), folder).check()
        assert [variant["name"] for variant in checked.report["variants"]] == ["baseline", "dark"]
        assert checked.report.seconds >= 0
        results = checked.run(progress=told.append)
        assert any(entry.get("share") == 1 for entry in told), told
        assert list(results) == ["baseline", "dark"]
        with results["baseline"] as base, results["dark"] as dark:
            expect_result(sunload, base)
            differences = base.sunload.compare(dark)
            assert "part (time)" in raised(ValueError, lambda: base.sunload.compare(dark.isel(time=slice(1))))
            assert (differences["difference_kwh_m2"] < 0).any() and "p_value" in differences
        # Of the same study, by its file: nothing is computed again.
        again_file = os.path.join(folder, "square.yaml")
        again = sunload.Study(again_file, folder).run(variants=["dark"])
        assert again.paths == sunload.Study(again_file, folder).run(variants="dark").paths
        assert list(again) == ["dark"] and os.path.exists(again.paths["dark"])
        expect_errors(sunload, folder)
        expect_program_named(sunload, folder)
        expect_own_folder(sunload, folder)


main()
