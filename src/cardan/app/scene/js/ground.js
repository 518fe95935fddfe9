// The floor: a quiet grid, and the soft shade of the drive on it, drawn once for a scene.

import { THREE } from "nicegui-scene";
import { Lines } from "./lines.js";
import { plain } from "./studio.js";

const CELLS = 96; // of the shade, each way, as it is measured
const BLUR = 3;
const DEPTH = 0.6; // of the shade where no light comes at all
const [ACROSS, DEEP] = [36, 24]; // cells of the floor: its colours are kept in their corners, which draws faster than a picture

export class Ground {
  constructor() {
    this.root = new THREE.Group();
    const geometry = new THREE.PlaneGeometry(1, 1, ACROSS, DEEP);
    this.cells = geometry.index.array;
    geometry.setAttribute("tone", new THREE.BufferAttribute(new Uint8Array(4 * (ACROSS + 1) * (DEEP + 1)), 4, true));
    const material = new THREE.ShaderMaterial({
      vertexShader: `attribute vec4 tone; varying vec3 vTone;
        void main() { vTone = tone.rgb; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
      fragmentShader: `varying vec3 vTone; void main() { gl_FragColor = vec4(vTone, 1.0); }`,
      depthWrite: false,
      depthTest: false,
    });
    this.plane = new THREE.Mesh(geometry, material);
    this.plane.renderOrder = -2;
    this.lines = new Lines({ groups: [this.root] }, { order: -1, hidden: false });
    this.root.add(this.plane);
  }

  theme(theme) {
    this.colours = theme;
    if (!this.box) return;
    this.paint();
    this.rule();
  }

  // Lay the floor under the bodies, and their shade on it.
  lay(bodies, size, renderer) {
    const box = new THREE.Box3().setFromPoints(bodies.corners());
    const low = box.min.z - 0.035 * size;
    const centre = box.getCenter(new THREE.Vector3());
    const wide = box.max.x - box.min.x + 0.9 * size;
    const deep = box.max.y - box.min.y + 0.7 * size;
    this.box = { low, centre, wide, deep, size };
    this.plane.position.set(centre.x, centre.y, low);
    this.plane.scale.set(wide, deep, 1);
    this.rule();
    this.darken(renderer, bodies, box.max.z);
  }

  rule() {
    const { low, centre, wide, deep, size } = this.box;
    const raw = size / 10;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].find((n) => n * power >= raw) * power;
    const lines = [];
    const line = (points) => lines.push({ group: "grid", points, colour: this.colours.grid, dashed: false, width: 1 });
    // Within the ellipse in which the floor can be seen.
    for (let x = Math.ceil((centre.x - wide / 2) / step) * step; x < centre.x + wide / 2; x += step) {
      const half = 0.42 * deep * Math.sqrt(Math.max(0.86 - ((2 * (x - centre.x)) / wide) ** 2, 0));
      if (half) line([x, centre.y - half, low, x, centre.y + half, low]);
    }
    for (let y = Math.ceil((centre.y - deep / 2) / step) * step; y < centre.y + deep / 2; y += step) {
      const half = 0.42 * wide * Math.sqrt(Math.max(0.86 - ((2 * (y - centre.y)) / deep) ** 2, 0));
      if (half) line([centre.x - half, y, low, centre.x + half, y, low]);
    }
    this.lines.show(lines, size);
  }

  darken(renderer, bodies, top) {
    const { low, centre, wide, deep, size } = this.box;
    const camera = new THREE.OrthographicCamera(-wide / 2, wide / 2, deep / 2, -deep / 2, 0, top - low + size);
    camera.position.set(centre.x, centre.y, top + 0.5 * size);
    camera.lookAt(centre.x, centre.y, low);
    const target = new THREE.WebGLRenderTarget(CELLS, CELLS);
    const stage = new THREE.Scene();
    const white = new THREE.MeshBasicMaterial({ color: "#ffffff", side: THREE.DoubleSide });
    for (const { solid } of bodies.batches.values()) {
      const copy = new THREE.Mesh(solid.geometry, white);
      copy.applyMatrix4(solid.matrixWorld);
      stage.add(copy);
    }
    renderer.setRenderTarget(target);
    renderer.setClearColor("#000000");
    renderer.render(stage, camera);
    const seen = new Uint8Array(4 * CELLS * CELLS);
    renderer.readRenderTargetPixels(target, 0, 0, CELLS, CELLS, seen);
    renderer.setRenderTarget(null);
    target.dispose();
    white.dispose();
    let values = Float32Array.from({ length: CELLS * CELLS }, (_, k) => seen[4 * k]);
    for (let pass = 0; pass < 3; pass++) values = blurred(blurred(values, 1), CELLS);
    this.shade = values;
    this.paint();
  }

  // Colour the corners of the floor, and draw no more of it than what is shaded: the rest is the background.
  paint() {
    const [back, dark] = ["back", "shade"].map((name) => plain(this.colours[name]));
    const { geometry } = this.plane;
    const { uv, tone } = geometry.attributes;
    const cell = (share) => Math.min(Math.floor(share * CELLS), CELLS - 1);
    const shades = Array.from({ length: uv.count }, (_, k) => this.shade[cell(uv.getY(k)) * CELLS + cell(uv.getX(k))] / 255);
    shades.forEach((shade, k) => {
      for (let c = 0; c < 3; c++) tone.array[4 * k + c] = Math.round(255 * (back[c] + DEPTH * shade * (dark[c] - back[c])));
    });
    tone.needsUpdate = true;
    const kept = [];
    for (let k = 0; k < this.cells.length; k += 3) {
      const corners = this.cells.slice(k, k + 3);
      if (corners.some((corner) => shades[corner] > 0.01)) kept.push(...corners);
    }
    geometry.setIndex(kept);
  }

  dispose() {
    this.lines.dispose();
    this.plane.geometry.dispose();
    this.plane.material.dispose();
  }
}

// The mean over neighbours `step` apart.
function blurred(values, step) {
  const out = new Float32Array(values.length);
  const across = step === 1 ? CELLS : 1;
  for (let line = 0; line < CELLS; line++) {
    for (let k = 0; k < CELLS; k++) {
      let sum = 0;
      for (let n = Math.max(k - BLUR, 0); n <= Math.min(k + BLUR, CELLS - 1); n++) sum += values[line * across + n * step];
      out[line * across + k * step] = sum / (2 * BLUR + 1);
    }
  }
  return out;
}
