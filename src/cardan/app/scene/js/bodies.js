// The solid parts: one mesh for all bodies of a track and a material, so that a drive needs few calls to draw.

import { THREE } from "nicegui-scene";
import { coarser } from "./coarse.js";
import { floats, lit, whole } from "./mesh.js";
import { Outline } from "./outline.js";
import { materials, plain, tone } from "./studio.js";

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
    this.outline = new Outline();
    this.meshes = new Map(); // by name of the mesh, for as long as a scene uses it
    this.batches = new Map();
    this.by = "shaft";
    this.fine = false;
    this.thinned = false;
    this.ghost = false;
    this.selected = null;
    this.shown = [];
    this.cut = null; // a plane: what lies behind it is not drawn
  }

  // Cut all bodies at a plane, or make them whole again.
  section(plane) {
    this.cut = plane;
    const kinds = Object.values(this.materials).flatMap(({ fast, fine }) => [fast, fine]);
    for (const material of [...kinds, this.edge]) {
      material.clippingPlanes = plane && [plane];
      if (material !== this.edge) material.side = plane ? THREE.DoubleSide : THREE.FrontSide;
      material.needsUpdate = true;
    }
    this.outline.material.clippingPlanes = plane && [plane];
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
    this.shown = scene.bodies;
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
      if (!wanted.has(key) || content(wanted.get(key)) !== batch.content) {
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
    const full = joined(parts);
    const lines = new THREE.BufferGeometry();
    lines.setAttribute("position", new THREE.BufferAttribute(concatenated(parts, "edges"), 3));
    const solid = new THREE.Mesh(full);
    const edges = new THREE.LineSegments(lines, this.edge);
    return { content: content(members), members, full, coarse: null, solid, edges };
  }

  drop({ solid, edges, full, coarse }) {
    for (const one of [solid, edges]) one.removeFromParent();
    for (const geometry of [full, coarse, edges.geometry]) geometry?.dispose();
  }

  // Make a second form of every mesh with fewer triangles, a little at a time; `done` is called when there is one of all.
  thin(error, done) {
    clearTimeout(this.thinning);
    if (error !== this.error) {
      for (const batch of this.batches.values()) {
        batch.coarse?.dispose();
        batch.coarse = null;
      }
      this.dress();
    }
    this.error = error;
    const step = () => {
      const begun = performance.now();
      for (const mesh of this.meshes.values()) {
        if (mesh.error === error) continue;
        if (performance.now() - begun > 12) {
          this.thinning = setTimeout(step, 30);
          return;
        }
        Object.assign(mesh, { error, thin: coarser(mesh, error) });
      }
      for (const batch of this.batches.values()) {
        batch.coarse ??= joined(batch.members.map((b) => this.meshes.get(b.mesh).thin));
      }
      this.colourBy(this.by);
      this.dress();
      done();
    };
    this.thinning = setTimeout(step, 200);
  }

  // Give every mesh the form and material for this quality and mode; edges take longer than they are worth in motion.
  dress() {
    this.outline.material.visible = !this.ghost;
    for (const { solid, members, edges, full, coarse } of this.batches.values()) {
      const kind = this.materials[this.ghost ? "ghost" : members[0].metal];
      solid.material = this.fine ? kind.fine : kind.fast;
      solid.geometry = this.thinned && coarse ? coarse : full;
      solid.renderOrder = this.ghost ? 2 : 0;
      edges.visible = this.fine && !this.ghost && edges.geometry.attributes.position.count > 0;
    }
  }

  // `pixel`: the size of a pixel on the drive; thinner forms are used where they differ by one and a half at most.
  quality(fine, pixel) {
    const thinned = !fine && 1.5 * pixel > (this.error ?? Infinity);
    if (this.fine === fine && this.thinned === thinned) return;
    this.fine = fine;
    this.thinned = thinned;
    this.dress();
  }

  haunt(ghost) {
    this.ghost = ghost;
    this.dress();
  }

  theme({ edge, mark }, dark) {
    this.edge.color.set(edge);
    this.edge.opacity = dark ? 0.5 : 0.28;
    this.outline.material.uniforms.colour.value.set(...plain(mark));
  }

  // Colour the bodies by shaft or by utilisation.
  colourBy(by) {
    this.by = by;
    for (const { members, full, coarse } of this.batches.values()) {
      for (const geometry of [full, coarse]) {
        if (!geometry) continue;
        const { tone: tones } = geometry.attributes;
        members.forEach((body, k) => {
          const rgb = tone(by === "utilisation" ? (body.utilisation === null ? UNKNOWN : body.utilisation_colour) : body.colour);
          const { vertex, vertices } = geometry.userData.spans[k];
          for (let v = 3 * vertex; v < 3 * (vertex + vertices); v++) tones.array[v] = rgb[v % 3];
        });
        tones.needsUpdate = true;
      }
    }
  }

  // Draw a line round all bodies that a key path speaks of, or that hold the key it names.
  select(path) {
    this.selected = path;
    const within = (one, other) => one === other || one.startsWith(`${other}.`) || one.startsWith(`${other}[`);
    const chosen = this.shown.filter((body) => path && (within(body.path, path) || within(path, body.path)));
    this.outline.show(chosen.map(({ mesh, track }) => ({ mesh: this.meshes.get(mesh), group: this.tracks.groups[track] })));
  }

  // Return the body a ray meets first, with its distance.
  pick(ray) {
    let best = null;
    for (const { members, solid } of this.batches.values()) {
      const hit = ray.intersectObject(solid, false).find(({ point }) => this.cut === null || this.cut.distanceToPoint(point) >= 0);
      if (!hit || (best && best.distance < hit.distance)) continue;
      const { spans } = solid.geometry.userData;
      const k = spans.findIndex(({ index, indices }) => 3 * hit.faceIndex >= index && 3 * hit.faceIndex < index + indices);
      best = { body: members[k], distance: hit.distance, point: hit.point };
    }
    return best;
  }

  // Corners of all bodies where they are now, for the camera.
  corners() {
    const points = [];
    this.tracks.root.updateMatrixWorld(true);
    for (const { solid, full } of this.batches.values()) {
      full.boundingBox ?? full.computeBoundingBox();
      const { min, max } = full.boundingBox;
      for (let k = 0; k < 8; k++) {
        const corner = new THREE.Vector3(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z);
        points.push(corner.applyMatrix4(solid.matrixWorld));
      }
    }
    return points;
  }

  // Points of all surfaces where they are now, as near to one another as a step: where the picture is not free.
  dots(step) {
    const found = [];
    for (const { members, solid } of this.batches.values()) {
      for (const { mesh } of members) {
        const own = this.meshes.get(mesh);
        if (own.step !== step) Object.assign(own, { step, dots: spread(own, step) });
        for (const dot of own.dots) found.push(dot.clone().applyMatrix4(solid.matrixWorld));
      }
    }
    return found;
  }

  dispose() {
    clearTimeout(this.thinning);
    for (const batch of this.batches.values()) this.drop(batch);
    for (const { fast, fine } of Object.values(this.materials)) {
      fast.dispose();
      fine.dispose();
    }
    this.edge.dispose();
    this.outline.dispose();
  }
}

