// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Opens a page of `sunload view` in a real browser, uses it, and tells what it saw as JSON:
//   node view_probe.mjs FOLDER_OF_PLAYWRIGHT CHROMIUM PAGE FOLDER_OF_PICTURES [match|one|fly]
// one: a page of one result, only looked at.
// fly: share of each facade that is seen from where the camera flies to.
// match: only what the second result brings onto the patches of the first.
import { join } from "node:path";
import { Browser, picture as draw } from "./view_browser.mjs";

const [modules, chromium, page, pictures, mode] = process.argv.slice(2);
const picture = (tab, name) => draw(tab, join(pictures, `${name}.png`));
const seen = { patches: [], clicks: [], times: {} };

const browser = await Browser.start(modules, chromium, seen);
try {
  const started = Date.now(), tab = await browser.open(`file://${page}`);
  seen.loadSeconds = (Date.now() - started) / 1000;
  await { match, one, fly, undefined: use }[mode](tab);
} finally {
  await browser.close();
}
console.log(JSON.stringify(seen));

async function set(tab, id, value) {
  await tab.selectOption(`#${id}`, value);
}

async function setTime(tab, k) {
  await tab.locator("#slider").evaluate((slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event("input"));
  }, k);
}

/** Patches of the first result that a pixel and those around it show, spread over the scene, not under a box. */
function visiblePatches(tab, most) {
  return tab.evaluate((count) => {
    const viewer = window.sunload, patches = viewer.results[0].patches, found = [];
    for (let k = 0; k < 40 * count && found.length < count; ++k) {
      const patch = (k * 7919) % patches, place = viewer.placeOf(patch);
      const x = Math.floor(place.x) + 0.5, y = Math.floor(place.y) + 0.5;
      if (document.elementFromPoint(x, y)?.id !== "scene") continue;
      const around = [[0, 0], [3, 0], [-3, 0], [0, 3], [0, -3]];
      if (around.every(([dx, dy]) => viewer.patchAt(x + dx, y + dy)?.patch === patch)) found.push({ patch, x, y });
    }
    return found;
  }, most);
}

async function one(tab) {
  seen.clock = await tab.textContent("#clock");
  seen.slider = await tab.getAttribute("#slider", "max");
  seen.patches = await visiblePatches(tab, 5);
  await tab.evaluate(() => { window.sunload.sky.object.visible = false; });
  seen.limit = await tab.evaluate(() => window.sunload.limit());
  await picture(tab, "one");
}

async function fly(tab) {
  seen.flights = await tab.evaluate(() => {
    const viewer = window.sunload, [result] = viewer.results, shares = {};
    result.geometry.facade_name.forEach((name, of) => {
      viewer.flyTo([{ of: "facade", name }]);
      viewer.man.fly(0);
      viewer.man.fly(Infinity);
      viewer.render();
      const patches = [...result.patch_facade.keys()].filter((p) => result.patch_facade[p] === of), places = patches.map((p) => viewer.placeOf(p));
      shares[name] = places.filter((at, k) => viewer.patchAt(at.x, at.y)?.patch === patches[k]).length / patches.length;
    });
    return shares;
  });
}

async function match(tab) {
  seen.unmatchedShare = await tab.evaluate(() => window.sunload.unmatchedShare);
  seen.differences = await tab.evaluate(() => [...window.sunload.difference(window.sunload.valuesOf(0, "light_load"), window.sunload.valuesOf(1, "light_load"))]);
  await tab.evaluate(() => { window.sunload.change({ quantity: "materials", view: "side" }); });
  seen.legend = await tab.$$eval("#materials li", (list) => list.map((row) => row.textContent));
  seen.coloursOfMaterials = await tab.evaluate(() => window.sunload.results.map((result) => result.colour_of_material));
  seen.matchedKwh = await tab.evaluate(() => {
    const viewer = window.sunload, own = viewer.valuesOf(0, "light_load");
    return viewer.difference(own, viewer.valuesOf(1, "light_load")).reduce((sum, apart, p) => sum + viewer.results[0].patch_area[p] * (own[p] + apart), 0);
  });
}

