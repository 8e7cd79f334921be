// A heat map of the robots' positions: seconds in each cell of a grid over the arena, as a picture.
import { Flag } from "../protocol.js";
import { rampColour } from "./robot_values.js";

const MOST_CELLS = 96; // along the longer side
const LEAST_CELL_M = 0.08; // about half a footbot
const FULL = 0.85; // opacity of the cell with the largest value
const PICTURE_EVERY_S = 0.5; // simulated time

export class HeatMap {
  constructor(world) {
    this.world = world;
    const [width, depth] = world.arena;
    const cell = Math.max(Math.max(width, depth) / MOST_CELLS, LEAST_CELL_M);
    this.columns = Math.max(1, Math.round(width / cell));
    this.rows = Math.max(1, Math.round(depth / cell));
    this.cellSize = width / this.columns; // m
    this.seconds = new Float64Array(this.columns * this.rows);
    this.time = null;
    this.pictureTime = -Infinity;
  }

  // Returns true if the picture has changed.
  add(frame) {
    if (!this.count(frame)) return false;
    if (frame.time - this.pictureTime < PICTURE_EVERY_S && frame.time > this.pictureTime) return false;
    this.pictureTime = frame.time;
    this.draw();
    return true;
  }

  // Adds the time since the frame before. Returns false if there is none.
  count(frame) {
    if (this.time === null || frame.time < this.time) {
      this.time = frame.time;
      return false;
    }
    const elapsed = frame.time - this.time;
    if (elapsed === 0) return false;
    this.time = frame.time;
    for (const entity of this.world.robots) {
      const slot = this.world.slots[entity];
      if (frame.colours[4 * slot + 3] & Flag.absent) continue;
      const column = Math.floor((frame.positions[3 * slot] / this.world.arena[0]) * this.columns);
      const row = Math.floor((frame.positions[3 * slot + 1] / this.world.arena[1]) * this.rows);
      if (column >= 0 && row >= 0 && column < this.columns && row < this.rows) this.seconds[row * this.columns + column] += elapsed;
    }
    return true;
  }

  get most() {
    return this.seconds.reduce((most, value) => Math.max(most, value), 0);
  }

  // Draws the picture, whose row 0 has the lowest y.
  draw() {
    this.canvas ??= Object.assign(document.createElement("canvas"), { width: this.columns, height: this.rows });
    const context = this.canvas.getContext("2d");
    const image = context.createImageData(this.columns, this.rows);
    const most = Math.max(this.most, 1e-9);
    this.seconds.forEach((value, i) => {
      if (value === 0) return;
      const share = Math.sqrt(value / most); // the root makes rare visits visible
      image.data.set([...rampColour(share), 255 * FULL * (0.35 + 0.65 * share)], 4 * i);
    });
    context.putImageData(image, 0, 0);
  }
}
