# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: checked and run by the program."""

from __future__ import annotations

import collections.abc
import json
import os
import re
from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Sequence, Union

import xarray

from . import program, results

Progress = Callable[[Dict[str, Any]], None]


class Report(dict):
    """What `sunload check --json` tells: study (its name), folder (of all results, relative to the study's folder of
    work), variants with patches, intervals, memory_bytes, disk_bytes, seconds."""

    @property
    def seconds(self) -> float:
        """Estimated time of all variants [s]."""
        return sum(variant["seconds"] for variant in self["variants"])


class Results(collections.abc.Mapping):
    """Results of a study by the names of its variants; files are opened when they are asked for."""

    def __init__(self, paths: Mapping[str, str]):
        self.paths = dict(paths)

    def __getitem__(self, variant: str) -> xarray.Dataset:
        return results.open(self.paths[variant])

    def __iter__(self) -> Iterator[str]:
        return iter(self.paths)

    def __len__(self) -> int:
        return len(self.paths)

    def __repr__(self) -> str:
        return f"Results({self.paths!r})"


def _plain(value: Any) -> Any:
    """Numbers and arrays of numpy, dates and paths, as JSON has them."""
    if hasattr(value, "tolist"):
        return value.tolist()
    return str(value)


class Study:
    """A study of a file, or of a dict with the keys of docs/study-file.md.

    A dict is written to `<name>.yaml` in `folder` (JSON, which YAML reads), where paths in it are relative to; a file
    of another content that is there is not replaced, unless it was written so and the program refuses it: then it is
    kept as `<name>.yaml~`. The program is started in `folder`, which is the working one
    unless given. After `check`, `report` has what it told."""

    def __init__(self, study: Union[str, os.PathLike, Mapping[str, Any]], folder: Optional[str] = None):
        self.folder = os.path.abspath(folder or os.getcwd())
        self.report: Optional[Report] = None
        if isinstance(study, collections.abc.Mapping):
            self.path = self._written(dict(study))
        else:
            self.path = os.path.abspath(os.fspath(study))
            self._expect_readable()

    @property
    def name(self) -> str:
        """The study's name; a study that is not checked yet is."""
        return self._checked()["study"]

    def _checked(self) -> Report:
        if self.report is None:
            self.check()
        return self.report

    def _written(self, study: Dict[str, Any]) -> str:
        study.setdefault("format", "sunload-study-1")
        name = study.get("name")
        if not isinstance(name, str) or not re.fullmatch(r"[A-Za-z0-9_-][A-Za-z0-9_.-]*", name):
            raise program.InputError(f"name {name!r} of the study: letters, digits, _ - . name a study; write e.g. "
                                     "name='street'", 2)
        path = os.path.join(self.folder, name + ".yaml")
        text = json.dumps(study, indent=1, ensure_ascii=False, default=_plain) + "\n"
        try:
            with open(path, encoding="utf-8") as file:
                there = file.read()
            if there != text and not self._is_of_no_use(path, there):
                raise program.InputError(f"{path}: is there with another study; choose another name or folder, or "
                                         "remove it", 2)
        except FileNotFoundError:
            os.makedirs(self.folder, exist_ok=True)
            there = ""
        if there != text:
            if there:
                os.replace(path, path + "~")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        return path

    def _is_of_no_use(self, path: str, text: str) -> bool:
        """Whether a file is a study that was written from a dict and that the program refuses: a slip to be mended."""
        try:
            json.loads(text)
        except ValueError:
            return False
        try:
            program.run(["check", path, "--json", "--no-refine", "--progress", "none"], self.folder)
        except program.InputError:
            return True
        return False

    def _expect_readable(self) -> None:
        try:
            with open(self.path, "rb"):
                pass
        except OSError as error:
            raise program.InputError(f"{self.path}: cannot be read ({error.strerror})", 2) from error

    def check(self, refine: bool = False) -> "Study":
        """Reads everything and estimates work (`report`); with `refine` meshes are refined as a run does it. Raises
        InputError with every problem. Returns itself."""
        words = ["check", self.path, "--json", "--progress", "none"] + ([] if refine else ["--no-refine"])
        self.report = Report(json.loads(program.run(words, self.folder)))
        return self

    def run(self, variants: Union[str, Sequence[str]] = (), output: Optional[str] = None, resume: bool = True,
            overwrite: bool = False, threads: Optional[int] = None, progress: Optional[Progress] = None) -> Results:
        """Computes what is missing below `output` (relative to the study's folder of work; None: the study's own
        output.folder) and returns the results.

        resume: finished results of this very study are taken as they are; overwrite: others are replaced. `progress`
        gets dicts with `variant`, `stage`, `share` (of the stage, 0 … 1), `suns_done`, `suns`, `left_s`, and others with
        `message` alone. Raises InputError, MachineError, Unfinished."""
        variants = [variants] if isinstance(variants, str) else list(variants)
        words: List[str] = ["run", self.path, "--progress", "json" if progress else "none"]
        if output is not None:
            words += ["--output", os.fspath(output)]
        for variant in variants:
            words += ["--variant", variant]
        words += ["--overwrite"] if overwrite else ["--resume"] if resume else []
        if threads is not None:
            words += ["--threads", str(threads)]
        program.run(words, self.folder, _listener(progress) if progress else None)
        report = self._checked()
        names = variants or [variant["name"] for variant in report["variants"]]
        place = os.path.join(self.folder, report["folder"] if output is None else os.fspath(output), report["study"])
        return Results({name: os.path.join(place, name + ".h5") for name in names})


def _listener(progress: Progress) -> Callable[[str], bool]:
    def line(text: str) -> bool:
        try:
            told = json.loads(text)
        except ValueError:
            return False
        if not isinstance(told, dict):
            return False
        progress(told)
        return True
    return line
