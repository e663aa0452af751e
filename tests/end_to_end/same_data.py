# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether two results hold the same datasets, bit for bit; attributes (times, history) may differ."""

import sys


def datasets(path):
    import h5py
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: (item.dtype, item.shape, item[()])})
                        if isinstance(item, h5py.Dataset) else None)
    return found


def bits(value):
    return value.tobytes() if hasattr(value, "tobytes") and not value.dtype.hasobject else repr(value.tolist() if hasattr(value, "tolist") else value)


def different_data(a, b):
    """Names of datasets that are not in both files with the same shape and the same bits."""
    one, two = datasets(a), datasets(b)
    return sorted(set(one) ^ set(two)) + sorted(
        name for name in set(one) & set(two)
        if one[name][:2] != two[name][:2] or bits(one[name][2]) != bits(two[name][2]))


if __name__ == "__main__":
    names = different_data(sys.argv[1], sys.argv[2])
    print("\n".join(names))
    sys.exit(1 if names else 0)
