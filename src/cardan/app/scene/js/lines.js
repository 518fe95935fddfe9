// Lines of any width in screen pixels, smooth without multisampling; what lies behind a body shows through faintly.

import { THREE } from "nicegui-scene";
import { plain } from "./studio.js";

const VERTEX = /* glsl */ `
attribute vec3 a;
attribute vec3 b;
attribute vec3 tone;
attribute vec3 style; // width, dashed, way along the line where the segment starts
uniform vec2 screen;
varying vec3 vTone;
varying float vAcross;
varying float vHalf;
varying float vAlong;
varying float vDashed;
void main() {
  vec4 start = modelViewMatrix * vec4(a, 1.0);
  vec4 end = modelViewMatrix * vec4(b, 1.0);
  if (projectionMatrix[2][3] != 0.0) { // perspective: cut off what lies behind the camera
    float near = -0.01;
    if (start.z > near && end.z < near) start = mix(start, end, (start.z - near) / (start.z - end.z));
    if (end.z > near && start.z < near) end = mix(end, start, (end.z - near) / (end.z - start.z));
  }
  vec4 p = projectionMatrix * start;
  vec4 q = projectionMatrix * end;
  vec2 along = (q.xy / q.w - p.xy / p.w) * screen;
  float size = length(along);
  along = size > 0.0 ? along / size : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  vHalf = max(style.x, 1.0) * 0.5;
  float reach = vHalf + 0.75;
  vec4 at = position.y < 0.5 ? p : q;
  at.xy += (across * position.x + along * (position.y * 2.0 - 1.0) * 0.3) * reach / screen * 2.0 * at.w;
  vAcross = position.x * reach;
  vAlong = style.z + position.y * distance(a, b);
  vDashed = style.y;
  vTone = tone;
  gl_Position = at;
}
`;

const FRAGMENT = /* glsl */ `
uniform float opacity;
uniform float period;
varying vec3 vTone;
varying float vAcross;
varying float vHalf;
varying float vAlong;
varying float vDashed;
void main() {
  if (vDashed > 0.5) {
    float place = fract(vAlong / period);
    if (place > 0.6 && (place < 0.74 || place > 0.86)) discard;
  }
  float cover = clamp(vHalf + 0.5 - abs(vAcross), 0.0, 1.0);
  gl_FragColor = vec4(vTone, opacity * cover);
}
`;

const QUAD = { corners: [-1, 0, 0, 1, 0, 0, -1, 1, 0, 1, 1, 0], indices: [0, 1, 2, 2, 1, 3] };

export class Lines {
  constructor(tracks, { order = 3, hidden = true } = {}) {
    this.order = order;
    this.hidden = hidden;
    this.tracks = tracks; // of the scene; lines hang in them
    this.screen = { value: new THREE.Vector2(1, 1) };
    this.period = { value: 1 };
    this.sets = [];
    const material = (opacity, depthFunc) =>
      new THREE.ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        uniforms: { screen: this.screen, period: this.period, opacity: { value: opacity } },
        transparent: true,
        depthWrite: false,
        depthFunc,
        side: THREE.DoubleSide,
      });
    this.front = material(0.95, THREE.LessEqualDepth);
    this.behind = material(0.22, THREE.GreaterDepth);
  }

  show(lines, size) {
    this.clear();
    this.period.value = 0.022 * size;
    const sets = new Map();
    for (const line of lines) {
      const key = `${line.track ?? 0} ${line.group}`;
      if (!sets.has(key)) sets.set(key, []);
      sets.get(key).push(line);
    }
    for (const members of sets.values()) {
      const [{ group, track = 0 }] = members;
      const geometry = segments(members);
      const root = new THREE.Group();
      for (const material of this.hidden ? [this.front, this.behind] : [this.front]) {
        const mesh = new THREE.Mesh(geometry, material);
        mesh.frustumCulled = false;
        mesh.renderOrder = this.order;
        root.add(mesh);
      }
      this.sets.push({ group, root, geometry });
      this.tracks.groups[track].add(root);
    }
  }

  visible(on) {
    for (const { group, root } of this.sets) root.visible = on(group);
  }

  clear() {
    for (const { root, geometry } of this.sets) {
      root.removeFromParent();
      geometry.dispose();
    }
    this.sets = [];
  }

  dispose() {
    this.clear();
    this.front.dispose();
    this.behind.dispose();
  }
}

// One instance a segment, each a strip of two triangles that the shader lays along it.
export function segments(lines) {
  const [from, to, tones, styles] = [[], [], [], []];
  for (const { points, colour, dashed, width } of lines) {
    const rgb = plain(colour);
    let way = 0;
    for (let k = 0; k + 5 < points.length; k += 3) {
      const [p, q] = [points.slice(k, k + 3), points.slice(k + 3, k + 6)];
      from.push(...p);
      to.push(...q);
      tones.push(...rgb);
      styles.push(width, dashed ? 1 : 0, way);
      way += Math.hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
    }
  }
  const geometry = new THREE.InstancedBufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(QUAD.corners, 3));
  geometry.setIndex(QUAD.indices);
  for (const [name, values] of Object.entries({ a: from, b: to, tone: tones, style: styles })) {
    geometry.setAttribute(name, new THREE.InstancedBufferAttribute(new Float32Array(values), 3));
  }
  geometry.instanceCount = from.length / 3;
  return geometry;
}
