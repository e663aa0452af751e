# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the pictures share: colours, command line, saving, the listing of what is drawn."""

import argparse
import contextlib
import csv
import errno
import os
import shutil
import signal
import sys
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.colors import ListedColormap  # noqa: E402

import fonts  # noqa: E402
from reading import InputError, Result  # noqa: E402

# Okabe and Ito (2008), Color universal design: told apart by all kinds of colour vision.
LINE_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000", "#999999")
LINE_STYLES = ("-", "--", "-.", ":")
COMPONENT_COLOURS = {"direct": "#E69F00", "sky": "#56B4E9", "mirror": "#CC79A7", "lamps": "#F0E442",
                     "reflected": "#0072B2", "other parts, not stored": "#999999", "other light": "#999999"}
TIME_SUMS = {"W/m²": "kWh/m²", "lx": "klx h"}   # of a thousand times the unit, by the hour
NO_DATA = "#c9c9c9"
# Of the intervals that whiskers show.
CONFIDENCE = 0.95
# Scales end where this share of the area lies below, as those of `sunload render` do.
SCALE_SHARE = 0.995
# Of headings, on the average of their letters.
HEADING_LETTERS_PER_IN = 12.5

plt.rcParams.update({
    "font.size": 9, "axes.titlesize": 10, "axes.titlelocation": "left", "figure.titlesize": 12,
    "axes.spines.top": False, "axes.spines.right": False, "axes.axisbelow": True, "legend.frameon": False,
    "axes.grid": False, "grid.color": "#dddddd", "grid.linewidth": 0.6, "savefig.facecolor": "white",
    "svg.hashsalt": "sunload", "text.parse_math": False,  # names are written as they are, also with a $
    "figure.constrained_layout.use": True})


def student_t(degrees):
    """Quantile of Student's t for a two-sided interval, from its density (trapezoids in an
    angle that makes the tails finite: t = √ν tan θ has the density cos^(ν−1) θ)."""
    angle = np.linspace(0, np.pi / 2, 200_001)
    density = np.cos(angle) ** (degrees - 1)
    inside = np.concatenate([[0], np.cumsum((density[1:] + density[:-1]) / 2)])
    return float(np.sqrt(degrees) * np.tan(np.interp(CONFIDENCE * inside[-1], inside, angle)))


def srgb_from_lab(lightness, a, b):
    """CIE 15:2004 with the white D65, then sRGB (IEC 61966-2-1); clipped to what a screen shows."""
    f = (lightness + 16) / 116
    f = np.stack([f + a / 500, f, f - b / 200])
    knee = 6 / 29
    xyz = np.where(f > knee, f**3, 3 * knee**2 * (f - 4 / 29)) * np.array([[0.95047], [1.0], [1.08883]])
    linear = np.array([[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560],
                       [0.0556434, -0.2040259, 1.0572252]]) @ xyz
    toe = 12.92 * linear
    return np.clip(np.where(linear <= 0.0031308, toe, 1.055 * np.maximum(linear, 1e-9)**(1 / 2.4) - 0.055), 0, 1).T


def palette(kind):
    """The false colours and greys of `sunload render` (io/base/colour_map.h): equal steps of value
    are equal steps of lightness and of colour difference."""
    share = np.linspace(0, 1, 256)
    lightness, chroma, hue = 12 + 80 * share, 58 if kind == "false" else 0, np.radians(305 + 153 * share)
    colours = ListedColormap(srgb_from_lab(lightness, chroma * np.cos(hue), chroma * np.sin(hue)), name=kind)
    colours.set_bad(NO_DATA)
    return colours


def rounded_up(value):
    """Smallest 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 × 10^n that is not below a value above 0."""
    power = 10.0 ** np.floor(np.log10(value))
    steps = np.array([1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10]) * power
    return float(steps[steps >= value * (1 - 1e-9)][0])


def scale_end(values, area, largest=None):
    """Value of the last colour: the user's, or one that 99.5 % of the area do not exceed."""
    if largest is not None:
        return largest
    known = np.isfinite(values)
    if not known.any():
        raise InputError("nothing to draw: all values are missing (a partial merge?)")
    order = np.argsort(values[known])
    share = np.cumsum(area[known][order]) / area[known].sum()
    limit = values[known][order][min(np.searchsorted(share, SCALE_SHARE), len(share) - 1)]
    return rounded_up(limit) if limit > 0 else 1.0


def colour_bar(figure, mappable, axes, caption, values, end):
    above = bool(np.nanmax(values) > end * (1 + 1e-12))
    figure.colorbar(mappable, ax=axes, label=caption + (f"\n(larger values, up to {np.nanmax(values):.4g}, "
                                                        "have the last colour)" if above else ""),
                    extend="max" if above else "neither", shrink=0.8, aspect=30, pad=0.01)


