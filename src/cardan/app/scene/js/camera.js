// The viewer: two cameras with one place, standard views, and smooth ways between them.

import { OrbitControls, THREE } from "nicegui-scene";

const ANGLE = (28 * Math.PI) / 180; // of the perspective camera, from bottom to top
const MOVE = 380; // ms from one view to the next
const MARGIN = 1.12;

// From where each view looks at the drive; x along the drive, z up.
export const VIEWS = {
  iso: [0.52, -1, 0.62],
  side: [0, -1, 0],
  plan: [0, -0.0004, 1],
  front: [1, 0, 0],
  far: [0, 1, 0],
  below: [0, 0.0004, -1],
  back: [-1, 0, 0],
};
const STRAIGHT = new Set(["side", "plan", "front", "far", "below", "back", "axis"]); // views without perspective, unless one is asked for

export class Viewer {
  constructor(canvas, changed) {
    this.changed = changed;
    this.perspective = new THREE.PerspectiveCamera((ANGLE * 180) / Math.PI, 1, 0.01, 100);
    this.orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.01, 100);
    for (const camera of [this.perspective, this.orthographic]) camera.up.set(0, 0, 1);
    this.camera = this.perspective;
    this.camera.position.set(1, -2, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.controls, { enableDamping: true, dampingFactor: 0.18, zoomToCursor: true, zoomSpeed: 1.2 });
    this.controls.addEventListener("change", changed);
    this.controls.addEventListener("start", () => {
      this.way = null;
      this.own = true;
    });
    this.size = 1;
    this.width = this.height = 1;
    this.asked = null; // the projection the user asked for
    this.view = "iso";
    this.own = false; // whether the user has turned, moved or zoomed the picture since a view was chosen
  }

  resize(width, height) {
    [this.width, this.height] = [width, height];
    this.perspective.aspect = width / height;
    this.frame();
  }

  // Keep the orthographic picture as large as the perspective one is at the point looked at.
  frame() {
    const { reach } = this;
    const half = reach * Math.tan(ANGLE / 2);
    const { orthographic: flat, perspective: deep } = this;
    flat.top = half;
    flat.bottom = -half;
    flat.right = (half * this.width) / this.height;
    flat.left = -flat.right;
    for (const camera of [flat, deep]) {
      camera.near = Math.max(reach - 3 * this.size, 0.01 * this.size);
      camera.far = reach + 6 * this.size;
    }
    flat.near = -6 * this.size;
    flat.updateProjectionMatrix();
    deep.updateProjectionMatrix();
  }

  // The size of a pixel at the point looked at.
  get pixel() {
    const { reach } = this;
    return (2 * reach * Math.tan(ANGLE / 2)) / this.height / this.camera.zoom;
  }

  // "perspective", "orthographic", or null for what suits the view.
  projection(kind) {
    this.asked = kind;
    this.project(kind ?? (STRAIGHT.has(this.view) ? "orthographic" : "perspective"));
    this.changed();
  }

  project(kind) {
    const next = kind === "orthographic" ? this.orthographic : this.perspective;
    if (next === this.camera) return;
    if (this.camera === this.orthographic) this.unzoom();
    next.position.copy(this.camera.position);
    next.quaternion.copy(this.camera.quaternion);
    next.zoom = 1;
    this.camera = next;
    this.controls.object = next;
    this.frame();
  }

  // Zooming without perspective changes no distance; put it into the distance.
  unzoom() {
    const { camera, controls } = this;
    const offset = camera.position.clone().sub(controls.target);
    camera.position.copy(controls.target).addScaledVector(offset, 1 / camera.zoom);
    camera.zoom = 1;
  }

  // Where to stand to see all points from a direction.
  standing(direction, points) {
    const back = new THREE.Vector3(...direction).normalize();
    const right = new THREE.Vector3(0, 0, 1).cross(back);
    if (right.lengthSq() < 1e-9) right.set(1, 0, 0);
    right.normalize();
    const over = new THREE.Vector3().crossVectors(back, right);
    const ranges = [right, over].map((axis) => {
      const along = points.map((p) => p.dot(axis));
      return [Math.min(...along), Math.max(...along)];
    });
    const middle = ranges.map(([least, most]) => (least + most) / 2);
    const depth = points.map((p) => p.dot(back));
    const centre = (Math.min(...depth) + Math.max(...depth)) / 2;
    const tan = Math.tan(ANGLE / 2);
    const aspect = this.width / this.height;
    const flat = (this.asked ?? (this.camera === this.orthographic ? "orthographic" : "")) === "orthographic";
    const reach = Math.max(
      0.05 * this.size,
      ...points.map((p) => {
        const wide = (MARGIN * Math.abs(p.dot(right) - middle[0])) / (tan * aspect);
        const high = (MARGIN * Math.abs(p.dot(over) - middle[1])) / tan;
        return Math.max(wide, high) + (flat ? 0 : p.dot(back) - centre);
      }),
    );
    const target = right.multiplyScalar(middle[0]).addScaledVector(over, middle[1]).addScaledVector(back, centre);
    return { target, position: target.clone().addScaledVector(back, reach) };
  }

  // How far the camera stands from the point looked at.
  get reach() {
    return this.camera.position.distanceTo(this.controls.target);
  }

  // From where the drive is looked at now.
  get direction() {
    return this.camera.position.clone().sub(this.controls.target).normalize().toArray();
  }

  go(view, direction, points, smooth) {
    this.view = view;
    this.own = false;
    this.project(this.asked ?? (STRAIGHT.has(view) ? "orthographic" : "perspective"));
    if (this.camera === this.orthographic) this.unzoom();
    const end = this.standing(direction, points);
    const { target } = this.controls;
    const start = { target: target.clone(), offset: this.camera.position.clone().sub(target) };
    this.way = { start, end: { target: end.target, offset: end.position.sub(end.target) }, begun: null, smooth };
    if (!smooth) this.advance(0);
    this.changed();
  }

  // Turn by angles [rad] about the point looked at, as the arrow keys do.
  orbit(across, up) {
    this.own = true;
    const { target } = this.controls;
    const round = new THREE.Spherical();
    const toPole = new THREE.Quaternion().setFromUnitVectors(this.camera.up, new THREE.Vector3(0, 1, 0));
    const offset = this.camera.position.clone().sub(target).applyQuaternion(toPole);
    round.setFromVector3(offset);
    round.theta += across;
    round.phi += up;
    round.makeSafe();
    offset.setFromSpherical(round).applyQuaternion(toPole.invert());
    this.place(target, offset);
    this.changed();
  }

  zoom(factor) {
    this.own = true;
    if (this.camera === this.orthographic) {
      this.camera.zoom *= factor;
      this.camera.updateProjectionMatrix();
    } else {
      const offset = this.camera.position.clone().sub(this.controls.target);
      this.place(this.controls.target, offset.divideScalar(factor));
    }
    this.changed();
  }

  place(target, offset) {
    this.controls.target.copy(target);
    this.camera.position.copy(target).add(offset);
    this.camera.lookAt(target);
  }

  // Move on; return whether there is more to come.
  advance(now) {
    let more = false;
    if (this.way) {
      const { start, end, smooth } = this.way;
      this.way.begun ??= now;
      const share = smooth ? Math.min((now - this.way.begun) / MOVE, 1) : 1;
      const eased = share * share * (3 - 2 * share);
      const [from, to] = [new THREE.Spherical(), new THREE.Spherical()];
      const pole = new THREE.Quaternion().setFromUnitVectors(this.camera.up, new THREE.Vector3(0, 1, 0));
      from.setFromVector3(start.offset.clone().applyQuaternion(pole));
      to.setFromVector3(end.offset.clone().applyQuaternion(pole));
      let turn = to.theta - from.theta;
      turn -= 2 * Math.PI * Math.round(turn / (2 * Math.PI));
      const mix = (a, b) => a + eased * (b - a);
      const round = new THREE.Spherical(mix(from.radius, to.radius), mix(from.phi, to.phi), from.theta + eased * turn);
      const offset = new THREE.Vector3().setFromSpherical(round.makeSafe()).applyQuaternion(pole.invert());
      this.place(start.target.clone().lerp(end.target, eased), offset);
      if (share === 1) this.way = null;
      else more = true;
      this.frame();
    }
    return this.controls.update() || more;
  }

  dispose() {
    this.controls.dispose();
  }
}
