# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs studies in a temporary folder, as a user would, and opens their results."""

import os
import shutil
import subprocess
import tempfile

import h5py


class Program:
    def __init__(self, path, pictures="."):
        self.path = os.path.abspath(path)
        self.pictures = pictures  # folder of what sections draw
        self.folder = tempfile.TemporaryDirectory(prefix="validate-")

    def write(self, name, text):
        path = os.path.join(self.folder.name, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def results(self, name, study):
        """Runs the study of that name; {variant: open result}."""
        path = self.write(name + ".yaml", f"format: sunload-study-1\nname: {name}\n{study}")
        done = subprocess.run([self.path, "run", path, "--progress", "none"], cwd=self.folder.name,
                              capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"validate: {name}: {done.stderr}")
        folder = os.path.join(self.folder.name, "results", name)
        return {os.path.splitext(file)[0]: h5py.File(os.path.join(folder, file))
                for file in sorted(os.listdir(folder)) if file.endswith(".h5")}

    def forget(self, name):
        shutil.rmtree(os.path.join(self.folder.name, "results", name))
