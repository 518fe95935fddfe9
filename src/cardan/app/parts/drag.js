// Plan and side view of a drive: its points can be dragged, or moved with the arrow keys.
// Coordinates are millimetres of the drive; the server is told where a point is to be and sends the drive back.

const WAIT = 1000; // milliseconds after which it is waited no more to be followed
const GRIP = 2.8; // times as large as a point is what a finger may touch of it

export default {
  template: `
    <div class="drag-views">
      <figure v-for="view in views" :key="view.name">
        <figcaption>{{ view.title }}</figcaption>
        <svg :ref="view.name" :viewBox="box(view)" preserveAspectRatio="xMidYMid meet" role="group" :aria-label="view.title">
          <polyline :points="line(view)" fill="none" class="axis" vector-effect="non-scaling-stroke" />
          <g v-for="point in points" :key="point.path">
            <circle :cx="point.at[0]" :cy="-point.at[view.up]" :r="grip(view)" :tabindex="point.fixed ? -1 : 0" :role="point.fixed ? 'img' : 'slider'" :class="{ fixed: point.fixed }"
              :aria-label="point.name" :aria-valuetext="point.fixed ? null : told(point)" :data-path="point.path"
              @pointerdown.prevent="grab($event, point, view)" @pointermove="drag($event, view)"
              @pointerup="drop" @pointercancel="drop" @keydown="key($event, point, view)"
              ><title>{{ point.name }} {{ told(point) }}</title></circle>
            <ellipse :cx="point.at[0]" :cy="-point.at[view.up]" :rx="dot(view)" :ry="dot(view)"
              :class="{ end: point.end, selected: point.path === selected }" vector-effect="non-scaling-stroke" />
            <text :x="point.at[0]" :y="-point.at[view.up] - 1.6 * dot(view)" :font-size="2.6 * dot(view)"
              text-anchor="middle">{{ point.short }}</text>
          </g>
        </svg>
      </figure>
    </div>`,
  props: { points: Array, selected: String, titles: Array },
  data() {
    return { held: null, frozen: null, waits: 0 };
  },
  mounted() {
    addEventListener("cardan-followed", this.followed);
  },
  unmounted() {
    removeEventListener("cardan-followed", this.followed);
  },
  computed: {
    views() {
      return [
        { name: "side", title: this.titles[0], up: 2 },
        { name: "plan", title: this.titles[1], up: 1 },
      ];
    },
  },
  methods: {
    extent(view) {
      if (!this.points.length) return [0, 0, 1, 1];
      const across = this.points.map((point) => point.at[0]);
      const upright = this.points.map((point) => -point.at[view.up]);
      const [left, right] = [Math.min(...across), Math.max(...across)];
      const [low, high] = [Math.min(...upright), Math.max(...upright)];
      const wide = Math.max(right - left, 1e-6);
      const tall = Math.max(high - low, 0.3 * wide);
      const middle = (low + high) / 2;
      return [left - 0.08 * wide, middle - 0.62 * tall, 1.16 * wide, 1.24 * tall];
    },
    box(view) {
      return (this.frozen?.[view.name] ?? this.extent(view)).join(" ");
    },
    line(view) {
      return this.points.map((point) => `${point.at[0]},${-point.at[view.up]}`).join(" ");
    },
    grip(view) {
      return GRIP * this.dot(view);
    },
    dot(view) {
      return 0.022 * (this.frozen?.[view.name] ?? this.extent(view))[2];
    },
    told(point) {
      return point.at.map((value) => `${+value.toFixed(1)}`).join(" / ") + " mm";
    },
    place(event, view) {
      const svg = [].concat(this.$refs[view.name])[0];
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
      return [at.x, -at.y];
    },
    grab(event, point, view) {
      if (point.fixed) return this.$emit("touched", { path: point.path });
      event.target.setPointerCapture(event.pointerId);
      event.target.focus();
      const [x, y] = this.place(event, view);
      this.frozen = Object.fromEntries(this.views.map((one) => [one.name, this.extent(one)]));
      this.held = { point, from: [x, y], start: [...point.at] };
      this.$emit("touched", { path: point.path });
    },
    drag(event, view) {
      if (!this.held) return;
      const [x, y] = this.place(event, view);
      const step = event.shiftKey ? 0.1 : 1;
      const at = [...this.held.start];
      at[0] = Math.round((at[0] + x - this.held.from[0]) / step) * step;
      at[view.up] = Math.round((at[view.up] + y - this.held.from[1]) / step) * step;
      this.held.point.at = this.held.at = this.held.last = at;
      this.held.moved = true;
      this.send();
    },
    // The newest place alone is sent, once the one before is followed: `cardan-followed` tells, or time does.
    send() {
      if (this.waits || !this.held?.at) return;
      document.dispatchEvent(new Event("cardan-moving"));
      this.$emit("moving", { path: this.held.point.path, at: this.held.at });
      this.held.at = null;
      this.waits = window.setTimeout(this.followed, WAIT);
    },
    followed() {
      clearTimeout(this.waits);
      this.waits = 0;
      this.send();
    },
    drop() {
      if (this.held?.moved) this.$emit("moved", { path: this.held.point.path, at: this.held.last });
      this.held = null;
      this.frozen = null;
    },
    key(event, point, view) {
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!way || point.fixed) return;
      event.preventDefault();
      const step = event.shiftKey ? 10 : event.altKey ? 0.1 : 1;
      const at = [...point.at];
      at[0] += step * way[0];
      at[view.up] += step * way[1];
      point.at = at;
      this.$emit("moved", { path: point.path, at });
    },
  },
};
