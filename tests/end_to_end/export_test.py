#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Exports of a small study, read by the programs that they are for: the numbers are those of the result.

export_test.py SUNLOAD [PROGRAM]     PROGRAM: vtk or assimp, whose tests may be skipped; all others else
"""

import csv
import io
import json
import os
import re
import shutil
import sqlite3
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

from skip import skip
from small_study import RESULT, write_study

NOON = "2026-03-21T12:30"
NOON_INTERVAL = 6
WRONG_INPUT = 2


class Exports:
    """The program, and what it was asked for."""

    def __init__(self, sunload, folder):
        self.sunload, self.folder = sunload, folder

    def run(self, *words):
        return subprocess.run([self.sunload, *words], cwd=self.folder, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, encoding="utf-8")

    def file(self, name, form, *words):
        ran = self.run("export", RESULT, "--to", form, "-o", name, *words)
        assert ran.returncode == 0, f"{form}: {ran.returncode}\n{ran.stderr}"
        return os.path.join(self.folder, name)


def same(one, other):
    assert np.array_equal(one, other), f"{one}\n{other}"


def patch_values(result, name):
    data = result[name]
    return data[()] if data.ndim == 1 else data[NOON_INTERVAL]


def test_csv(exports, result):
    with open(exports.file("a.csv", "csv", "--quantity", "irradiance", "--time", NOON), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert np.allclose([float(row["irradiance_w_m2"]) for row in rows], patch_values(result, "irradiance"), 1e-8)
    assert exports.run("export", RESULT, "--to", "csv").stdout == exports.run("info", RESULT, "--patches").stdout
    with open(exports.file("series.csv", "csv", "--quantity", "series"), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    area = result["patch_area"][()]
    means = result["irradiance"][()].astype(float) @ area / area.sum()
    assert np.allclose([float(row["irradiance_w_m2 whole"]) for row in rows], means, 1e-8)


def test_vtk(exports, result):
    try:
        import vtk
        from vtk.util.numpy_support import vtk_to_numpy
    except ImportError:
        skip("python3-vtk9 is not installed")
    reader = vtk.vtkPolyDataReader()
    reader.SetFileName(exports.file("a.vtk", "vtk", "--quantity", "irradiance", "--time", NOON))
    reader.Update()
    read = reader.GetOutput()
    same(vtk_to_numpy(read.GetPoints().GetData()), result["vertex_position"][()])
    same(vtk_to_numpy(read.GetPolys().GetConnectivityArray()).reshape(-1, 3), result["patch_vertices"][()])
    cells = read.GetCellData()
    names = {cells.GetArrayName(k) for k in range(cells.GetNumberOfArrays())}
    assert {"light_load", "light_load_se", "sun_hours", "irradiance", "patch_object"} <= names, names
    for name in names:
        same(vtk_to_numpy(cells.GetArray(name)), patch_values(result, name))
    objects = read.GetFieldData().GetAbstractArray("object_name")
    assert [objects.GetValue(k) for k in range(2)] == ["square", "house"]


def data_item(folder, item):
    """Numbers that an item of XDMF stands for."""
    import h5py
    if item.get("ItemType") == "HyperSlab":
        slab, source = item.findall("DataItem")
        (first, begin), _, (count, width) = np.array(slab.text.split(), int).reshape(3, 2)
        return data_item(folder, source)[first:first + count, begin:begin + width].ravel()
    path, dataset = item.text.split(":")
    with h5py.File(os.path.join(folder, path), "r") as file:
        numbers = file[dataset][()]
    assert numbers.shape == tuple(int(n) for n in item.get("Dimensions").split())
    kind = {"Float": "f", "Int": "i", "Char": "i"}[item.get("NumberType")]
    assert (numbers.dtype.kind, numbers.dtype.itemsize) == (kind, int(item.get("Precision"))), dataset
    return numbers


def test_xdmf(exports, result):
    os.makedirs(os.path.join(exports.folder, "to/x & y"), exist_ok=True)
    path = exports.file("to/x & y/a.xdmf", "xdmf")
    grids = xml.parse(path).getroot().findall("Domain/Grid/Grid")
    same([float(grid.find("Time").get("Value")) for grid in grids], result["time"][()])
    noon, folder = grids[NOON_INTERVAL], os.path.dirname(path)
    same(data_item(folder, noon.find("Topology/DataItem")), result["patch_vertices"][()])
    same(data_item(folder, noon.find("Geometry/DataItem")), result["vertex_position"][()])
    for attribute in noon.findall("Attribute"):
        same(data_item(folder, attribute.find("DataItem")), patch_values(result, attribute.get("Name")))


def glb_parts(path):
    """JSON and buffer of a binary glTF, every length of which is right (glTF 2.0, 4.4)."""
    with open(path, "rb") as file:
        data = file.read()
    magic, version, length, json_length, json_kind = struct.unpack_from("<4sIII4s", data)
    assert (magic, version, json_kind) == (b"glTF", 2, b"JSON") and length == len(data)
    buffer_length, buffer_kind = struct.unpack_from("<I4s", data, 20 + json_length)
    assert buffer_kind == b"BIN\0" and 28 + json_length + buffer_length == length
    assert json_length % 4 == 0 and buffer_length % 4 == 0
    return json.loads(data[20:20 + json_length]), data[28 + json_length:]


def accessor(tree, buffer, index):
    about = tree["accessors"][index]
    view = tree["bufferViews"][about["bufferView"]]
    kind = {5126: "<f4", 5123: "<u2"}[about["componentType"]]
    width = int(about["type"][-1])
    assert view["byteOffset"] % 4 == 0 and view["byteOffset"] + view["byteLength"] <= tree["buffers"][0]["byteLength"]
    assert about["count"] * width * np.dtype(kind).itemsize == view["byteLength"]
    numbers = np.frombuffer(buffer, kind, about["count"] * width, view["byteOffset"]).reshape(-1, width)
    if "min" in about:
        same(numbers.min(axis=0), np.float32(about["min"]))
        same(numbers.max(axis=0), np.float32(about["max"]))
    return numbers


def lightness(linear):
    """L* of linear sRGB: it grows evenly along the scales."""
    luminance = linear @ [0.2126, 0.7152, 0.0722]
    return np.where(luminance > (6 / 29) ** 3, 116 * np.cbrt(luminance) - 16, luminance * (29 / 3) ** 3)


def linear(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def expect_scale(linear_colours, values, largest, rounding=0.02):
    """The colours are those of the values: darkest for 0, lightest for the largest and above."""
    expected = 12 + 80 * np.clip(values / largest, 0, 1)
    off = np.abs(lightness(linear_colours) - expected).max()
    # Half of a step of the scale, and what the format rounds.
    assert off < 40 / 1023 + rounding, f"lightness is off by {off}"


def test_glb(exports, result):
    largest = 4
    path = exports.file("a.glb", "glb", "--max", str(largest))
    tree, buffer = glb_parts(path)
    assert [node["name"] for node in tree["nodes"]] == ["square", "house"]
    corners = result["vertex_position"][()][result["patch_vertices"][()]]
    for k, node in enumerate(tree["nodes"]):
        attributes = tree["meshes"][node["mesh"]]["primitives"][0]["attributes"]
        mine = result["patch_object"][()] == k
        expected = corners[mine].reshape(-1, 3)
        # y up.
        same(accessor(tree, buffer, attributes["POSITION"]),
             np.float32(np.stack([expected[:, 0], expected[:, 2], -expected[:, 1]], axis=1)))
        colours = accessor(tree, buffer, attributes["COLOR_0"])[:, :3] / 65535
        values = np.repeat(result["light_load"][()][mine], 3)
        expect_scale(colours, values, largest)
        refuses(expect_scale, colours, values, 1.01 * largest)


def test_light_map(exports, result):
    """The texture, where the corners say, has the colours of the vertices of the same model without it."""
    import matplotlib.image
    for words in ((), ("--interpolate",)):
        plain, plain_buffer = glb_parts(exports.file("plain.glb", "glb", *words))
        tree, buffer = glb_parts(exports.file("mapped.glb", "glb", "--lightmap", *words))
        view = tree["bufferViews"][tree["images"][0]["bufferView"]]
        texture = matplotlib.image.imread(io.BytesIO(buffer[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]))
        about = tree["asset"]["extras"]["light_map"]
        assert texture.shape[:2] == (about["height"], about["width"]) and about["block"] in (4, 8)
        assert tree["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] == {"index": 0}
        for mesh, without in zip(tree["meshes"], plain["meshes"]):
            here, there = mesh["primitives"][0]["attributes"], without["primitives"][0]["attributes"]
            assert set(here) == {"POSITION", "TEXCOORD_0"}
            same(accessor(tree, buffer, here["POSITION"]), accessor(plain, plain_buffer, there["POSITION"]))
            places = accessor(tree, buffer, here["TEXCOORD_0"])
            assert places.min() > 0 and places.max() < 1
            x, y = (places * [about["width"], about["height"]]).T.round().astype(int)
            # The four texels around a corner, filtered.
            found = np.mean([texture[y - j, x - i, :3] for i in (0, 1) for j in (0, 1)], axis=0)
            expected = accessor(plain, plain_buffer, there["COLOR_0"])[:, :3] / 65535
            off = np.abs(linear(found) - expected).max()
            assert off < (0.2 if words else 0.005), off
    said = exports.run("export", RESULT, "--to", "vrml", "--lightmap")
    assert said.returncode == WRONG_INPUT and "--to glb" in said.stderr, said.stderr


def test_assimp(exports, result):
    if not shutil.which("assimp"):
        skip("assimp-utils is not installed")
    patches = len(result["patch_area"])
    for words, textures in (((), 0), (("--lightmap",), 1)):
        path = exports.file("a.glb", "glb", *words)
        said = subprocess.run(["assimp", "info", path], stdout=subprocess.PIPE, encoding="utf-8")
        assert said.returncode == 0 and f"Faces:              {patches}\n" in said.stdout, said.stdout
        assert f"Textures (embed.):  {textures}\n" in said.stdout, said.stdout


def numbers_within(text, field, kind):
    """Numbers between the brackets that follow a field."""
    found = re.search(field + r"[^\[\]]*\[([^\]]*)\]", text)
    return np.array(found.group(1).replace(",", " ").split(), kind)


def test_vrml(exports, result):
    largest = 4
    with open(exports.file("a.wrl", "vrml", "--max", str(largest)), encoding="utf-8") as file:
        text = file.read()
    assert text.startswith("#VRML V2.0 utf8\n") and "colorPerVertex FALSE" in text
    faces = numbers_within(text, "coordIndex", int).reshape(-1, 4)
    same(faces[:, :3], result["patch_vertices"][()])
    same(faces[:, 3], np.full(len(faces), -1))
    colours = numbers_within(text, "color Color", float).reshape(-1, 3)
    chosen = colours[numbers_within(text, "colorIndex", int)]
    expect_scale(linear(chosen), result["light_load"][()], largest)
    with open(exports.file("smooth.wrl", "vrml", "--interpolate", "--colour", "grey"), encoding="utf-8") as file:
        smooth = file.read()
    assert "colorPerVertex TRUE" in smooth
    # A colour index for every corner, with the same ends of faces (ISO/IEC 14772-1, 6.23).
    indices = numbers_within(smooth, "colorIndex", int).reshape(-1, 4)
    same(indices[:, 3], faces[:, 3])
    # Continuous within a plane: a corner of the ground has one colour, whichever the patch.
    ground = result["patch_object"][()] == 0
    seen = {}
    for face, colour in zip(faces[ground, :3].ravel(), indices[ground, :3].ravel()):
        assert seen.setdefault(face, colour) == colour, face


def test_ply(exports, result):
    largest = 4
    with open(exports.file("a.ply", "ply", "--max", str(largest)), "rb") as file:
        head, _, data = file.read().partition(b"end_header\n")
    head = head.decode()
    vertices, faces = (int(n) for n in re.findall(r"element \w+ (\d+)", head))
    same(np.frombuffer(data, "<f8", 3 * vertices).reshape(-1, 3), result["vertex_position"][()])
    names = re.findall(r"property double (\w{2,})", head)
    record = np.dtype([("n", "u1"), ("corners", "<i4", 3), ("colour", "u1", 3), ("object", "<i4")] +
                      [(name, "<f8") for name in names])
    data = data[24 * vertices:]
    assert len(data) == faces * record.itemsize
    table = np.frombuffer(data, record)
    same(table["corners"], result["patch_vertices"][()])
    same(table["object"], result["patch_object"][()])
    for name in names:
        same(table[name], patch_values(result, name))
    # L* grows by at most 1.2 for a hundredth of an encoded channel; half of 1/255 is rounded.
    expect_scale(linear(table["colour"] / 255), result["light_load"][()], largest, 120 * 0.5 / 255)


def city_model():
    """A house of two parts: walls share one semantic surface, the roofs have none; a square before it."""
    vertices, objects = [], {}

    def box(low, high):
        base = len(vertices)
        vertices.extend([x, y, z] for z in (low[2], high[2])
                        for x, y in ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])))
        faces = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6, 7), (3, 2, 1, 0)]
        return [[[[base + k for k in face]] for face in faces]]

    for name, low, high in (("part_1", (0, 10000, 0), (8000, 16000, 7000)), ("part_2", (12000, 10000, 0), (18000, 15000, 4000))):
        objects[name] = {"type": "BuildingPart", "parents": ["house"], "geometry": [
            {"type": "Solid", "lod": "1.2", "boundaries": box(low, high)},
            {"type": "Solid", "lod": "2", "boundaries": box(low, high), "semantics": {
                "surfaces": [{"type": "WallSurface", "paint": "lime"}, {"type": "GroundSurface"}], "values": [[0, 0, 0, 0, None, 1]]}}]}
    objects["house"] = {"type": "Building", "children": ["part_1", "part_2"], "attributes": {"storeys": 2}}
    corners = [[-5000, 0, 0], [25000, 0, 0], [25000, 9000, 0], [-5000, 9000, 0]]
    objects["square"] = {"type": "LandUse", "geometry": [
        {"type": "MultiSurface", "lod": "2", "boundaries": [[[len(vertices) + k for k in range(4)]]]}]}
    vertices.extend(corners)
    return {"type": "CityJSON", "version": "2.0", "CityObjects": objects, "vertices": vertices,
            "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/7415"},
            "transform": {"scale": [0.001] * 3, "translate": [84980, 447460, 1]}}


CITY_STUDY = """format: sunload-study-1
name: city
site: {timezone: Europe/Amsterdam}
period: {days: [2026-06-21], from: "06:00", to: "20:00", step_min: 120}
light: {source: clear_sky}
scene: {files: [city.json], ground: none}
mesh: {max_edge_m: 3, oracle: none}
solver: {lines_per_patch: 64}
variants: [{name: fine}, {name: block, scene: {lod: "1.2"}}]
"""


def surfaces_of(city, name, place):
    """Corners and semantic surface (or None) of every surface of a geometry, seen plainly."""
    geometry = city["CityObjects"][name]["geometry"][place]
    scale, shift = city["transform"]["scale"], city["transform"]["translate"]
    semantics = geometry.get("semantics")
    for shell in range(len(geometry["boundaries"]) if geometry["type"] == "Solid" else 1):
        solid = geometry["type"] == "Solid"
        faces = geometry["boundaries"][shell] if solid else geometry["boundaries"]
        values = (semantics["values"][shell] if solid else semantics["values"]) if semantics else [None] * len(faces)
        assert len(values) == len(faces)
        for face, value in zip(faces, values):
            corners = np.array([city["vertices"][k] for k in face[0]]) * scale + shift
            yield corners, None if value is None else semantics["surfaces"][value]


def patches_on(result, name, corners):
    """Front patches of an object that lie in a rectangle or triangle, by its box."""
    centre = result["patch_centroid"][()] + result.attrs["origin"]
    low, high = corners.min(axis=0) - 0.005, corners.max(axis=0) + 0.005
    mine = result["patch_object"][()] == list(result["object_name"].asstr()).index(name)
    return np.flatnonzero(mine & (centre >= low).all(axis=1) & (centre <= high).all(axis=1) & (result["patch_side"][()] == 0))


def mean_and_error(result, patches):
    area = result["patch_area"][()][patches]
    of_realizations = result["light_load_realization"][:, patches] @ area / area.sum()
    return result["light_load"][()][patches] @ area / area.sum(), of_realizations.std(ddof=1) / len(of_realizations) ** 0.5


def expect_values(result, patches, values):
    mean, error = mean_and_error(result, patches)
    # Datasets may be floats.
    assert np.isclose(values["sunload_light_load_kwh_m2"], mean, 1e-6), (values, mean)
    assert np.isclose(values["sunload_light_load_se_kwh_m2"], error, 1e-4), (values, error)
    assert np.isclose(values["sunload_area_m2"], result["patch_area"][()][patches].sum())
    assert np.isclose(values["sunload_irradiance_max_w_m2"], result["irradiance_max"][()][patches].max())


def geometry_seen(exports, files):
    """What the program's own reader says of a scene."""
    with open(os.path.join(exports.folder, "again.yaml"), "w", encoding="utf-8") as file:
        file.write(CITY_STUDY.replace("city.json", files))
    ran = exports.run("check", "again.yaml", "--variant", "fine")
    assert ran.returncode == 0, ran.stderr
    return [line for line in ran.stdout.splitlines() if re.match(r"\s+(area|bounds|extent|floors)\b", line)]


