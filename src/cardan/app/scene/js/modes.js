// Mode shapes: bent centre lines that whirl, and shafts that twist to and fro.

import { THREE } from "nicegui-scene";
import { floats } from "./mesh.js";
import { slerp } from "./motion.js";

const EXTRA = new THREE.Quaternion();
const PERIOD = 1800; // ms of one swing, slow enough to follow with the eye

export class Modes {
  constructor(curves) {
    this.curves = curves;
    this.all = [];
    this.index = null;
    this.time = PERIOD / 4; // stopped, a mode shows its greatest deflection
  }

  show(modes) {
    this.all = modes;
    this.choose(this.index);
  }

  choose(index) {
    this.index = index;
    this.chosen = this.all[index] ?? null;
    /** @type {[number, Float32Array][]} */
    this.turns = Object.entries(this.chosen?.turns ?? {}).map(([track, turn]) => [
      Number(track),
      typeof turn === "string" ? floats(turn) : Float32Array.from(turn),
    ]);
    if (this.chosen) this.curves.show(this.chosen.curves, this.chosen.frames);
    else this.curves.clear();
  }

  // Whether solid bodies stand back behind bent lines.
  get whirls() {
    return this.chosen?.kind === "whirl";
  }

  advance(passed) {
    this.time = (this.time + passed) % PERIOD;
  }

  pose(tracks) {
    if (!this.chosen) return;
    const place = (this.time / PERIOD) * this.chosen.frames;
    const before = Math.floor(place) % this.chosen.frames;
    const after = (before + 1) % this.chosen.frames;
    const share = place - Math.floor(place);
    for (const [track, turn] of this.turns) tracks[track].quaternion.premultiply(slerp(EXTRA, turn, before, after, share));
    this.curves.pose(before, after, share);
  }
}
