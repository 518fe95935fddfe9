// Where every track is at an angle of the input: between the frames that Python worked out, by turning evenly.

import { THREE } from "nicegui-scene";
import { floats } from "./mesh.js";

export const TURN = 2 * Math.PI;

export class Motion {
  constructor(scene) {
    this.frames = scene.frames;
    this.tracks = scene.tracks.map(({ origin, turn }) => ({ origin, turn: floats(turn) }));
  }

  // Bring the groups of all tracks to where they are at an angle.
  pose(groups, angle) {
    const [before, after, share] = this.between(angle);
    this.tracks.forEach(({ origin, turn }, k) => {
      slerp(groups[k].quaternion, turn, before, after, share);
      this.vector(origin, angle, groups[k].position);
    });
  }

  // The frames before and after an angle, and the share of the way between them.
  between(angle) {
    const place = ((((angle / TURN) % 1) + 1) % 1) * this.frames;
    const before = Math.floor(place) % this.frames;
    return [before, (before + 1) % this.frames, place - Math.floor(place)];
  }

  // A vector that is the same at all angles, or has one value a frame.
  vector(values, angle, out) {
    if (values.length === 3) return out.fromArray(values);
    const [before, after, share] = this.between(angle);
    const [a, b] = [3 * before, 3 * after];
    const mixed = [0, 1, 2].map((k) => values[a + k] + share * (values[b + k] - values[a + k]));
    return out.set(...mixed);
  }

  // The axis a track turns about, or null when it stands still.
  axis(track) {
    const { turn } = this.tracks[track];
    const first = new THREE.Quaternion().fromArray(turn, 0);
    const change = new THREE.Quaternion().fromArray(turn, 4 * Math.floor(this.frames / 4)).multiply(first.invert());
    const axis = new THREE.Vector3(change.x, change.y, change.z);
    return axis.length() < 1e-3 ? null : axis.normalize();
  }
}

export function slerp(out, turns, before, after, share) {
  const four = [0, 0, 0, 1];
  THREE.Quaternion.slerpFlat(four, 0, turns, 4 * before, turns, 4 * after, share);
  return out.fromArray(four);
}

// One group for each track, in which everything that moves with it hangs.
export class Tracks {
  constructor() {
    this.root = new THREE.Group();
    this.groups = [];
  }

  count(number) {
    while (this.groups.length > number) this.groups.pop().removeFromParent();
    while (this.groups.length < number) {
      const group = new THREE.Group();
      this.groups.push(group);
      this.root.add(group);
    }
  }
}
