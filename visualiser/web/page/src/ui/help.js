// The keys, over everything.
import { h } from "./dom.js";

const KEYS = [
  ["drag", "turn the view; move the plan"],
  ["right drag, arrow keys", "move the view"],
  ["wheel, page up, page down", "nearer, further"],
  ["click", "select"],
  ["double click", "select and go there"],
  ["shift + drag a robot", "move it, and those selected with it (with control)"],
  ["shift + drag the floor", "select by a box"],
  ["F", "follow the selected one"],
  ["K", "keep its card"],
  ["Esc", "select nothing"],
  ["/", "filter the list"],
  ["space", "pause, go on (with control)"],
  ["N", "one tick (with control)"],
  ["shift + N", "ten ticks (with control)"],
  ["+  −", "faster, slower (with control)"],
  ["I", "ids"],
  ["L", "trails"],
  ["B", "laser beams and grips"],
  ["S", "shadows (in three dimensions)"],
  ["V", "plan view, three dimensions"],
  ["M", "measure: drag over the floor"],
  ["H", "handles that move and turn the selected one (with control)"],
  ["Delete", "take the selected ones out of the arena (with control)"],
  ["J", "heat map: where robots have been"],
  ["W", "plots of the whole swarm"],
  ["Y", "copy a link to this view"],
  ["P", "save the picture (PNG)"],
  ["shift + P", "film, until it is pressed again"],
  ["Home", "the whole arena"],
  ["End", "the arena from above"],
  ["G", "log"],
  ["F3", "list of entities, on a narrow screen"],
  ["F1 or ?", "these keys"],
];

export class Help {
  constructor() {
    this.element = h(
      "div.help",
      { role: "dialog", "aria-label": "Keys", onclick: () => this.toggle(false) },
      (this.sheet = h("div.sheet", { tabindex: "0" }, h("h2", {}, "Keys"), h("dl", {}, ...KEYS.flatMap(([key, what]) => [h("dt", {}, key), h("dd", {}, what)])))),
    );
    this.element.hidden = true;
  }

  toggle(on = this.element.hidden) {
    this.element.hidden = !on;
    if (on) this.sheet.focus();
  }
}
