// What the view puts into the page: the canvas, the tip at the pointer, a sentence where nothing can be drawn.

const STYLE = `
.cardan-scene { position: relative; overflow: hidden; min-height: 120px; contain: strict; background: #f3f5f8; color: #1d2630; }
.cardan-scene[data-theme="dark"] { background: #13171c; color: #e6ebf0; }
.cardan-scene canvas { position: absolute; inset: 0; width: 100%; height: 100%; display: block; outline: none; touch-action: none; cursor: grab; }
.cardan-scene canvas:active { cursor: grabbing; }
.cardan-scene canvas.over { cursor: pointer; }
.cardan-scene canvas:focus-visible { box-shadow: inset 0 0 0 2px #0a6cff; }
.cardan-labels { position: absolute; inset: 0; pointer-events: none; }
.cardan-labels span { position: absolute; left: 0; top: 0; padding: 1px 5px; border-radius: 4px; white-space: nowrap; visibility: hidden;
  font: 500 12px/16px system-ui, "Segoe UI", Roboto, sans-serif; font-variant-numeric: tabular-nums;
  background: rgb(255 255 255 / 82%); color: #1d2630; }
.cardan-scene[data-theme="dark"] .cardan-labels span { background: rgb(24 30 37 / 82%); color: #e6ebf0; }
.cardan-tip { position: absolute; z-index: 2; padding: 4px 8px; border-radius: 6px; pointer-events: none;
  font: 12px/17px system-ui, "Segoe UI", Roboto, sans-serif; white-space: pre-line; background: #1d2630; color: #fff; box-shadow: 0 2px 8px rgb(0 0 0 / 25%); }
.cardan-tip { left: 8px; top: 8px; max-width: min(60%, 26rem); }
.cardan-tip.low { top: auto; bottom: 8px; left: auto; right: 8px; }
.cardan-legend { position: absolute; left: 8px; bottom: 8px; margin: 0; padding: 4px 8px; list-style: none; border-radius: 6px; pointer-events: none;
  font: 12px/17px system-ui, "Segoe UI", Roboto, sans-serif; background: rgb(255 255 255 / 88%); color: #1d2630; }
.cardan-scene[data-theme="dark"] .cardan-legend { background: rgb(24 30 37 / 88%); color: #e6ebf0; }
.cardan-legend i { display: inline-block; width: 12px; height: 12px; margin-right: 6px; border-radius: 3px; vertical-align: -1px; border: 1px solid rgb(128 128 128 / 60%); }
.cardan-cube { position: absolute; right: 14px; top: 12px; width: 44px; height: 44px; perspective: 260px; }
.cardan-cube > div { position: absolute; left: 50%; top: 50%; width: 0; height: 0; transform-style: preserve-3d; }
.cardan-cube span { position: absolute; left: -21px; top: -21px; width: 42px; height: 42px; display: grid; place-items: center; backface-visibility: hidden;
  box-sizing: border-box; border: 1px solid #8b95a1; background: rgb(255 255 255 / 92%); color: #1d2630; cursor: pointer; font: 600 12px/1 system-ui, "Segoe UI", Roboto, sans-serif; user-select: none; }
.cardan-cube span:hover { background: #cfe0f5; }
.cardan-scene[data-theme="dark"] .cardan-cube span { background: rgb(40 48 58 / 94%); color: #e6ebf0; }
.cardan-scene[data-theme="dark"] .cardan-cube span:hover { background: #35506f; }
.cardan-scene[data-theme="dark"] .cardan-tip { background: #e6ebf0; color: #13171c; }
.cardan-said { position: absolute; inset: 0; display: grid; place-items: center; padding: 2em; text-align: center;
  font: 14px/20px system-ui, "Segoe UI", Roboto, sans-serif; background: inherit; }
.cardan-tip[hidden], .cardan-said[hidden], .cardan-legend[hidden] { display: none; }
`;

// Fill an element; return its parts and what can be done with them.
export function furnished(root, texts) {
  if (!document.getElementById("cardan-scene-style")) {
    const style = document.createElement("style");
    style.id = "cardan-scene-style";
    style.textContent = STYLE;
    document.head.append(style);
  }
  const canvas = document.createElement("canvas");
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-label", texts.label);
  const tip = box("cardan-tip");
  const said = box("cardan-said");
  const legend = document.createElement("ul");
  legend.className = "cardan-legend";
  legend.hidden = true;
  root.append(canvas, said, tip, legend);
  return {
    root,
    canvas,
    texts,
    empty: () => root.replaceChildren(),

    // A sentence in place of the picture, or the picture again.
    say(text) {
      said.hidden = !text;
      said.textContent = text ?? "";
      said.setAttribute("role", "status");
      canvas.style.visibility = text ? "hidden" : "visible";
    },

    // What the legend covers of the picture [CSS pixels].
    get covered() {
      const { offsetLeft: left, offsetTop: top, offsetWidth: width, offsetHeight: height } = legend;
      return legend.hidden ? [] : [{ left, top, right: left + width, bottom: top + height }];
    },

    // What colours mean, [{colour, text}]; nothing where there are none.
    explain(colours) {
      legend.hidden = !colours.length;
      legend.replaceChildren(
        ...colours.map(({ colour, text }) => {
          const [row, chip] = [document.createElement("li"), document.createElement("i")];
          chip.style.background = colour;
          row.append(chip, text);
          return row;
        }),
      );
    },

    // The text of what lies under the pointer, in a corner where the pointer is not: it covers nothing that is looked at.
    tip(found, event) {
      canvas.classList.toggle("over", Boolean(found?.body));
      const text = found?.body?.text ?? found?.text;
      tip.hidden = !text;
      if (!text) return;
      tip.textContent = text;
      const { left, top, width, height } = root.getBoundingClientRect();
      tip.classList.toggle("low", event.clientX < left + 0.6 * width && event.clientY < top + 0.5 * height);
    },
  };
}

function box(name) {
  const element = document.createElement("div");
  element.className = name;
  element.hidden = true;
  return element;
}

// The canvas with its labels as a data address; must follow the drawing at once, in the same task.
export function picture(canvas, labels, ratio) {
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const context = copy.getContext("2d");
  context.drawImage(canvas, 0, 0);
  labels.paint(context, ratio);
  return copy.toDataURL("image/png");
}
