# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What users can get wrong in arrays: all of it is told at once, as `what (why); what to try`."""

from __future__ import annotations

import difflib
import operator
from typing import Any, Iterable, List, Optional, Sequence, Tuple

import numpy as np


class Problems:
    """Collects problems, so that all of them are told at once."""

    def __init__(self) -> None:
        self._list: List[str] = []

    def add(self, what: str, why: str = "", hint: str = "") -> None:
        """A line: what is wrong, why that is wrong, what to try."""
        self._list.append(what + (f" ({why})" if why else "") + (f"; {hint}" if hint else ""))

    def raise_if_any(self) -> None:
        """ValueError with all of them, a line each."""
        if self._list:
            raise ValueError("\n".join(self._list))

    def __len__(self) -> int:
        return len(self._list)


def numbers(problems: Problems, name: str, value: Any,
            shapes: Sequence[Tuple[Optional[int], ...]]) -> Optional[np.ndarray]:
    """A finite float64 array of one of the shapes, in which None is any length; None where it is not."""
    array = shaped(problems, name, value, shapes)
    return array if array is not None and all_finite(problems, name, array) else None


def shaped(problems: Problems, name: str, value: Any,
           shapes: Sequence[Tuple[Optional[int], ...]]) -> Optional[np.ndarray]:
    """The same with NaN and infinity."""
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        problems.add(f"{name}: not an array of numbers", f"wanted: {_words(shapes)}")
        return None
    if not any(_fits(array.shape, shape) for shape in shapes):
        problems.add(f"{name}: shape {list(array.shape)}", f"wanted: {_words(shapes)}")
        return None
    return array


def all_finite(problems: Problems, name: str, array: np.ndarray) -> bool:
    """Tells of NaN and infinity."""
    bad = ~np.isfinite(array)
    if bad.any():
        problems.add(f"{name}: {_count(bad)} not finite, the first at {_place(bad)}", "NaN and infinity are no values",
                     "leave such rows out, or fill them")
    return not bad.any()


def _fits(shape: Tuple[int, ...], wanted: Tuple[Optional[int], ...]) -> bool:
    return len(shape) == len(wanted) and all(w is None or w == s for s, w in zip(shape, wanted))


def _words(shapes: Sequence[Tuple[Optional[int], ...]]) -> str:
    return " or ".join("one number" if not shape else
                       "[" + ", ".join("n" if length is None else str(length) for length in shape) + "]"
                       for shape in shapes)


def _count(bad: np.ndarray) -> str:
    count = int(bad.sum())
    return f"{count} value{'s' if count > 1 else ''}"


def _place(bad: np.ndarray) -> str:
    first = np.argwhere(bad)[0]
    return "[" + ", ".join(str(i) for i in first) + "]" if first.size else "its only value"


def within(problems: Problems, name: str, array: Optional[np.ndarray], low: float, high: float, hint: str = "",
           above: bool = False) -> None:
    """Tells of values that are not in [low, high]; with `above` in (low, high]."""
    if array is None:
        return
    bad = (array <= low if above else array < low) | (array > high)
    if bad.any():
        first = array[tuple(np.argwhere(bad)[0])]
        bounds = f"{'(' if above else '['}{low:g}, {high:g}]"
        problems.add(f"{name}: {_count(bad)} outside of {bounds}, the first {first:g} at {_place(bad)}", "", hint)


def whole(problems: Problems, name: str, value: Any, low: int, high: int) -> int:
    """An integer in [low, high]; `low` where it is none."""
    try:
        number = operator.index(value)
    except TypeError:
        problems.add(f"{name} = {value!r}", "must be a whole number")
        return low
    if not low <= number <= high:
        problems.add(f"{name} = {number}", f"must lie in [{low}, {high}]")
        return low
    return number


def number(problems: Problems, name: str, value: Any, low: float, high: float, above: bool = False) -> float:
    """A number in [low, high], with `above` in (low, high]; `high` where it is none."""
    array = numbers(problems, name, value, [()])
    before = len(problems)
    within(problems, name, array, low, high, above=above)
    return high if array is None or len(problems) > before else float(array)


def word(problems: Problems, name: str, value: Any, known: Sequence[str]) -> str:
    """One of the words; the first of them where it is none."""
    if value in known:
        return value
    problems.add(f"{name} = {value!r}", "known: " + ", ".join(known), nearest(str(value), known))
    return known[0]


def nearest(name: str, known: Iterable[str]) -> str:
    """did you mean …?"""
    found = difflib.get_close_matches(name, list(known), 1)
    return f"did you mean '{found[0]}'?" if found else ""


def known_keys(problems: Problems, name: str, keys: Iterable[Any], known: Sequence[str]) -> None:
    """Tells of keys that are not known."""
    for key in keys:
        if key not in known:
            problems.add(f"{name}: unknown key {key!r}", "", nearest(str(key), known) or "known: " + ", ".join(known))
