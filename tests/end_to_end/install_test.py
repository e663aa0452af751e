#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `cmake --install` leaves works where it is: an example found from the prefix, pages of man and of HTML,
completions, the Python package with its module, and a program of somebody else's that is built with
find_package(sunload).

install_test.py SOURCE_FOLDER BUILD_FOLDER CMAKE
"""

import glob
import gzip
import os
import shutil
import subprocess
import sys
import tempfile


def run(words, folder=None):
    ran = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", cwd=folder)
    assert ran.returncode == 0, f"{words}: {ran.returncode}\n{ran.stdout[-2000:]}\n{ran.stderr[-2000:]}"
    return ran.stdout


def expect_example(program, folder):
    """A prefix has all that an example needs, whatever the sources are."""
    run([program, "init", "--example", "street"], folder)
    run([program, "check", "street.yaml", "--no-refine"], folder)
    with open(os.path.join(folder, "street.yaml"), encoding="utf-8") as study:
        assert "sunload-study-1" in study.read()


def expect_manual(prefix, program):
    pages = {os.path.basename(page) for page in glob.glob(os.path.join(prefix, "share/man/man1/*.1.gz"))}
    commands = [line.split()[0] for line in run([program, "--help"]).split("Subcommands:\n")[1].split("\n\n")[0].splitlines()]
    assert pages == {"sunload.1.gz"} | {f"sunload-{command}.1.gz" for command in commands}, pages
    if shutil.which("man"):
        for page in sorted(pages):
            path = os.path.join(prefix, "share/man/man1", page)
            ran = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", path], stdout=subprocess.DEVNULL,
                                 stderr=subprocess.PIPE, encoding="utf-8", env=dict(os.environ, MANWIDTH="80"))
            assert ran.returncode == 0 and not ran.stderr, f"{page}: {ran.stderr}"
    with gzip.open(os.path.join(prefix, "share/man/man1/sunload-run.1.gz"), "rt", encoding="utf-8") as page:
        text = page.read()
    assert "\\-\\-resume" in text and "1 to 4096" in text and "SUNLOAD_THREADS" in text, text


def expect_completions(prefix):
    script = os.path.join(prefix, "share/bash-completion/completions/sunload")
    ask = ('source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _sunload; '
           'printf "%s\\n" "${COMPREPLY[@]}"')
    complete = lambda *words: run(["bash", "-c", ask, "bash", script, *words]).split()
    assert complete("sunload", "re") == ["render"]
    assert complete("sunload", "run", "--res") == ["--resume"]
    assert complete("sunload", "render", "--camera", "t") == ["top"]
    assert complete("sunload", "render", "--scale", "") == ["linear", "log"]
    # Readline takes a word apart at "=".
    assert complete("sunload", "run", "--progress", "=", "b") == ["bar"]
    assert "bar" in complete("sunload", "run", "--progress", "=")
    assert complete("sunload", "export", "--to", "en") == ["energyplus"]
    assert complete("sunload", "scene", "str") == ["street"]
    assert "street" in complete("sunload", "init", "--example", "")
    for shell, name in (("zsh", "zsh/vendor-completions/_sunload"), ("fish", "fish/vendor_completions.d/sunload.fish")):
        if shutil.which(shell):
            run([shell, "-n", os.path.join(prefix, "share", name)])


def expect_html(prefix):
    """All pages as one file, where Debian's Python has what makes it."""
    has = subprocess.run(["/usr/bin/python3", "-c", "import markdown_it"], stderr=subprocess.DEVNULL, check=False).returncode == 0
    page = os.path.join(prefix, "share/doc/sunload/html/sunload.html")
    assert os.path.exists(page) == has, page
    if has:
        with open(page, encoding="utf-8") as file:
            assert "<h1 id=\"tutorial\">" in file.read()


def compiler_flags(build):
    """Of the build: archives with sanitizers want a program with them."""
    with open(os.path.join(build, "CMakeCache.txt"), encoding="utf-8") as cache:
        entries = dict(line.rstrip("\n").split("=", 1) for line in cache if line.startswith("CMAKE_CXX_FLAGS"))
    return " ".join(value for key, value in entries.items() if key.startswith("CMAKE_CXX_FLAGS:") or "-f" in value
                    and key.startswith("CMAKE_CXX_FLAGS_RELWITHDEBINFO:"))


