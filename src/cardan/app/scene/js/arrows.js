// Forces as arrows, couples as curls about their axis; both may change with the angle.

import { THREE } from "nicegui-scene";
import { materials, tone } from "./studio.js";

const X = new THREE.Vector3(1, 0, 0);
const CURL = 1.55 * Math.PI; // how far a curl reaches round its axis

export class Arrows {
  constructor(shared) {
    this.root = new THREE.Group();
    this.material = materials(shared, { metal: false });
    for (const one of Object.values(this.material)) one.transparent = true; // drawn last, over all that would bury them
    const rod = new THREE.CylinderGeometry(1, 1, 1, 10, 1).rotateZ(-Math.PI / 2).translate(0.5, 0, 0);
    const head = new THREE.ConeGeometry(1, 1, 16, 1).rotateZ(-Math.PI / 2).translate(0.5, 0, 0);
    const ring = new THREE.TorusGeometry(1, 0.085, 8, 36, CURL).rotateY(Math.PI / 2).rotateX(Math.PI / 2);
    this.shapes = { rod, head, ring };
    this.groups = new Map();
    // What is drawn before them takes the depth of the bodies away, so that none of these lies before an arrow.
    this.wipe = new THREE.Mesh(new THREE.BufferGeometry().setFromPoints([0, 0, 0].map(() => new THREE.Vector3())), this.material.fast);
    Object.assign(this.wipe, { renderOrder: 9, frustumCulled: false, onBeforeRender: (renderer) => renderer.clearDepth() });
    this.root.add(this.wipe);
  }

  show(arrows, motion, size) {
    this.clear();
    this.motion = motion;
    this.size = size;
    const sets = new Map();
    for (const arrow of arrows) {
      if (!sets.has(arrow.group)) sets.set(arrow.group, []);
      sets.get(arrow.group).push(arrow);
    }
    for (const [name, members] of sets) {
      const group = new THREE.Group();
      const straight = members.filter((arrow) => !arrow.curl);
      const curls = members.filter((arrow) => arrow.curl);
      const many = (shape, count) => {
        const mesh = new THREE.InstancedMesh(this.shapes[shape], this.material.fast, count);
        mesh.frustumCulled = false;
        mesh.visible = count > 0;
        mesh.renderOrder = 10;
        group.add(mesh);
        return mesh;
      };
      const entry = {
        group,
        members: [...straight, ...curls],
        rods: many("rod", straight.length),
        rings: many("ring", curls.length),
        heads: many("head", members.length),
      };
      entry.members.forEach((arrow, k) => {
        const colour = new THREE.Color(...tone(arrow.colour));
        entry.heads.setColorAt(k, colour);
        if (arrow.curl) entry.rings.setColorAt(k - straight.length, colour);
        else entry.rods.setColorAt(k, colour);
      });
      this.groups.set(name, entry);
      this.root.add(group);
    }
  }

  quality(fine) {
    this.root.traverse((one) => one.isMesh && (one.material = fine ? this.material.fine : this.material.fast));
  }

  visible(on) {
    for (const [name, { group }] of this.groups) group.visible = on(name);
    this.wipe.visible = this.moving;
  }

  get moving() {
    return [...this.groups.values()].some(({ group }) => group.visible);
  }

  pose(angle) {
    for (const { group, members, rods, rings, heads } of this.groups.values()) {
      if (!group.visible) continue;
      let [rod, ring] = [0, 0];
      members.forEach((arrow, k) => {
        this.motion.vector(arrow.from, angle, FROM);
        this.motion.vector(arrow.vector, angle, VECTOR);
        const length = VECTOR.length();
        if (arrow.curl) curl(this.size, length, rings, ring++, heads, k);
        else straight(this.size, length, rods, rod++, heads, k);
      });
      for (const mesh of [rods, rings, heads]) mesh.instanceMatrix.needsUpdate = true;
    }
  }

  // Where each arrow that can be seen has its text, and how large it is at this angle: [arrow, place, text].
  texts(angle) {
    const found = [];
    for (const { group, members } of this.groups.values()) {
      if (!group.visible) continue;
      for (const arrow of members) {
        const at = this.motion.vector(arrow.from, angle, new THREE.Vector3());
        const vector = this.motion.vector(arrow.vector, angle, VECTOR);
        const length = vector.length();
        if (length > 1e-3 * this.size) found.push([arrow, at.addScaledVector(vector, arrow.curl ? 0.6 : 1.06), told(arrow, length)]);
      }
    }
    return found;
  }

