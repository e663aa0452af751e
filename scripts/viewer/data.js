// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what io/view/data.cpp has put into the page.

/** Value of every half-precision float (IEEE 754 binary16) by its bits. */
function halfValues() {
  const table = new Float32Array(65536);
  for (let bits = 0; bits < 65536; ++bits) {
    const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, mantissa = bits & 1023;
    if (exponent === 31) table[bits] = mantissa ? NaN : sign * Infinity;
    else if (exponent === 0) table[bits] = sign * mantissa * 2 ** -24;
    else table[bits] = sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
  }
  return table;
}

async function block(number) {
  const element = document.getElementById(`block-${number}`);
  const text = atob(element.textContent);
  element.remove();
  const packed = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) packed[k] = text.charCodeAt(k);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

const integers = ["patch_vertices", "patch_object", "patch_facade", "patch_material", "patch_surface", "patch_side",
  "patch_input_triangle", "input_triangle_vertices"];
const surfaces = ["other", "wall", "roof", "ground", "window", "floor"];

/** Value of a series of halves at interval k: low bytes of all columns, then high bytes. */
function halfAt(series, halves, columns, k, column) {
  const at = 2 * k * columns + column;
  return halves[series.planes[at] | (series.planes[at + columns] << 8)] / series.scale;
}

/** Points that receive light; quantities have the names of those of patches. */
class Sensors {
  static async read(about, halves) {
    const sensors = Object.assign(new Sensors(), about, { halves });
    sensors.position = new Float32Array(await block(about.position));
    sensors.count = sensors.position.length / 3;
    for (const total of about.totals) total.values = new Float32Array(await block(total.values));
    if (about.series) about.series.planes = new Uint8Array(await block(about.series.values));
    return sensors;
  }

  seriesValue(k, sensor) { return halfAt(this.series, this.halves, this.count, k, sensor); }

  /** One value per sensor; nothing where they lack the quantity. */
  values(name, k) {
    const total = this.totals.find((one) => one.name === name);
    if (total) return total.values;
    if (this.series?.name !== name || k < 0) return null;
    return Float32Array.from({ length: this.count }, (_, s) => this.seriesValue(k, s));
  }

  units(name) {
    return this.series?.name === name ? this.series.units : this.totals.find((one) => one.name === name)?.units ?? "";
  }
}

/** Results of equal variants have the first of these that differs as their name: study, file, folder; else numbers. */
function nameApart(results) {
  if (results.length < 2 || results[0].label !== results[1].label) return;
  const [differs] = ["study", "file", "folder"].filter((key) => results[0][key] !== results[1][key]);
  results.forEach((result, n) => { result.name = `${result.label} (${differs ? result[differs] : n + 1})`; });
}

/** All results in the frame of the first: each has its own local origin, near the middle of its scene. */
function ofOneFrame(results) {
  const { origin } = results[0];
  for (const result of results.slice(1)) {
    result.geometry.centre = result.geometry.centre.map((x, axis) => x + (result.origin[axis] - origin[axis]));
    result.origin = origin;
  }
}

/** One result: names as in its file, arrays unpacked. */
class Result {
  static async read(about, halves) {
    const result = Object.assign(new Result(), about, { halves });
    const g = about.geometry;
    result.vertices = new Float32Array(await block(g.vertices));
    for (const name of integers) result[name] = new Int32Array(await block(g[name]));
    for (const name of ["patch_area", "patch_normal"]) result[name] = new Float32Array(await block(g[name]));
    result.patches = result.patch_area.length;
    for (const total of about.totals) total.values = new Float32Array(await block(total.values));
    if (about.series) about.series.planes = new Uint8Array(await block(about.series.values));
    for (const division of about.divisions) division.values = new Float32Array(await block(division.values));
    if (about.facade_series) about.facade_series.planes = new Uint8Array(await block(about.facade_series.values));
    if (about.sensors) result.sensors = await Sensors.read(about.sensors, halves);
    const twins = new Set();
    result.patch_side.forEach((side, p) => side && twins.add(result.patch_input_triangle[p]));
    result.isTwoSided = Uint8Array.from(result.patch_input_triangle, (triangle) => +twins.has(triangle));
    return result;
  }

  /** The variant, or what else tells results apart (nameApart). */
  get label() { return this.name || this.variant || this.study; }

  /** Value of the series at interval k of the page. */
  seriesValue(k, patch) {
    return halfAt(this.series, this.halves, this.patches, k, patch);
  }

  facadeValue(k, facade) {
    return halfAt(this.facade_series, this.halves, this.geometry.facade_name.length, k, facade);
  }

  /** Light loads of parts of the period: [word of the quantity, name of the part]. */
  partNames() {
    return this.divisions.flatMap(({ name, parts }) => parts.map((part) => [`light_load_by_${name}:${part}`, part]));
  }

  /** Values of such a part, one per patch; nothing where there is none. */
  partValues(word) {
    for (const { name, parts, values } of this.divisions) {
      const at = parts.findIndex((part) => word === `light_load_by_${name}:${part}`);
      if (at >= 0) return values.subarray(at * this.patches, (at + 1) * this.patches);
    }
    return null;
  }

  /** One value per patch: of a total, of a part of the period, or of the series at interval k (NaN: not covered). */
  values(name, k) {
    const total = this.totals.find((one) => one.name === name), part = this.partValues(name);
    if (total || part) return total?.values ?? part;
    const values = new Float32Array(this.patches).fill(NaN);
    if (this.series?.name === name && k >= 0) for (let p = 0; p < this.patches; ++p) values[p] = this.seriesValue(k, p);
    return values;
  }