def test_cityjson(exports):
    import h5py
    model = city_model()
    with open(os.path.join(exports.folder, "city.json"), "w", encoding="utf-8") as file:
        json.dump(model, file)
    with open(os.path.join(exports.folder, "city.yaml"), "w", encoding="utf-8") as file:
        file.write(CITY_STUDY)
    ran = exports.run("run", "city.yaml", "--progress", "none")
    assert ran.returncode == 0, ran.stderr
    for variant, place in (("fine", 1), ("block", 0)):
        path = f"results/city/{variant}.h5"
        ran = exports.run("export", path, "--to", "cityjson", "--model", "city.json", "-o", f"{variant}.json")
        assert ran.returncode == 0 and not ran.stderr, ran.stderr
        with open(os.path.join(exports.folder, f"{variant}.json"), encoding="utf-8") as file:
            city = json.load(file)
        with h5py.File(os.path.join(exports.folder, path), "r") as result:
            test_model(result, model, city, place)
    seen = geometry_seen(exports, "city.json")
    assert len(seen) >= 2, seen
    assert geometry_seen(exports, "fine.json") == seen
    path = "results/city/fine.h5"
    ran = exports.run("export", path, "--to", "cityjson", "-o", "patches.json")
    assert ran.returncode == 0, ran.stderr
    with h5py.File(os.path.join(exports.folder, path), "r") as result:
        with open(os.path.join(exports.folder, "patches.json"), encoding="utf-8") as file:
            test_patches(result, json.load(file))
    # Floors, which are no patches, are in triangles as they were, split where patches of walls end.
    assert geometry_seen(exports, "patches.json")[1:] == seen[1:] and seen[0].split()[0] == "floors", seen
    other = json.loads(json.dumps(model).replace("part_", "piece_").replace("square", "place"))
    with open(os.path.join(exports.folder, "other.json"), "w", encoding="utf-8") as file:
        json.dump(other, file)
    ran = exports.run("export", path, "--to", "cityjson", "--model", "other.json")
    assert ran.returncode == WRONG_INPUT and "their ids differ" in ran.stderr, ran.stderr


