# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials of `solve`, with the keys and the rules of a study's (docs/study-file.md)."""

from __future__ import annotations

import collections.abc
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from .checks import Problems, known_keys, number, numbers, whole, within, word

try:
    from numpy.typing import ArrayLike
except ImportError:  # NumPy before 1.20
    ArrayLike = Any  # type: ignore[assignment, misc]

Materials = Union[ArrayLike, Mapping[str, Any], Sequence[Mapping[str, Any]]]

# Range of each key, whether its low end is excluded, what it is without the key.
_MATERIAL = {"diffuse": (0, 1, False, 0), "mirror": (0, 1, False, 0), "glossy": (0, 1, False, 0),
             "glossy_exponent": (0, 1e5, False, 0), "transmittance": (0, 1, False, 0),
             "emission_w_m2": (0, 1e7, False, 0), "refractive_index": (0.01, 10, False, 0),
             "extinction_coefficient": (0, 100, True, 0), "thickness_m": (0, 1, True, 0.004),
             "absorption_per_m": (0, 1e5, False, 0), "normal_transmittance": (0, 1, True, 0)}
_ROUNDING = 1e-12  # of sums of decimal numbers

_CLEAR_GLASS = 1.018  # of light from the normal clear glass passes this times its transmittance (solver/surface)


def materials_of(problems: Problems, materials: Materials, triangle_material: Optional[ArrayLike],
               count: Optional[int]) -> Tuple[List[Dict[str, Any]], Optional[np.ndarray]]:
    """Materials with all their keys, and which of them each triangle has; `count` of triangles, None: not known."""
    if isinstance(materials, collections.abc.Mapping):
        materials = [materials]
    is_list = isinstance(materials, (list, tuple)) and len(materials) > 0 and \
        any(isinstance(item, collections.abc.Mapping) for item in materials)
    if not is_list:
        return _reflectances(problems, materials, triangle_material, count)
    written = [_material(problems, index, item) for index, item in enumerate(materials)]
    if triangle_material is None:
        if count is not None and len(written) not in (1, count):
            problems.add(f"materials: {len(written)} for {count} triangles", "which has which is not told",
                         "give triangle_material, an index into them for each triangle")
        return written, np.arange(count or 0, dtype=np.int32) % len(written)
    index = numbers(problems, "triangle_material", triangle_material, [(count,)])
    if index is None:
        return written, None
    wrong = (index < 0) | (index >= len(written)) | (index != np.floor(index))
    if wrong.any():
        first = np.flatnonzero(wrong)[0]
        problems.add(f"triangle_material: {int(wrong.sum())} no indices of the {len(written)} materials, the first "
                     f"{index[first]:g} at [{first}]", "they count from 0")
    return written, index.astype(np.int32)


def _reflectances(problems: Problems, diffuse: Any, triangle_material: Any,
                  count: Optional[int]) -> Tuple[List[Dict[str, Any]], Optional[np.ndarray]]:
    if triangle_material is not None:
        problems.add("triangle_material: stands without a list of materials", "reflectances are of triangles already",
                     "leave it out, or give a list of dicts")
    values = numbers(problems, "materials", diffuse, [(), (count,)])
    within(problems, "materials", values, 0, 1, "reflectances are shares: 0.3, not 30")
    if values is None:
        return [], None
    different, index = np.unique(np.broadcast_to(values, (count or values.size,)), return_inverse=True)
    return ([dict(_filled({"diffuse": float(value)}), name=f"diffuse_{value:g}") for value in different],
            index.astype(np.int32))


def _filled(written: Mapping[str, Any]) -> Dict[str, Any]:
    """With what keys that are not written mean."""
    kind = "clear glass" if "normal_transmittance" in written else \
        "metal" if "extinction_coefficient" in written else "panes" if "refractive_index" in written else "constant"
    return {**{key: default for key, (_, _, _, default) in _MATERIAL.items()}, "panes": 1, "sides": "one", "kind": kind,
            **written}


def _material(problems: Problems, index: int, written: Any) -> Dict[str, Any]:
    place = f"materials[{index}]"
    if not isinstance(written, collections.abc.Mapping):
        problems.add(f"{place}: {type(written).__name__}", "a list of materials has dicts", "{'diffuse': 0.3}")
        return _filled({"name": place})
    known_keys(problems, place, written, (*_MATERIAL, "panes", "sides", "name"))
    before = len(problems)
    values: Dict[str, Any] = {key: number(problems, f"{place}: {key}", written[key], low, high, above)
                              for key, (low, high, above, _) in _MATERIAL.items() if key in written}
    if "panes" in written:
        values["panes"] = whole(problems, f"{place}: panes", written["panes"], 1, 10)
    if not any(key in written for key in ("diffuse", "mirror", "glossy", "transmittance", "refractive_index",
                                          "normal_transmittance", "emission_w_m2")):
        problems.add(f"{place}: says nothing of reflection", "names of the table of materials mean nothing here",
                     "{'diffuse': 0.3}; black is {'diffuse': 0}")
    if "sides" in written:
        values["sides"] = word(problems, f"{place}: sides", written["sides"], ("one", "two"))
    values["name"] = str(written.get("name", f"material_{index}"))
    if len(problems) == before:
        _expect_one_kind(problems, place, values)
    return _filled(values)


def _expect_one_kind(problems: Problems, place: str, values: Mapping[str, Any]) -> None:
    """Panes, metals, clear glass and constant shares exclude each other; none sends on more than it receives."""
    constant = ("mirror", "glossy", "transmittance")
    of_panes = ("thickness_m", "absorption_per_m", "panes")

    def excludes(key: str, others: Sequence[str], why: str) -> None:
        for other in others:
            if other in values:
                problems.add(f"{place}: {other} cannot stand with {key}", why)

    if "normal_transmittance" in values:
        excludes("normal_transmittance", ("refractive_index", "extinction_coefficient", *of_panes, "glossy",
                                          "transmittance"), "that is all that is known of clear glass")
    elif "refractive_index" in values:
        excludes("refractive_index", constant, "it follows from the index, at every angle")
        if "extinction_coefficient" in values:
            excludes("extinction_coefficient", of_panes, "no light passes a metal")
        elif values["refractive_index"] <= 1:
            problems.add(f"{place}: refractive_index = {values['refractive_index']:g}", "panes are denser than air",
                         "metals have an extinction_coefficient, too")
    else:
        for key in ("extinction_coefficient", *of_panes):
            if key in values:
                problems.add(f"{place}: {key} stands without refractive_index", "it belongs to panes or metals")
    if values.get("glossy", 0) > 0 and "glossy_exponent" not in values:
        problems.add(f"{place}: glossy stands without glossy_exponent", "that is the width of its lobe",
                     "10 is a broad lobe, 1000 a narrow one")
    shares = {key: values.get(key, 0.0) for key in ("diffuse", *constant)}
    clear = _CLEAR_GLASS * values.get("normal_transmittance", 0.0)
    if sum(shares.values()) + clear > 1 + _ROUNDING:
        terms = " + ".join(key for key, share in shares.items() if share) + (f" + {_CLEAR_GLASS} normal_transmittance"
                                                                             if clear else "")
        problems.add(f"{place}: {terms} = {sum(shares.values()) + clear:g} is above 1",
                     "no surface sends on more than it receives")
