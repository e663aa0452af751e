// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The page of `sunload view`: state, what it draws, and what the user does to it.
import * as THREE from "three";
import { CameraMan } from "./camera.js";
import { matchedMean, readPage } from "./data.js";
import { PatchMesh, paletteTexture } from "./mesh.js";
import { $, drawLegend, isShape, materialPalette, materialValue, materials, preview, tellPatch, tellTime } from "./panels.js";
import { scaleEnd, shown } from "./scale.js";
import { Sky, sceneNorth } from "./sky.js";

const playIntervalMs = 250, clickPixels = 4;

class Viewer {
  constructor({ results, palettes }) {
    this.results = results;
    this.palettes = { ...palettes, materials: materialPalette() };
    this.state = { view: results.length > 1 ? "side" : "0", quantity: "light_load", k: this.brightest(results[0]), colours: "false",
      shading: "constant", crease: Number($("crease").value), lines: "none", picked: null, limits: {} };
    this.textures = Object.fromEntries(Object.entries(this.palettes).map(([name, colours]) => [name, paletteTexture(colours)]));
    this.buildScene();
    this.fillChoices();
    this.listen();
    this.refresh();
    this.loop();
  }

  brightest(result) {
    const elevation = result.times.map((time) => time.elevation);
    return elevation.indexOf(Math.max(...elevation));
  }

  // What is drawn.

  buildScene() {
    const [result] = this.results;
    this.renderer = new THREE.WebGLRenderer({ canvas: $("scene"), antialias: !isDrawnBySoftware(), preserveDrawingBuffer: true });
    this.renderer.setClearColor(0xe8f0f7);
    this.renderer.autoClear = false;
    this.scene = new THREE.Scene();
    this.meshes = this.results.map((one) => new PatchMesh(one));
    // All results in the frame of the first.
    this.meshes.forEach((mesh, n) => {
      mesh.object.position.set(...this.results[n].geometry.centre.map((x, axis) => x - result.geometry.centre[axis]));
      this.scene.add(mesh.object);
    });
    const { box } = this.meshes[0];
    const radius = 0.5 * box.getSize(new THREE.Vector3()).length();
    this.sky = new Sky(result.times, radius, box.min.z);
    this.scene.add(this.sky.object);
    this.lowest = box.min.z;
    this.rays = new THREE.Raycaster();
    this.man = new CameraMan($("scene"), radius, sceneNorth(result.times), (x, y, below) => this.groundAt(x, y, below), () => { this.isStale = true; });
    this.resize();
  }

  /** Height of the highest surface below a height, over a point of the plan. */
  groundAt(x, y, below) {
    const height = this.results[0].heightAt(x, y, Number.isFinite(below) ? below : this.lowest + highestStreetM);
    return Number.isFinite(height) ? height : this.lowest;
  }

  /** Views side by side: which mesh in which share of the width. */
  parts() {
    const { view } = this.state;
    if (view === "side") return [{ mesh: 0, from: 0, to: 0.5 }, { mesh: 1, from: 0.5, to: 1 }];
    return [{ mesh: view === "1" ? 1 : 0, from: 0, to: 1 }];
  }

  isDifference() { return this.state.view === "difference" && !isShape(this.state.quantity); }

  /** Value per patch of a result for the quantity that is shown, at the time of the slider. */
  valuesOf(n, quantity = this.state.quantity, k = this.state.k) {
    const result = this.results[n];
    return result.values(quantity, n === 0 ? k : result.intervalAt(this.results[0].times[k]));
  }

  /** The second result minus the first, on the patches of the first. */
  difference(values, others) {
    return values.map((value, p) => matchedMean(this.match, p, (q) => others[q]) - value);
  }

