// Plots values of one unit over simulated time on a canvas, for the last minute or the whole run. It also gives them as
// a picture or a table.
import { h, saveBlob, setText } from "./dom.js";
import { Series, toCsv } from "./series.js";

const WINDOW_S = 60;
const LINES = ["--accent", "--warn", "--good", "--bad", "--plot-5", "--plot-6"];

export function niceStep(range, parts) {
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
  // `fileName`: without ending.
  constructor(unit, fileName, onClose) {
    this.unit = unit;
    this.fileName = fileName;
    this.series = new Map(); // by key
    this.whole = false;
    this.legend = h("span.legend-names");
    this.canvas = h("canvas", { role: "img", "aria-label": "No values yet" });
    this.range = h("button.small", { title: "The last minute, or the whole run as far as this page has seen it", "aria-pressed": "false", onclick: () => this.setWhole(!this.whole) }, "All");
    this.element = h(
      "div.plot",
      {},
      h(
        "div.plot-head",
        {},
        this.legend,
        this.range,
        h("button.small", { title: "Save as a table", onclick: () => this.saveTable() }, "CSV"),
        h("button.small", { title: "Save as a picture", onclick: () => this.savePicture() }, "PNG"),
        h("button.close", { title: "Close the plot", "aria-label": "Close", onclick: onClose }, "×"),
      ),
      this.canvas,
    );
  }

  open(key, name) {
    this.series.set(key, new Series(name));
    this.stale = true;
    this.writeLegend();
  }
  close(key) {
    this.series.delete(key);
    this.stale = true;
    this.writeLegend();
  }

  add(key, time, value, spread) {
    this.stale = this.series.get(key)?.add(time, value, spread) || this.stale;
  }

  setWhole(on) {
    this.whole = on;
    this.range.setAttribute("aria-pressed", String(on));
    this.stale = true;
  }

  writeLegend() {
    this.values = [...this.series.values()].map(() => h("span.number"));
    this.legend.replaceChildren(
      ...[...this.series.values()].map(({ name }, i) => {
        const mark = h("i.mark");
        mark.style.background = `var(${LINES[i % LINES.length]})`;
        return h("span", {}, this.series.size > 1 ? mark : null, name, " ", this.values[i]);
      }),
    );
  }

  saveTable() {
    saveBlob(new Blob([toCsv([...this.series.values()], this.unit)], { type: "text/csv" }), `${this.fileName()}.csv`);
  }

  // Saves the picture with background and names, which the canvas lacks.
  savePicture() {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [this.canvas.width, this.canvas.height + 18 * ratio];
    const copy = h("canvas", { width, height });
    const context = copy.getContext("2d");
    const style = getComputedStyle(this.canvas);
    context.fillStyle = style.getPropertyValue("--page");
    context.fillRect(0, 0, width, height);
    context.font = `${11 * ratio}px system-ui, sans-serif`;
    let x = 38 * ratio;
    [...this.series.values()].forEach(({ name }, i) => {
      const text = this.unit ? `${name} (${this.unit})` : name;
      context.fillStyle = style.getPropertyValue(LINES[i % LINES.length]);
      context.fillText(text, x, 13 * ratio);
      x += context.measureText(text).width + 12 * ratio;
    });
    context.drawImage(this.canvas, 0, 18 * ratio);
    copy.toBlob((blob) => saveBlob(blob, `${this.fileName()}.png`));
  }

  // Returns the first and last time, and the lowest and highest value, rounded.
  bounds() {
    const all = [...this.series.values()].filter(({ times }) => times.length > 0);
    if (all.length === 0) return null;
    const end = Math.max(...all.map(({ times }) => times.at(-1)));
    const begin = Math.min(...all.map(({ times }) => times[0]));
    const start = this.whole ? begin : Math.max(begin, end - WINDOW_S);
    let [low, high] = [Infinity, -Infinity];
    for (const series of all)
      for (let i = series.from(start); i < series.values.length; i++) {
        const spread = series.spreads[i] ?? 0;
        low = Math.min(low, series.values[i] - spread);
        high = Math.max(high, series.values[i] + spread);
      }
    if (low > high) return null;
    if (high - low < 1e-9) [low, high] = [low - Math.max(0.5, Math.abs(low) * 0.1), high + Math.max(0.5, Math.abs(high) * 0.1)];
    const step = niceStep(high - low, 2.5);
    return { start, end, low: Math.floor(low / step) * step, high: Math.ceil(high / step) * step, step };
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
    const bounds = this.bounds();
    if (!bounds) return;
    const style = getComputedStyle(canvas);
    const box = { left: 38, right: width - 4, top: 5, bottom: height - 14 };
    const x = (time) => box.left + ((time - bounds.start) / Math.max(bounds.end - bounds.start, 1e-9)) * (box.right - box.left);
    const y = (value) => box.bottom - ((value - bounds.low) / (bounds.high - bounds.low)) * (box.bottom - box.top);
    this.drawAxes(context, style, box, bounds, y, height);
    [...this.series.values()].forEach((series, i) => {
      const colour = style.getPropertyValue(LINES[i % LINES.length]);
      drawSeries(context, series, series.from(bounds.start), x, y, colour);
      if (series.values.length > 0) setText(this.values[i], `${numberText(series.values.at(-1))}${this.unit ? ` ${this.unit}` : ""}`);
    });
    canvas.setAttribute("aria-label", `${[...this.series.values()].map(({ name }) => name).join(", ")} from ${bounds.start.toFixed(1)} to ${bounds.end.toFixed(1)} seconds`);
  }

  drawAxes(context, style, box, { start, end, low, high, step }, y, height) {
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
  }
}

// Draws the line and, for a mean, the band of one standard deviation around it.
function drawSeries(context, { times, values, spreads }, first, x, y, colour) {
  if (spreads.length > 0) {
    context.beginPath();
    for (let i = first; i < values.length; i++) context.lineTo(x(times[i]), y(values[i] + spreads[i]));
    for (let i = values.length - 1; i >= first; i--) context.lineTo(x(times[i]), y(values[i] - spreads[i]));
    context.globalAlpha = 0.2;
    context.fillStyle = colour;
    context.fill();
    context.globalAlpha = 1;
  }
  context.strokeStyle = colour;
  context.lineWidth = 1.5;
  context.lineJoin = "round";
  context.beginPath();
  for (let i = first; i < values.length; i++) context.lineTo(x(times[i]), y(values[i]));
  context.stroke();
}