MOVED_STUDY = """format: sunload-study-1
name: moved
site: {crs: "EPSG:7415", timezone: Europe/Amsterdam}
period: {days: [2026-06-21], from: "10:00", to: "14:00", step_min: 120}
light: {source: clear_sky}
scene: {files: [neighbour.json], ground: none}
mesh: {max_edge_m: 8, oracle: none}
solver: {lines_per_patch: 64}
variants:
  - {name: turned, scene: {files: [neighbour.json, {file: parts/city.json, unit_m: 0.1, lod: "1.2", turn_deg: 30, position_m: [84000, 446000, 3]}]}}
  - {name: on_earth, scene: {files: [neighbour.json, {file: parts/city.json, unit_m: 0.1, lod: "1.2", position: 52d0'0"N 4d21'0"E}]}}
"""


def face_area(corners):
    return np.linalg.norm(sum(np.cross(corners[k] - corners[0], corners[k + 1] - corners[0]) for k in range(1, len(corners) - 1))) / 2


def test_moved_model(exports):
    """A file with a unit, a level of detail and a place of its own, beside another one, gets its model back."""
    unit = 0.1  # m in the file's unit
    model = city_model()
    del model["metadata"]
    model["transform"] = {"scale": [0.001 / unit] * 3, "translate": [0, 0, 0]}
    neighbour = json.loads(json.dumps(city_model()).replace("part_", "piece_").replace("square", "place").replace("house", "home"))
    os.makedirs(os.path.join(exports.folder, "parts"), exist_ok=True)
    for name, one in (("parts/city.json", model), ("neighbour.json", neighbour)):
        with open(os.path.join(exports.folder, name), "w", encoding="utf-8") as file:
            json.dump(one, file)
    with open(os.path.join(exports.folder, "moved.yaml"), "w", encoding="utf-8") as file:
        file.write(MOVED_STUDY)
    ran = exports.run("run", "moved.yaml", "--progress", "none")
    assert ran.returncode == 0, ran.stderr
    # The result tells how the file was read even when the folder of the study is gone.
    os.rename(os.path.join(exports.folder, "parts"), os.path.join(exports.folder, "elsewhere"))
    for variant in ("turned", "on_earth"):
        for name, parts in (("elsewhere/city.json", ("part_1", "part_2")), ("neighbour.json", ("piece_1", "piece_2"))):
            ran = exports.run("export", f"results/moved/{variant}.h5", "--to", "cityjson", "--model", name)
            assert ran.returncode == 0 and not ran.stderr, ran.stderr
            city = json.loads(ran.stdout)
            read, metres = (0, unit) if "part_1" in parts else (1, 1)
            for part in parts:
                valued = [(corners, semantic) for corners, semantic in surfaces_of(city, part, read)
                          if semantic and "sunload_area_m2" in semantic]
                assert len(valued) == 5, f"{variant} {name}: {len(valued)} surfaces of {part} have values"
                for corners, semantic in valued:
                    assert np.isclose(semantic["sunload_area_m2"], face_area(corners) * metres ** 2, 1e-6)
                assert "semantics" not in city["CityObjects"][part]["geometry"][0] or read == 0


