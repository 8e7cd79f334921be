// Draws over the picture in any view: rings around selected entities, names, handles, box and tape, and in a corner the
// scale and the axes.
import { h, setText } from "../ui/dom.js";
import { GRIP, SELECTION, css, extentOf } from "./look.js";

const RING_PIXELS = 7; // the least radius of the ring around a selected entity
const MOST_LABELS = 150;
const MOST_CONSIDERED = 400;
const LABEL_PX = 13; // height
const HANDLE_PX = 11;
const SCALE_PX = 110; // longest bar
const AXIS_PX = 22;
const LEAST_TOLD = 1.2; // how much larger than they are robots may be drawn without a note

export class Overlay {
  constructor(container, picture) {
    this.picture = picture;
    this.canvas = h("canvas.labels", { "aria-hidden": "true" });
    this.context = this.canvas.getContext("2d", { willReadFrequently: true }); // in memory, which starts quickly
    this.scaleText = h("span");
    this.scaleBar = h("div.scale-bar");
    this.axes = h("canvas.axes", { width: 64, height: 64, "aria-hidden": "true" });
    this.scaleNote = h("div.dim"); // robots that would be too small to be seen are drawn larger
    this.corner = h("div.scale", { role: "img" }, this.axes, h("div", {}, this.scaleNote, this.scaleText, this.scaleBar));
    this.corner.hidden = true;
    container.append(this.canvas, this.corner);
  }

  setWorld(world) {
    this.world = world;
    this.widths = new Map(); // widths of names, by entity
  }

  get view() {
    return this.picture.view;
  }

  draw() {
    const { picture, canvas, context } = this;
    this.drawScale();
    const texts = picture.shownDrawing?.texts ?? [];
    const empty = texts.length === 0 && !picture.shows.ids && picture.chosen.length === 0 && picture.ghosts.length === 0 && !picture.box && !picture.tape;
    canvas.hidden = empty;
    if (empty) return;
    const ratio = window.devicePixelRatio || 1;
    const { clientWidth: width, clientHeight: height } = canvas;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    this.style = getComputedStyle(canvas);
    [this.ink, this.edge] = [this.style.color, this.style.getPropertyValue("--label-edge")];
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    context.font = "11px system-ui, sans-serif";
    for (const entity of picture.chosen) this.drawRing(entity);
    for (const ghost of picture.ghosts) this.drawGhost(ghost);
    this.drawHandles();
    this.drawTexts(texts);
    this.drawLabels(width, height);
    if (picture.box) this.drawBox(picture.box);
    if (picture.tape) this.drawTape(picture.tape);
  }

  // Draws a circle on the floor; returns false if part of it is behind the eye.
  circle([x, y, z], radius, from = 0, to = 2 * Math.PI) {
    const { context } = this;
    context.beginPath();
    for (let i = 0; i <= 40; i++) {
      const angle = from + ((to - from) * i) / 40;
      const at = this.view.project(x + radius * Math.cos(angle), y + radius * Math.sin(angle), z);
      if (!at) return false;
      context.lineTo(at.x, at.y);
    }
    return true;
  }

  ringRadius(entity, place) {
    return Math.max(1.3 * extentOf(this.world, entity).radius, RING_PIXELS / this.view.pixelsPerMetre(...place));
  }

  drawRing(entity) {
    const place = this.picture.placeOf(entity);
    if (!place) return;
    const radius = this.ringRadius(entity, place);
    const main = entity === this.picture.selected;
    if (!this.circle(place, radius)) return;
    const { context } = this;
    context.lineWidth = main ? 5 : 3.5;
    context.strokeStyle = this.edge;
    context.stroke();
    context.lineWidth = main ? 2.5 : 1.5;
    context.strokeStyle = css(SELECTION);
    context.stroke();
    if (main && this.picture.canMove(entity)) this.drawArrow(place, this.picture.yawOf(entity), radius);
  }

  // Draws the heading as a wedge outside of the ring.
  drawArrow([x, y, z], yaw, radius) {
    const at = (angle, distance) => this.view.project(x + distance * Math.cos(yaw + angle), y + distance * Math.sin(yaw + angle), z);
    const corners = [at(0, 1.45 * radius), at(0.22, 1.08 * radius), at(-0.22, 1.08 * radius)];
    if (corners.some((corner) => !corner)) return;
    const { context } = this;
    context.beginPath();
    for (const corner of corners) context.lineTo(corner.x, corner.y);
    context.fillStyle = css(SELECTION);
    context.fill();
  }

