// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// One camera for all views: orbiting a point, or walking on the ground.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

// Height of a walker's eyes and speed of a brisk walk.
const eyeHeightM = 1.65, walkMPerS = 3, turnPerPixel = 0.004, highestStepM = 1.2;
const fieldDeg = 35, usualAspect = 1.5, framed = 1.06, flightMs = 700, homeRise = 0.7;
// A flight ends where that share of what faces it is seen; a sight may end so much before it.
const enoughSeen = 0.75, sightSlack = 1e-3;
const turnPerKey = Math.PI / 24, zoomPerKey = 1.15;
const ways = { KeyW: "ahead", ArrowUp: "ahead", KeyS: "back", ArrowDown: "back", KeyA: "left", ArrowLeft: "left", KeyD: "right", ArrowRight: "right" };

export class CameraMan {
  /** `focus`: box that a whole view frames, from `side` (a level unit vector). `world`: groundAt(x, y, below) and clear(from, way): metres to what is in the way. */
  constructor(canvas, radius, focus, side, world, moved) {
    Object.assign(this, { canvas, radius, focus, side, world, moved, mode: "orbit", keys: new Set(), isMoved: false, aspect: usualAspect });
    this.camera = new THREE.PerspectiveCamera(fieldDeg, usualAspect, radius / 2000, radius * 20);
    this.camera.up.set(0, 0, 1);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.home();
    this.orbit.addEventListener("change", moved);
    this.orbit.addEventListener("start", () => { this.isMoved = true; this.flight = null; });
    this.pointers = new Map();
    canvas.addEventListener("pointerdown", (event) => this.pointers.set(event.pointerId, event));
    for (const end of ["pointerup", "pointercancel", "pointerleave"]) canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    canvas.addEventListener("pointermove", (event) => this.drag(event));
    window.addEventListener("blur", () => this.keys.clear());
  }

  home() {
    const way = this.side.clone().setZ(homeRise).normalize();
    this.setMode("orbit");
    this.orbit.target.copy(this.focus.getCenter(new THREE.Vector3()));
    this.camera.position.copy(this.orbit.target).addScaledVector(way, this.distanceFor(this.focus, way));
    this.orbit.update();
    this.isMoved = false;
    this.flight = null;
  }

  /** Pictures have another shape now: a whole view stays one. */
  shapeTo(aspect) {
    this.aspect = aspect;
    if (!this.isMoved) this.home();
  }

  /** How far from the middle of a box the camera must be, looking against `way`, to have all of it in a picture. */
  distanceFor(box, way) {
    const middle = box.getCenter(new THREE.Vector3()), right = new THREE.Vector3(-way.y, way.x, 0);
    if (right.lengthSq() < 1e-9) right.set(1, 0, 0);
    const up = way.clone().cross(right.normalize()), tall = Math.tan((fieldDeg * Math.PI) / 360) * Math.max(1, usualAspect / this.aspect), wide = tall * this.aspect;
    let farthest = 0;
    for (let k = 0; k < 8; ++k) {
      const corner = new THREE.Vector3(k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y, k & 4 ? box.max.z : box.min.z).sub(middle);
      farthest = Math.max(farthest, corner.dot(way) + Math.max(Math.abs(corner.dot(right)) / wide, Math.abs(corner.dot(up)) / tall));
    }
    return framed * Math.max(farthest, this.radius / 500);
  }

  setMode(mode) {
    if (mode === this.mode) return;
    this.mode = mode;
    this.orbit.enabled = mode === "orbit";
    this.flight = null;
    this.isMoved = true;
    const ahead = this.camera.getWorldDirection(new THREE.Vector3());
    if (mode === "walk") {
      const start = this.startOfWalk();
      this.camera.position.copy(start.place);
      this.look(start.heading, 0);
    } else {
      this.orbit.target.copy(this.camera.position).addScaledVector(ahead, 0.2 * this.radius);
      this.orbit.update();
    }
    this.moved();
  }

