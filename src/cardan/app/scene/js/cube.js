// A cube in the corner that lies as the drive lies: touching a side looks from there. Its sides are buttons of the page's
// bar and keys as well, so it is left out of what a screen is read by.

const HALF = 21; // CSS pixels

// Side -> how it is laid on the cube, in the axes of the page (x right, y down, z to the reader), seen in plan.
const SIDES = {
  plan: "",
  below: "rotateY(180deg)",
  side: "rotateX(-90deg)",
  far: "rotateX(90deg) rotateZ(180deg)",
  front: "rotateX(-90deg) rotateY(90deg)",
  back: "rotateX(-90deg) rotateY(-90deg)",
};

export class Cube {
  constructor(parent, texts, chosen) {
    this.frame = document.createElement("div");
    this.frame.className = "cardan-cube";
    this.frame.setAttribute("aria-hidden", "true");
    this.solid = document.createElement("div");
    for (const [name, lay] of Object.entries(SIDES)) {
      const side = document.createElement("span");
      side.dataset.look = name;
      side.textContent = texts[name];
      side.style.transform = `${lay} translateZ(${HALF}px)`;
      this.solid.append(side);
    }
    this.frame.append(this.solid);
    this.frame.addEventListener("click", ({ target }) => {
      const { look } = /** @type {HTMLElement} */ (target).dataset;
      if (look) chosen(look);
    });
    parent.append(this.frame);
  }

  // Lie as a camera sees the world: its turn, with y down as on the page.
  turn({ matrixWorldInverse: { elements: e } }) {
    const m = [e[0], -e[1], e[2], 0, -e[4], e[5], -e[6], 0, e[8], -e[9], e[10], 0, 0, 0, 0, 1];
    this.solid.style.transform = `matrix3d(${m.map((one) => one.toFixed(4))})`;
  }

  // What it covers of the picture [CSS pixels].
  get spot() {
    const { offsetLeft: left, offsetTop: top, offsetWidth: width, offsetHeight: height } = this.frame;
    return { left, top, right: left + width, bottom: top + height };
  }
}
