// A chart that is updated in place, follows light and dark, and shares the angle of the drive with the view in space.
// Curves over the input angle have a cursor: the window's "cardan-angle" moves it, pressing on the chart sends
// "cardan-go-to". The cursor is a line of the page, moved by a transform alone: nothing is drawn anew while it moves.
// Curves that an edit moves are drawn at once between the axes there are; plotly follows when the user is quiet.
import { fitted } from "cardan-charts";
import { toRaw } from "vue";

const CONFIG = {
  displaylogo: false,
  responsive: false,
  locale: "own",
  modeBarButtonsToRemove: ["lasso2d", "select2d", "toImage", "autoScale2d"],
};
const TURN = 360;
const STEP = 5;
const QUIET = 250; // ms without an edit after which plotly draws everything anew
const SOON = 30; // ms by which a chart that plotly has to draw anew follows what is shown at once

// Return where in a turn an angle [rad] is, in degrees.
const turned = (angle) => ((((angle * TURN) / (2 * Math.PI)) % TURN) + TURN) % TURN;

const faded = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16)).join(",");

// Return a copy of plotly's data or layout in the colours of a dark page.
function darkened(thing, colours, rgb) {
  if (typeof thing === "string") {
    if (thing in colours) return colours[thing];
    const found = /^rgba\((\d+,\d+,\d+),/.exec(thing);
    return found && found[1] in rgb ? thing.replace(found[1], rgb[found[1]]) : thing;
  }
  if (Array.isArray(thing)) return typeof thing[0] === "number" ? thing : thing.map((one) => darkened(one, colours, rgb));
  if (thing === null || typeof thing !== "object") return thing;
  return Object.fromEntries(Object.entries(thing).map(([key, one]) => [key, darkened(one, colours, rgb)]));
}

const sheet = document.createElement("canvas").getContext("2d");

// Return what tells how wide a text is.
function ruler({ family, size }) {
  return (text) => {
    sheet.font = `bold ${size}px ${family}`;
    return sheet.measureText(text).width;
  };
}

// Return the numbers that bytes in base 64 are.
function numbers(bytes) {
  return new Float64Array(Uint8Array.from(atob(bytes), (one) => one.charCodeAt(0)).buffer);
}

// Return a curve as the path of an SVG; a value that is missing leaves a gap.
function curve(across, heights, x, y) {
  let path = "";
  let pen = "M";
  for (let k = 0; k < heights.length; k++) {
    if (Number.isNaN(heights[k])) pen = "M";
    else {
      path += `${pen}${x.l2p(across[k]).toFixed(2)},${y.l2p(heights[k]).toFixed(2)}`;
      pen = "L";
    }
  }
  return path;
}

export default {
  template: `<div class="cardan-chart" tabindex="0" role="group" @keydown="key">
    <div ref="plot" class="plot"></div><div ref="cursors" class="cursors" aria-hidden="true"></div></div>`,
  props: { spec: Array, label: String, dark: Object, words: Object }, // spec: the one description, in a list
  watch: {
    spec() {
      this.take();
      this.draw();
    },
  },
  async mounted() {
    this.lines = [];
    this.take();
    this.angle = window.cardanView?.angle ?? 0;
    this.time = window.cardanTime ?? null;
    this.shown = true;
    this.rgb = Object.fromEntries(Object.entries(this.dark).map(([from, to]) => [faded(from), faded(to)]));
    this.ends = [];
    const { Plotly } = await import("nicegui-plotly");
    if (this.gone) return;
    this.Plotly = Plotly;
    await this.draw();
    if (this.gone) return;
    this.listen();
  },
  unmounted() {
    this.gone = true;
    clearTimeout(this.waiting);
    clearTimeout(this.due);
    for (const end of this.ends) end();
    if (this.Plotly && this.$refs.plot) this.Plotly.purge(this.$refs.plot);
  },
  methods: {
    listen() {
      const on = (target, name, handler, how) => {
        target.addEventListener(name, handler, how);
        this.ends.push(() => target.removeEventListener(name, handler, how));
      };
      const watch = (observer, ...what) => {
        observer.observe(...what);
        this.ends.push(() => observer.disconnect());
      };
      on(window, "cardan-angle", (event) => {
        this.angle = event.detail.angle;
        if (this.shown) this.place();
      });
      on(window, "cardan-time", (event) => {
        this.time = event.detail.time;
        if (this.shown) this.place();
      });
      on(this.$refs.plot, "pointerdown", this.press, true);
      on(this.$refs.plot, "mousedown", (event) => this.pressed && event.stopPropagation(), true); // plotly would tell no values
      on(this.$refs.plot, "wheel", this.wheel, { capture: true, passive: false });
      on(this.$refs.plot, "dblclick", this.whole, true);
      on(this.$el, "focusout", () => this.Plotly.Fx.unhover(this.$refs.plot));
      on(window, "pointermove", (event) => this.pressed && this.go(event), true);
      on(window, "pointerup", () => (this.pressed = null), true);
      on(window, "pointercancel", () => (this.pressed = null), true);
      watch(new IntersectionObserver(([one]) => (this.shown = one.isIntersecting) && this.place()), this.$el);
      watch(new MutationObserver(() => this.isDark() !== this.drawnDark && this.draw()), document.body, {
        attributes: true,
        attributeFilter: ["class"],
      });
      let width = this.$el.clientWidth;
      watch(
        new ResizeObserver(() => {
          if (!this.$el.clientWidth || this.$el.clientWidth === width) return;
          width = this.$el.clientWidth;
          requestAnimationFrame(() => !this.gone && this.draw());
        }),
        this.$el,
      );
    },
    isDark() {
      return document.body.classList.contains("body--dark");
    },
    // Keep what is to be drawn out of Vue's sight, which would watch every number of it.
    take() {
      const { data, layout } = toRaw(this.spec)[0];
      this.held = { data: [...data], layout };
      this.dress(this.label);
    },
    dress(label) {
      const { meta, height } = this.held.layout;
      this.$refs.plot.style.minHeight = meta.equal.length ? "" : `${height}px`;
      this.$el.setAttribute("aria-label", label);
    },
    // Lines and numbers of a drawing say less to the ear than its label does.
    hush() {
      for (const one of this.$refs.plot.querySelectorAll("svg.main-svg")) one.setAttribute("aria-hidden", "true");
    },
    // Show another state of the figure: the bytes of the `heights` of curves by their places, else all `data`; `layout` if it is another.
    change(text) {
      const { label, heights, data, layout } = JSON.parse(text);
      if (data) this.held.data = data;
      const curves = Object.entries(heights ?? {}).map(([place, bytes]) => ({ place: +place, y: numbers(bytes) }));
      for (const { place, y } of curves) this.held.data[place] = { ...this.held.data[place], y };
      if (layout) this.held.layout = layout;
      this.dress(label);
      clearTimeout(this.waiting);
      if (!data && this.sketch(curves)) this.waiting = setTimeout(() => this.draw(), QUIET);
      else this.due ??= setTimeout(() => this.draw(), this.shown ? SOON : QUIET);
    },
    // Draw curves anew between the axes as they stand; false where that cannot be.
    sketch(curves) {
      const whole = this.$refs.plot?._fullLayout;
      if (!whole || this.drawing) return false;
      const drawn = new Map();
      for (const one of this.$refs.plot.querySelectorAll("g.trace.scatter")) {
        const trace = one.__data__?.[0]?.trace;
        if (trace) drawn.set(trace.index, { trace, path: one.querySelector("path.js-line") });
      }
      return curves.every(({ place, y: heights }) => {
        const { trace, path } = drawn.get(place) ?? {};
        if (!trace) return this.held.data[place].visible === "legendonly";
        const [x, y] = [whole[trace.xaxis.replace("x", "xaxis")], whole[trace.yaxis.replace("y", "yaxis")]];
        if (!path || !x || !y || x.type !== "linear" || y.type !== "linear") return false;
        path.setAttribute("d", curve(trace.x, heights, x, y));
        return true;
      });
    },
    async draw() {
      clearTimeout(this.waiting);
      this.due = clearTimeout(this.due);
      if (!this.Plotly || this.gone) return;
      this.drawnDark = this.isDark();
      let { data, layout } = this.held;
      if (this.drawnDark) {
        data = darkened(data, this.dark, this.rgb);
        layout = darkened(layout, this.dark, this.rgb);
      }
      const turns = this.courses();
      const plot = this.$refs.plot;
      const dragmode = turns.length ? false : "zoom";
      const looks = { paper_bgcolor: "rgba(0,0,0,0)", uirevision: "kept", autosize: false, dragmode };
      const config = { ...CONFIG, locales: { own: { dictionary: this.words, format: {} } } };
      const fit = () => fitted({ data, layout }, this.$el.clientWidth || 600, ruler(layout.font), this.legend);
      const drawn = (one) => this.Plotly.react(plot, data, { ...one, ...looks }, config);
      this.drawing = true;
      try {
        const one = fit();
        await drawn(one);
        this.legend = plot.querySelector("g.legend")?.getBoundingClientRect().height;
        const other = fit();
        if (other.height !== one.height && !this.gone) await drawn(other);
      } finally {
        this.drawing = false;
      }
      if (this.gone) return;
      this.hush();
      if (!this.afterplot && plot.on) {
        this.afterplot = true;
        plot.on("plotly_afterplot", this.measure);
      }
      plot.style.touchAction = turns.length ? "pan-y" : "";
      this.measure();
    },
    // Note where the panels stand, so that the cursor needs no look at the page while it moves.
    measure() {
      const whole = this.$refs.plot?._fullLayout;
      if (!whole || this.gone) return;
      const courses = this.courses();
      const cursors = this.$refs.cursors;
      while (cursors.children.length > courses.length) cursors.lastChild.remove();
      while (cursors.children.length < courses.length) cursors.append(document.createElement("div"));
      this.lines = courses.map(({ tail, scale, timed }, k) => {
        const [x, y] = [whole[`xaxis${tail}`], whole[`yaxis${tail}`]];
        const line = cursors.children[k];
        line.style.top = `${y._offset}px`;
        line.style.height = `${y._length}px`;
        const box = { left: x._offset, width: x._length, top: y._offset, height: y._length };
        return { tail, line, scale, timed, low: x.range[0], high: x.range[1], ...box };
      });
      this.place();
    },
    // The panels along which the drive turns or moves: the tail of their axis, and how many of its units a degree or a
    // second is.
    courses() {
      const { turning, timed } = this.held.layout.meta;
      const told = (which, timed) => which.map(([tail, scale]) => ({ tail, scale, timed }));
      return [...told(turning, false), ...told(timed, true)];
    },
    place() {
      const degrees = turned(this.angle);
      for (const { line, scale, timed, low, high, left, width } of this.lines) {
        const at = timed ? this.time === null ? NaN : this.time * scale : degrees * scale;
        const here = at >= low && at <= high;
        line.style.visibility = here ? "visible" : "hidden";
        if (here) line.style.transform = `translateX(${left + ((at - low) / (high - low)) * width}px)`;
      }
    },
    // Zoom about the pointer: where the chart has the focus, or with ctrl, as a pinch on a touch pad sends it; else the
    // page scrolls.
    wheel(event) {
      const whole = this.$refs.plot._fullLayout;
      if (!whole || !(event.ctrlKey || this.$el.contains(document.activeElement))) return;
      const frame = this.$refs.plot.getBoundingClientRect();
      const [px, py] = [event.clientX - frame.left, event.clientY - frame.top];
      const change = {};
      for (const plot of Object.values(whole._plots)) {
        for (const [axis, at] of [[plot.xaxis, px], [plot.yaxis, py]]) {
          const share = (at - axis._offset) / axis._length;
          if (plot.xaxis._offset > px || px > plot.xaxis._offset + plot.xaxis._length) continue;
          if (axis === plot.yaxis && (share < 0 || share > 1)) continue;
          const middle = axis.p2l(at - axis._offset);
          const factor = Math.exp(0.0015 * Math.max(-120, Math.min(120, event.deltaY)));
          change[`${axis._name}.range`] = axis.range.map((one) => middle + factor * (axis.r2l(one) - middle));
        }
      }
      if (!Object.keys(change).length) return;
      event.preventDefault();
      event.stopPropagation();
      this.Plotly.relayout(this.$refs.plot, change);
    },
    // See all of the curves again.
    whole(event) {
      const change = {};
      for (const [name, axis] of Object.entries(this.held.layout)) if (/^[xy]axis/.test(name)) change[`${name}.range`] = [...axis.range];
      event.stopPropagation();
      this.Plotly.relayout(this.$refs.plot, change);
    },
    press(event) {
      if (event.button !== 0 || this.$refs.plot._fullLayout?.dragmode !== false) return;
      const frame = this.$refs.plot.getBoundingClientRect();
      const [x, y] = [event.clientX - frame.left, event.clientY - frame.top];
      const inside = ({ left, width, top, height }) => x >= left && x <= left + width && y >= top && y <= top + height;
      const found = this.lines.find(inside);
      if (!found) return;
      this.pressed = { ...found, origin: frame.left };
      this.go(event);
    },
    go(event) {
      const { left, width, low, high, scale, timed, origin } = this.pressed;
      const share = Math.min(Math.max((event.clientX - origin - left) / width, 0), 1);
      const at = (low + share * (high - low)) / scale;
      if (timed) window.dispatchEvent(new CustomEvent("cardan-go-to-time", { detail: { time: at } }));
      else this.turn((at * 2 * Math.PI) / TURN);
    },
    turn(angle) {
      window.dispatchEvent(new CustomEvent("cardan-go-to", { detail: { angle } }));
    },
    key(event) {
      const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      const panel = this.lines.find(({ timed }) => !timed);
      if (!way || !panel || event.target !== this.$el) return;
      event.preventDefault();
      const angle = this.angle + (way * STEP * 2 * Math.PI) / TURN;
      this.turn(angle);
      this.tell(panel, turned(angle) * panel.scale);
    },
    // Tell the values of the curves of a panel where its cursor was put, as they are told where the pointer is.
    tell({ tail, low, high }, at) {
      if (at >= low && at <= high) this.Plotly.Fx.hover(this.$refs.plot, { xval: at }, `x${tail}y${tail}`);
    },
  },
};
