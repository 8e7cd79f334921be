// Blocks of states in a page that has its run: what recording.js reads is what was packed. The packer here is written from
// visualiser/web/recording_writer.h, and recorded_page_test.mjs compares files of the command with the journal.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Bytes, decodeBlock } from "../../visualiser/web/page/src/recording.js";

const UNIT = 1e-5;

class Packer {
  bytes = [];
  count(value) {
    for (; value >= 128; value = Math.floor(value / 128)) this.bytes.push((value % 128) | 128);
    this.bytes.push(value);
  }
  number(value) {
    this.count(value >= 0 ? 2 * value : -2 * value - 1);
  }
  value(value) {
    if (Number.isInteger(value)) return this.count(2 * (value >= 0 ? 2 * value : -2 * value - 1));
    this.count(1);
    this.raw(new Uint8Array(new Float32Array([value]).buffer));
  }
  raw(bytes) {
    this.bytes.push(...bytes);
  }
  column(values, changes) {
    this.number(values[0]);
    for (let i = 1; changes && i < values.length; i++) this.number(values[i] - values[i - 1] - (i > 1 ? values[i - 1] - values[i - 2] : 0));
  }
  // `changes`: [[place, …values], …] in ascending order; put(value) writes one.
  changes(list, put) {
    this.count(list.length);
    list.forEach(([place, value], i) => {
      this.count(place - (i > 0 ? list[i - 1][0] : -1));
      put(value);
    });
  }
  get buffer() {
    return Uint8Array.from(this.bytes).buffer;
  }
}

test("numbers of any length are read back", () => {
  const values = [0, 1, -1, 2, 63, -64, 64, 127, 128, -129, 16383, 16384, 2 ** 31, -(2 ** 31), 2 ** 40];
  const packer = new Packer();
  for (const value of values) packer.number(value);
  for (const value of [0, 3, -7, 0xffffff, 0.5, -1.25]) packer.value(value);
  const bytes = new Bytes(packer.buffer);
  assert.deepEqual(values.map(() => bytes.signed()), values);
  assert.deepEqual([0, 3, -7, 0xffffff, 0.5, -1.25].map(() => bytes.value()), [0, 3, -7, 0xffffff, 0.5, -1.25]);
  assert.throws(() => bytes.byte(), /cut off/);
});

test("an empty arena has states", () => {
  const packer = new Packer();
  for (const value of [2, 7, 5]) packer.count(value);
  packer.raw([]); // no poses, no colours
  packer.count(0); // no changed colours
  packer.raw([1, 0, 0, 0, 0]); // lists: none, and as before
  packer.count(0);
  packer.count(0);
  const block = decodeBlock(packer.buffer, { count: 0, attributes: 0, unit: UNIT });
  assert.deepEqual(block.ticks, [7, 12]);
  assert.deepEqual(block.lists, [{ beams: [], grips: [], rings: [] }, { beams: [], grips: [], rings: [] }]);
  assert.deepEqual(block.attributes, [[], []]);
});

test("a robot that drives and turns beyond a full turn, one that stands, and one that tilts", () => {
  const packer = new Packer();
  for (const value of [3, 100, 1, 4]) packer.count(value);
  packer.raw([1 | 2 | 8]); // x, y and the heading change
  packer.column([100000, 100100, 100200], true);
  packer.column([-5, 0, 10], true);
  packer.column([0], false);
  packer.column([32000, 33000, 98534], true); // the last one is 32,767 more than a full turn
  packer.raw([0]);
  for (const value of [7, 8, 9]) packer.column([value], false);
  packer.column([16384], false);
  packer.raw([4 | 8 | 16]);
  for (const value of [1, 2]) packer.column([value], false);
  packer.column([3, 4, 3], true);
  for (const column of [[32767, 0, 0], [0, 32767, 0], [0, 0, 32767], [0, 0, 0]]) packer.column(column, true);
  packer.raw([1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 64]);
  packer.changes([[1, [9, 9, 9, 1]]], (colour) => packer.raw(colour));
  packer.changes([[0, [1, 1, 1, 1]], [2, [2, 2, 2, 2]]], (colour) => packer.raw(colour));
  packer.raw([1, 0, 1, 0, 2, 0, 0, 0, 5, 0, 0, 0]); // a grip: robot 2 holds entity 5
  packer.raw([0]);
  packer.raw([1, 0, 0, 0]);
  packer.changes([[0, 0xff0000], [3, 0.25]], (value) => packer.value(value));
  packer.changes([], () => {});
  packer.changes([[3, -1]], (value) => packer.value(value));
  const { ticks, positions, quaternions, colours, lists, attributes } = decodeBlock(packer.buffer, { count: 3, attributes: 4, unit: UNIT });
  assert.deepEqual(ticks, [100, 101, 105]);
  const position = (state, slot) => [...positions.subarray(9 * state + 3 * slot, 9 * state + 3 * slot + 3)].map((value) => Math.round(value / UNIT));
  assert.deepEqual([position(0, 0), position(1, 0), position(2, 0)], [[100000, -5, 0], [100100, 0, 0], [100200, 10, 0]]);
  assert.deepEqual([position(0, 1), position(2, 1)], [[7, 8, 9], [7, 8, 9]]);
  assert.deepEqual([position(0, 2), position(1, 2), position(2, 2)], [[1, 2, 3], [1, 2, 4], [1, 2, 3]]);
  const heading = (state, slot) => {
    const [, , z, w] = quaternions.subarray(12 * state + 4 * slot, 12 * state + 4 * slot + 4);
    return (2 * Math.atan2(z, w) * 32767) / Math.PI;
  };
  const turned = (a, b) => Math.abs(((a - b + 3 * 65534 + 32767) % 65534) - 32767);
  [32000, 33000, 98534].forEach((value, state) => assert.ok(turned(heading(state, 0), value) < 1, `${heading(state, 0)} ${value}`));
  assert.ok(turned(heading(2, 1), 16384) < 1);
  assert.deepEqual([0, 1, 2].map((state) => [...quaternions.subarray(12 * state + 8, 12 * state + 12)]), [[32767, 0, 0, 0], [0, 32767, 0, 0], [0, 0, 32767, 0]]);
  assert.deepEqual([...colours.subarray(12, 24)], [1, 2, 3, 0, 9, 9, 9, 1, 7, 8, 9, 64]);
  assert.deepEqual([...colours.subarray(24)], [1, 1, 1, 1, 9, 9, 9, 1, 2, 2, 2, 2]);
  assert.deepEqual(lists.map(({ grips }) => grips), [[{ robot: 2, held: 5 }], [{ robot: 2, held: 5 }], []]);
  assert.deepEqual(attributes, [[[0, 0xff0000], [3, 0.25]], [], [[3, -1]]]);
});

test("a block that is cut off, or names an attribute that does not exist, is refused", () => {
  const packer = new Packer();
  for (const value of [1, 0]) packer.count(value);
  packer.raw([0, 0, 0, 0, 0, 1, 2, 3, 0, 0]);
  const whole = [...packer.bytes, 1, 3, 4];
  assert.throws(() => decodeBlock(Uint8Array.from(whole).buffer, { count: 1, attributes: 2, unit: UNIT }), /attribute 2 of 2/);
  for (let length = 0; length < packer.bytes.length; length++)
    assert.throws(() => decodeBlock(Uint8Array.from(whole.slice(0, length)).buffer, { count: 1, attributes: 3, unit: UNIT }), /cut off/, `${length} bytes`);
});