  /** A place on the ground near the middle of the picture with air around it, and the way that one sees farthest from there. */
  startOfWalk() {
    const { target } = this.orbit, step = Math.max(2.5, this.radius / 40), airM = 2, headings = 12, rings = 8;
    let best = null;
    for (let ring = 0; ring < rings; ++ring) {
      for (let k = 0; k < (ring ? 6 : 1); ++k) {
        const turn = ((k + 0.5 * (ring % 2)) * Math.PI) / 3, x = target.x + ring * step * Math.cos(turn), y = target.y + ring * step * Math.sin(turn);
        if (!this.world.isOutdoors(x, y)) continue;
        const place = new THREE.Vector3(x, y, this.world.groundAt(x, y, Infinity) + eyeHeightM);
        const sights = [...Array(headings).keys()].map((w) => {
          const heading = (w * 2 * Math.PI) / headings;
          return { heading, clear: this.world.clear(place, new THREE.Vector3(Math.cos(heading), Math.sin(heading), 0)) };
        });
        // Out of the scene one sees far, and nothing.
        const least = Math.min(...sights.map((one) => one.clear)), seen = sights.filter((one) => Number.isFinite(one.clear));
        const far = seen.sort((a, b) => b.clear - a.clear)[0], found = { place, heading: far?.heading ?? Math.PI / 2, least };
        if (far && least >= airM) return found;
        if (!best || least > best.least) best = found;
      }
    }
    return best ?? { place: target.clone().setZ(this.world.groundAt(target.x, target.y, Infinity) + eyeHeightM), heading: Math.PI / 2 };
  }

  /** A picture narrower than it is usual keeps what a usual one shows from side to side. */
  fitTo(aspect) {
    this.camera.aspect = aspect;
    this.camera.fov = (360 / Math.PI) * Math.atan(Math.tan((fieldDeg * Math.PI) / 360) * Math.max(1, usualAspect / aspect));
    this.camera.updateProjectionMatrix();
  }

  /** Flies before a shape: against its normal, from as low as nothing stands before most of it. `points` of it: { at, normal }. */
  flyTo({ box, middle, normal, points }) {
    this.setMode("orbit");
    const level = new THREE.Vector3(normal.x, normal.y, 0), up = new THREE.Vector3(0, 0, 1);
    const ahead = level.length() > 0.2 * normal.length() && level.length() > 1e-9 ? level.normalize() : this.camera.position.clone().sub(this.orbit.target).setZ(0).normalize();
    const room = box.clone().expandByScalar(0.25 * box.getSize(new THREE.Vector3()).length());
    let place = null, most = -1;
    for (const riseDeg of normal.z > 0.7 * normal.length() ? [50, 70, 85] : [15, 30, 45, 60, 75]) {
      const rise = (riseDeg * Math.PI) / 180, way = ahead.clone().multiplyScalar(Math.cos(rise)).addScaledVector(up, Math.sin(rise));
      const from = middle.clone().addScaledVector(way, this.distanceFor(room, way)), seen = this.shareSeen(from, points);
      if (seen > most) [place, most] = [from, seen];
      if (most >= enoughSeen) break;
    }
    this.isMoved = true;
    this.flight = { from: [this.camera.position.clone(), this.orbit.target.clone()], to: [place, middle], start: null };
    if (window.matchMedia("(prefers-reduced-motion: reduce)").matches) this.fly(Infinity);
    this.moved();
  }

  /** Of the points that face a place, the share that is seen from there. */
  shareSeen(place, points) {
    let facing = 0, seen = 0;
    for (const { at, normal } of points) {
      const way = at.clone().sub(place), distance = way.length();
      if (normal && way.dot(normal) >= 0) continue;
      ++facing;
      if (this.world.clear(place, way.divideScalar(distance)) >= (1 - sightSlack) * distance) ++seen;
    }
    return facing ? seen / facing : 0;
  }

  fly(now) {
    const flight = this.flight;
    flight.start ??= now;
    const share = Number.isFinite(now) ? Math.min(1, (now - flight.start) / flightMs) : 1, eased = share * share * (3 - 2 * share);
    this.camera.position.lerpVectors(flight.from[0], flight.to[0], eased);
    this.orbit.target.lerpVectors(flight.from[1], flight.to[1], eased);
    this.orbit.update();
    if (share >= 1) this.flight = null;
  }