def test_model(result, model, city, place):
    """The user's model is as it was, but for what was added."""
    for key in ("type", "version", "vertices", "transform", "metadata"):
        assert city[key] == model[key], key
    for name, object_ in model["CityObjects"].items():
        mine = city["CityObjects"][name]
        assert mine["type"] == object_["type"] and mine.get("parents") == object_.get("parents")
        for k, geometry in enumerate(object_.get("geometry", [])):
            assert mine["geometry"][k]["boundaries"] == geometry["boundaries"]
            if k != place and name != "square":
                assert mine["geometry"][k] == geometry, "a level that was not read has values"
    assert city["CityObjects"]["house"]["attributes"]["storeys"] == 2
    names = list(result["object_name"].asstr())
    for object_ in ("part_1", "part_2"):
        own = np.flatnonzero(result["patch_object"][()] == names.index(object_))
        expect_values(result, own, city["CityObjects"][object_]["attributes"])
        kinds = []
        for corners, semantic in surfaces_of(city, object_, place):
            patches = patches_on(result, object_, corners)
            if len(patches) == 0:
                assert semantic is None or "sunload_area_m2" not in semantic
                continue
            expect_values(result, patches, semantic)
            refuses(expect_values, result, own, semantic)
            kinds.append(semantic["type"])
            if semantic["type"] == "WallSurface" and place == 1:
                assert semantic["paint"] == "lime"
        assert sorted(kinds) == ["RoofSurface"] + 4 * ["WallSurface"], kinds
    both = np.flatnonzero(np.isin(result["patch_object"][()], [names.index("part_1"), names.index("part_2")]))
    expect_values(result, both, city["CityObjects"]["house"]["attributes"])
    # Land use bears no semantic surfaces.
    assert "semantics" not in city["CityObjects"]["square"]["geometry"][0]
    assert "sunload_light_load_kwh_m2" in city["CityObjects"]["square"]["attributes"]


