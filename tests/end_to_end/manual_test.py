#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual that scripts/manual writes: every link leads somewhere, nothing of Markdown is left, it needs no other file;
in headless Chromium no width makes it scroll sideways.

manual_test.py SOURCE_FOLDER read|browser [PACKAGES_OF_THE_VIEWER]
"""

import glob
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

from skip import skip

VOID = {"meta", "input", "img", "br", "hr", "wbr"}
# Elements whose text is no prose.
VERBATIM = {"code", "pre", "script", "style"}
MARKDOWN = re.compile(r"\*\*|`|\]\(|!\[|^\s*#{1,6} |^\s*[-*] \S|\n\d+\. \S|\|\s*-{3,}|(?<!\w)\*\w[^*]*\w\*|&(?:amp|lt|gt|quot);", re.MULTILINE)
# Of a window: a large one, a tablet, a phone, a small one; and A4 less its margins.
WIDTHS = [1280, 800, 390, 320]
PRINTED = 703


class Reader(html.parser.HTMLParser):
    """What a page has and links to; elements that are not closed, or closed twice."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.sources, self.unbalanced, self.raw, self.open = [], [], [], [], [], []
        self.counts = {}
        self.feed(text)
        self.close()
        self.unbalanced += self.open

    def handle_starttag(self, tag, attrs):
        named = dict(attrs)
        self.counts[tag] = self.counts.get(tag, 0) + 1
        self.ids += [named["id"]] if "id" in named else []
        self.links += [named["href"]] if "href" in named else []
        self.sources += [named["src"]] if "src" in named else []
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag in VOID:
            return
        if self.open and self.open[-1] == tag:
            self.open.pop()
        else:
            self.unbalanced.append("/" + tag)

    def handle_data(self, data):
        if not VERBATIM.intersection(self.open):
            self.raw += [data.strip() for found in [MARKDOWN.search(data)] if found]


def faults(text):
    """What is wrong with a page, by kind."""
    page = Reader(text)
    inner = [link[1:] for link in page.links if link.startswith("#")]
    return {kind: found for kind, found in {
        "twice": sorted({name for name in page.ids if page.ids.count(name) > 1}),
        "nowhere": [name for name in inner if name not in page.ids],
        "not of this file": [link for link in page.links if not re.match(r"#|https?:|mailto:", link)]
                            + [source[:40] for source in page.sources if not source.startswith("data:image/")],
        "unbalanced": page.unbalanced,
        "Markdown": page.raw}.items() if found}


def manual(source, folder):
    ran = subprocess.run([os.path.join(source, "scripts/manual"), "-o", folder], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                         encoding="utf-8")
    if ran.returncode == 3:
        skip("python3-markdown-it is not installed")
    assert ran.returncode == 0, ran.stdout
    return ran.stdout.strip()


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def expect_whole(source, text):
    """All pages are there, with all that they show."""
    page = Reader(text)
    paths = [path for pattern in ("README.md", "docs/*.md", "docs/developer/*.md", "configs/*.yaml", "configs/mcrad/*.yaml")
             for path in glob.glob(os.path.join(source, pattern))]
    said = re.findall(r'<p class="path">[^<]*<code>([^<]*)</code>', text)
    missing = {os.path.relpath(path, source) for path in paths} - set(said)
    assert not missing and len(said) == len(set(said)) == page.counts["article"], (missing, said)
    pages = [text_of(path) for path in paths if path.endswith(".md")]
    pictures = sum(len(re.findall(r"^!\[", one, re.MULTILINE)) for one in pages)
    tables = sum(len(re.findall(r"^\|[-|: ]+\|$", one, re.MULTILINE)) for one in pages)
    assert page.counts["img"] >= pictures > 5, (page.counts["img"], pictures)
    assert page.counts["table"] >= tables > 50, (page.counts["table"], tables)
    # Signs of equations, and what a cell escapes.
    for words in ("∫ L cosθ dω", "Σ_j F_ij B_j", "--facades|--objects"):
        assert words in re.sub(r"<[^>]*>", "", text), words


