// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Uses a page of `sunload view` as people do, and tells what it saw as JSON:
//   node view_use_probe.mjs FOLDER_OF_PLAYWRIGHT CHROMIUM PAGE FOLDER_OF_PICTURES FACADE PAGE_OF_THE_STUDY PAGE_WITHOUT_SERIES PAGE_OF_A_PART PAGE_OF_THE_SOUTH
import { join } from "node:path";
import { Browser, picture as draw } from "./view_browser.mjs";

const [modules, chromium, page, pictures, facade, studyPage, barePage, partPage, southPage] = process.argv.slice(2);
const sizes = [[1280, 720], [600, 900], [900, 420], [400, 760]];
const seen = { layouts: [], charts: {}, keys: {} };
const picture = (tab, name) => draw(tab, join(pictures, `${name}.png`));

const browser = await Browser.start(modules, chromium, seen);
try {
  const tab = await browser.open(`file://${page}`);
  seen.lookedFrom = { day: await lookedFrom(tab) };
  await layouts(tab);
  await found(tab);
  await parts(tab);
  await address(tab);
  await saved(tab);
  await shaded(tab);
  await logarithmic(tab);
  await keys(tab);
  await tab.close();
  await touched(await browser.open(`file://${page}`, { viewport: { width: 400, height: 760 }, hasTouch: true }));
  await ofStudy(await browser.open(`file://${studyPage}`));
  await withoutSeries(await browser.open(`file://${barePage}#select=facade:${encodeURIComponent(facade)}&chart=days`));
  await ofPart(await browser.open(`file://${partPage}#select=facade:${encodeURIComponent(facade)}&chart=months`));
  const south = await browser.open(`file://${southPage}`);
  seen.lookedFrom.south = await lookedFrom(south);
  await south.close();
} finally {
  await browser.close();
}
console.log(JSON.stringify(seen));

/** Rectangles of what can be seen of the panels, of the picture and of its captions. */
function boxes(tab) {
  return tab.evaluate(() => {
    const names = ["head", "left", "patch", "more", "scene", "what", "legend", "time", "pad"], found = {};
    const add = (name, element) => {
      let { left, top, right, bottom } = element.getBoundingClientRect();
      // What a scrolling panel does not show overlaps nothing.
      for (let parent = element.parentElement; parent; parent = parent.parentElement) {
        const rect = parent.getBoundingClientRect();
        if (!/auto|scroll|hidden/.test(getComputedStyle(parent).overflowY)) continue;
        [left, top, right, bottom] = [Math.max(left, rect.left), Math.max(top, rect.top), Math.min(right, rect.right), Math.min(bottom, rect.bottom)];
      }
      if (element.checkVisibility() && right - left > 1 && bottom - top > 1) found[name] = [left, top, right, bottom];
    };
    for (const name of names) add(name, document.getElementById(name));
    // The pictures, without the strips of their captions.
    const canvas = document.getElementById("scene").getBoundingClientRect();
    delete found.scene;
    window.sunload.parts().forEach((part, k) => {
      found[`picture ${k}`] = [canvas.left + part.x, canvas.top + part.y, canvas.left + part.x + part.width, canvas.top + part.y + part.height];
    });
    [...document.querySelectorAll("#names span")].forEach((span, k) => add(`caption ${k}`, span));
    return found;
  });
}

/** Compass bearing of the camera of a whole view; north is +y. */
function lookedFrom(tab) {
  return tab.evaluate(() => {
    const { camera, orbit } = window.sunload.man, way = camera.position.clone().sub(orbit.target);
    return ((Math.atan2(way.x, way.y) * 180) / Math.PI + 360) % 360;
  });
}

async function settled(tab) {
  await tab.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); }));
}

