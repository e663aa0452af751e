// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the page says beside the picture: legend, time and the values of a patch.
import { matchedMean } from "./data.js";
import { drawSeries } from "./plot.js";
import { shown, ticks } from "./scale.js";

export const $ = (id) => document.getElementById(id);
// The preview has no values; it is a choice among the quantities all the same.
export const preview = "preview", materials = "materials";
export const isShape = (quantity) => quantity === preview || quantity === materials;

/** Colours that all eyes tell apart (Okabe & Ito 2008, Color Universal Design), lightened; then darker ones of them. */
const basicColours = ["#d9a441", "#7cc4ea", "#45b592", "#e5dc6a", "#4a90c4", "#dc8b55", "#d79bbf"];
const materialColours = [1, 0.72, 0.5].flatMap((share) => basicColours.map((colour) =>
  [1, 3, 5].map((at) => Math.round(share * parseInt(colour.slice(at, at + 2), 16)))));
export function materialPalette() {
  return Array.from({ length: 256 }, (_, k) => materialColours[k % materialColours.length]).flat();
}
/** A material's place in the palette; -1: none. */
export const materialValue = (index) => (index < 0 ? -1 : index % materialColours.length);

function drawMaterials(viewer) {
  const names = viewer.results[0].geometry.material_name, used = new Set(viewer.results[0].patch_material);
  const shownMost = 12, list = names.map((name, k) => [name, k]).filter(([, k]) => used.has(k));
  $("materials").replaceChildren(...list.slice(0, shownMost).map(([name, k]) => {
    const row = document.createElement("li");
    const swatch = document.createElement("span");
    swatch.style.background = `rgb(${materialColours[materialValue(k)]})`;
    row.append(swatch, name || "without a name");
    return row;
  }), ...(list.length > shownMost ? [`and ${list.length - shownMost} more`] : []));
}

export function drawLegend(viewer, end) {
  const { quantity, colours } = viewer.state;
  $("legend").hidden = isShape(quantity);
  $("materials").hidden = quantity !== materials;
  if (quantity === materials) drawMaterials(viewer);
  if (isShape(quantity)) return;
  const bar = $("bar").getContext("2d"), palette = viewer.palettes[viewer.isDifference() ? "difference" : colours];
  for (let y = 0; y < 256; ++y) {
    bar.fillStyle = `rgb(${palette.slice(3 * (255 - y), 3 * (255 - y) + 3)})`;
    bar.fillRect(0, y, 22, 1);
  }
  const low = viewer.isDifference() ? -end : 0;
  $("ticks").replaceChildren(...ticks(low, end).map((value) => {
    const tick = document.createElement("span");
    tick.textContent = shown(value);
    tick.style.top = `${256 * (1 - (value - low) / (end - low))}px`;
    return tick;
  }));
  $("units").textContent = viewer.results[0].units(quantity) || "share";
  if (document.activeElement !== $("limit")) $("limit").value = end;
  let largest = 0;
  viewer.parts().forEach((part) => viewer.meshes[part.mesh].value.array.forEach((value) => { if (value > largest) largest = value; }));
  $("above").textContent = largest > end * (1 + 1e-6) ? `larger values, up to ${shown(largest)}, have the last colour` : "";
}

export function tellTime(viewer) {
  const result = viewer.results[0], time = result.times[viewer.state.k];
  const sun = `sun ${time.azimuth.toFixed(0)}° from north, ${time.elevation.toFixed(1)}° high`;
  const dark = time.elevation > 0 ? sun : "sun below the horizon";
  const clock = result.is_synthetic ? `position ${viewer.state.k * result.step + 1}` :
    `${time.local_begin.slice(0, 16).replace("T", " ")} – ${time.local_end.slice(11, 16)} ${result.timezone}`;
  $("clock").textContent = `${clock}, ${dark}`;
  $("slider").value = viewer.state.k;
  const isSide = viewer.state.view === "side";
  $("names").children[0].textContent = isSide ? viewer.results[0].label : "";
  $("names").children[1].textContent = isSide ? viewer.results[1].label : "";
}

