// What experiment functions draw, as the page reads it, and the keys that it gives them; without a browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { FunctionKeys, nameOfKey } from "../../visualiser/web/page/src/function_keys.js";
import { isDrawing, readDrawing } from "../../visualiser/web/page/src/view/drawing_reader.js";

// As drawing_frame.h has it. Each line: six numbers, colour, width; triangle: nine, colour; dot: three, colour, diameter.
function bytesOf({ lines = [], triangles = [], dots = [], texts = [], tick = 7n }) {
  const words = new TextEncoder().encode(JSON.stringify(texts));
  const numbers = [...lines.flatMap((line) => line), ...triangles.flatMap((one) => one), ...dots.flatMap((dot) => dot)];
  const buffer = new ArrayBuffer(32 + 4 * numbers.length + words.length);
  const view = new DataView(buffer);
  [0x344d5753, lines.length, triangles.length, dots.length].forEach((value, i) => view.setUint32(4 * i, value, true));
  view.setBigUint64(16, tick, true);
  view.setUint32(24, words.length, true);
  let at = 32;
  const put = (places, list) => {
    for (const one of list)
      one.forEach((value, k) => {
        if (k === places) view.setUint32(at, value, true);
        else view.setFloat32(at, value, true);
        at += 4;
      });
  };
  put(6, lines);
  put(9, triangles);
  put(3, dots);
  new Uint8Array(buffer).set(words, at);
  return buffer;
}

test("what looks alike is one group, in its order", () => {
  const red = 0xff0000ff;
  const buffer = bytesOf({
    lines: [[0, 0, 0, 1, 0, 0, red, 2], [0, 0, 0, 0, 1, 0, 0x00ff0080, 2], [1, 0, 0, 1, 1, 0, red, 2], [1, 0, 0, 1, 1, 0, red, 3]],
    triangles: [[0, 0, 0, 1, 0, 0, 0, 1, 0, 0x0000ff80]],
    dots: [[1, 2, 3, red, 8]],
    texts: [[1, 2, 3, 0x102030ff, "fb → 1"]],
  });
  assert.ok(isDrawing(buffer));
  const drawing = readDrawing(buffer);
  assert.equal(drawing.tick, 7);
  assert.deepEqual(drawing.lines.map(({ colour, width, points }) => [colour, width, points.length]), [[0xff0000, 2, 12], [0x00ff00, 2, 6], [0xff0000, 3, 6]]);
  assert.ok(Math.abs(drawing.lines[1].opacity - 128 / 255) < 1e-9);
  assert.deepEqual(drawing.lines[0].points, [0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0]);
  assert.deepEqual(drawing.triangles[0].points, [0, 0, 0, 1, 0, 0, 0, 1, 0]);
  assert.deepEqual([drawing.dots[0].points, drawing.dots[0].width], [[1, 2, 3], 8]);
  assert.deepEqual(drawing.texts, [{ place: [1, 2, 3], text: "fb → 1", colour: 0x102030, opacity: 1 }]);
});

test("a drawing that is cut off, and a state, are none", () => {
  const buffer = bytesOf({ lines: [[0, 0, 0, 1, 0, 0, 1, 1]] });
  assert.throws(() => readDrawing(buffer.slice(0, buffer.byteLength - 8)), /no drawing/);
  const state = new ArrayBuffer(40);
  new DataView(state).setUint32(0, 0x314d5753, true);
  assert.ok(!isDrawing(state));
  assert.ok(!isDrawing(new ArrayBuffer(3)));
});

test("keys have the names that functions know", () => {
  const names = { a: "A", A: "A", 1: "1", "+": "+", " ": "Space", ArrowUp: "Up", Enter: "Return", Escape: "Escape", F1: "F1", F12: "F12", Shift: "Shift" };
  for (const [key, name] of Object.entries(names)) assert.equal(nameOfKey(key), name, key);
  for (const key of ["é", "F13", "AudioVolumeUp", "Dead", ""]) assert.equal(nameOfKey(key), null, key);
});

function keyboard(selected = null) {
  const sent = [];
  const keys = new FunctionKeys({ command: ({ do: verb, key, entity }) => sent.push([verb, key ?? entity ?? null]), selected: () => selected, changed() {} });
  const event = (key, more = {}) => ({ key, code: `Key${key}`, target: { tagName: "BODY" }, preventDefault() {}, ...more });
  return { sent, keys, event };
}

test("keys go to the functions only while that is on, once for each press", () => {
  const { sent, keys, event } = keyboard();
  assert.equal(keys.down(event("i")), false);
  keys.toggle();
  assert.equal(keys.down(event("i")), true);
  keys.down(event("i")); // the browser repeats it
  keys.up(event("i"));
  assert.equal(keys.down(event("F8")), false, "which ends it");
  assert.equal(keys.down(event("c", { ctrlKey: true })), false, "a command of the browser");
  assert.equal(keys.down(event("i", { target: { tagName: "INPUT" } })), false, "text");
  assert.deepEqual(sent, [["press", "I"], ["release", "I"]]);
});

test("keys that are held are let go when it ends or the page is left", () => {
  const { sent, keys, event } = keyboard("fb_0");
  keys.toggle();
  keys.down(event("i"));
  keys.release();
  keys.up(event("i"));
  keys.down(event("k"));
  keys.toggle();
  assert.deepEqual(sent, [["select", "fb_0"], ["press", "I"], ["release", "I"], ["press", "K"], ["release", "K"], ["deselect", null]]);
  keys.select("fb_1");
  assert.equal(sent.length, 6);
});
