# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Letters of names that the usual font lacks: another installed font that has them, or one warning."""

import sys
import warnings

import matplotlib
from matplotlib import font_manager
from matplotlib.ft2font import FT2Font

# Fonts that have a box for every letter, or pictures that cannot be drawn in a colour.
NO_LETTERS = ("Last Resort", "Noto Color Emoji")
MOST_LETTERS_TOLD = 8
DEBIAN = "fonts-noto-cjk"   # Chinese, Japanese and Korean, the usual case


def letters_of(results):
    """All that names and titles are written with, but those of ASCII, which every font has."""
    texts = [result.attribute(name) for result in results for name in ("study", "variant", "title")]
    texts += [text for result in results for name in ("facade_name", "object_name") for text in result.names(name)]
    return {letter for text in texts for letter in text if ord(letter) > 127}


def lacking(letters, path):
    """Those that a font file does not have."""
    try:
        font = FT2Font(path)
    except (RuntimeError, OSError):
        return letters
    return {letter for letter in letters if font.get_char_index(ord(letter)) == 0}


def installed():
    """Fonts that Matplotlib knows, then those that were installed since it looked."""
    known = font_manager.fontManager.ttflist
    yield from list(known)
    paths = {font.fname for font in known}
    for path in sorted(set(font_manager.findSystemFonts()) - paths):
        try:
            font_manager.fontManager.addfont(path)
        except (RuntimeError, OSError, ValueError):
            continue
        yield known[-1]


def found_for(letters):
    """Names of fonts that have letters, as few as it takes, and the letters that none has."""
    names = []
    while letters:
        best, still = None, letters
        for font in installed():
            rest = letters if font.name.startswith(NO_LETTERS) or font.style != "normal" else lacking(letters, font.fname)
            if len(rest) < len(still):
                best, still = font.name, rest
            if not rest:
                break
        if best is None:
            break
        names.append(best)
        letters = still
    return names, letters


def serve(results):
    """Of what is drawn from now on."""
    usual = font_manager.findfont(font_manager.FontProperties())
    names, missing = found_for(lacking(letters_of(results), usual))
    matplotlib.rcParams["font.family"] = [*matplotlib.rcParams["font.family"], *names]
    # A warning of each letter, wherever it stands.
    warnings.filterwarnings("ignore", message=r"Glyph \d+ .*missing from")
    if missing:
        told = sorted(missing)
        print(f"note: no installed font has {' '.join(told[:MOST_LETTERS_TOLD])}{' …' if len(told) > MOST_LETTERS_TOLD else ''}: "
              f"boxes stand in their place (Debian: apt install {DEBIAN})", file=sys.stderr)
