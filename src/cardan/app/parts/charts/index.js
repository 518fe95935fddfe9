// A figure made to fit the room that there is: panels grow and shrink, while numbers, titles and what stands between
// panels keep their size. Panels of a row that would become too narrow go below each other, long words break into
// lines, and a legend that needs more lines has them.

const LEAST = 150; // px that a panel is wide, if it shares its row
const APART = { bare: 34, marked: 70 }; // px between panels that went below each other
const LINE = 15; // px of a line of words
const WIDE = 640; // px of a drawing that has the row for itself, however small the room is
const NUMBER = /^[\d\s.,·⁻⁰¹²³⁴-⁹−-]+$/;
const WORDS = 0.45; // of the room that words to the left of a panel may take

// Return a text with breaks where its lines would be wider than there is room, and the count of lines.
export function broken(text, room, ruler) {
  const lines = [];
  for (const word of text.split(" ")) {
    const longer = lines.length ? `${lines.at(-1)} ${word}` : word;
    if (lines.length && ruler(longer.replace(/<[^>]*>/g, "")) <= room) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return { text: lines.join("<br>"), count: lines.length };
}

// Return the panels of a layout by rows from the top, in pixels of the figure as Python laid it out.
function rows(layout) {
  const { height, meta } = layout;
  const panels = [];
  for (const [key, one] of Object.entries(layout)) {
    const tail = /^(?:xaxis|scene)(\d*)$/.exec(key)?.[1];
    if (tail === undefined) continue;
    const [x, y] = key.startsWith("scene") ? [one.domain.x, one.domain.y] : [one.domain, layout[`yaxis${tail}`].domain];
    const heads = layout.annotations.filter(({ xref, x: at, y: up }) => xref === "paper" && at === x[0] && up === y[1]);
    const box = { left: x[0] * meta.width, right: x[1] * meta.width, top: (1 - y[1]) * height, bottom: (1 - y[0]) * height };
    panels.push({ key, tail, heads, equal: meta.equal.includes(tail), bare: one.visible === false || key.startsWith("scene"), title: one.title, ...box });
  }
  panels.sort((one, other) => one.top - other.top || one.left - other.left);
  const found = [];
  for (const panel of panels) {
    if (found.length && Math.abs(found.at(-1)[0].top - panel.top) < 1) found.at(-1).push(panel);
    else found.push([panel]);
  }
  return found;
}

// Return the room to the left of a panel of a row, of whose panels so many stand side by side.
function before(row, k, count, room) {
  return Math.min(row[k].left - (k ? row[k - 1].right : 0), (WORDS * room) / count);
}

// Return how many panels of a row stand side by side, and how much wider or narrower they become.
function shared(row, width, room) {
  const equal = row.some((panel) => panel.equal);
  const rim = width - row.at(-1).right;
  for (let count = row.length; ; count--) {
    const some = row.slice(0, count);
    const gaps = some.reduce((sum, _one, k) => sum + before(row, k, count, room), rim);
    const wide = some.reduce((sum, { left, right }) => sum + right - left, 0);
    const factor = Math.max((room - gaps) / wide, 0.1);
    if (count > 1 && (factor * wide) / count < LEAST) continue;
    return { count, factor: equal ? Math.min(factor, 1) : factor, upright: equal ? Math.min(factor, 1) : 1 };
  }
}

// Put the words beside upright rules of a panel into lines such that none runs into another.
function apart(made, tail, wide, ruler) {
  const { range } = made[`xaxis${tail}`];
  const words = [];
  made.annotations.forEach((one, place) => {
    if (one.yref !== `y${tail} domain` || one.yanchor !== "top" || one.y !== 1) return;
    const [at, size] = [((one.x - range[0]) / (range[1] - range[0])) * wide, ruler(one.text) + 6];
    const before = at + size > wide + LINE && at > size;
    words.push({ place, size, before, start: before ? at - size : at });
  });
  const ends = [];
  for (const { place, size, before, start } of words.sort((one, other) => one.start - other.start)) {
    const free = ends.findIndex((end) => end < start);
    const line = free < 0 ? ends.length : free;
    ends[line] = start + size;
    made.annotations[place] = { ...made.annotations[place], xanchor: before ? "right" : "left", yshift: -LINE * line };
  }
}

// Leave out numbers along the bottom that would run into each other.
function thinned(axis, wide, ruler) {
  const texts = axis.ticktext ?? [];
  if (texts.length < 2 || !texts.every((text) => NUMBER.test(text) || !text)) return axis;
  const at = axis.tickvals.map((value) => (axis.type === "log" ? Math.log10(value) : value));
  const apart = (wide * (at.at(-1) - at[0])) / (at.length - 1) / Math.abs(axis.range[1] - axis.range[0]);
  const step = Math.ceil((Math.max(0, ...texts.map(ruler)) + 6) / apart);
  const some = (all) => all.filter((_one, k) => k % step === 0);
  return step > 1 ? { ...axis, tickvals: some(axis.tickvals), ticktext: some(texts), tickangle: 0 } : axis;
}

// Return the range of an axis with room for the words behind lying bars.
function roomy(axis, tail, data, wide, rim, ruler) {
  let [low, high] = axis.range;
  for (const { type, orientation, xaxis, x, text, base = 0 } of data) {
    if (type !== "bar" || orientation !== "h" || xaxis !== `x${tail}` || !text || axis.type !== "linear") continue;
    x.forEach((size, k) => {
      const free = Math.max(wide + rim - ruler(text[k] ?? "") - 8, 0.3 * wide);
      high = Math.max(high, low + ((base + size - low) * wide) / free);
    });
  }
  return [low, high];
}

// Return the layout of a figure for a room of so many pixels, with `width` and `height`.
// ruler: tells how wide a text is; legend: how high the legend became.
export function fitted({ data, layout }, room, ruler, legend = 0) {
  const { height, margin, meta } = layout;
  const all = rows(layout);
  if (all.some((row) => row.length === 1 && row[0].equal)) room = Math.max(room, WIDE);
  const paper = room - margin.l - margin.r;
  const places = []; // [panel, its place]
  let [end, y] = [0, 0]; // how far down all is laid out, before and now
  for (const row of all) {
    const { count, factor, upright } = shared(row, meta.width, paper);
    let above = row[0].top - end;
    // What only fills the row needs no room of its own where panels go below each other.
    const filled = ({ key, tail }) => data.some(({ xaxis, scene }) => xaxis === `x${tail}` || scene === key);
    const kept = count < row.length ? row.filter(filled) : row;
    if (!end) above += Math.max(0, legend + 4 - above + (row.some(({ heads }) => heads.length) ? LINE + 4 : 0));
    for (let first = 0; first < kept.length; first += count) {
      let x = 0;
      const some = kept.slice(first, first + count).map((panel, k) => {
        const left = (x += before(row, k, count, paper));
        x += factor * (panel.right - panel.left);
        return { panel, left, right: x, heads: [], title: null, names: null };
      });
      let [heads, feet, taller] = [1, 1, upright];
      some.forEach((one, k) => {
        const { panel, left, right } = one;
        const names = layout[`yaxis${panel.tail}`]?.ticktext ?? [];
        if (left - (k ? some[k - 1].right : 0) < row[k].left - (k ? row[k - 1].right : 0) - 1 && names.length) {
          one.names = names.map((name) => broken(name, left - (k ? some[k - 1].right : 0) - 8, ruler));
          const lines = Math.max(...one.names.map((name) => name.count));
          taller = Math.max(taller, (lines * LINE * (names.length + 0.6)) / (panel.bottom - panel.top));
        }
        one.heads = panel.heads.map((head) => broken(head.text, (some[k + 1]?.left ?? paper) - left, ruler));
        heads = Math.max(heads, ...one.heads.map((head) => head.count));
        if (!panel.title?.text) return;
        const middle = (left + right) / 2;
        one.title = broken(panel.title.text, 2 * Math.min(middle, paper - middle), ruler);
        feet = Math.max(feet, one.title.count);
      });
      y += above + (heads - 1) * LINE;
      const tallest = Math.max(...some.map(({ panel }) => panel.bottom - panel.top));
      for (const one of some) places.push({ ...one, top: y, bottom: y + taller * (one.panel.bottom - one.panel.top) });
      y += taller * tallest + (feet - 1) * LINE;
      above = APART[row[0].bare ? "bare" : "marked"];
    }
    end = Math.max(...row.map(({ bottom }) => bottom));
  }
  const whole = y + height - end;
  const made = { ...layout, width: room, height: whole, annotations: [...layout.annotations] };
  for (const { panel, left, right, top, bottom, heads, title, names } of places) {
    const x = [left / paper, right / paper];
    const up = [1 - bottom / whole, 1 - top / whole];
    const held = layout[panel.key];
    if (panel.key.startsWith("scene")) made[panel.key] = { ...held, domain: { x, y: up } };
    else {
      const named = title ? { title: { ...held.title, text: title.text } } : {};
      const range = roomy(held, panel.tail, data, right - left, margin.r, ruler);
      made[panel.key] = thinned({ ...held, domain: x, range, ...named }, right - left, ruler);
      const ticks = names ? { ticktext: names.map(({ text }) => text) } : {};
      made[`yaxis${panel.tail}`] = { ...layout[`yaxis${panel.tail}`], domain: up, ...ticks };
      apart(made, panel.tail, right - left, ruler);
    }
    panel.heads.forEach((head, k) => {
      const text = heads[k].text;
      made.annotations[layout.annotations.indexOf(head)] = { ...head, text, x: x[0], y: up[1], align: "left" };
    });
  }
  return made;
}
