# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writers of scene files. A model is a list of (name of an object, [(material, kind, corners)])."""

import json
import struct


def in_file(point, up, unit_m):
    """A point of the scene (metres, z up) as a file with that axis up and that unit has it."""
    x, y, z = (c / unit_m for c in point)
    return {"z": (x, y, z), "y": (x, z, -y), "x": (z, x, y)}[up]


def indexed(model, up, unit_m):
    """Corners without repetition, and faces as (object, material, indices)."""
    points, place, faces = [], {}, []
    for name, parts in model:
        for material, _, corners in parts:
            indices = []
            for corner in corners:
                point = in_file(corner, up, unit_m)
                if point not in place:
                    place[point] = len(points)
                    points.append(point)
                indices.append(place[point])
            faces.append((name, material, indices))
    return points, faces


def write_obj(path, model, up="z", unit_m=1):
    points, faces = indexed(model, up, unit_m)
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points]
    last = (None, None)
    for name, material, indices in faces:
        if name != last[0]:
            lines.append(f"o {name}")
        if (name, material) != last:
            lines.append(f"usemtl {material}")
        last = (name, material)
        lines.append("f " + " ".join(str(i + 1) for i in indices))
    write(path, "\n".join(lines) + "\n")


def write_ply(path, model, up="z", unit_m=1):
    points, faces = indexed(model, up, unit_m)
    lines = ["ply", "format ascii 1.0", f"element vertex {len(points)}",
             *(f"property double {axis}" for axis in "xyz"), f"element face {len(faces)}",
             "property list uchar int vertex_indices", "end_header"]
    lines += [f"{x!r} {y!r} {z!r}" for x, y, z in points]
    lines += [" ".join(map(str, [len(indices), *indices])) for _, _, indices in faces]
    write(path, "\n".join(lines) + "\n")


def write_off(path, model, up="z", unit_m=1):
    points, faces = indexed(model, up, unit_m)
    lines = ["OFF", f"{len(points)} {len(faces)} 0", *(f"{x!r} {y!r} {z!r}" for x, y, z in points)]
    lines += [" ".join(map(str, [len(indices), *indices])) for _, _, indices in faces]
    write(path, "\n".join(lines) + "\n")


def write_stl(path, model, up="z", unit_m=1):
    """Binary, in fans of triangles; its floats move large coordinates."""
    points, faces = indexed(model, up, unit_m)
    fans = [(f[0], f[k], f[k + 1]) for _, _, f in faces for k in range(1, len(f) - 1)]
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *(c for i in fan for c in points[i]), 0) for fan in fans)
    with open(path, "wb") as file:
        file.write(b"a soak".ljust(80) + struct.pack("<I", len(fans)) + body)


def write_vrml(path, model, up="y", unit_m=1, colours=None):
    """`colours`: material -> (diffuse, specular, emissive) grey strengths."""
    text = "#VRML V2.0 utf8\n"
    for name, parts in model:
        for material in sorted({part[0] for part in parts}):
            points, faces = indexed([(name, [p for p in parts if p[0] == material])], up, unit_m)
            diffuse, specular, emissive = (colours or {}).get(material, (0.3, 0, 0))
            text += (f"DEF {name} Shape {{ appearance Appearance {{ material DEF {material} Material {{ "
                     f"diffuseColor {diffuse} {diffuse} {diffuse} specularColor {specular} {specular} {specular} "
                     f"emissiveColor {emissive} {emissive} {emissive} }} }}\n geometry IndexedFaceSet {{ coord Coordinate {{ "
                     f"point [ {', '.join(f'{x!r} {y!r} {z!r}' for x, y, z in points)} ] }}\n coordIndex [ "
                     f"{', '.join(' '.join(map(str, f)) + ' -1' for _, _, f in faces)} ] }} }}\n")
    write(path, text)


SURFACES = {"wall": "WallSurface", "roof": "RoofSurface", "floor": "GroundSurface"}


def write_cityjson(path, model, crs=None, solids=True):
    """Objects as buildings (plants where their material is a crown), corners in millimetres."""
    points = [c for _, parts in model for _, _, corners in parts for c in corners]
    origin = [float(round(min(p[axis] for p in points))) for axis in range(3)]
    vertices, place, objects = [], {}, {}

    def index(point):
        at = tuple(round(1000 * (c - o)) for c, o in zip(point, origin))
        if at not in place:
            place[at] = len(vertices)
            vertices.append(at)
        return place[at]

    for name, parts in model:
        rings = [[[index(c) for c in corners]] for _, _, corners in parts]
        plant = any(material == "crown" for material, _, _ in parts)
        geometry = {"type": "Solid" if solids else "MultiSurface", "lod": "2",
                    "boundaries": [rings] if solids else rings}
        kinds = [kind for kind in SURFACES if any(kind == part[1] for part in parts)]
        if kinds and not plant:
            values = [kinds.index(kind) if kind in kinds else None for _, kind, _ in parts]
            geometry["semantics"] = {"surfaces": [{"type": SURFACES[kind]} for kind in kinds],
                                     "values": [values] if solids else values}
        objects[name] = {"type": "SolitaryVegetationObject" if plant else "Building", "geometry": [geometry]}
    city = {"type": "CityJSON", "version": "2.0",
            "transform": {"scale": [0.001] * 3, "translate": origin}, "CityObjects": objects, "vertices": vertices}
    if crs:
        city["metadata"] = {"referenceSystem": f"https://www.opengis.net/def/crs/EPSG/0/{crs.split(':')[1]}"}
    write(path, json.dumps(city))


def write_raster(path, rows, cell, west=0.0, south=0.0):
    """ESRI ASCII grid; rows of heights from north to south, None where there is none."""
    head = (f"ncols {len(rows[0])}\nnrows {len(rows)}\nxllcorner {west}\nyllcorner {south}\n"
            f"cellsize {cell}\nNODATA_value -9999\n")
    write(path, head + "".join(" ".join("-9999" if h is None else f"{h:.3f}" for h in row) + "\n" for row in rows))


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
