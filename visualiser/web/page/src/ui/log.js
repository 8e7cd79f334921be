// The log at the bottom: the newest line always, all lines when opened.
import { h, setText } from "./dom.js";

const MOST_LINES = 1000;

export class LogPanel {
  constructor() {
    this.last = h("span.last");
    this.count = h("span.dim");
    this.lines = h("div.lines", { role: "log" });
    this.toggleButton = h("button.bar", { "aria-expanded": "false", title: "Log  (G)", onclick: () => this.toggle() }, h("span", {}, "Log"), this.count, this.last);
    this.element = h("footer", {}, this.toggleButton, this.lines);
    this.lines.hidden = true;
    this.total = 0;
    this.worst = "info";
  }

  toggle() {
    this.lines.hidden = !this.lines.hidden;
    this.toggleButton.setAttribute("aria-expanded", String(!this.lines.hidden));
    this.lines.scrollTop = this.lines.scrollHeight;
  }

  clear() {
    this.lines.replaceChildren();
    this.total = 0;
    setText(this.last, "");
    setText(this.count, "");
  }

  add({ tick, source, level, text }) {
    const atEnd = this.lines.scrollTop + this.lines.clientHeight >= this.lines.scrollHeight - 4;
    this.lines.append(
      h(`div.line.${level}`, {}, h("span.tick", {}, tick === null ? "" : String(tick)), h("span.source", {}, source), h("span", {}, text)),
    );
    if (this.lines.childElementCount > MOST_LINES) this.lines.firstElementChild.remove();
    this.total++;
    setText(this.count, String(this.total));
    setText(this.last, `${source}: ${text}`);
    this.last.className = `last ${level}`;
    if (atEnd) this.lines.scrollTop = this.lines.scrollHeight;
  }
}
