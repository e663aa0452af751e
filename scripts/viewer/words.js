// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Names of what can be shown and of what is.
import { difference } from "./mesh.js";
import { clockText, isShape, kinds, materials, preview } from "./panels.js";

/** Quantities to choose from, [word, name]. What one result has, the other may lack: only those of both. */
export function quantities(viewer) {
  const { results } = viewer, series = results[0].series?.name;
  const names = results[0].totals.map((total) => total.name).filter((name) => results.every((r) => r.totals.some((t) => t.name === name)));
  if (series && results.every((r) => r.series?.name === series)) names.push(series);
  return [...names.map((name) => [name, name.replaceAll("_", " ") + (name === series ? " at the time" : name.endsWith("_se") ? " (error)" : "")]),
    ...partsOfAll(results), [kinds, "kinds of surface"], [materials, "materials"], [preview, "shape only"]];
}

/** Light loads of parts of the period that all results have; where one is chosen they are of all their time nevertheless. */
function partsOfAll(results) {
  const shared = results[0].partNames().filter(([word]) => results.every((result) => result.partValues(word)));
  return shared.map(([word, part]) => [word, `light load, ${part}${results[0].part ? " (all of it)" : ""}`]);
}

/** Which part of the period and which band values are of, where that is not all. */
export function chosenText([result]) { return [result.band, result.part].filter(Boolean).join(", "); }

/** What is shown and of when, as below the title of `sunload render`; nothing of shapes. */
export function shownText(viewer) {
  const { results, state } = viewer, { quantity } = state, name = quantityName(viewer);
  if (isShape(quantity)) return "";
  if (quantity === results[0].series?.name) return `${quantity.replaceAll("_", " ")}, ${clockText(results[0], state.k)}`;
  const totals = results.map((result) => result.totals.find((total) => total.name === quantity)), [total] = totals;
  if (!total) return name;
  const rule = quantity.startsWith("measure_") && total.what ? `: ${total.what}` : "", whens = [...new Set(totals.map(({ when }) => when))];
  const when = whens.length > 1 ? totals.map((one, n) => `${results[n].label} ${one.when}`).join("; ") : whens[0];
  return `${name}${rule}${when ? `, ${when}` : ""}`;
}

export function views(viewer) {
  const { results } = viewer, list = results.map((result, n) => [String(n), result.label]);
  if (results.length < 2) return list;
  const has = viewer.unmatchedShare < 1, apart = `${results[1].label} − ${results[0].label}`;
  return [...list, ["side", "side by side"], ...(has ? [["difference", `difference: ${apart}`], ["all", "both and the difference"]] : [])];
}

export function quantityName(viewer) { return quantities(viewer).find(([word]) => word === viewer.state.quantity)[1]; }

export function caption(viewer, part) {
  const { results } = viewer, name = part.mesh === difference ? `difference: ${results[1].label} − ${results[0].label}` : results[part.n].label;
  return `${name}: ${quantityName(viewer)}`;
}

export function title(viewer) {
  const { results, state } = viewer, names = [...new Set(viewer.parts().map((part) => part.n))].map((n) => results[n].label);
  const isSeries = state.quantity === results[0].series?.name;
  return `${results[0].study} (${[...names, chosenText(results)].filter(Boolean).join(", ")}): ${isSeries ? `${state.quantity.replaceAll("_", " ")} ${clockText(results[0], state.k)}` : quantityName(viewer)}`;
}

export function fileName(viewer) {
  const { results, state } = viewer, view = views(viewer).find(([word]) => word === state.view)[1];
  return `${results[0].study}-${view}-${state.quantity}`.replace(/[^\p{L}\p{N}._-]+/gu, "-");
}
