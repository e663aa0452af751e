// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the colours stand for: a scale of values, or kinds with a swatch each.
import { deepestShade, notKnown } from "./mesh.js";
import { isShape, kinds, preview } from "./panels.js";
import { colourShare, endAbove, isPowerOfTen, leastOfDecades, logarithmicTicks, scaleEnd, shown, ticks, withEnds } from "./scale.js";
import { quantityName, shownText } from "./words.js";

const mostSwatches = 40;

/** What the colours of the pictures stand for. */
export function legendsOf(viewer) {
  const { quantity, colours, shade, limits } = viewer.state, parts = viewer.parts();
  if (quantity === preview) return [];
  if (isShape(quantity)) return [{ of: quantity, swatches: swatchesOf(viewer, parts) }];
  const isApart = (part) => viewer.isDifference(part), chosen = [parts.find((part) => !isApart(part)), parts.find(isApart)].filter(Boolean);
  return chosen.map((part, place) => {
    const apart = isApart(part), scale = scaleOf(viewer, apart), { low, high, isLogarithmic } = scale;
    const key = limitKey(viewer, apart), units = viewer.results[0].units(quantity) || "share";
    return { ...scale, key, units: apart && chosen.length > 1 ? `± ${units}` : units, ticks: withEnds(scale, isLogarithmic ? logarithmicTicks(low, high) : ticks(low, high)),
      palette: viewer.palettes[apart ? "difference" : colours], isShaded: shade === "all", isUsers: key in limits, isMain: place === 0, isApart: apart,
      beyond: beyondWords(viewer, parts.filter((one) => isApart(one) === apart), scale) };
  });
}

/** Values of the first and the last colour, and how those between lie: differences, of either sign, evenly. */
export function scaleOf(viewer, isApart) {
  const high = limitOf(viewer, isApart), isLogarithmic = !isApart && viewer.state.scale === "log";
  return { low: isApart ? -high : isLogarithmic ? leastOfDecades(high) : 0, high, isLogarithmic };
}

/** What has the first or the last colour without being of its value, and what has none of them, in sentences. */
function beyondWords(viewer, parts, scale) {
  const { largest, smallest, isKnown } = rangeOf(parts.map((one) => viewer.meshes[one.mesh].value.array)), { low, high, isLogarithmic } = scale;
  const words = [];
  if (largest > high * (1 + 1e-6)) words.push(`larger values, up to ${shown(largest)}, have the last colour`);
  if (isLogarithmic && smallest < low) words.push(`values below ${shown(low)} have the first colour`);
  if (low < 0 && smallest < low * (1 + 1e-6)) words.push(`smaller values, down to ${shown(smallest)}, have the first colour`);
  if (!isKnown) words.push(unknownWords(viewer, low < 0));
  if (parts.some((part) => hasWhiteSensors(viewer, part))) words.push("white dots: sensors without a value of it");
  return words;
}

function hasWhiteSensors(viewer, part) {
  if (!viewer.results[part.n].sensors) return false;
  const values = viewer.sensorValues(part);
  return !values || !values.every(Number.isFinite);
}

function rangeOf(arrays) {
  let largest = -Infinity, smallest = Infinity, isKnown = true;
  for (const array of arrays)
    for (const value of array) {
      if (!(value > notKnown)) isKnown = false;
      else if (value > largest) largest = value;
      if (value > notKnown && value < smallest) smallest = value;
    }
  return { largest, smallest, isKnown };
}

/** What surfaces without a value are. */
function unknownWords(viewer, isApart) {
  if (isApart) return "grey: no counterpart";
  const colour = viewer.state.colours === "grey" ? "blue" : "grey";
  return `${colour}: not ${viewer.state.quantity.startsWith("measure_") ? "measured" : "known"}`;
}

/** Kinds or materials of all results, each name once. */
function swatchesOf(viewer, parts) {
  const { quantity } = viewer.state, palette = viewer.palettes[quantity], colour = (k) => `rgb(${palette.slice(3 * k, 3 * k + 3)})`, found = new Map();
  for (const { n } of parts) {
    const result = viewer.results[n], isOfKinds = quantity === kinds, names = isOfKinds ? result.allSurfaceNames() : result.geometry.material_name;
    for (const k of [...new Set(isOfKinds ? result.patch_surface : result.patch_material)].sort((a, b) => a - b))
      if (k >= 0) found.set(names[k], { colour: colour(isOfKinds ? k : result.colour_of_material[k]), name: names[k] || "without a name" });
  }
  return [...found.values(), ...(parts.some(({ n }) => viewer.results[n].sensors) ? [{ colour: "#fff", name: "sensors" }] : [])];
}

/** What the colours end at: the user's limit, or one for all results and times. */
export function limitOf(viewer, isApart) {
  const { quantity, limits } = viewer.state;
  if (isShape(quantity)) return 1;
  const key = limitKey(viewer, isApart);
  return limits[key] ?? (viewer.ends ??= {})[key] ?? (viewer.ends[key] = automaticLimit(viewer, isApart));
}