  refresh() {
    const { quantity, shading, crease, lines, colours, k } = this.state;
    const end = this.limit(), isSmooth = shading === "smooth";
    this.meshes.forEach((mesh, n) => {
      const { uniforms } = mesh;
      if (quantity === materials) {
        mesh.show(Float32Array.from(this.results[n].patch_material, materialValue), false, crease);
      } else if (quantity !== preview) {
        let values = this.valuesOf(n);
        if (this.isDifference() && n === 0) {
          values = this.difference(values, this.valuesOf(1));
        }
        mesh.show(values, isSmooth, crease);
      }
      mesh.showAs(isShape(quantity));
      uniforms.materials.value = quantity === materials;
      const palette = this.isDifference() ? "difference" : quantity === materials ? materials : colours;
      uniforms.palette.value = this.textures[palette];
      uniforms.low.value = this.isDifference() ? -end : 0;
      uniforms.high.value = end;
      mesh.showLines(lines);
      this.showSensors(mesh, n, end);
    });
    this.sky.show(k);
    drawLegend(this, end);
    tellTime(this);
    tellPatch(this);
    this.isStale = true;
  }

  /** Sensors have the colours of their values; in a difference, and where they lack the quantity, they are white. */
  showSensors(mesh, n, end) {
    if (!mesh.sensors) return;
    const { quantity, colours, k } = this.state, own = n === 0 ? k : this.results[n].intervalAt(this.results[0].times[k]);
    const values = this.isDifference() || isShape(quantity) ? null : this.results[n].sensors.values(quantity, own);
    mesh.sensors.show(values, this.palettes[colours], 0, end);
  }

  /** What the colours end at: the user's limit, or one for all results and times. */
  limit() {
    const { quantity, limits } = this.state;
    if (isShape(quantity)) return 1;
    const key = this.limitKey();
    return limits[key] ?? (this.ends ??= {})[key] ?? (this.ends[key] = this.automaticLimit());
  }

  limitKey() { return `${this.state.quantity}${this.isDifference() ? " difference" : ""}`; }

  automaticLimit() {
    const { quantity, k } = this.state, isSeries = this.results[0].series?.name === quantity;
    const intervals = isSeries ? [...new Set([0.25, 0.5, 0.75, 1].map((share) => this.atElevation(share)).concat(k))] : [k];
    const ends = intervals.flatMap((at) => {
      if (!this.isDifference()) return this.results.map((result, n) => scaleEnd(this.valuesOf(n, quantity, at), result.patch_area));
      const apart = this.difference(this.valuesOf(0, quantity, at), this.valuesOf(1, quantity, at));
      return [scaleEnd(apart.map(Math.abs), this.results[0].patch_area)];
    });
    return Math.max(...ends);
  }

  /** Interval whose sun stands at a share of the highest elevation. */
  atElevation(share) {
    const elevation = this.results[0].times.map((time) => time.elevation), goal = share * Math.max(...elevation);
    return elevation.reduce((best, value, k) => (Math.abs(value - goal) < Math.abs(elevation[best] - goal) ? k : best), 0);
  }

  render() {
    const { clientWidth: width, clientHeight: height } = $("scene");
    this.renderer.setScissorTest(true);
    for (const part of this.parts()) {
      const x = Math.round(part.from * width), wide = Math.round(part.to * width) - x;
      this.renderer.setViewport(x, 0, wide, height);
      this.renderer.setScissor(x, 0, wide, height);
      this.man.fitTo(wide / height);
      this.meshes.forEach((mesh, n) => {
        mesh.object.visible = n === part.mesh;
        mesh.showFolds(this.man.camera, height);
      });
      this.renderer.clear();
      this.renderer.render(this.scene, this.man.camera);
    }
    this.isStale = false;
  }

