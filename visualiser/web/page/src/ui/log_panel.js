// The log at the bottom: the newest line always, all lines when opened.
import { h, setText } from "./dom.js";

const MOST_LINES = 1000;
const COMPARED = 8; // newest lines; a note that is among them is counted there instead of being added

export class LogPanel {
  constructor() {
    this.last = h("span.last");
    this.count = h("span.dim");
    this.lines = h("div.lines", { role: "log", "aria-label": "Log", tabindex: 0 });
    this.toggleButton = h("button.bar", { "aria-expanded": "false", title: "Log  (G)", onclick: () => this.toggle() }, h("span", {}, "Log"), this.count, this.last);
    this.element = h("footer", {}, this.toggleButton, this.lines);
    this.lines.hidden = true;
    this.total = 0;
    this.newest = []; // {source, text, element, count} of the last lines
  }

  toggle() {
    this.lines.hidden = !this.lines.hidden;
    this.toggleButton.setAttribute("aria-expanded", String(!this.lines.hidden));
    this.lines.scrollTop = this.lines.scrollHeight;
  }

  clear() {
    this.lines.replaceChildren();
    this.newest = [];
    this.total = 0;
    setText(this.last, "");
    setText(this.count, "");
  }

  add({ tick, source, level, text }) {
    const atEnd = this.lines.scrollTop + this.lines.clientHeight >= this.lines.scrollHeight - 4;
    const same = this.newest.find((line) => line.source === source && line.text === text);
    if (same) this.countAgain(same, tick);
    else this.addLine({ tick, source, level, text });
    this.total++;
    setText(this.count, String(this.total));
    setText(this.last, `${source}: ${text}`);
    this.last.className = `last ${level}`;
    if (atEnd) this.lines.scrollTop = this.lines.scrollHeight;
  }

  addLine({ tick, source, level, text }) {
    const [when, times] = [h("span.tick", {}, tick === null ? "" : String(tick)), h("span.times")];
    const element = h(`div.line.${level}`, {}, when, h("span.source", {}, source), h("span", {}, text, times));
    this.lines.append(element);
    if (this.lines.childElementCount > MOST_LINES) this.lines.firstElementChild.remove();
    this.newest = [...this.newest.slice(1 - COMPARED), { source, text, element, when, times, count: 1 }];
  }

  // Shows the tick of the newest repetition, at the end.
  countAgain(line, tick) {
    line.count++;
    setText(line.when, tick === null ? "" : String(tick));
    setText(line.times, `×${line.count}`);
    this.lines.append(line.element);
  }
}