def expect_faults_seen():
    fault = ('<p id="a"><a href="#b">x</a><a href="#a">y</a><a href="docs/view.md">z</a><img src="a.png"></p><p id="a">'
             "a **word** that <code>**is**</code> not</p><div>")
    assert faults(fault) == {"twice": ["a"], "nowhere": ["b"], "not of this file": ["docs/view.md", "a.png"], "unbalanced": ["div"],
                             "Markdown": ["a **word** that"]}, faults(fault)
    for raw in ("see [a](b)", "| --- | --- |", "## two", "- one", "an *old* one", "a `code`", "a &amp;lt; b", "Tests:\n1. one"):
        assert faults(f"<p>{raw}</p>") == {"Markdown": [raw.replace("&amp;", "&")]}, raw
    assert not faults("<p>2 * 3 * 4, 5 # 6, W m-2, a_b_c</p>")


def expect_refusal(source, folder):
    """A page that links to a heading that is not there is refused by its name."""
    copy = os.path.join(folder, "copy")
    os.mkdir(copy)
    for name in os.listdir(source):
        if name in ("docs", "scripts"):  # where it finds itself, and what is changed
            shutil.copytree(os.path.join(source, name), os.path.join(copy, name), ignore=shutil.ignore_patterns("__pycache__"))
        else:
            os.symlink(os.path.join(source, name), os.path.join(copy, name))
    with open(os.path.join(copy, "docs/view.md"), "a", encoding="utf-8") as page:
        page.write("\n[far](render.md#no-such-heading)\n")
    ran = subprocess.run([os.path.join(copy, "scripts/manual"), "-o", folder], stderr=subprocess.PIPE, encoding="utf-8")
    assert ran.returncode == 2 and "docs/view.md: render.md#no-such-heading" in ran.stderr, (ran.returncode, ran.stderr)


def expect_read(source, folder):
    text = text_of(manual(source, folder))
    expect_faults_seen()
    assert not faults(text), faults(text)
    expect_whole(source, text)
    with open(os.path.join(folder, "again"), "w", encoding="utf-8") as again:
        again.write(text)
    assert text_of(manual(source, folder)) == text_of(again.name), "the same pages make another file"
    expect_refusal(source, folder)


def expect_browser(source, packages, folder):
    import view_test
    why = view_test.missing(packages)
    if why:
        skip(why)
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    probe = os.path.join(os.path.dirname(os.path.abspath(__file__)), "manual_probe.mjs")
    seen = json.loads(view_test.run(["node", probe, packages, chromium, manual(source, folder), json.dumps([*WIDTHS, PRINTED])]))
    assert seen["errors"] == [] and seen["requests"] == [], (seen["errors"], seen["requests"])
    for at in seen["widths"]:
        assert at["scrolls"] <= at["width"], f"{at['width']} wide, {at['media']}: the page is {at['scrolls']} wide"
        assert at["pictures"] == 0, f"{at['pictures']} pictures are not drawn"
        # Contents stand beside the text where there is room, behind the button on a phone, before the text in print.
        assert at["contents"] == (at["media"] == "print" or at["width"] > 1000), at
    assert seen["marked"] == ["The study file"] and seen["top"] < 60, seen
    assert seen["found"] and all("shadow" in words.lower() for words in seen["found"]), seen["found"]
    assert seen["opened"] and not seen["closed"], "the contents of a phone do not open, or stay open"


def main():
    source, what = os.path.abspath(sys.argv[1]), sys.argv[2]
    with tempfile.TemporaryDirectory(prefix="sunload-manual-") as folder:
        if what == "read":
            expect_read(source, folder)
        else:
            expect_browser(source, os.path.abspath(sys.argv[3]), folder)


main()