def test_patches(result, city):
    assert (city["type"], city["version"]) == ("CityJSON", "2.0")
    assert city["metadata"]["referenceSystem"].endswith("/EPSG/0/7415")
    types = {name: one["type"] for name, one in city["CityObjects"].items()}
    assert types == {"part_1": "Building", "part_2": "Building", "square": "TransportSquare"}, types
    assert all(isinstance(x, int) for vertex in city["vertices"] for x in vertex)
    load, count = result["light_load"][()], 0
    for name in types:
        own = patches_on(result, name, np.array([[-1e9] * 3, [1e9] * 3]))
        surfaces = [(corners, semantic) for corners, semantic in surfaces_of(city, name, 0) if "sunload_area_m2" in semantic]
        assert len(surfaces) == len(own)
        for patch, (corners, semantic) in zip(own, surfaces):
            assert np.allclose(corners.mean(axis=0), result["patch_centroid"][patch] + result.attrs["origin"], atol=1e-4)
            assert np.isclose(semantic["sunload_light_load_kwh_m2"], load[patch], 1e-6)
            count += 1
    assert count == len(load)


def test_geopackage(exports):
    """Read as what it is: a database of SQLite with geometries of WKB behind a head."""
    import h5py
    path = os.path.join(exports.folder, "a.gpkg")
    ran = exports.run("export", "results/city/fine.h5", "--to", "gpkg", "-o", path)
    assert ran.returncode == 0, ran.stderr
    data = sqlite3.connect(path)
    assert data.execute("SELECT organization_coordsys_id FROM gpkg_geometry_columns JOIN gpkg_spatial_ref_sys USING (srs_id)").fetchall() == [(7415,)] * 3
    rows = data.execute("SELECT object, sunload_light_load_kwh_m2, geom FROM patches ORDER BY fid").fetchall()
    with h5py.File(os.path.join(exports.folder, "results/city/fine.h5"), "r") as result:
        names = list(result["object_name"].asstr())
        assert [row[0] for row in rows] == [names[k] for k in result["patch_object"]]
        assert np.allclose([row[1] for row in rows], result["light_load"][()])
        corners = result["vertex_position"][()][result["patch_vertices"][()]] + result.attrs["origin"]
        for row, expected in zip(rows, corners):
            blob = row[2]
            envelope = {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}[(blob[3] >> 1) & 7]
            kind, rings, points = struct.unpack_from("<III", blob, 8 + envelope + 1)
            assert blob[:2] == b"GP" and (kind, rings, points) == (1003, 1, 4), (kind, rings, points)
            assert np.allclose(np.frombuffer(blob, "<f8", 9, 8 + envelope + 13).reshape(3, 3), expected, atol=1e-9)
        objects = dict(data.execute("SELECT object, sunload_light_load_kwh_m2 FROM objects").fetchall())
        assert set(objects) == set(names)
        for k, name in enumerate(names):
            own = np.flatnonzero((result["patch_object"][()] == k) & (result["patch_side"][()] == 0))
            assert np.isclose(objects[name], mean_and_error(result, own)[0], 1e-6)
        facades = data.execute("SELECT facade, sunload_light_load_kwh_m2, sunload_light_load_se_kwh_m2, sunload_azimuth_deg, "
                               "sunload_energy_kwh FROM facades ORDER BY fid").fetchall()
        assert [row[0] for row in facades] == list(result["facade_name"].asstr())
        area = np.bincount(result["patch_facade"][()][result["patch_facade"][()] >= 0],
                           result["patch_area"][()][result["patch_facade"][()] >= 0])
        expected = np.transpose([result["facade_light_load"][()], result["facade_light_load_se"][()],
                                 result["facade_azimuth"][()], result["facade_light_load"][()] * area])
        assert np.allclose([row[1:] for row in facades], expected, 1e-9)
    styles = dict(data.execute("SELECT f_table_name, styleQML FROM layer_styles WHERE f_table_schema = '' AND "
                               "f_geometry_column = 'geom' AND useAsDefault").fetchall())
    assert set(styles) == {"patches", "objects", "facades"}, set(styles)
    for layer, qml in styles.items():
        renderer = xml.fromstring(qml.split("'SYSTEM'>")[1]).find("renderer-v2")
        ranges = renderer.findall("ranges/range")
        assert renderer.get("type") == "graduatedSymbol" and len(ranges) == len(renderer.findall("symbols/symbol")) == 10
        data.execute(f"SELECT {renderer.get('attr')} FROM {layer}").fetchone()
        assert [one.get("lower") for one in ranges[1:]] == [one.get("upper") for one in ranges[:-1]]
    data.close()
    ran = exports.run("export", "results/city/fine.h5", "--to", "gpkg", "-o", os.path.join(exports.folder, "b.gpkg"),
                      "--facade", facades[0][0])
    assert ran.returncode == 0, ran.stderr
    data = sqlite3.connect(os.path.join(exports.folder, "b.gpkg"))
    assert data.execute("SELECT count(*) FROM facades").fetchone() == (1,)
    assert data.execute("SELECT DISTINCT facade FROM patches").fetchall() == [(facades[0][0],)]
    data.close()