  units(name) {
    if (this.partValues(name)) return this.divisions[0].units;
    return this.series?.name === name ? this.series.units : this.totals.find((one) => one.name === name)?.units ?? "";
  }

  /** Interval that holds an instant of another result, -1: none. */
  intervalAt(time) {
    const middle = (time.begin + time.end) / 2;
    return this.times.findIndex((own) => own.begin <= middle && middle < own.end);
  }

  allSurfaceNames() { return surfaces; }

  /** Kinds of surface that its patches have. */
  surfaceNames() {
    const used = new Set(this.patch_surface);
    return surfaces.filter((_, k) => used.has(k));
  }

  patchNames(patch) {
    const g = this.geometry;
    return {
      object: g.object_name[this.patch_object[patch]] ?? "",
      facade: g.facade_name[this.patch_facade[patch]] ?? "",
      material: g.material_name[this.patch_material[patch]] ?? "",
      surface: surfaces[this.patch_surface[patch]] ?? "",
    };
  }

  corner(patch, k) {
    const v = 3 * this.patch_vertices[3 * patch + k];
    return [this.vertices[v], this.vertices[v + 1], this.vertices[v + 2]];
  }

  /** Height of the highest patch (of a kind) below a height over a point of the plan; -Infinity: none. */
  heightAt(x, y, below, kind = "") {
    const { vertices: v, patch_vertices: corners } = this, only = kind ? surfaces.indexOf(kind) : -1;
    let highest = -Infinity;
    for (let c = 0; c < corners.length; c += 3) {
      if (only >= 0 && this.patch_surface[c / 3] !== only) continue;
      const a = 3 * corners[c], b = 3 * corners[c + 1], d = 3 * corners[c + 2];
      // Twice the signed areas that the point spans with the sides, seen in plan.
      const u = (v[b] - x) * (v[d + 1] - y) - (v[d] - x) * (v[b + 1] - y);
      const w = (v[d] - x) * (v[a + 1] - y) - (v[a] - x) * (v[d + 1] - y);
      if (u < 0 !== w < 0) continue;
      const t = (v[a] - x) * (v[b + 1] - y) - (v[b] - x) * (v[a + 1] - y);
      if (u < 0 !== t < 0 || u + w + t === 0) continue;
      const z = (u * v[a + 2] + w * v[b + 2] + t * v[d + 2]) / (u + w + t);
      if (z <= below && z > highest) highest = z;
    }
    return highest;
  }

  centroid(patch) {
    const corners = [0, 1, 2].map((k) => this.corner(patch, k));
    return [0, 1, 2].map((axis) => (corners[0][axis] + corners[1][axis] + corners[2][axis]) / 3);
  }
}

/** Area-weighted mean of another result's values over what is matched to a patch; NaN: nothing. */
export function matchedMean(match, patch, valueOf) {
  let sum = 0, area = 0;
  for (let k = match.first[patch]; k < match.first[patch + 1]; ++k) {
    const q = match.list[k], value = valueOf(q);
    if (!Number.isFinite(value)) continue;
    sum += match.area[k] * value;
    area += match.area[k];
  }
  return area > 0 ? sum / area : NaN;
}

/** What lies on each patch of the first result, and how much of it: `first` places in `list` and `area`. */
async function readMatch(about, { patches, patch_area }) {
  if (about.is_same) {
    const numbers = Int32Array.from({ length: patches + 1 }, (_, p) => p);
    return { first: numbers, list: numbers.subarray(0, patches), area: patch_area };
  }
  const first = new Int32Array(patches + 1);
  new Int32Array(await block(about.count)).forEach((count, p) => { first[p + 1] = first[p] + count; });
  return { first, list: new Int32Array(await block(about.patch)), area: new Float32Array(await block(about.area)) };
}

export async function readPage() {
  const about = JSON.parse(document.getElementById("about").textContent);
  const halves = halfValues();
  const results = [];
  for (const one of about.results) results.push(await Result.read(one, halves));
  ofOneFrame(results);
  nameApart(results);
  const match = about.two ? await readMatch(about.two.pairs, results[0]) : null;
  for (const result of results) result.colour_of_material = result.geometry.material_name.map((name) => about.colour_of_material[name]);
  return { results, match, endOfDifferences: about.two?.end, noValue: about.no_value, palettes: { false: about.false, grey: about.grey, difference: differencePalette(), surfaces: about.surfaces, materials: about.materials } };
}

/** Blue, near white, orange: lightness falls equally to both sides (CIELAB), told apart by all colour vision. */
function differencePalette() {
  const colours = [];
  for (let k = 0; k < 256; ++k) {
    const t = k / 127.5 - 1, away = Math.abs(t), hue = t < 0 ? 285 : 55, chroma = 45 * Math.min(1, 1.3 * away);
    colours.push(...srgb(95 - 60 * away, chroma * Math.cos((hue * Math.PI) / 180), chroma * Math.sin((hue * Math.PI) / 180)));
  }
  return colours;
}

/** CIE 15:2004 with white D65, then sRGB (IEC 61966-2-1), 0 … 255. */
function srgb(lightness, a, b) {
  const f = (lightness + 16) / 116;
  const scale = (t) => (t > 6 / 29 ? t ** 3 : 3 * (6 / 29) ** 2 * (t - 4 / 29));
  const [x, y, z] = [0.95047 * scale(f + a / 500), scale(f), 1.08883 * scale(f - b / 200)];
  return [3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.969266 * x + 1.8760108 * y + 0.041556 * z,
    0.0556434 * x - 0.2040259 * y + 1.0572252 * z].map((c) => {
    const coded = c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
    return Math.round(255 * Math.min(1, Math.max(0, coded)));
  });
}
