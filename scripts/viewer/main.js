// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The page of `sunload view`: state, and what it draws of it.
import * as THREE from "three";
import { addressOf, readAddress } from "./address.js";
import { CameraMan } from "./camera.js";
import { fillChoices, listen, showState } from "./controls.js";
import { matchedMean, readPage } from "./data.js";
import { knownNames } from "./find.js";
import { legendsOf, limitOf, scaleOf, showLegends, whatText } from "./legend.js";
import { PatchMesh, difference, paletteTexture } from "./mesh.js";
import { $, isShape, kinds, materials, preview, tellSelection, tellTime } from "./panels.js";
import { Picker } from "./picker.js";
import { pointsOf, sameEntry, selectedPatches, shapeOf } from "./selection.js";
import { Sky, bearing, overviewAzimuth, sceneNorth } from "./sky.js";
import { caption, quantities } from "./words.js";

const playIntervalMs = 250, addressAfterMs = 300, captionPixels = 24;
// The sun's path lies beyond what is built by this factor; a whole view has so many of its heights around it.
const pathBeyond = 1.15, aroundHeight = 0.3;
// What is not higher above the ground than this is no roof.
const highestStreetM = 2;
// Rays to so many points of a shape tell whether it is seen.
const mostSightPoints = 16;

class Viewer {
  constructor({ results, match, endOfDifferences, palettes, noValue }) {
    this.results = results;
    this.canvas = $("scene");
    this.palettes = palettes;
    this.noValue = noValue;
    this.textures = Object.fromEntries(Object.entries(palettes).map(([name, colours]) => [name, paletteTexture(colours)]));
    this.known = knownNames(results);
    this.match = match;
    this.endOfDifferences = endOfDifferences;
    this.unmatchedShare = this.match ? this.lonelyShare() : 0;
    this.state = { view: results.length > 1 ? "side" : "0", quantity: quantities(this)[0][0], k: this.brightest(results[0]), colours: "false", scale: "linear",
      shading: "constant", crease: 20, lines: "none", edges: true, shade: "shapes", path: true, takes: "patch", chart: "day", picked: [], limits: {}, folded: new Set() };
    this.buildScene();
    fillChoices(this);
    this.usual = { ...this.state, fold: "" };
    if (this.isNarrow()) this.state.folded.add("left");
    this.usual.fold = [...this.state.folded].join(",");
    listen(this);
    this.takeAddress();
    window.addEventListener("hashchange", () => window.location.hash.slice(1) !== this.written && this.takeAddress());
    this.loop();
  }

  /** Of the part of the period that is chosen the interval with most light on open ground; where there is none at all, with the highest sun. */
  brightest(result) {
    const chosen = result.times.map((_, k) => k).filter((k) => result.times[k].share > 0);
    const most = (of) => chosen.reduce((best, k) => (of(result.times[k]) > of(result.times[best]) ? k : best), chosen[0] ?? 0);
    const brightest = most((time) => time.ghi ?? 0);
    return result.times[brightest].ghi > 0 ? brightest : most((time) => time.elevation);
  }

  isNarrow() { return window.matchMedia("(max-width: 760px)").matches; }

  /** Share of the first result's area that has nothing in its place in the second. */
  lonelyShare() {
    const { patch_area: area } = this.results[0], { first } = this.match;
    let lonely = 0, all = 0;
    area.forEach((one, p) => { all += one; if (first[p] === first[p + 1]) lonely += one; });
    return lonely / all;
  }

  // What is drawn.

