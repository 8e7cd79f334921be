// A value over simulated time on a canvas of its own: axes that fit, the last value beside it.
import { h, setText } from "./dom.js";

const WINDOW_S = 60;
const MOST_POINTS = 4000;

function niceStep(range, parts) {
  const rough = range / parts;
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= rough);
}

function numberText(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size >= 1e5 || size < 1e-3 ? value.toExponential(1) : String(Number(value.toPrecision(3)));
}

export class Plot {
  constructor(title, unit, onClose) {
    this.times = [];
    this.values = [];
    this.value = h("span.number");
    this.canvas = h("canvas");
    this.element = h(
      "div.plot",
      {},
      h("div.plot-head", {}, h("span", {}, title), this.value, h("button.close", { title: "Close the plot", "aria-label": "Close", onclick: onClose }, "×")),
      this.canvas,
    );
    this.unit = unit;
  }

  add(time, value) {
    const last = this.times.at(-1);
    if (last !== undefined && time < last) this.times.length = this.values.length = 0;
    if (time === last || !Number.isFinite(value)) return;
    this.times.push(time);
    this.values.push(value);
    let drop = 0;
    while (this.times[drop] < time - WINDOW_S || this.times.length - drop > MOST_POINTS) drop++;
    if (drop > 64) {
      this.times.splice(0, drop);
      this.values.splice(0, drop);
    }
    this.stale = true;
  }

  draw() {
    const { canvas } = this;
    const ratio = window.devicePixelRatio || 1;
    const { clientWidth: width, clientHeight: height } = canvas;
    if (!this.stale || width === 0) return;
    this.stale = false;
    if (canvas.width !== Math.round(width * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    if (this.times.length === 0) return;

    const style = getComputedStyle(canvas);
    const end = this.times.at(-1);
    const start = Math.max(this.times[0], end - WINDOW_S);
    const first = this.times.findIndex((time) => time >= start);
    let low = Infinity;
    let high = -Infinity;
    for (let i = first; i < this.values.length; i++) {
      low = Math.min(low, this.values[i]);
      high = Math.max(high, this.values[i]);
    }
    if (high - low < 1e-9) [low, high] = [low - Math.max(0.5, Math.abs(low) * 0.1), high + Math.max(0.5, Math.abs(high) * 0.1)];
    const step = niceStep(high - low, 2.5);
    [low, high] = [Math.floor(low / step) * step, Math.ceil(high / step) * step];

    const box = { left: 38, right: width - 4, top: 5, bottom: height - 14 };
    const x = (time) => box.left + ((time - start) / Math.max(end - start, 1e-9)) * (box.right - box.left);
    const y = (value) => box.bottom - ((value - low) / (high - low)) * (box.bottom - box.top);
    context.font = "10px system-ui, sans-serif";
    context.fillStyle = style.getPropertyValue("--dim");
    context.strokeStyle = style.getPropertyValue("--line");
    context.lineWidth = 1;
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (let value = low; value <= high + step / 2; value += step) {
      context.beginPath();
      context.moveTo(box.left, Math.round(y(value)) + 0.5);
      context.lineTo(box.right, Math.round(y(value)) + 0.5);
      context.stroke();
      context.fillText(numberText(Number(value.toPrecision(12))), box.left - 5, y(value));
    }
    context.textBaseline = "alphabetic";
    context.fillText(`${end.toFixed(1)} s`, box.right, height - 2);
    context.textAlign = "left";
    context.fillText(`${start.toFixed(1)} s`, box.left, height - 2);

    context.strokeStyle = style.getPropertyValue("--accent");
    context.lineWidth = 1.5;
    context.lineJoin = "round";
    context.beginPath();
    for (let i = first; i < this.values.length; i++) context.lineTo(x(this.times[i]), y(this.values[i]));
    context.stroke();
    setText(this.value, `${numberText(this.values.at(-1))} ${this.unit}`);
  }
}
