#!/usr/bin/env python3
# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The plot scripts on a small study: pictures that are not blank, data that are those of the file.

plots_test.py SUNLOAD SOURCE_FOLDER
"""

import base64
import csv
import datetime
import io
import json
import os
import re
import runpy
import shutil
import subprocess
import sys
import tempfile
import traceback

from skip import skip
from small_study import SQUARE

STUDY = """format: sunload-study-1
name: square
site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague, north_deg: 20}
period: {days: [2026-03-21, 2026-06-21], step_min: 60}
light: {source: clear_sky}
scene:
  files: [square.obj]
  materials: {paving: {diffuse: 0.3}, plaster: {diffuse: 0.6}, glass: {diffuse: 0.05, mirror: 0.85}}
mesh: {max_edge_m: 3}
solver: {lines_per_patch: 64, batch_suns: 16}
variants:
  - {name: baseline}
  - {name: bright, scene: {materials: {paving: {diffuse: 0.8}}}}
"""
SCRIPTS = ("facade_map", "series", "carpet", "months", "sun_path", "compare_bars", "samples", "report")


class Plots:
    """The scripts, called as users do, but that Python with all its packages is there already: to start it takes longer
    than most pictures."""

    def __init__(self, source, folder):
        self.scripts, self.folder = os.path.join(source, "scripts/plot"), folder

    def run(self, script, *words):
        with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
            child = os.fork()
            if child == 0:
                os.dup2(out.fileno(), 1)
                os.dup2(err.fileno(), 2)
                self.become(script, *words)
            _, status = os.waitpid(child, 0)
            out.seek(0)
            err.seek(0)
            return subprocess.CompletedProcess(words, os.waitstatus_to_exitcode(status), out.read(), err.read())

    def become(self, script, *words):
        """Never returns."""
        code = 1
        sys.stdout, sys.stderr = open(1, "w", encoding="utf-8"), open(2, "w", encoding="utf-8")
        sys.argv = [os.path.join(self.scripts, script + ".py"), *words]
        os.chdir(self.folder)
        try:
            runpy.run_path(sys.argv[0], run_name="__main__")
            code = 0
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else int(end.code is not None)
            if isinstance(end.code, str):
                print(end.code, file=sys.stderr)
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)

    def rows(self, script, *words):
        """What a script says that it drew, after a look at the picture."""
        picture = os.path.join(self.folder, script + ".png")
        ran = self.run(script, *words, "-o", picture, "--csv", "-", "--dpi", "80")
        assert ran.returncode == 0, f"{script}: {ran.returncode}\n{ran.stderr}"
        assert_not_blank(picture)
        return list(csv.DictReader(io.StringIO(ran.stdout)))


def assert_not_blank(picture):
    import matplotlib.image
    pixels = matplotlib.image.imread(picture)[..., :3]
    colours = np.unique((pixels.reshape(-1, 3) * 255).round().astype(int), axis=0)
    painted = (np.abs(pixels - pixels[0, 0]).max(axis=2) > 0.02).mean()
    assert len(colours) > 20 and painted > 0.03, f"{picture}: {len(colours)} colours, {painted:.1%} painted"


def close(one, other, share=1e-6):
    assert np.allclose(np.asarray(one, float), np.asarray(other, float), rtol=share, atol=1e-9), (one, other)


def column(rows, name):
    return np.array([float(row[name]) for row in rows])


def facade_means(result, name, facade):
    mine = np.flatnonzero(result["patch_facade"][...] == facade)
    area = result["patch_area"][...][mine]
    return result[name][...][..., mine].astype(float) @ area / area.sum()


def test_facade_map(plots, path, result):
    rows = plots.rows("facade_map", path)
    patches = column(rows, "patch").astype(int)
    assert sorted(patches) == list(np.flatnonzero(result["patch_facade"][...] >= 0))
    close(column(rows, "light_load"), result["light_load"][...][patches])
    centroid = result["patch_centroid"][...][patches]
    # The glass front looks to -y: who faces it has +x to the right and z up.
    front = result["patch_normal"][...][patches][:, 1] < -0.99
    close(column(rows, "right_m")[front], centroid[front, 0] + 4, 1e-4)
    close(column(rows, "up_m"), centroid[:, 2] - 0.01, 1e-4)
    azimuth = column(rows, "azimuth_deg")
    close(azimuth[front], np.full(front.sum(), 200.0))
    # Who walks on to the right comes to the wall that looks 90° further east.
    order = [azimuth[k] for k in range(len(azimuth)) if k == 0 or azimuth[k] != azimuth[k - 1]]
    close(order, [290, 200, 110, 20])
    at_noon = plots.rows("facade_map", path, "--quantity", "irradiance", "--time", "2026-06-21T13:00")
    stored = result["irradiance"][24 + 13]
    close(column(at_noon, "irradiance"), stored[patches])


def test_facade_map_drawing(path):
    """The artists, not the listing: every triangle has the value of its patch."""
    from types import SimpleNamespace

    import facade_map
    import reading
    chosen = SimpleNamespace(quantity="light_load", time=None, facade=["house/south_1"], colour="false", max=None)
    opened = reading.Result(path)
    figure, rows = facade_map.draw(opened, chosen)
    collection = figure.axes[0].collections[0]
    drawn = {(round(x, 4), round(y, 4)): value for (x, y), value in
             zip([p.vertices[:3].mean(axis=0) for p in collection.get_paths()], collection.get_array())}
    lines = list(rows)[1:]
    left = min(x for x, _ in drawn) - min(line[3] for line in lines)
    low = min(y for _, y in drawn) - min(line[4] for line in lines)
    assert len(drawn) == len(lines)
    for line in lines:
        nearest = min(drawn, key=lambda place: abs(place[0] - left - line[3]) + abs(place[1] - low - line[4]))
        close(drawn[nearest], line[6])


def box(first, low, high):
    """Faces of a box as OBJ, without a floor; `first`: number of its first vertex."""
    corners = [(x, y, z) for z in (low[2], high[2]) for x, y in
               ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))]
    faces = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6, 7)]
    return "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + \
        "".join("f " + " ".join(str(first + k) for k in face) + "\n" for face in faces)


def test_facade_map_of_tower(sunload, folder):
    """No picture is higher than readers open, labels stand apart, and what is small is left to who asks for it."""
    with open(os.path.join(folder, "tower.obj"), "w") as file:
        file.write("o tower\nusemtl plaster\n" + box(1, (0, 0, 0), (9, 9, 600)) + "o shed\n" + box(9, (30, 0, 0), (33, 3, 3))
                   + "o step\n" + box(17, (60, 0, 0), (90, 20, 100)) + box(25, (60, 0, 100), (75, 20, 200)))
    study = STUDY[:STUDY.index("variants")].replace("name: square", "name: tower").replace("square.obj", "tower.obj") \
        .replace("days: [2026-03-21, 2026-06-21], step_min: 60", "instants: [2026-06-21T09:00]") \
        .replace("paving: {diffuse: 0.3}, ", "").replace(", glass: {diffuse: 0.05, mirror: 0.85}", "").replace("edge_m: 3", "edge_m: 40")
    path = run_study(sunload, folder, "tower", study)
    figure, heading = drawn("facade_map", path, quantity="light_load")
    axes = figure.axes[0]
    assert figure.get_figheight() < 15 and "9 of 13 facades" in heading and "white between its parts" in heading, heading
    assert not any("shed" in text.get_text() for text in axes.texts)
    figure.canvas.draw()
    boxes = [text.get_window_extent() for text in axes.texts]
    assert not any(one.overlaps(two) for k, one in enumerate(boxes) for two in boxes[:k])
    figure, heading = drawn("facade_map", path, quantity="light_load", facade=["shed/*"])
    assert sum("shed" in text.get_text() for text in figure.axes[0].texts) == 4 and "white" not in heading, heading


def test_long_names(sunload, path, other):
    """Names leave the plot its room."""
    from types import SimpleNamespace

    import compare_bars
    import drawing
    import program
    import reading
    import series
    long = "a_name_that_somebody_might_really_give_to_it_because_nobody_said_that_it_should_not_be_long"

    class Named(reading.Result):
        def attribute(self, name, default=""):
            return super().attribute(name, default) + (long if name in ("variant", "study") else "")

        def names(self, name):
            return [f"{long}/{text}" for text in super().names(name)]
    figure, _ = compare_bars.draw([Named(path), Named(other)], SimpleNamespace(by="surface", group=[]), program.Program(sunload))
    figure.canvas.draw()
    left, right = figure.axes
    assert min(axes.get_window_extent().width for axes in (left, right)) > figure.bbox.width / 5
    assert not left.xaxis.label.get_window_extent().overlaps(right.xaxis.label.get_window_extent())
    assert figure._suptitle.get_window_extent().x1 < figure.bbox.width
    figure, _ = series.draw(Named(path), SimpleNamespace(facade=[], patch=[], sensor=[], quantity=None, step="day"))
    figure.canvas.draw()
    assert figure.axes[0].get_window_extent().width > figure.bbox.width / 2
    # Numbers of tall pictures stand above, too.
    for high in (4, 40):
        figure, axes = drawing.plt.subplots(figsize=(11, high))
        compare_bars.name_axis(axes, "light load")
        assert axes.get_title(loc="center") == ("light load" if high == 40 else "")
        assert axes.xaxis.get_major_ticks()[0].label2.get_visible() == (high == 40)


def test_series(plots, path, result):
    facade = [name.decode() for name in result["facade_name"][...]].index("house/south_1")
    rows = plots.rows("series", path, "--facade", "house/south_1", "--patch", "3")
    close(column(rows, "irradiance of house/south_1"), result["facade_irradiance"][:, facade], 1e-5)
    owner = [name for name in rows[0] if "patch 3" in name]
    close(column(rows, owner[0]), result["irradiance"][:, 3])
    assert rows[0]["begin"] == "2026-03-21T00:00:00+01:00", rows[0]["begin"]
    assert rows[24]["begin"] == "2026-06-21T00:00:00+02:00", rows[24]["begin"]
    days = plots.rows("series", path, "--facade", "house/south_1", "--step", "day")
    assert len(days) == 2
    close(column(days, "irradiance of house/south_1").sum(), result["facade_light_load"][facade], 1e-5)


def test_series_without_dates(sunload, folder):
    """Suns by their positions are counted: no half of one stands below the axis."""
    path = run_study(sunload, folder, "positions", re.sub(
        r"site:.*\nperiod:.*\nlight:.*\n", "period: {positions: [{azimuth_deg: 90, elevation_deg: 20}, {azimuth_deg: 180, elevation_deg: 40}]}\n"
        "light: {source: fixed, dni_w_m2: 700, dhi_w_m2: 100}\n", STUDY[:STUDY.index("variants")])
        .replace("name: square", "name: positions"))
    figure, _ = drawn("series", path)
    assert all(place == int(place) for place in figure.axes[0].get_xticks()), figure.axes[0].get_xticks()


def test_carpet(plots, path, result):
    facade = [name.decode() for name in result["facade_name"][...]].index("house/east_1")
    rows = plots.rows("carpet", path, "--facade", "house/east_1")
    name = "irradiance of house/east_1"
    close(column(rows, name), facade_means(result, "irradiance", facade))
    # A wall that looks to 110° has its sun before noon, an hour later by the clock in summer.
    brightest = [max((row for row in rows if row["day"] == day), key=lambda row: float(row[name]))
                 for day in ("2026-03-21", "2026-06-21")]
    assert all(7 <= float(row["begin_hour"]) <= 11 for row in brightest), brightest
    assert_sunrise(path, result)


def assert_sunrise(path, result):
    """The sun of an interval stands at the middle of its sunlit part: there are sunrise and sunset at its other end."""
    figure, _ = drawn("carpet", path, facade=["house/east_1"])
    lines = sorted({(line.get_xdata()[0], line.get_ydata()[0]) for line in figure.axes[0].lines})
    midnight = [result["time_bounds"][24 * day, 0] for day in (0, 1)]
    is_up, time, bounds = result["sun_elevation"][...] > 0, result["time"][...], result["time_bounds"][...]
    expected = []
    for day in (0, 1):
        first, *_, last = [k for k in range(24 * day, 24 * (day + 1)) if is_up[k]]
        expected += [(day, (2 * time[first] - bounds[first, 1] - midnight[day]) / 3600),
                     (day, (2 * time[last] - bounds[last, 0] - midnight[day]) / 3600)]
    assert len(lines) == len(expected) and np.abs(np.array(lines) - expected).max() < 2 / 60, (lines, expected)
    assert [text.get_text() for text in figure.axes[0].get_legend().get_texts()] == ["sunrise, sunset"]


def assert_labels_apart(axes):
    """Names below the axis do not touch."""
    axes.figure.canvas.draw()
    boxes = [label.get_window_extent() for label in axes.get_xticklabels() if label.get_text()]
    assert len(boxes) > 3 and all(one.x1 < two.x0 for one, two in zip(boxes, boxes[1:])), boxes


def test_months(plots, path, result):
    rows = plots.rows("months", path, "--facade", "house/*")
    names = [name.decode() for name in result["facade_name"][...]]
    assert [row["month"] for row in rows[::len(names)]] == ["2026-03", "2026-06"]
    for k, name in enumerate(names):
        mine = [row for row in rows if row["target"] == name]
        close(column(mine, "sum").sum(), result["facade_light_load"][k], 1e-5)
        close(column(mine, "irradiance_sky").sum(), facade_means(result, "light_load_sky", k), 1e-5)


def run_study(sunload, folder, name, text):
    """Path of the result of a study's variant baseline."""
    with open(os.path.join(folder, f"{name}.yaml"), "w", encoding="utf-8") as file:
        file.write(text)
    ran = subprocess.run([sunload, "run", f"{name}.yaml"], cwd=folder, stderr=subprocess.PIPE, text=True)
    assert ran.returncode == 0, ran.stderr
    return os.path.join(folder, f"results/{name}/baseline.h5")


