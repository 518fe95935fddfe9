// Translucent planes and sectors, and the curves of mode shapes.

import { THREE } from "nicegui-scene";
import { floats } from "./mesh.js";
import { materials, plain, tone } from "./studio.js";

export class Areas {
  constructor(tracks) {
    this.tracks = tracks;
    this.meshes = [];
  }

  show(areas) {
    this.clear();
    for (const { group, positions, indices, colour, opacity, text, track = 0 } of areas) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
      geometry.setIndex(indices);
      const material = new THREE.MeshBasicMaterial({ transparent: true, opacity, side: THREE.DoubleSide, depthWrite: false });
      material.color.setRGB(...plain(colour), THREE.SRGBColorSpace);
      const mesh = new THREE.Mesh(geometry, material);
      mesh.userData = { group, text };
      mesh.renderOrder = 2;
      this.tracks.groups[track].add(mesh);
      this.meshes.push(mesh);
    }
  }

  visible(on) {
    for (const mesh of this.meshes) mesh.visible = on(mesh.userData.group);
  }

  // The area a ray meets first.
  pick(ray) {
    const [hit] = ray.intersectObjects(this.meshes.filter((mesh) => mesh.visible), false);
    return hit ? { text: hit.object.userData.text, distance: hit.distance } : null;
  }

  clear() {
    for (const mesh of this.meshes) {
      mesh.removeFromParent();
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.meshes = [];
  }
}

const SIDES = 10;

// A round rod along a curve that moves: a mode shape.
export class Curves {
  constructor(shared, tracks) {
    this.tracks = tracks;
    this.meshes = [];
    this.material = materials(shared, { metal: false });
  }

  show(curves, frames) {
    this.clear();
    this.frames = frames;
    for (const { points, colour, radius, track = 0 } of curves) {
      const values = typeof points === "string" ? floats(points) : new Float32Array(points);
      const count = values.length / 3 / frames;
      const rgb = tone(colour);
      const geometry = new THREE.BufferGeometry();
      const vertices = count * SIDES;
      for (const name of ["position", "normal", "tone"]) {
        geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(3 * vertices), 3));
      }
      for (let k = 0; k < 3 * vertices; k++) geometry.attributes.tone.array[k] = rgb[k % 3];
      const indices = [];
      for (let k = 0; k + 1 < count; k++) {
        for (let s = 0; s < SIDES; s++) {
          const [a, b] = [k * SIDES + s, k * SIDES + ((s + 1) % SIDES)];
          indices.push(a, b, b + SIDES, a, b + SIDES, a + SIDES);
        }
      }
      geometry.setIndex(indices);
      const mesh = new THREE.Mesh(geometry, this.material.fast);
      mesh.frustumCulled = false;
      mesh.userData = { values, count, radius };
      this.tracks.groups[track].add(mesh);
      this.meshes.push(mesh);
    }
  }

  // Bend all curves to a place between two frames.
  pose(before, after, share) {
    for (const { geometry, userData } of this.meshes) {
      const { values, count, radius } = userData;
      const point = (k, out) => {
        const [a, b] = [3 * (before * count + k), 3 * (after * count + k)];
        return out.set(...[0, 1, 2].map((c) => values[a + c] + share * (values[b + c] - values[a + c])));
      };
      const { position, normal } = geometry.attributes;
      for (let k = 0; k < count; k++) {
        point(k, HERE);
        point(Math.min(k + 1, count - 1), AHEAD).sub(point(Math.max(k - 1, 0), ACROSS)).normalize();
        ACROSS.set(-AHEAD.y, AHEAD.x, 0);
        if (ACROSS.lengthSq() < 1e-6) ACROSS.set(1, 0, 0);
        ACROSS.normalize();
        OVER.crossVectors(AHEAD, ACROSS);
        for (let s = 0; s < SIDES; s++) {
          const [c, d] = [Math.cos((2 * Math.PI * s) / SIDES), Math.sin((2 * Math.PI * s) / SIDES)];
          SIDE.copy(ACROSS).multiplyScalar(c).addScaledVector(OVER, d);
          normal.setXYZ(k * SIDES + s, SIDE.x, SIDE.y, SIDE.z);
          position.setXYZ(k * SIDES + s, HERE.x + radius * SIDE.x, HERE.y + radius * SIDE.y, HERE.z + radius * SIDE.z);
        }
      }
      position.needsUpdate = true;
      normal.needsUpdate = true;
    }
  }

  quality(fine) {
    for (const mesh of this.meshes) mesh.material = fine ? this.material.fine : this.material.fast;
  }

  clear() {
    for (const mesh of this.meshes) {
      mesh.removeFromParent();
      mesh.geometry.dispose();
    }
    this.meshes = [];
  }

  dispose() {
    this.clear();
    this.material.fast.dispose();
    this.material.fine.dispose();
  }
}

const [HERE, AHEAD, ACROSS, OVER, SIDE] = Array.from({ length: 5 }, () => new THREE.Vector3());
