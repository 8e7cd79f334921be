// What the page computes from states: plots, swarm values, heat map, links.
import assert from "node:assert/strict";
import { test } from "node:test";
import { readLink, writeLink } from "../../visualiser/web/page/src/link.js";
import { Flag } from "../../visualiser/web/page/src/protocol.js";
import { MOST_POINTS, Series, toCsv } from "../../visualiser/web/page/src/ui/series.js";
import { HeatMap } from "../../visualiser/web/page/src/view/heat_map.js";
import { Colouring, Meter, rampColour } from "../../visualiser/web/page/src/view/robot_values.js";

// Robots in an arena of 4 m x 2 m; entity 0 is a wall.
function worldOf(count) {
  const robots = Array.from({ length: count }, (_, i) => i + 1);
  return {
    arena: [4, 2, 1],
    robots,
    movable: robots,
    slots: [-1, ...robots.map((_, i) => i)],
    engineOf: [-1, ...robots.map((_, i) => i % 2)],
    hostOf: [],
    controllerOf: [],
  };
}
// places: [x, y, yaw] of each
function frameOf(time, places, flags = places.map(() => 0)) {
  return {
    time,
    positions: Float32Array.from(places.flatMap(([x, y]) => [x, y, 0])),
    quaternions: Int16Array.from(places.flatMap(([, , yaw = 0]) => [0, 0, Math.round(32767 * Math.sin(yaw / 2)), Math.round(32767 * Math.cos(yaw / 2))])),
    colours: Uint8Array.from(flags.flatMap((flag) => [9, 9, 9, flag])),
    rings: [],
  };
}

test("a series keeps the whole run, thinned out where it is old, and begins again with another run", () => {
  const series = new Series("x");
  const count = 3 * MOST_POINTS;
  for (let i = 0; i < count; i++) series.add(0.1 * i, i);
  assert.ok(series.times.length <= MOST_POINTS && series.times.length > MOST_POINTS / 2);
  assert.equal(series.times[0], 0);
  assert.equal(series.values.at(-1), count - 1);
  for (let i = 1; i < series.times.length; i++) assert.ok(series.times[i] > series.times[i - 1]);
  series.times.forEach((time, i) => assert.ok(Math.abs(time - 0.1 * series.values[i]) < 1e-6));
  assert.equal(series.from(series.times[700]), 700);
  assert.equal(series.from(series.times[700] + 1e-9), 701);
  series.add(0.05, 7);
  assert.deepEqual([series.times, series.values], [[0.05], [7]]);
});

test("what is no number is no point", () => {
  const series = new Series("x");
  for (const value of [NaN, Infinity, null, undefined]) assert.ok(!series.add(1, value));
  assert.deepEqual(series.times, []);
});

test("a table has a line for each time and empty fields where a series has no value", () => {
  const [a, b] = [new Series("left, fast"), new Series("mean")];
  a.add(1, 10);
  a.add(2, 20);
  b.add(2, 0.5, 0.25);
  b.add(3, 0.75, 0.125);
  assert.equal(
    toCsv([a, b], "m/s"),
    'time (s),"left, fast (m/s)",mean (m/s),"mean, standard deviation (m/s)"\n1,10,,\n2,20,0.5,0.25\n3,,0.75,0.125\n',
  );
});

test("speed and turn rate are differences over simulated time; jumps are none", () => {
  const meter = new Meter(worldOf(3));
  meter.add(frameOf(1, [[0, 0, 3.1], [1, 1], [1, 1]]));
  assert.equal(meter.value("speed", 1), undefined);
  meter.add(frameOf(1.5, [[0.03, 0.04, -3.1], [1, 1], [3, 1]]));
  assert.ok(Math.abs(meter.value("speed", 1) - 0.1) < 1e-6);
  assert.ok(Math.abs(meter.value("turn rate", 1) - ((2 * Math.PI - 6.2) * 180) / Math.PI / 0.5) < 0.1);
  assert.equal(meter.value("speed", 3), 0);
  const { count, mean, deviation } = meter.statistics("speed", [1, 2]);
  assert.deepEqual([count, Math.abs(mean - 0.05) < 1e-6, Math.abs(deviation - 0.05) < 1e-6], [2, true, true]);
  // The same state again does not make robots stand still.
  meter.add(frameOf(1.5, [[0.03, 0.04, -3.1], [1, 1], [3, 1]]));
  assert.ok(Math.abs(meter.value("speed", 1) - 0.1) < 1e-6);
});

test("who is not in the arena counts for nothing", () => {
  const meter = new Meter(worldOf(2));
  meter.add(frameOf(1, [[2, 1], [9000, 9000]], [0, Flag.absent]));
  assert.equal(meter.value("distance from the middle", 2), undefined);
  assert.deepEqual(meter.statistics("distance from the middle", [1, 2]), { count: 1, mean: 0, deviation: 0 });
});

test("robots are coloured from the lowest to the highest value, and the frame that came stays as it is", () => {
  const world = worldOf(3);
  const meter = new Meter(world);
  const frame = frameOf(1, [[2, 1], [3, 1], [4, 1]], [Flag.unevenRing, 0, 0]);
  meter.add(frame);
  const shown = new Colouring(world, "distance from the middle").apply(frame, meter);
  const colourOf = (slot) => [...shown.colours.subarray(4 * slot, 4 * slot + 3)];
  assert.deepEqual([0, 1, 2].map(colourOf), [rampColour(0), rampColour(0.5), rampColour(1)]);
  assert.equal(shown.colours[3], Flag.lit);
  assert.deepEqual([...frame.colours.subarray(0, 4)], [9, 9, 9, Flag.unevenRing]);
});

test("the heat map holds the seconds that robots spent in each cell", () => {
  globalThis.document = {
    createElement: () => ({ getContext: () => ({ createImageData: (w, h) => ({ data: new Uint8ClampedArray(4 * w * h) }), putImageData() {} }) }),
  };
  const map = new HeatMap(worldOf(2));
  assert.equal(map.columns / map.rows, 2);
  for (let i = 0; i <= 10; i++) map.add(frameOf(0.1 * i, [[0.01, 0.01], [3.99, 1.99]]));
  assert.ok(Math.abs(map.seconds[0] - 1) < 1e-9);
  assert.ok(Math.abs(map.seconds.at(-1) - 1) < 1e-9);
  assert.ok(Math.abs(map.seconds.reduce((a, b) => a + b) - 2) < 1e-9);
  map.add(frameOf(1.1, [[-5, 0], [9, 9]]));
  assert.ok(Math.abs(map.seconds.reduce((a, b) => a + b) - 2) < 1e-9, "no robot is outside");
});

test("a link says what it was made from, and nothing else is believed", () => {
  const wanted = { view: { target: [1.5, -2, 0.25], span: 3.5, direction: [0.1, -0.8, 0.5] }, select: "fb_1 & 2", shows: ["ids", "trails"], colours: "turn rate", quality: "plan" };
  assert.deepEqual(readLink(writeLink(wanted)), wanted);
  assert.deepEqual(readLink(writeLink({ view: { target: [0, 0, 0], span: 2, direction: null } })), { view: { target: [0, 0, 0], span: 2, direction: null } });
  for (const fragment of ["", "at=1,2&span=3", "at=1,2,3&span=-1", "at=1,2,nan&span=3", "at=1,2,1e300&span=3", "token=abc"]) assert.deepEqual(readLink(fragment), {});
});
