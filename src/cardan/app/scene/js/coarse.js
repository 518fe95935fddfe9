// The same body with fewer triangles, for renderers that work without a graphics card while things move.
//
// Corners are moved onto a neighbour, one edge at a time, as long as the surface stays within `error` of where it was
// and its shading keeps its seams: a corner where several smooth surfaces meet only moves along their common edge.

const TURN = 0.5; // cosine of how far a triangle may tilt
const BEND = 0.3; // cosine of how far the direction of shading may jump
const PASSES = 14;

export function coarser(mesh, error) {
  const work = new Work(mesh);
  for (let pass = 1; pass <= PASSES; pass++) {
    if (work.pass(error * Math.min(1, 0.25 * pass)) === 0 && pass >= 4) break;
  }
  return work.result();
}

class Work {
  constructor({ positions, normals, indices, points }) {
    this.positions = positions;
    this.normals = normals;
    this.points = points;
    this.corners = indices.slice(); // vertices of the triangles that are left
    this.alive = new Uint8Array(indices.length / 3).fill(1);
    const count = points.reduce((most, point) => Math.max(most, point + 1), 0);
    this.place = new Float64Array(3 * count);
    points.forEach((point, vertex) => {
      for (let c = 0; c < 3; c++) this.place[3 * point + c] = positions[3 * vertex + c];
    });
    this.faces = Array.from({ length: count }, () => []);
    indices.forEach((vertex, k) => this.faces[points[vertex]].push(Math.floor(k / 3)));
    this.spent = new Float64Array(count); // how far the surface has gone here
    this.touched = new Int32Array(count);
    this.round = 0;
  }

  // Try once to move every point; return how many went.
  pass(error) {
    this.round += 1;
    let gone = 0;
    for (let point = 0; point < this.faces.length; point++) {
      if (this.touched[point] === this.round || !this.faces[point].length) continue;
      const around = this.neighbours(point);
      const near = [...around].sort((a, b) => this.distance(point, a) - this.distance(point, b));
      if (near.some((other) => this.move(point, other, around, error))) gone += 1;
    }
    return gone;
  }

  neighbours(point) {
    const found = new Set();
    for (const f of this.faces[point]) {
      for (let c = 0; c < 3; c++) found.add(this.points[this.corners[3 * f + c]]);
    }
    found.delete(point);
    return found;
  }

  distance(a, b) {
    const p = this.place;
    return (p[3 * a] - p[3 * b]) ** 2 + (p[3 * a + 1] - p[3 * b + 1]) ** 2 + (p[3 * a + 2] - p[3 * b + 2]) ** 2;
  }

  // Move a point onto a neighbour if all allows it.
  move(point, other, around, error) {
    const { corners, points } = this;
    const at = (f, wanted) => [0, 1, 2].find((c) => points[corners[3 * f + c]] === wanted);
    const lost = this.faces[point].filter((f) => at(f, other) !== undefined);
    if (lost.length !== 2) return false;
    const onto = new Map(lost.map((f) => [corners[3 * f + at(f, point)], corners[3 * f + at(f, other)]]));
    for (const [from, to] of onto) {
      let dot = 0;
      for (let c = 0; c < 3; c++) dot += this.normals[3 * from + c] * this.normals[3 * to + c];
      if (dot < BEND) return false;
    }
    const left = this.faces[point].filter((f) => !lost.includes(f));
    let common = 0;
    for (const one of this.neighbours(other)) common += around.has(one) ? 1 : 0;
    if (common !== 2) return false;
    let way = 0;
    for (const f of left) {
      if (!onto.has(corners[3 * f + at(f, point)])) return false;
      const tilt = this.tilt(f, point, other);
      if (tilt === null) return false;
      way = Math.max(way, tilt);
    }
    if (this.spent[point] + way > error) return false;
    this.spent[other] = Math.max(this.spent[other], this.spent[point] + way);
    for (const f of left) {
      const c = 3 * f + at(f, point);
      corners[c] = onto.get(corners[c]);
      this.faces[other].push(f);
    }
    for (const f of lost) {
      this.alive[f] = 0;
      for (let c = 0; c < 3; c++) {
        const list = this.faces[points[corners[3 * f + c]]];
        const k = list.indexOf(f);
        if (k >= 0) list.splice(k, 1);
      }
    }
    this.faces[point] = [];
    for (const one of around) this.touched[one] = this.round;
    return true;
  }

  // How far a point lies from a triangle that it leaves for another corner; null where that tilts it too far.
  tilt(f, point, other) {
    const spots = [0, 1, 2].map((c) => this.points[this.corners[3 * f + c]]);
    const before = this.normal(spots);
    const after = this.normal(spots.map((spot) => (spot === point ? other : spot)));
    const [b, a] = [Math.hypot(...before), Math.hypot(...after)];
    if (a < 1e-12) return null;
    const dot = before[0] * after[0] + before[1] * after[1] + before[2] * after[2];
    if (b > 1e-12 && dot < TURN * a * b) return null;
    let way = 0;
    for (let c = 0; c < 3; c++) way += (after[c] / a) * (this.place[3 * point + c] - this.place[3 * other + c]);
    return Math.abs(way);
  }

  /** @param {number[]} corners */
  normal([i, j, k]) {
    const p = this.place;
    const [ux, uy, uz] = [0, 1, 2].map((c) => p[3 * j + c] - p[3 * i + c]);
    const [vx, vy, vz] = [0, 1, 2].map((c) => p[3 * k + c] - p[3 * i + c]);
    return [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
  }

  // What is left, with its vertices in the order of their use.
  result() {
    const number = new Map();
    const indices = [];
    this.alive.forEach((alive, f) => {
      for (let c = 0; alive && c < 3; c++) {
        const vertex = this.corners[3 * f + c];
        if (!number.has(vertex)) number.set(vertex, number.size);
        indices.push(number.get(vertex));
      }
    });
    const pick = (values) => Float32Array.from([...number.keys()].flatMap((v) => [values[3 * v], values[3 * v + 1], values[3 * v + 2]]));
    return { positions: pick(this.positions), normals: pick(this.normals), indices: Uint32Array.from(indices) };
  }
}
