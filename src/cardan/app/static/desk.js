// Panes of the page: their edges are dragged or moved by arrow keys, and any of them may take all of the room. What was
// chosen stays in this browser.

const LEAST = 12; // per cent of the page that a pane keeps
const STEP = 2;
const KEPT = "cardan-panes";

const kept = () => {
  try {
    return JSON.parse(localStorage.getItem(KEPT)) ?? {};
  } catch {
    return {};
  }
};

function set(edge, share) {
  const now = Math.min(Math.max(share, LEAST), 70);
  edge.closest(".desk").style.setProperty(edge.dataset.share, `${now.toFixed(1)}%`);
  edge.setAttribute("aria-valuenow", Math.round(now));
  localStorage.setItem(KEPT, JSON.stringify({ ...kept(), [edge.dataset.share]: now }));
}

// The share of the page that a pane would have if its edge stood where the pointer is.
function pointed(edge, event) {
  const desk = edge.closest(".desk");
  const { left, top, width, height } = desk.getBoundingClientRect();
  const rim = parseFloat(getComputedStyle(desk).paddingLeft);
  const part = (place, from, size) => (100 * (place - from - rim)) / (size - 2 * rim);
  if (edge.dataset.share === "--view") return part(event.clientY - edge.offsetHeight / 2, top, height);
  const share = part(event.clientX - edge.offsetWidth / 2, left, width);
  return edge.dataset.share === "--file" ? share : 100 - share - (100 * edge.offsetWidth) / (width - 2 * rim);
}

let dragged = null;

// Return what an event is about, or what it stands in.
const within = ({ target }, names) => /** @type {HTMLElement | null} */ (target instanceof Element ? target.closest(names) : null);

addEventListener("pointerdown", (event) => {
  const edge = within(event, ".edge");
  if (!edge || event.button !== 0) return;
  event.preventDefault();
  edge.focus();
  dragged = edge;
  edge.setPointerCapture(event.pointerId);
});
addEventListener("pointermove", (event) => dragged && set(dragged, pointed(dragged, event)));
addEventListener("pointerup", () => (dragged = null));
addEventListener("pointercancel", () => (dragged = null));

addEventListener("keydown", (event) => {
  const edge = within(event, ".edge");
  const way = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[event.key];
  if (!edge || !way) return;
  event.preventDefault();
  const sense = edge.dataset.share === "--verdicts" ? -way : way;
  set(edge, Number(edge.getAttribute("aria-valuenow")) + STEP * sense);
});

addEventListener("click", (event) => {
  const button = within(event, ".enlarge");
  if (!button) return;
  const desk = /** @type {HTMLElement} */ (button.closest(".desk"));
  const name = button.closest(".pane").classList[1];
  const on = desk.dataset.whole !== name;
  if (on) desk.dataset.whole = name;
  else delete desk.dataset.whole;
  button.setAttribute("aria-pressed", String(on));
});

// The editor of the file has the name of what it stands in, and its lines are scrolled by keys.
function named() {
  for (const one of document.querySelectorAll(".cm-editor:not([data-named])")) {
    one.setAttribute("data-named", "");
    one.querySelector(".cm-content").setAttribute("aria-label", one.closest("[aria-label]")?.ariaLabel ?? "");
    one.querySelector(".cm-scroller").setAttribute("tabindex", "0");
  }
}

// A page that is built anew has the shares that were chosen.
new MutationObserver(() => {
  named();
  const desk = document.querySelector(".desk:not([data-laid])");
  if (!desk?.querySelector(".edge")) return;
  desk.setAttribute("data-laid", "");
  const shares = kept();
  const edges = /** @type {NodeListOf<HTMLElement>} */ (desk.querySelectorAll(".edge"));
  for (const edge of edges) if (edge.dataset.share in shares) set(edge, shares[edge.dataset.share]);
}).observe(document, { childList: true, subtree: true });
