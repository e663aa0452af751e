# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`solve`: a mesh, suns and skies as arrays in, irradiance out, without files."""

from __future__ import annotations

import collections.abc
import warnings
from typing import Any, Dict, Mapping, Optional, Union

import numpy as np
import xarray

from . import native
from .checks import Problems, all_finite, known_keys, number, numbers, shaped, whole, within, word
from .materials import Materials, materials_of

try:
    from numpy.typing import ArrayLike
except ImportError:  # NumPy before 1.20
    ArrayLike = Any  # type: ignore[assignment, misc]

Table = Union[ArrayLike, Mapping[str, Any]]

SKY_MODELS = ("perez", "uniform", "cie_overcast", "cie_clear", "cie_general", "preetham")
#: Radiances per sky: patches of Tregenza, of Reinhart (2 x 2, 4 x 4), cells of the solver's own grid.
SKY_PATCHES = (145, 577, 2305, 4096)
#: Rays are floats, which resolve 6 cm there (geo/mesh/mesh_prepare.h).
LARGEST_EXTENT_M = 1e6


def solve(vertices: ArrayLike, triangles: ArrayLike, materials: Materials, suns: Table, skies: Table = 0.0, *,
          triangle_material: Optional[ArrayLike] = None, hours: ArrayLike = 1.0, far_ground_albedo: float = 0.2,
          max_edge_m: Optional[float] = None, lines: int = 256, samples: int = 16, realizations: int = 8,
          bounces: int = 5, seed: int = 1, threads: Optional[int] = None,
          standard_error: str = "totals") -> xarray.Dataset:
    """Irradiance of every patch of a mesh under each sun and its sky, W m-2.

    vertices: [V, 3] metres, x east, y north, z up. triangles: [T, 3] indices into them, counter-clockwise seen from the
    front, which receives and sends on; backs absorb. Nothing is repaired, turned or left out.

    materials: one diffuse reflectance, or an array [T] of them; or a dict, or a list of dicts, with the keys that
    materials of a study have (diffuse, mirror, glossy, transmittance, refractive_index, …, sides, emission_w_m2; also
    name). triangle_material: [T] indices into that list; it may be left out for one dict, or for T of them.

    suns: rows of azimuth_deg (clockwise from north), elevation_deg, DNI [W m-2], or of x, y, z (to the sun, of length 1)
    and DNI; or named columns (a dict, a DataFrame, what `sunload sun` lists): azimuth_deg, elevation_deg or direction,
    and dni_w_m2. Suns at or below the horizon bring no direct light. skies: diffuse horizontal irradiance [W m-2], one
    or one per sun, by the sky of Perez; or a dict of dhi_w_m2 with sky (perez, uniform, cie_overcast, cie_clear,
    cie_general with sky_type, preetham with turbidity); or radiances [suns, n] in W m-2 sr-1 of the n = 145, 577 or 2305
    patches of Tregenza or Reinhart (clockwise from north, from the horizon up, as `sunload sky --subdivision` lists them) or
    4096 cells. hours: that each sun stands for, in light_load.

    max_edge_m: longer edges are halved; None: each triangle is one patch. lines, samples, realizations, bounces, seed,
    far_ground_albedo: as of a study. threads: None: the processors that this process may use.
    standard_error: "totals" (of light_load and its parts), or "instants": of irradiance, too, which takes longer.

    Returns a dataset with the names of result files (docs/result-file.md), `time` being `sun`: irradiance[sun, patch] and
    its parts, light_load[patch] and its parts with standard errors, patch_area, patch_centroid, patch_normal,
    patch_input_triangle, …. The same bits for any number of threads, and those of a study of the same mesh
    (docs/python.md). Ctrl-C stops it. Other threads of Python run meanwhile; calls from several wait for each other.

    Raises ValueError with every problem of the input, a line each; MachineError where the module that computes is not
    part of this installation."""
    problems = Problems()
    scene = _scene(problems, vertices, triangles)
    count = None if scene["triangles"] is None else len(scene["triangles"])
    scene["materials"], scene["triangle_material"] = materials_of(problems, materials, triangle_material, count)
    light = _light(problems, suns, skies, hours)
    light["far_ground_albedo"] = number(problems, "far_ground_albedo", far_ground_albedo, 0, 1)
    rules = _rules(problems, max_edge_m=max_edge_m, bounces=bounces, realizations=realizations, lines=lines,
                   samples=samples, seed=seed, threads=threads, standard_error=standard_error)
    problems.raise_if_any()
    _warn_of_low_suns(light)
    module = native.module()
    return _dataset(module.solve(scene, light, rules), scene, light, rules, module.version)


