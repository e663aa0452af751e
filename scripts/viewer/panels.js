// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the page says beside the picture: time, and values and charts of what is chosen.
import { chartNames, chartsOf, curveColours, drawBars, drawChart } from "./chart.js";
import { shown } from "./scale.js";
import { meanOver, sameEntry, selectedPatches, selectionText } from "./selection.js";

export const $ = (id) => document.getElementById(id);
// What is built has no values; it is a choice among the quantities all the same.
export const preview = "preview", materials = "materials", kinds = "surfaces";
export const isShape = (quantity) => [preview, materials, kinds].includes(quantity);

export function tellTime(viewer) {
  const result = viewer.results[0], time = result.times[viewer.state.k];
  const sun = `sun ${time.azimuth.toFixed(0)}° from north, ${time.elevation.toFixed(1)}° high`;
  const dark = time.elevation > 0 ? sun : "sun below the horizon";
  // No one sun stands for a day or a month.
  const told = result.has_sun ? `, ${dark}` : ", mean";
  $("clock").textContent = clockText(result, viewer.state.k) + told + outsideText(result, time);
  // A total is not of the slider's time: sun and chart are.
  $("time").classList.toggle("aside", viewer.state.quantity !== result.series?.name);
  $("slider").value = viewer.state.k;
  $("slider").setAttribute("aria-valuetext", $("clock").textContent);
}

/** Whether a time is in the part of the period that totals are of. */
function outsideText({ part }, { share }) {
  if (!part || share >= 1) return "";
  return share > 0 ? `, in part in ${part}` : `, outside of ${part}`;
}

export function clockText(result, k) {
  const time = result.times[k];
  return result.is_synthetic ? `position ${k * result.step + 1}` :
    `${time.local_begin.slice(0, 16).replace("T", " ")} – ${endText(result, time)} ${result.timezone}`;
}

/** Its hour, or of days and months all of it. */
function endText(result, time) {
  return result.has_sun ? time.local_end.slice(11, 16) : time.local_end.slice(0, 16).replace("T", " ");
}

/** Text that may go on in another line after _, / and . of its names, so that their words are not broken. */
export function breakable(text) {
  const pieces = String(text).split(/(?<=[_/.])(?=\p{L})/u);
  return pieces.flatMap((piece, n) => (n ? [document.createElement("wbr"), piece] : [piece]));
}

export function tellSelection(viewer) {
  const { picked } = viewer.state;
  $("patch").hidden = !picked.length;
  // Before the chart is drawn, which asks how wide it is.
  document.body.classList.toggle("no-patch", !picked.length);
  if (!picked.length) return;
  $("chosen").replaceChildren(...breakable(selectionText(picked)));
  showWidening(viewer);
  const sensor = picked.length === 1 && picked[0].of === "sensor" ? picked[0] : null;
  const told = sensor ? sensorTold(viewer, sensor) : patchesTold(viewer);
  showRows(told.rows);
  showCharts(viewer, told);
}

/** From a patch to its facade and object: buttons. */
function showWidening(viewer) {
  const { picked } = viewer.state, wider = [];
  for (const { of, n, patch } of picked.slice(-1)) {
    if (of !== "patch") continue;
    const names = viewer.results[n].patchNames(patch);
    for (const kind of ["facade", "object"]) if (names[kind]) wider.push({ of: kind, name: names[kind] });
  }
  if (picked.length === 1 && picked[0].of === "facade") {
    for (const result of viewer.results) {
      const facade = result.geometry.facade_name.indexOf(picked[0].name), patch = result.patch_facade.indexOf(facade);
      const entry = facade >= 0 && patch >= 0 && { of: "object", name: result.patchNames(patch).object };
      if (entry && entry.name && !wider.some((one) => sameEntry(one, entry))) wider.push(entry);
    }
  }
  $("widen").replaceChildren(...wider.map((entry) => {
    const button = Object.assign(document.createElement("button"), { title: `choose this ${entry.of}` });
    button.append(...breakable(`${entry.of} ${entry.name}`));
    button.addEventListener("click", () => viewer.choose([entry]));
    return button;
  }));
}

