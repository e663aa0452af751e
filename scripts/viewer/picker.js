// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What lies under a point of the window, and where in the window a point of the scene lies.
import * as THREE from "three";

export class Picker {
  constructor(viewer) { this.viewer = viewer; }

  /** The part of the stage under a point of the window, and where in it, from -1 to 1. */
  placeIn(x, y) {
    const rect = this.viewer.canvas.getBoundingClientRect(), parts = this.viewer.parts();
    const inside = (part) => x - rect.left >= part.x && x - rect.left < part.x + part.width && y - rect.top >= part.y && y - rect.top < part.y + part.height;
    const part = parts.find(inside);
    if (!part) return null;
    this.viewer.man.fitTo(part.width / part.height);
    return { part, at: new THREE.Vector2((2 * (x - rect.left - part.x)) / part.width - 1, 1 - (2 * (y - rect.top - part.y)) / part.height) };
  }

  /** The patch under a point of the window. */
  patchAt(x, y) {
    const place = this.placeIn(x, y);
    if (!place) return null;
    this.viewer.rays.setFromCamera(place.at, this.viewer.man.camera);
    const { object, patchOf } = this.viewer.meshes[place.part.mesh], [hit] = this.viewer.rays.intersectObject(object, false);
    return hit ? { n: place.part.n, patch: patchOf[hit.faceIndex] } : null;
  }

  /** The sensor under a point of the window, where nothing stands before it. */
  sensorAt(x, y) {
    const place = this.placeIn(x, y);
    if (!place) return null;
    const { mesh, n } = place.part, { sensors, object } = this.viewer.meshes[mesh];
    const found = sensors?.near(x, y, this.viewer.man.camera, (point) => this.pixelOf(point, place.part));
    if (!found) return null;
    const way = new THREE.Vector3().fromArray(this.viewer.results[n].sensors.position, 3 * found.sensor).add(object.position).sub(this.viewer.man.camera.position).normalize();
    this.viewer.rays.set(this.viewer.man.camera.position, way);
    const [hit] = this.viewer.rays.intersectObject(object, false);
    // Sensors lie on surfaces or before them.
    return hit && hit.distance < 0.999 * found.distance ? null : { n, sensor: found.sensor };
  }

  /** What a click takes at a point of the window; null: nothing. */
  entryAt(x, y) {
    const sensor = this.sensorAt(x, y);
    if (sensor) return { of: "sensor", ...sensor };
    const hit = this.patchAt(x, y), { takes } = this.viewer.state;
    if (!hit) return null;
    const name = takes !== "patch" && this.viewer.results[hit.n].patchNames(hit.patch)[takes];
    // What is no facade is taken with its object.
    const object = takes === "facade" && !name && this.viewer.results[hit.n].patchNames(hit.patch).object;
    return name ? { of: takes, name } : object ? { of: "object", name: object } : { of: "patch", ...hit };
  }

  /** Where a point is in the window, and its depth. */
  pixelOf(point, part) {
    const rect = this.viewer.canvas.getBoundingClientRect(), at = point.clone().project(this.viewer.man.camera);
    return { x: rect.left + part.x + ((at.x + 1) / 2) * part.width, y: rect.top + part.y + ((1 - at.y) / 2) * part.height, z: at.z };
  }

  /** The same of a point of the n-th result, in the first picture of it. */
  placeOf(point, n) {
    const part = this.viewer.parts().find((one) => one.n === n);
    this.viewer.man.fitTo(part.width / part.height);
    return this.pixelOf(point.add(this.viewer.meshes[n].object.position), part);
  }
}
