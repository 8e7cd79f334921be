// The timeline and the list of entities, in a document that holds elements and draws nothing; and looking back.
import assert from "node:assert/strict";
import { test } from "node:test";

class Element {
  constructor(tag) {
    Object.assign(this, { tag, children: [], attributes: {}, listeners: {}, style: {}, dataset: {}, textContent: "", value: "" });
    Object.assign(this, { hidden: false, scrollTop: 0, clientHeight: 0 });
    const classes = new Set();
    this.classList = { contains: (name) => classes.has(name), toggle: (name, on) => (on ? classes.add(name) : classes.delete(name)) };
  }
  setAttribute(name, value) {
    this.attributes[name] = value;
  }
  addEventListener(name, listener) {
    this.listeners[name] = listener;
  }
  append(...children) {
    this.children.push(...children);
  }
  replaceChildren(...children) {
    this.children = children;
  }
}
globalThis.document = { createElement: (tag) => new Element(tag), createElementNS: (_, tag) => new Element(tag) };
globalThis.ResizeObserver = class {
  observe() {}
};
const { EntityList, matcher } = await import("../../visualiser/web/page/src/ui/list.js");
const { Timeline } = await import("../../visualiser/web/page/src/ui/timeline.js");
const { PlaybackRequests } = await import("../../visualiser/web/page/src/playback_requests.js");

const EVENTS = [
  { tick: 5, what: "move", entity: "fb_1", from: "anna@lab" },
  { tick: 20, what: "pause" },
  { tick: 20, what: "resume" },
  { tick: 35, what: "remove", entity: "fb_2" },
];

function timelineOf(message, tickSeconds = 0.1) {
  const looked = [];
  const timeline = new Timeline({ look: (tick) => looked.push(tick) });
  timeline.set({ first: 0, last: 50, events: EVENTS, all_events: EVENTS.length, ...message }, tickSeconds);
  return { timeline, looked };
}

test("a timeline is shown from two ticks on", () => {
  for (const [first, last, hidden] of [[0, 0, true], [0, 1, false], [7, 7, true], [7, 8, false]])
    assert.equal(timelineOf({ first, last }).timeline.element.hidden, hidden, `${first} to ${last}`);
});

test("the next event is after the tick that is shown, the previous one before it", () => {
  const { timeline } = timelineOf({});
  const from = (tick) => [timeline.neighbour(tick, false), timeline.neighbour(tick, true)];
  assert.deepEqual(from(4), [null, 5]);
  assert.deepEqual(from(5), [null, 20]);
  assert.deepEqual(from(19), [5, 20]);
  assert.deepEqual(from(20), [5, 35]);
  assert.deepEqual(from(21), [20, 35]);
  assert.deepEqual(from(35), [20, null]);
});

test("events stand at their ticks, and those before the first tick that is kept are left out", () => {
  const { timeline, looked } = timelineOf({ first: 10, last: 60 });
  assert.deepEqual(timeline.buttons.map(({ hidden }) => hidden), [true, false, false, false]);
  assert.deepEqual(timeline.buttons.slice(1).map(({ style }) => style.left), ["20%", "20%", "50%"]);
  assert.equal(timeline.neighbour(20, false), null);
  assert.equal(timeline.buttons[0].attributes.title, "tick 5: move fb_1 (anna@lab)");
  assert.equal(timeline.buttons[3].attributes.title, "tick 35: remove fb_2");
  timeline.buttons[3].listeners.click();
  assert.deepEqual(looked, [35]);
  assert.equal(timelineOf({ first: 5 }).timeline.buttons[0].hidden, false, "the first tick has its events");
});

test("events that are left out are counted", () => {
  assert.match(timelineOf({ all_events: 900 }).timeline.buttons[0].attributes.title, /\(the first 4 of 900 events\)$/);
});