function patchesTold(viewer) {
  const { picked } = viewer.state, { results } = viewer;
  const single = picked.length === 1 ? picked[0] : null, sets = results.map((_, m) => selectedPatches(viewer, picked, m));
  const which = results.map((_, m) => m).filter((m) => sets[m].length), rows = [];
  if (single?.of === "patch") {
    const result = results[single.n], names = Object.entries(result.patchNames(single.patch));
    rows.push(["patch", [single.patch]], ...names.filter(([, name]) => name !== "").map(([what, name]) => [what, [name]]),
      ["area", [`${shown(result.patch_area[single.patch])} m²`]]);
  } else {
    if (results.length > 1) rows.push(["", which.map((m) => results[m].label)]);
    rows.push(...describedRows(viewer, single, sets, which));
  }
  if (results.length > 1 && single?.of === "patch") rows.push(["", which.map((m) => results[m].label)]);
  rows.push(...valueRows(viewer, single, sets, which));
  const series = which.map((m) => seriesOf(results[m], picked)).find(Boolean);
  return { rows, curves: series ? curvesOf(viewer, sets, which, series.name) : [], units: series ? `${series.name} [${series.units}]` : "",
    stored: storedSums(viewer, sets, which) };
}

/** Charts of stored totals: those of all results, exact where series have rounded values or are missing. */
function storedSums(viewer, sets, which) {
  const charts = {};
  for (const [chart, name] of [["days", "day"], ["months", "month"]]) {
    const own = which.map((m) => viewer.results[m].divisions.find((division) => division.name === name));
    if (!own.length || own.some((division) => !division || String(division.parts) !== String(own[0].parts))) continue;
    charts[chart] = { names: own[0].parts, labels: which.map((m) => viewer.results[m].label), values: which.map((m, i) => {
      const result = viewer.results[m];
      return own[0].parts.map((_, at) => meanOver(sets[m], result.patch_area, (p) => own[i].values[at * result.patches + p]));
    }) };
  }
  return charts;
}

/** The series that a selection has: facades have one of their own, which is there where patches have none. */
function seriesOf(result, picked) {
  return (picked.every((entry) => entry.of === "facade") && result.facade_series) || result.series;
}

/** One value per interval of a result: the mean over facades, or over patches. */
function meansOverTime(result, picked, patches) {
  if (seriesOf(result, picked) === result.series) return Float64Array.from(result.times, (_, i) => meanOver(patches, result.patch_area, (p) => result.seriesValue(i, p)));
  const facades = picked.map((entry) => result.geometry.facade_name.indexOf(entry.name)).filter((facade) => facade >= 0);
  return Float64Array.from(result.times, (_, i) => meanOver(facades, result.geometry.facade_area, (facade) => result.facadeValue(i, facade)));
}

/** Curves of a selection; kept while it stays, because time may play. */
function curvesOf(viewer, sets, which, name) {
  const { picked } = viewer.state, { results } = viewer, key = JSON.stringify(picked), { times } = results[0];
  if (viewer.curves?.key === key) return viewer.curves.list;
  const list = which.filter((m) => seriesOf(results[m], picked)?.name === name).map((m) => {
    const result = results[m], values = meansOverTime(result, picked, sets[m]);
    return { label: result.label, times: result.times, values, step: result.step, shown: m === 0 ? values : times.map((time) => values[result.intervalAt(time)] ?? NaN) };
  });
  viewer.curves = { key, list };
  return list;
}

/** What is chosen, without light. */
function describedRows(viewer, single, sets, which) {
  const { results } = viewer, areaOf = (m) => sets[m].reduce((sum, p) => sum + results[m].patch_area[p], 0), rows = [];
  const facade = single?.of === "facade" ? which.map((m) => results[m].geometry.facade_azimuth?.[results[m].geometry.facade_name.indexOf(single.name)]) : [];
  if (facade.some(Number.isFinite)) rows.push(["azimuth", facade.map((azimuth) => `${shown(azimuth, 3)}°`)]);
  rows.push(["patches", which.map((m) => sets[m].length)], ["area", which.map((m) => `${shown(areaOf(m))} m²`)]);
  return rows;
}

/** Series travel with 11 bits: three digits. Errors of parts are no mean of those of patches. */
function valueRows(viewer, single, sets, which) {
  const { results } = viewer, isGroup = single?.of !== "patch";
  const names = [...results[0].totals.map((total) => total.name), ...(results[0].series ? [results[0].series.name] : [])];
  return names.flatMap((name) => {
    const units = results[0].units(name), digits = name === results[0].series?.name ? 3 : 4, lists = which.map((m) => viewer.valuesOf(m, name));
    const means = which.map((m, i) => meanOver(sets[m], results[m].patch_area, (p) => lists[i][p]));
    const row = (what, values, key) => [what, values.map((value) => shown(value, digits)), key];
    const head = `${name.replaceAll("_", " ")} ${units && `[${units}]`}`;
    if (!isGroup) return [row(head, means, name)];
    if (name === "light_load_se") {
      const errors = which.map((m) => (single?.of === "facade" ? results[m].geometry.facade_light_load_se?.[results[m].geometry.facade_name.indexOf(single.name)] : NaN));
      return errors.some(Number.isFinite) ? [row(`error of the mean [${units}]`, errors, name)] : [];
    }
    if (name.endsWith("_se")) return [];
    const isLargest = name.endsWith("_max"), largest = which.map((m, i) => sets[m].reduce((most, p) => (lists[i][p] > most ? lists[i][p] : most), -Infinity));
    if (isLargest) return [row(`${head}, largest`, largest, name)];
    const sum = units === "kWh/m²" && name === "light_load" ? [row("energy [kWh]", means.map((mean, i) => mean * sets[which[i]].reduce((all, p) => all + results[which[i]].patch_area[p], 0)), "energy")] : [];
    return [row(head, means, name), ...sum];
  });
}

