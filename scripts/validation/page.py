# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page: a summary, and of each section the rows that come nearest to their limit."""

import csv
import math

WORST = 3, 24  # rows of a section that the page shows: nearest to their limit; farthest off where nothing decides

HEAD = """# Validation

Made by `scripts/validate`, which runs all of it and writes this page and [validation.csv](validation.csv) with every
row. *z*: off in standard errors of our own; over many rows its root mean square is about 1 where error bars are right,
and larger where the reference has roundings or the model a known bias, which the limit holds. *Limit*: Student's t of
the suite's false-alarm budget times the standard error, and the model's own bias from a formula
([design](developer/design.md), Tests), or the tolerance that the reference states. *Told*: nothing decides; both
numbers are here for the reader. Scenes of the sources, with pictures beside what must be seen: [figures](figures.md).

"""


def number(value):
    return "" if value is None else f"{value:.6g}"


def z_of(rows):
    z = [row.z for row in rows if row.z is not None]
    return f"{math.sqrt(sum(v * v for v in z) / len(z)):.2f}" if z else ""


def summary(sections):
    text = "| case | reference | values | tests | largest share of a limit | z, rms | verdict |\n|---|---|---|---|---|---|---|\n"
    for s in sections:
        judged = [row.share_of_limit for row in s.rows if row.limit is not None]
        largest = f"{100 * max(judged):.0f} %" if judged else ""
        text += (f"| {s.name} | {s.source} | {len(s.rows) or ''} | {s.checks or ''} | {largest} | {z_of(s.rows)} "
                 f"| {s.skipped and 'not run: ' + s.skipped or s.verdict} |\n")
    return text


def detail(section):
    if not section.rows:
        return ""
    judged = any(row.limit is not None for row in section.rows)
    if judged:
        rows = sorted(section.rows, key=lambda row: -row.share_of_limit)[:WORST[0]]
    else:
        rows = sorted(section.rows, key=lambda row: -abs(row.off / (row.reference or 1)))[:WORST[1]]
    title = f"\n## {section.name[0].upper()}{section.name[1:]}\n\n"
    if section.said:
        title += section.said + "\n\n"
    if len(rows) < len(section.rows):
        which = "nearest to their limit" if judged else "farthest off"
        title += f"The {len(rows)} {which}, of {len(section.rows)}.\n\n"
    table = "| quantity | reference | ours | ± | off | z | |\n|---|---|---|---|---|---|---|\n"
    for row in rows:
        z = "" if row.z is None else f"{row.z:.2f}"
        verdict = ("holds" if row.holds else "**fails**") if row.limit is not None else ""
        off = f"{100 * row.off / row.reference:+.2f} %" if row.reference else number(row.off)
        table += (f"| {row.case.replace('|', '/')} | {number(row.reference)} | {number(row.ours)} "
                  f"| {row.error and f'{row.error:.2g}' or ''} | {off} | {z} | {verdict} |\n")
    return title + table


def write(sections, page, table):
    with open(page, "w", encoding="utf-8") as file:
        file.write(HEAD + summary(sections) + "".join(detail(s) for s in sections))
    with open(table, "w", encoding="utf-8", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["case", "quantity", "reference", "ours", "standard_error", "limit", "holds"])
        for s in sections:
            for row in s.rows:
                out.writerow([s.name, row.case, f"{row.reference:.9g}", f"{row.ours:.9g}",
                              "" if row.error is None else f"{row.error:.4g}",
                              "" if row.limit is None else f"{row.limit:.4g}", "yes" if row.holds else "no"])