export function tellPatch(viewer) {
  const { picked, k } = viewer.state;
  $("patch").hidden = !picked;
  if (!picked) return;
  if (picked.sensor !== undefined) return tellSensor(viewer);
  const { n, patch } = picked, result = viewer.results[n];
  // For a patch of the first result also what the second has in its place.
  const hasBoth = n === 0 && viewer.match && viewer.match.first[patch] < viewer.match.first[patch + 1], which = hasBoth ? [0, 1] : [n];
  const valueOf = (m, value) => (m === n ? value(patch) : matchedMean(viewer.match, patch, value));
  const rows = [["patch", patch], ...Object.entries(result.patchNames(patch)),
    ["area", `${shown(result.patch_area[patch])} m²`]].filter(([, value]) => value !== "").map(([name, value]) => [name, [value]]);
  if (viewer.results.length > 1) rows.push(["", which.map((m) => viewer.results[m].label)]);
  const names = [...result.totals.map((total) => total.name), ...(result.series ? [result.series.name] : [])];
  for (const name of names)
    rows.push([`${name.replaceAll("_", " ")} ${result.units(name) && `[${result.units(name)}]`}`,
      which.map((m) => {
        const values = viewer.valuesOf(m, name);
        return shown(valueOf(m, (p) => values[p]), digits(viewer, name));
      }), name]);
  showRows(rows);
  $("series").hidden = !result.series;
  if (!result.series) return;
  const times = viewer.results[0].times;
  const curves = which.map((m) => ({ label: viewer.results[m].label, values: times.map((time, i) => {
    const own = m === 0 ? i : viewer.results[m].intervalAt(time);
    return own >= 0 ? valueOf(m, (p) => viewer.results[m].seriesValue(own, p)) : NaN;
  }) }));
  drawSeries($("series"), times, k, curves, `${result.series.name} [${result.series.units}]`);
}

function showRows(rows) {
  $("values").replaceChildren(...rows.map(([what, values, name]) => {
    const row = document.createElement("tr");
    if (name) row.dataset.quantity = name;
    for (const text of [what, ...values]) {
      const cell = document.createElement("td");
      cell.textContent = text;
      row.append(cell);
    }
    return row;
  }));
}

function tellSensor(viewer) {
  const { picked: { n, sensor }, k } = viewer.state, result = viewer.results[n], { sensors } = result;
  const at = [0, 1, 2].map((axis) => shown(sensors.position[3 * sensor + axis] + result.geometry.centre[axis] + (result.origin?.[axis] ?? 0), 8));
  const rows = [["sensor", [sensor]], ["position [m]", [at.join(", ")]]];
  const own = n === 0 ? k : result.intervalAt(viewer.results[0].times[k]);
  for (const name of [...sensors.totals.map((total) => total.name), ...(sensors.series ? [sensors.series.name] : [])]) {
    const units = sensors.units(name), values = sensors.values(name, own);
    rows.push([`${name.replaceAll("_", " ")} ${units && `[${units}]`}`, [values ? shown(values[sensor], sensors.series?.name === name ? 3 : 4) : "not known"], name]);
  }
  showRows(rows);
  $("series").hidden = !sensors.series;
  if (!sensors.series) return;
  const times = viewer.results[0].times;
  drawSeries($("series"), times, k, [{ label: result.label, values: times.map((time, i) => {
    const interval = n === 0 ? i : result.intervalAt(time);
    return interval >= 0 ? sensors.seriesValue(interval, sensor) : NaN;
  }) }], `${sensors.series.name} [${sensors.series.units}]`);
}

/** Series travel with 11 bits. */
function digits(viewer, name) {
  return name === viewer.results[0].series?.name ? 3 : 4;
}
