#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One PDF or HTML page about a study: the scene, what each variant changes, one table, and the pictures.

STUDY is the study's folder of results, or its result files; the study's first
variant, of files the first one, is what the others are compared with."""

import interpreter  # first: finds a Python that has the other packages

import argparse
import base64
import glob
import html
import io
import os
import sys
import tempfile
import textwrap
from types import SimpleNamespace

import numpy as np
from matplotlib.backends.backend_pdf import PdfPages

import carpet
import compare_bars
import drawing
import facade_map
import fonts
import months
import series
import sun_path
from drawing import plt
from program import NOWHERE, Program, add_program
from reading import InputError, Result

# Carpets and months of a few days say nothing that the series does not.
LEAST_DAYS_OF_CARPET, LEAST_MONTHS = 5, 2
HTML_DPI = 130


def results_in(folder):
    """Those of a folder in the order of the study."""
    results = [Result(path) for path in sorted(glob.glob(os.path.join(glob.escape(folder), "*.h5")))]
    if not results:
        raise InputError(f"{folder}: no result (*.h5) in this folder; give results/<study>")
    return sorted(results, key=lambda result: (result.attribute("variant_number", np.inf),
                                               result.attribute("variant") != "baseline"))


def results_of(names):
    """The result files of folders and files, the base first."""
    results = []
    for name in names:
        results += results_in(name) if os.path.isdir(name) else [Result(name)]
    studies = {result.attribute("study") for result in results}
    if len(studies) > 1:
        raise InputError(f"results of several studies ({', '.join(sorted(studies))}); make one report for each")
    return results


def facts(result):
    """Rows (what, value) about one result."""
    load, area = result.numbers("light_load"), result.numbers("patch_area")
    units = result.units("light_load")
    rows = [("period", result.period()),
            ("steps of the series: " + result.series_step if result.series_step else "intervals",
             f"{len(result.bounds())}, sun above the horizon in "
                          f"{int((result.numbers('sun_elevation') > 0).sum())}"),
            ("site", f"latitude {result.attribute('latitude_deg', np.nan):.4f}°, longitude "
                     f"{result.attribute('longitude_deg', np.nan):.4f}°; scene +y points to "
                     f"{sun_path.scene_north_deg(result) % 360:.1f}° from north"),
            ("patches", f"{len(area)}, {area.sum():.0f} m²"),
            ("least … largest load of a patch", f"{drawing.number(load.min(), 4)} … {drawing.number(load.max(), 4)} {units}")]
    if result.has("power_residual"):
        residual = result.file["power_residual"].attrs
        for what, key, unit in (("energy", "kwh", "kWh"), ("light", "klm_h", "klm h")):
            if f"time_sum_{key}" in residual:
                rows.append((f"{what} in − out", f"{drawing.number(residual[f'time_sum_{key}'], 3)} ± "
                                                 f"{drawing.number(residual.get(f'time_sum_se_{key}', np.nan), 2)} {unit}"))
    if result.attribute("warnings"):
        rows.append(("warnings", result.attribute("warnings")))
    return rows + [("made by", result.attribute("source")), ("content hash", result.attribute("study_sha256")[:16])]


def load_rows(results, program):
    """Mean light load of the whole and of every kind of surface, with standard errors; of variants the
    change of what they have in common with the base, in percent."""
    units = results[0].units("light_load")
    changes = [percent_changes(program, results[0].path, result.path) for result in results[1:]]
    for by in ("whole", "surface"):
        of_results = [compare_bars.Groups(result, by) for result in results]
        for name in of_results[0].place:
            cells = []
            for one, change in zip(of_results, [{}, *changes]):
                if name not in one.place:
                    cells.append("none")
                    continue
                k, count = one.place[name], len(one.realizations)
                error = f" ± {drawing.number(one.realizations[:, k].std(ddof=1) / np.sqrt(count), 2)}" if count > 1 else ""
                percent = change.get((by, name))
                cells.append(f"{drawing.number(one.load[k], 4)}{error} {units}"
                             + (f" ({percent:+.2f} % where both are)" if percent is not None else ""))
            yield f"mean load, {'all surfaces' if by == 'whole' else name}", cells


def table(results, program):
    """The one table: rows (what, a value of each result)."""
    yield "variant", [result.attribute("variant") for result in results]
    yield from load_rows(results, program)
    of_each = [dict(facts(result)) for result in results]
    for what in dict.fromkeys(key for rows in of_each for key in rows):
        yield what, [str(rows.get(what, "")) for rows in of_each]


def percent_changes(program, base, variant):
    """Of (kind, name) of groups the change over the area that both have [%]; empty without the program."""
    if not program.path:
        return {}
    return {(row["group"], row["name"]): row["difference_percent"] for row in program.compared(base, variant)["rows"]
            if row["difference_percent"] is not None}


def drawn_scene(program, path, folder, others=()):
    """A result or a comparison as a figure, pixel by pixel, on a scale that does for others, too."""
    image = os.path.join(folder, "scene.png")
    program.run("render", path, "-o", image, "--size", "1400x880", *(["--same-scale", *others] if others else []))
    pixels = plt.imread(image)
    figure = plt.figure(figsize=(pixels.shape[1] / HTML_DPI, pixels.shape[0] / HTML_DPI), constrained_layout=False)
    axes = figure.add_axes([0, 0, 1, 1])
    axes.imshow(pixels, interpolation="none")
    axes.set_axis_off()
    return figure


def scene_pictures(results, program):
    """The scene with the light load of the base, and what each variant changes, all on one scale."""
    if not program.path:
        return
    base, *variants = results
    with tempfile.TemporaryDirectory(prefix="sunload-report-") as folder:
        yield f"{base.attribute('variant')}: the scene", drawn_scene(program, base.path, folder)
        differences = [os.path.join(folder, f"difference-{k}.h5") for k in range(len(variants))]
        for variant, difference in zip(variants, differences):
            program.run("compare", base.path, variant.path, "--hdf5", difference)
        for variant, difference in zip(variants, differences):
            yield (f"{variant.attribute('variant')} minus {base.attribute('variant')}: the difference",
                   drawn_scene(program, difference, folder, [other for other in differences if other != difference]))


def variant_pictures(results, program):
    """Bars of the groups that all variants have: of facades, where none is common to all (a turned site, houses that
    are taken away) of objects, then of surfaces; none where nothing is."""
    for by in ("facade", "object", "surface"):
        if by != "surface" and not all(result.has(f"{by}_name") for result in results):
            continue
        try:
            yield "Variants", compare_bars.draw(results, SimpleNamespace(by=by, group=[]), program)[0]
            return
        except compare_bars.NothingInCommon:
            continue


def pictures(results, program):
    """(title, figure) one after the other, so that one figure is open at a time."""
    yield from scene_pictures(results, program)
    if len(results) > 1 and program.path:
        yield from variant_pictures(results, program)
    # All variants show the same facades on the same scales.
    largest = max(drawing.scale_end(result.numbers("light_load"), result.numbers("patch_area"))
                  for result in results)
    for result in results:
        chosen = SimpleNamespace(facade=[], patch=[], sensor=[], quantity=None, time=None, colour="false", max=None,
                                 step="auto", horizon=None)
        name = result.attribute("variant")
        if result.names("facade_name"):
            yield f"{name}: facades", facade_map.draw(
                result, SimpleNamespace(**{**vars(chosen), "quantity": "light_load", "max": largest}))[0]
        if result.stored_main_series:
            yield f"{name}: time series", series.draw(result, chosen)[0]
        if not result.is_synthetic:
            if result.stored_main_series and not result.has_long_steps and \
                    len(carpet.columns(result)[0]) >= LEAST_DAYS_OF_CARPET:
                yield f"{name}: day and hour", carpet.draw(result, chosen)[0]
            if (result.stored_main_series or result.has("light_load_by_month")) and \
                    len(months.month_shares(result)[0]) >= LEAST_MONTHS:
                yield f"{name}: months", months.draw(result, chosen)[0]
        if not result.series_step and result.has(sun_path.direct_series(result)) and (result.numbers("sun_elevation") > 0).any():
            yield f"{name}: hours in the sun", sun_path.draw(result, chosen)[0]


def table_html(results, program):
    """Values that all results share stand once."""
    text = "<table>"
    for what, values in table(results, program):
        cells = values[:1] if len(set(values)) == 1 else values
        span = f' colspan="{len(values)}"' if len(cells) < len(values) else ""
        text += f"<tr><td>{html.escape(what)}</td>" + "".join(f"<td{span}>{html.escape(value)}</td>" for value in cells) + "</tr>"
    return text + "</table>\n"


def write_html(results, program, file):
    title = html.escape(f"sunload: {results[0].attribute('study')}")
    file.write(f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>'
               "body{font:15px/1.45 sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;color:#222}"
               "img{width:100%}td{padding:.15em 1em .15em 0;vertical-align:top}td:first-child{color:#666}"
               "tr:first-child{font-weight:bold}"
               f"</style></head><body>\n<h1>{title}</h1>\n")
    is_table_due = True
    for name, figure in pictures(results, program):
        if is_table_due and not name.endswith((": the scene", ": the difference")):
            file.write(table_html(results, program))
            is_table_due = False
        picture = io.BytesIO()
        figure.savefig(picture, format="png", dpi=HTML_DPI)
        plt.close(figure)
        file.write(f'<h2>{html.escape(name)}</h2><img alt="{html.escape(name)}" src="data:image/png;base64,'
                   f'{base64.b64encode(picture.getvalue()).decode()}">\n')
    if is_table_due:
        file.write(table_html(results, program))
    file.write("</body></html>\n")


def table_page(results, program):
    """The table as text; long values are wrapped."""
    rows = [(what, values[:1] if len(set(values)) == 1 else values) for what, values in table(results, program)]
    width = max(24, 110 // len(results))
    lines = []
    for what, values in rows:
        cells = [textwrap.wrap(value, width * (len(results) if len(values) == 1 else 1) - 2) or [""] for value in values]
        for k in range(max(len(cell) for cell in cells)):
            lines.append(f"{what if k == 0 else '':>32}   " + "".join(
                f"{cell[k] if k < len(cell) else '':<{width}}" for cell in cells))
    figure = plt.figure(figsize=(11, 1.5 + 0.17 * len(lines)))
    figure.text(0.02, 0.98, f"sunload: {results[0].attribute('study')}", va="top", fontsize=16)
    figure.text(0.02, 1 - 0.8 / figure.get_figheight(), "\n".join(lines), va="top", fontsize=7,
                family=["monospace", *plt.rcParams["font.family"]])
    return figure


def write_pdf(results, program, file):
    with PdfPages(file, metadata={"Title": f"sunload: {results[0].attribute('study')}", "CreationDate": None}) as pdf:
        def page(figure):
            pdf.savefig(figure, dpi=150)
            plt.close(figure)

        is_table_due = True
        for name, figure in pictures(results, program):
            if is_table_due and not name.endswith((": the scene", ": the difference")):
                page(table_page(results, program))
                is_table_due = False
            page(figure)
        if is_table_due:
            page(table_page(results, program))


def main(argv):
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("results", metavar="STUDY", nargs="+", help="folder of results, or result files (.h5)")
    p.add_argument("-o", "--output", metavar="REPORT", help="file to write: .html or .pdf (default: report.html "
                                                            "in the folder of the first result)")
    add_program(p)
    arguments = p.parse_args(argv)
    results = results_of(arguments.results)
    fonts.serve(results)
    output = arguments.output or os.path.join(os.path.dirname(results[0].path), "report.html")
    kind = os.path.splitext(output)[1].lower()
    if kind not in (".html", ".pdf"):
        raise InputError(f"{output}: a report is .html or .pdf")
    program = Program(arguments.sunload)
    if not program.path:
        print(f"no pictures of the scene and no comparison: the program sunload is {NOWHERE}; name it with --sunload",
              file=sys.stderr)
    # Aside first: what fails half-way leaves no half report behind.
    with drawing.written_aside(output) as aside:
        if kind == ".html":
            with open(aside, "w", encoding="utf-8") as file:
                write_html(results, program, file)
        else:
            with open(aside, "wb") as file:
                write_pdf(results, program, file)
    print(f"wrote {output}", file=sys.stderr)


if __name__ == "__main__":
    drawing.run(main)
