// Bodies other than robots, seen from above: boxes as the outline of their corners, with a shadow that shows their
// height.
import { css, paint } from "../look.js";
import { rotate } from "../turning.js";

const SHADOW_LEAST_M = 0.02;
const SHADOW_MOST_M = 0.6; // taller bodies throw no longer shadows
const SUN = [0.3, 0.4]; // metres of shadow a metre of height, towards +x and +y, as in three dimensions
const TERRAIN_LOW = [0x6d, 0x6a, 0x5c];
const TERRAIN_HIGH = [0xc6, 0xbb, 0xa2];

// Returns the offset in pixels of the shadow of a point at a height above the floor.
export function shadowOf(frame, height) {
  const reach = Math.min(height, SHADOW_MOST_M) * frame.scale;
  return [SUN[0] * reach, -SUN[1] * reach];
}

// Returns the outline of points, by Andrew's monotone chain.
export function outline(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list) => {
    const chain = [];
    for (const point of list) {
      while (chain.length > 1) {
        const [a, b] = chain.slice(-2);
        if ((b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]) > 0) break;
        chain.pop();
      }
      chain.push(point);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

// Returns the corners of a body in metres, and the height of its top.
function cornersOf({ form, based }, [sx, sy, sz], { position, orientation }) {
  const corners = [];
  const low = based || form === "cylinder" ? 0 : -sz / 2;
  let top = -Infinity;
  const add = (x, y, z) => {
    const [rx, ry, rz] = rotate([x, y, z], orientation);
    corners.push([position[0] + rx, position[1] + ry]);
    top = Math.max(top, position[2] + rz);
  };
  for (const z of [low, low + sz]) {
    if (form === "cylinder") for (let i = 0; i < 24; i++) add(sx * Math.cos((i * Math.PI) / 12), sx * Math.sin((i * Math.PI) / 12), z);
    else for (const x of [-sx / 2, sx / 2]) for (const y of [-sy / 2, sy / 2]) add(x, y, z);
  }
  return { corners: outline(corners), top };
}

function trace(context, frame, corners, [dx, dy] = [0, 0]) {
  context.beginPath();
  for (const [x, y] of corners) context.lineTo(frame.x(x) + dx, frame.y(y) + dy);
  context.closePath();
}

const darker = (colour) => css(((colour >> 1) & 0x7f7f7f) + ((colour >> 2) & 0x3f3f3f));

// `pose`: {position, orientation}; `colour`: as in the file; `casts`: whether it throws a shadow.
export function fillBody(context, frame, look, body, pose, colour, intensity, casts = true) {
  const kind = look.form === "none" ? look.role : look.form;
  if (kind === "light") return drawLight(context, frame, pose.position, colour, intensity);
  if (kind === "sound") return drawSound(context, frame, pose.position, colour);
  if (kind !== "box" && kind !== "cylinder") return;
  const { corners, top } = cornersOf(look, body.size, pose);
  const painted = paint(colour);
  if (casts && top > SHADOW_LEAST_M) {
    trace(context, frame, corners, shadowOf(frame, top));
    context.fillStyle = "rgb(0 0 0 / 0.16)";
    context.fill();
  }
  trace(context, frame, corners);
  context.fillStyle = css(painted);
  context.fill();
  context.strokeStyle = darker(painted);
  context.lineWidth = frame.ratio;
  context.stroke();
}

function drawLight(context, frame, [px, py], colour, intensity) {
  const [x, y] = [frame.x(px), frame.y(py)];
  const reach = Math.max(0.25 * frame.scale, 10 * frame.ratio);
  const gradient = context.createRadialGradient(x, y, 0, x, y, reach);
  gradient.addColorStop(0, `${css(colour)}c0`);
  gradient.addColorStop(1, `${css(colour)}00`);
  if (intensity > 0) {
    context.fillStyle = gradient;
    context.fillRect(x - reach, y - reach, 2 * reach, 2 * reach);
  }
  context.beginPath();
  context.arc(x, y, Math.max(0.06 * frame.scale, 3 * frame.ratio), 0, 2 * Math.PI);
  context.fillStyle = intensity > 0 ? css(colour) : darker(colour);
  context.fill();
  context.lineWidth = frame.ratio;
  context.strokeStyle = "rgb(0 0 0 / 0.35)";
  context.stroke();
}

function drawSound(context, frame, [px, py], colour) {
  const [x, y] = [frame.x(px), frame.y(py)];
  context.strokeStyle = context.fillStyle = css(colour);
  context.lineWidth = 1.5 * frame.ratio;
  for (const radius of [0.06, 0.12, 0.18]) {
    context.beginPath();
    context.arc(x, y, Math.max(radius * frame.scale, 50 * radius * frame.ratio), 0, 2 * Math.PI);
    if (radius < 0.1) context.fill();
    else context.stroke();
  }
}

// Returns a terrain as a picture of one pixel a cell: light at high ground, shaded by the sun. Row 0 has the lowest y.
export function terrainPicture({ low, high, columns, rows, heights }) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [columns, rows];
  const context = canvas.getContext("2d");
  const image = context.createImageData(columns, rows);
  const [cellX, cellY] = [(high[0] - low[0]) / columns, (high[1] - low[1]) / rows];
  const at = (column, row, otherwise) => heights[row * columns + column] ?? otherwise;
  for (let row = 0; row < rows; row++)
    for (let column = 0; column < columns; column++) {
      const height = heights[row * columns + column];
      if (height === null) continue; // no ground
      const slope = (dx, dy, cell) => {
        const [c0, c1] = [Math.max(column - dx, 0), Math.min(column + dx, columns - 1)];
        const [r0, r1] = [Math.max(row - dy, 0), Math.min(row + dy, rows - 1)];
        return (at(c1, r1, height) - at(c0, r0, height)) / (cell * Math.max(c1 - c0 + r1 - r0, 1));
      };
      const [gx, gy] = [slope(1, 0, cellX), slope(0, 1, cellY)];
      const light = (1 + 0.45 * gx + 0.6 * gy) / Math.hypot(1, gx, gy);
      const share = (height - low[2]) / Math.max(high[2] - low[2], 1e-6);
      const place = 4 * (row * columns + column);
      for (let k = 0; k < 3; k++) {
        const colour = TERRAIN_LOW[k] + share * (TERRAIN_HIGH[k] - TERRAIN_LOW[k]);
        image.data[place + k] = Math.max(0, Math.min(255, colour * (0.35 + 0.65 * light)));
      }
      image.data[place + 3] = 255;
    }
  context.putImageData(image, 0, 0);
  return canvas;
}