  drawGhost({ entity, place, yaw }) {
    const radius = this.ringRadius(entity, place);
    if (!this.circle(place, radius)) return;
    const { context } = this;
    context.setLineDash([5, 4]);
    context.lineWidth = 2;
    context.strokeStyle = css(GRIP);
    context.stroke();
    context.setLineDash([]);
    this.drawArrow(place, yaw, radius);
  }

  // ---- handles ----

  // Returns the CSS pixels of the two handles of the selected entity; null without handles.
  get handles() {
    const { picture } = this;
    if (!picture.handles || picture.selected === null || !picture.canMove(picture.selected) || !picture.actions.mayMove()) return null;
    const place = picture.placeOf(picture.selected);
    if (!place) return null;
    const yaw = picture.yawOf(picture.selected);
    const reach = this.ringRadius(picture.selected, place) + 26 / this.view.pixelsPerMetre(...place);
    const [move, turn] = [this.view.project(...place), this.view.project(place[0] + reach * Math.cos(yaw), place[1] + reach * Math.sin(yaw), place[2])];
    return move && turn ? { move, turn } : null;
  }

  // Returns "move", "turn" or null.
  handleAt(at) {
    const handles = this.handles;
    if (!handles) return null;
    const near = (handle) => Math.hypot(handle.x - at.x, handle.y - at.y) <= HANDLE_PX;
    return near(handles.turn) ? "turn" : near(handles.move) ? "move" : null;
  }

  drawHandles() {
    const handles = this.handles;
    if (!handles) return;
    const { context } = this;
    context.lineWidth = 2;
    context.strokeStyle = css(SELECTION);
    context.beginPath();
    context.moveTo(handles.move.x, handles.move.y);
    context.lineTo(handles.turn.x, handles.turn.y);
    context.stroke();
    for (const { x, y } of [handles.move, handles.turn]) {
      context.beginPath();
      context.arc(x, y, 6, 0, 2 * Math.PI);
      context.fillStyle = "#ffffff";
      context.fill();
      context.stroke();
    }
  }

  // ---- texts of experiment functions ----

  drawTexts(texts) {
    const { context } = this;
    context.textAlign = "left";
    context.textBaseline = "alphabetic";
    context.lineWidth = 3;
    for (const { place, text, colour, opacity } of texts) {
      const at = this.view.project(...place);
      if (!at) continue;
      context.globalAlpha = opacity;
      context.fillStyle = css(colour);
      // Dark texts get a light rim and light texts a dark one, so that they are readable on any ground.
      context.strokeStyle = luminance(colour) < 128 ? "rgba(255, 255, 255, 0.6)" : "rgba(0, 0, 0, 0.6)";
      context.strokeText(text, at.x, at.y);
      context.fillText(text, at.x, at.y);
    }
    context.globalAlpha = 1;
  }

  // ---- names ----

  drawLabels(width, height) {
    const { picture, context } = this;
    const found = [];
    const chosen = new Set(picture.chosen);
    const consider = (entity) => {
      const place = picture.placeOf(entity);
      if (!place) return;
      const at = this.view.project(place[0], place[1], place[2] + extentOf(this.world, entity).height + 0.02);
      if (!at || at.x < 0 || at.y < 0 || at.x > width || at.y > height) return;
      if (picture.isPlan) at.y -= extentOf(this.world, entity).radius * this.view.pixelsPerMetre(...place) + 3;
      found.push({ entity, ...at, depth: chosen.has(entity) ? -1 : at.depth });
    };
    for (const entity of picture.shows.ids ? this.world.movable : chosen) consider(entity);
    found.sort((a, b) => a.depth - b.depth);
    context.textAlign = "center";
    context.textBaseline = "bottom";
    context.lineWidth = 3;
    context.strokeStyle = this.edge;
    const taken = [];
    for (const { entity, x, y } of found.slice(0, MOST_CONSIDERED)) {
      if (taken.length >= MOST_LABELS) break;
      const text = this.world.ids[entity];
      if (!this.widths.has(entity)) this.widths.set(entity, context.measureText(text).width);
      const half = this.widths.get(entity) / 2 + 2;
      if (taken.some((other) => Math.abs(other.y - y) < LABEL_PX && Math.abs(other.x - x) < half + other.half)) continue;
      taken.push({ entity, x, y, half });
      context.fillStyle = chosen.has(entity) ? this.style.getPropertyValue("--accent") : this.ink;
      context.strokeText(text, x, y);
      context.fillText(text, x, y);
    }
    this.labels = taken;
  }

