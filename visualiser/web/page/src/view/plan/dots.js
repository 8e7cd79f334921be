// Draws robots of a few pixels directly into the picture's memory. Ten thousand cost a few milliseconds; drawing
// commands would cost far more. A dot is a disc in its colour with a rim that stands out from the floor, and a nose to
// the front.
import { rgb } from "../look.js";

export const DOT_PIXELS = 10; // CSS pixels: larger robots are drawn as sprites
const HEADINGS = 16;
const PLACES = 3; // positions in a pixel along each side, so that dots glide instead of jumping
const SAMPLES = 3; // samples in a pixel along each side, for soft edges
const NOSE_FROM = 5.6; // pixels: on smaller dots a nose would hide the colour
const MOST_FAMILIES = 400;
const NOSE = 0xf08a3c;

// Returns the colour of a dot's rim: darker by day, lighter by night.
export function rimOf(colour, dark) {
  return rgb(colour).reduce((sum, channel) => sum * 256 + Math.round(dark ? 0.5 * channel + 0.5 * 255 : 0.42 * channel), 0);
}

export class DotSprites {
  constructor() {
    this.families = new Map(); // by size and colour: the sprites of all headings and subpixel positions
    this.key = null;
  }

  // Draws a dot about x, y (pixels) into `pixels` with so many columns and rows. `size`: the diameter in half pixels.
  draw(pixels, columns, rows, x, y, size, yaw, colour, dark) {
    const key = (size * 2 + (dark ? 1 : 0)) * 0x1000000 + colour;
    if (key !== this.key) this.changeTo(key, size / 2, colour, dark);
    const px = Math.floor(x);
    const py = Math.floor(y);
    const place = Math.floor((x - px) * PLACES) + PLACES * Math.floor((y - py) * PLACES);
    const heading = (Math.round((yaw * HEADINGS) / (2 * Math.PI)) + 4 * HEADINGS) % HEADINGS;
    const number = heading * PLACES * PLACES + place;
    const sprite = this.family.sprites[number] ?? (this.family.sprites[number] = makeSprite(this.family, heading, place));
    const { half, count, dx, dy, colours, opacity } = sprite;
    const inside = px >= half && py >= half && px + half < columns && py + half < rows;
    for (let i = 0; i < count; i++) {
      const column = px + dx[i];
      const row = py + dy[i];
      if (!inside && (column < 0 || row < 0 || column >= columns || row >= rows)) continue;
      const at = row * columns + column;
      const a = opacity[i];
      if (a === 256) {
        pixels[at] = colours[i];
        continue;
      }
      const over = colours[i];
      const under = pixels[at];
      const redBlue = (((over & 0xff00ff) * a + (under & 0xff00ff) * (256 - a)) >>> 8) & 0xff00ff;
      const green = (((over & 0xff00) * a + (under & 0xff00) * (256 - a)) >>> 8) & 0xff00;
      pixels[at] = 0xff000000 | redBlue | green;
    }
  }

  changeTo(key, diameter, colour, dark) {
    this.key = key;
    this.family = this.families.get(key);
    if (this.family) return;
    if (this.families.size >= MOST_FAMILIES) this.families.clear();
    this.family = { diameter, fill: colour, rim: rimOf(colour, dark), sprites: new Array(HEADINGS * PLACES * PLACES) };
    this.families.set(key, this.family);
  }
}

// Returns the pixels of a dot that are not clear: the offsets from its middle pixel, colour and opacity (0 to 256).
function makeSprite({ diameter, fill, rim }, heading, place) {
  const radius = diameter / 2;
  const inner = radius - Math.max(0.9, 0.13 * diameter);
  const tip = diameter >= NOSE_FROM ? 1.25 * radius : 0;
  const angle = (2 * Math.PI * heading) / HEADINGS;
  const cos = Math.cos(angle);
  const sin = Math.sin(angle);
  const half = Math.ceil(1.25 * radius) + 1;
  const middleX = ((place % PLACES) + 0.5) / PLACES;
  const middleY = (Math.floor(place / PLACES) + 0.5) / PLACES;
  const found = [];
  for (let row = -half; row <= half; row++)
    for (let column = -half; column <= half; column++) {
      let covered = 0;
      let red = 0;
      let green = 0;
      let blue = 0;
      for (let i = 0; i < SAMPLES * SAMPLES; i++) {
        const x = column + ((i % SAMPLES) + 0.5) / SAMPLES - middleX;
        const y = middleY - row - (Math.floor(i / SAMPLES) + 0.5) / SAMPLES;
        const along = x * cos + y * sin;
        const across = Math.abs(y * cos - x * sin);
        const inNose = along > 0.25 * radius && along < tip && across < 0.36 * (tip - along) + 0.1 * radius;
        const distance = Math.sqrt(x * x + y * y);
        if (distance > radius && !inNose) continue;
        const colour = inNose ? NOSE : distance > inner ? rim : fill;
        covered++;
        red += (colour >> 16) & 255;
        green += (colour >> 8) & 255;
        blue += colour & 255;
      }
      if (covered === 0) continue;
      const mean = (0xff << 24) | (Math.round(blue / covered) << 16) | (Math.round(green / covered) << 8) | Math.round(red / covered);
      found.push({ column, row, mean, opacity: Math.round((256 * covered) / (SAMPLES * SAMPLES)) });
    }
  return {
    half,
    count: found.length,
    dx: Int8Array.from(found, ({ column }) => column),
    dy: Int8Array.from(found, ({ row }) => row),
    colours: Int32Array.from(found, ({ mean }) => mean),
    opacity: Uint16Array.from(found, ({ opacity }) => opacity),
  };
}
