// The static content seen from above: floor, grid, patches, holes, terrain, walls, lights. It is drawn again only if
// the view moves or a colour changes.
import { css, gridStep, isBoundaryWall, paint, palette } from "../look.js";
import { floorPicture } from "../floor_picture.js";
import { fillBody, terrainPicture } from "./bodies.js";

export class Backdrop {
  constructor() {
    this.canvas = document.createElement("canvas");
    // Its pixels are read when robots are dots.
    this.context = this.canvas.getContext("2d", { alpha: false, willReadFrequently: true });
    this.stale = true;
  }

  setWorld(world) {
    this.world = world;
    this.stale = true;
    this.terrains = new Map();
    this.pictures = new Map(); // entity to { tint, canvas }
    this.colours = new Map(); // entity to [colour, intensity]
    const still = world.bodies.filter((body) => world.slots[body.entity] < 0);
    const flat = (body) => ["patch", "hole", "terrain"].includes(world.look(body.entity).role);
    this.flat = still.filter(flat);
    const top = (body) => body.position[2] + body.size[2] / 2;
    this.solid = still.filter((body) => !flat(body)).sort((a, b) => top(a) - top(b));
  }

  paint({ entities, colours, intensities }) {
    entities.forEach((entity, i) => this.colours.set(entity, [colours[i], intensities[i]]));
    this.stale = true;
  }

  colourOf(body) {
    return this.colours.get(body.entity) ?? [body.colour, 1];
  }

  // `frame`: the transformation of the plan (camera.js). `heat`: a picture of the arena's size on its floor, or null.
  update(frame, theme, heat) {
    const key = `${frame.key} ${theme.floor}`;
    if (!this.stale && key === this.key) return;
    this.stale = false;
    this.key = key;
    const { canvas, context } = this;
    if (canvas.width !== frame.width || canvas.height !== frame.height) [canvas.width, canvas.height] = [frame.width, frame.height];
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = css(theme.background);
    context.fillRect(0, 0, canvas.width, canvas.height);
    this.drawFloor(frame, theme);
    for (const body of this.flat) this.drawFlat(frame, body);
    if (heat) {
      const [width, depth] = this.world.arena;
      context.setTransform(1, 0, 0, -1, frame.x(0), frame.y(0));
      context.drawImage(heat, 0, 0, width * frame.scale, depth * frame.scale);
      context.setTransform(1, 0, 0, 1, 0, 0);
    }
    const still = (body) => ({ position: body.position, orientation: body.orientation });
    for (const body of this.solid) {
      // The shadow of a wall around the arena would hide robots inside.
      const casts = !isBoundaryWall(body, this.world.arena);
      fillBody(context, frame, this.world.look(body.entity), body, still(body), ...this.colourOf(body), casts);
    }
    this.pixels = null;
  }

  // Returns the whole picture as 32-bit numbers.
  read() {
    const { canvas, context } = this;
    this.pixels ??= new Uint32Array(context.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
    return this.pixels;
  }

  drawFloor(frame, theme) {
    const { context } = this;
    const [width, depth] = this.world.arena;
    const [left, top, right, bottom] = [frame.x(0), frame.y(depth), frame.x(width), frame.y(0)].map(Math.round);
    context.fillStyle = css(theme.floor);
    context.fillRect(left, top, right - left, bottom - top);
    const step = gridStep(Math.max(width, depth));
    const line = Math.max(1, Math.round(frame.ratio));
    context.fillStyle = css(theme.line);
    if (step * frame.scale > 5 * frame.ratio) {
      for (let i = 1; i * step < width; i++) context.fillRect(Math.round(frame.x(i * step)), top, line, bottom - top);
      for (let i = 1; i * step < depth; i++) context.fillRect(left, Math.round(frame.y(i * step)), right - left, line);
    }
    context.strokeStyle = css(theme.rim);
    context.lineWidth = line;
    context.strokeRect(left, top, right - left, bottom - top);
  }

  drawFlat(frame, body) {
    const { role } = this.world.look(body.entity);
    const { context } = this;
    if (role === "terrain") return this.drawTerrain(frame, body);
    const [x, y] = body.size;
    context.setTransform(...frame.standing(body));
    if (body.picture) {
      context.imageSmoothingEnabled = false;
      context.scale(1, -1); // the first row has the highest y
      context.drawImage(this.pictureOf(body), -x / 2, -y / 2, x, y);
      context.setTransform(1, 0, 0, 1, 0, 0);
      return;
    }
    context.beginPath();
    if (y === 0) context.arc(0, 0, x, 0, 2 * Math.PI);
    else context.rect(-x / 2, -y / 2, x, y);
    context.fillStyle = css(role === "hole" ? palette.hole : paint(this.colourOf(body)[0]));
    context.fill();
    context.setTransform(1, 0, 0, 1, 0, 0);
  }

  pictureOf(body) {
    const [tint] = this.colourOf(body);
    const made = this.pictures.get(body.entity);
    if (made?.tint === tint) return made.canvas;
    const canvas = floorPicture(body.picture, tint);
    this.pictures.set(body.entity, { tint, canvas });
    return canvas;
  }

  drawTerrain(frame, body) {
    const { context } = this;
    const { low, high } = body.terrain;
    if (!this.terrains.has(body.entity)) this.terrains.set(body.entity, terrainPicture(body.terrain));
    context.setTransform(...frame.standing(body)); // the first row has the lowest y, and y points up
    context.drawImage(this.terrains.get(body.entity), low[0], low[1], high[0] - low[0], high[1] - low[1]);
    context.setTransform(1, 0, 0, 1, 0, 0);
  }
}
