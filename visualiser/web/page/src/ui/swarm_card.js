// The card of the swarm: mean and band of any value over all robots, or over the selected ones.
import { robotValues } from "../view/robot_values.js";
import { h, setText } from "./dom.js";
import { Plot } from "./plot.js";

export class SwarmCard {
  // fileName(text): the name of a file without ending. `actions`: onClose(); plotsChanged(): called when other values
  // of the past are needed; isPast(): whether the past is shown.
  constructor(fileName, { onClose, plotsChanged, isPast }) {
    Object.assign(this, { fileName, plotsChanged, isPast });
    this.plots = new Map(); // by the name of the value
    this.who = h("div.dim");
    this.area = h("div.plots");
    this.choices = Object.entries(robotValues)
      .filter(([, { categories }]) => !categories)
      .map(([name]) => [name, h("button.toggle", { "aria-pressed": "false", onclick: () => this.toggle(name) }, name)]);
    this.element = h(
      "section.card.swarm",
      { "aria-label": "Swarm" },
      h("div.head", {}, h("div", {}, h("h2", {}, "Swarm"), this.who), h("span.space"), h("button.close", { title: "Close", "aria-label": "Close", onclick: onClose }, "×")),
      h("div.tool-group", {}, ...this.choices.map(([, button]) => button)),
      this.area,
    );
    this.toggle("speed");
  }

  toggle(name) {
    const known = this.plots.get(name);
    if (known) {
      known.element.remove();
      this.plots.delete(name);
    } else {
      const plot = new Plot(robotValues[name].unit, () => this.fileName(`swarm ${name}`), { onClose: () => this.toggle(name), onWhole: this.plotsChanged });
      if (this.isPast()) plot.lookBack(true);
      plot.open(name, name);
      this.plots.set(name, plot);
      this.area.append(plot.element);
      this.plotsChanged();
    }
    for (const [each, button] of this.choices) button.setAttribute("aria-pressed", String(this.plots.has(each)));
  }

  // `robots`: the counted ones; `all`: whether they are all robots of the experiment.
  addFrame(frame, meter, robots, all) {
    setText(this.who, `mean and standard deviation of ${all ? "all " : ""}${robots.length} ${all ? "" : "selected "}robots`);
    for (const [name, plot] of this.plots) {
      const found = meter.statistics(name, robots);
      if (found) plot.add(name, frame.time, found.mean, found.deviation);
    }
  }

  get allPlots() {
    return [...this.plots.values()];
  }

  // Clears the plots for other robots, since earlier values do not belong to them.
  clear() {
    for (const plot of this.plots.values()) for (const series of plot.series.values()) series.clear();
  }
}