  // The arrow a ray meets first.
  pick(ray, angle) {
    let best = null;
    for (const { group, members, rods, rings, heads } of this.groups.values()) {
      for (const mesh of group.visible ? [rods, rings, heads] : []) {
        mesh.boundingSphere = null; // arrows move
        const [hit] = mesh.visible ? ray.intersectObject(mesh, false) : [];
        if (!hit || (best && best.distance < hit.distance)) continue;
        const arrow = members[hit.instanceId + (mesh === rings ? rods.count : 0)];
        const now = told(arrow, this.motion.vector(arrow.vector, angle, VECTOR).length());
        best = { text: `${arrow.text}\n${now}`, distance: hit.distance };
      }
    }
    return best;
  }

  // Where feet and tips of those that can be seen come to over a turn, for the camera.
  corners() {
    const found = [];
    for (const { group, members } of this.groups.values()) {
      for (const { from, vector } of group.visible ? members : []) {
        for (let k = 0; k < 24; k++) {
          const angle = (k * Math.PI) / 12;
          const foot = this.motion.vector(from, angle, new THREE.Vector3());
          found.push(foot, foot.clone().add(this.motion.vector(vector, angle, VECTOR)));
        }
      }
    }
    return found;
  }

  clear() {
    for (const { group, rods, rings, heads } of this.groups.values()) {
      group.removeFromParent();
      for (const mesh of [rods, rings, heads]) mesh.dispose();
    }
    this.groups.clear();
  }

  dispose() {
    this.clear();
    for (const shape of [...Object.values(this.shapes), this.wipe.geometry]) shape.dispose();
    this.material.fast.dispose();
    this.material.fine.dispose();
  }
}

// The size of an arrow of this length, in the unit that its text is told in.
function told({ scale, unit, decimal }, length) {
  const value = scale * length;
  const digits = Math.max(0, 2 - Math.floor(Math.log10(value)));
  return `${value.toFixed(Math.min(digits, 20)).replace(".", decimal)} ${unit}`;
}

const FROM = new THREE.Vector3();
const VECTOR = new THREE.Vector3();
const PLACE = new THREE.Vector3();
const SCALE = new THREE.Vector3();
const TURN = new THREE.Quaternion();
const SPIN = new THREE.Quaternion();
const MATRIX = new THREE.Matrix4();

function put(mesh, k, place, turn, along, thick) {
  SCALE.set(along, thick, thick);
  mesh.setMatrixAt(k, MATRIX.compose(place, turn, SCALE));
}

function straight(size, length, rods, rod, heads, head) {
  const thick = Math.min(0.0042 * size, 0.06 * length);
  const tip = Math.min(0.03 * size, 0.4 * length);
  TURN.setFromUnitVectors(X, PLACE.copy(VECTOR).divideScalar(length || 1));
  put(rods, rod, FROM, TURN, length - tip, thick);
  put(heads, head, PLACE.copy(FROM).addScaledVector(VECTOR, length ? 1 - tip / length : 0), TURN, tip, 2.6 * thick);
}

function curl(size, length, rings, ring, heads, head) {
  const radius = Math.min(0.04 * size, 0.55 * length) + 0.1 * length;
  TURN.setFromUnitVectors(X, PLACE.copy(VECTOR).divideScalar(length || 1));
  SCALE.setScalar(radius);
  rings.setMatrixAt(ring, MATRIX.compose(FROM, TURN, SCALE));
  // The ring starts at y and turns about x; its head follows it at the end.
  PLACE.set(0, Math.cos(CURL), Math.sin(CURL)).multiplyScalar(radius).applyQuaternion(TURN).add(FROM);
  SPIN.setFromAxisAngle(X, CURL + Math.PI / 2);
  TURN.multiply(SPIN).multiply(SPIN.setFromUnitVectors(X, SCALE.set(0, 1, 0)));
  put(heads, head, PLACE, TURN, 0.55 * radius, 0.26 * radius);
}