def _warn_of_low_suns(light: Mapping[str, Any]) -> None:
    low = (light["elevation_deg"] <= 0) & (light["dni"] > 0)
    if low.any():
        warnings.warn(f"suns: {int(low.sum())} with dni_w_m2 above 0 not above the horizon, the first at "
                      f"[{int(np.flatnonzero(low)[0])}] (they light nothing); elevation_deg is above the horizon, z points "
                      "up", stacklevel=3)


def _rules(problems: Problems, *, max_edge_m: Any, bounces: Any, realizations: Any, lines: Any, samples: Any, seed: Any,
           threads: Any, standard_error: Any) -> Dict[str, Any]:
    before = len(problems)
    rules = {"max_edge_m": 1e9 if max_edge_m is None else number(problems, "max_edge_m", max_edge_m, 1e-6, 1e9),
             "bounces": whole(problems, "bounces", bounces, 0, 1000),
             "realizations": whole(problems, "realizations", realizations, 2, 1024),
             "lines": whole(problems, "lines", lines, 1, 1_000_000),
             "samples": whole(problems, "samples", samples, 1, 1_000_000),
             "seed": whole(problems, "seed", seed, 0, 2**63 - 1),
             "threads": 0 if threads is None else whole(problems, "threads", threads, 1, 65536),
             "standard_error": word(problems, "standard_error", standard_error, ("totals", "instants"))}
    for name in ("lines", "samples"):
        if len(problems) == before and rules[name] % rules["realizations"]:
            problems.add(f"{name} = {rules[name]}", f"cannot be shared by {rules['realizations']} realizations",
                         "each gets the same number: write a multiple")
    return rules


def _scene(problems: Problems, vertices: ArrayLike, triangles: ArrayLike) -> Dict[str, Any]:
    points = shaped(problems, "vertices", vertices, [(None, 3)])
    are_finite = points is not None and all_finite(problems, "vertices", points)
    corners = numbers(problems, "triangles", triangles, [(None, 3)])
    scene = {"vertices": points, "triangles": corners}
    if corners is None:
        return scene
    if not len(corners):
        problems.add("triangles: there are none", "there is nothing to light")
    elif (corners != np.floor(corners)).any():
        problems.add("triangles: indices that are not whole numbers", "they count the rows of vertices from 0")
    elif points is not None and _expect_corners(problems, corners, len(points)):
        scene["triangles"] = corners.astype(np.int32)
        if are_finite:
            _expect_shape(problems, points[scene["triangles"]])
    return scene


def _expect_corners(problems: Problems, corners: np.ndarray, count: int) -> bool:
    outside = (corners < 0) | (corners >= count)
    if outside.any():
        row, corner = np.argwhere(outside)[0]
        problems.add(f"triangles: {int(outside.sum())} of the indices outside of 0 … {count - 1}, the first "
                     f"{corners[row, corner]:.0f} at [{row}, {corner}]", "they count the rows of vertices from 0",
                     "subtract 1 where they count from 1")
    return not outside.any()


def _expect_shape(problems: Problems, corners: np.ndarray) -> None:
    """Triangles with area, of a city and not of a country; `corners`: [T, 3, xyz]."""
    extent = float((corners.max(axis=(0, 1)) - corners.min(axis=(0, 1))).max())
    if extent > LARGEST_EXTENT_M:
        problems.add(f"vertices: the mesh is {extent:g} m wide", f"at most {LARGEST_EXTENT_M:g} m are supported",
                     "are they metres, or is one vertex far away?")
    edges = np.roll(corners, -1, axis=1) - corners
    longest = np.sum(edges**2, axis=2).max(axis=1)
    flat = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) <= 1e-12 * longest
    if flat.any():
        problems.add(f"triangles: {int(flat.sum())} without area, the first is number {np.flatnonzero(flat)[0]}",
                     "irradiance is light per area", "leave them out")


