// HTML that is changed by a message of its own.
export default {
  template: `<component :is="tag"></component>`,
  props: { html: String, tag: { type: String, default: "div" } },
  mounted() {
    this.show(this.html);
  },
  watch: {
    html(now) {
      this.show(now);
    },
  },
  methods: {
    show(html) {
      if (html !== this.shown) this.$el.innerHTML = this.shown = html;
    },
  },
};
