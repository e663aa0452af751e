// What the page says beside the picture: legend, time and the values of a patch.
import { matchedMean } from "./data.js";
import { drawSeries } from "./plot.js";
import { shown, ticks } from "./scale.js";

export const $ = (id) => document.getElementById(id);
// The preview has no values; it is a choice among the quantities all the same.
export const preview = "preview";

export function drawLegend(viewer, end) {
  const { quantity, colours } = viewer.state, isPreview = quantity === preview;
  $("legend").hidden = isPreview;
  if (isPreview) return;
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
  if (!result.series) return;
  const times = viewer.results[0].times;
  const curves = which.map((m) => ({ label: viewer.results[m].label, values: times.map((time, i) => {
    const own = m === 0 ? i : viewer.results[m].intervalAt(time);
    return own >= 0 ? valueOf(m, (p) => viewer.results[m].seriesValue(own, p)) : NaN;
  }) }));
  drawSeries($("series"), times, k, curves, `${result.series.name} [${result.series.units}]`);
}

/** Series travel with 11 bits. */
function digits(viewer, name) {
  return name === viewer.results[0].series?.name ? 3 : 4;
}