def drawn(script, path, **chosen):
    """The figure of a script, and its heading as one line."""
    import importlib
    from types import SimpleNamespace

    import reading
    arguments = {"facade": [], "patch": [], "sensor": [], "quantity": None, "time": None, "colour": "false", "max": None,
                 "step": "auto", "horizon": None, **chosen}
    figure, _ = importlib.import_module(script).draw(reading.Result(path), SimpleNamespace(**arguments))
    return figure, " ".join(figure._suptitle.get_text().split())


def test_months_of_days(sunload, folder):
    """A day of each month: all have bars, and titles the whole load."""
    import months
    days = [f"2026-{month:02}-21" for month in range(1, 13)]
    path = run_study(sunload, folder, "days", STUDY[:STUDY.index("variants")].replace("name: square", "name: days")
                     .replace("2026-03-21, 2026-06-21", ", ".join(days)))
    figure, heading = drawn("months", path)
    told = json.loads(subprocess.run([sunload, "info", path, "--facades", "--json"], stdout=subprocess.PIPE, text=True,
                                     check=True).stdout)
    loads = {row["name"]: row["light_load_kwh_m2"] for row in told["rows"]}
    panels = [axes for axes in figure.axes if axes.get_title(loc="left")]
    assert len(panels) == 4
    for axes in panels:
        name, _, rest = axes.get_title(loc="left").rpartition(": ")
        assert len(axes.get_xticks()) == 12, name
        close(float(rest.split()[0]), loads[name], 1e-3)
    assert "without a bar" not in heading
    assert_labels_apart(drawn("carpet", path)[0].axes[0])
    hours = np.diag([1.0, *[720.0] * 11, 14.0])
    assert list(months.months_worth_a_bar(hours)) == list(range(1, 12))
    assert list(months.months_worth_a_bar(np.diag([24.0, 720.0, 720.0]))) == [0, 1, 2]
    assert months.words_of_stray([(2025, 12), (2026, 1), (2026, 2)], np.diag([1.0, 720.0, 672.0]), [1, 2]) == \
        "; without a bar, but in the sums: 1 h of 2025-12"


