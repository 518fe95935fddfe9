// A distance between two points that were touched: a line over the drive, and what the server says of it.

import { THREE } from "nicegui-scene";

export class Measure {
  constructor(root, emit) {
    this.emit = emit;
    this.on = false;
    this.points = [];
    this.line = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ color: "#d55e00", depthTest: false, transparent: true }),
    );
    this.dots = new THREE.Points(
      this.line.geometry,
      new THREE.PointsMaterial({ color: "#d55e00", size: 9, sizeAttenuation: false, depthTest: false, transparent: true }),
    );
    for (const one of [this.line, this.dots]) {
      one.renderOrder = 11;
      one.frustumCulled = false;
      root.add(one);
    }
    this.clear();
  }

  // Begin to measure, or end it.
  switch(on) {
    this.on = on;
    this.clear();
  }

  // Take a point [m]; a third one begins anew.
  take(point) {
    if (this.points.length === 2) this.clear();
    this.points.push(point.clone());
    this.line.geometry.setFromPoints(this.points);
    this.line.visible = this.points.length === 2;
    this.dots.visible = true;
    if (this.line.visible) this.emit("measured", this.points.flatMap((one) => one.toArray()));
  }

  clear() {
    this.points = [];
    this.line.visible = this.dots.visible = false;
  }

  dispose() {
    this.line.geometry.dispose();
    for (const { material } of [this.line, this.dots]) material.dispose();
  }
}
