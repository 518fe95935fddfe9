// Triangles as they come from Python, made ready to be lit: normals that break at edges, and those edges as lines.

const SMOOTH = Math.cos((25 * Math.PI) / 180); // faces of a round body that meet at less are one surface, and those with a corner in common
const FLAT = Math.cos((8 * Math.PI) / 180); // faces of a flat body that meet at less are one plane
const EDGE = Math.cos((30 * Math.PI) / 180); // an edge is drawn where faces meet at more
const GRID = 1e6; // points nearer than a micrometre are one point

export function floats(text) {
  return new Float32Array(bytes(text).buffer);
}

export function whole(text) {
  return new Uint32Array(bytes(text).buffer);
}

function bytes(text) {
  const raw = atob(text);
  const out = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; k++) out[k] = raw.charCodeAt(k);
  return out;
}

// Number points that lie on one another alike.
function welded(positions) {
  const seen = new Map();
  const number = new Uint32Array(positions.length / 3);
  for (let k = 0; k < number.length; k++) {
    const [x, y, z] = [0, 1, 2].map((c) => Math.round(positions[3 * k + c] * GRID));
    const key = `${x},${y},${z}`;
    if (!seen.has(key)) seen.set(key, seen.size);
    number[k] = seen.get(key);
  }
  return { number, count: seen.size };
}

// Twice the area vector of each triangle, and the same with length one.
function faces(positions, indices) {
  const area = new Float32Array(indices.length);
  const unit = new Float32Array(indices.length);
  for (let f = 0; f < indices.length; f += 3) {
    const [a, b, c] = [3 * indices[f], 3 * indices[f + 1], 3 * indices[f + 2]];
    const [ux, uy, uz] = [0, 1, 2].map((k) => positions[b + k] - positions[a + k]);
    const [vx, vy, vz] = [0, 1, 2].map((k) => positions[c + k] - positions[a + k]);
    const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const size = Math.hypot(...n) || 1;
    for (let k = 0; k < 3; k++) {
      area[f + k] = n[k];
      unit[f + k] = n[k] / size;
    }
  }
  return { area, unit };
}

const dot = (unit, f, g) => unit[f] * unit[g] + unit[f + 1] * unit[g + 1] + unit[f + 2] * unit[g + 2];

// Corners round each welded point: start[p] ... start[p + 1] of `corner`.
function around(indices, number, count) {
  const start = new Uint32Array(count + 1);
  for (const k of indices) start[number[k] + 1]++;
  for (let p = 0; p < count; p++) start[p + 1] += start[p];
  const next = start.slice();
  const corner = new Uint32Array(indices.length);
  indices.forEach((k, c) => (corner[next[number[k]]++] = c));
  return { start, corner };
}

// Segments where two faces meet at an angle, or one face ends.
function sharp(positions, indices, number, unit) {
  const open = new Map();
  const points = [];
  const add = (a, b) => {
    for (const k of [a, b]) points.push(positions[3 * k], positions[3 * k + 1], positions[3 * k + 2]);
  };
  for (let f = 0; f < indices.length; f += 3) {
    for (let k = 0; k < 3; k++) {
      const [a, b] = [indices[f + k], indices[f + ((k + 1) % 3)]];
      const [p, q] = [number[a], number[b]];
      if (p === q) continue;
      const key = p < q ? p * 4294967296 + q : q * 4294967296 + p;
      const other = open.get(key);
      if (other === undefined) open.set(key, [f, a, b]);
      else {
        open.delete(key);
        if (dot(unit, f, other[0]) < EDGE) add(a, b);
      }
    }
  }
  for (const [, a, b] of open.values()) add(a, b);
  return new Float32Array(points);
}

// Return positions, normals, indices and edges of one mesh, and which vertices lie on one another.
export function lit({ positions, indices, smooth }) {
  const { number, count } = welded(positions);
  const { area, unit } = faces(positions, indices);
  const { start, corner } = around(indices, number, count);
  const least = smooth ? SMOOTH : FLAT;
  const place = [];
  const normal = [];
  const points = []; // the welded point of each vertex
  const index = new Uint32Array(indices.length);
  for (let p = 0; p < count; p++) {
    const made = []; // vertices of this point: [x, y, z, number]
    for (let m = start[p]; m < start[p + 1]; m++) {
      const f = corner[m] - (corner[m] % 3);
      let [x, y, z] = [0, 0, 0];
      for (let o = start[p]; o < start[p + 1]; o++) {
        const g = corner[o] - (corner[o] % 3);
        if (indices[corner[m]] !== indices[corner[o]] && dot(unit, f, g) < least) continue;
        x += area[g];
        y += area[g + 1];
        z += area[g + 2];
      }
      const size = Math.hypot(x, y, z) || 1;
      [x, y, z] = [x / size, y / size, z / size];
      let one = made.find((v) => v[0] * x + v[1] * y + v[2] * z > 0.9999);
      if (!one) {
        one = [x, y, z, place.length / 3];
        made.push(one);
        const at = 3 * indices[corner[m]];
        place.push(positions[at], positions[at + 1], positions[at + 2]);
        normal.push(x, y, z);
        points.push(p);
      }
      index[corner[m]] = one[3];
    }
  }
  return {
    positions: new Float32Array(place),
    normals: new Float32Array(normal),
    indices: index,
    points: Uint32Array.from(points),
    edges: sharp(positions, indices, number, unit),
  };
}
