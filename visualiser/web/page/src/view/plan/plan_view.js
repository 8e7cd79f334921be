// The plan: the experiment from above, on a canvas without a graphics card. It starts without loading other code, and
// draws ten thousand robots in the time in which the view in three dimensions draws ten without a graphics card.
import { h } from "../../ui/dom.js";
import { Flag } from "../../protocol.js";
import { GRIP, css, extentOf, themes } from "../look.js";
import { Backdrop } from "./backdrop.js";
import { PlanCamera } from "./plan_camera.js";
import { PlanSwarm } from "./plan_swarm.js";
import { TrailLayer } from "./trail_layer.js";
import { viewOf } from "../viewpoints.js";

const MOST_RATIO = 2; // the most drawn pixels for a pixel of the page
const PICK_PIXELS = 6; // pixels by which a click may miss
const BEAM_SPOT_M = 0.055;

export class PlanView {
  // `picture`: the content that all views show.
  constructor(container, picture) {
    this.container = container;
    this.picture = picture;
    this.canvas = h("canvas.picture.plan", { role: "img", "aria-label": "The experiment from above" });
    container.prepend(this.canvas);
    // The canvas is in memory, not on a graphics card. Dots are written there, and a slow driver is never involved.
    this.context = this.canvas.getContext("2d", { alpha: false, willReadFrequently: true });
    this.backdrop = new Backdrop();
    this.trails = new TrailLayer();
    this.camera = new PlanCamera(this.canvas, () => this.invalidate());
    this.stale = true;
    const dark = window.matchMedia("(prefers-color-scheme: dark)");
    const applyTheme = () => {
      this.dark = dark.matches;
      this.theme = dark.matches ? themes.dark : themes.light;
      this.clear();
      this.invalidate();
    };
    dark.addEventListener("change", applyTheme);
    applyTheme();
    new ResizeObserver(() => this.resize()).observe(container);
    this.resize();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.container;
    if (width === 0 || height === 0) return;
    const ratio = Math.min(window.devicePixelRatio || 1, MOST_RATIO);
    [this.canvas.width, this.canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    [this.canvas.style.width, this.canvas.style.height] = [`${width}px`, `${height}px`];
    this.camera.resize(width, height, ratio);
    this.pixels = null;
    this.clear();
    this.invalidate();
  }

  // Fills the canvas, which is black at first. It stays so while there is no run to be drawn.
  clear() {
    this.context.fillStyle = css(this.theme.background);
    this.context.fillRect(0, 0, this.canvas.width, this.canvas.height);
  }

  setWorld(world) {
    this.world = world;
    this.backdrop.setWorld(world);
    this.swarm = new PlanSwarm(world);
    this.camera.setArena(world.arena);
    this.invalidate();
  }

  paint(colours) {
    this.backdrop.paint(colours);
    this.invalidate();
  }

  applyShows() {
    this.backdrop.stale = true;
    this.invalidate();
  }

  // Handles another picture of the heat map.
  updateHeat() {
    this.backdrop.stale = true;
    this.invalidate();
  }

  addFrame(frame) {
    this.swarm.addFrame(frame);
  }

  invalidate() {
    this.stale = true;
  }

  // Returns false if nothing has changed. `moved`: whether robots have moved since the last picture.
  draw(moved) {
    if (!moved && !this.stale) return false;
    this.stale = false;
    const { context, swarm, picture } = this;
    const { motion, shows } = picture;
    const frame = this.camera.frame;
    this.backdrop.update(frame, this.theme, picture.heat?.canvas ?? null);
    this.drawGround(frame, motion);
    if (this.trails.update(frame, picture.trails)) context.drawImage(this.trails.canvas, 0, 0);
    swarm.drawThings(context, frame, motion, this.backdrop.colours);
    swarm.drawSprites(context, frame, motion);
    if (shows.beams && motion.frame) {
      this.drawGrips(frame, motion);
      this.drawBeams(frame, motion);
    }
    for (const lines of picture.marks.lines(this.theme)) this.drawLines(frame, lines);
    if (picture.shownDrawing) this.drawDrawing(frame, picture.shownDrawing);
    return true;
  }

  // Draws drawings of experiment functions from above: areas, then lines, then points.
  drawDrawing(frame, { triangles, lines, dots }) {
    const { context } = this;
    for (const { colour, opacity, points } of triangles) {
      context.globalAlpha = opacity;
      context.fillStyle = css(colour);
      context.beginPath();
      for (let i = 0; i < points.length; i += 9) {
        context.moveTo(frame.x(points[i]), frame.y(points[i + 1]));
        context.lineTo(frame.x(points[i + 3]), frame.y(points[i + 4]));
        context.lineTo(frame.x(points[i + 6]), frame.y(points[i + 7]));
        context.closePath();
      }
      context.fill();
    }
    for (const { colour, opacity, points, width } of lines) this.drawLines(frame, { colour, points, opacity, width });
    for (const { colour, opacity, points, width } of dots) {
      context.globalAlpha = opacity;
      context.fillStyle = css(colour);
      context.beginPath();
      for (let i = 0; i < points.length; i += 3) {
        const [x, y] = [frame.x(points[i]), frame.y(points[i + 1])];
        context.moveTo(x, y);
        context.arc(x, y, (width / 2) * frame.ratio, 0, 2 * Math.PI);
      }
      context.fill();
    }
    context.globalAlpha = 1;
  }

  // Draws the static content, and the robots that are dots.
  drawGround(frame, motion) {
    const { context, swarm, backdrop } = this;
    swarm.drawn = { dots: 0, sprites: 0 };
    if (!motion.frame || !swarm.herds.some((herd) => swarm.isDots(herd, frame))) {
      context.drawImage(backdrop.canvas, 0, 0);
      return;
    }
    if (!this.pixels || this.pixels.width !== frame.width || this.pixels.height !== frame.height) {
      this.pixels = context.createImageData(frame.width, frame.height);
      this.words = new Uint32Array(this.pixels.data.buffer);
    }
    this.words.set(backdrop.read());
    swarm.writeDots(this.words, frame, motion, this.dark);
    context.putImageData(this.pixels, 0, 0);
  }

  drawGrips(frame, motion) {
    const { context, world, picture } = this;
    context.strokeStyle = css(GRIP);
    context.lineWidth = 3 * frame.ratio;
    context.lineCap = "round";
    context.beginPath();
    for (const { robot, held } of motion.frame.grips) {
      const [from, to] = [robot, held].map((entity) => picture.placeOf(entity));
      if (!from || !to) continue;
      context.moveTo(frame.x(from[0]), frame.y(from[1]));
      context.lineTo(frame.x(to[0]), frame.y(to[1]));
    }
    // From above, a rope to the ceiling is a point, shown by a ring.
    for (const { slots, radius } of this.swarm.herds)
      for (const slot of slots) {
        if (!(motion.colours[4 * slot + 3] & Flag.attached) || !motion.isPresent(slot)) continue;
        const [x, y] = [frame.x(motion.positions[3 * slot]), frame.y(motion.positions[3 * slot + 1])];
        const reach = Math.max(0.25 * radius * frame.scale, 3 * frame.ratio);
        context.moveTo(x + reach, y);
        context.arc(x, y, reach, 0, 2 * Math.PI);
      }
    context.stroke();
    context.lineCap = "butt";
  }

  drawBeams(frame, motion) {
    const { context, world } = this;
    for (const { entity, x, y, colour } of motion.frame.beams) {
      const slot = world.slots[entity];
      const [x0, y0, x1, y1] = [frame.x(motion.positions[3 * slot]), frame.y(motion.positions[3 * slot + 1]), frame.x(x), frame.y(y)];
      context.strokeStyle = context.fillStyle = css(colour);
      context.globalAlpha = 0.6;
      context.lineWidth = Math.max(0.012 * frame.scale, 1.5 * frame.ratio);
      context.beginPath();
      context.moveTo(x0, y0);
      context.lineTo(x1, y1);
      context.stroke();
      context.globalAlpha = 0.9;
      context.beginPath();
      context.arc(x1, y1, Math.max(BEAM_SPOT_M * frame.scale, 3 * frame.ratio), 0, 2 * Math.PI);
      context.fill();
    }
    context.globalAlpha = 1;
  }

  drawLines(frame, { colour, points, opacity = 1, width = 1.25 }) {
    const { context } = this;
    context.globalAlpha = opacity;
    context.strokeStyle = css(colour);
    context.lineWidth = width * frame.ratio;
    context.beginPath();
    for (let i = 0; i < points.length; i += 6) {
      context.moveTo(frame.x(points[i]), frame.y(points[i + 1]));
      context.lineTo(frame.x(points[i + 3]), frame.y(points[i + 4]));
    }
    context.stroke();
    context.globalAlpha = 1;
  }

  // ---- what every view can do ----

  show(on) {
    this.canvas.hidden = !on;
    this.camera.enabled = on;
    if (on) this.resize();
  }
  holdCamera(on) {
    this.camera.held = on;
  }
  get home() {
    return this.camera.home;
  }
  frameArena(how) {
    this.camera.frameArena(how);
  }
  get viewpoint() {
    return this.camera.viewpoint;
  }
  set viewpoint(viewpoint) {
    this.camera.viewpoint = viewpoint;
  }
  get eye() {
    const { target, span } = this.camera.viewpoint;
    return [target[0], target[1], span];
  }
  // `camera`: as in viewpoints.js. The plan shows the point that it looks at.
  stand(camera) {
    this.viewpoint = viewOf(camera, Math.max(...this.world.arena.slice(0, 2)));
  }
  shift(dx, dy) {
    this.camera.shift(dx, dy);
  }
  step(right, up) {
    this.camera.step(right, up);
  }
  zoom(steps) {
    this.camera.zoom(steps);
  }
  approach(entity, [x, y]) {
    this.camera.look(x, y, Math.max(9 * extentOf(this.world, entity).radius, 1));
  }

  // Returns the CSS pixels of the canvas. `depth` is smaller for points nearer to the eye.
  project(x, y, z) {
    const frame = this.camera.frame;
    return { x: frame.x(x) / frame.ratio, y: frame.y(y) / frame.ratio, depth: -z };
  }
  pixelsPerMetre() {
    return this.camera.frame.scale / this.camera.frame.ratio;
  }
  floorPoint({ x, y }, height) {
    const frame = this.camera.frame;
    return [frame.metresX(x * frame.ratio), frame.metresY(y * frame.ratio), height];
  }

  // Returns the ray of sight.
  sight(at) {
    const [x, y] = this.floorPoint(at, 0);
    return { origin: [x, y, 1e4], direction: [0, 0, -1] };
  }

  // Returns the entity whose outline is nearest to a place: robots before others, the highest of several.
  pick(at) {
    const { world, picture } = this;
    const [x, y] = this.floorPoint(at, 0);
    const slack = PICK_PIXELS / this.pixelsPerMetre();
    let best = null;
    let nearest = Infinity;
    for (const entity of world.movable) {
      const slot = world.slots[entity];
      if (!picture.motion.isPresent(slot)) continue;
      const { radius } = extentOf(world, entity);
      const away = Math.hypot(picture.motion.positions[3 * slot] - x, picture.motion.positions[3 * slot + 1] - y);
      if (away > radius + slack) continue;
      const score = Math.max(0, away - radius) / slack + (away / (radius + slack)) * 0.5 - 0.2 * picture.motion.positions[3 * slot + 2];
      if (score < nearest) [best, nearest] = [entity, score];
    }
    return best;
  }

  // Returns how much wider than they are robots are drawn, at most.
  get enlargement() {
    const { frame } = this.camera;
    return Math.max(1, ...this.swarm.herds.map((herd) => this.swarm.diameter(herd, frame) / (2 * herd.radius * frame.scale)));
  }

  get details() {
    return [{ robots: this.world.robots.length, drawn: [this.swarm.drawn.dots, this.swarm.drawn.sprites] }];
  }
}
