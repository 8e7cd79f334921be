// A run that the page itself has, in place of the connection to a server. It answers the same requests: a tick of the
// past comes as a state and the message `past`. visualiser/web/recording_writer.h makes it, and has its format.
import { RING_LEDS } from "./protocol.js";

const KEPT_BLOCKS = 12; // decoded ones; each has about 6 MB at most
const HALF_TURN = 32767;
const POSE_X = 1, POSE_Y = 2, POSE_Z = 4, TURN = 8, SPATIAL = 16; // bits of an entity's mode in a block: see decodeBlock

// Reads bytes and numbers of variable length in their order.
export class Bytes {
  constructor(buffer) {
    this.bytes = new Uint8Array(buffer);
    this.view = new DataView(buffer);
    this.place = 0;
  }

  byte() {
    if (this.place >= this.bytes.length) throw new Error("the recording is cut off");
    return this.bytes[this.place++];
  }

  // A number from 0 on: seven bits a byte, the lowest first.
  count() {
    let [value, factor] = [0, 1];
    while (true) {
      const byte = this.byte();
      value += (byte & 127) * factor;
      if (byte < 128) return value;
      factor *= 128;
    }
  }

  // 0, -1, 1, -2, … as 0, 1, 2, 3, …
  signed() {
    const value = this.count();
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  }

  take(length) {
    if (this.place + length > this.bytes.length) throw new Error("the recording is cut off");
    const start = this.place;
    this.place += length;
    return this.bytes.subarray(start, this.place);
  }

  // A whole number, or after 1 a float.
  value() {
    const first = this.count();
    if (first !== 1) return first % 4 === 0 ? first / 4 : -(first + 2) / 4;
    return new DataView(this.take(4).slice().buffer).getFloat32(0, true);
  }
}

// Returns the states of a block: `ticks`, and for each state its poses, colours, lists and attributes.
//
// The columns x, y, z and the heading of each entity are second differences of whole numbers. A column that does not
// change has only its first value. An entity that tilts has four columns of its quaternion instead of the heading.
export function decodeBlock(buffer, { count, attributes, unit }) {
  const bytes = new Bytes(buffer);
  const states = bytes.count();
  const ticks = [bytes.count()];
  while (ticks.length < states) ticks.push(ticks.at(-1) + bytes.count());
  const block = { ticks, count, positions: new Float32Array(3 * count * states), quaternions: new Int16Array(4 * count * states), colours: new Uint8Array(4 * count * states), lists: [], attributes: [] };
  for (let slot = 0; slot < count; slot++) readPoses(bytes, block, slot, unit);
  readColours(bytes, block);
  for (let i = 0; i < states; i++) block.lists.push(readLists(bytes) ?? block.lists.at(-1));
  readAttributes(bytes, block, attributes);
  return block;
}

function readColumn(bytes, varies, states, use) {
  let value = bytes.signed();
  let step = 0;
  use(0, value);
  for (let i = 1; i < states; i++) {
    if (varies) value += step += bytes.signed();
    use(i, value);
  }
}

function readPoses(bytes, { ticks, count, positions, quaternions }, slot, unit) {
  const states = ticks.length;
  const mode = bytes.byte();
  [POSE_X, POSE_Y, POSE_Z].forEach((bit, k) => readColumn(bytes, mode & bit, states, (i, value) => (positions[3 * (i * count + slot) + k] = value * unit)));
  if (mode & SPATIAL) {
    for (let k = 0; k < 4; k++) readColumn(bytes, mode & TURN, states, (i, value) => (quaternions[4 * (i * count + slot) + k] = value));
    return;
  }
  readColumn(bytes, mode & TURN, states, (i, value) => {
    const half = (value * Math.PI) / 2 / HALF_TURN;
    quaternions[4 * (i * count + slot) + 2] = Math.round(HALF_TURN * Math.sin(half));
    quaternions[4 * (i * count + slot) + 3] = Math.round(HALF_TURN * Math.cos(half));
  });
}

function readColours(bytes, { ticks, count, colours }) {
  colours.set(bytes.take(4 * count));
  for (let i = 1; i < ticks.length; i++) {
    colours.copyWithin(4 * count * i, 4 * count * (i - 1), 4 * count * i);
    let slot = -1;
    for (let changed = bytes.count(); changed > 0; changed--) {
      slot += bytes.count();
      colours.set(bytes.take(4), 4 * (count * i + slot));
    }
  }
}

// Returns null if the lists are those of the state before.
function readLists(bytes) {
  if (bytes.byte() === 0) return null;
  const counts = [bytes.count(), bytes.count(), bytes.count()];
  const view = (length) => new DataView(bytes.take(length).slice().buffer);
  const list = (length, size, of) => {
    const data = view(length * size);
    return Array.from({ length }, (_, i) => of(data, i * size));
  };
  return {
    beams: list(counts[0], 20, (data, at) => ({ entity: data.getUint32(at, true), x: data.getFloat32(at + 4, true), y: data.getFloat32(at + 8, true), z: data.getFloat32(at + 12, true), colour: data.getUint32(at + 16, true) })),
    grips: list(counts[1], 8, (data, at) => ({ robot: data.getUint32(at, true), held: data.getUint32(at + 4, true) })),
    rings: list(counts[2], 4 + 3 * RING_LEDS, (data, at) => ({ entity: data.getUint32(at, true), colours: new Uint8Array(data.buffer, at + 4, 3 * RING_LEDS) })),
  };
}

