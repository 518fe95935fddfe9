// A line round the parts that are selected: the same parts, a little larger, seen from inside.

import { THREE } from "nicegui-scene";

const WIDTH = 2.6; // CSS pixels

export class Outline {
  constructor() {
    this.screen = { value: new THREE.Vector2(1, 1) };
    this.material = new THREE.ShaderMaterial({
      vertexShader: /* glsl */ `
        #include <clipping_planes_pars_vertex>
        uniform vec2 screen;
        void main() {
          vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
          #include <clipping_planes_vertex>
          vec4 at = projectionMatrix * mvPosition;
          vec2 off = (projectionMatrix * vec4(mat3(modelViewMatrix) * normal, 0.0)).xy * screen;
          at.xy += normalize(off + 1e-9) * ${(2 * WIDTH).toFixed(1)} / screen * at.w;
          gl_Position = at;
        }`,
      fragmentShader: `#include <clipping_planes_pars_fragment>
        uniform vec3 colour;
        void main() {
          #include <clipping_planes_fragment>
          gl_FragColor = vec4(colour, 1.0);
        }`,
      clipping: true,
      uniforms: { screen: this.screen, colour: { value: new THREE.Vector3() } },
      side: THREE.BackSide,
    });
    this.shown = [];
  }

  // Draw round meshes, each given with the group it moves with.
  show(parts) {
    this.clear();
    for (const { mesh, group } of parts) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(mesh.positions, 3));
      geometry.setAttribute("normal", new THREE.BufferAttribute(mesh.swollen ??= swollen(mesh), 3));
      geometry.setIndex(new THREE.BufferAttribute(mesh.indices, 1));
      const shell = new THREE.Mesh(geometry, this.material);
      group.add(shell);
      this.shown.push(shell);
    }
  }

  clear() {
    for (const shell of this.shown) {
      shell.removeFromParent();
      shell.geometry.dispose();
    }
    this.shown = [];
  }

  dispose() {
    this.clear();
    this.material.dispose();
  }
}

// One direction outwards for all vertices of a point, so that the larger part has no gaps at edges.
function swollen({ normals, points }) {
  const sums = new Float32Array(3 * points.reduce((most, point) => Math.max(most, point + 1), 0));
  points.forEach((point, k) => [0, 1, 2].forEach((c) => (sums[3 * point + c] += normals[3 * k + c])));
  const out = new Float32Array(normals.length);
  points.forEach((point, k) => [0, 1, 2].forEach((c) => (out[3 * k + c] = sums[3 * point + c])));
  return out;
}
