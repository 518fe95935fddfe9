// The solid parts: one mesh for all bodies of a track and a material, so that a drive needs few calls to draw.

import { THREE } from "nicegui-scene";
import { floats, lit, whole } from "./mesh.js";
import { materials, tone } from "./studio.js";

const UNKNOWN = "#9aa3ad"; // a body without a utilisation, where colours show utilisation

export class Bodies {
  constructor(shared, tracks) {
    this.tracks = tracks;
    this.materials = {
      true: materials(shared, { metal: true }),
      false: materials(shared, { metal: false }),
      ghost: materials(shared, { metal: false, ghost: true }),
    };
    this.edge = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.28 });
    this.mark = new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.38, depthWrite: false });
    this.meshes = new Map(); // by name of the mesh, for as long as a scene uses it
    this.batches = new Map();
    this.by = "shaft";
    this.fine = false;
    this.ghost = false;
    this.selected = null;
  }

  // Which meshes of a scene are neither sent with it nor known from before.
  lacking(scene) {
    return scene.bodies.map((b) => b.mesh).filter((key) => !this.meshes.has(key) && !scene.meshes[key]);
  }

  show(scene) {
    const kept = new Map();
    for (const { mesh, smooth } of scene.bodies) {
      if (kept.has(mesh)) continue;
      const sent = scene.meshes[mesh];
      kept.set(mesh, this.meshes.get(mesh) ?? lit({ positions: floats(sent.positions), indices: whole(sent.indices), smooth }));
    }
    this.meshes = kept;
    this.fill(scene.bodies);
    this.colourBy(this.by);
    this.select(this.selected);
  }

  // Make the meshes whose bodies have changed, and leave the others on the graphics card.
  fill(bodies) {
    const wanted = new Map();
    for (const body of bodies) {
      const key = `${body.track}/${body.metal}`;
      if (!wanted.has(key)) wanted.set(key, []);
      wanted.get(key).push(body);
    }
    for (const [key, batch] of this.batches) {
      const same = wanted.get(key)?.map((b) => `${b.name} ${b.mesh}`).join("\n") === batch.content;
      if (!same) {
        this.drop(batch);
        this.batches.delete(key);
      }
    }
    for (const [key, members] of wanted) {
      const batch = this.batches.get(key) ?? this.batch(members);
      batch.members = members;
      batch.solid.parent ?? this.tracks.groups[members[0].track].add(batch.solid, batch.edges);
      this.batches.set(key, batch);
    }
    this.dress();
  }

  batch(members) {
    const parts = members.map((b) => this.meshes.get(b.mesh));
    const sum = (pick) => parts.reduce((total, part) => total + part[pick].length, 0);
    const positions = new Float32Array(sum("positions"));
    const normals = new Float32Array(sum("positions"));
    const indices = new Uint32Array(sum("indices"));
    const edges = new Float32Array(sum("edges"));
    const spans = []; // of each body: first and count of its vertices and of its indices
    let [p, i, e] = [0, 0, 0];
    for (const part of parts) {
      positions.set(part.positions, p);
      normals.set(part.normals, p);
      edges.set(part.edges, e);
      for (let k = 0; k < part.indices.length; k++) indices[i + k] = part.indices[k] + p / 3;
      spans.push({ vertex: p / 3, vertices: part.positions.length / 3, index: i, indices: part.indices.length });
      p += part.positions.length;
      i += part.indices.length;
      e += part.edges.length;
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
    geometry.setAttribute("tone", new THREE.BufferAttribute(new Float32Array(positions.length), 3));
    geometry.setIndex(new THREE.BufferAttribute(indices, 1));
    const lines = new THREE.BufferGeometry();
    lines.setAttribute("position", new THREE.BufferAttribute(edges, 3));
    const solid = new THREE.Mesh(geometry);
    const seams = new THREE.LineSegments(lines, this.edge);
    seams.visible = edges.length > 0;
    return { content: members.map((b) => `${b.name} ${b.mesh}`).join("\n"), members, spans, solid, edges: seams };
  }

  drop({ solid, edges }) {
    for (const one of [solid, edges]) {
      one.removeFromParent();
      one.geometry.dispose();
    }
  }

  // Give every mesh the material for this quality and mode; edges take longer than they are worth while it is fast.
  dress() {
    for (const { solid, members, edges } of this.batches.values()) {
      const kind = this.materials[this.ghost ? "ghost" : members[0].metal];
      solid.material = this.fine ? kind.fine : kind.fast;
      solid.renderOrder = this.ghost ? 2 : 0;
      edges.visible = this.fine && !this.ghost && edges.geometry.attributes.position.count > 0;
    }
  }

  quality(fine) {
    if (this.fine === fine) return;
    this.fine = fine;
    this.dress();
  }

  haunt(ghost) {
    this.ghost = ghost;
    this.dress();
  }

  theme({ edge }, dark) {
    this.edge.color.set(edge);
    this.edge.opacity = dark ? 0.5 : 0.28;
    this.mark.color.set(dark ? "#7cc0ff" : "#0a6cff");
  }

  colourBy(by) {
    this.by = by;
    for (const { members, spans, solid } of this.batches.values()) {
      const { tone: tones } = solid.geometry.attributes;
      members.forEach((body, k) => {
        const colour = by === "utilisation" ? (body.utilisation === null ? UNKNOWN : body.utilisation_colour) : body.colour;
        const rgb = tone(colour);
        const { vertex, vertices } = spans[k];
        for (let v = 3 * vertex; v < 3 * (vertex + vertices); v++) tones.array[v] = rgb[v % 3];
      });
      tones.needsUpdate = true;
    }
  }

  // Return the body a ray meets first, with the place.
  pick(ray) {
    let best = null;
    for (const { members, spans, solid } of this.batches.values()) {
      const [hit] = ray.intersectObject(solid, false);
      if (!hit || (best && best.distance < hit.distance)) continue;
      const k = spans.findIndex(({ index, indices }) => 3 * hit.faceIndex >= index && 3 * hit.faceIndex < index + indices);
      best = { body: members[k], distance: hit.distance, point: hit.point };
    }
    return best;
  }

  // Mark all bodies that belong to a key path.
  select(path) {
    this.selected = path;
    for (const one of this.marks ?? []) {
      one.removeFromParent();
      one.geometry.dispose();
    }
    this.marks = [];
    if (!path) return;
    for (const { members, spans, solid } of this.batches.values()) {
      members.forEach((body, k) => {
        if (body.path !== path) return;
        const part = new THREE.BufferGeometry();
        part.setAttribute("position", new THREE.BufferAttribute(solid.geometry.attributes.position.array, 3));
        part.setIndex(new THREE.BufferAttribute(solid.geometry.index.array.slice(spans[k].index, spans[k].index + spans[k].indices), 1));
        const mark = new THREE.Mesh(part, this.mark);
        mark.renderOrder = 1;
        solid.parent.add(mark);
        this.marks.push(mark);
      });
    }
  }

  // Corners of all bodies where they are now, for the camera.
  corners() {
    const points = [];
    this.tracks.root.updateMatrixWorld(true);
    for (const { solid } of this.batches.values()) {
      solid.geometry.boundingBox ?? solid.geometry.computeBoundingBox();
      const { min, max } = solid.geometry.boundingBox;
      for (let k = 0; k < 8; k++) {
        const corner = new THREE.Vector3(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z);
        points.push(corner.applyMatrix4(solid.matrixWorld));
      }
    }
    return points;
  }

  dispose() {
    this.select(null);
    for (const batch of this.batches.values()) this.drop(batch);
    for (const { fast, fine } of Object.values(this.materials)) {
      fast.dispose();
      fine.dispose();
    }
    this.edge.dispose();
    this.mark.dispose();
  }
}
