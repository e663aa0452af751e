# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of light in bands (solver.bands: rgb), shown as their mean: broadband light."""

import h5py
import numpy as np


class MeanOfBands:
    """A dataset without its dimension `band`."""

    def __init__(self, dataset, axis):
        self.dataset, self.axis = dataset, axis
        self.shape = dataset.shape[:axis] + dataset.shape[axis + 1:]
        self.dtype, self.chunks = dataset.dtype, dataset.chunks
        self.dims = [dim for i, dim in enumerate(dataset.dims) if i != axis]
        # Of the ledger's terms some have a value per band.
        self.attrs = {name: float(np.mean(value)) if name.startswith("time_sum") else value
                      for name, value in dataset.attrs.items()}

    def __getitem__(self, key):
        keys = [] if key is Ellipsis else list(key) if isinstance(key, tuple) else [key]
        keys += [slice(None)] * (len(self.shape) - len(keys))
        lost = sum(isinstance(k, (int, np.integer)) for k in keys[:self.axis])
        keys.insert(self.axis, slice(None))
        return self.dataset[tuple(keys)].mean(axis=self.axis - lost)

    def __iter__(self):
        return (self[row] for row in range(self.shape[0]))

    def __len__(self):
        return self.shape[0]


class BroadbandFile:
    """A file of light in bands that reads like one without."""

    def __init__(self, file):
        self.file, self.attrs = file, file.attrs

    def __contains__(self, name):
        return name in self.file and name != "band"

    def __getitem__(self, name):
        item = self.file[name]
        if not isinstance(item, h5py.Dataset):
            return item
        dims = [dim[0].name.rpartition("/")[2] if len(dim) else "" for dim in item.dims]
        return MeanOfBands(item, dims.index("band")) if "band" in dims else item

    def items(self):
        return ((name, self[name]) for name in self.file if name != "band")


def broadband(file):
    """The file as it is, or, where it has bands, their mean."""
    return BroadbandFile(file) if "band" in file else file