def test_months_of_some_parts(plots, sunload, folder):
    """Where the total and one part are stored the bars are the total, as where all parts are."""
    with open(os.path.join(folder, "square.yaml")) as file:
        text = file.read()
    with open(os.path.join(folder, "parts.yaml"), "w") as file:
        file.write(text.replace("name: square", "name: parts", 1).replace(
            "variants:", "output: {series: [total, direct]}\nvariants:"))
    ran = subprocess.run([sunload, "run", "parts.yaml", "--variant", "baseline"], cwd=folder,
                         stderr=subprocess.PIPE, text=True)
    assert ran.returncode == 0, ran.stderr
    path = os.path.join(folder, "results/parts/baseline.h5")
    rows = plots.rows("months", path, "--facade", "house/*")
    with h5py.File(path, "r") as result:
        for k, name in enumerate(name.decode() for name in result["facade_name"][...]):
            mine = [row for row in rows if row["target"] == name]
            close(column(mine, "sum").sum(), result["facade_light_load"][k], 1e-5)
            close(column(mine, "irradiance_direct").sum(), facade_means(result, "light_load_direct", k), 1e-5)
            assert column(mine, "other parts, not stored").sum() > 0, name


def test_months_of_rounded_series(sunload, folder):
    """What the rounding of series leaves of the whole is no part that is not stored."""
    with open(os.path.join(folder, "square.yaml")) as file:
        text = file.read()
    path = run_study(sunload, folder, "rounded", text[:text.index("variants")].replace("name: square", "name: rounded", 1) +
                     "output: {significant_bits: 5}\n")
    figure, _ = drawn("months", path)
    words = [entry.get_text() for legend in [*figure.legends, *(axes.get_legend() for axes in figure.axes)] if legend
             for entry in legend.get_texts()]
    assert "direct" in words and "other parts, not stored" not in words, words


