#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One PDF or HTML page about a study: what was computed, how sure it is, and the pictures.

STUDY is the study's folder of results, or its result files; the result named
baseline, else the first, is what the others are compared with."""

import argparse
import base64
import glob
import html
import io
import os
import sys
import textwrap
from types import SimpleNamespace

import numpy as np
from matplotlib.backends.backend_pdf import PdfPages

import carpet
import compare_bars
import drawing
import facade_map
import months
import series
import sun_path
from drawing import plt
from reading import InputError, Result

# Carpets and months of a few days say nothing that the series does not.
LEAST_DAYS_OF_CARPET, LEAST_MONTHS = 5, 2


def results_of(names):
    """The result files of folders and files, the base first."""
    paths = []
    for name in names:
        found = sorted(glob.glob(os.path.join(glob.escape(name), "*.h5"))) if os.path.isdir(name) else [name]
        if not found:
            raise InputError(f"{name}: no result (*.h5) in this folder; give results/<study>")
        paths += found
    results = [Result(path) for path in paths]
    studies = {result.attribute("study") for result in results}
    if len(studies) > 1:
        raise InputError(f"results of several studies ({', '.join(sorted(studies))}); make one report for each")
    return sorted(results, key=lambda result: result.attribute("variant") != "baseline")


def facts(result):
    """Rows (what, value) of the first page."""
    load, area = result.numbers("light_load"), result.numbers("patch_area")
    units = result.units("light_load")
    rows = [("variant", result.attribute("variant")), ("period", result.period()),
            ("intervals", f"{len(result.bounds())}, sun above the horizon in "
                          f"{int((result.numbers('sun_elevation') > 0).sum())}"),
            ("site", f"latitude {result.attribute('latitude_deg', np.nan):.4f}°, longitude "
                     f"{result.attribute('longitude_deg', np.nan):.4f}°; scene +y points to "
                     f"{sun_path.scene_north_deg(result) % 360:.1f}° from north"),
            ("patches", f"{len(area)}, {area.sum():.0f} m²"),
            ("light load", f"mean {np.average(load, weights=area):.4g}, least {load.min():.4g}, "
                           f"largest {load.max():.4g} {units}")]
    if result.has("light_load_realization"):
        means = np.array([np.average(row[...], weights=area) for row in result.file["light_load_realization"]])
        if len(means) > 1:
            rows.append(("standard error of the mean", f"{means.std(ddof=1) / np.sqrt(len(means)):.2g} {units} "
                                                       f"from {len(means)} realizations"))
    if result.has("power_residual"):
        residual = result.file["power_residual"].attrs
        if "time_sum_kwh" in residual:
            rows.append(("energy in − out", f"{residual['time_sum_kwh']:.3g} ± "
                                            f"{residual.get('time_sum_se_kwh', np.nan):.2g} kWh"))
    if result.attribute("warnings"):
        rows.append(("warnings", result.attribute("warnings")))
    return rows + [("made by", result.attribute("source")), ("content hash", result.attribute("study_sha256")[:16])]


def pictures(results):
    """(title, figure) one after the other, so that one figure is open at a time."""
    if len(results) > 1 and all(result.has("facade_name") for result in results):
        yield "Variants", compare_bars.draw(results, SimpleNamespace(by="facade", group=[]))[0]
    # All variants show the same facades on the same scales.
    largest = max(drawing.scale_end(result.numbers("light_load"), result.numbers("patch_area"))
                  for result in results)
    for result in results:
        chosen = SimpleNamespace(facade=[], patch=[], sensor=[], quantity=None, time=None, colour="false", max=None,
                                 step="auto")
        name = result.attribute("variant")
        if result.names("facade_name"):
            yield f"{name}: facades", facade_map.draw(
                result, SimpleNamespace(**{**vars(chosen), "quantity": "light_load", "max": largest}))[0]
        yield f"{name}: time series", series.draw(result, chosen)[0]
        if not result.is_synthetic:
            if len(carpet.columns(result)[0]) >= LEAST_DAYS_OF_CARPET:
                yield f"{name}: day and hour", carpet.draw(result, chosen)[0]
            if len(months.month_shares(result)[0]) >= LEAST_MONTHS:
                yield f"{name}: months", months.draw(result, chosen)[0]
        if result.has("irradiance_direct") and (result.numbers("sun_elevation") > 0).any():
            yield f"{name}: hours in the sun", sun_path.draw(result, chosen)[0]


def write_html(results, file):
    title = html.escape(f"sunload: {results[0].attribute('study')}")
    file.write(f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>'
               "body{font:15px/1.45 sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;color:#222}"
               "img{width:100%}td{padding:.15em 1em .15em 0;vertical-align:top}td:first-child{color:#666}"
               f"</style></head><body>\n<h1>{title}</h1>\n")
    for result in results:
        file.write("<table>" + "".join(f"<tr><td>{html.escape(what)}</td><td>{html.escape(value)}</td></tr>"
                                       for what, value in facts(result)) + "</table><hr>\n")
    for name, figure in pictures(results):
        picture = io.BytesIO()
        figure.savefig(picture, format="png", dpi=130)
        plt.close(figure)
        file.write(f'<h2>{html.escape(name)}</h2><img alt="{html.escape(name)}" src="data:image/png;base64,'
                   f'{base64.b64encode(picture.getvalue()).decode()}">\n')
    file.write("</body></html>\n")


def first_page(results):
    lines = []
    for result in results:
        for what, value in facts(result):
            first, *rest = textwrap.wrap(str(value), 95) or [""]
            lines += [f"{what:>28}   {first}"] + [" " * 31 + line for line in rest]
        lines.append("")
    figure = plt.figure(figsize=(11, 1.5 + 0.17 * len(lines)))
    figure.text(0.02, 0.98, f"sunload: {results[0].attribute('study')}", va="top", fontsize=16)
    figure.text(0.02, 1 - 0.8 / figure.get_figheight(), "\n".join(lines), va="top", fontsize=8,
                family="monospace")
    return figure


def write_pdf(results, file):
    with PdfPages(file, metadata={"Title": f"sunload: {results[0].attribute('study')}", "CreationDate": None}) as pdf:
        front = first_page(results)
        pdf.savefig(front)
        plt.close(front)
        for _, figure in pictures(results):
            pdf.savefig(figure, dpi=150)
            plt.close(figure)


def main(argv):
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("results", metavar="STUDY", nargs="+", help="folder of results, or result files (.h5)")
    p.add_argument("-o", "--output", metavar="REPORT", help="file to write: .html or .pdf (default: report.html "
                                                            "in the folder of the first result)")
    arguments = p.parse_args(argv)
    results = results_of(arguments.results)
    output = arguments.output or os.path.join(os.path.dirname(results[0].path), "report.html")
    kind = os.path.splitext(output)[1].lower()
    if kind not in (".html", ".pdf"):
        raise InputError(f"{output}: a report is .html or .pdf")
    # Aside first: what fails half-way leaves no half report behind.
    aside = f"{output}.part-{os.getpid()}"
    try:
        if kind == ".html":
            with open(aside, "w", encoding="utf-8") as file:
                write_html(results, file)
        else:
            with open(aside, "wb") as file:
                write_pdf(results, file)
        os.replace(aside, output)
    finally:
        if os.path.exists(aside):
            os.remove(aside)
    print(f"wrote {output}", file=sys.stderr)


if __name__ == "__main__":
    drawing.run(main)
