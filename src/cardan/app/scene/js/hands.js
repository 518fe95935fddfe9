// Mouse, touch and keys on the canvas, beyond turning the picture, which the camera's controls do.

import { THREE } from "nicegui-scene";

const STILL = 5; // pixels a finger may slip and still touch
const STEP = Math.PI / 36;

// Wire a canvas; return a function that takes everything off again.
export function wire(canvas, view) {
  const ray = new THREE.Raycaster();
  const place = new THREE.Vector2();
  let down = null;
  let waiting = null;

  const under = (event, find) => {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    place.set(((event.clientX - left) / width) * 2 - 1, 1 - ((event.clientY - top) / height) * 2);
    ray.setFromCamera(place, view.viewer.camera);
    return find(ray);
  };

  const handlers = {
    pointerdown(event) {
      down = [event.clientX, event.clientY];
      view.tip(null);
    },
    pointerup(event) {
      const near = down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < STILL;
      down = null;
      if (!near || event.button !== 0) return;
      view.touched(under(event, (r) => view.bodies.pick(r)));
    },
    pointermove(event) {
      if (down || event.pointerType === "touch" || waiting) return;
      waiting = setTimeout(() => {
        waiting = null;
        if (!down && view.scene) view.tip(under(event, (r) => view.found(r)), event);
      }, 60);
    },
    pointerleave() {
      clearTimeout(waiting);
      waiting = null;
      view.tip(null);
    },
    dblclick() {
      view.look(view.viewer.view === "free" ? "iso" : view.viewer.view);
    },
    keydown(event) {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const act = KEYS[event.key];
      if (!act) return;
      event.preventDefault();
      act(view);
    },
    contextmenu: (event) => event.preventDefault(),
  };
  for (const [name, handler] of Object.entries(handlers)) canvas.addEventListener(name, handler);
  return () => {
    clearTimeout(waiting);
    for (const [name, handler] of Object.entries(handlers)) canvas.removeEventListener(name, handler);
  };
}

const KEYS = {
  Escape: (view) => view.touched(null),
  f: (view) => view.fit(),
  ArrowLeft: (view) => view.viewer.orbit(-STEP, 0),
  ArrowRight: (view) => view.viewer.orbit(STEP, 0),
  ArrowUp: (view) => view.viewer.orbit(0, -STEP),
  ArrowDown: (view) => view.viewer.orbit(0, STEP),
  "+": (view) => view.viewer.zoom(1.15),
  "=": (view) => view.viewer.zoom(1.15),
  "-": (view) => view.viewer.zoom(1 / 1.15),
  " ": (view) => view.play(!view.playing),
  ",": (view) => view.step(-1),
  ".": (view) => view.step(1),
  1: (view) => view.look("iso"),
  2: (view) => view.look("side"),
  3: (view) => view.look("plan"),
  4: (view) => view.look("front"),
};
