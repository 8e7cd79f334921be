// The timeline below the picture: the shown tick, the events of the run as marks, and the way back to the present.
import { clockText, h, icon, setText } from "./dom.js";

const PACES = [0.25, 0.5, 1, 2, 4, 8, 16, 32, 64]; // times real time

export class Timeline {
  // `actions`: look(tick), play(), step(ticks), pace(factor), live(), branch().
  constructor(actions) {
    this.actions = actions;
    this.first = this.last = 0;
    this.step = 1; // ticks between two states
    this.events = [];
    this.past = null; // the requested tick; null: the present
    this.play = h("button.icon", { onclick: () => actions.play() }, icon("resume"));
    this.back = h("button.icon", { title: "One tick back  (,)", "aria-label": "One tick back", onclick: () => actions.step(-1) }, icon("back"));
    this.ahead = h("button.icon", { title: "One tick ahead  (.)", "aria-label": "One tick ahead", onclick: () => actions.step(1) }, icon("step"));
    this.pace = h(
      "select",
      { title: "Speed of playing the past", "aria-label": "Speed of playing the past", onchange: () => actions.pace(Number(this.pace.value)) },
      ...PACES.map((pace) => h("option", { value: pace }, `${pace}×`)),
    );
    this.showPace(1);
    this.track = h("input.track", {
      type: "range",
      step: 1,
      "aria-label": "Tick that is shown",
      oninput: () => actions.look(Number(this.track.value)),
    });
    this.marks = h("div.event-marks", { role: "group", "aria-label": "Events" });
    this.text = h("output.number", {});
    this.live = h("button.toggle", { title: "Back to the present  (Q)", onclick: () => actions.live() }, "Live");
    this.branch = h("button.toggle", { title: "Start a new run from this tick; without control, copy the command that does  (Shift + B)", onclick: () => actions.branch() }, "Branch here");
    this.branches = h("span.branches");
    this.element = h("section.timeline", { "aria-label": "Timeline" }, this.play, this.back, this.ahead, h("div.rail", {}, this.track, this.marks), this.text, this.pace, this.branch, this.branches, this.live);
    this.element.hidden = true;
    this.showPlaying(false);
  }

  // Takes a message of the server. `tickSeconds`: simulated time of a tick.
  set({ first, last, step = 1, events, all_events: all }, tickSeconds) {
    Object.assign(this, { first, last, step, tickSeconds });
    this.element.hidden = last <= first;
    this.track.step = step;
    this.track.min = first;
    this.track.max = last;
    if (this.past === null) this.track.value = last;
    const marks = JSON.stringify([events, all]);
    if (marks !== this.shownMarks) this.setEvents(events, all);
    this.shownMarks = marks;
    this.placeMarks();
    this.showText();
  }

  // Returns the recorded tick nearest to a tick.
  recorded(tick) {
    const { first, last, step } = this;
    return Math.max(first, Math.min(last, first + Math.round((tick - first) / step) * step));
  }

  // For a run without a present.
  setRecorded() {
    this.live.hidden = this.branch.hidden = true;
  }

  // Shows the way to a new run.
  showBranch(tick, url) {
    this.branches.append(h("a.toggle", { href: url, target: "_blank", rel: "noopener", title: `The new run from tick ${tick}` }, `Run from ${tick}`));
  }

  showPace(pace) {
    this.pace.value = String(pace);
  }

  // Returns the next quicker or slower pace.
  neighbourPace(pace, step) {
    return PACES[Math.max(0, Math.min(PACES.length - 1, PACES.indexOf(pace) + step))];
  }

  setEvents(events, all) {
    this.events = events;
    const more = all > events.length ? ` (the first ${events.length} of ${all} events)` : "";
    this.buttons = events.map((event) => {
      const what = [`tick ${event.tick}:`, event.what, event.entity, event.from && `(${event.from})`].filter(Boolean).join(" ") + more;
      return h("button.event-mark", { title: what, "aria-label": what, "data-what": event.what, onclick: () => this.actions.look(event.tick) });
    });
    this.marks.replaceChildren(...this.buttons);
  }

  placeMarks() {
    const span = Math.max(1, this.last - this.first);
    this.events.forEach((event, k) => {
      this.buttons[k].hidden = event.tick < this.first;
      this.buttons[k].style.left = `${(100 * (event.tick - this.first)) / span}%`;
    });
  }

  // `past`: the shown tick of the past; null: the present.
  show(past) {
    this.past = past;
    this.track.value = past ?? this.last;
    this.element.dataset.past = String(past !== null);
    this.showText();
  }

  showPlaying(on) {
    const label = on ? "Stop playing  (Z)" : "Play from here  (Z)";
    this.play.replaceChildren(icon(on ? "pause" : "resume"));
    this.play.title = label;
    this.play.setAttribute("aria-label", label.split("  ")[0]);
  }

  showText() {
    const tick = this.past ?? this.last;
    const time = clockText(tick * (this.tickSeconds ?? 0));
    setText(this.text, this.past === null ? `live · ${time}` : `${time} · tick ${tick}`);
    this.track.setAttribute("aria-valuetext", `tick ${tick}, ${time}${this.past === null ? ", live" : ""}`);
    this.live.setAttribute("aria-pressed", String(this.past === null));
  }

  // Returns the event after or before a tick.
  neighbour(tick, forward) {
    const ticks = this.events.map((event) => event.tick).filter((t) => t >= this.first && (forward ? t > tick : t < tick));
    return ticks.length === 0 ? null : forward ? Math.min(...ticks) : Math.max(...ticks);
  }
}