function sensorTold(viewer, { n, sensor }) {
  const { k } = viewer.state, result = viewer.results[n], { sensors } = result;
  const at = [0, 1, 2].map((axis) => String(Number((sensors.position[3 * sensor + axis] + result.geometry.centre[axis] + (result.origin?.[axis] ?? 0)).toFixed(3))));
  const rows = [["sensor", [sensor]], ["position [m]", [at.join(", ")]]];
  const own = n === 0 ? k : result.intervalAt(viewer.results[0].times[k]);
  for (const name of [...sensors.totals.map((total) => total.name), ...(sensors.series ? [sensors.series.name] : [])]) {
    const units = sensors.units(name), values = sensors.values(name, own);
    rows.push([`${name.replaceAll("_", " ")} ${units && `[${units}]`}`, [values ? shown(values[sensor], sensors.series?.name === name ? 3 : 4) : "not known"], name]);
  }
  if (!sensors.series) return { rows, curves: [], units: "" };
  const values = Float64Array.from(result.times, (_, i) => sensors.seriesValue(i, sensor)), { times } = viewer.results[0];
  return { rows, units: `${sensors.series.name} [${sensors.series.units}]`, curves: [{ label: result.label, times: result.times, values, step: result.step,
    shown: n === 0 ? values : times.map((time) => values[result.intervalAt(time)] ?? NaN) }] };
}

function showRows(rows) {
  $("values").replaceChildren(...rows.map(([what, values, name]) => {
    const row = document.createElement("tr");
    if (name) row.dataset.quantity = name;
    for (const text of [what, ...values]) {
      const cell = document.createElement("td");
      cell.append(...breakable(text));
      row.append(cell);
    }
    return row;
  }));
}

/** The chart that is chosen, and buttons for the others. */
function showCharts(viewer, { curves, units, stored = {} }) {
  const { state } = viewer, possible = [...new Set([...(curves.length ? chartsOf(viewer.results[0]) : []), ...Object.keys(stored)])];
  const kind = possible.includes(state.chart) ? state.chart : possible[0];
  $("series").hidden = $("chart-says").hidden = !kind;
  $("charts").replaceChildren(...(possible.length > 1 ? possible : []).map((one) => {
    const button = Object.assign(document.createElement("button"), { textContent: chartNames[one] });
    button.setAttribute("role", "tab");
    button.setAttribute("aria-selected", one === kind);
    button.dataset.chart = one;
    button.addEventListener("click", () => viewer.change({ chart: one }));
    return button;
  }));
  if (!kind) return;
  const bars = stored[kind];
  viewer.chart = { kind, ...(bars ? drawBars($("series"), kind, bars) : drawChart($("series"), kind, viewer.results[0].times, state.k, curves)) };
  sayChart(viewer.results[0], kind, bars ? bars.labels.map((label) => ({ label, step: 1 })) : curves, units);
}

function sayChart({ part }, kind, curves, units) {
  const energy = units.includes("lx") ? "light exposure [klx h]" : "light load [kWh/m²]";
  const what = { day: units, hours: `${units}, mean of each hour`, days: `${energy} of each day`, months: `${energy} of each month` }[kind];
  const says = [Object.assign(document.createElement("span"), { textContent: what.replaceAll("_", " ") })];
  if (curves.length > 1) curves.forEach((curve, n) => {
    const label = Object.assign(document.createElement("b"), { style: `color: ${curveColours[n]}` });
    label.append(...breakable(`${n ? "- -" : "—"} ${curve.label}`));
    says.push(" ", label);
  });
  if (curves.some((curve) => curve.step > 1)) says.push(` (from every ${curves[0].step}. interval)`);
  if (part) says.push(`; of all the period, not of ${part} alone`);
  $("chart-says").replaceChildren(...says);
}
