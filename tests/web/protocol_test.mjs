// What the page reads from the binary states, written here by the letter of docs/web_render.md.
import assert from "node:assert/strict";
import test from "node:test";
import { FrameDecoder, isPast } from "../../visualiser/web/page/src/protocol.js";

const KEY = 0x314d5753;
const CHANGE = 0x324d5753;
const PAST = 0x334d5753;

// parts: [type, value] in order, as DataView names the types.
function bytesOf(parts) {
  const sizes = { Uint8: 1, Int16: 2, Uint32: 4, Float32: 4, BigUint64: 8, Float64: 8 };
  const view = new DataView(new ArrayBuffer(parts.reduce((sum, [type]) => sum + sizes[type], 0)));
  let place = 0;
  for (const [type, value] of parts) {
    view[`set${type}`](place, value, true);
    place += sizes[type];
  }
  return view.buffer;
}
const header = (magic, count, { tick = 5, beams = 0, grips = 0, rings = 0, key = 1 } = {}) => [
  ["Uint32", magic], ["Uint32", count], ["BigUint64", BigInt(tick)], ["Float64", tick / 10],
  ["Uint32", beams], ["Uint32", grips], ["Uint32", rings], ["Uint32", key],
];
const all = (type, values) => values.map((value) => [type, value]);
const key = (more) => [
  ...header(KEY, 2, more),
  ...all("Float32", [1, 2, 0, 3, 4, 1.5]),
  ...all("Int16", [0, 0, 0, 32767, 0, 0, 0, 32767]),
  ...all("Uint8", [1, 2, 3, 0, 4, 5, 6, 64]),
];
const change = ({ poses = [], colours = [], steps = [0, 0, 0, 0, 0, 0], grips = [], ...more } = {}) => [
  ...header(CHANGE, 2, { grips: grips.length, ...more }),
  ["Uint32", poses.length], ["Uint32", colours.length],
  ...poses.flatMap(({ slot, at, turn }) => [["Uint32", slot], ...all("Float32", at), ...all("Int16", turn)]),
  ...colours.flatMap(({ slot, colour }) => [["Uint32", slot], ...all("Uint8", colour)]),
  ...grips.flatMap((grip) => all("Uint32", grip)),
  ...all("Int16", steps),
];

test("a key is the whole state", () => {
  const frame = new FrameDecoder().decode(bytesOf(key({ tick: 7 })));
  assert.equal(frame.tick, 7);
  assert.equal(frame.count, 2);
  assert.deepEqual([...frame.positions], [1, 2, 0, 3, 4, 1.5]);
  assert.deepEqual([...frame.colours], [1, 2, 3, 0, 4, 5, 6, 64]);
});

test("a state of the past is whole, and no change refers to it", () => {
  const decoder = new FrameDecoder();
  decoder.decode(bytesOf(key({ tick: 7 })));
  const old = bytesOf([["Uint32", PAST], ...key({ tick: 2, key: 9 }).slice(1)]);
  assert.ok(isPast(old));
  assert.ok(!isPast(bytesOf(key())));
  assert.equal(decoder.decode(old).tick, 2);
  assert.equal(decoder.decode(bytesOf(change({ tick: 8, key: 9 }))), null);
  assert.equal(decoder.decode(bytesOf(change({ tick: 8 }))).tick, 8);
});

test("a change refers to its key, however many there were before it", () => {
  const decoder = new FrameDecoder();
  decoder.decode(bytesOf(key()));
  decoder.decode(bytesOf(change({ steps: [9, 9, 9, 9, 9, 9] })));
  const frame = decoder.decode(bytesOf(change({
    tick: 9,
    steps: [-500, 32767, 16384, 0, 0, 0],
    poses: [{ slot: 1, at: [5, 6, 0.25], turn: [32767, 0, 0, 0] }],
    colours: [{ slot: 0, colour: [7, 8, 9, 1] }],
    grips: [[11, 12]],
  })));
  assert.equal(frame.tick, 9);
  const expected = [0.95, 5.2767, 0, 5, 6, 0.25];
  frame.positions.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) < 1e-6, `${i}: ${value}`));
  const [, , z, w] = frame.quaternions;
  assert.ok(Math.abs(2 * Math.atan2(z, w) - Math.PI / 2) < 1e-3);
  assert.deepEqual([...frame.quaternions.subarray(4)], [32767, 0, 0, 0]);
  assert.deepEqual([...frame.colours], [7, 8, 9, 1, 4, 5, 6, 64]);
  assert.deepEqual(frame.grips, [{ robot: 11, held: 12 }]);
});

test("a change without its key says nothing", () => {
  const decoder = new FrameDecoder();
  assert.equal(decoder.decode(bytesOf(change())), null);
  decoder.decode(bytesOf(key({ key: 3 })));
  assert.equal(decoder.decode(bytesOf(change({ key: 2 }))), null);
  assert.notEqual(decoder.decode(bytesOf(change({ key: 3 }))), null);
});

test("what is no state is refused", () => {
  const decoder = new FrameDecoder();
  decoder.decode(bytesOf(key()));
  for (const bad of [new ArrayBuffer(0), new ArrayBuffer(40), bytesOf(key()).slice(0, -1), bytesOf(change()).slice(0, -2),
    bytesOf(change({ poses: [{ slot: 2, at: [0, 0, 0], turn: [0, 0, 0, 0] }] })), bytesOf(change({ colours: [{ slot: 9, colour: [0, 0, 0, 0] }] }))])
    assert.throws(() => decoder.decode(bad));
});
