// The 3-D view of a drive: what Python describes, drawn; it turns between frames that Python worked out.
//
// Other parts of the page follow without the server: every drawn frame sends "cardan-angle" {angle, view} to the
// window (without a graphics card ten a second do), and the view turns to the angle of a "cardan-go-to" {angle}.
// `window.cardanView` is the view made last.

import { THREE } from "nicegui-scene";
import { Areas, Curves } from "./areas.js";
import { Arrows } from "./arrows.js";
import { Bodies } from "./bodies.js";
import { Viewer, VIEWS } from "./camera.js";
import { Cube } from "./cube.js";
import { Ground } from "./ground.js";
import { wire } from "./hands.js";
import { Labels } from "./labels.js";
import { Lines } from "./lines.js";
import { Measure } from "./measure.js";
import { Modes } from "./modes.js";
import { Motion, Tracks, TURN } from "./motion.js";
import { furnished, picture } from "./page.js";
import { Quality, software } from "./quality.js";
import { THEMES, uniforms } from "./studio.js";

const REST = 160; // ms without motion until the picture is drawn at its best
const THIN = [700, 320]; // without a graphics card, moving bodies keep to their form within a pixel: this part of the whole
const NEAR = 0.03; // a camera that stands so near to where it should, beside its distance, may stay
const QUIET = 300; // ms without an edit until the floor follows
const HOLD = 200; // ms at most that the picture waits for an edit to be worked on
const EDITS = ["change", "cardan-moving"]; // what comes from fields, and from points that are dragged
const FOLLOW = 100; // ms between two angles told to the page where every change of it costs a frame
const BUSY = 1000; // ms that a frame may take and the drive still turns as fast as is said
const HEARD = 100; // ms between two angles told to the server
const mounted = [];

// Return a view inside an element, or null where the browser has no WebGL: the element then says so.
export function open(root, texts, emit) {
  const page = furnished(root, texts);
  const canvas = page.canvas;
  const probe = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: false });
  const slow = probe ? software(probe) : false;
  probe?.getExtension("WEBGL_lose_context")?.loseContext();
  const context = probe && canvas.getContext("webgl2", { alpha: false, antialias: !slow, desynchronized: slow, powerPreference: "high-performance" });
  if (!context) {
    page.say(texts.no_webgl);
    return null;
  }
  return new View(page, context, slow, emit);
}

class View {
  constructor(page, context, slow, emit) {
    this.page = page;
    this.slow = slow;
    this.emit = emit;
    this.playing = false;
    this.rate = 6;
    this.angle = 0;
    this.groupsOn = null;
    this.scene = null;
    this.selected = null;
    this.width = 0;
    this.height = 0;
    this.renderer = new THREE.WebGLRenderer({ canvas: page.canvas, context });
    this.renderer.debug.checkShaderErrors = false;
    this.renderer.info.autoReset = true;
    this.renderer.localClippingEnabled = true;
    this.stage = new THREE.Scene();
    this.shared = uniforms();
    this.tracks = new Tracks();
    this.bodies = new Bodies(this.shared, this.tracks);
    this.lines = new Lines(this.tracks);
    this.areas = new Areas(this.tracks);
    this.arrows = new Arrows(this.shared);
    this.ground = new Ground();
    this.modes = new Modes(new Curves(this.shared, this.tracks));
    this.labels = new Labels(page.root, this.tracks);
    this.measuring = new Measure(this.stage, emit);
    this.cube = new Cube(page.root, page.texts.sides, (name) => this.look(name));
    this.labels.covered = () => [this.cube.spot, ...page.covered];
    this.labels.dots = () => this.bodies.dots(this.scene.size / 90);
    this.parts = [this.bodies, this.lines, this.areas, this.arrows, this.ground, this.modes.curves, this.measuring];
    this.stage.add(this.ground.root, this.tracks.root, this.arrows.root);
    this.quality = new Quality(slow);
    this.calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.viewer = new Viewer(page.canvas, () => this.draw());
    this.undo = [wire(page.canvas, this), ...this.listen()];
    this.theme("light");
    mounted.push(this);
    window.cardanView = this;
  }

