// The binary frame of the server (docs/web_render.md), read in place: little-endian, structure of arrays.

const MAGIC = 0x314d5753;
const HEADER_BYTES = 40;

export const Flag = { lit: 1, unevenRing: 2, gripping: 4, laserOn: 8, beaconLit: 16, attached: 32, absent: 64 };
export const RING_LEDS = 16;

// Throws an Error for anything else than a frame.
export function decodeFrame(buffer) {
  const view = new DataView(buffer);
  if (buffer.byteLength < HEADER_BYTES || view.getUint32(0, true) !== MAGIC) throw new Error("this is no frame");
  const count = view.getUint32(4, true);
  const counts = { beams: view.getUint32(24, true), grips: view.getUint32(28, true), rings: view.getUint32(32, true) };
  const size = HEADER_BYTES + 24 * count + 20 * counts.beams + 8 * counts.grips + (4 + 3 * RING_LEDS) * counts.rings;
  if (buffer.byteLength !== size) throw new Error(`the frame has ${buffer.byteLength} bytes instead of ${size}`);

  let place = HEADER_BYTES + 24 * count;
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

  return {
    count,
    tick: Number(view.getBigUint64(8, true)),
    time: view.getFloat64(16, true),
    positions: new Float32Array(buffer, HEADER_BYTES, 3 * count),
    quaternions: new Int16Array(buffer, HEADER_BYTES + 12 * count, 4 * count), // times 32767
    colours: new Uint8Array(buffer, HEADER_BYTES + 20 * count, 4 * count), // red, green, blue, flags
    beams,
    grips,
    rings,
  };
}