async function use(tab) {
  const count = await tab.evaluate(() => window.sunload.results.length);
  seen.title = await tab.textContent("#title");
  seen.unmatchedShare = await tab.evaluate(() => (window.sunload.match ? window.sunload.unmatchedShare : 1));
  if (count > 1) {
    await picture(tab, "side");
    await set(tab, "view", "0");
  }
  // Nothing in front of the patches but the patches.
  await tab.evaluate(() => { window.sunload.sky.object.visible = false; });
  seen.dayTime = await tab.evaluate(() => window.sunload.state.k);
  seen.limit = await tab.evaluate(() => window.sunload.limit());
  seen.patches = await visiblePatches(tab, 40);
  await picture(tab, "light_load");
  await set(tab, "colours", "grey");
  await picture(tab, "grey");
  await set(tab, "colours", "false");

  // Two patches of the first object and one of another.
  const objects = await tab.evaluate((ids) => ids.map((id) => window.sunload.results[0].patch_object[id]), seen.patches.map((one) => one.patch));
  const chosen = [0, 1, objects.findIndex((object) => object !== objects[0])].filter((k) => k >= 0 && k < objects.length);
  for (const { patch, x, y } of chosen.map((k) => seen.patches[k])) {
    await tab.mouse.click(x, y);
    const rows = await tab.$$eval("#values tr", (list) => list.map((row) => [row.dataset.quantity ?? "", ...[...row.cells].map((cell) => cell.textContent)]));
    seen.clicks.push({ patch, rows });
    await picture(tab, "clicked");
    await tab.click("#close");
  }

  const sensor = await tab.evaluate(() => (window.sunload.results[0].sensors ? window.sunload.placeOfSensor(0) : null));
  if (sensor) {
    await tab.mouse.click(sensor.x, sensor.y);
    await picture(tab, "sensor");
    seen.sensor = { x: sensor.x, y: sensor.y,
      rows: await tab.$$eval("#values tr", (list) => list.map((row) => [row.dataset.quantity ?? "", ...[...row.cells].map((cell) => cell.textContent)])) };
    await tab.click("#close");
  }
  await set(tab, "quantity", "materials");
  seen.materials = await tab.$$eval("#materials li", (list) => list.map((row) => row.textContent));
  await picture(tab, "materials");

  const series = await tab.evaluate(() => window.sunload.results[0].series.name);
  await set(tab, "quantity", series);
  const times = await tab.evaluate(() => window.sunload.results[0].times.length);
  for (const k of [Math.floor(times / 3), Math.floor((2 * times) / 3)]) {
    await setTime(tab, k);
    seen.times[k] = { clock: await tab.textContent("#clock"), limit: await tab.evaluate(() => window.sunload.limit()) };
    await picture(tab, `time-${k}`);
  }
  seen.differenceLimitOfSeries = await tab.evaluate(() => (window.sunload.match ? window.sunload.limit(true) : null));
  await tab.fill("#limit", "123");
  await tab.press("#limit", "Enter");
  seen.userLimit = await tab.evaluate(() => window.sunload.limit());
  await picture(tab, "limit");
  await tab.click("#automatic");

  await set(tab, "shading", "smooth");
  await picture(tab, "smooth");
  await set(tab, "shading", "constant");
  for (const which of ["after", "before"]) {
    await set(tab, "lines", which);
    await picture(tab, `mesh-${which}`);
  }
  await set(tab, "lines", "none");
  await set(tab, "quantity", "preview");
  await picture(tab, "preview");
  await set(tab, "quantity", "light_load");
  if (seen.unmatchedShare < 1) {
    await set(tab, "view", "difference");
    seen.differenceLimit = await tab.evaluate(() => window.sunload.limit());
    await picture(tab, "difference");
    await set(tab, "view", "0");
  }
  await tab.evaluate(() => { window.sunload.sky.object.visible = true; });
  seen.framesPerSecond = await tab.evaluate(() => window.sunload.measuredFrames(20));
  await picture(tab, "orbit");

  await set(tab, "camera", "walk");
  const before = await tab.evaluate(() => window.sunload.man.camera.position.toArray());
  await tab.keyboard.down("w");
  await tab.waitForFunction((start) => Math.hypot(...window.sunload.man.camera.position.toArray().map((x, k) => x - start[k])) > 0.3, before);
  await tab.keyboard.up("w");
  seen.walked = [before, await tab.evaluate(() => window.sunload.man.camera.position.toArray())];
  await picture(tab, "walk");

  await tab.click("#play");
  const shown = await tab.textContent("#clock");
  await tab.waitForFunction((text) => document.getElementById("clock").textContent !== text, shown);
  await tab.click("#play");
  seen.played = [shown, await tab.textContent("#clock")];
}
