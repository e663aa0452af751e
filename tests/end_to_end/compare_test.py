#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`sunload compare --hdf5`: the differences are those of the two results, and the page about the file is right.

compare_test.py SUNLOAD SOURCE_FOLDER
"""

import csv
import io
import os
import re
import sqlite3
import subprocess
import sys
import tempfile

from skip import skip
from small_study import write_study

VARIANTS = """variants:
  - {name: baseline}
  - {name: dark, scene: {materials: {plaster: {diffuse: 0.2}}}}
  - {name: coarse, mesh: {max_edge_m: 4}}
"""
SENSORS = "sensors: {points: [{position_m: [0, 0, 1], normal: [0, 0, 1]}, {position_m: [0, %d, 1], normal: [0, 1, 0]}]}\n"
HEADER = ("group,name,area_m2,base_kwh_m2,variant_kwh_m2,difference_kwh_m2,difference_percent,se_kwh_m2,paired,p_value,"
          "p_corrected,significant,unmatched_area_m2")


def run(words, code=0):
    ran = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
    assert ran.returncode == code, f"{words}: {ran.returncode}\n{ran.stderr}"
    return ran.stdout


def documented(source):
    with open(os.path.join(source, "docs/comparison-file.md"), encoding="utf-8") as file:
        rows = [re.split(r"\s*\|\s*", line.strip("|\n ")) for line in file if re.match(r"\| \w+ \| ", line)]
    return {row[0]: row[1:] for row in rows if row[0] != "name"}


def kind_of(data):
    return "text" if data.dtype.kind == "O" else str(data.dtype)


def dims_of(data):
    """A scale is its own dimension."""
    return data.name.strip("/") if data.attrs.get("CLASS") == b"DIMENSION_SCALE" else ",".join(dim[0].name.strip("/") for dim in data.dims)


def test_page(source, file, compared="light_load", of_compared="kWh m-2"):
    table = {name.replace("light_load", compared):
             [dims, kind, of_compared if units == "kWh m-2" else units, meaning.replace("light load", compared.replace("_", " "))]
             for name, (dims, kind, units, meaning) in documented(source).items()}
    for name, (dims, kind, units, meaning) in table.items():
        data = file[name]
        mine = [dims_of(data), kind_of(data), data.attrs.get("units", ""), data.attrs["long_name"]]
        assert mine == [dims, kind, units, meaning], (name, mine)
    spared = re.compile(r"mesh|vertex\w*|patch\w*|object\w*|xyz|corner|group|facade|material\w*|input_triangle\w*")
    unknown = [name for name in file if name not in table and not spared.fullmatch(name)]
    assert not unknown, unknown


def expect_differences(file, base, variant):
    apart = variant["light_load"][()] - base["light_load"][()]
    assert np.array_equal(file["variant_patch"][()], np.arange(len(apart)))
    assert np.allclose(file["light_load_difference"][()], apart, atol=1e-12)
    rows = variant["light_load_realization"][()] - base["light_load_realization"][()]
    se = rows.std(axis=0, ddof=1) / len(rows) ** 0.5
    assert np.allclose(file["light_load_difference_se"][()], se, rtol=1e-9, atol=1e-12)


def test_numbers(file, base, variant, listing):
    assert file.attrs["errors"] == "paired" and file.attrs["sunload_format"] == "sunload-comparison-1"
    expect_differences(file, base, variant)
    try:
        expect_differences(file, variant, base)
    except AssertionError:
        pass
    else:
        raise AssertionError("the test does not see the sign")
    rows = list(csv.DictReader(io.StringIO(listing)))
    assert [row["name"] for row in rows] == list(file["group_name"].asstr())
    for column, name in (("difference_kwh_m2", "group_difference"), ("se_kwh_m2", "group_difference_se"), ("area_m2", "group_area"),
                         ("p_corrected", "group_p_corrected")):
        assert np.allclose([float(row[column]) for row in rows], file[name][()], rtol=1e-8, atol=1e-12), name
    degrees = base.attrs["realizations"] - 1
    assert (file["group_degrees_of_freedom"][()] == degrees).all()
    assert [row["significant"] == "true" for row in rows] == list(file["group_significant"][()] == 1)
    facades = {row["name"]: float(row["difference_kwh_m2"]) for row in rows if row["group"] == "facade"}
    assert np.allclose([facades[name] for name in file["facade_name"].asstr()], file["facade_light_load_difference"][()], rtol=1e-8)


def test_drawn_and_exported(sunload, comparison, folder):
    """Like a result, as far as it is one."""
    def at(name):
        return os.path.join(folder, name)

    run([sunload, "render", comparison, "-o", at("d.png"), "--size", "400x320"])
    run([sunload, "render", comparison, "-o", at("d.png"), "--size", "400x320", "--facade", "house/south_1"])
    for form in ("vtk", "glb", "vrml", "ply", "cityjson", "gpkg"):
        run([sunload, "export", comparison, "--to", form, "-o", at("d." + form)])
    rows = list(csv.DictReader(io.StringIO(run([sunload, "export", comparison, "--to", "csv"]))))
    with h5py.File(comparison) as file:
        assert np.allclose([float(row["difference_kwh_m2"]) for row in rows], file["light_load_difference"][()], atol=1e-8)
        facades = dict(zip(file["facade_name"].asstr(), file["facade_light_load_difference"][()]))
    layer = sqlite3.connect(at("d.gpkg")).execute("SELECT facade, sunload_light_load_difference_kwh_m2 FROM facades").fetchall()
    assert layer and all(np.isclose(value, facades[name], rtol=1e-12) for name, value in layer)
    for words in (["--camera", "sun"], ["--time", "2026-03-21T12:00"], ["--animate"], ["--colour", "grey"], ["--quantity", "sun_hours"]):
        run([sunload, "render", comparison, "-o", at("e.png"), *words], 2)
    for words in (["--to", "xdmf", "-o", at("d.xdmf")], ["--to", "energyplus"], ["--to", "csv", "--of", "facade"]):
        run([sunload, "export", comparison, *words], 2)
    for command in (["info", comparison], ["view", comparison, "-o", at("e.html")], ["compare", comparison, comparison]):
        run([sunload, *command], 2)


def test_another_quantity(sunload, source, results, folder):
    """Of a total without realizations: differences without errors, drawn and exported like those of the light load."""
    def at(name):
        return os.path.join(folder, name)

    pair = [results["baseline"], results["dark"]]
    for name, units in (("sun_hours", "h"), ("light_load_reflected", "kWh m-2"), ("sky_view_factor", "1")):
        words = [sunload, "compare", *pair, "--quantity", name]
        rows = list(csv.DictReader(io.StringIO(run([*words, "--csv", "--hdf5", at("q.h5")]))))
        with h5py.File(at("q.h5")) as file, h5py.File(pair[0]) as base, h5py.File(pair[1]) as variant:
            test_page(source, file, name, units)
            assert file.attrs["compared"] == name and file.attrs["errors"] == "none"
            apart = file[name + "_difference"][()]
            assert np.array_equal(apart, variant[name][()] - base[name][()])
            assert name != "light_load_reflected" or (apart < 0).any()
            area = file["patch_area"][()]
            assert np.isclose(float(rows[0]["difference"]), (apart * area).sum() / area.sum(), rtol=1e-6, atol=1e-12)
            for column in (name + "_difference_se", "group_difference_se", "group_p_value"):
                assert np.isnan(file[column][()]).all(), column
        assert {row["units"] for row in rows} == {units} and {row["se"] for row in rows} == {""}
        run([sunload, "render", at("q.h5"), "-o", at("q.png"), "--size", "400x320"])
        for form in ("vtk", "gpkg"):
            run([sunload, "export", at("q.h5"), "--to", form, "-o", at("q." + form)])
        assert "std.err." not in run(words)
    columns = [row[1] for row in sqlite3.connect(at("q.gpkg")).execute("PRAGMA table_info(facades)")]
    assert "sunload_sky_view_factor_difference" in columns, columns
    run([sunload, "compare", *pair, "--quantity", "sky_view"], 2)
    run([sunload, "compare", *pair, "--quantity", "sky_view_factor", "--hours", "8-12"], 2)


def test_sensors(sunload, folder):
    """Sensors in the same place have differences realization by realization; others stand alone."""
    write_study(folder, 4, 12)
    study = os.path.join(folder, "square.yaml")
    with open(study, encoding="utf-8") as file:
        text = file.read()
    for name, more in (("pair", SENSORS % -2 + VARIANTS), ("apart", SENSORS % -3)):
        with open(study, "w", encoding="utf-8") as file:
            file.write(text.replace("name: square", "name: " + name) + more)
        run([sunload, "run", study, "--progress", "none", "--output", folder])
    base, dark, coarse, apart = (os.path.join(folder, name) + ".h5" for name in
                                 ("pair/baseline", "pair/dark", "pair/coarse", "apart/baseline"))

    def rows(variant, *words):
        return list(csv.DictReader(io.StringIO(run([sunload, "compare", base, variant, "--csv", "--sensor", "*", *words]))))

    with h5py.File(base) as a, h5py.File(dark) as b:
        means = b["sensor_light_load"][()] - a["sensor_light_load"][()]
        apart_by = b["sensor_light_load_realization"][()] - a["sensor_light_load_realization"][()]
    se = apart_by.std(axis=0, ddof=1) / len(apart_by) ** 0.5
    for row, mean, error in zip(rows(dark), means, se, strict=True):
        assert row["paired"] == "true" and row["area_m2"] == "" and mean < 0
        assert np.allclose([float(row["difference_kwh_m2"]), float(row["se_kwh_m2"])], [mean, error], rtol=1e-6), row
    series = list(csv.DictReader(io.StringIO(run([sunload, "export", base, "--to", "csv", "--of", "sensor",
                                                  "--quantity", "irradiance_direct"]))))
    with h5py.File(base) as a:
        of_file = a["sensor_irradiance_direct"][()]
    for k in (0, 1):
        mine = [float(row[f"sensor_irradiance_direct_w_m2 sensor {k}"]) for row in series]
        assert np.allclose(mine, of_file[:, k], rtol=1e-6), k
    assert not np.allclose(of_file[:, 0], of_file[:, 1]), "the test does not see the order"
    for total in ("light_load_realization", "sun_hours", "position"):
        run([sunload, "export", base, "--to", "csv", "--of", "sensor", "--quantity", total], 2)
    assert [row["difference_kwh_m2"] == "" for row in rows(apart)] == [False, True, True]
    assert all(row["se"] == "" and float(row["difference"]) == 0 for row in rows(dark, "--quantity", "sun_hours"))
    assert not any(row["significant"] == "true" for row in rows(coarse)), "the mesh alone differs"
    assert [row["name"] for row in rows(dark, "--facade", "house/south_1")] == ["house/south_1", "0", "1"]
    run([sunload, "compare", base, dark, "--sensor", "2"], 2)


def test(sunload, source, folder):
    write_study(folder, 2, 4)
    study = os.path.join(folder, "square.yaml")
    with open(study, "a", encoding="utf-8") as file:
        file.write(VARIANTS)
    run([sunload, "run", study, "--progress", "none", "--output", folder])
    results = {name: os.path.join(folder, f"square/{name}.h5") for name in ("baseline", "dark", "coarse")}
    target = os.path.join(folder, "dark-baseline.h5")
    listing = run([sunload, "compare", results["baseline"], results["dark"], "--csv", "--hdf5", target])
    assert listing.splitlines()[0] == HEADER
    with h5py.File(target) as file, h5py.File(results["baseline"]) as base, h5py.File(results["dark"]) as variant:
        test_page(source, file)
        test_numbers(file, base, variant, listing)
    run([sunload, "compare", results["baseline"], results["coarse"], "--hdf5", target])
    with h5py.File(target) as file, h5py.File(results["coarse"]) as coarse:
        match = file["variant_patch"][()]
        assert (match < 0).any()
        # Of patches that are cut otherwise means over the area in common: all of the coarse ones' energy.
        on_base = file["variant_light_load"][()]
        assert np.isfinite(on_base).all()
        energy = (coarse["light_load"][()] * coarse["patch_area"][()]).sum()
        assert np.isclose((on_base * file["patch_area"][()]).sum(), energy, rtol=1e-9), energy
        assert np.allclose(file["light_load_difference"][()], on_base - file["base_light_load"][()], atol=1e-12)
        found = match >= 0
        assert np.allclose(file["patch_centroid"][()][found], coarse["patch_centroid"][()][match[found]], atol=1e-4)
    test_drawn_and_exported(sunload, target, folder)
    test_another_quantity(sunload, source, results, folder)
    test_sensors(sunload, folder)
    run([sunload, "compare", *results.values(), "--hdf5", target], 2)
    run([sunload, "compare", results["baseline"], results["dark"], "--hdf5", os.path.join(folder, "no/such.h5")], 3)
    import xarray
    for engine in ("h5netcdf", "netcdf4"):
        with xarray.open_dataset(target, engine=engine) as data:
            assert data["light_load_difference"].dims == ("patch",)
            assert list(data["facade_light_load_difference"].to_series().index) == list(data["facade_name"].values)


def main():
    sunload, source = (os.path.abspath(word) for word in sys.argv[1:3])
    if lacking:
        skip(lacking)
    with tempfile.TemporaryDirectory(prefix="sunload-compare-") as folder:
        test(sunload, source, folder)


try:
    import h5py
    import numpy as np
    import xarray  # noqa: F401
    lacking = ""
except ImportError as error:
    lacking = f"{error.name} is not installed (python3-h5py, python3-xarray)"

if __name__ == "__main__":
    main()