def test_sun_path(plots, path, result):
    import sun_path
    close(sun_path.place(90, 0), (1, 0))    # east is right
    close(sun_path.place(0, 90), (0, 0))
    close(sun_path.place(180, 30), (0, -np.tan(np.radians(30))))
    patch = int(np.argmax(result["sun_hours"][...]))
    rows = plots.rows("sun_path", path, "--patch", str(patch))
    close(column(rows, "irradiance_direct"), result["irradiance_direct"][:, patch])
    full = result["dni"][...] * (result["sun_direction"][...] @ result["patch_normal"][patch])
    direct = result["irradiance_direct"][:, patch]
    close(column(rows, "lit_share"), np.where(direct > 0, direct / np.where(direct > 0, full, 1), 0), 1e-5)
    close(column(rows, "azimuth_deg"), result["sun_azimuth"][...])
    rows = plots.rows("sun_path", path, "--facade", "house/east_1")
    lit, elevation = column(rows, "lit_share") > 0.5, column(rows, "elevation_deg")
    bearing = np.cos(np.radians(column(rows, "azimuth_deg") - 110))
    assert lit.sum() > 5 and (bearing[lit] > 0).all() and not lit[elevation < 0].any()


HILLS = "azimuth_deg,elevation_deg\n0,5\n90,25\n180,12\n270,10\n"


