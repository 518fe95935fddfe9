// The Vue side of the 3-D view: it opens the view, forwards calls from Python and says when it is there.

import { open } from "cardan-scene";

// Calls from Python that only pass on; they do nothing where there is no WebGL.
const FORWARDED = ["groups", "mode", "play", "speed", "goTo", "look", "projection", "theme", "colourBy", "select", "fit", "section", "measure"];

export default {
  template: `<div class="cardan-scene"></div>`,
  props: { texts: Object },
  mounted() {
    this.view = open(this.$el, this.texts, (name, value) => this.$emit(name, value));
    this.$emit("ready", Boolean(this.view));
  },
  beforeUnmount() {
    this.view?.dispose();
    this.view = null;
  },
  methods: /** @type {Methods} */ ({
    show(text) {
      if (this.view && !this.view.show(JSON.parse(text))) this.$emit("lacking");
    },
    // The picture in pieces that fit into one message each.
    snapshot() {
      this.taken = this.view?.snapshot() ?? "";
      return this.taken.length;
    },
    snapshotPart(start, length) {
      return this.taken.slice(start, start + length);
    },
    ...Object.fromEntries(FORWARDED.map((name) => [name, function (...values) {
      return this.view?.[name](...values);
    }])),
  }),
};
