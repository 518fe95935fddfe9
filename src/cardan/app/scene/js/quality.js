// How well to draw: as well as the machine can while things move, at its best when they rest.

const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;
const LEVELS = [
  { fine: true, ratio: 2 },
  { fine: true, ratio: 1 },
  { fine: false, ratio: 1 },
  { fine: false, ratio: 0.75 },
  { fine: false, ratio: 0.55 },
];
const SLOW = 1000 / 45; // ms a frame above which a lower level is tried
const LOOK = 30; // frames to judge by

export function software(gl) {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  return SOFTWARE.test(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER) ?? "");
}

export class Quality {
  constructor(slow) {
    this.level = slow ? 2 : 0;
    this.first = this.level;
    this.stamps = []; // of the frames of the last two seconds
    this.gaps = [];
    this.last = null;
    this.retry = 20_000;
    this.changed = 0;
  }

  // What to draw with: while moving, and at rest.
  get moving() {
    return limited(LEVELS[this.level]);
  }

  get resting() {
    return { fine: true, ratio: Math.max(Math.min(window.devicePixelRatio, 2), this.first ? 2 : 1) };
  }

  // A frame was drawn at this time; `running`: the one before was drawn just before it.
  drawn(now, running) {
    this.stamps.push(now);
    while (this.stamps[0] < now - 2000) this.stamps.shift();
    if (running && this.last !== null) this.judge(now, now - this.last);
    this.last = now;
  }

  judge(now, gap) {
    if (gap > 400) return; // the page was busy or away
    this.gaps.push(gap);
    if (this.gaps.length < LOOK) return;
    const middle = this.gaps.sort((a, b) => a - b)[LOOK >> 1];
    this.gaps = [];
    if (middle > SLOW && this.level < LEVELS.length - 1) {
      if (now - this.changed < this.retry / 2) this.retry *= 2; // going up again did not last
      this.level += 1;
      this.changed = now;
    } else if (middle < SLOW && this.level > this.first && now - this.changed > this.retry) {
      this.level -= 1;
      this.changed = now;
    }
  }

  get fps() {
    const now = performance.now();
    return this.stamps.filter((stamp) => stamp > now - 2000).length / 2;
  }
}

function limited({ fine, ratio }) {
  return { fine, ratio: Math.min(ratio, Math.max(window.devicePixelRatio, 1)) };
}
