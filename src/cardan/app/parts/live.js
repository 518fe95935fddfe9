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
    // Show other HTML; what was opened in it by its name stays open.
    show(html) {
      if (html === this.shown) return;
      const names = [...this.$el.querySelectorAll("details[open]")].map((one) => one.dataset.name);
      this.$el.innerHTML = this.shown = html;
      for (const one of names.length ? this.$el.querySelectorAll("details") : []) one.open = names.includes(one.dataset.name);
    },
  },
};
