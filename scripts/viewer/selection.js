// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the user has chosen: patches, facades, objects, kinds of surface, or a sensor.
//
// A selection is a list of entries { of: "facade" | "object" | "surface" | "pattern", name },
// { of: "patch", n, patch } and { of: "sensor", n, sensor }; n is the result that it was clicked in.
import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { findNames } from "./find.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";

const outlinePixels = 3, outlineColour = 0x00b7ff, smallestLoop = 0.3;

export const sameEntry = (a, b) => a.of === b.of && a.name === b.name && a.n === b.n && a.patch === b.patch && a.sensor === b.sensor;

export function entryText(entry) {
  if (entry.of === "patch" || entry.of === "sensor") return `${entry.of} ${entry[entry.of]}`;
  if (entry.of === "pattern") return `all that match ${entry.name}`;
  return entry.of === "surface" ? `all of kind ${entry.name}` : `${entry.of} ${entry.name}`;
}

export function selectionText(entries) {
  if (entries.length === 1) return entryText(entries[0]);
  const kinds = new Set(entries.map((entry) => entry.of));
  const kind = kinds.size === 1 ? { facade: "facades", object: "objects", patch: "patches", surface: "kinds of surface" }[[...kinds][0]] : "parts";
  const most = 3, names = entries.slice(0, most).map((entry) => entry.name ?? entry[entry.of]).join(", ");
  return `${entries.length} ${kind}: ${names}${entries.length > most ? ", …" : ""}`;
}

/** Patches of the m-th result that a selection has there; of a patch of the first result those in its place. */
export function selectedPatches(viewer, picked, m) {
  const result = viewer.results[m], chosen = new Set();
  const entries = picked.flatMap((entry) => (entry.of === "pattern" ? findNames(viewer.known, entry.name).found : [entry]));
  const names = (of) => new Set(entries.filter((entry) => entry.of === of).map((entry) => entry.name));
  const [facades, objects, kinds] = ["facade", "object", "surface"].map(names);
  if (facades.size + objects.size + kinds.size) {
    const g = result.geometry, has = (list, wanted) => list.map((name) => wanted.has(name));
    const isFacade = has(g.facade_name, facades), isObject = has(g.object_name, objects), isKind = has(result.allSurfaceNames(), kinds);
    for (let p = 0; p < result.patches; ++p)
      if (isFacade[result.patch_facade[p]] || isObject[result.patch_object[p]] || isKind[result.patch_surface[p]]) chosen.add(p);
  }
  for (const { of, n, patch } of entries) {
    if (of !== "patch") continue;
    if (n === m) chosen.add(patch);
    else if (n === 0 && viewer.match) for (let k = viewer.match.first[patch]; k < viewer.match.first[patch + 1]; ++k) chosen.add(viewer.match.list[k]);
  }
  return [...chosen].sort((a, b) => a - b);
}

/** Area-weighted mean of what is known. */
export function meanOver(patches, area, valueOf) {
  let sum = 0, all = 0;
  for (const p of patches) {
    const value = valueOf(p);
    if (!Number.isFinite(value)) continue;
    sum += area[p] * value;
    all += area[p];
  }
  return all > 0 ? sum / all : NaN;
}

/** Middle, box and mean normal of patches, in the frame of their result. */
export function shapeOf(result, patches) {
  const box = new THREE.Box3(), normal = new THREE.Vector3();
  for (const p of patches) {
    for (let k = 0; k < 3; ++k) box.expandByPoint(new THREE.Vector3(...result.corner(p, k)));
    normal.add(new THREE.Vector3().fromArray(result.patch_normal, 3 * p).multiplyScalar(result.patch_area[p]));
  }
  return { box, middle: box.getCenter(new THREE.Vector3()), normal };
}

/** Middles of some of the patches, with their normals. */
export function pointsOf(result, patches, most) {
  const step = Math.ceil(patches.length / most);
  return patches.filter((_, k) => k % step === Math.floor(step / 2)).map((p) => ({ at: new THREE.Vector3(...result.centroid(p)), normal: new THREE.Vector3().fromArray(result.patch_normal, 3 * p) }));
}

/** Edges that one of the patches has and no other of them. */
function rim(result, patches) {
  const edges = new Map(), v = result.patch_vertices;
  for (const p of patches) {
    for (let k = 0; k < 3; ++k) {
      const a = v[3 * p + k], b = v[3 * p + ((k + 1) % 3)], key = `${Math.min(a, b)} ${Math.max(a, b)}`;
      edges.has(key) ? edges.set(key, null) : edges.set(key, [a, b]);
    }
  }
  const at = (k) => [0, 1, 2].map((axis) => result.vertices[3 * k + axis]);
  return largeLoops([...edges.values()].filter(Boolean), at).flatMap((ends) => ends.flatMap(at));
}

/** Edges in loops that are not small beside the largest: holes for windows are left out. */
function largeLoops(edges, at) {
  const above = new Map(), top = (k) => {
    while (above.has(k)) {
      if (above.has(above.get(k))) above.set(k, above.get(above.get(k)));
      k = above.get(k);
    }
    return k;
  };
  for (const [a, b] of edges) if (top(a) !== top(b)) above.set(top(a), top(b));
  const boxes = new Map();
  for (const [a, b] of edges) {
    if (!boxes.has(top(a))) boxes.set(top(a), new THREE.Box3());
    for (const k of [a, b]) boxes.get(top(a)).expandByPoint(new THREE.Vector3(...at(k)));
  }
  const size = (box) => box.getSize(new THREE.Vector3()).length(), largest = Math.max(0, ...[...boxes.values()].map(size));
  return edges.filter(([a]) => size(boxes.get(top(a))) >= smallestLoop * largest);
}

/** The twelve edges of a box. */
function frame({ min, max }) {
  const corner = (k) => [k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z];
  return [...Array(8).keys()].flatMap((k) => [1, 2, 4].filter((bit) => !(k & bit)).flatMap((bit) => [...corner(k), ...corner(k | bit)]));
}

/** The line around what is chosen, on one mesh: rims, and frames around objects, which have none. */
export class Outline {
  constructor() {
    this.material = new LineMaterial({ color: outlineColour, linewidth: outlinePixels });
    this.object = new LineSegments2(new LineSegmentsGeometry(), this.material);
    this.object.renderOrder = 3;
    this.object.visible = false;
  }

  show(viewer, picked, m) {
    const key = JSON.stringify(picked);
    if (key === this.key) return;
    this.key = key;
    const result = viewer.results[m], isObject = ({ of }) => of === "object";
    const points = [...rim(result, selectedPatches(viewer, picked.filter((entry) => !isObject(entry)), m)), ...picked.filter(isObject).flatMap((entry) => {
      const patches = selectedPatches(viewer, [entry], m);
      return patches.length ? frame(shapeOf(result, patches).box) : [];
    })];
    this.object.visible = points.length > 0;
    if (!points.length) return;
    this.object.geometry.dispose();
    this.object.geometry = new LineSegmentsGeometry();
    this.object.geometry.setPositions(points);
  }
}