  buildScene() {
    const [result] = this.results;
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: !isDrawnBySoftware(), preserveDrawingBuffer: true });
    this.renderer.setClearColor(0xe8f0f7);
    this.renderer.autoClear = false;
    this.scene = new THREE.Scene();
    this.meshes = [];
    this.results.forEach((_, n) => this.addMesh(n, n));
    const { box } = this.meshes[0], focus = this.meshes[0].focus(), radius = 0.5 * box.getSize(new THREE.Vector3()).length();
    const middle = focus.getCenter(new THREE.Vector3()), north = sceneNorth(result.times), size = focus.getSize(new THREE.Vector3());
    this.lowest = box.min.z;
    this.sky = new Sky(result.times, pathBeyond * Math.hypot(size.x / 2, size.y / 2, size.z), middle.clone().setZ(focus.min.z), result.has_sun);
    this.scene.add(this.sky.object);
    focus.expandByVector(new THREE.Vector3(aroundHeight * size.z, aroundHeight * size.z, 0));
    this.rays = new THREE.Raycaster();
    this.picker = new Picker(this);
    const world = { groundAt: (x, y, below) => this.groundAt(x, y, below), clear: (from, way) => this.clear(from, way), isOutdoors: (x, y) => this.isOutdoors(x, y) };
    this.man = new CameraMan(this.canvas, radius, focus, bearing((overviewAzimuth(result.times) * Math.PI) / 180, north), world, () => this.touch());
    new ResizeObserver(() => this.resize()).observe($("stage"));
    this.resize();
  }

  /** All results in the frame of the first. */
  addMesh(at, n) {
    const mesh = new PatchMesh(this.results[n]);
    mesh.object.position.set(...this.results[n].geometry.centre.map((x, axis) => x - this.results[0].geometry.centre[axis]));
    this.scene.add(mesh.object);
    this.meshes[at] = mesh;
  }

  /** Height of the highest surface below a height, over a point of the plan. */
  groundAt(x, y, below) {
    const height = this.results[0].heightAt(x, y, below);
    return Number.isFinite(height) ? height : this.lowest;
  }

  /** Whether the ground (where the scene has none: its lowest level) is the highest that is there over a point of the plan. */
  isOutdoors(x, y) {
    const [result] = this.results, height = result.heightAt(x, y, Infinity), hasGround = result.surfaceNames().includes("ground");
    return Number.isFinite(height) && height <= (hasGround ? result.heightAt(x, y, Infinity, "ground") : this.lowest) + highestStreetM;
  }

  /** Metres from a point to the first surface on a way; infinite where there is none, 0 where it is seen from behind. */
  clear(from, way) {
    this.rays.set(from, way);
    const [hit] = this.rays.intersectObject(this.meshes[0].object, false), normals = this.results[0].patch_normal;
    if (!hit) return Infinity;
    const patch = this.meshes[0].patchOf[hit.faceIndex], turn = way.dot(new THREE.Vector3().fromArray(normals, 3 * patch));
    return turn < 0 || this.results[0].isTwoSided[this.results[0].patch_input_triangle[patch]] ? hit.distance : 0;
  }

  /**
   * The pictures beside each other (one above the other where the stage is tall): which mesh, of which result, and
   * where [pixels of the stage, from its upper left corner]. Below each is room for its caption.
   */
  parts() {
    const { view } = this.state, { clientWidth: width, clientHeight: height } = this.canvas;
    const meshes = { side: [0, 1], difference: [difference], all: [0, 1, difference] }[view] ?? [Number(view)];
    const isTall = height > width, wide = isTall ? width : width / meshes.length, tall = isTall ? height / meshes.length : height;
    return meshes.map((mesh, k) => {
      const x = isTall ? 0 : Math.round(k * wide), y = isTall ? Math.round(k * tall) : 0;
      return { mesh, n: mesh === difference ? 0 : mesh, x, y, width: (isTall ? width : Math.round((k + 1) * wide)) - x,
        height: (isTall ? Math.round((k + 1) * tall) : height) - y - captionPixels };
    });
  }

  isDifference(part) { return part.mesh === difference && !isShape(this.state.quantity); }

  /** Value per patch of a result for the quantity that is shown, at the time of the slider. */
  valuesOf(n, quantity = this.state.quantity, k = this.state.k) {
    const result = this.results[n];
    return result.values(quantity, n === 0 ? k : result.intervalAt(this.results[0].times[k]));
  }

  /** The second result minus the first, on the patches of the first. */
  difference(values, others) {
    return values.map((value, p) => matchedMean(this.match, p, (q) => others[q]) - value);
  }

  /** What a mesh shows: one value per patch, or the number of a kind. */
  shownBy(part) {
    const { quantity } = this.state, result = this.results[part.n];
    if (quantity === preview) return new Float32Array(result.patches);
    if (quantity === kinds) return Float32Array.from(result.patch_surface);
    if (quantity === materials) return Float32Array.from(result.patch_material, (k) => result.colour_of_material[k] ?? -1);
    return this.isDifference(part) ? this.difference(this.valuesOf(0), this.valuesOf(1)) : this.valuesOf(part.n);
  }

  refresh() {
    this.shapeCamera();
    const { quantity, shading, crease, lines, colours, edges, shade, path, picked, k } = this.state;
    for (const part of this.parts()) {
      if (!this.meshes[part.mesh]) this.addMesh(part.mesh, part.n);
      const mesh = this.meshes[part.mesh], { uniforms } = mesh, isApart = this.isDifference(part), scale = scaleOf(this, isApart);
      mesh.show(this.shownBy(part), shading === "smooth" && !isShape(quantity), crease);
      mesh.showAs(isShape(quantity), shade === "all" || (shade === "shapes" && isShape(quantity)));
      uniforms.kinds.value = quantity === materials || quantity === kinds;
      uniforms.palette.value = this.textures[isApart ? "difference" : uniforms.kinds.value ? quantity : colours];
      uniforms.none.value.fromArray(this.noValue[isApart ? "false" : colours]).divideScalar(255);
      for (const [name, value] of Object.entries(scale)) uniforms[name].value = value;
      mesh.showLines(lines);
      mesh.foldLines.visible = edges;
      mesh.outline.show(this, picked, part.n);
      mesh.sensors?.show(this.sensorValues(part), this.palettes[colours], scale);
    }
    this.sky.show(k);
    if (path !== this.isPathShown) this.sky.object.visible = this.isPathShown = path;
    this.showCaptions();
    $("what").textContent = whatText(this);
    const legends = this.legends(), told = JSON.stringify(legends.map((legend) => ({ ...legend, palette: colours })));
    if (told !== this.toldLegends) showLegends($("legend"), legends, (key, value) => this.setLimit(key, value), (what) => this.change(what));
    this.toldLegends = told;
    tellTime(this);
    tellSelection(this);
    showState(this);
    this.touch();
  }

  /** Of what a picture shows one value per sensor; nothing in a difference, and where they lack the quantity. */
  sensorValues(part) {
    const { quantity, k } = this.state, result = this.results[part.n], own = part.n === 0 ? k : result.intervalAt(this.results[0].times[k]);
    return part.mesh === difference || isShape(quantity) ? null : result.sensors.values(quantity, own);
  }

  shapeCamera() {
    const [{ width, height }] = this.parts();
    if (width > 0 && height > 0) this.man.shapeTo(width / height);
  }

  showCaptions() {
    $("names").replaceChildren(...this.parts().map((part) => {
      const span = Object.assign(document.createElement("span"), { textContent: caption(this, part), title: caption(this, part) });
      Object.assign(span.style, { left: `${part.x}px`, top: `${part.y + part.height}px`, width: `${part.width}px` });
      return span;
    }));
  }

  legends() { return legendsOf(this); }

  /** What the colours end at: the user's limit, or one for all results and times. */
  limit(isApart = this.state.view === "difference") { return limitOf(this, isApart); }

  render() {
    const { clientHeight: whole } = this.canvas;
    this.renderer.setScissorTest(true);
    for (const part of this.parts()) {
      const { x, width, height } = part, y = whole - part.y - height;
      this.renderer.setViewport(x, y, width, height);
      this.renderer.setScissor(x, y, width, height);
      this.man.fitTo(width / height);
      this.meshes.forEach((mesh, n) => {
        mesh.object.visible = n === part.mesh;
        if (n === part.mesh) mesh.showFolds(this.man.camera, width, height);
      });
      this.renderer.clear();
      this.renderer.render(this.scene, this.man.camera);
    }
    this.isStale = false;
  }

  /** Draws with the next frame, and soon writes the address. */
  touch() {
    this.isStale = true;
    clearTimeout(this.writing);
    this.writing = setTimeout(() => this.writeAddress(), addressAfterMs);
  }

  loop() {
    let before = performance.now();
    const frame = (now) => {
      if (this.man.step((now - before) / 1000, now)) this.touch();
      before = now;
      if (this.isStale) this.render();
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = $("stage");
    if (width < 1 || height < 1) return;
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(width, height, false);
    // At once, so that the picture does not blink; not before there is something to show.
    if (this.toldLegends === undefined) return;
    this.shapeCamera();
    this.showCaptions();
    tellSelection(this);
    showState(this);
    this.render();
    this.touch();
  }

  // The address.

  offset() { return this.results[0].geometry.centre.map((x, axis) => x + (this.results[0].origin?.[axis] ?? 0)); }

  address() {
    return addressOf(this.state, this.usual, this.results[0], { mode: this.man.mode, isMoved: this.man.isMoved, numbers: this.man.numbers(this.offset()) });
  }

  writeAddress() {
    this.written = this.address();
    if (window.location.hash.slice(1) !== this.written) window.history.replaceState(null, "", `${window.location.href.split("#")[0]}${this.written ? "#" : ""}${this.written}`);
  }

  takeAddress() {
    const has = (id, value) => [...$(id).options].some((option) => option.value === value);
    const { camera, ...asked } = readAddress(window.location.hash, this.results, has);
    Object.assign(this.state, asked);
    this.refresh();
    if (camera) this.man.setNumbers(camera.mode, camera.numbers, this.offset());
    showState(this);
  }

  // What the user does.

  change(what) {
    Object.assign(this.state, what);
    this.refresh();
  }

  choose(entries) { this.change({ picked: entries }); }

  /** Adds an entry, or takes it away where it is chosen. */
  toggle(entry) {
    const { picked } = this.state, rest = picked.filter((one) => !sameEntry(one, entry));
    this.choose(rest.length < picked.length ? rest : [...picked.filter((one) => one.of !== "sensor"), entry]);
  }

  flyTo(entries = this.state.picked) {
    for (const [m, result] of this.results.entries()) {
      const patches = selectedPatches(this, entries, m);
      if (!patches.length) continue;
      const shape = shapeOf(result, patches), { position } = this.meshes[m].object;
      shape.box.translate(position);
      shape.middle.add(position);
      const points = pointsOf(result, patches, mostSightPoints);
      for (const { at } of points) at.add(position);
      return this.man.flyTo({ ...shape, points });
    }
    const [sensor] = entries.filter((entry) => entry.of === "sensor");
    if (!sensor) return undefined;
    const { sensors } = this.results[sensor.n], middle = new THREE.Vector3().fromArray(sensors.position, 3 * sensor.sensor).add(this.meshes[sensor.n].object.position);
    return this.man.flyTo({ box: new THREE.Box3().setFromCenterAndSize(middle, new THREE.Vector3(6, 6, 6)), middle, normal: new THREE.Vector3(0, 0, 1), points: [{ at: middle }] });
  }

  setLimit(key, value) {
    if (value !== null && !(value > 0)) return;
    if (value === null) delete this.state.limits[key];
    else this.state.limits[key] = value;
    this.toldLegends = "";
    this.refresh();
  }

  play() {
    if (this.timer) {
      clearInterval(this.timer);
      this.timer = null;
    } else {
      // A total does not change with time: light at the time is what plays.
      const series = this.results[0].series?.name;
      if (series && !isShape(this.state.quantity) && quantities(this).some(([word]) => word === series)) this.state.quantity = series;
      this.timer = setInterval(() => this.stepTime(1), playIntervalMs);
    }
    this.refresh();
  }

  stepTime(by) {
    const count = this.results[0].times.length;
    this.change({ k: (this.state.k + by + count) % count });
  }

  // For tests: where things are in the window, and how fast frames are.

  patchAt(x, y) { return this.picker.patchAt(x, y); }

  placeOf(patch, n = 0) { return this.picker.placeOf(new THREE.Vector3(...this.results[n].centroid(patch)), n); }

  placeOfSensor(sensor, n = 0) { return this.picker.placeOf(new THREE.Vector3().fromArray(this.results[n].sensors.position, 3 * sensor), n); }

  /** Frames per second of a turn around the scene, each finished before the next begins. */
  measuredFrames(count) {
    const gl = this.renderer.getContext(), pixel = new Uint8Array(4), start = performance.now(), place = this.man.camera.position.clone();
    for (let frame = 0; frame < count; ++frame) {
      this.man.camera.position.applyAxisAngle(new THREE.Vector3(0, 0, 1), (2 * Math.PI) / count);
      this.man.orbit.update();
      this.render();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    }
    this.man.camera.position.copy(place);
    this.man.orbit.update();
    return (1000 * count) / (performance.now() - start);
  }
}

/** Whether the browser draws without a graphics card: smooth edges cost it two thirds of its frames. */
function isDrawnBySoftware() {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

readPage().then((page) => {
  window.sunload = new Viewer(page);
  $("message").remove();
}).catch((error) => {
  $("message").textContent = `The page cannot be shown: ${error.message}`;
  throw error;
});
