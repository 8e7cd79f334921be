// The choice of the page's quality, with a clock of its own.
import assert from "node:assert/strict";
import test from "node:test";
import { Governor, qualities } from "../../visualiser/web/page/src/view/quality_levels.js";

// Pictures at this distance for so long. Returns the qualities it chose.
function play(governor, clock, period_ms, seconds) {
  const chosen = [];
  for (const end = clock.now + 1000 * seconds; clock.now < end; clock.now += period_ms)
    if (governor.observe(clock.now, true)) chosen.push(governor.quality);
  return chosen;
}

test("slow pictures lower the quality step by step to the last", () => {
  const governor = new Governor("high");
  assert.deepEqual(play(governor, { now: 0 }, 200, 20), Object.keys(qualities).slice(1));
});

test("it falls within two seconds", () => {
  assert.deepEqual(play(new Governor("high"), { now: 0 }, 100, 2), ["medium"]);
});

test("pictures that take seconds lower it as well", () => {
  assert.deepEqual(play(new Governor("high"), { now: 0 }, 2500, 30), Object.keys(qualities).slice(1));
});

test("a pace that is good enough changes nothing", () => {
  assert.deepEqual(play(new Governor("medium"), { now: 0 }, 33, 60), []);
});

test("quick pictures raise it, but not at once to where it was too slow", () => {
  const governor = new Governor("low");
  const clock = { now: 0 };
  assert.deepEqual(play(governor, clock, 16, 8), ["medium"]);
  assert.deepEqual(play(governor, clock, 100, 2), ["low"]);
  assert.deepEqual(play(governor, clock, 16, 25), []);
  assert.deepEqual(play(governor, clock, 16, 7), ["medium"]);
  // Each fall makes it wait longer.
  assert.deepEqual(play(governor, clock, 100, 2), ["low"]);
  assert.deepEqual(play(governor, clock, 16, 50), []);
});

test("one long picture among quick ones changes nothing", () => {
  const governor = new Governor("high");
  const clock = { now: 0 };
  for (let i = 0; i < 20; i++) {
    assert.deepEqual(play(governor, clock, 16, 1), []);
    clock.now += 400;
  }
});

test("pictures that are drawn now and then say nothing about the pace", () => {
  const governor = new Governor("high");
  for (let now = 0; now < 60000; now += 100) assert.equal(governor.observe(now, now % 200 === 0), false);
});