def _light(problems: Problems, suns: Table, skies: Table, hours: ArrayLike) -> Dict[str, Any]:
    light = _suns(problems, suns)
    count = None if light["dni"] is None else len(light["dni"])
    light.update(_skies(problems, skies, count))
    length = numbers(problems, "hours", hours, [(), (count,)])
    within(problems, "hours", length, 0, 8784, "hours are those that a sun stands for", above=True)
    light["hours"] = _each(length, count)
    return light


def _each(values: Optional[np.ndarray], count: Optional[int]) -> Optional[np.ndarray]:
    """One for each of `count`."""
    return None if values is None or count is None else np.broadcast_to(values, (count,)).copy()


def _has_columns(table: Any) -> bool:
    """A dict, a DataFrame, a Dataset."""
    return isinstance(table, collections.abc.Mapping) or hasattr(table, "columns")


def _dimensions(value: Any) -> int:
    try:
        return np.ndim(value)
    except ValueError:  # rows of different lengths
        return -1


def _suns(problems: Problems, suns: Table) -> Dict[str, Any]:
    light: Dict[str, Any] = {"azimuth_deg": None, "elevation_deg": None, "direction": None, "dni": None}
    columns = _sun_columns(problems, suns)
    if columns is None:
        return light
    dni, count = columns["dni_w_m2"], len(columns["dni_w_m2"])
    within(problems, "suns: dni_w_m2", dni, 0, 2000, "W/m2 on a plane that faces the sun")
    light["dni"] = dni
    if not count:
        problems.add("suns: there are none", "", "without direct light a sun of DNI 0 stands for each sky")
    if "direction" in columns:
        length = np.linalg.norm(columns["direction"], axis=1, keepdims=True)
        off = np.abs(length[:, 0] - 1) > 1e-6
        if off.any():
            first = np.flatnonzero(off)[0]
            problems.add(f"suns: {int(off.sum())} directions not of length 1, the first {length[first, 0]:g} at [{first}]",
                         "x east, y north, z up, to the sun", "divide them by their length")
            return light
        light["direction"] = columns["direction"] / length
        x, y, z = light["direction"].T
        light["azimuth_deg"] = np.degrees(np.arctan2(x, y)) % 360
        light["elevation_deg"] = np.degrees(np.arctan2(z, np.hypot(x, y)))
        return light
    within(problems, "suns: azimuth_deg", columns["azimuth_deg"], -360, 360, "degrees clockwise from north")
    within(problems, "suns: elevation_deg", columns["elevation_deg"], -90, 90, "did azimuth and elevation change places?")
    light.update({key: columns[key] for key in ("azimuth_deg", "elevation_deg")})
    return light


def _sun_columns(problems: Problems, suns: Table) -> Optional[Dict[str, np.ndarray]]:
    """dni_w_m2 and azimuth_deg, elevation_deg or direction, of one length; None where they are not."""
    if not _has_columns(suns):
        rows = numbers(problems, "suns", np.atleast_2d(suns) if _dimensions(suns) == 1 else suns, [(None, 3), (None, 4)])
        if rows is None:
            return None
        if rows.shape[1] == 4:
            return {"direction": rows[:, :3], "dni_w_m2": rows[:, 3]}
        return {"azimuth_deg": rows[:, 0], "elevation_deg": rows[:, 1], "dni_w_m2": rows[:, 2]}
    keys = list(suns.keys())
    known_keys(problems, "suns", keys, ("azimuth_deg", "elevation_deg", "direction", "dni_w_m2", "dhi_w_m2", "ghi_w_m2",
                                        "time"))
    wanted = (["direction"] if "direction" in keys else ["azimuth_deg", "elevation_deg"]) + ["dni_w_m2"]
    missing = [key for key in wanted if key not in keys]
    if missing:
        problems.add(f"suns: no {', '.join(missing)}",
                     "a sun has azimuth_deg and elevation_deg, or direction, and dni_w_m2")
        return None
    count = np.size(suns["dni_w_m2"])
    shapes = {"direction": [(count, 3)]}
    columns = {key: numbers(problems, f"suns: {key}", np.atleast_1d(suns[key]), shapes.get(key, [(count,)]))
               for key in wanted}
    return None if any(column is None for column in columns.values()) else columns