  listen() {
    const { canvas, root } = this.page;
    const goTo = (/** @type {Event} */ event) => this.goTo(/** @type {CustomEvent} */ (event).detail.angle);
    const lost = (event) => {
      event.preventDefault();
      this.page.say(this.page.texts.lost);
    };
    const found = () => {
      this.page.say(null);
      this.floor();
      this.draw();
    };
    window.addEventListener("cardan-go-to", goTo);
    canvas.addEventListener("webglcontextlost", lost);
    canvas.addEventListener("webglcontextrestored", found);
    const sized = new ResizeObserver(() => this.resize());
    sized.observe(root);
    const edited = () => this.slow && this.hold();
    for (const name of EDITS) document.addEventListener(name, edited, true);
    const seen = new IntersectionObserver(([{ isIntersecting }]) => {
      this.hidden = !isIntersecting;
      this.draw();
    });
    seen.observe(root);
    return [
      () => window.removeEventListener("cardan-go-to", goTo),
      () => canvas.removeEventListener("webglcontextlost", lost),
      () => canvas.removeEventListener("webglcontextrestored", found),
      () => sized.disconnect(),
      () => EDITS.forEach((name) => document.removeEventListener(name, edited, true)),
      () => seen.disconnect(),
    ];
  }

  // Show a whole scene; false where it counts on meshes that are not here (the sender then sends all).
  show(scene) {
    if (this.bodies.lacking(scene).length) return false;
    const first = !this.scene || moved(this.scene, scene);
    this.scene = scene;
    this.motion = new Motion(scene);
    for (const part of [this.lines, this.areas, this.modes.curves]) part.clear();
    this.tracks.count(scene.tracks.length);
    this.bodies.show(scene);
    this.motion.pose(this.tracks.groups, this.angle);
    this.viewer.size = scene.size;
    this.lines.show(scene.lines, scene.size);
    this.areas.show(scene.areas);
    this.arrows.show(scene.arrows, this.motion, scene.size);
    this.labels.show(scene.labels);
    this.modes.show(scene.modes);
    this.bodies.haunt(this.modes.whirls);
    this.switch();
    clearTimeout(this.laying);
    if (first) this.floor();
    else this.laying = setTimeout(() => this.relay(), QUIET);
    if (first) this.look(this.viewer.view, false);
    this.explain();
    this.thin();
    this.release();
    return true;
  }

  // Without a graphics card, fewer triangles: as many as can be told apart.
  thin() {
    if (!this.slow || !this.sized) return;
    const [least, most] = THIN.map((part) => this.scene.size / part);
    const error = this.bodies.error ?? 0;
    const pixel = Math.min(Math.max(this.viewer.pixel, least), most);
    const keep = pixel / error < 1.3 && error / pixel < 1.3; // the forms there are will do
    this.bodies.thin(keep ? error : pixel, () => this.draw());
  }

  // The floor of a drive that was edited, once the user is quiet: its shade is read back, which takes its time. The
  // camera finds the whole drive again, unless the user has put it somewhere.
  relay() {
    this.floor();
    if (!this.viewer.own) this.fit();
    this.draw();
  }

  floor() {
    if (this.scene) this.ground.lay(this.bodies, this.scene.size, this.renderer);
  }

  groups(on) {
    const same = this.groupsOn && `${[...this.groupsOn]}` === `${on}`;
    this.groupsOn = new Set(on);
    this.switch();
    if (!same && this.sized && !this.viewer.own) this.fit();
  }

  switch() {
    const known = new Map((this.scene?.groups ?? []).map(({ name, on }) => [name, on]));
    const on = (name) => (known.has(name) && this.groupsOn ? this.groupsOn.has(name) : known.get(name) ?? true);
    for (const part of [this.lines, this.areas, this.arrows, this.labels]) part.visible(on);
    this.draw();
  }

  mode(index) {
    this.modes.choose(index);
    this.bodies.haunt(this.modes.whirls);
    this.draw();
  }

  // Start or stop; `first`: not asked for by the user, so a user who wants calm keeps it.
  play(on, first = false) {
    const next = on && !(first && this.calm);
    if (next !== this.playing) {
      this.playing = next;
      this.emit("playing", next);
      window.dispatchEvent(new CustomEvent("cardan-playing", { detail: { playing: next, view: this } }));
    } else if (first && on !== next) this.emit("playing", next);
    this.draw();
  }

  speed(turns) {
    this.rate = turns;
  }

  goTo(angle) {
    this.angle = angle % TURN;
    if (this.angle < 0) this.angle += TURN;
    this.draw();
  }

  step(frames) {
    this.play(false);
    if (this.motion) this.goTo(this.angle + (frames * TURN) / this.motion.frames);
  }