def test_sun_path_with_hills(plots, sunload, folder):
    """Hills are those of the study's file; suns behind them are told apart."""
    import hills
    with open(os.path.join(folder, "hills.csv"), "w") as file:
        file.write(HILLS)
    text = STUDY[:STUDY.index("variants")].replace("name: square", "name: hills").replace("2026-03-21, 2026-06-21", "2026-12-21") \
        .replace("north_deg: 20", "north_deg: 20, horizon: hills.csv  # of the town\n ")
    path = run_study(sunload, folder, "hills", text)
    figure, heading = drawn("sun_path", path)
    with h5py.File(path, "r") as result:
        azimuth, elevation = result["sun_azimuth"][...], result["sun_elevation"][...]
        assert hills.name_in(result["study_yaml"][()].decode()) == "hills.csv"
    is_hidden = (elevation > 0) & (elevation <= np.interp(azimuth, [0, 90, 180, 270, 360], [5, 25, 12, 10, 5]))
    dots = {dots.get_label(): len(dots.get_offsets()) for dots in figure.axes[0].collections}
    assert 0 < is_hidden.sum() < (elevation > 0).sum() and dots["behind far hills"] == is_hidden.sum(), dots
    assert f"above the far hills in those of {(elevation > 0).sum() - is_hidden.sum()} h" in heading, heading
    assert "house/south_1" in heading and "of 4 facades the one with most sun" in heading, heading
    # As PVGIS writes them, from south; and nowhere.
    with open(os.path.join(folder, "hills.csv"), "w") as file:
        file.write("Latitude: 49.7\n\nA\tH_hor\n-180\t5\n-90\t25\n0\t12\n90\t10\n\nA: Azimuth\n")
    close(hills.read_hills(os.path.join(folder, "hills.csv")).at([0, 45, 90, 180, 270, 315]), [5, 15, 25, 12, 10, 7.5])
    plots.rows("sun_path", path, "--horizon", "hills.csv")
    os.remove(os.path.join(folder, "hills.csv"))
    assert "far hills are not drawn: hills.csv is not found" in drawn("sun_path", path)[1]
    dark = run_study(sunload, folder, "dark", text.replace("name: hills", "name: dark").replace(", horizon: hills.csv", "")
                     .replace("source: clear_sky", "source: fixed, dni_w_m2: 0, dhi_w_m2: 100"))
    assert "of 4 facades the one with most light" in drawn("sun_path", dark)[1]
    assert drawn("sun_path", dark, facade=["house/north_1"])[1].count("facades") == 0


def test_compare(plots, sunload, path, other):
    import compare_bars
    # Quantiles of Student's t for 95 %: Abramowitz and Stegun (1964), table 26.10.
    close([compare_bars.student_t(1), compare_bars.student_t(7), compare_bars.student_t(30)],
          [12.706, 2.365, 2.042], 5e-4)
    listed = subprocess.run([sunload, "compare", path, other, "--csv"], stdout=subprocess.PIPE, text=True,
                            check=True).stdout
    for by in ("facade", "object", "surface"):
        rows = plots.rows("compare_bars", path, other, "--by", by)
        expected = {row["name"]: row for row in csv.DictReader(io.StringIO(listed)) if row["group"] == by}
        assert {row["name"] for row in rows} == set(expected)
        for row in rows:
            for name in ("base_kwh_m2", "variant_kwh_m2", "difference_kwh_m2", "se_kwh_m2", "area_m2"):
                close(float(row[name]), float(expected[row["name"]][name]), 1e-4)
            assert row["paired"] == expected[row["name"]]["paired"] == "true"
            close(float(row["whisker_kwh_m2"]), compare_bars.student_t(7) * float(row["se_kwh_m2"]) +
                  float(row["mesh_error_kwh_m2"]), 1e-4)


def test_samples(plots, sunload, folder):
    counts = (16, 64, 256, 1024)
    with open(os.path.join(folder, "lines.yaml"), "w", encoding="utf-8") as file:
        file.write(STUDY[:STUDY.index("variants")].replace("name: square", "name: lines") + f"matrix: {{solver.lines_per_patch: {list(counts)}}}\n")
    subprocess.run([sunload, "run", "lines.yaml"], cwd=folder, check=True, stderr=subprocess.PIPE)
    results = [os.path.join(folder, f"results/lines/lines_per_patch-{count}.h5") for count in counts]
    # Errors that fall by a known law, and their noise.
    with open(os.path.join(folder, "errors.csv"), "w", encoding="utf-8") as file:
        file.write("sampler,what,samples,error\n" + "".join(f"random,flat,{n},{0.3 * n**-0.5}\n" for n in counts))
    rows = plots.rows("samples", *results, "--quantity", "light_load_sky", "--errors", os.path.join(folder, "errors.csv"))
    flat = [row for row in rows if row["what"] == "flat"]
    close(column(flat, "slope"), -0.5)
    close(column(flat, "slope_se"), 0)
    ours = [row for row in rows if row["name"] == "lines"]
    assert [int(row["samples"]) for row in ours] == list(counts)
    for row, path in zip(ours, results):
        with h5py.File(path, "r") as result:
            area, load = result["patch_area"][...], result["light_load_sky"][...]
            errors = result["light_load_sky_se"][...]
        close(float(row["error_share"]), np.sqrt(np.average(errors**2, weights=area)) / np.average(load, weights=area))
    # Scrambled Sobol points do better than random ones.
    assert float(ours[0]["slope"]) < -0.55, ours[0]
    few = plots.run("samples", *results[:2], "--quantity", "light_load_sky")
    assert few.returncode == 2 and "needs 3" in few.stderr, few.stderr
    none = plots.run("samples", *results, "--quantity", "light_load_lamps")
    assert none.returncode == 2, none.stderr