const content = (members) => members.map((b) => `${b.name} ${b.mesh}`).join("\n");

// Points along the edges of all triangles, one a cell of a grid.
function spread({ positions, indices }, step) {
  const found = new Map();
  const [a, b] = [new THREE.Vector3(), new THREE.Vector3()];
  for (let t = 0; t < indices.length; t += 3) {
    for (let c = 0; c < 3; c++) {
      a.fromArray(positions, 3 * indices[t + c]);
      b.fromArray(positions, 3 * indices[t + ((c + 1) % 3)]);
      const count = Math.ceil(a.distanceTo(b) / step);
      for (let k = 0; k <= count; k++) {
        const point = a.clone().lerp(b, k / (count || 1));
        found.set(point.toArray().map((one) => Math.round(one / step)).join(), point);
      }
    }
  }
  return [...found.values()];
}

function concatenated(parts, name) {
  const all = new Float32Array(parts.reduce((total, part) => total + part[name].length, 0));
  parts.reduce((start, part) => (all.set(part[name], start), start + part[name].length), 0);
  return all;
}

// Several meshes as one geometry, which remembers where each begins.
function joined(parts) {
  const positions = concatenated(parts, "positions");
  const indices = new Uint32Array(parts.reduce((total, part) => total + part.indices.length, 0));
  const spans = []; // of each body: first and count of its vertices and of its indices
  let [vertex, index] = [0, 0];
  for (const part of parts) {
    for (let k = 0; k < part.indices.length; k++) indices[index + k] = part.indices[k] + vertex;
    const span = { vertex, vertices: part.positions.length / 3, index, indices: part.indices.length };
    spans.push(span);
    vertex += span.vertices;
    index += span.indices;
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(concatenated(parts, "normals"), 3));
  geometry.setAttribute("tone", new THREE.BufferAttribute(new Float32Array(positions.length), 3));
  geometry.setIndex(new THREE.BufferAttribute(indices, 1));
  geometry.userData.spans = spans;
  return geometry;
}