async function layouts(tab) {
  const states = {
    first: {}, chosen: { view: "0", picked: [{ of: "facade", name: facade }] }, side: { view: "side" }, all: { view: "all" },
    kinds: { view: "side", quantity: "surfaces" }, logarithmic: { view: "all", scale: "log" }, folded: { folded: ["left", "foot"] },
  };
  for (const [width, height] of sizes) {
    await tab.setViewportSize({ width, height });
    for (const [name, change] of [...Object.entries(states), ["walk", {}]]) {
      await tab.evaluate(([what, mode]) => {
        const viewer = window.sunload;
        viewer.man.setMode(mode);
        viewer.change({ ...viewer.usual, k: viewer.state.k, picked: [], limits: {}, ...what, folded: new Set(what.folded ?? []) });
      }, [change, name === "walk" ? "walk" : "orbit"]);
      await settled(tab);
      seen.layouts.push({ width, height, name, boxes: await boxes(tab) });
      await picture(tab, `layout-${width}-${name}`);
    }
  }
  // The planted fault: a panel on the picture.
  await tab.setViewportSize({ width: 1280, height: 720 });
  await tab.evaluate(() => {
    window.sunload.man.home();
    window.sunload.change({ folded: new Set() });
    document.getElementById("side").style.position = "fixed";
  });
  await settled(tab);
  seen.onPicture = await boxes(tab);
  await tab.evaluate(() => { document.getElementById("side").style.position = ""; });
  await settled(tab);
}

async function found(tab) {
  const list = () => tab.$$eval("#found li", (rows) => rows.map((row) => row.textContent));
  await tab.selectOption("#view", "0");
  await tab.fill("#find", "hause");
  seen.near = await list();
  await tab.fill("#find", "house/s*");
  seen.pattern = await list();
  await tab.fill("#find", facade);
  await tab.keyboard.press("Enter");
  await tab.waitForFunction(() => !window.sunload.man.flight);
  seen.chosen = await tab.textContent("#chosen");
  seen.rows = await tab.$$eval("#values tr", (rows) => rows.map((row) => [row.dataset.quantity ?? row.cells[0].textContent, ...[...row.cells].slice(1).map((cell) => cell.textContent)]));
  seen.flown = await tab.evaluate((name) => {
    const viewer = window.sunload, [result] = viewer.results, of = result.geometry.facade_name.indexOf(name), part = viewer.parts()[0];
    const patches = [...result.patch_facade.keys()].filter((p) => result.patch_facade[p] === of), places = patches.map((p) => viewer.placeOf(p));
    const rect = viewer.canvas.getBoundingClientRect(), inside = places.filter((at) => Math.abs((2 * (at.x - rect.left)) / part.width - 1) < 1 && Math.abs((2 * (at.y - rect.top)) / part.height - 1) < 1);
    const met = places.filter((at) => result.patch_facade[viewer.patchAt(at.x, at.y)?.patch] === of);
    return { patches: patches.length, inside: inside.length, met: met.length };
  }, facade);
  for (const kind of ["day", "hours", "days", "months"]) {
    await tab.click(`#charts button[data-chart=${kind}]`);
    seen.charts[kind] = await tab.evaluate(() => ({ names: window.sunload.chart.names, values: window.sunload.chart.values, says: document.getElementById("chart-says").textContent }));
    await picture(tab, `chart-${kind}`);
  }
}

/** Stored totals of parts of the period, on the map and in charts. */
async function parts(tab) {
  await tab.evaluate(() => { window.sunload.choose([{ of: "object", name: "house" }]); });
  await tab.click("#charts button[data-chart=months]");
  seen.months = await tab.evaluate(() => ({ names: window.sunload.chart.names, values: window.sunload.chart.values }));
  await tab.selectOption("#quantity", "light_load_by_month:2026-06");
  seen.june = await tab.evaluate(() => ({ values: [...window.sunload.valuesOf(1)], caption: document.getElementById("names").textContent,
    days: [...document.querySelectorAll("#quantity option")].filter((option) => option.value.startsWith("light_load_by_day:")).map((option) => option.textContent) }));
  await tab.selectOption("#quantity", "light_load");
  await tab.evaluate((name) => { window.sunload.choose([{ of: "facade", name }]); }, facade);
}