def test_report(plots, folder):
    page = os.path.join(folder, "report.html")
    ran = plots.run("report", os.path.join(folder, "results/square"), "-o", page)
    assert ran.returncode == 0, ran.stderr
    text = open(page, encoding="utf-8").read()
    pictures = re.findall(r'<h2>(.*?)</h2><img alt=".*?" src="data:image/png;base64,([^"]+)"', text)
    assert [name for name, _ in pictures] == [
        "baseline: the scene", "bright minus baseline: the difference", "Variants"] + [
        f"{variant}: {what}" for variant in ("baseline", "bright")
        for what in ("facades", "time series", "months", "hours in the sun")], [name for name, _ in pictures]
    for name, data in pictures:
        picture = os.path.join(folder, "embedded.png")
        with open(picture, "wb") as file:
            file.write(base64.b64decode(data))
        assert_not_blank(picture)
    assert text.count("<table>") == 1 and text.index("the difference</h2>") < text.index("<table>") < text.index("Variants</h2>")
    assert re.search(r"mean load, wall</td><td>[\d.]+ ± [\de.-]+ kWh/m²</td><td>[^<]+ \([+-][\d.]+ % where both are\)</td>", text), text[:3000]
    # Letters of a picture may spell anything.
    assert "http" not in re.sub(r"base64,[A-Za-z0-9+/=]+", "", text), "the page wants the network"
    page = os.path.join(folder, "report.pdf")
    assert plots.run("report", os.path.join(folder, "results/square"), "-o", page).returncode == 0
    data = open(page, "rb").read()
    assert data.startswith(b"%PDF") and len(re.findall(rb"/Type /Page\b", data)) == 1 + len(pictures)


def test_report_has_one_scale(sunload, path, other):
    """Each difference is drawn on a scale that does for the others."""
    import program
    import report
    from reading import Result

    class Recorder(program.Program):
        calls = []

        def run(self, *words):
            self.calls.append(words)
            return super().run(*words)
    names = [name for name, _ in report.scene_pictures([Result(path), Result(other), Result(path)], Recorder(sunload))]
    drawn_scenes = [words for words in Recorder.calls if words[0] == "render"]
    assert len(names) == len(drawn_scenes) == 3, names
    assert "--same-scale" not in drawn_scenes[0]
    for one, two in (drawn_scenes[1:], drawn_scenes[:0:-1]):
        assert one[-2:] == ("--same-scale", two[1]) and one[1] != two[1], drawn_scenes


def test_program_beside(source, folder):
    """Installed scripts find the program that was installed with them."""
    plot, bin_folder = (os.path.join(folder, "prefix", name) for name in ("share/sunload/scripts/plot", "bin"))
    shutil.copytree(os.path.join(source, "scripts/plot"), plot)
    os.makedirs(bin_folder)
    installed = os.path.join(bin_folder, "sunload")
    with open(installed, "w") as file:
        file.write("#!/bin/sh\n")
    os.chmod(installed, 0o755)
    environment = {name: value for name, value in os.environ.items() if name != "SUNLOAD"}
    ran = subprocess.run([sys.executable, "-c", "import program; print(program.Program().path)"], env=environment,
                         cwd=plot, stdout=subprocess.PIPE, text=True, check=True)
    assert ran.stdout.strip() == os.path.realpath(installed), ran.stdout


def test_report_without_series(plots, sunload, folder):
    """The first variant of the study is the base whatever its name, and what needs a series is left out."""
    study = STUDY[:STUDY.index("variants")].replace("name: square", "name: totals") + """output: {series: none}
variants:
  - {name: zeta}
  - {name: alpha, scene: {materials: {paving: {diffuse: 0.8}}}}
"""
    with open(os.path.join(folder, "totals.yaml"), "w") as file:
        file.write(study)
    subprocess.run([sunload, "run", "totals.yaml"], cwd=folder, stderr=subprocess.PIPE, check=True)
    page = os.path.join(folder, "totals.html")
    ran = plots.run("report", os.path.join(folder, "results/totals"), "-o", page)
    assert ran.returncode == 0, ran.stderr
    text = open(page, encoding="utf-8").read()
    assert re.findall("<h2>(.*?)</h2>", text) == [
        "zeta: the scene", "alpha minus zeta: the difference", "Variants"] + [
        f"{variant}: {what}" for variant in ("zeta", "alpha") for what in ("facades", "months")], text[:500]
    import drawing
    cells = ["=1+1", "-2e3", "+house", "house_1", 2.5]
    assert [drawing.csv_cell(cell) for cell in cells] == ["'=1+1", "-2e3", "'+house", "house_1", "2.5"]


