// Figures in the room that there is, with a ruler that counts letters: no browser needed.
import assert from "node:assert/strict";
import { test } from "node:test";
import { broken, fitted } from "../../src/cardan/app/parts/charts/index.js";

const ruler = (text) => 7 * text.length;
const axis = (domain, more = {}) => ({ domain, range: [0, 10], type: "linear", tickvals: [0, 5, 10], ticktext: ["0", "5", "10"], ...more });
const base = { height: 300, margin: { l: 0, r: 34, t: 0, b: 0 }, meta: { width: 900, equal: [], turning: [], timed: [] }, annotations: [] };
const head = (x, y, text) => ({ text, x, y, xref: "paper", yref: "paper", xanchor: "left", yanchor: "bottom" });

test("words break where the room ends, and a word alone stays whole", () => {
  assert.deepEqual(broken("angle of the input", 70, ruler), { text: "angle of<br>the input", count: 2 });
  assert.deepEqual(broken("unbreakable", 10, ruler), { text: "unbreakable", count: 1 });
  assert.equal(broken("<b>a b</b>", 30, ruler).count, 1); // marks have no width
});

test("a panel becomes narrower, what stands beside it does not", () => {
  const layout = { ...base, xaxis: axis([0.1, 0.9]), yaxis: axis([0.2, 0.8]) };
  for (const room of [334, 634, 1234]) {
    const made = fitted({ data: [], layout }, room, ruler);
    const paper = room - 34;
    assert.ok(Math.abs(made.xaxis.domain[0] * paper - 90) < 1e-9); // px before, and as many behind
    assert.ok(Math.abs((1 - made.xaxis.domain[1]) * paper - 90) < 1e-9);
    assert.equal(made.height, 300);
    assert.equal(made.width, room);
  }
});

test("panels of a row go below each other where they would be too narrow, headings with them", () => {
  const data = [{ xaxis: "x" }, { xaxis: "x2" }];
  const layout = {
    ...base,
    xaxis: axis([0.05, 0.45]),
    yaxis: axis([0.2, 0.8]),
    xaxis2: axis([0.55, 0.95]),
    yaxis2: axis([0.2, 0.8]),
    annotations: [head(0.05, 0.8, "one"), head(0.55, 0.8, "two")],
  };
  const wide = fitted({ data, layout }, 934, ruler);
  assert.deepEqual(wide.yaxis.domain, wide.yaxis2.domain);
  const narrow = fitted({ data, layout }, 334, ruler);
  assert.ok(narrow.yaxis2.domain[1] < narrow.yaxis.domain[0]);
  narrow.xaxis.domain.forEach((end, k) => assert.ok(Math.abs(end - narrow.xaxis2.domain[k]) < 1e-9));
  assert.deepEqual(narrow.annotations.map(({ y }) => y), [narrow.yaxis.domain[1], narrow.yaxis2.domain[1]]);
  assert.ok(narrow.height > 1.5 * wide.height);
});

test("what only fills a row needs no room where its panels go below each other", () => {
  const row = (count) =>
    Object.fromEntries([...Array(count).keys()].flatMap((k) => {
      const tail = k ? String(k + 1) : "";
      return [[`xaxis${tail}`, axis([0.02 + k / 3, 0.3 + k / 3])], [`yaxis${tail}`, axis([0.1, 0.9])]];
    }));
  const data = [{ xaxis: "x" }, { xaxis: "x2" }];
  const height = (count) => fitted({ data, layout: { ...base, ...row(count) } }, 334, ruler).height;
  assert.ok(Math.abs(height(3) - height(2)) < 1e-9);
});

test("circles stay round", () => {
  const layout = { ...base, meta: { ...base.meta, equal: [""] }, xaxis: axis([0.3, 0.7]), yaxis: axis([0.1, 0.9]) };
  const ratio = ({ width, height, xaxis, yaxis }) =>
    ((xaxis.domain[1] - xaxis.domain[0]) * (width - 34)) / ((yaxis.domain[1] - yaxis.domain[0]) * height);
  for (const room of [334, 700, 1500]) assert.ok(Math.abs(ratio(fitted({ data: [], layout }, room, ruler)) - 1.5) < 1e-9);
});

test("a legend of more lines has the room that it needs", () => {
  const layout = { ...base, xaxis: axis([0.1, 0.9]), yaxis: axis([0.2, 0.8]), annotations: [head(0.1, 0.8, "ratio")] };
  const top = (made) => (1 - made.yaxis.domain[1]) * made.height;
  const [one, three] = [20, 90].map((legend) => fitted({ data: [], layout }, 634, ruler, legend));
  assert.equal(Math.round(top(one)), 60);
  assert.ok(top(three) >= 90 + 15);
  assert.equal(Math.round(three.height - one.height), Math.round(top(three) - top(one)));
});

test("numbers that would run into each other are left out, names are not", () => {
  const ticks = { tickvals: [0, 1, 2, 3, 4, 5], ticktext: ["10 000", "20 000", "30 000", "40 000", "50 000", "60 000"] };
  const layout = { ...base, xaxis: axis([0.1, 0.9], ticks), yaxis: axis([0.2, 0.8]) };
  assert.equal(fitted({ data: [], layout }, 934, ruler).xaxis.ticktext.length, 6);
  assert.equal(fitted({ data: [], layout }, 390, ruler).xaxis.ticktext.length, 2);
  const names = { ...layout, xaxis: axis([0.1, 0.9], { ...ticks, ticktext: ["tube", "cross", "yoke", "spline", "weld", "bolt"] }) };
  assert.equal(fitted({ data: [], layout: names }, 390, ruler).xaxis.ticktext.length, 6);
});

test("names before lying bars break into lines, and the bars make room for them and for the words behind", () => {
  const names = ["torque that keeps the gaps of the joints closed", "length of shaft 2"];
  const layout = { ...base, xaxis: axis([0.45, 0.95]), yaxis: axis([0.2, 0.5], { tickvals: [0, 1], ticktext: names }) };
  const data = [{ type: "bar", orientation: "h", xaxis: "x", x: [10, 2], text: ["31 980 rpm", "1"] }];
  const made = fitted({ data, layout }, 334, ruler);
  const lines = made.yaxis.ticktext[0].split("<br>");
  const left = made.xaxis.domain[0] * 300;
  assert.ok(left <= 0.45 * 300 + 1e-9);
  for (const line of lines) assert.ok(ruler(line) <= left);
  assert.ok((made.yaxis.domain[1] - made.yaxis.domain[0]) * made.height >= 2 * lines.length * 15);
  const wide = (made.xaxis.domain[1] - made.xaxis.domain[0]) * 300;
  const end = (10 / made.xaxis.range[1]) * wide;
  assert.ok(end + ruler("31 980 rpm") <= wide + 34);
});

test("words of rules side by side stand in lines of their own", () => {
  const rule = (x, text) => ({ text, x, y: 1, xref: "x", yref: "y domain", xanchor: "left", yanchor: "top" });
  const layout = { ...base, xaxis: axis([0.1, 0.9]), yaxis: axis([0.2, 0.8]), annotations: [rule(1, "in use"), rule(1.2, "1.6 × the highest"), rule(8, "far")] };
  const shifts = fitted({ data: [], layout }, 934, ruler).annotations.map(({ yshift }) => yshift);
  assert.deepEqual(shifts.map(Math.abs), [0, 15, 0]);
});
