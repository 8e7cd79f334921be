// Plots values of one unit over simulated time on a canvas, for the last minute or the whole run. The pointer shows the
// values at a time, in all plots together. Dragging or the wheel shows a part of the time. The plot can be saved as a
// picture or a table.
import { h, saveBlob, setText } from "./dom.js";
import { Series, toCsv } from "./series.js";

const WINDOW_S = 60;
const LEAST_DRAG_PX = 6; // a shorter one is a click
const ZOOM = 1.25; // of a step of the wheel
const BOX = { left: 38, right: 4, top: 5, bottom: 14 }; // px beside the drawn part
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

// Returns a mean and its deviation with as many decimals as two digits of the deviation need.
function meanText(mean, deviation) {
  const decimals = deviation > 0 ? Math.max(0, Math.min(6, 1 - Math.floor(Math.log10(deviation)))) : 3;
  return `${mean.toFixed(decimals)} ± ${deviation.toFixed(decimals)}`;
}

export class Plot {
  // `fileName`: without ending. `actions`: onClose(); onWhole(): called when the plot shows another part of the run.
  constructor(unit, fileName, { onClose, onWhole }) {
    this.onWhole = onWhole;
    this.shownCursor = this.cursor;
    this.part = null; // {start, end} in seconds, if the user has chosen it
    this.drag = null; // {from, to} in pixels
    this.unit = unit;
    this.fileName = fileName;
    this.series = new Map(); // by key
    this.whole = false;
    this.legend = h("span.legend-names");
    this.canvas = h("canvas", {
      role: "img",
      "aria-label": "No values yet",
      title: "Drag: show this part of the time; wheel: more or less of it; double click: all again",
      onpointermove: (event) => this.point(event),
      onpointerleave: () => this.leave(),
      onpointerdown: (event) => this.beginDrag(event),
      onpointerup: (event) => this.endDrag(event),
      onpointercancel: () => (this.drag = null),
      ondblclick: () => this.showPart(null),
      onwheel: (event) => this.zoom(event),
    });
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

  // The time under the pointer, in any plot; null: none.
  static cursor = null;
  get cursor() {
    return Plot.cursor;
  }

  open(key, name) {
    this.series.set(key, new Series(name));
    if (this.past) this.series.get(key).keep();
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

  clear() {
    for (const series of this.series.values()) series.clear();
    this.stale = true;
  }

  // `on`: the plot gets states of the past from now on. The others are kept meanwhile.
  lookBack(on) {
    if (on === Boolean(this.past)) return;
    this.past = on;
    for (const series of this.series.values()) on ? series.keep() : series.restore();
    this.showPart(null);
  }

  setWhole(on) {
    this.whole = on;
    this.range.setAttribute("aria-pressed", String(on));
    this.showPart(null);
    this.onWhole();
  }

  // `part`: {start, end} in seconds; null: up to the newest value.
  showPart(part) {
    this.part = part;
    this.stale = true;
  }

  // ---- the pointer ----

  // Returns the time at a place of the page.
  timeAt(x) {
    const { left, width } = this.canvas.getBoundingClientRect();
    const { start, end } = this.drawn;
    const share = (x - left - BOX.left) / Math.max(1, width - BOX.left - BOX.right);
    return start + Math.max(0, Math.min(1, share)) * (end - start);
  }

  point(event) {
    if (!this.drawn) return;
    Plot.cursor = this.timeAt(event.clientX);
    if (this.drag) this.drag.to = event.offsetX;
  }

  leave() {
    if (!this.drag) Plot.cursor = null;
  }

  // A finger moves the pointer only.
  beginDrag(event) {
    this.point(event);
    if (!this.drawn || event.button !== 0 || event.pointerType === "touch") return;
    this.canvas.setPointerCapture(event.pointerId);
    this.drag = { from: event.offsetX, to: event.offsetX, time: this.timeAt(event.clientX) };
  }

  endDrag(event) {
    const { drag } = this;
    this.drag = null;
    this.stale = true;
    if (!drag || Math.abs(event.offsetX - drag.from) < LEAST_DRAG_PX) return;
    const [start, end] = [drag.time, this.timeAt(event.clientX)].sort((a, b) => a - b);
    this.showPart({ start, end });
  }

  zoom(event) {
    if (!this.drawn) return;
    event.preventDefault();
    const { start, end, first, last } = this.drawn;
    const [time, factor] = [this.timeAt(event.clientX), event.deltaY > 0 ? ZOOM : 1 / ZOOM];
    const part = { start: Math.max(first, time - (time - start) * factor), end: Math.min(last, time + (end - time) * factor) };
    this.showPart(part.start <= first && part.end >= last ? null : part);
    if (factor > 1 && !this.part) this.setWhole(true);
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
    const last = Math.max(...all.map(({ times }) => times.at(-1)));
    const first = Math.min(...all.map(({ times }) => times[0]));
    const part = this.part && this.part.start < last && this.part.end > first ? this.part : null;
    const { start, end } = part ?? { start: this.whole ? first : Math.max(first, last - WINDOW_S), end: last };
    let [low, high] = [Infinity, -Infinity];
    for (const series of all)
      for (let i = series.from(start); i < series.values.length && series.times[i] <= end; i++) {
        const spread = series.spreads[i] ?? 0;
        low = Math.min(low, series.values[i] - spread);
        high = Math.max(high, series.values[i] + spread);
      }
    if (low > high) return null;
    if (high - low < 1e-9) [low, high] = [low - Math.max(0.5, Math.abs(low) * 0.1), high + Math.max(0.5, Math.abs(high) * 0.1)];
    const step = niceStep(high - low, 2.5);
    return { start, end, first, last, low: Math.floor(low / step) * step, high: Math.ceil(high / step) * step, step };
  }

  draw() {
    const { canvas } = this;
    const ratio = window.devicePixelRatio || 1;
    const { clientWidth: width, clientHeight: height } = canvas;
    if ((!this.stale && !this.drag && this.cursor === this.shownCursor) || width === 0) return;
    this.stale = false;
    this.shownCursor = this.cursor;
    if (canvas.width !== Math.round(width * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    const bounds = (this.drawn = this.bounds());
    if (!bounds) return;
    const style = getComputedStyle(canvas);
    const box = { left: BOX.left, right: width - BOX.right, top: BOX.top, bottom: height - BOX.bottom };
    const x = (time) => box.left + ((time - bounds.start) / Math.max(bounds.end - bounds.start, 1e-9)) * (box.right - box.left);
    const y = (value) => box.bottom - ((value - bounds.low) / (bounds.high - bounds.low)) * (box.bottom - box.top);
    this.drawAxes(context, style, box, bounds, y, height);
    const cursor = this.cursor !== null && this.cursor >= bounds.start && this.cursor <= bounds.end ? this.cursor : null;
    context.save();
    context.beginPath();
    context.rect(box.left, 0, box.right - box.left, height);
    context.clip();
    if (this.drag) {
      context.fillStyle = style.getPropertyValue("--accent-soft");
      context.fillRect(this.drag.from, box.top, this.drag.to - this.drag.from, box.bottom - box.top);
    }
    const marks = [...this.series.values()].map((series, i) => {
      const colour = style.getPropertyValue(LINES[i % LINES.length]);
      drawSeries(context, series, Math.max(0, series.from(bounds.start) - 1), x, y, colour);
      const place = cursor === null ? series.values.length - 1 : series.nearest(cursor);
      const spread = series.spreads[place];
      const textAt = () => (spread === undefined ? numberText(series.values[place]) : meanText(series.values[place], spread));
      setText(this.values[i], place < 0 ? "" : `${textAt()}${this.unit ? ` ${this.unit}` : ""}`);
      return { series, place, colour };
    });
    if (cursor !== null) this.drawCursor(context, style, box, cursor, marks, x, y);
    context.restore();
    canvas.setAttribute("aria-label", `${[...this.series.values()].map(({ name }) => name).join(", ")} from ${bounds.start.toFixed(1)} to ${bounds.end.toFixed(1)} seconds`);
  }

  // Draws the line at the time of the pointer, and a dot on each series.
  drawCursor(context, style, box, cursor, marks, x, y) {
    context.strokeStyle = context.fillStyle = style.getPropertyValue("--dim");
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(Math.round(x(cursor)) + 0.5, box.top);
    context.lineTo(Math.round(x(cursor)) + 0.5, box.bottom);
    context.stroke();
    const text = `${cursor.toFixed(1)} s`;
    context.textAlign = x(cursor) > (box.left + box.right) / 2 ? "right" : "left";
    context.fillText(text, x(cursor) + (context.textAlign === "left" ? 4 : -4), box.top + 8);
    for (const { series, place, colour } of marks) {
      if (place < 0) continue;
      context.fillStyle = colour;
      context.beginPath();
      context.arc(x(series.times[place]), y(series.values[place]), 3, 0, 2 * Math.PI);
      context.fill();
    }
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