def test_interpreter(source, folder):
    """Another python3 without the packages stands first on PATH."""
    script, path = os.path.join(source, "scripts/plot/series.py"), os.path.join(folder, "results/square/baseline.h5")
    bare = os.path.join(folder, "bare/bin")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", os.path.dirname(bare)], check=True)
    lines = ["import importlib.util", "assert importlib.util.find_spec('numpy') is None"]
    assert subprocess.run([os.path.join(bare, "python3"), "-c", "\n".join(lines)]).returncode == 0
    environment = {**os.environ, "PATH": bare + os.pathsep + os.environ["PATH"]}
    picture = os.path.join(folder, "by_another.png")
    ran = subprocess.run(["python3", script, path, "-o", picture], env=environment, stderr=subprocess.PIPE, text=True)
    assert ran.returncode == 0 and os.path.exists(picture), ran.stderr
    # None has them: every one asked is told with what it lacks.
    ran = subprocess.run([os.path.join(bare, "python3"), script, path, "-o", picture], stderr=subprocess.PIPE, text=True,
                         env={**environment, "SUNLOAD_PLOT_PYTHON": "taken over already"})
    assert ran.returncode == 3 and "Traceback" not in ran.stderr, ran.stderr
    assert f"{os.path.join(bare, 'python3')}: lacks numpy, h5py, matplotlib" in ran.stderr, ran.stderr


def test_bands(plots, sunload, folder):
    """Of light in bands the mean is drawn."""
    study = STUDY[:STUDY.index("variants")].replace("name: square", "name: colours") \
        .replace("batch_suns: 16", "batch_suns: 16, bands: rgb").replace("{diffuse: 0.6}", "{diffuse: [0.8, 0.6, 0.4]}")
    with open(os.path.join(folder, "colours.yaml"), "w") as file:
        file.write(study)
    subprocess.run([sunload, "run", "colours.yaml"], cwd=folder, stderr=subprocess.PIPE, check=True)
    path = os.path.join(folder, "results/colours/baseline.h5")
    with h5py.File(path, "r") as result:
        rows = plots.rows("series", path, "--facade", "house/south_1", "--patch", "3")
        facade = [name.decode() for name in result["facade_name"][...]].index("house/south_1")
        close(column(rows, "irradiance of house/south_1"), result["facade_irradiance"][:, :, facade].mean(axis=1), 1e-5)
        owner = [name for name in rows[0] if "patch 3" in name]
        close(column(rows, owner[0]), result["irradiance"][:, :, 3].mean(axis=1))
        rows = plots.rows("facade_map", path)
        close(column(rows, "light_load"), result["light_load"][...].mean(axis=0)[column(rows, "patch").astype(int)])
    import reading
    assert reading.Result(path).title.endswith("mean of the bands")
    ran = plots.run("report", path, "-o", os.path.join(folder, "colours.html"))
    assert ran.returncode == 0, ran.stderr


def test_letters(plots, sunload, folder):
    """What the usual font lacks comes from another one, or is told once."""
    import fonts
    import matplotlib.font_manager
    from matplotlib.ft2font import FT2Font

    def letters_in(name):
        return set(FT2Font(matplotlib.font_manager.findfont(name)).get_charmap())
    # Both come with Matplotlib.
    rare = {chr(min(letters_in("STIXGeneral") - letters_in("DejaVu Sans")))}
    names, missing = fonts.found_for(rare)
    assert len(names) == 1 and not missing and min(map(ord, rare)) in letters_in(names[0]), names
    # No letter of this plane is ever given away (Unicode: private use).
    assert fonts.found_for({"\U0010fffd"}) == ([], {"\U0010fffd"})
    with open(os.path.join(folder, "letters.obj"), "w", encoding="utf-8") as file:
        file.write(SQUARE.replace("o house", "o 家屋\U0010fffd"))
    path = run_study(sunload, folder, "letters", STUDY[:STUDY.index("variants")].replace("name: square", "name: letters")
                     .replace("square.obj", "letters.obj").replace("2026-03-21, ", ""))
    for script, words in (("series", [path]), ("report", [path, "-o", os.path.join(folder, "letters.html")])):
        ran = plots.run(script, *words)
        assert ran.returncode == 0 and "Warning" not in ran.stderr, ran.stderr
        assert ran.stderr.count("no installed font has ") == 1 and "\U0010fffd: boxes" in ran.stderr, ran.stderr