def test_energyplus(exports):
    ran = exports.run("export", RESULT, "--to", "energyplus")
    assert ran.returncode == WRONG_INPUT and "365" in ran.stderr and not ran.stdout, ran.stderr
    for word in ("--object", "--selection", "--sensor"):
        ran = exports.run("export", RESULT, "--to", "energyplus", word, "0")
        assert ran.returncode == WRONG_INPUT and "write --facade" in ran.stderr and not ran.stdout, ran.stderr


YEAR = """period: {start: 2025-01-01T00:00, end: 2026-01-01T00:00, step_min: 60}
mesh: {max_edge_m: 8, oracle: none}
solver: {lines_per_patch: 8, direct_samples: 8, realizations: 2, bounces: 1}
output: {series: [direct], significant_bits: 23}
"""


def test_sunlit_fractions(exports):
    """Of every facade and roof plane and hour of a year: direct light by what nothing in its way would leave."""
    write_study(exports.folder, 8, 4)
    path = os.path.join(exports.folder, "square.yaml")
    with open(path, encoding="utf-8") as file:
        kept = [line for line in file if not line.startswith(("period", "mesh", "solver", "site"))]
    text = "".join(kept).replace("name: square", "name: shaded")
    site = "site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: \"+01:00\"}\n"
    with open(path, "w", encoding="utf-8") as file:
        file.write(text + site + YEAR)
    ran = exports.run("run", "square.yaml", "--progress", "none")
    assert ran.returncode == 0, ran.stderr
    ran = exports.run("export", "results/shaded/baseline.h5", "--to", "energyplus")
    assert ran.returncode == 0, ran.stderr
    head, *rows = list(csv.reader(io.StringIO(ran.stdout)))
    assert head[0] == "Surface Name" and "house/roof_1" in head and "house/south_1" in head, head
    assert len(rows) == 8760 and rows[0][0] == "01/01 01:00" and rows[-1][0] == "12/31 24:00", (rows[0], rows[-1])
    with h5py.File(os.path.join(exports.folder, "results/shaded/baseline.h5")) as result:
        area, normal, kind, facade = (result[name][()] for name in ("patch_area", "patch_normal", "patch_surface", "patch_facade"))
        names, direct = list(result["facade_name"].asstr()), result["irradiance_direct"][()]
        dni, sun = result["dni"][()], result["sun_direction"][()]
    for name, chosen in (("house/roof_1", kind == 2), ("house/south_1", facade == names.index("house/south_1"))):
        free = dni[:, None] * np.maximum(0, sun @ normal[chosen].T) @ area[chosen]
        wanted = np.where(free > 0, np.minimum(1, direct[:, chosen] @ area[chosen] / np.maximum(free, 1e-300)), 0)
        found = np.array([float(row[head.index(name)]) for row in rows])
        assert np.allclose(found, wanted, atol=2e-6), (name, np.abs(found - wanted).max())
        assert found.max() > 0.99 and (free > 0).sum() > 1000, name