test("the present moves on, and the past that is looked at stays", () => {
  const { timeline } = timelineOf({});
  assert.equal(timeline.text.textContent, "live · 0:05.0");
  assert.equal(timeline.track.value, 50);
  timeline.show(33);
  timeline.set({ first: 0, last: 700, events: EVENTS, all_events: 4 }, 0.1);
  assert.equal(timeline.track.value, 33);
  assert.equal(timeline.track.max, 700);
  assert.equal(timeline.text.textContent, "0:03.3 · tick 33");
  assert.equal(timeline.live.attributes["aria-pressed"], "false");
  timeline.show(null);
  assert.equal(timeline.track.value, 700);
  assert.equal(timeline.text.textContent, "live · 1:10.0");
  assert.equal(timeline.live.attributes["aria-pressed"], "true");
});

test("tick 0 is a tick of the past like others", () => {
  const { timeline } = timelineOf({});
  timeline.show(0);
  assert.equal(timeline.track.value, 0);
  assert.equal(timeline.text.textContent, "0:00.0 · tick 0");
});

function pastOf(...earlier) {
  const asked = [];
  let ended = 0;
  return { asked, past: new PlaybackRequests({ ask: (tick) => asked.push(tick), ended: () => ++ended, earlier: () => earlier.shift() ?? null }), ends: () => ended };
}

test("one tick is asked for at a time, and then the newest that is wanted", () => {
  const { past, asked } = pastOf();
  past.look(5, 0);
  past.look(7, 10);
  past.look(0, 20);
  assert.deepEqual(asked, [5]);
  past.answered(30);
  assert.deepEqual(asked, [5, 0]);
  past.answered(40);
  assert.deepEqual(asked, [5, 0]);
});

test("an answer that comes after the return to the present asks for nothing", () => {
  const { past, asked } = pastOf();
  past.look(5, 0);
  past.live();
  past.answered(10);
  assert.equal(past.isOn, false);
  assert.deepEqual(asked, [5]);
});

test("an answer is given up after five seconds", () => {
  const { past, asked } = pastOf();
  past.look(5, 0);
  past.look(6, 4999);
  assert.deepEqual(asked, [5]);
  past.look(7, 5000);
  assert.deepEqual(asked, [5, 7]);
});

test("playing follows the clock and ends at the present", () => {
  const { past, asked, ends } = pastOf();
  past.look(10, 0);
  past.answered(0);
  past.play(true, 0);
  past.advance(99, 13, 10);
  assert.deepEqual(asked, [10], "the next tick is not due yet");
  past.advance(100, 13, 10);
  past.advance(250, 13, 10);
  assert.deepEqual(asked, [10, 11], "the answer of one tick is awaited");
  past.answered(250);
  past.advance(250, 13, 10);
  assert.deepEqual(asked, [10, 11, 12]);
  past.answered(260);
  past.advance(299, 13, 10);
  assert.equal(ends(), 0);
  past.advance(300, 13, 10);
  assert.equal(ends(), 1);
});

test("earlier ticks are asked for one by one once the wanted one is shown, and wait for another wanted one", () => {
  const { past, asked } = pastOf(3, 4, 5);
  past.askEarlier(0);
  past.look(7, 0);
  past.askEarlier(0);
  assert.deepEqual(asked, [7], "its answer is awaited");
  past.answered(10);
  past.askEarlier(10);
  past.askEarlier(11);
  assert.deepEqual(asked, [7, 3]);
  assert.equal(past.isEarlier, true);
  past.look(9, 12);
  past.answered(13);
  assert.deepEqual(asked, [7, 3, 9]);
  assert.equal(past.isEarlier, false);
  past.answered(14);
  past.askEarlier(14);
  past.answered(15);
  past.askEarlier(15);
  past.answered(16);
  past.askEarlier(16);
  assert.deepEqual(asked, [7, 3, 9, 4, 5]);
  past.live();
  past.askEarlier(17);
  assert.equal(past.isOn, false);
});