  loop() {
    let before = performance.now();
    const frame = (now) => {
      if (this.man.step((now - before) / 1000)) this.isStale = true;
      before = now;
      if (this.isStale) this.render();
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  resize() {
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(window.innerWidth, window.innerHeight, false);
    this.isStale = true;
  }

  // What the user does.

  fillChoices() {
    const { results, state } = this;
    document.title = `sunload: ${results[0].study}`;
    $("title").textContent = `${results[0].study}: ${results.map((result) => result.label).join(", ")}`;
    this.match = results.length > 1 ? results[0].matched(results[1]) : null;
    const lonely = this.match ? results[0].patch_area.reduce((sum, area, p) => sum + (this.match.first[p] < this.match.first[p + 1] ? 0 : area), 0) : 0;
    this.unmatchedShare = this.match ? lonely / results[0].patch_area.reduce((sum, area) => sum + area, 0) : 0;
    const views = results.map((result, n) => [String(n), result.label]);
    if (results.length > 1) views.push(["side", "side by side"]);
    if (this.unmatchedShare < 1 && this.match) views.push(["difference", `difference: ${results[1].label} − ${results[0].label}`]);
    $("no-difference").hidden = !(this.unmatchedShare > 0);
    if (this.match) {
      $("no-difference").textContent = this.unmatchedShare < 1 ?
        `${shown(100 * this.unmatchedShare, 2)} % of ${results[0].label} has other shapes in ${results[1].label}: grey in the difference.` :
        "The two results share no surface: there is no difference.";
    }
    fill($("view"), views, state.view);
    $("view").parentElement.hidden = results.length < 2;
    // What a result has, the other may lack: only quantities of both can be shown.
    const names = results[0].totals.map((total) => total.name).filter((name) => results.every((r) => r.totals.some((t) => t.name === name)));
    const series = results[0].series?.name;
    if (series && results.every((r) => r.series?.name === series)) names.push(series);
    if (!names.includes(state.quantity)) state.quantity = names[0];
    fill($("quantity"), [[preview, "preview (shape only)"], [materials, "materials"], ...names.map((name) => [name,
      name.replaceAll("_", " ") + (name === series ? " at the time" : name.endsWith("_se") ? " (error)" : "")])], state.quantity);
    $("slider").max = results[0].times.length - 1;
  }

  listen() {
    const choose = (id, key, read = (element) => element.value) => $(id).addEventListener("change", () => {
      this.state[key] = read($(id));
      this.refresh();
    });
    for (const id of ["view", "quantity", "colours", "shading", "lines"]) choose(id, id);
    choose("crease", "crease", (element) => Math.min(180, Math.max(0, Number(element.value) || 0)));
    $("camera").addEventListener("change", () => {
      this.man.setMode($("camera").value);
      $("hint").textContent = $("camera").value === "walk" ? "W A S D or arrows walk, dragging looks around" : "";
      $("scene").focus();
    });
    $("slider").addEventListener("input", () => this.setTime(Number($("slider").value)));
    $("play").addEventListener("click", () => this.play());
    $("limit").addEventListener("change", () => this.setLimit(Number($("limit").value)));
    $("automatic").addEventListener("click", () => this.setLimit(null));
    $("close").addEventListener("click", () => { this.state.picked = null; this.refresh(); });
    let down = null;
    $("scene").addEventListener("pointerdown", (event) => { down = event; });
    $("scene").addEventListener("pointerup", (event) => {
      if (down && Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) < clickPixels) this.pick(event.clientX, event.clientY);
      down = null;
    });
    window.addEventListener("resize", () => this.resize());
  }

  setTime(k) {
    this.state.k = k;
    this.refresh();
  }

  setLimit(value) {
    if (value !== null && !(value > 0)) return;
    if (value === null) delete this.state.limits[this.limitKey()];
    else this.state.limits[this.limitKey()] = value;
    $("limit").blur();
    this.refresh();
  }

  play() {
    if (this.timer) {
      clearInterval(this.timer);
      this.timer = null;
    } else {
      // A total does not change with time: light at the time is what plays.
      const series = this.results[0].series?.name;
      if (series && this.state.quantity !== series && [...$("quantity").options].some((one) => one.value === series)) {
        this.state.quantity = $("quantity").value = series;
      }
      this.timer = setInterval(() => this.setTime((this.state.k + 1) % this.results[0].times.length), playIntervalMs);
    }
    $("play").textContent = this.timer ? "stop" : "play";
  }

  /** The patch under a point of the window. */
  patchAt(x, y) {
    const { clientWidth: width, clientHeight: height } = $("scene");
    const part = this.parts().find((one) => x / width < one.to) ?? this.parts()[0];
    const across = (x / width - part.from) / (part.to - part.from);
    this.man.fitTo(((part.to - part.from) * width) / height);
    this.rays.setFromCamera(new THREE.Vector2(2 * across - 1, 1 - (2 * y) / height), this.man.camera);
    const { object, patchOf } = this.meshes[part.mesh], [hit] = this.rays.intersectObject(object, false);
    return hit ? { n: part.mesh, patch: patchOf[hit.faceIndex] } : null;
  }

  /** The sensor under a point of the window, where nothing stands before it. */
  sensorAt(x, y) {
    const { clientWidth: width, clientHeight: height } = $("scene");
    const part = this.parts().find((one) => x / width < one.to) ?? this.parts()[0], { sensors } = this.meshes[part.mesh];
    if (!sensors) return null;
    this.man.fitTo(((part.to - part.from) * width) / height);
    const found = sensors.near(x, y, this.man.camera, (point) => this.pixelOf(point, part));
    if (!found) return null;
    const way = new THREE.Vector3().fromArray(this.results[part.mesh].sensors.position, 3 * found.sensor)
      .add(this.meshes[part.mesh].object.position).sub(this.man.camera.position).normalize();
    this.rays.set(this.man.camera.position, way);
    const [hit] = this.rays.intersectObject(this.meshes[part.mesh].object, false);
    // Sensors lie on surfaces or before them.
    return hit && hit.distance < 0.999 * found.distance ? null : { n: part.mesh, sensor: found.sensor };
  }

  pick(x, y) {
    this.state.picked = this.sensorAt(x, y) ?? this.patchAt(x, y);
    this.refresh();
  }

  /** Where a point is in the window, and its depth. */
  pixelOf(point, part) {
    const { clientWidth: width, clientHeight: height } = $("scene"), at = point.clone().project(this.man.camera);
    return { x: width * (part.from + ((at.x + 1) / 2) * (part.to - part.from)), y: (height * (1 - at.y)) / 2, z: at.z };
  }

  // For tests: where a patch is in the window, and how fast frames are.

  placeOf(patch, n = 0) {
    const part = this.parts().find((one) => one.mesh === n);
    const { clientWidth: width, clientHeight: height } = $("scene");
    this.man.fitTo(((part.to - part.from) * width) / height);
    return this.pixelOf(new THREE.Vector3(...this.results[n].centroid(patch)).add(this.meshes[n].object.position), part);
  }

  placeOfSensor(sensor, n = 0) {
    const part = this.parts().find((one) => one.mesh === n), { clientWidth: width, clientHeight: height } = $("scene");
    this.man.fitTo(((part.to - part.from) * width) / height);
    return this.pixelOf(new THREE.Vector3().fromArray(this.results[n].sensors.position, 3 * sensor).add(this.meshes[n].object.position), part);
  }

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

// Walking starts on what is lower than this above the lowest point: streets, not roofs.
const highestStreetM = 2;

/** Whether the browser draws without a graphics card: smooth edges cost it two thirds of its frames. */
function isDrawnBySoftware() {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

function fill(select, choices, chosen) {
  select.replaceChildren(...choices.map(([value, text]) => Object.assign(document.createElement("option"), { value, textContent: text })));
  select.value = chosen;
}

readPage().then((page) => {
  window.sunload = new Viewer(page);
  $("message").remove();
}).catch((error) => {
  $("message").textContent = `The page cannot be shown: ${error.message}`;
  throw error;
});
