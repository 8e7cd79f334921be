// What the page reads from the binary states, written here by the letter of docs/web_render.md, and how it receives them.
import assert from "node:assert/strict";
import test from "node:test";
import { Connection } from "../../visualiser/web/page/src/connection.js";
import { FrameDecoder, isPast } from "../../visualiser/web/page/src/protocol.js";
import { Reception } from "../../visualiser/web/page/src/reception.js";

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

// A page with the world that both robots are in. `calls` has what its parts were told.
function pageOf() {
  const calls = [];
  const told = (part, ...names) => Object.fromEntries(names.map((name) => [name, (...values) => void calls.push(`${part}.${name}`, ...values)]));
  const frames = [];
  const state = { frames: 0, world: { robots: [0, 1], isRobot: () => true }, live: null, frame: null, status: null, selected: null };
  const page = new Reception({
    state,
    past: { isOn: false, ...told("past", "show") },
    picture: { chosen: [], marks: told("marks", "forget"), addFrame: (frame) => frames.push(frame.tick), setDrawing: () => calls.push("picture.setDrawing") },
    inspector: { addFrame() {} },
    actions: { countSwarm() {} },
    toolbar: { setFrame() {} },
    processes: { update() {} },
    log: { add: ({ text }) => calls.push(text) },
    moves: { clear() {} },
    banner: told("banner", "itBegan"),
    showState() {},
  });
  page.connected(true);
  calls.length = 0;
  return { page, state, calls, frames };
}

test("after a reconnect, changes of the connection before are not shown", () => {
  const { page, state, calls, frames } = pageOf();
  page.frame(bytesOf(key({ tick: 5, key: 1 })));
  page.frame(bytesOf(change({ tick: 6, key: 1 })));
  page.connected(false);
  assert.equal(state.connected, false);
  assert.deepEqual(calls, [], "the picture stays while the server is away");
  page.connected(true);
  assert.equal(state.connected, true);
  assert.deepEqual(calls, ["marks.forget", "picture.setDrawing"]);
  page.frame(bytesOf(change({ tick: 8, key: 1 })));
  assert.deepEqual(frames, [5, 6], "its key came before");
  page.frame(bytesOf(key({ tick: 9, key: 1 })));
  page.frame(bytesOf(change({ tick: 10, key: 1 })));
  assert.deepEqual(frames, [5, 6, 9, 10]);
  assert.equal(state.live.tick, 10);
});

test("after a reconnect the run goes on from its tick or a later one, and an earlier tick is of another run", () => {
  const { page, state, calls, frames } = pageOf();
  page.frame(bytesOf(key({ tick: 7 })));
  state.status = { phase: "running" };
  for (const tick of [7, 9]) {
    page.connected(true);
    calls.length = 0;
    page.frame(bytesOf(key({ tick })));
    assert.deepEqual(calls, []);
    assert.deepEqual(state.status, { phase: "running" });
  }
  page.connected(true);
  calls.length = 0;
  page.frame(bytesOf(key({ tick: 8 })));
  assert.deepEqual(calls, ["the experiment was started again", "banner.itBegan"]);
  assert.equal(state.status, null);
  assert.equal(state.live.tick, 8);
  assert.deepEqual(frames, [7, 7, 9, 8]);
});

test("a run that was finished and is not any more has begun again", () => {
  const { page, state, calls } = pageOf();
  for (const phase of ["running", "finished", "finished"]) page.message({ type: "status", phase });
  assert.deepEqual(calls, []);
  page.message({ type: "status", phase: "paused" });
  assert.deepEqual(calls, ["the experiment was started again", "banner.itBegan"]);
  assert.equal(state.status.phase, "paused");
});

test("the present is kept, not shown, while the page looks back", () => {
  const { page, state, calls, frames } = pageOf();
  page.frame(bytesOf(key({ tick: 7 })));
  page.past.isOn = true;
  page.frame(bytesOf(key({ tick: 8 })));
  assert.deepEqual(frames, [7]);
  assert.equal(state.frame.tick, 7);
  assert.equal(state.live.tick, 8);
  page.frame(bytesOf([...header(PAST, 2, { tick: 3 }), ...key().slice(8)]));
  assert.equal(calls[0], "past.show");
  assert.equal(calls[1].tick, 3);
  assert.equal(state.live.tick, 8, "a state of the past is no new run");
});

test("a page tries to connect again at growing intervals, and soon again after a connection", (context) => {
  const { setTimeout, location, WebSocket } = globalThis;
  context.after(() => Object.assign(globalThis, { setTimeout, location, WebSocket }));
  const sockets = [], delays = [], told = [];
  let over = false;
  globalThis.location = { protocol: "https:", host: "there:1" };
  globalThis.WebSocket = class {
    constructor(address) {
      this.address = address;
      sockets.push(this);
    }
  };
  globalThis.setTimeout = (connect, delay) => {
    delays.push(delay);
    connect();
  };
  new Connection({ onOpen: () => told.push("open"), onClose: () => told.push("close"), onText: (message) => told.push(message), onFrame: (buffer) => told.push(buffer), isOver: () => over });
  const fail = () => sockets.at(-1).onclose();
  for (let k = 0; k < 7; k++) fail();
  assert.deepEqual(delays.map(Math.round), [300, 480, 768, 1229, 1966, 3000, 3000]);
  assert.equal(sockets.length, 8);
  assert.equal(sockets[7].address, "wss://there:1/stream");
  told.length = 0;
  sockets[7].onopen();
  sockets[7].onmessage({ data: '{"type":"welcome"}' });
  const buffer = new ArrayBuffer(4);
  sockets[7].onmessage({ data: buffer });
  fail();
  assert.deepEqual(told, ["open", { type: "welcome" }, buffer, "close"]);
  assert.equal(delays.at(-1), 300);
  over = true;
  fail();
  assert.equal(sockets.length, 9, "a page that has ended its run does not connect again");
});
