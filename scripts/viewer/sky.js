// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The sun's arc and the compass around the scene.
import * as THREE from "three";

/** Azimuth of the scene's +y axis [rad, clockwise from north], from the lowest sun. */
export function sceneNorth(times) {
  const lowest = times.reduce((a, b) => (Math.abs(b.sun[2]) < Math.abs(a.sun[2]) ? b : a));
  return (lowest.azimuth * Math.PI) / 180 - Math.atan2(lowest.sun[0], lowest.sun[1]);
}

/** Unit vector of the scene towards a compass bearing [rad]. */
export function bearing(azimuth, north) {
  return new THREE.Vector3(Math.sin(azimuth - north), Math.cos(azimuth - north), 0);
}

/** Azimuth from which light comes on the whole [deg], by the sun's and by what falls on open ground; of what has no sun that of noon. */
function lightAzimuth(times) {
  const noon = 180, least = 1e-3, hasLight = times.some((time) => time.ghi * time.share > 0);
  let [north, east, all] = [0, 0, 0];
  for (const { azimuth, elevation, ghi, share } of times) {
    const weight = share * (hasLight ? ghi ?? 0 : Math.max(0, Math.sin((elevation * Math.PI) / 180))), turn = (azimuth * Math.PI) / 180;
    north += weight * Math.cos(turn);
    east += weight * Math.sin(turn);
    all += weight;
  }
  return Math.hypot(north, east) > least * all ? ((Math.atan2(east, north) * 180) / Math.PI + 360) % 360 : noon;
}

/**
 * From where a whole view looks [deg], as `sunload render` does: of north, east, south and west the side that light comes
 * from, and of the sides beside it west for north and south (the afternoon's), for east and west the one that gets more of it.
 */
export function overviewAzimuth(times) {
  const light = lightAzimuth(times), side = Math.round(light / 90) * 90, isNoon = side % 180 === 0;
  return side + ((isNoon ? side === 180 : light >= side) ? 45 : -45);
}

function letter(text) {
  const canvas = Object.assign(document.createElement("canvas"), { width: 64, height: 64 });
  const c = canvas.getContext("2d");
  c.font = "bold 48px sans-serif";
  c.textAlign = "center";
  c.textBaseline = "middle";
  // A rim, so that it is read on dark ground.
  [c.strokeStyle, c.lineWidth, c.lineJoin] = ["#fff", 7, "round"];
  c.strokeText(text, 32, 34);
  c.fillStyle = "#333";
  c.fillText(text, 32, 34);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  return new THREE.Sprite(new THREE.SpriteMaterial({ map: texture }));
}

function line(points, colour) {
  return new THREE.Line(new THREE.BufferGeometry().setFromPoints(points), new THREE.LineBasicMaterial({ color: colour }));
}

export class Sky {
  /** Around a point of the ground. */
  constructor(times, radius, middle, hasSun) {
    this.times = times;
    this.hasSun = hasSun;
    this.radius = radius;
    this.object = new THREE.Group();
    this.object.position.copy(middle);
    const north = sceneNorth(times), letters = 0.09 * radius;
    const circle = [...Array(97).keys()].map((k) => bearing((k * Math.PI) / 48, north).multiplyScalar(radius));
    this.object.add(line(circle, 0x888888));
    ["N", "E", "S", "W"].forEach((text, k) => {
      const sprite = letter(text);
      // Upon the ground, not half in it.
      sprite.position.copy(bearing((k * Math.PI) / 2, north).multiplyScalar(1.06 * radius)).setZ(letters / 2);
      sprite.scale.setScalar(letters);
      this.object.add(sprite);
    });
    this.sun = new THREE.Mesh(new THREE.SphereGeometry(0.035 * radius, 24, 16), new THREE.MeshBasicMaterial({ color: 0xf2a900 }));
    this.ray = line([new THREE.Vector3(), new THREE.Vector3()], 0xf2a900);
    this.arc = new THREE.Group();
    this.object.add(this.sun, this.ray, this.arc);
  }

  /** The sun of interval k and the arc of its day. */
  show(k) {
    const now = this.times[k], direction = new THREE.Vector3(...now.sun);
    this.sun.visible = this.ray.visible = this.hasSun && now.elevation > 0;
    if (!this.hasSun) return;
    this.sun.position.copy(direction).multiplyScalar(this.radius);
    this.ray.geometry.setFromPoints([this.sun.position, direction.clone().multiplyScalar(0.5 * this.radius)]);
    const day = now.local_begin.slice(0, 10);
    if (this.day === day && this.arc.children.length) return;
    this.day = day;
    for (const child of this.arc.children) child.geometry.dispose();
    this.arc.clear();
    const points = this.times.filter((time) => time.local_begin.slice(0, 10) === day && time.elevation > 0)
      .map((time) => new THREE.Vector3(...time.sun).multiplyScalar(this.radius));
    if (!points.length) return;
    this.arc.add(line(points, 0xc98a00));
    this.arc.add(new THREE.Points(new THREE.BufferGeometry().setFromPoints(points),
      new THREE.PointsMaterial({ color: 0xc98a00, size: 5, sizeAttenuation: false })));
  }
}
