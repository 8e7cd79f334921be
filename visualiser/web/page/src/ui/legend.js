// The legend of the robots' colours, if they are not those of their LEDs.
import { categoryColour, rampColour, robotValues } from "../view/robot_values.js";
import { fixed, h } from "./dom.js";

const rgb = (colour) => `rgb(${colour})`;

export class Legend {
  constructor() {
    this.element = h("div.legend", { role: "note" });
    this.element.hidden = true;
  }

  // `colouring`: Colouring of robot_values.js, or null.
  show(colouring, world) {
    this.element.hidden = colouring === null || !(colouring.high >= colouring.low);
    if (this.element.hidden) return;
    const { name, low, high } = colouring;
    const { unit, categories } = robotValues[name];
    const key = `${name} ${fixed(low)} ${fixed(high)}`;
    if (key === this.key) return;
    this.key = key;
    if (categories) this.element.replaceChildren(h("span", {}, name), ...names(name, world, low, high).flatMap(([text, number]) => [mark(number), h("span", {}, text)]));
    else {
      const ramp = h("i.ramp");
      ramp.style.background = `linear-gradient(to right, ${[0, 0.25, 0.5, 0.75, 1].map((share) => rgb(rampColour(share)))})`;
      this.element.replaceChildren(h("span", {}, name), h("span.number", {}, fixed(low, 2)), ramp, h("span.number", {}, `${fixed(high, 2)} ${unit}`));
    }
  }
}

function mark(number) {
  const element = h("i.mark");
  element.style.background = rgb(categoryColour(number));
  return element;
}

function names(name, world, low, high) {
  const numbers = Array.from({ length: high - low + 1 }, (_, i) => low + i);
  const text = (number) => {
    if (number < 0) return "none";
    if (name === "engine") return world.engines[number]?.id ?? "none";
    if (name === "controller") return world.controllers[number]?.id ?? "none";
    return String(number);
  };
  return numbers.map((number) => [text(number), number]);
}