  // ---- box and tape ----

  drawBox({ left, top, right, bottom }) {
    const { context } = this;
    context.fillStyle = "rgb(61 139 253 / 0.15)";
    context.strokeStyle = css(SELECTION);
    context.lineWidth = 1;
    context.fillRect(left, top, right - left, bottom - top);
    context.strokeRect(left + 0.5, top + 0.5, right - left, bottom - top);
  }

  drawTape({ from, to }) {
    const [a, b] = [from, to].map((point) => this.view.project(...point));
    if (!a || !b) return;
    const { context } = this;
    const metres = Math.hypot(to[0] - from[0], to[1] - from[1]);
    const degrees = (Math.atan2(to[1] - from[1], to[0] - from[0]) * 180) / Math.PI;
    for (const [colour, width] of [[this.edge, 4], [css(GRIP), 2]]) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.beginPath();
      context.moveTo(a.x, a.y);
      context.lineTo(b.x, b.y);
      context.stroke();
    }
    context.textAlign = "center";
    context.textBaseline = "bottom";
    context.lineWidth = 3;
    context.strokeStyle = this.edge;
    context.fillStyle = this.ink;
    const text = `${metres.toFixed(3)} m, ${degrees.toFixed(1)}°`;
    const [x, y] = [(a.x + b.x) / 2, (a.y + b.y) / 2 - 6];
    context.strokeText(text, x, y);
    context.fillText(text, x, y);
  }

  // ---- scale and axes ----

  drawScale() {
    const { target } = this.view.viewpoint;
    const pixels = this.view.pixelsPerMetre(...target);
    const directions = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => {
      const [from, to] = [target, target.map((value, k) => value + (0.1 * axis[k] * SCALE_PX) / pixels)].map((point) => this.view.project(...point));
      return from && to ? [to.x - from.x, to.y - from.y].map((value) => (value * 10) / SCALE_PX) : [0, 0];
    });
    const larger = this.view.enlargement;
    const key = JSON.stringify([pixels.toPrecision(4), larger.toPrecision(2), directions.flat().map((value) => value.toFixed(2)), this.view.dark]);
    if (key === this.scaleKey) return;
    this.scaleKey = key;
    const metres = scaleLength(SCALE_PX / pixels);
    const text = metres >= 1 ? `${metres} m` : `${Math.round(metres * 1000) / 10} cm`;
    const note = larger < LEAST_TOLD ? "" : `robots up to ${Number(larger.toPrecision(2))}× as wide`;
    setText(this.scaleText, text);
    setText(this.scaleNote, note);
    this.corner.setAttribute("aria-label", `Scale: the bar is ${text} long${note && `; ${note} as they are`}`);
    this.scaleBar.style.width = `${metres * pixels}px`;
    this.corner.hidden = false;
    this.drawAxes(directions);
  }

  drawAxes(directions) {
    const context = this.axes.getContext("2d", { willReadFrequently: true });
    context.clearRect(0, 0, 64, 64);
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineWidth = 2;
    const colours = ["#d9483b", "#2e9d5b", "#3d8bfd"];
    directions.forEach(([x, y], axis) => {
      context.strokeStyle = context.fillStyle = colours[axis];
      const length = Math.hypot(x, y);
      if (length < 0.12) return; // it points at the eye
      context.beginPath();
      context.moveTo(32, 32);
      context.lineTo(32 + AXIS_PX * x, 32 + AXIS_PX * y);
      context.stroke();
      context.fillText("xyz"[axis], 32 + (AXIS_PX * x * (length + 0.35)) / length, 32 + (AXIS_PX * y * (length + 0.35)) / length);
    });
  }
}

// Returns 0 to 255 for 0xRRGGBB.
const luminance = (colour) => 0.299 * (colour >> 16) + 0.587 * ((colour >> 8) & 255) + 0.114 * (colour & 255);

// Returns the longest round length (1, 2 or 5 and zeros) that is at most `most`.
export function scaleLength(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  return Number((power * [5, 2, 1].find((factor) => factor * power <= most)).toPrecision(1));
}
