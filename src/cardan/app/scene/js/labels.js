// Texts as HTML over the canvas: crisp at any size; where two would lie on one another, the less important one goes.

import { THREE } from "nicegui-scene";

const RANK = { dimension: 0, angle: 1, joint: 2, shaft: 3 }; // what is kept first; others come after
const SHIFTS = [
  [0, -16],
  [0, 16],
  [34, -12],
  [-34, -12],
  [34, 16],
  [-34, 16],
  [0, -34],
  [0, 34],
  [0, -52],
  [0, 52],
];

const SEEN = new THREE.Vector3();

export class Labels {
  constructor(parent, tracks) {
    this.tracks = tracks;
    this.layer = document.createElement("div");
    this.layer.className = "cardan-labels";
    parent.append(this.layer);
    this.still = [];
    this.moving = [];
    this.covered = () => []; // where other things stand in the picture
    this.dots = () => []; // points of the bodies, beside which there is room
  }

  show(labels) {
    this.still.forEach(({ element }) => element.remove());
    this.still = labels.map((label) => ({ ...this.make(label.text, label.role), ...label, place: new THREE.Vector3(...label.at), track: label.track ?? 0 }));
    this.still.sort((a, b) => (RANK[a.role] ?? 9) - (RANK[b.role] ?? 9));
  }

  make(text, role) {
    const element = document.createElement("span");
    element.textContent = text;
    element.dataset.role = role;
    this.layer.append(element);
    return { element, width: 0 };
  }

  visible(on) {
    for (const label of this.still) {
      label.on = on(label.group);
      if (!label.on) label.element.style.visibility = "hidden";
    }
  }

  // Whether any text that is switched on moves with a shaft.
  get turning() {
    return this.still.some((label) => label.on && label.track);
  }

  // Texts of arrows: a list of [arrow, place, text], another one every frame.
  follow(texts) {
    const kept = new Map(this.moving.map((label) => [label.arrow, label]));
    this.moving = texts.map(([arrow, place, text]) => {
      const label = kept.get(arrow) ?? { ...this.make("", "arrow"), arrow, on: true };
      label.element.style.boxShadow = `inset 3px 0 ${arrow.colour}`;
      if (label.element.textContent !== text) Object.assign(label, { width: 0 }).element.textContent = text;
      kept.delete(arrow);
      label.place = place;
      return label;
    });
    for (const { element } of kept.values()) element.remove();
  }

  // Lay all texts out for a camera and a canvas of this size [CSS pixels].
  place(camera, width, height) {
    const taken = this.covered();
    const busy = cells(this.dots(), camera, width, height);
    for (const label of [...this.still, ...this.moving]) {
      if (!label.on) continue;
      const { element } = label;
      if (!label.width) [label.width, label.height] = [element.offsetWidth, element.offsetHeight];
      SEEN.copy(label.place);
      if (label.track) SEEN.applyMatrix4(this.tracks.groups[label.track].matrixWorld);
      SEEN.project(camera);
      const inside = Math.abs(SEEN.x) < 1.05 && Math.abs(SEEN.y) < 1.05 && SEEN.z > -1 && SEEN.z < 1;
      const spot = inside && free(taken, ((SEEN.x + 1) / 2) * width, ((1 - SEEN.y) / 2) * height, label, width, height, busy);
      element.style.visibility = spot ? "visible" : "hidden";
      label.spot = spot || null;
      if (!spot) continue;
      taken.push(spot);
      element.style.transform = `translate(${Math.round(spot.left)}px, ${Math.round(spot.top)}px)`;
    }
  }

  // Draw the texts into a picture.
  paint(context, ratio) {
    context.save();
    context.scale(ratio, ratio);
    context.textBaseline = "middle";
    for (const { element, spot } of [...this.still, ...this.moving]) {
      if (!spot || element.style.visibility !== "visible") continue;
      const style = getComputedStyle(element);
      context.font = style.font;
      context.fillStyle = style.backgroundColor;
      context.beginPath();
      context.roundRect(spot.left, spot.top, spot.right - spot.left, spot.bottom - spot.top, 4);
      context.fill();
      context.fillStyle = style.color;
      context.fillText(element.textContent, spot.left + parseFloat(style.paddingLeft), (spot.top + spot.bottom) / 2 + 1);
    }
    context.restore();
  }
}

const CELL = 12; // CSS pixels

// The cells of the picture in which points lie.
function cells(points, camera, width, height) {
  const found = new Set();
  for (const point of points) {
    SEEN.copy(point).project(camera);
    found.add(`${Math.floor(((SEEN.x + 1) / 2) * (width / CELL))} ${Math.floor(((1 - SEEN.y) / 2) * (height / CELL))}`);
  }
  return found;
}

function covers(busy, { left, top, right, bottom }) {
  for (let x = Math.floor(left / CELL); x * CELL < right; x++) {
    for (let y = Math.floor(top / CELL); y * CELL < bottom; y++) if (busy.has(`${x} ${y}`)) return true;
  }
  return false;
}

// The first place round a point where a text of this size covers no other and no part, or no other if parts are all
// round; null where there is none.
function free(taken, x, y, { width, height }, right, bottom, busy) {
  let second = null;
  for (const [dx, dy] of SHIFTS) {
    const left = Math.min(Math.max(x + dx - width / 2 + Math.sign(dx) * (width / 2 - 17), 2), Math.max(right - width - 2, 2));
    const top = Math.min(Math.max(y + dy - height / 2, 2), Math.max(bottom - height - 2, 2));
    const spot = { left, top, right: left + width, bottom: top + height };
    const hit = taken.some((o) => o.left < spot.right && spot.left < o.right && o.top < spot.bottom && spot.top < o.bottom);
    if (!hit && !covers(busy, spot)) return spot;
    if (!hit) second ??= spot;
  }
  return second;
}