  // A standard view, or "axis of shafts[1]": along the axis about which that part turns.
  look(view, smooth = !this.calm) {
    const path = view.startsWith("axis of ") ? view.slice(8) : null;
    const part = path && this.scene?.bodies.find((body) => body.path === path && this.motion.axis(body.track));
    const direction = part ? this.motion.axis(part.track).toArray() : VIEWS[view];
    if (!direction) return;
    if (!this.scene) this.viewer.view = part ? "axis" : view;
    else this.viewer.go(part ? "axis" : view, direction, this.corners(), smooth);
  }

  // See all of it, from where it is looked at now.
  fit(smooth = !this.calm) {
    if (!this.scene || this.viewer.way) return;
    const { viewer } = this;
    const { position } = viewer.standing(viewer.direction, this.corners());
    const off = position.distanceTo(viewer.camera.position) / viewer.reach;
    if (viewer.own || off > NEAR) viewer.go(viewer.view, viewer.direction, this.corners(), smooth);
  }

  corners() {
    return [...this.bodies.corners(), ...this.arrows.corners()];
  }

  // Cut the drive along its length, toward who looks, or make it whole again; `place`: from the middle, -1 nearest to 1
  // farthest.
  section(place) {
    if (place === null || !this.scene) this.bodies.section(null);
    else {
      const away = new THREE.Vector3(...this.viewer.direction).negate();
      const joints = this.scene.labels.filter(({ role }) => role === "joint").map(({ at }) => new THREE.Vector3(...at));
      const along = joints.length > 1 ? joints.at(-1).sub(joints[0]).normalize() : null;
      if (along && Math.abs(along.dot(away)) < 0.95) away.addScaledVector(along, -along.dot(away)).normalize();
      if (!this.bodies.cut) this.bodies.section(new THREE.Plane(away));
      const { normal } = this.bodies.cut;
      const reach = this.bodies.corners().map((one) => one.dot(normal));
      const [near, far] = [Math.min(...reach), Math.max(...reach)];
      this.bodies.cut.constant = -(near + far + place * (far - near)) / 2;
    }
    this.draw();
  }

  // Measure between points that are touched, or touch parts again.
  measure(on) {
    this.measuring.switch(on);
    this.draw();
  }

  projection(kind) {
    this.viewer.projection(kind);
  }

  theme(name) {
    const theme = THEMES[name] ?? THEMES.light;
    this.stage.background = new THREE.Color(theme.back);
    this.shared.sky.value = theme.sky;
    this.bodies.theme(theme, name === "dark");
    this.ground.theme(theme);
    this.page.root.dataset.theme = name;
    this.draw();
  }

  colourBy(what) {
    this.bodies.colourBy(what);
    this.explain();
    this.draw();
  }

  explain() {
    const scale = this.scene?.scale ?? [];
    if (this.bodies.by !== "utilisation") this.page.explain([]);
    else if (scale.length) this.page.explain(scale); // that of a drive just edited is still to come
  }

  select(path) {
    this.selected = path;
    this.bodies.select(path);
    this.draw();
  }

  // What was touched: a part, found with its point, or nothing, which takes the mark away.
  touched(found) {
    if (this.measuring.on && found) {
      this.measuring.take(found.point);
      this.draw();
      return;
    }
    const path = found?.body.path ?? null;
    if (path === null && this.selected === null) return;
    this.select(path);
    this.emit("touched", path ?? "");
  }

  // What a ray meets first: a body, or an arrow or a plane that is switched on.
  found(ray) {
    const arrow = this.arrows.pick(ray, this.angle); // stands over all else
    const hits = [this.bodies, this.areas].map((part) => part.pick(ray)).filter(Boolean);
    return arrow ?? hits.sort((a, b) => a.distance - b.distance)[0] ?? null;
  }

  tip(found, event) {
    this.page.tip(found, event);
  }

  // Whether nothing is left to be drawn.
  get resting() {
    return !this.pending && !this.restful;
  }

  get fps() {
    return this.quality.fps;
  }

  get state() {
    const { level } = this.quality;
    return { level, calls: this.renderer.info.render.calls, triangles: this.renderer.info.render.triangles };
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.page.root;
    if (!width || !height) return;
    [this.width, this.height] = [width, height];
    const fit = !this.sized;
    this.sized = true;
    this.drawnAt = null;
    this.viewer.resize(width, height);
    for (const { screen } of [this.lines, this.ground.lines, this.bodies.outline]) screen.value.set(width, height);
    if (fit) this.look(this.viewer.view, false);
    else if (!this.viewer.own) this.fit(false);
    if (fit && this.scene) this.thin();
    this.render(performance.now(), this.quality.resting);
  }