def refuses(check, *arguments):
    """The check must fail: it would see a fault."""
    try:
        check(*arguments)
    except AssertionError:
        return
    raise AssertionError(f"{check.__name__} sees nothing")


def test_refusals(exports):
    for words, hint in ((("--to", "obj"), "write one of"), (("--to", "glb"), "add -o"),
                        (("--to", "csv", "--quantity", "light"), "choose one of"),
                        (("--to", "vrml", "--crease-angle", "10"), "add --interpolate"),
                        (("--to", "vrml", "--max", "-1"), "see sunload export --help"), ((), "--help")):
        ran = exports.run("export", RESULT, *words)
        assert ran.returncode == WRONG_INPUT and hint in ran.stderr and not ran.stdout, (words, ran)


def main():
    try:
        import h5py as of_hdf5
        import numpy
    except ImportError:
        skip("python3-h5py is not installed")
    global h5py, np
    h5py, np = of_hdf5, numpy
    with tempfile.TemporaryDirectory(prefix="sunload-export-") as folder:
        write_study(folder, 2, 4)
        exports = Exports(os.path.abspath(sys.argv[1]), folder)
        ran = exports.run("run", "square.yaml", "--progress", "none")
        assert ran.returncode == 0, ran.stderr
        with h5py.File(os.path.join(folder, RESULT), "r") as result:
            of_program = {"vtk": [test_vtk], "assimp": [test_assimp]}
            tests = of_program[sys.argv[2]] if len(sys.argv) > 2 else [test_csv, test_xdmf, test_glb, test_light_map, test_vrml, test_ply]
            for test in tests:
                test(exports, result)
                print(test.__name__, "passed")
        if len(sys.argv) > 2:
            return
        test_cityjson(exports)
        test_moved_model(exports)
        print("test_cityjson passed")
        test_geopackage(exports)
        print("test_geopackage passed")
        test_energyplus(exports)
        test_refusals(exports)
        test_sunlit_fractions(exports)
        left = [name for name in os.listdir(folder) if ".part-" in name]
        assert not left, left


if __name__ == "__main__":
    main()