function limitKey(viewer, isApart) { return `${viewer.state.quantity}${isApart ? " difference" : ""}`; }

/** Of a series, one for all its intervals: the program has looked for it, because a page that did would keep its user waiting. */
function automaticLimit(viewer, isApart) {
  const { quantity } = viewer.state, { results } = viewer;
  if (results[0].series?.name === quantity) return endAbove(isApart ? viewer.endOfDifferences : Math.max(...results.map((result) => result.series.end)));
  if (!isApart) return Math.max(...results.map((result, n) => scaleEnd(viewer.valuesOf(n), result.patch_area)));
  return scaleEnd(viewer.difference(viewer.valuesOf(0), viewer.valuesOf(1)).map(Math.abs), results[0].patch_area);
}

/** The bar of a scale, 256 colours from left to right; below, where there is shading, how dark it makes them. */
export function drawBarCanvas(canvas, { palette, isShaded }) {
  [canvas.width, canvas.height] = [256, 16];
  const c = canvas.getContext("2d");
  for (let x = 0; x < 256; ++x) {
    const colour = palette.slice(3 * x, 3 * x + 3);
    c.fillStyle = `rgb(${colour})`;
    c.fillRect(x, 0, 1, 16);
    if (!isShaded) continue;
    c.fillStyle = `rgb(${colour.map((channel) => Math.round(channel * (1 - deepestShade)))})`;
    c.fillRect(x, 12, 1, 4);
  }
}

function element(name, text = "", properties = {}) {
  return Object.assign(document.createElement(name), { textContent: text, ...properties });
}

/** Of a logarithmic scale without the digits that round numbers do not need. */
export function tickText({ isLogarithmic }, value) { return isLogarithmic ? String(value) : shown(value); }

/** Whether there is no number at a tick where there is little room. */
export function isMinor({ isLogarithmic, high }, value) { return isLogarithmic && !isPowerOfTen(value) && value !== high; }

function scaleElement(legend, setLimit, change) {
  const box = element("div", "", { className: "scale" }), bar = element("div", "", { className: "bar" }), canvas = element("canvas");
  drawBarCanvas(canvas, legend);
  if (legend.isShaded) canvas.title = "below: the same colours where surfaces are shaded";
  const marks = element("div", "", { className: "ticks" });
  for (const value of legend.ticks) {
    const tick = element("span", tickText(legend, value), { className: isMinor(legend, value) ? "minor" : "" });
    tick.style.left = `${100 * colourShare(legend, value)}%`;
    marks.append(tick);
  }
  bar.append(canvas, marks);
  const choice = element("span"), limit = element("input", "", { type: "number", min: 0, step: "any", value: legend.high, title: "value of the last colour" });
  limit.setAttribute("aria-label", "limit");
  limit.addEventListener("change", () => setLimit(legend.key, Number(limit.value)));
  const automatic = element("button", "automatic", { disabled: !legend.isUsers });
  automatic.addEventListener("click", () => setLimit(legend.key, null));
  if (legend.isMain) [limit.id, automatic.id, canvas.id] = ["limit", "automatic", "bar"];
  choice.append(limit, " ", automatic);
  // Of differences there is no logarithm.
  if (!legend.isApart) {
    const switched = element("button", "log", { id: "scale", title: "logarithmic colours, over three powers of ten" });
    switched.setAttribute("aria-pressed", legend.isLogarithmic);
    switched.addEventListener("click", () => {
      change({ scale: legend.isLogarithmic ? "linear" : "log" });
      document.getElementById("scale")?.focus();
    });
    choice.append(" ", switched);
  }
  box.append(element("span", legend.units, { className: "units" }), bar, choice);
  // Always there and of two lines, so that the picture stays as high as it is.
  box.append(element("p", legend.beyond.join("; "), { className: "beyond" }));
  return box;
}

function swatchElement({ swatches, of }) {
  const list = element("ul", "", { className: "swatches", id: of });
  for (const { colour, name } of swatches.slice(0, mostSwatches)) {
    const row = element("li"), swatch = element("span");
    swatch.style.background = colour;
    row.append(swatch, name);
    list.append(row);
  }
  if (swatches.length > mostSwatches) list.append(element("li", `and ${swatches.length - mostSwatches} more`));
  return list;
}

/** What the colours are of: a total does not become one of the slider's time. */
export function whatText(viewer) {
  const { quantity } = viewer.state;
  if (isShape(quantity)) return quantityName(viewer);
  return quantity === viewer.results[0].series?.name ? `${quantity.replaceAll("_", " ")} at the time of the slider` : `${shownText(viewer)}; not of the slider's time`;
}

/** `change` is told what of the state a legend's switches change. */
export function showLegends(box, legends, setLimit, change) {
  box.replaceChildren(...legends.map((legend) => (legend.swatches ? swatchElement(legend) : scaleElement(legend, setLimit, change))));
}
