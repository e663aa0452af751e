# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a call refuses."""


def raised(kind, work):
    """The words of the exception of that kind which `work()` raises; fails where it raises none."""
    try:
        work()
    except kind as error:
        return str(error)
    raise AssertionError(f"no {kind.__name__}")
