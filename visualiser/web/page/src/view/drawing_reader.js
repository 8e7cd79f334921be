// Reads drawings of experiment functions (docs/web_render.md) in place: little-endian.
const DRAWING_MAGIC = 0x344d5753;
const HEADER_BYTES = 32;
const [LINE_WORDS, TRIANGLE_WORDS, DOT_WORDS] = [8, 10, 5];

export const isDrawing = (buffer) => buffer.byteLength >= HEADER_BYTES && new DataView(buffer).getUint32(0, true) === DRAWING_MAGIC;

// Returns {tick, lines: [{width, colour, opacity, points}], triangles: [{opacity, …}], dots: [{diameter, …}], texts:
// [{place, text, colour, opacity}]}. Shapes of equal look form one list; `points` has three numbers a place. Throws an
// Error for data that is no drawing.
export function readDrawing(buffer) {
  const view = new DataView(buffer);
  const [lines, triangles, dots] = [4, 8, 12].map((place) => view.getUint32(place, true));
  const textBytes = view.getUint32(24, true);
  const words = LINE_WORDS * lines + TRIANGLE_WORDS * triangles + DOT_WORDS * dots;
  if (buffer.byteLength !== HEADER_BYTES + 4 * words + textBytes) throw new Error("this is no drawing");
  const numbers = new Float32Array(buffer, HEADER_BYTES, words);
  const colours = new Uint32Array(buffer, HEADER_BYTES, words);
  let at = 0;
  // `places`: the number of places of a shape; `size`: whether another number follows its colour.
  const read = (count, places, size) => {
    const groups = new Map();
    for (let i = 0; i < count; i++) {
      const colour = colours[at + places];
      const width = size ? numbers[at + places + 1] : 0;
      const key = `${colour} ${width}`;
      if (!groups.has(key)) groups.set(key, { colour: colour >>> 8, opacity: (colour & 255) / 255, width, points: [] });
      const { points } = groups.get(key);
      for (let k = 0; k < places; k++) points.push(numbers[at + k]);
      at += places + (size ? 2 : 1);
    }
    return [...groups.values()];
  };
  const drawing = { tick: Number(view.getBigUint64(16, true)), lines: read(lines, 6, true), triangles: read(triangles, 9, false), dots: read(dots, 3, true) };
  const texts = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, buffer.byteLength - textBytes)));
  drawing.texts = texts.map(([x, y, z, colour, text]) => ({ place: [x, y, z], text, colour: colour >>> 8, opacity: (colour & 255) / 255 }));
  return drawing;
}
