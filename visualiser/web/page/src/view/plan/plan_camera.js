// The camera of the plan, and the pointers that move it: drag, wheel, two fingers.

const WHEEL_STEP = 1.2; // for 100 pixels of the wheel
const KEY_PIXELS = 60;
const LEAST_SPAN_M = 0.3; // from top to bottom
const MOST_SCALE = 2500; // pixels a metre
const MARGIN = 0.06; // part of the picture around the arena

// The transformation from metres to pixels of the canvas.
class Frame {
  constructor(width, height, ratio, centre, scale) {
    Object.assign(this, { width, height, ratio, scale });
    this.left = width / 2 - centre[0] * scale;
    this.bottom = height / 2 + centre[1] * scale;
    this.key = `${width} ${height} ${this.left} ${this.bottom} ${scale}`;
  }
  x(metres) {
    return this.left + metres * this.scale;
  }
  y(metres) {
    return this.bottom - metres * this.scale;
  }
  metresX(pixels) {
    return (pixels - this.left) / this.scale;
  }
  metresY(pixels) {
    return (this.bottom - pixels) / this.scale;
  }
  // Returns the arguments of setTransform for an upright body in metres, with y to its left.
  standing({ position, orientation: [, , z, w] }) {
    const yaw = 2 * Math.atan2(z, w);
    const [cos, sin] = [this.scale * Math.cos(yaw), this.scale * Math.sin(yaw)];
    return [cos, -sin, -sin, -cos, this.x(position[0]), this.y(position[1])];
  }
}

export class PlanCamera {
  // `onChange`: called when the camera has moved.
  constructor(canvas, onChange) {
    this.canvas = canvas;
    this.onChange = onChange;
    this.centre = [0, 0];
    this.height = 0; // height of the target, kept for other views
    this.span = 10; // m from top to bottom
    this.direction = null; // direction of the eye in three dimensions, kept for that view
    this.home = null;
    this.enabled = true;
    this.held = false;
    this.fingers = new Map();
    this.listen();
  }

  resize(width, height, ratio) {
    Object.assign(this, { width, pixels: height, ratio });
    if (this.home) this.frameArena(this.home);
    this.change();
  }

  setArena(arena) {
    this.arena = arena;
    this.mostSpan = 8 * Math.max(arena[0], arena[1], 1);
  }

  change() {
    this.kept = null;
    this.onChange();
  }

  get frame() {
    this.kept ??= new Frame(Math.round(this.width * this.ratio), Math.round(this.pixels * this.ratio), this.ratio, this.centre, this.scale);
    return this.kept;
  }
  // Returns the pixels of the canvas a metre.
  get scale() {
    return (this.pixels * this.ratio) / this.span;
  }

  setSpan(span) {
    const least = Math.max(LEAST_SPAN_M, this.pixels / MOST_SCALE);
    this.span = Math.max(least, Math.min(span, this.mostSpan ?? Infinity));
  }

  frameArena(how) {
    if (!this.arena) return;
    const [width, depth] = this.arena;
    this.home = how;
    this.direction = null;
    this.height = 0;
    this.centre = [width / 2, depth / 2];
    this.span = Math.max(depth, (width * this.pixels) / this.width) / (1 - 2 * MARGIN);
    this.change();
  }

  look(x, y, span) {
    this.home = null;
    this.centre = [x, y];
    this.setSpan(span);
    this.change();
  }

  shift(dx, dy) {
    this.look(this.centre[0] + dx, this.centre[1] + dy, this.span);
  }

  // Handles arrow keys: steps to the right and up.
  step(right, up) {
    const metres = (KEY_PIXELS * this.ratio) / this.scale;
    this.shift(right * metres, up * metres);
  }

  // Zooms and keeps the point at a place of the canvas (CSS pixels) fixed.
  zoom(steps, at = { x: this.width / 2, y: this.pixels / 2 }) {
    const before = [this.frame.metresX(at.x * this.ratio), this.frame.metresY(at.y * this.ratio)];
    this.setSpan(this.span * WHEEL_STEP ** -steps);
    this.kept = null;
    const after = [this.frame.metresX(at.x * this.ratio), this.frame.metresY(at.y * this.ratio)];
    this.shift(before[0] - after[0], before[1] - after[1]);
  }

  get viewpoint() {
    return { target: [...this.centre, this.height], span: this.span, direction: this.direction };
  }
  set viewpoint({ target: [x, y, z], span, direction }) {
    this.height = z;
    this.direction = direction;
    this.look(x, y, span);
  }

  listen() {
    const { canvas, fingers } = this;
    const at = (event) => ({ x: event.offsetX, y: event.offsetY });
    canvas.addEventListener("pointerdown", (event) => {
      if (!this.enabled) return;
      fingers.set(event.pointerId, at(event));
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = fingers.get(event.pointerId);
      if (!before || this.held || !this.enabled) return;
      const now = at(event);
      const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
      const metres = this.ratio / this.scale;
      const share = other ? 0.5 : 1; // each of two fingers moves it by half
      this.shift(-(now.x - before.x) * metres * share, (now.y - before.y) * metres * share);
      if (other) {
        const [was, is] = [before, now].map((finger) => Math.max(10, Math.hypot(finger.x - other.x, finger.y - other.y)));
        this.zoom(Math.log(is / was) / Math.log(WHEEL_STEP), { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 });
      }
      fingers.set(event.pointerId, now);
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        const lines = event.deltaMode === 1 ? 33 : 1;
        this.zoom((-event.deltaY * lines) / 100, at(event));
      },
      { passive: false },
    );
  }
}
