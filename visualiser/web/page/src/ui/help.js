// The list of keys, over the whole page.
import { h } from "./dom.js";

const KEYS = [
  ["drag", "turn the view; move the plan"],
  ["right drag", "move the view"],
  ["arrow keys", "turn the view; move the plan"],
  ["wheel, page up, page down", "nearer, further"],
  ["two fingers", "nearer, further; move the view"],
  ["click", "select"],
  ["Ctrl + click", "select, and keep the card of the one before"],
  ["double click", "select and go there"],
  ["shift + drag a robot", "move it, and those selected with it; the wheel turns them (with control)"],
  ["shift + drag the floor", "select by a box"],
  ["F", "follow the selected one"],
  ["O", "look from the selected robot; a drag looks about"],
  ["K", "keep its card"],
  ["Esc", "select nothing"],
  ["/", "filter the list"],
  ["space", "pause, go on (with control)"],
  ["N", "one tick (with control)"],
  ["shift + N", "ten ticks (with control)"],
  ["+  −", "faster, slower: the past that is looked at, or the run (with control)"],
  ["I", "ids"],
  ["L", "trails"],
  ["B", "laser beams and grips"],
  ["R", "rays of proximity sensors and range scanners"],
  ["C", "collision models"],
  ["X", "links of range and bearing: half a line comes from who is not answered"],
  ["S, T", "shadows, textures (in three dimensions)"],
  ["V", "plan view, three dimensions"],
  ["M", "measure: drag over the floor"],
  ["H", "handles that move and turn the selected one (with control)"],
  ["Delete", "take the selected ones out of the arena (with control)"],
  [", .", "look back: one tick earlier, later"],
  ["< >", "the event before, after"],
  ["Z", "play from the tick that is looked at, stop"],
  ["Q", "back to the present"],
  ["shift + B", "start a new run from this tick; without control, copy the command that does"],
  ["shift + I", "copy the command that tells what the selected robot sensed at that tick"],
  ["Ctrl + Z, Ctrl + Y", "undo, do again: moves of this page (with control), changes in the editor"],
  ["Ctrl + S, Ctrl + Enter", "save; run (in the editor)"],
  ["J", "heat map: where robots have been"],
  ["W", "plots of the whole swarm"],
  ["Y", "copy a link to this view"],
  ["P", "save the picture (PNG)"],
  ["shift + P", "film, until it is pressed again"],
  ["Home", "the whole arena"],
  ["End", "the arena from above"],
  ["Ctrl + 0 … 9", "go to a viewpoint"],
  ["Ctrl + shift + 0 … 9", "keep this view as one, and copy its XML"],
  ["U", "fly through the viewpoints"],
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