// A wall, two footbots and an eyebot. Entity 2 is not in the arena.
const WORLD = {
  size: 4,
  ids: ["wall", "fb_1", "fb_12", "eb_1"],
  kinds: ["block", "footbot", "footbot", "eye_bot"],
  slots: [-1, 0, 1, 2],
  bodyOf: new Map([[0, { colour: 0x00ff01 }]]),
  engineName: (entity) => (entity === 3 ? "air (kinematics3d)" : "ground (dynamics2d)"),
  controllerName: (entity) => (entity === 0 ? "none" : "walk (footbot_diffusion)"),
  hostName: (entity) => (entity === 0 ? "none" : `controller host ${entity % 2}`),
  isRobot: (entity) => entity > 0,
};
const MOTION = { frame: {}, colour: (slot) => `rgb(${slot},0,0)`, isPresent: (slot) => slot !== 1 };

test("every word of a filter must be found, with a colon in its column", () => {
  const found = (text) => [0, 1, 2, 3].filter(matcher(text, WORLD));
  assert.deepEqual(found(""), [0, 1, 2, 3]);
  assert.deepEqual(found("FB_1"), [1, 2]);
  assert.deepEqual(found("foot 12"), [2]);
  assert.deepEqual(found("_1 foot"), [1, 2]);
  assert.deepEqual(found("engine:ground id:_1"), [1, 2]);
  assert.deepEqual(found("ground"), [], "other columns are searched by their name only");
  assert.deepEqual(found("host:1"), [1, 3]);
  assert.deepEqual(found("controller:none"), [0]);
  assert.deepEqual(found("speed:3"), [], "without such a column the word itself is searched");
});

function listOf(rows = 10) {
  const selected = [];
  const list = new EntityList({ select: (entity) => selected.push(entity) });
  list.scroll.clientHeight = 26 * rows;
  list.setWorld(WORLD);
  return { list, selected };
}
const shownRows = (list) => list.pool.filter(({ element }) => !element.hidden);
const shownIds = (list) => shownRows(list).map(({ id }) => id.textContent);

test("what moves comes first, and a filter says how many of all it shows", () => {
  const { list } = listOf();
  assert.deepEqual(shownIds(list), ["fb_1", "fb_12", "eb_1", "wall"]);
  assert.equal(list.count.textContent, "4");
  list.filter.value = "_1";
  list.filter.listeners.input();
  assert.deepEqual(shownIds(list), ["fb_1", "fb_12", "eb_1"]);
  assert.equal(list.count.textContent, "3 of 4");
  list.filter.value = "  ";
  list.filter.listeners.input();
  assert.equal(list.count.textContent, "4");
});

test("only rows in view exist, and they show what is scrolled to", () => {
  const { list } = listOf(1);
  assert.deepEqual(shownIds(list), ["fb_1", "fb_12"]);
  list.scroll.scrollTop = 26 * 3;
  list.scroll.listeners.scroll();
  assert.deepEqual(shownIds(list), ["wall"]);
  assert.equal(list.pool.length, 2);
});

test("a row shows the colour of its entity, and who is not in the arena is absent", () => {
  const { list } = listOf();
  list.render(MOTION);
  assert.deepEqual(shownRows(list).map(({ dot }) => dot.style.background), ["rgb(0,0,0)", "transparent", "rgb(2,0,0)", "#00ff01"]);
  assert.deepEqual(shownRows(list).map(({ element }) => element.classList.contains("absent")), [false, true, false, false]);
});

test("arrow keys go through what is shown and stop at its ends", () => {
  const { list, selected } = listOf();
  list.filter.value = "foot";
  list.refilter();
  const press = (key) => {
    list.scroll.listeners.keydown({ key, preventDefault() {}, stopPropagation() {} });
    list.select(selected.at(-1));
  };
  ["ArrowDown", "ArrowDown", "ArrowDown", "ArrowUp", "PageDown", "PageUp"].forEach(press);
  assert.deepEqual(selected, [1, 2, 2, 1, 2, 1]);
  assert.deepEqual(shownRows(list).map(({ element }) => element.attributes["aria-selected"]), ["true", "false"]);
  list.filter.value = "nothing";
  list.refilter();
  press("ArrowDown");
  assert.equal(selected.length, 6, "an empty list selects nothing");
});