async function address(tab) {
  await tab.fill("#find", "");
  await tab.evaluate(() => document.activeElement.blur());
  await tab.evaluate(() => {
    const viewer = window.sunload;
    viewer.change({ view: "all", k: 4, scale: "log", lines: "after", limits: { light_load: 3 }, chart: "months", picked: [...viewer.state.picked, { of: "pattern", name: "house/*" }] });
    viewer.man.orbitBy(2, 1, 0.9);
  });
  await settled(tab);
  await picture(tab, "sent");
  await tab.evaluate(() => window.sunload.writeAddress());
  seen.address = await tab.evaluate(() => window.location.href);
  seen.regions = await boxes(tab);
  const other = await browser.open(seen.address);
  await settled(other);
  await picture(other, "received");
  await other.evaluate(() => { window.location.hash = "view=nonsense&quantity=none&time=never&camera=orbit,1,2&select=facade:none,patch:0:99999999&limit.light_load=-1&%E0=1&=&fold=x&scale=cubic"; });
  await settled(other);
  seen.nonsense = await other.evaluate(() => (({ view, quantity, scale }) => ({ view, quantity, scale }))(window.sunload.state));
  await other.close();
}

async function saved(tab) {
  await tab.evaluate(() => { document.activeElement.blur(); });
  const [download] = await Promise.all([tab.waitForEvent("download"), tab.keyboard.press("p")]);
  seen.file = download.suggestedFilename();
  await download.saveAs(join(pictures, "saved.png"));
}

async function shaded(tab) {
  await tab.evaluate(() => {
    window.sunload.man.home();
    window.sunload.change({ view: "0", picked: [], limits: {}, lines: "none", edges: false, path: false, quantity: "light_load", scale: "linear" });
  });
  await settled(tab);
  seen.shades = await tab.evaluate(() => {
    const viewer = window.sunload, [result] = viewer.results, list = [];
    for (let k = 0; k < 4000 && list.length < 60; ++k) {
      const patch = (k * 7919) % result.patches, { x, y } = viewer.placeOf(patch);
      if ([[0, 0], [3, 0], [-3, 0], [0, 3], [0, -3]].every(([dx, dy]) => viewer.patchAt(Math.floor(x) + 0.5 + dx, Math.floor(y) + 0.5 + dy)?.patch === patch))
        list.push({ patch, x: Math.floor(x), y: Math.floor(y), rises: result.patch_normal[3 * patch + 2] });
    }
    return list;
  });
  await picture(tab, "plain");
  await tab.selectOption("#shade", "all");
  await picture(tab, "shaded");
  await tab.selectOption("#shade", "shapes");
}

/** The switch of the legend, by the keyboard and back. */
async function logarithmic(tab) {
  await tab.focus("#scale");
  await tab.keyboard.press("Enter");
  await settled(tab);
  seen.logarithmic = await tab.evaluate(() => ({ limit: window.sunload.limit(), focus: document.activeElement.id, pressed: document.getElementById("scale").getAttribute("aria-pressed"), address: window.sunload.address(),
    ticks: [...document.querySelectorAll("#legend .ticks span")].map((tick) => [Number(tick.textContent), parseFloat(tick.style.left) / 100]), says: document.querySelector("#legend .beyond").textContent }));
  await picture(tab, "logarithmic");
  await tab.evaluate(() => { window.sunload.change({ view: "difference" }); });
  seen.logarithmic.ofDifference = await tab.evaluate(() => ({ limit: window.sunload.limit(), switches: document.querySelectorAll("#scale").length, ticks: [...document.querySelectorAll("#legend .ticks span")].map((tick) => Number(tick.textContent)) }));
  seen.beyond = await tab.evaluate(() => {
    const viewer = window.sunload, quantity = "light_load_se", says = () => document.querySelector("#legend .beyond").textContent;
    viewer.change({ quantity, limits: { [`${quantity} difference`]: 1e-9 } });
    const some = says(), values = viewer.difference(viewer.valuesOf(0), viewer.valuesOf(1));
    viewer.change({ quantity: "light_load", limits: {} });
    return { some, least: values.reduce((a, b) => Math.min(a, b)), most: values.reduce((a, b) => Math.max(a, b)) };
  });
  await tab.evaluate(() => { window.sunload.change({ view: "0" }); });
  await tab.click("#scale");
  seen.logarithmic.after = await tab.evaluate(() => window.sunload.state.scale);
  await picture(tab, "linear");
}

