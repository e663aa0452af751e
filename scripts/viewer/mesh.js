// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The patches of a result as triangles that know a value at every corner.
import * as THREE from "three";
import { Outline } from "./selection.js";
import { SensorPoints } from "./sensors.js";

// Two pairs of shaders: without a graphics card every number that is handed on costs frames.
const lightVertexShader = `
attribute float value;
varying float vValue;
varying float vShade;
uniform float shade;
uniform vec3 light;
void main() {
  vValue = value;
  vShade = 1.0 - shade * (1.0 - max(normal.z, max(0.0, dot(normal, light))));
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

// Colours are those of the legend, unless the user wants some shade: level surfaces keep them then, too,
// and others are darker by as much as the legend shows. Backs of one-sided patches are as what has no value.
const lightFragmentShader = `
uniform sampler2D palette;
uniform vec3 none;
uniform float low;
uniform float high;
uniform bool isLogarithmic;
varying float vValue;
varying float vShade;
void main() {
  vec3 colour = none;
  if (gl_FrontFacing && vValue > -1e29) {
    float share = isLogarithmic ? log(max(vValue, low) / low) / log(high / low) : (vValue - low) / (high - low);
    share = clamp(share, 0.0, 1.0);
    colour = texture2D(palette, vec2((share * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  }
  gl_FragColor = vec4(colour * vShade, 1.0);
}`;

const shapeVertexShader = `
attribute float value;
varying float vValue;
varying vec3 vNormal;
void main() {
  vValue = value;
  vNormal = normal;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

// What is built, shaded: in one colour or in those of kinds.
const shapeFragmentShader = `
uniform sampler2D palette;
uniform bool kinds;
uniform float shade;
uniform vec3 light;
varying float vValue;
varying vec3 vNormal;
void main() {
  vec3 colour = vec3(0.72);
  if (gl_FrontFacing) {
    vec3 own = kinds && vValue > -0.5 ? texture2D(palette, vec2((vValue + 0.5) / 256.0, 0.5)).rgb : vec3(0.93, 0.92, 0.89);
    colour = own * mix(1.0, 0.5 + 0.2 * vNormal.z + 0.3 * max(0.0, dot(vNormal, light)), shade);
  }
  gl_FragColor = vec4(colour, 1.0);
}`;
/** In place of values that are not known. */
export const notKnown = -1e30;
/** Among meshes, that of the second result minus the first; before it come those of the results. */
export const difference = 2;
// Share of light that shading takes at most.
export const deepestShade = 0.22;
// Cosine of the turn from which on an edge gets a line (20°), as in `sunload render`.
const leastFold = 0.94;
const shortestFoldPixels = 5, paleLineShare = 0.4;

export function paletteTexture(colours) {
  const bytes = new Uint8Array(256 * 4).fill(255);
  for (let k = 0; k < 256; ++k) for (let c = 0; c < 3; ++c) bytes[4 * k + c] = colours[3 * k + c];
  const texture = new THREE.DataTexture(bytes, 256, 1);
  texture.needsUpdate = true;
  return texture;
}

export class PatchMesh {
  constructor(result) {
    this.result = result;
    // Two-sided patches first: their backs are not drawn, as the twin in the same place is.
    const all = [...Array(result.patches).keys()], twoSided = all.filter((p) => result.isTwoSided[p]);
    this.patchOf = Uint32Array.from([...twoSided, ...all.filter((p) => !result.isTwoSided[p])]);
    const corners = 3 * result.patches, twoSidedCorners = 3 * twoSided.length;
    const position = new Float32Array(3 * corners), normal = new Float32Array(3 * corners);
    for (let c = 0; c < corners; ++c) {
      const p = this.patchOf[Math.floor(c / 3)], v = 3 * result.patch_vertices[3 * p + (c % 3)];
      for (let axis = 0; axis < 3; ++axis) {
        position[3 * c + axis] = result.vertices[v + axis];
        normal[3 * c + axis] = result.patch_normal[3 * p + axis];
      }
    }
    this.value = new THREE.BufferAttribute(new Float32Array(corners), 1).setUsage(THREE.DynamicDrawUsage);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(normal, 3));
    geometry.setAttribute("value", this.value);
    if (twoSidedCorners > 0) geometry.addGroup(0, twoSidedCorners, 0);
    if (twoSidedCorners < corners) geometry.addGroup(twoSidedCorners, corners - twoSidedCorners, 1);
    this.uniforms = { palette: { value: null }, none: { value: new THREE.Vector3() }, low: { value: 0 }, high: { value: 1 }, isLogarithmic: { value: false }, kinds: { value: false },
      shade: { value: 0 }, light: { value: new THREE.Vector3(0.4, -0.6, 0.7) } };
    const ofSides = (vertexShader, fragmentShader) => [THREE.FrontSide, THREE.DoubleSide].map((side) => new THREE.ShaderMaterial({
      vertexShader, fragmentShader, side, uniforms: this.uniforms, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
    this.ofLight = ofSides(lightVertexShader, lightFragmentShader);
    this.ofShape = ofSides(shapeVertexShader, shapeFragmentShader);
    this.object = new THREE.Mesh(geometry, this.ofLight);
    this.box = new THREE.Box3().setFromBufferAttribute(geometry.attributes.position);
    this.addFolds();
    this.lines = {};
    this.creaseDeg = null;
    this.outline = new Outline();
    this.object.add(this.outline.object);
    if (result.sensors) {
      this.sensors = new SensorPoints(result.sensors);
      this.object.add(this.sensors.object);
    }
  }

  /** What is built (preview, kinds of surface, materials), or light on it. */
  showAs(isShape, isShaded) {
    this.object.material = isShape ? this.ofShape : this.ofLight;
    this.uniforms.shade.value = isShaded ? (isShape ? 1 : deepestShade) : 0;
  }

  /** One value per patch, constant on it or interpolated between its corners. */
  show(values, interpolate, creaseDeg) {
    const shown = this.value.array;
    if (!interpolate) {
      for (let t = 0; t < values.length; ++t) {
        const value = values[this.patchOf[t]];
        shown[3 * t] = shown[3 * t + 1] = shown[3 * t + 2] = Number.isFinite(value) ? value : notKnown;
      }
    } else {
      this.findNeighbours(creaseDeg);
      const area = this.result.patch_area;
      for (let s = 0; s < shown.length; ++s) {
        const c = 3 * this.patchOf[Math.floor(s / 3)] + (s % 3);
        let sum = 0, weight = 0;
        for (let k = this.first[c]; k < this.first[c + 1]; ++k) {
          const q = this.neighbours[k];
          if (!Number.isFinite(values[q])) continue;
          sum += area[q] * values[q];
          weight += area[q];
        }
        shown[s] = weight > 0 ? sum / weight : notKnown;
      }
    }
    this.value.needsUpdate = true;
  }

  /** For every corner the patches around its vertex that turn by less than the crease angle. */
  findNeighbours(creaseDeg) {
    if (this.creaseDeg === creaseDeg) return;
    this.creaseDeg = creaseDeg;
    const { patch_vertices: vertices, patch_normal: n, patch_side: side } = this.result;
    const start = new Int32Array(this.result.vertices.length / 3 + 1);
    for (const v of vertices) ++start[v + 1];
    for (let v = 0; v + 1 < start.length; ++v) start[v + 1] += start[v];
    const next = start.slice(), around = new Int32Array(vertices.length);
    vertices.forEach((v, c) => { around[next[v]++] = Math.floor(c / 3); });
    const least = Math.cos((creaseDeg * Math.PI) / 180), list = [];
    this.first = new Int32Array(vertices.length + 1);
    for (let c = 0; c < vertices.length; ++c) {
      const p = Math.floor(c / 3);
      for (let k = start[vertices[c]]; k < start[vertices[c] + 1]; ++k) {
        const q = around[k];
        const cosine = n[3 * p] * n[3 * q] + n[3 * p + 1] * n[3 * q + 1] + n[3 * p + 2] * n[3 * q + 2];
        if (q === p || (side[p] === side[q] && cosine >= least)) list.push(q);
      }
      this.first[c + 1] = list.length;
    }
    this.neighbours = Int32Array.from(list);
  }

  /** Edges of the patches ("after" refinement) or of the input triangles ("before"); none for "none". */
  showLines(which) {
    for (const lines of Object.values(this.lines)) lines.visible = false;
    if (which === "none") return;
    this.lines[which] ??= this.edges(which === "after" ? this.result.patch_vertices : this.result.input_triangle_vertices);
    this.lines[which].visible = true;
  }

  /** Lines where the surface turns or ends, the longest first. */
  addFolds() {
    const folds = this.folds(), length = ([a, b]) => a.distanceTo(b);
    folds.sort((one, other) => length(other) - length(one));
    this.foldLengths = Float32Array.from(folds, length);
    this.foldLines = new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(folds.flat()), new THREE.LineBasicMaterial({ color: 0x30343c, transparent: true }));
    this.foldLines.renderOrder = 0.5;
    this.foldLines.add(this.paleLines());
    this.object.add(this.foldLines);
  }

  /** The same lines pale and one pixel aside, below the dark ones: they are what one sees on dark values. */
  paleLines() {
    const material = new THREE.LineBasicMaterial({ color: 0xffffff, transparent: true, opacity: paleLineShare, depthWrite: false });
    this.pixel = { value: new THREE.Vector2() };
    material.onBeforeCompile = (shader) => {
      shader.uniforms.pixel = this.pixel;
      shader.vertexShader = `uniform vec2 pixel;\n${shader.vertexShader.replace("#include <project_vertex>", "#include <project_vertex>\ngl_Position.xy += pixel * gl_Position.w;")}`;
    };
    const lines = new THREE.LineSegments(this.foldLines.geometry, material);
    lines.renderOrder = 0.4;
    return lines;
  }

  /** Leaves lines out that would be short even on the side of the scene next to the camera. */
  showFolds(camera, widthPixels, heightPixels) {
    this.pixel.value.set(2 / widthPixels, 2 / heightPixels);
    const distance = this.box.distanceToPoint(camera.position.clone().sub(this.object.position));
    const pixel = (2 * distance * Math.tan((camera.fov * Math.PI) / 360)) / heightPixels;
    const first = this.foldLengths.findIndex((length) => length < shortestFoldPixels * pixel);
    this.foldLines.geometry.setDrawRange(0, first < 0 ? Infinity : 2 * first);
  }

  /** Box around what is built, or around everything where there is nothing but ground. */
  focus() {
    const { result } = this, box = new THREE.Box3(), ground = result.allSurfaceNames().indexOf("ground");
    for (let p = 0; p < result.patches; ++p)
      if (result.patch_surface[p] !== ground) for (let k = 0; k < 3; ++k) box.expandByPoint(new THREE.Vector3(...result.corner(p, k)));
    return box.isEmpty() ? this.box.clone() : box;
  }

  /** Edges of the input triangles where the surface turns or ends. */
  folds() {
    const { vertices: v, input_triangle_vertices: triangles } = this.result, edges = new Map();
    const at = (k) => new THREE.Vector3(v[3 * k], v[3 * k + 1], v[3 * k + 2]);
    for (let c = 0; c < triangles.length; c += 3) {
      const corners = [0, 1, 2].map((k) => at(triangles[c + k]));
      const normal = new THREE.Triangle(...corners).getNormal(new THREE.Vector3());
      for (let k = 0; k < 3; ++k) {
        const ends = [corners[k], corners[(k + 1) % 3]];
        const key = ends.map((p) => p.toArray().map((x) => Math.round(1000 * x)).join(" ")).sort().join(" ");
        edges.has(key) ? edges.get(key).normals.push(normal) : edges.set(key, { ends, normals: [normal] });
      }
    }
    const isFold = ({ normals: [first, ...rest] }) => !rest.length || rest.some((n) => Math.abs(n.dot(first)) < leastFold);
    return [...edges.values()].filter(isFold).map(({ ends }) => ends);
  }

  edges(triangles) {
    const vertices = this.result.vertices, seen = new Set(), points = [], count = vertices.length / 3;
    for (let c = 0; c < triangles.length; ++c) {
      const a = triangles[c], b = triangles[c % 3 === 2 ? c - 2 : c + 1];
      const key = Math.min(a, b) * count + Math.max(a, b);
      if (seen.has(key)) continue;
      seen.add(key);
      for (const v of [a, b]) points.push(vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(points), 3));
    const lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: 0x9a9a9a }));
    this.object.add(lines);
    return lines;
  }
}