// `block.attributes` gets for each state the numbers and values of the attributes that change there; for the first
// state, of all that are not 0.
function readAttributes(bytes, block, attributes) {
  for (let i = 0; i < block.ticks.length; i++) {
    const changes = [];
    let number = -1;
    for (let changed = bytes.count(); changed > 0; changed--) {
      number += bytes.count();
      if (number >= attributes) throw new Error(`the recording names attribute ${number} of ${attributes}`);
      changes.push([number, bytes.value()]);
    }
    block.attributes.push(changes);
  }
}

// Returns the content of an element of the page: base64 of compressed bytes.
async function unpack(element) {
  const packed = Uint8Array.from(atob(element.textContent.trim()), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

const unpackJson = async (id) => JSON.parse(new TextDecoder().decode(await unpack(document.getElementById(id))));

export class Recording {
  // Returns whether this page has a run.
  static get isHere() {
    return document.getElementById("swarmanoid-run") !== null;
  }

  // Returns the models of robots, which other pages fetch.
  static meshes() {
    return unpackJson("swarmanoid-meshes");
  }

  // `handlers`: onOpen(), onText(message), onPast(frame), onFailure(error).
  constructor(handlers) {
    this.handlers = handlers;
    this.blocks = new Map(); // decoded ones, the last used one last
    this.asked = Promise.resolve();
    this.open().catch((error) => handlers.onFailure(error));
  }

  async open() {
    const head = (this.head = await unpackJson("swarmanoid-run"));
    this.elements = [...document.querySelectorAll("script.swarmanoid-block")];
    const { world } = head;
    this.count = world.entities.movable.filter((moves) => moves === 1).length;
    this.numberAttributes(world);
    const { handlers } = this;
    handlers.onOpen();
    handlers.onText({ type: "welcome", control: "read-only" });
    handlers.onText({ type: "world", ...world });
    handlers.onText(this.coloursAt(head.timeline.first));
    handlers.onText({ type: "status", phase: "recorded", real_time_factor: 0, speed_wanted: 1, processes: [] });
    for (const note of head.notes) handlers.onText({ type: "log", tick: null, source: "page", level: "info", text: note });
    handlers.onText({ type: "timeline", run: null, ...head.timeline });
  }

  // The numbers of all attributes, in the order of the entities.
  numberAttributes({ entities, kinds, attributes }) {
    const left = new Set(this.head.left_out);
    this.attributesOf = [];
    let number = 0;
    for (const kind of entities.kind) {
      const list = [];
      for (const { name, count } of attributes[kinds[kind]] ?? [])
        if (!left.has(name)) {
          list.push({ name, count, first: number });
          number += count;
        }
      this.attributesOf.push(list);
    }
    this.attributes = number;
  }

  // Other requests are those to a run, and have no answer here.
  send(request) {
    if (request.do !== "look_back") return;
    this.asked = this.asked.then(() => this.answer(request)).catch((error) => this.handlers.onText({ type: "reply", ok: false, text: `nothing can be shown of tick ${request.tick}: ${error.message}` }));
  }

  async answer({ tick, entities }) {
    const block = await this.blockOf(tick);
    let state = block.ticks.findLastIndex((each) => each <= tick);
    if (state < 0) state = 0;
    const at = block.ticks[state];
    const time = at * this.head.world.tick_seconds;
    const details = entities.length > 0 ? this.detailsOf(block, state, entities) : [];
    this.handlers.onText({ type: "past", tick: at, time_s: time, entities: details, colours: this.coloursAt(at) });
    const { count } = this;
    this.handlers.onPast({
      count,
      tick: at,
      time,
      key: 0,
      positions: block.positions.subarray(3 * count * state, 3 * count * (state + 1)),
      quaternions: block.quaternions.subarray(4 * count * state, 4 * count * (state + 1)),
      colours: block.colours.subarray(4 * count * state, 4 * count * (state + 1)),
      ...block.lists[state],
    });
  }

  async blockOf(tick) {
    const { firsts } = this.head;
    let number = firsts.findLastIndex((first) => first <= tick);
    if (number < 0) number = 0;
    const known = this.blocks.get(number);
    this.blocks.delete(number);
    const block = known ?? decodeBlock(await unpack(this.elements[number]), { count: this.count, attributes: this.attributes, unit: this.head.unit_m });
    this.blocks.set(number, block);
    if (this.blocks.size > KEPT_BLOCKS) this.blocks.delete(this.blocks.keys().next().value);
    return block;
  }

  detailsOf(block, state, entities) {
    if (block.filled?.state > state || !block.filled) block.filled = { state: -1, values: new Float64Array(this.attributes) };
    const { filled } = block;
    while (filled.state < state) for (const [number, value] of block.attributes[++filled.state]) filled.values[number] = value;
    return entities.map((entity) => ({
      entity,
      attributes: Object.fromEntries(this.attributesOf[entity].map(({ name, count, first }) => [name, [...filled.values.subarray(first, first + count)]])),
    }));
  }

  // Colours of lights, patches and fixed entities, which states do not have.
  coloursAt(tick) {
    const { colours } = this.head;
    const found = colours.findLast(([first]) => first <= tick) ?? colours[0];
    return found[1];
  }
}