async function keys(tab) {
  const press = async (key, ask) => {
    await tab.evaluate(() => document.activeElement.blur());
    await tab.keyboard.press(key);
    await settled(tab);
    seen.keys[key] = await tab.evaluate(ask);
  };
  await press("3", () => window.sunload.state.view);
  await press(".", () => window.sunload.state.k);
  await press(",", () => window.sunload.state.k);
  await press(" ", () => Boolean(window.sunload.timer));
  await press(" ", () => Boolean(window.sunload.timer));
  await press("h", () => [...window.sunload.state.folded].sort());
  await press("h", () => [...window.sunload.state.folded]);
  await press("w", () => window.sunload.man.mode);
  seen.outdoors = await tab.evaluate(() => window.sunload.isOutdoors(...window.sunload.man.camera.position.toArray().slice(0, 2)));
  await press("o", () => window.sunload.man.mode);
  await press("/", () => document.activeElement.id);
  await press("0", () => window.sunload.man.isMoved);
}

async function touched(tab) {
  const place = await tab.evaluate(() => {
    const viewer = window.sunload;
    viewer.change({ view: "0", takes: "object" });
    const { result = viewer.results[0] } = {}, house = result.geometry.object_name.indexOf("house");
    for (let p = 0; p < result.patches; ++p) {
      const at = viewer.placeOf(p);
      if (result.patch_object[p] === house && viewer.patchAt(at.x, at.y)?.patch === p) return at;
    }
    return null;
  });
  await tab.touchscreen.tap(place.x, place.y);
  seen.tapped = await tab.textContent("#chosen");
  await tab.click("#close");
  await tab.evaluate(() => window.sunload.man.setMode("walk"));
  await tab.evaluate(() => window.sunload.refresh());
  const before = await tab.evaluate(() => window.sunload.man.camera.position.toArray());
  const button = await tab.locator("#pad button[data-way=ahead]").boundingBox();
  await tab.mouse.move(button.x + 5, button.y + 5);
  await tab.mouse.down();
  await tab.waitForFunction((start) => Math.hypot(...window.sunload.man.camera.position.toArray().map((x, k) => x - start[k])) > 0.1, before);
  await tab.mouse.up();
  seen.stands = await tab.evaluate(() => window.sunload.man.keys.size === 0);
  await tab.close();
}

async function ofStudy(tab) {
  seen.study = await tab.evaluate(() => {
    const viewer = window.sunload;
    return { quantities: [...document.querySelectorAll("#quantity option")].map((option) => option.value), quantity: viewer.state.quantity, views: viewer.results.map((result) => result.label),
      kinds: [...document.querySelectorAll("#surfaces li")].map((row) => row.textContent), suns: viewer.sky.arc.children[1].geometry.attributes.position.count, title: document.getElementById("title").textContent };
  });
  await picture(tab, "study");
  await tab.selectOption("#quantity", "materials");
  seen.study.materials = await tab.$$eval("#materials li", (list) => list.map((row) => row.textContent));
  await tab.evaluate(() => { window.sunload.choose([{ of: "object", name: "house" }]); });
  seen.study.chosen = await tab.textContent("#values");
  await tab.close();
}

async function withoutSeries(tab) {
  seen.bare = await tab.evaluate(() => ({ names: window.sunload.chart?.names, values: window.sunload.chart?.values }));
  await tab.evaluate(() => { window.sunload.choose([{ of: "object", name: "house" }]); });
  seen.bareObject = await tab.$$eval("#charts button", (list) => list.map((button) => button.dataset.chart));
  await tab.close();
}

/** Of some hours, and of one band, of the period. */
async function ofPart(tab) {
  const told = () => tab.evaluate(() => ({ clock: document.getElementById("clock").textContent, what: document.getElementById("what").textContent, title: document.getElementById("title").textContent,
    chart: document.getElementById("chart-says").textContent, months: [...document.querySelectorAll("#quantity option")].filter((option) => option.value.startsWith("light_load_by_month:")).map((option) => option.textContent) }));
  seen.part = await told();
  seen.lookedFrom.morning = await lookedFrom(tab);
  await tab.evaluate(() => { window.sunload.change({ k: 0 }); });
  seen.outside = await told();
  await tab.evaluate(() => { window.sunload.change({ quantity: "irradiance" }); });
  seen.series = await told();
  await tab.close();
}
