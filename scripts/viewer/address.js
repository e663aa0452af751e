// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is shown as words of the address, so that a view can be sent: #view=side&quantity=…
// Words that the page does not know or cannot show are left out.

const clean = (x) => Number(x.toFixed(3));

function entryWord({ of, name, n, patch, sensor }) {
  return [of, ...(of === "patch" ? [n, patch] : of === "sensor" ? [n, sensor] : [name])].map((part) => encodeURIComponent(part)).join(":");
}

function entryOf(word, results) {
  const [of, ...rest] = word.split(":").map(decodeURIComponent), [n, index] = rest.map(Number);
  if (of === "patch") return index >= 0 && index < (results[n]?.patches ?? 0) ? { of, n, patch: index } : null;
  if (of === "sensor") return index >= 0 && index < (results[n]?.sensors?.count ?? 0) ? { of, n, sensor: index } : null;
  if (of === "pattern") return rest[0] ? { of, name: rest[0] } : null;
  const names = { facade: (r) => r.geometry.facade_name, object: (r) => r.geometry.object_name, surface: (r) => r.surfaceNames() }[of];
  return names && results.some((result) => names(result).includes(rest[0])) ? { of, name: rest[0] } : null;
}

export function timeWord(result, k) {
  return result.is_synthetic ? String(k) : result.times[k].local_begin.slice(0, 16);
}

/** `state` and the camera's place [m, in the coordinates of the study] in words. */
export function addressOf(state, usual, result, camera) {
  const words = [];
  const add = (name, value, isUsual = value === usual[name]) => isUsual || words.push(`${name}=${encodeURIComponent(value).replaceAll("%3A", ":").replaceAll("%2C", ",")}`);
  for (const name of ["view", "quantity", "colours", "scale", "shading", "lines", "chart", "takes", "shade"]) add(name, state[name]);
  for (const name of ["edges", "path"]) add(name, Number(state[name]), state[name] === usual[name]);
  add("crease", state.crease);
  add("time", timeWord(result, state.k), state.k === usual.k);
  for (const [key, value] of Object.entries(state.limits)) words.push(`limit.${encodeURIComponent(key)}=${value}`);
  add("fold", [...state.folded].sort().join(","));
  if (state.picked.length) words.push(`select=${state.picked.map(entryWord).join(",")}`);
  if (camera.isMoved) words.push(`camera=${[camera.mode, ...camera.numbers.map(clean)].join(",")}`);
  return words.join("&");
}

/** What an address asks for, as far as these results have it: parts of the state, and `camera`. */
export function readAddress(text, results, has) {
  const asked = { limits: {} };
  for (const word of text.replace(/^#/, "").split("&")) {
    const at = word.indexOf("="), name = word.slice(0, at);
    let value;
    try {
      value = decodeURIComponent(word.slice(at + 1));
      if (name === "select") asked.picked = word.slice(at + 1).split(",").map((one) => entryOf(one, results)).filter(Boolean);
    } catch {
      continue;
    }
    if (at < 1) continue;
    if (["view", "quantity", "colours", "shading", "lines", "takes", "shade"].includes(name) && has(name, value)) asked[name] = value;
    else if (["edges", "path"].includes(name) && /^[01]$/.test(value)) asked[name] = value === "1";
    else if (name === "scale" && ["linear", "log"].includes(value)) asked.scale = value;
    else if (name === "chart") asked.chart = value;
    else if (name === "crease" && Number(value) >= 0 && Number(value) <= 180) asked.crease = Number(value);
    else if (name === "fold") asked.folded = new Set(value.split(",").filter((one) => one === "left" || one === "foot"));
    else if (name.startsWith("limit.") && Number(value) > 0) asked.limits[decodeURIComponent(name.slice(6))] = Number(value);
    else if (name === "time") {
      const k = results[0].times.findIndex((_, i) => timeWord(results[0], i) === value);
      if (k >= 0) asked.k = k;
    } else if (name === "camera") {
      const [mode, ...numbers] = value.split(",");
      if ((mode === "orbit" || mode === "walk") && numbers.length === 6 && numbers.every((x) => x !== "" && Number.isFinite(Number(x)))) asked.camera = { mode, numbers: numbers.map(Number) };
    }
  }
  return asked;
}
