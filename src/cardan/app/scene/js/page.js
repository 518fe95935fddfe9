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
  font: 500 11px/15px system-ui, "Segoe UI", Roboto, sans-serif; font-variant-numeric: tabular-nums;
  background: rgb(255 255 255 / 82%); color: #1d2630; }
.cardan-scene[data-theme="dark"] .cardan-labels span { background: rgb(24 30 37 / 82%); color: #e6ebf0; }
.cardan-tip { position: absolute; z-index: 2; left: 0; top: 0; max-width: 60%; padding: 4px 8px; border-radius: 6px; pointer-events: none;
  font: 12px/17px system-ui, "Segoe UI", Roboto, sans-serif; white-space: pre-line; background: #1d2630; color: #fff; box-shadow: 0 2px 8px rgb(0 0 0 / 25%); }
.cardan-scene[data-theme="dark"] .cardan-tip { background: #e6ebf0; color: #13171c; }
.cardan-said { position: absolute; inset: 0; display: grid; place-items: center; padding: 2em; text-align: center;
  font: 14px/20px system-ui, "Segoe UI", Roboto, sans-serif; background: inherit; }
.cardan-tip[hidden], .cardan-said[hidden] { display: none; }
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
  root.append(canvas, said, tip);
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

    // The text of what lies under the pointer.
    tip(found, event) {
      canvas.classList.toggle("over", Boolean(found?.body));
      const text = found?.body?.text ?? found?.text;
      tip.hidden = !text;
      if (!text) return;
      tip.textContent = text;
      const { left, top, width } = root.getBoundingClientRect();
      const x = Math.min(event.clientX - left + 14, Math.max(width - tip.offsetWidth - 4, 0));
      const y = Math.max(event.clientY - top - tip.offsetHeight - 10, 4);
      tip.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px)`;
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