def heading(figure, result, text):
    letters = int(HEADING_LETTERS_PER_IN * figure.get_figwidth())
    lines = [part for line in f"{result.title}\n{text}".split("\n") for part in textwrap.wrap(line, letters) or [""]]
    figure.suptitle("\n".join(lines), x=0.01, ha="left", fontsize=10.5, linespacing=1.4)


def shortened(name, letters):
    """A long name without its middle."""
    if len(name) <= letters:
        return name
    tail = max(letters * 2 // 3, 1)
    return name[:letters - tail - 1] + "…" + name[-tail:]


# Command line.

def positive(text):
    value = float(text)
    if not (np.isfinite(value) and value > 0):
        raise argparse.ArgumentTypeError(f"{text} is not a number above 0")
    return value


def parser(description, results="RESULT", many=False):
    p = argparse.ArgumentParser(description=description,
                                formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("results", metavar=results, nargs="+" if many else 1, help="result file (.h5)")
    p.add_argument("-o", "--output", metavar="PICTURE",
                   help="picture to write: .png, .pdf or .svg (default: beside the result)")
    p.add_argument("--csv", metavar="FILE", help="also list what is drawn; - for standard output")
    p.add_argument("--dpi", type=positive, default=150, help="pixels per inch (default: %(default)s)")
    return p


def add_colours(p):
    p.add_argument("--colour", choices=("false", "grey"), default="false",
                   help="colours of values (default: %(default)s)")
    p.add_argument("--max", type=positive, metavar="VALUE", help="value of the last colour")


def add_targets(p, sensors=True):
    p.add_argument("--facade", action="append", default=[], metavar="NAME",
                   help="facade by name or pattern, e.g. 'house_3/*' (repeatable)")
    p.add_argument("--patch", action="append", type=int, default=[], metavar="N",
                   help="patch by its index in the file (repeatable)")
    if sensors:
        p.add_argument("--sensor", action="append", type=int, default=[], metavar="N",
                       help="sensor by its index in the file (repeatable)")


@contextlib.contextmanager
def written_aside(path):
    """A name to write to, which becomes `path` where all is well: what was there before is not lost on a full disk.
    Errors of writing, which name no file, get the name. What is no file (/dev/null, a pipe), and a file in a folder where
    nothing can be made, are written to as they are."""
    target = os.path.realpath(path)   # links stay
    is_there = os.path.exists(target)
    if is_there and (not os.path.isfile(target) or not os.access(os.path.dirname(target), os.W_OK)):
        yield path
        return
    aside = f"{target}.part-{os.getpid()}"
    try:
        if is_there and not os.access(target, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        yield aside
        if is_there:
            shutil.copymode(target, aside)
        os.replace(aside, target)
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), path) from error
    finally:
        with contextlib.suppress(OSError):
            os.remove(aside)


def save(figure, path, dpi):
    ending = os.path.splitext(path)[1].lower()
    if ending[1:] not in figure.canvas.get_supported_filetypes():
        why = f"format {ending[1:]} is not known" if ending else "it has no ending"
        raise InputError(f"{path}: {why}; end the name in .png, .pdf or .svg")
    metadata = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}.get(ending)
    try:
        with written_aside(path) as aside:
            figure.savefig(aside, dpi=dpi, metadata=metadata, format=ending[1:])
    finally:
        plt.close(figure)


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def number(value, digits):
    """So many significant digits; large numbers are whole, without an exponent."""
    text = f"{value:.{digits}g}"
    return f"{float(text):.0f}" if "e+" in text else text


def csv_cell(cell):
    """Names that spreadsheets would compute get an apostrophe before them, as those of `sunload export` do."""
    if isinstance(cell, float):
        return f"{cell:.9g}"
    return "'" + cell if isinstance(cell, str) and cell[:1] in tuple("=+-@") and not is_number(cell) else cell


def write_csv(path, rows):
    """Rows: the header first."""
    def write(file):
        csv.writer(file, lineterminator="\n").writerows([csv_cell(cell) for cell in row] for row in rows)
    if path == "-":
        write(sys.stdout)
        return
    with written_aside(path) as aside, open(aside, "w", encoding="utf-8", newline="") as file:
        write(file)


def default_output(result, name):
    return os.path.splitext(result.path)[0] + f"-{name}.png"


def run(main):
    """Exit codes as the program's: 2 where the input is wrong, 3 where a file cannot be written."""
    # By way of what removes half-written files.
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))
    try:
        main(sys.argv[1:])
    except InputError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
    except OSError as error:
        print(f"{error.filename or ''}: {error.strerror or error}", file=sys.stderr)
        sys.exit(3)


def draw_one(arguments, name, draw):
    """For a picture of one result: `draw` gives figure and rows."""
    result = Result(arguments.results[0])
    fonts.serve([result])
    figure, rows = draw(result, arguments)
    if arguments.csv:
        write_csv(arguments.csv, rows)
    output = arguments.output or default_output(result, name)
    save(figure, output, arguments.dpi)
    print(f"wrote {output}", file=sys.stderr)
