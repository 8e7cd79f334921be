// Reads the binary states of the server (docs/web_render.md) in place: little-endian, structure of arrays.

const KEY_MAGIC = 0x314d5753; // the whole state
const PAST_MAGIC = 0x334d5753; // the whole state of a requested tick
const CHANGE_MAGIC = 0x324d5753; // the changes since a key
const HEADER_BYTES = 40;
const STEP_M = 1e-4;

export const isPast = (buffer) => buffer.byteLength >= HEADER_BYTES && new DataView(buffer).getUint32(0, true) === PAST_MAGIC;

export const Flag = { lit: 1, unevenRing: 2, gripping: 4, laserOn: 8, beaconLit: 16, attached: 32, absent: 64 };
export const RING_LEDS = 16;

// Reads states in the order of their arrival.
export class FrameDecoder {
  // Returns null for a change whose key has not come. Throws an Error for data that is no state.
  decode(buffer) {
    const view = new DataView(buffer);
    const magic = buffer.byteLength < HEADER_BYTES ? 0 : view.getUint32(0, true);
    if (![KEY_MAGIC, CHANGE_MAGIC, PAST_MAGIC].includes(magic)) throw new Error("this is no frame");
    const u32 = (place) => view.getUint32(place, true);
    const frame = { count: u32(4), tick: Number(view.getBigUint64(8, true)), time: view.getFloat64(16, true), key: u32(36) };
    const lists = { beams: u32(24), grips: u32(28), rings: u32(32) };
    if (magic === PAST_MAGIC) return this.readKey(buffer, view, frame, lists);
    if (magic === KEY_MAGIC) return (this.key = this.readKey(buffer, view, frame, lists));
    return frame.key === this.key?.key && frame.count === this.key.count ? this.readChange(buffer, view, frame, lists) : null;
  }

  readKey(buffer, view, frame, lists) {
    const { count } = frame;
    checkSize(buffer, HEADER_BYTES + 24 * count, lists);
    return {
      ...frame,
      positions: new Float32Array(buffer, HEADER_BYTES, 3 * count),
      quaternions: new Int16Array(buffer, HEADER_BYTES + 12 * count, 4 * count), // times 32767
      colours: new Uint8Array(buffer, HEADER_BYTES + 20 * count, 4 * count), // red, green, blue, flags
      ...readLists(buffer, view, HEADER_BYTES + 24 * count, lists),
    };
  }

  readChange(buffer, view, frame, lists) {
    const { count } = frame;
    const [poses, colours] = [view.getUint32(HEADER_BYTES, true), view.getUint32(HEADER_BYTES + 4, true)];
    const begin = HEADER_BYTES + 8;
    checkSize(buffer, begin + 24 * poses + 8 * colours + 6 * count, lists);
    const steps = new Int16Array(buffer, buffer.byteLength - 6 * count, 3 * count);
    const state = { positions: this.key.positions.slice(), quaternions: new Int16Array(4 * count), colours: this.key.colours.slice() };
    for (let i = 0; i < count; i++) {
      state.positions[3 * i] += STEP_M * steps[3 * i];
      state.positions[3 * i + 1] += STEP_M * steps[3 * i + 1];
      const half = (steps[3 * i + 2] * Math.PI) / 2 / 32767;
      state.quaternions[4 * i + 2] = Math.round(32767 * Math.sin(half));
      state.quaternions[4 * i + 3] = Math.round(32767 * Math.cos(half));
    }
    let place = begin;
    for (let i = 0; i < poses; i++, place += 24) {
      const slot = slotAt(view, place, count);
      for (let k = 0; k < 3; k++) state.positions[3 * slot + k] = view.getFloat32(place + 4 + 4 * k, true);
      for (let k = 0; k < 4; k++) state.quaternions[4 * slot + k] = view.getInt16(place + 16 + 2 * k, true);
    }
    for (let i = 0; i < colours; i++, place += 8) {
      const slot = slotAt(view, place, count);
      for (let k = 0; k < 4; k++) state.colours[4 * slot + k] = view.getUint8(place + 4 + k);
    }
    return { ...frame, ...state, ...readLists(buffer, view, place, lists) };
  }
}

function slotAt(view, place, count) {
  const slot = view.getUint32(place, true);
  if (slot >= count) throw new Error(`the frame names slot ${slot} of ${count}`);
  return slot;
}

function checkSize(buffer, fixed, { beams, grips, rings }) {
  const size = fixed + 20 * beams + 8 * grips + (4 + 3 * RING_LEDS) * rings;
  if (buffer.byteLength !== size) throw new Error(`the frame has ${buffer.byteLength} bytes instead of ${size}`);
}

function readLists(buffer, view, start, counts) {
  let place = start;
  const beams = [];
  for (let i = 0; i < counts.beams; i++, place += 20)
    beams.push({
      entity: view.getUint32(place, true),
      x: view.getFloat32(place + 4, true),
      y: view.getFloat32(place + 8, true),
      z: view.getFloat32(place + 12, true),
      colour: view.getUint32(place + 16, true),
    });
  const grips = [];
  for (let i = 0; i < counts.grips; i++, place += 8)
    grips.push({ robot: view.getUint32(place, true), held: view.getUint32(place + 4, true) });
  const rings = [];
  for (let i = 0; i < counts.rings; i++, place += 4 + 3 * RING_LEDS)
    rings.push({ entity: view.getUint32(place, true), colours: new Uint8Array(buffer, place + 4, 3 * RING_LEDS) });
  return { beams, grips, rings };
}