def expect_consumer(prefix, folder, cmake, flags):
    build = os.path.join(folder, "consumer")
    run([cmake, "-S", os.path.join(prefix, "share/doc/sunload/examples/consumer"), "-B", build,
         f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_CXX_FLAGS={flags}"])
    run([cmake, "--build", build])
    rows = [line.split(",") for line in run([os.path.join(build, "consumer")]).splitlines()]
    assert rows[0] == ["patch", "area_m2", "irradiance_w_m2", "standard_error_w_m2"]
    values = [float(row[2]) for row in rows[1:]]
    # Sun of 800 W/m² at 45 degrees and a sky of 100: the brightest place has 566 of the sun, what the sky gives, and of
    # the other face, of reflectance 0.5, less than half as much again. The plane's own back has none.
    assert min(values) == 0 and 566 + 50 < max(values) < 1.5 * (566 + 100), (min(values), max(values))


def expect_absence_told(prefix, folder, cmake):
    """Where a library is missing, find_package tells it, and a project that can do without goes on."""
    source = os.path.join(folder, "without")
    os.makedirs(source)
    with open(os.path.join(source, "CMakeLists.txt"), "w", encoding="utf-8") as file:
        file.write("cmake_minimum_required(VERSION 3.23)\nproject(without CXX)\nfind_package(sunload ${WISH})\n"
                   "message(STATUS \"found: ${sunload_FOUND}, goes on\")\n")
    ask = lambda wish: subprocess.run(
        [cmake, "-S", source, "-B", os.path.join(folder, "without_" + wish), f"-DCMAKE_PREFIX_PATH={prefix}", f"-DWISH={wish}"],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8", check=False,
        env=dict(os.environ, PKG_CONFIG_LIBDIR=folder))
    optional, required = ask("QUIET"), ask("REQUIRED")
    assert optional.returncode == 0 and "found: 0, goes on" in optional.stdout, optional.stdout
    assert required.returncode != 0 and "libgeographiclib-dev" in required.stdout, required.stdout


def expect_python(prefix, build, folder):
    """The package with its compiled module, where the build has one."""
    if not glob.glob(os.path.join(build, "io/python/_native.*.so")):
        return
    script = ("import sunload; solved = sunload.solve([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], 0.3, [[180, 90, 500]]); "
              "print(float(solved.irradiance[0, 0]), sunload.__file__)")
    environment = dict(os.environ, PYTHONPATH=os.path.join(prefix, "lib/python3/dist-packages"), SUNLOAD="/nowhere/sunload")
    ran = subprocess.run(["/usr/bin/python3", "-B", "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                         encoding="utf-8", env=environment, cwd=folder, check=False)
    assert ran.returncode == 0, ran.stderr[-2000:]
    value, place = ran.stdout.split()
    assert abs(float(value) - 500) < 1e-3 and place.startswith(prefix), ran.stdout


def main():
    source, build, cmake = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as folder:
        prefix = os.path.join(folder, "prefix")
        run([cmake, "--install", build, "--prefix", prefix])
        program = os.path.join(prefix, "bin/sunload")
        expect_example(program, folder)
        expect_manual(prefix, program)
        expect_completions(prefix)
        expect_html(prefix)
        for name in ("study.schema.json", "models/town.city.json"):
            installed = os.path.join(prefix, "share/sunload/configs", name)
            with open(installed, "rb") as one, open(os.path.join(source, "configs", name), "rb") as other:
                assert one.read() == other.read()
        run(["/usr/bin/python3", os.path.join(prefix, "share/sunload/scripts/plot/report.py"), "--help"])
        run(["bash", "-n", os.path.join(prefix, "share/sunload/scripts/demo")])
        expect_python(prefix, build, folder)
        expect_consumer(prefix, folder, cmake, compiler_flags(build))
        expect_absence_told(prefix, folder, cmake)


main()