  look(turn, rise) {
    Object.assign(this, { heading: turn, rise: Math.max(-1.5, Math.min(1.5, rise)) });
    this.camera.lookAt(this.ahead().add(this.camera.position));
    this.moved();
  }

  ahead() {
    return new THREE.Vector3(Math.cos(this.heading) * Math.cos(this.rise), Math.sin(this.heading) * Math.cos(this.rise), Math.sin(this.rise));
  }

  drag(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    this.pointers.set(event.pointerId, event);
    if (this.mode !== "walk") return;
    this.look(this.heading + (event.clientX - before.clientX) * turnPerPixel, this.rise + (event.clientY - before.clientY) * turnPerPixel);
  }

  /** Takes a key of the keyboard; whether it is one of the camera's. */
  key(event, isDown) {
    if (this.mode === "walk") return this.walk(ways[event.code], isDown);
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.code];
    const zoom = { "+": 1 / zoomPerKey, "=": 1 / zoomPerKey, "-": zoomPerKey, "−": zoomPerKey }[event.key];
    if (!turns && !zoom) return false;
    if (isDown) this.orbitBy(...(turns ?? [0, 0]), zoom ?? 1);
    return true;
  }

  orbitBy(aside, up, zoom) {
    const way = new THREE.Spherical().setFromVector3(swapped(this.camera.position.clone().sub(this.orbit.target)));
    way.theta += aside * turnPerKey;
    way.phi = Math.max(0.02, Math.min(Math.PI - 0.02, way.phi - up * turnPerKey));
    way.radius *= zoom;
    this.camera.position.copy(this.orbit.target).add(swapped(new THREE.Vector3().setFromSpherical(way), -1));
    this.isMoved = true;
    this.orbit.update();
    this.moved();
  }

  /** Begins or ends to walk ahead, back, left or right. */
  walk(way, isDown) {
    if (!way) return false;
    isDown ? this.keys.add(way) : this.keys.delete(way);
    this.isMoved = true;
    this.moved();
    return true;
  }

  /** Walks or flies on for some seconds; whether it moves. */
  step(seconds, now) {
    if (this.flight) {
      this.fly(now);
      return true;
    }
    if (this.mode !== "walk" || !this.keys.size) return false;
    const along = this.keys.has("ahead") - this.keys.has("back"), aside = this.keys.has("right") - this.keys.has("left");
    const way = walkMPerS * Math.min(seconds, 0.2), p = this.camera.position;
    p.x += way * (along * Math.cos(this.heading) + aside * Math.sin(this.heading));
    p.y += way * (along * Math.sin(this.heading) - aside * Math.cos(this.heading));
    // Steps and kerbs are climbed, roofs overhead are not.
    p.z = this.world.groundAt(p.x, p.y, p.z - eyeHeightM + highestStepM) + eyeHeightM;
    return true;
  }

  /** Eye and point looked at, to which `offset` is added. */
  numbers(offset) {
    const target = this.mode === "walk" ? this.ahead().add(this.camera.position) : this.orbit.target;
    return [this.camera.position, target].flatMap((point) => point.toArray().map((x, axis) => x + offset[axis]));
  }

  setNumbers(mode, numbers, offset) {
    const [eye, target] = [numbers.slice(0, 3), numbers.slice(3)].map((point) => new THREE.Vector3(...point.map((x, axis) => x - offset[axis])));
    this.mode = mode;
    this.orbit.enabled = mode === "orbit";
    this.flight = null;
    this.camera.position.copy(eye);
    this.isMoved = true;
    if (mode === "orbit") {
      this.orbit.target.copy(target);
      this.orbit.update();
    } else {
      const way = target.sub(eye).normalize();
      this.look(Math.atan2(way.y, way.x), Math.asin(Math.max(-1, Math.min(1, way.z))));
    }
    this.moved();
  }
}

/** The scene's z axis as the y axis of spherical coordinates, and back. */
function swapped(v, back = 1) {
  return back > 0 ? new THREE.Vector3(v.x, v.z, -v.y) : new THREE.Vector3(v.x, -v.z, v.y);
}
