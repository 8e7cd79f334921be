// The keys, over everything.
import { h } from "./dom.js";

const KEYS = [
  ["drag", "turn the view"],
  ["right drag, arrow keys", "move the view"],
  ["wheel", "nearer, further"],
  ["click", "select"],
  ["double click", "select and go there"],
  ["shift + drag a robot", "move it (with control)"],
  ["F", "follow what is selected"],
  ["P", "pin what is selected"],
  ["Esc", "select nothing"],
  ["/", "filter the list"],
  ["space", "pause, go on (with control)"],
  [".", "one tick (with control)"],
  ["+  −", "faster, slower (with control)"],
  ["I", "ids"],
  ["T", "trails"],
  ["B", "laser beams and grips"],
  ["S", "shadows"],
  ["R", "the whole arena"],
  ["V", "from above"],
  ["L", "log"],
  ["?", "these keys"],
];

export class Help {
  constructor() {
    this.element = h(
      "div.help",
      { role: "dialog", "aria-label": "Keys", onclick: () => this.toggle(false) },
      h("div.sheet", {}, h("h2", {}, "Keys"), h("dl", {}, ...KEYS.flatMap(([key, what]) => [h("dt", {}, key), h("dd", {}, what)]))),
    );
    this.element.hidden = true;
  }

  toggle(on = this.element.hidden) {
    this.element.hidden = !on;
  }
}
