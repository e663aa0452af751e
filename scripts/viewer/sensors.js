// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sensors: points that receive light, in the colour of their value.
import * as THREE from "three";
import { colourShare } from "./scale.js";

const sizePixels = 9, pickPixels = 8;

export class SensorPoints {
  constructor(sensors) {
    this.sensors = sensors;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(sensors.position, 3));
    this.colour = new THREE.BufferAttribute(new Float32Array(3 * sensors.count), 3);
    geometry.setAttribute("color", this.colour);
    // A rim, so that they are seen on patches of their own colour: after the patches, and no obstacle to what is drawn over it.
    const rim = new THREE.Points(geometry.clone().deleteAttribute("color"),
      new THREE.PointsMaterial({ color: 0x202020, size: sizePixels + 4, sizeAttenuation: false, depthWrite: false }));
    const points = new THREE.Points(geometry, new THREE.PointsMaterial({ vertexColors: true, size: sizePixels, sizeAttenuation: false }));
    [rim.renderOrder, points.renderOrder] = [1, 2];
    this.object = new THREE.Group();
    this.object.add(rim, points);
  }

  /** Colours of values on a scale; white where there is none. `palette`: 256 sRGB colours. */
  show(values, palette, scale) {
    const colour = new THREE.Color();
    for (let s = 0; s < this.sensors.count; ++s) {
      const share = values ? colourShare(scale, values[s]) : NaN;
      const at = 3 * Math.round(255 * share);
      if (Number.isFinite(share)) colour.setRGB(palette[at] / 255, palette[at + 1] / 255, palette[at + 2] / 255, THREE.SRGBColorSpace);
      else colour.setRGB(1, 1, 1);
      this.colour.setXYZ(s, colour.r, colour.g, colour.b);
    }
    this.colour.needsUpdate = true;
  }

  /** The sensor within some pixels of a point of the view that is nearest to the camera; `place` gives pixels. */
  near(x, y, camera, place) {
    let best = null;
    for (let s = 0; s < this.sensors.count; ++s) {
      const point = new THREE.Vector3().fromArray(this.sensors.position, 3 * s).add(this.object.parent.position);
      const distance = point.distanceTo(camera.position), at = place(point);
      if (Math.hypot(at.x - x, at.y - y) > pickPixels || at.z > 1) continue;
      if (!best || distance < best.distance) best = { sensor: s, distance };
    }
    return best;
  }
}