  // Without a graphics card drawing takes all there is of the machine: leave it to an edit until its curves are there.
  hold() {
    clearTimeout(this.holding);
    this.holding = setTimeout(() => this.release(), HOLD);
  }

  release() {
    this.holding = clearTimeout(this.holding);
    this.draw();
  }

  // Ask for one more frame; nothing is drawn unless something asks.
  draw() {
    if (!this.pending && !this.gone && !this.hidden && !this.holding) this.pending = requestAnimationFrame((now) => this.frame(now));
  }

  frame(now) {
    this.pending = null;
    if (this.gone || !this.sized || !this.scene || this.holding) return;
    this.restful = clearTimeout(this.restful);
    const running = this.moving;
    const passed = this.last && running ? Math.min(now - this.last, BUSY) : 0;
    this.last = now;
    this.moving = this.playing;
    if (this.playing && this.modes.chosen) this.modes.advance(passed);
    else if (this.playing) this.angle = (this.angle + (passed / 60_000) * this.rate * TURN) % TURN;
    const travelling = this.viewer.advance(now);
    this.moving ||= travelling;
    this.render(now, this.moving || running ? this.quality.moving : this.quality.resting);
    this.quality.drawn(now, running);
    if (this.moving) this.draw();
    else if (running) {
      this.restful = setTimeout(() => {
        this.restful = null;
        this.draw();
      }, REST);
    }
  }

  render(now, { fine, ratio }) {
    if (!this.scene || !this.sized || this.renderer.getContext().isContextLost()) return;
    const size = `${this.width} ${this.height} ${ratio}`;
    if (size !== this.drawnAt) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(this.width, this.height, false);
      this.drawnAt = size;
    }
    for (const part of [this.bodies, this.arrows, this.modes.curves]) part.quality(fine, this.viewer.pixel);
    this.motion.pose(this.tracks.groups, this.angle);
    this.modes.pose(this.tracks.groups);
    this.arrows.pose(this.angle);
    const { camera } = this.viewer;
    this.viewer.frame();
    camera.updateMatrixWorld();
    this.shared.up.value.set(0, 0, 1).transformDirection(camera.matrixWorldInverse);
    this.renderer.render(this.stage, camera);
    this.cube.turn(camera);
    const seen = `${camera.matrixWorld.elements} ${camera.projectionMatrix.elements} ${size}`;
    this.labels.follow(this.arrows.moving ? this.arrows.texts(this.angle) : []);
    if (seen !== this.labelled || this.arrows.moving || this.labels.turning) this.labels.place(camera, this.width, this.height);
    this.labelled = seen;
    this.tell(now);
  }

  // Tell the page where the drive is: at each frame, where that is cheap; the server at most every tenth of a second.
  tell(now) {
    if (this.angle === this.told || (this.slow && this.playing && now - (this.toldAt ?? -FOLLOW) < FOLLOW)) return;
    this.told = this.angle;
    this.toldAt = now;
    window.dispatchEvent(new CustomEvent("cardan-angle", { detail: { angle: this.angle, view: this } }));
    clearTimeout(this.late);
    const send = () => {
      this.sent = performance.now();
      this.emit("angle", this.told);
    };
    if (now - (this.sent ?? -HEARD) >= HEARD) send();
    else this.late = setTimeout(send, HEARD);
  }

  // A picture of what is seen, as a PNG in base 64.
  snapshot() {
    if (!this.sized || !this.scene) return "";
    this.render(performance.now(), { fine: true, ratio: 2 });
    const url = picture(this.page.canvas, this.labels, 2);
    this.draw();
    return url.slice(url.indexOf(",") + 1);
  }

  // Stop, and leave nothing behind.
  dispose() {
    this.gone = true;
    cancelAnimationFrame(this.pending);
    clearTimeout(this.restful);
    clearTimeout(this.late);
    clearTimeout(this.laying);
    clearTimeout(this.holding);
    this.undo.forEach((off) => off());
    this.viewer.dispose();
    for (const part of this.parts) (part.dispose ?? part.clear).call(part);
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.page.empty();
    mounted.splice(mounted.indexOf(this), 1);
    window.cardanView = mounted.at(-1);
  }
}

// Whether a scene lies so differently that the camera has to find it anew.
function moved(before, after) {
  const way = Math.hypot(...[0, 1, 2].map((k) => after.centre[k] - before.centre[k]));
  const share = after.size / before.size;
  return way > 0.5 * before.size || share > 1.6 || share < 0.6;
}