def _skies(problems: Problems, skies: Table, count: Optional[int]) -> Dict[str, Any]:
    sky: Dict[str, Any] = {"sky": "perez", "sky_type": 12, "turbidity": 3.0, "extraterrestrial_w_m2": 1361.0,
                           "dhi": None, "radiance": None}
    dhi: Any = skies
    if _has_columns(skies):
        keys = list(skies.keys())
        known_keys(problems, "skies", keys, ("dhi_w_m2", "sky", "sky_type", "turbidity", "extraterrestrial_w_m2",
                                             "azimuth_deg", "elevation_deg", "dni_w_m2", "ghi_w_m2", "time"))
        if "dhi_w_m2" not in keys:
            problems.add("skies: no dhi_w_m2", "a sky's model has the diffuse horizontal irradiance that it meets")
            return sky
        dhi = skies["dhi_w_m2"]
        if "sky" in keys:
            sky["sky"] = word(problems, "skies: sky", skies["sky"], SKY_MODELS)
        if "sky_type" in keys:
            sky["sky_type"] = whole(problems, "skies: sky_type", skies["sky_type"], 1, 15)
        for key, low, high in (("turbidity", 2, 10), ("extraterrestrial_w_m2", 1000, 2000)):
            if key in keys:
                sky[key] = number(problems, f"skies: {key}", skies[key], low, high)
    elif _dimensions(skies) == 2:
        sky["radiance"] = numbers(problems, "skies", skies, [(count, patches) for patches in SKY_PATCHES])
        within(problems, "skies", sky["radiance"], 0, 1e6, "radiances are W m-2 sr-1")
        dhi = 0.0
    values = numbers(problems, "skies: dhi_w_m2", dhi, [(), (count,)])
    within(problems, "skies: dhi_w_m2", values, 0, 2000, "W/m2 on a horizontal plane")
    sky["dhi"] = _each(values, count)
    return sky


_UNITS = {"irradiance": "W m-2", "light_load": "kWh m-2", "sun_hours": "h", "patch_area": "m2", "patch_centroid": "m",
          "vertex_position": "m", "patch_normal": "1"}
_DIMS = {"irradiance": ("sun", "patch"), "vertex_position": ("vertex", "xyz"), "patch_vertices": ("patch", "corner"),
         "patch_centroid": ("patch", "xyz"), "patch_normal": ("patch", "xyz")}


def _dataset(arrays: Mapping[str, np.ndarray], scene: Mapping[str, Any], light: Mapping[str, Any],
             rules: Mapping[str, Any], version: str) -> xarray.Dataset:
    def of(name: str, table: Mapping[str, Any], otherwise: Any) -> Any:
        kind = next((key for key in ("irradiance", "light_load") if name.startswith(key)), name)
        return table.get(kind, otherwise)

    told = {name: value for name, value in arrays.items() if not isinstance(value, np.ndarray)}
    variables = {name: (of(name, _DIMS, ("patch",)), values,
                        {"units": of(name, _UNITS, "")} if of(name, _UNITS, "") else {})
                 for name, values in arrays.items() if name not in told}
    names = np.array([material["name"] for material in scene["materials"]], dtype=object)
    material = scene["triangle_material"][arrays["patch_input_triangle"]]
    coordinates = {"sun_azimuth": ("sun", light["azimuth_deg"], {"units": "degree"}),
                   "sun_elevation": ("sun", light["elevation_deg"], {"units": "degree"}),
                   "dni": ("sun", light["dni"], {"units": "W m-2"}), "hours": ("sun", light["hours"], {"units": "h"}),
                   "material_of": ("patch", names[material])}
    if light["radiance"] is None:
        coordinates["dhi"] = ("sun", light["dhi"], {"units": "W m-2"})
    attributes = {"title": "irradiance of patches", "source": f"sunload {version}", "seed": rules["seed"],
                  "realizations": rules["realizations"], "lines_per_patch": rules["lines"],
                  "direct_samples": rules["samples"], "bounces": rules["bounces"], **told}
    return xarray.Dataset(variables, coordinates, attributes)
