#!/usr/bin/env python3
"""Exports of a small study, read by the programs that they are for: the numbers are those of the result.

export_test.py SUNLOAD
"""

import csv
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

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
        print("NOT RUN: end_to_end/export vtk: python3-vtk9 is not installed")
        return
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
    if shutil.which("assimp"):
        said = subprocess.run(["assimp", "info", path], stdout=subprocess.PIPE, encoding="utf-8")
        assert said.returncode == 0 and f"Faces:              {len(corners)}\n" in said.stdout, said.stdout
    else:
        print("NOT RUN: end_to_end/export assimp: assimp-utils is not installed")


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


def test_energyplus(exports):
    ran = exports.run("export", RESULT, "--to", "energyplus")
    assert ran.returncode == WRONG_INPUT and "365" in ran.stderr and not ran.stdout, ran.stderr


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
        import h5py
        import numpy
    except ImportError:
        print("NOT RUN: end_to_end/export: python3-h5py is not installed")
        return
    global np
    np = numpy
    with tempfile.TemporaryDirectory(prefix="sunload-export-") as folder:
        write_study(folder, 2, 4)
        exports = Exports(os.path.abspath(sys.argv[1]), folder)
        ran = exports.run("run", "square.yaml", "--progress", "none")
        assert ran.returncode == 0, ran.stderr
        with h5py.File(os.path.join(folder, RESULT), "r") as result:
            for test in (test_csv, test_vtk, test_xdmf, test_glb, test_vrml, test_ply):
                test(exports, result)
                print(test.__name__, "passed")
        test_energyplus(exports)
        test_refusals(exports)
        left = [name for name in os.listdir(folder) if ".part-" in name]
        assert not left, left


if __name__ == "__main__":
    main()
