// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// One camera for all views: orbiting a point, or walking on the ground.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { bearing } from "./sky.js";

// Height of a walker's eyes and speed of a brisk walk.
const eyeHeightM = 1.65, walkMPerS = 3, turnPerPixel = 0.004, highestStepM = 1.2;
const fieldDeg = 35, usualAspect = 1.5;

export class CameraMan {
  constructor(canvas, radius, north, groundAt, moved) {
    Object.assign(this, { canvas, radius, groundAt, moved, mode: "orbit", keys: new Set() });
    this.camera = new THREE.PerspectiveCamera(fieldDeg, 1, radius / 1000, radius * 20);
    this.camera.up.set(0, 0, 1);
    // From the sun's afternoon side (north of the equator), as `sunload render` looks.
    this.camera.position.copy(bearing((225 * Math.PI) / 180, north)).setZ(0.7).multiplyScalar(2.7 * radius);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.addEventListener("change", moved);
    this.orbit.update();
    canvas.addEventListener("pointermove", (event) => this.mode === "walk" && event.buttons && this.turn(event));
    window.addEventListener("keydown", (event) => this.key(event, true));
    window.addEventListener("keyup", (event) => this.key(event, false));
    window.addEventListener("blur", () => this.keys.clear());
  }

  setMode(mode) {
    if (mode === this.mode) return;
    this.mode = mode;
    this.orbit.enabled = mode === "orbit";
    const ahead = this.camera.getWorldDirection(new THREE.Vector3());
    if (mode === "walk") {
      const start = this.orbit.target.clone();
      this.camera.position.set(start.x, start.y, this.groundAt(start.x, start.y, Infinity) + eyeHeightM);
      this.look(Math.atan2(ahead.y, ahead.x), 0);
    } else {
      this.orbit.target.copy(this.camera.position).addScaledVector(ahead, 0.2 * this.radius);
      this.orbit.update();
    }
    this.moved();
  }

  /** A picture narrower than it is usual keeps what a usual one shows from side to side. */
  fitTo(aspect) {
    this.camera.aspect = aspect;
    this.camera.fov = (360 / Math.PI) * Math.atan(Math.tan((fieldDeg * Math.PI) / 360) * Math.max(1, usualAspect / aspect));
    this.camera.updateProjectionMatrix();
  }

  look(turn, rise) {
    Object.assign(this, { heading: turn, rise: Math.max(-1.5, Math.min(1.5, rise)) });
    const ahead = new THREE.Vector3(Math.cos(turn) * Math.cos(this.rise), Math.sin(turn) * Math.cos(this.rise), Math.sin(this.rise));
    this.camera.lookAt(ahead.add(this.camera.position));
    this.moved();
  }

  turn(event) {
    this.look(this.heading + event.movementX * turnPerPixel, this.rise + event.movementY * turnPerPixel);
  }

  key(event, down) {
    if (event.target.closest?.("input, select, button") || this.mode !== "walk") return;
    const name = { KeyW: "ahead", ArrowUp: "ahead", KeyS: "back", ArrowDown: "back", KeyA: "left", ArrowLeft: "left",
      KeyD: "right", ArrowRight: "right" }[event.code];
    if (!name) return;
    event.preventDefault();
    down ? this.keys.add(name) : this.keys.delete(name);
    this.moved();
  }

  /** Walks on for some seconds; whether it moves. */
  step(seconds) {
    if (this.mode !== "walk" || !this.keys.size) return false;
    const along = this.keys.has("ahead") - this.keys.has("back"), aside = this.keys.has("right") - this.keys.has("left");
    const way = walkMPerS * Math.min(seconds, 0.2), p = this.camera.position;
    p.x += way * (along * Math.cos(this.heading) + aside * Math.sin(this.heading));
    p.y += way * (along * Math.sin(this.heading) - aside * Math.cos(this.heading));
    // Steps and kerbs are climbed, roofs overhead are not.
    p.z = this.groundAt(p.x, p.y, p.z - eyeHeightM + highestStepM) + eyeHeightM;
    return true;
  }
}
