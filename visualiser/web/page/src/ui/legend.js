// The legends of the robots' colours, if they are not those of their LEDs, and of the heat map.
import { categoryColour, rampColour, robotValues } from "../view/robot_values.js";
import { fixed, h, setText } from "./dom.js";

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
      this.element.replaceChildren(h("span", {}, name), h("span.number", {}, fixed(low, 2)), ramp((share) => share), h("span.number", {}, `${fixed(high, 2)} ${unit}`));
    }
  }
}

// The colour bar of the heat map.
export class HeatLegend {
  constructor() {
    this.most = h("span.number");
    this.cell = h("span.dim");
    // The colours follow the root of the time, and the bar the time.
    this.element = h("div.legend", { role: "note" }, h("span", {}, "heat map"), h("span.number", {}, "0"), ramp(Math.sqrt), this.most, this.cell);
    this.element.hidden = true;
  }

  // `heat`: HeatMap, or null.
  show(heat) {
    this.element.hidden = heat === null;
    if (heat === null) return;
    setText(this.most, `${fixed(heat.most, heat.most < 10 ? 1 : 0)} s`);
    setText(this.cell, `in a cell of ${Math.round(100 * heat.cellSize)} cm`);
  }
}

// Returns a bar. `shareAt`: the share of the ramp at a share of the bar.
function ramp(shareAt) {
  const bar = h("i.ramp");
  const places = Array.from({ length: 9 }, (_, i) => i / 8);
  bar.style.background = `linear-gradient(to right, ${places.map((place) => `${rgb(rampColour(shareAt(place)))} ${100 * place}%`)})`;
  return bar;
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
