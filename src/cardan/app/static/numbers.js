// Numbers of the form by arrow keys, wheel, dragging of their name, and a slider on request. The name, or the letter of an
// axis before a number, is dragged; the wheel turns the number that has the focus. While it goes on, what stands in the
// field is sent and no more often than answers come; a series is one step of undo, which ends with the hand.

const PIXELS = 4; // that the hand goes for a step
const WAIT = 1000; // milliseconds after which an answer that did not come is waited for no more
const HALF = 50; // steps from the middle of a slider to its ends

const NUMBERS = ".key input[inputmode=decimal]";

const number = (text) => parseFloat(String(text).replace(/\s/g, "").replace(",", ".").replace("−", "-"));

// Return a step that suits a number: a round one, about a fiftieth of it.
export const stepOf = (value) => (value ? 10 ** Math.round(Math.log10(Math.abs(value) / 50)) : 1);

// Return a number so many steps on, without more digits than it and a tenth of the step have.
export function stepped(value, steps, step) {
  const digits = (one) => (String(one).includes("e-") ? Number(String(one).split("e-")[1]) : (String(one).split(".")[1] ?? "").length);
  return String(Number((value + steps * step).toFixed(Math.min(12, Math.max(digits(value), digits(step / 10))))));
}

// The number that is on the move: its field, where it began, its step, how far it is, when it was sent last.
let moving = null;

function begin(field) {
  if (moving?.field === field) return moving;
  end();
  const value = number(field.value);
  if (!Number.isFinite(value) || field.disabled || field.readOnly) return null;
  moving = { field, value, step: stepOf(value), steps: 0, waits: 0, text: field.value, told: field.value };
  field.dataset.spun = ""; // what the browser would undo in it is not what stands there
  return moving;
}

// Send where it is, unless the last place that was sent is not followed yet: `cardan-followed` tells, or time does.
function send(last) {
  const one = moving;
  if (!one || (one.waits && !last)) return;
  one.field.value = one.text; // a page that follows an older place may have put that there
  const { field, text, told } = one;
  if (text !== told) {
    one.told = text;
    one.waits = window.setTimeout(followed, WAIT);
    document.dispatchEvent(new Event("cardan-moving"));
    field.dispatchEvent(new Event("input", { bubbles: true }));
  }
  window.setTimeout(() => { // what the page says of its field by itself goes first
    if (text !== told) field.dispatchEvent(new CustomEvent("spin", { bubbles: true, detail: text }));
    if (last) field.dispatchEvent(new CustomEvent("spun", { bubbles: true }));
  });
}

function followed() {
  if (!moving) return;
  clearTimeout(moving.waits);
  moving.waits = 0;
  send(false);
}
addEventListener("cardan-followed", followed);

function show(text) {
  moving.field.value = moving.text = text;
  send(false);
}

function by(steps) {
  moving.steps += steps;
  show(stepped(moving.value, moving.steps, moving.step));
}

function end() {
  if (!moving) return;
  send(true);
  clearTimeout(moving.waits);
  moving = null;
}

const at = (event, names) => (event.target instanceof Element ? event.target.closest(names) : null);
const size = (event) => (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);

// In the capture phase: another key ends the move before anybody else hears of it.
addEventListener(
  "keydown",
  (event) => {
    const field = /** @type {HTMLInputElement | null} */ (at(event, NUMBERS));
    const way = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
    if (!field) return;
    if (way && begin(field)) {
      event.preventDefault();
      by(way * size(event));
    } else if (!["Shift", "Alt", "Control", "Meta"].includes(event.key)) end();
  },
  { capture: true },
);
addEventListener("focusout", (event) => at(event, NUMBERS) && end());
addEventListener("input", (event) => {
  const field = /** @type {HTMLInputElement | null} */ (at(event, NUMBERS));
  if (field && event.isTrusted) delete field.dataset.spun;
});

addEventListener(
  "wheel",
  (event) => {
    const field = /** @type {HTMLInputElement | null} */ (at(event, NUMBERS));
    if (!field || field !== document.activeElement || event.ctrlKey || !begin(field)) return;
    event.preventDefault();
    by(-Math.sign(event.deltaY || event.deltaX) * size(event));
  },
  { passive: false },
);

// What is dragged: the name of a key with one number, the letter before one of several.
function handle(event) {
  if (at(event, ".explore")) return null;
  const letter = at(event, ".triple .q-field__prefix");
  const place = letter?.closest(".q-field") ?? at(event, ".key:not(.wide) > .line > .name")?.closest(".key");
  return /** @type {HTMLInputElement | null} */ (place?.querySelector("input[inputmode=decimal]") ?? null);
}

let from = null;
addEventListener("pointerdown", (event) => {
  const field = event.button === 0 ? handle(event) : null;
  if (!field || !begin(field)) return;
  event.preventDefault();
  from = { x: event.clientX, done: 0 };
  document.documentElement.classList.add("scrubbing");
});
addEventListener("pointermove", (event) => {
  if (!from || !moving) return;
  const steps = Math.trunc((event.clientX - from.x) / PIXELS);
  if (steps !== from.done) by((steps - from.done) * size(event));
  from.done = steps;
});
const letGo = () => {
  if (from) end();
  from = null;
  document.documentElement.classList.remove("scrubbing");
};
addEventListener("pointerup", letGo);
addEventListener("pointercancel", letGo);

// A slider on request: the field that has the focus offers it, and it stays until its button is pressed again.
function offer(field) {
  const line = field.closest(".key")?.querySelector(".line");
  const name = line?.querySelector(".name");
  const words = field.closest("[data-explore]")?.getAttribute("data-explore");
  if (!name || !words || line.querySelector(".explore")) return;
  const button = document.createElement("button");
  Object.assign(button, { type: "button", className: "explore", title: words, ariaLabel: `${words}: ${field.ariaLabel}` });
  button.setAttribute("aria-expanded", "false");
  button.append(Object.assign(document.createElement("i"), { className: "material-icons", textContent: "linear_scale", ariaHidden: "true" }));
  button.addEventListener("click", () => slide(line, button, field));
  name.append(button);
}

function slide(line, button, field) {
  const there = line.parentElement.querySelector("input[type=range]");
  button.setAttribute("aria-expanded", String(!there));
  if (there) return there.remove();
  const value = number(field.value) || 0;
  const step = stepOf(value);
  const slider = document.createElement("input");
  const ends = { min: String(value - HALF * step), max: String(value + HALF * step), step: String(step / 10), value: String(value) };
  Object.assign(slider, { type: "range", ariaLabel: field.ariaLabel, ...ends });
  slider.addEventListener("input", () => begin(field) && show(stepped(Number(slider.value), 0, step / 10)));
  for (const done of ["pointerup", "focusout"]) slider.addEventListener(done, end);
  line.after(slider);
  slider.focus();
}

addEventListener("focusin", (event) => {
  const field = at(event, NUMBERS);
  if (field) offer(field);
});
