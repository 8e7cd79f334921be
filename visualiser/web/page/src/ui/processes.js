// The processes of the run: names, progress and delays.
import { h, setText } from "./dom.js";

const LATE_S = 0.5;

export class Processes {
  constructor() {
    this.body = h("tbody");
    this.summary = h("summary", {}, "Processes");
    this.element = h("details.processes", {}, this.summary, h("table", {}, this.body));
    this.rows = new Map();
  }

  update(status) {
    const names = new Set(status.processes.map((process) => process.name));
    for (const [name, row] of this.rows)
      if (!names.has(name)) {
        row.element.remove();
        this.rows.delete(name);
      }
    let late = 0;
    for (const process of status.processes) {
      let row = this.rows.get(process.name);
      if (!row) {
        row = { state: h("td.value") };
        row.element = h("tr", { title: process.process }, h("th", {}, process.name), row.state);
        this.rows.set(process.name, row);
        this.body.append(row.element);
      }
      const isLate = process.late_s >= LATE_S;
      late += isLate ? 1 : 0;
      row.element.classList.toggle("late", isLate);
      setText(row.state, isLate ? `late ${process.late_s.toFixed(1)} s${process.doing ? `: ${process.doing}` : ""}` : `tick ${process.tick}`);
    }
    setText(this.summary, late > 0 ? `Processes: ${late} late` : `Processes: ${status.processes.length}`);
    this.summary.classList.toggle("late", late > 0);
    this.element.hidden = status.processes.length === 0;
  }
}