def test_signs_and_offsets(plots, sunload, folder):
    """Names with signs that mean a formula elsewhere; a zone that is an offset alone."""
    with open(os.path.join(folder, "signs.obj"), "w", encoding="utf-8") as file:
        file.write(SQUARE.replace("o house", "o h$_{$x^"))
    study = STUDY[:STUDY.index("variants")].replace("name: square", "name: signs").replace("square.obj", "signs.obj")
    path = run_study(sunload, folder, "signs", re.sub(r"timezone: [A-Za-z/]+", 'timezone: "+05:45"', study))
    for script in ("series", "facade_map", "carpet", "sun_path"):
        ran = plots.run(script, path, "-o", os.path.join(folder, f"signs_{script}.png"))
        assert ran.returncode == 0, ran.stderr
    import reading
    offset = reading.fixed_offset("-03:30")
    assert offset.utcoffset(None) == datetime.timedelta(hours=-3, minutes=-30) and reading.fixed_offset("UTC") is None


def test_numbers():
    import drawing
    assert [drawing.number(value, digits) for value, digits in ((77234.5, 4), (99.7, 2), (-1.2345e6, 3), (0.0321, 2))] == \
        ["77230", "100", "-1230000", "0.032"]


def test_wrong_input(plots, path, folder):
    empty = os.path.join(folder, "empty")
    os.makedirs(empty)
    for script, words, says in (
            ("series", ["missing.h5"], "missing.h5"),
            ("series", ["square.yaml"], "HDF5"),
            ("facade_map", [path, "--quantity", "light_lode"], "choose one of diffuse_reflectance, irradiance_max, light_load"),
            ("facade_map", [path, "--quantity", "irradiance", "--time", "2027-01-01T12:00"], "no interval"),
            ("facade_map", [path, "--quantity", "irradiance", "--time", "noon"], "ISO 8601"),
            ("facade_map", [path, "--facade", "tower*"], "house/"),
            ("facade_map", [path, "-o", "picture.xyz"], ".png"),
            ("carpet", [path, "--patch", "100000"], "no patch 100000"),
            ("carpet", [path, "--sensor", "0"], "sensors"),
            ("months", [path, "--quantity", "facade_area"], "choose one of"),
            ("sun_path", [path, "--facade", "*"], "name one"),
            ("compare_bars", [path], "nothing to compare"),
            ("report", [empty], "no result"),
            ("report", [path, "-o", "report.doc"], ".html or .pdf"),
            ("carpet", [path, "--max", "-1"], "above 0")):
        ran = plots.run(script, *words)
        assert ran.returncode == 2 and says in ran.stderr and "Traceback" not in ran.stderr, \
            f"{script} {words}: {ran.returncode}\n{ran.stderr}"
    ran = plots.run("series", path, "-o", os.path.join(folder, "no/such/folder.png"))
    assert ran.returncode == 3 and "folder.png" in ran.stderr, ran.stderr
    for script in SCRIPTS:
        ran = plots.run(script, "--help")
        assert ran.returncode == 0 and "usage:" in ran.stdout, script


def test(sunload, source, folder):
    sys.dont_write_bytecode = True
    sys.path.insert(0, os.path.join(source, "scripts/plot"))
    for name, text in (("square.obj", SQUARE), ("square.yaml", STUDY)):
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)
    ran = subprocess.run([sunload, "run", "square.yaml"], cwd=folder, stderr=subprocess.PIPE, text=True)
    assert ran.returncode == 0, ran.stderr
    path, other = (os.path.join(folder, f"results/square/{name}.h5") for name in ("baseline", "bright"))
    import drawing  # noqa: F401: what all scripts take longest to import
    plots = Plots(source, folder)
    os.environ["SUNLOAD"] = sunload
    test_interpreter(source, folder)
    with h5py.File(path, "r") as result:
        for check in (test_facade_map, test_series, test_carpet, test_months, test_sun_path):
            check(plots, path, result)
            print(f"{check.__name__}: as in the file")
    test_months_of_some_parts(plots, sunload, folder)
    test_months_of_rounded_series(sunload, folder)
    test_series_without_dates(sunload, folder)
    test_numbers()
    test_months_of_days(sunload, folder)
    test_facade_map_drawing(path)
    test_facade_map_of_tower(sunload, folder)
    test_long_names(sunload, path, other)
    test_sun_path_with_hills(plots, sunload, folder)
    test_compare(plots, sunload, path, other)
    test_report(plots, folder)
    test_report_has_one_scale(sunload, path, other)
    test_program_beside(source, folder)
    test_report_without_series(plots, sunload, folder)
    test_letters(plots, sunload, folder)
    test_signs_and_offsets(plots, sunload, folder)
    test_wrong_input(plots, path, folder)
    test_samples(plots, sunload, folder)
    test_bands(plots, sunload, folder)
    print("comparison, report and wrong input: as they should be")


def main():
    if missing:
        skip(missing)
    with tempfile.TemporaryDirectory(prefix="sunload-plots-") as folder:
        test(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), folder)


try:
    import h5py
    import matplotlib  # noqa: F401
    import numpy as np
    missing = ""
except ImportError as error:
    missing = f"{error.name} is not installed (python3-h5py, python3-matplotlib)"

if __name__ == "__main__":
    main()
