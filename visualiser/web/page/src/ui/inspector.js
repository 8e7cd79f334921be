// The panel on the right. It has a card for the selected entity and for each pinned one, with pose, owner, attributes,
// readings and the state of the controller. A click plots a value; any number can be plotted.
import { fixed, h, hex, setText } from "./dom.js";
import { Flag } from "../protocol.js";
import { Plot } from "./plot.js";
import { SwarmCard } from "./swarm_card.js";

const DEGREES = 180 / Math.PI;
const COLOURS = new Set(["led", "beacon", "colour", "laser_colour"]);
const MANY = 8; // from this number of values on, a device has bars instead of rows
// Bytes that devices show in readable form.
const HIDDEN_ATTRIBUTES = new Set(["message", "radio", "report", "instruction"]);

// A row of a table: a name and a value that can be plotted.
class Row {
  constructor(card, name, unit, key) {
    this.key = key;
    this.unit = unit;
    this.value = h("td.value");
    this.element = h("tr", {}, h("th", {}, name), this.value);
    if (unit !== null) {
      this.element.className = "plottable";
      this.element.addEventListener("click", () => card.togglePlot(key, `${name}`, unit));
      // The row takes clicks; its name is a button for the keyboard.
      this.element.firstChild.replaceChildren(h("button.plot-button", { title: "Plot", "aria-label": `Plot ${name}` }, name));
    }
  }
  text(text) {
    setText(this.value, text);
  }
  number(value, digits = 3) {
    this.now = value;
    this.text(`${fixed(value, digits)}${this.unit ? ` ${this.unit}` : ""}`);
  }
  colours(colours) {
    const wanted = colours.map(hex).join();
    if (this.shown === wanted) return;
    this.shown = wanted;
    this.value.replaceChildren(
      h("span.swatches", {}, ...colours.map((colour) => {
        const swatch = h("i", { title: colour === 0 ? "off" : hex(colour) });
        swatch.style.background = colour === 0 ? "transparent" : hex(colour);
        return swatch;
      })),
    );
  }
}

// Shows many values of one kind, such as the rays of a ring, with a bar for each. Bars are too narrow to be targets of
// their own, so that all are one control: the pointer or the arrow keys choose a bar, a click or Enter plots it.
class Bars {
  constructor(card, section, key, names, unit) {
    this.unit = unit;
    this.names = names;
    this.chosen = 0;
    const plot = (i) => card.togglePlot(`${key}.${names[i]}`, names[i], unit);
    this.bars = names.map((name, i) => {
      const bar = h("span.reading", { onclick: () => plot(i) }, h("b"));
      card.rows.set(`${key}.${name}`, { element: bar });
      return bar;
    });
    this.element = h("div.bars", { role: "slider", tabindex: 0, "aria-label": "Reading to plot with Enter", "aria-valuemin": 0, "aria-valuemax": names.length - 1, onkeydown: (event) => this.key(event, plot) }, ...this.bars);
    section.element.append(this.element);
  }
  key(event, plot) {
    if (event.ctrlKey || event.metaKey || event.altKey || !this.element.matches(":focus-visible")) return; // after a click, keys are the page's
    const last = this.bars.length - 1;
    const goals = { ArrowLeft: this.chosen - 1, ArrowDown: this.chosen - 1, ArrowRight: this.chosen + 1, ArrowUp: this.chosen + 1, Home: 0, End: last };
    if (event.key in goals) this.chosen = Math.max(0, Math.min(last, goals[event.key]));
    else if (event.key === "Enter" || event.key === " ") plot(this.chosen);
    else return;
    event.preventDefault();
    event.stopPropagation();
    this.showChosen();
  }
  show(values) {
    this.most = Math.max(this.most ?? 0, 1e-9, ...values.map(Math.abs));
    values.forEach((value, i) => {
      this.bars[i].firstChild.style.height = `${(100 * Math.abs(value)) / this.most}%`;
      this.bars[i].title = `${this.names[i]}: ${fixed(value)} ${this.unit}`;
    });
    this.showChosen();
  }
  showChosen() {
    this.bars.forEach((bar, i) => bar.classList.toggle("chosen", i === this.chosen));
    this.element.setAttribute("aria-valuenow", this.chosen);
    this.element.setAttribute("aria-valuetext", this.bars[this.chosen].title);
  }
}

const NOT_RECORDED = "What its sensors and controller held then is not in the journal; it is computed when the tick stands, or by the command that shift + I copies.";
const NOT_IN_PAGE = "What its sensors and controller held is not in this page.";

class Card {
  constructor(panel, entity) {
    const { world } = panel;
    this.panel = panel;
    this.entity = entity;
    this.rows = new Map();
    this.plots = new Map();
    this.bars = new Map();
    this.sections = new Map();
    this.plotArea = h("div.plots");
    this.state = h("div.state");
    this.pin = h("button.small", { title: "Keep this card  (K)", onclick: () => panel.togglePin(this) }, "Pin");
    this.follow = h("button.small", { title: "Follow  (F)", onclick: () => panel.actions.follow(entity) }, "Follow");
    this.element = h(
      "section.card",
      {},
      h(
        "div.head",
        {},
        h("div", {}, h("h2", {}, world.ids[entity]), h("div.dim", {}, world.kinds[entity].replaceAll("_", " "))),
        h("span.space"),
        this.follow,
        this.pin,
        h("button.close", { title: "Close", "aria-label": "Close", onclick: () => panel.close(this) }, "×"),
      ),
      this.state,
      this.plotArea,
    );
    const owner = this.section("Owner");
    const facts = [["engine", world.engineName(entity)]];
    if (world.isRobot(entity)) facts.push(["host", world.hostName(entity)], ["controller", world.controllerName(entity)]);
    for (const [name, text] of facts) this.row(owner, name, null).text(text);
    const pose = this.section("Pose");
    for (const [name, unit] of [["x", "m"], ["y", "m"], ["z", "m"], ["heading", "°"], ["speed", "m/s"]]) this.row(pose, name, unit, `pose.${name}`);
    if (world.slots[entity] < 0) this.showStill();
    else this.addForm();
  }

  // Adds a form that moves the entity, or takes it out of the arena or into it, to the millimetre and by the keyboard.
  addForm() {
    const { actions } = this.panel;
    const field = (name, label, step) => {
      const input = h("input", { type: "number", step, "aria-label": label, name });
      return h("label", {}, label, input);
    };
    this.form = h(
      "form.place-form",
      { onsubmit: (event) => this.submit(event) },
      field("x", "x (m)", "any"),
      field("y", "y (m)", "any"),
      field("z", "z (m)", "any"),
      field("heading", "heading (°)", "any"),
      (this.put = h("button.small", { type: "submit" }, "Move")),
      (this.remove = h("button.small", { type: "button", title: "Take it out of the arena  (Delete)", onclick: () => actions.remove(this.entity) }, "Remove")),
    );
    // The form is filled at once. The event `toggle` comes later and would overwrite text that is typed already.
    const fill = () => details.open || this.fillForm();
    const details = h("details.place", {}, h("summary", { onclick: fill }, "Move, add, remove"), this.form);
    this.place = details;
    this.place.hidden = !this.panel.mayControl;
    this.element.append(details);
  }

  fillForm() {
    const pose = this.panel.actions.poseOf(this.entity);
    for (const name of ["x", "y", "z", "heading"]) this.form.elements[name].value = fixed(pose[name], name === "heading" ? 1 : 3);
    this.showPresence(pose.present);
  }

  showPresence(present) {
    if (!this.form || this.present === present) return;
    this.present = present;
    setText(this.put, present ? "Move" : "Add");
    this.remove.hidden = !present;
  }

  submit(event) {
    event.preventDefault();
    const pose = Object.fromEntries(["x", "y", "z", "heading"].map((name) => [name, Number(this.form.elements[name].value)]));
    this.panel.actions.put(this.entity, this.present ? "move" : "add", pose);
  }

  section(title) {
    if (!this.sections.has(title)) {
      const body = h("tbody");
      const element = h("details", { open: this.sections.size < 4 }, h("summary", {}, title), h("table", {}, body));
      this.sections.set(title, { element, body });
      this.element.append(element);
    }
    return this.sections.get(title);
  }

  row(section, name, unit, key = `${name}`) {
    let row = this.rows.get(key);
    if (!row) {
      row = new Row(this, name, unit, key);
      this.rows.set(key, row);
      section.body.append(row.element);
    }
    return row;
  }

  showStill() {
    const [x, y, z] = this.panel.world.bodyOf.get(this.entity).position;
    [["x", x], ["y", y], ["z", z]].forEach(([name, value]) => this.rows.get(`pose.${name}`).number(value));
  }

  addFrame(frame) {
    const values = this.poseIn(frame);
    if (values === undefined) return;
    this.showPresence(values !== null);
    for (const name of ["x", "y", "z", "heading", "speed"]) {
      const row = this.rows.get(`pose.${name}`);
      if (values === null) row.text("not in the arena");
      else row.number(values[name], name === "heading" ? 1 : 3);
    }
    if (!this.panel.past) this.plotPose(frame.time, values);
  }

  plotPose(time, values) {
    for (const [key, plot] of this.plots) if (key.startsWith("pose.")) plot.add(key, time, values?.[key.slice(5)]);
  }

  // Returns the values of the pose in the next frame; null if the entity is not in the arena, undefined if it never
  // moves.
  poseIn(frame) {
    const slot = this.panel.world.slots[this.entity];
    if (slot < 0) return undefined;
    const [x, y, z] = frame.positions.subarray(3 * slot, 3 * slot + 3);
    if (frame.colours[4 * slot + 3] & Flag.absent) {
      this.last = null;
      return null;
    }
    const [qx, qy, qz, qw] = frame.quaternions.subarray(4 * slot, 4 * slot + 4).map(Number);
    const scale = 1 / 32767 ** 2;
    const heading = Math.atan2(2 * (qw * qz + qx * qy) * scale, 1 - 2 * (qy * qy + qz * qz) * scale) * DEGREES;
    const { last } = this;
    let speed = last && frame.time > last.time ? Math.hypot(x - last.x, y - last.y, z - last.z) / (frame.time - last.time) : this.speed;
    if (speed === undefined || !Number.isFinite(speed)) speed = 0;
    this.speed = speed;
    this.last = { time: frame.time, x, y, z };
    return { x, y, z, heading, speed };
  }

  // Adds a state of the past to the plots. `details`: its attributes, or undefined.
  addPast(frame, details) {
    const values = this.poseIn(frame);
    if (values !== undefined) this.plotPose(frame.time, values);
    for (const [key, plot] of this.plots) {
      const [group, name, place] = key.split(".");
      if (group === "a") plot.add(key, frame.time, details?.attributes[name]?.[Number(place)]);
    }
  }

  addDetails(time, details) {
    if (details.state || details.text) {
      setText(this.state, details.state && details.text && details.text !== details.state ? `${details.state} — ${details.text}` : details.state || details.text);
      this.state.hidden = false;
    } else if (this.panel.past && !details.sensors && this.panel.world.isRobot(this.entity)) {
      setText(this.state, this.panel.actions.isRecorded ? NOT_IN_PAGE : NOT_RECORDED);
      this.state.hidden = false;
    } else this.state.hidden = true;
    if (this.panel.past) this.hideInside(!details.sensors);
    for (const [name, values] of Object.entries(details.attributes)) {
      if (HIDDEN_ATTRIBUTES.has(name)) continue;
      const section = this.section("Attributes");
      const label = name.replaceAll("_", " ");
      if (COLOURS.has(name)) this.row(section, label, null, `a.${name}`).colours(values);
      else if (name === "gripped") this.row(section, "holds", null, `a.${name}`).text(this.heldText(values));
      else values.forEach((value, i) => this.value(section, values.length > 1 ? `${label} ${i}` : label, "", `a.${name}.${i}`, time, value));
    }
    for (const [group, devices] of [["Sensor", details.sensors ?? []], ["Actuator", details.actuators ?? []]])
      for (const device of devices) {
        const section = this.section(`${group}: ${device.type.replaceAll("_", " ")}`);
        const colours = device.values.length > 0 && device.units.every((unit) => unit === "colour");
        if (colours) this.row(section, "colours", null, `${group}.${device.type}`).colours(device.values);
        else if (device.values.length >= MANY && new Set(device.units).size === 1) this.barsOf(section, `${group}.${device.type}`, device, time);
        else
          device.values.forEach((value, i) =>
            this.value(section, device.names[i], device.units[i], `${group}.${device.type}.${device.names[i]}`, time, value),
          );
      }
  }

  lookBack(on) {
    this.last = null;
    this.speed = undefined;
    for (const plot of new Set(this.plots.values())) plot.lookBack(on);
    this.hideInside(on);
  }

  hideInside(on) {
    for (const [title, { element }] of this.sections) if (/^(Sensor|Actuator): /.test(title)) element.hidden = on;
  }

  tell(text) {
    setText(this.state, text);
    this.state.hidden = false;
  }

  value(section, name, unit, key, time, value) {
    const shown = unit === "rad" && value !== null ? value * DEGREES : value; // null: infinite, or not a number
    const row = this.row(section, name, unit === "colour" || unit === "yes/no" ? null : unit === "rad" ? "°" : unit, key);
    if (unit === "colour") row.colours([value]);
    else if (unit === "yes/no") row.text(value ? "yes" : "no");
    else row.number(shown);
    if (!this.panel.past) this.plots.get(key)?.add(key, time, shown);
  }

  barsOf(section, key, { names, units, values }, time) {
    if (this.bars.get(key)?.names.length !== names.length) {
      section.element.querySelector(".bars")?.remove();
      this.bars.set(key, new Bars(this, section, key, names, units[0]));
    }
    this.bars.get(key).show(values);
    names.forEach((name, i) => this.plots.get(`${key}.${name}`)?.add(`${key}.${name}`, time, values[i]));
  }

  heldText(values) {
    const held = values.filter((value) => value > 0).map((value) => this.panel.world.ids[value - 1]);
    return held.length ? held.join(", ") : "nothing";
  }

  // Values with the same unit share a plot.
  togglePlot(key, title, unit) {
    const open = this.plots.get(key);
    if (open) {
      open.close(key);
      this.plots.delete(key);
      if (open.series.size === 0) open.element.remove();
    } else {
      const plot = [...this.plots.values()].find((each) => each.unit === unit) ?? this.newPlot(unit);
      plot.open(key, title);
      this.plots.set(key, plot);
      this.panel.actions.plotsChanged();
    }
    this.rows.get(key).element.classList.toggle("plotted", this.plots.has(key));
  }

  newPlot(unit) {
    const { world } = this.panel;
    const plot = new Plot(
      unit,
      () => `${world.experiment} ${world.ids[this.entity]} ${[...plot.series.values()].map(({ name }) => name).join(" ")}`,
      { onClose: () => [...plot.series.keys()].forEach((key) => this.togglePlot(key)), onWhole: () => this.panel.actions.plotsChanged() },
    );
    if (this.panel.past) plot.lookBack(true);
    this.plotArea.append(plot.element);
    return plot;
  }
}

export class Inspector {
  // `actions`: watch(entities), follow(entity), deselect(), put(entity, "move" or "add", pose), remove(entity),
  // poseOf(entity), swarmChanged(on), plotsChanged(): called when other values of the past are needed; isRecorded:
  // whether the page itself has the run.
  constructor(actions) {
    this.actions = actions;
    this.cards = []; // pinned cards, then the selected one
    this.selected = null;
    this.swarm = null;
    this.mayControl = false;
    this.past = false;
    this.element = h("aside.right", { "aria-label": "Inspector" });
    this.element.hidden = true;
  }

  setWorld(world) {
    this.world = world;
    this.cards = [];
    this.selected = null;
    this.swarm?.clear();
    this.element.replaceChildren(...(this.swarm ? [this.swarm.element] : []));
    this.refresh();
  }

  select(entity) {
    if (this.selected?.entity === entity) return;
    if (this.selected) {
      this.selected.element.remove();
      this.cards = this.cards.filter((card) => card !== this.selected);
      this.selected = null;
    }
    if (entity !== null && !this.cards.some((card) => card.entity === entity)) {
      this.selected = new Card(this, entity);
      for (const name of this.world.slots[entity] >= 0 ? ["speed"] : []) this.selected.togglePlot(`pose.${name}`, name, "m/s");
      this.cards.push(this.selected);
      if (this.swarm) this.swarm.element.after(this.selected.element);
      else this.element.prepend(this.selected.element);
    }
    this.refresh();
  }

  // Shows or hides the card of the swarm, above the others.
  toggleSwarm(on = !this.swarm) {
    this.swarm?.element.remove();
    this.swarm = on ? new SwarmCard((text) => `${this.world.experiment} ${text}`, { onClose: () => this.toggleSwarm(false), plotsChanged: () => this.actions.plotsChanged(), isPast: () => this.past }) : null;
    if (on) this.element.prepend(this.swarm.element);
    this.actions.swarmChanged(on);
    this.refresh();
  }

  // Pins the card, so that the next selection gets its own.
  keepSelected() {
    if (this.selected && !this.selected.pin.classList.contains("on")) this.togglePin();
  }

  togglePin(card = this.selected) {
    if (!card) return;
    card.pin.classList.toggle("on");
    if (card === this.selected) this.selected = null;
    else if (!card.pin.classList.contains("on")) this.close(card);
    this.refresh();
  }

  close(card) {
    const wasSelected = card === this.selected;
    card.element.remove();
    this.cards = this.cards.filter((other) => other !== card);
    if (wasSelected) {
      this.selected = null;
      this.actions.deselect();
    }
    this.refresh();
  }

  setControl(control) {
    this.mayControl = control === "granted";
    for (const card of this.cards) if (card.place) card.place.hidden = !this.mayControl;
  }

  setFollowed(entity) {
    for (const card of this.cards) card.follow.classList.toggle("on", card.entity === entity);
  }

  get watched() {
    return this.cards.map((card) => card.entity).slice(-16);
  }

  refresh() {
    this.element.hidden = this.cards.length === 0 && !this.swarm;
    this.actions.watch(this.watched);
  }

  addFrame(frame) {
    for (const card of this.cards) card.addFrame(frame);
  }

  addDetails({ time_s: time, entities }) {
    for (const details of entities) for (const card of this.cards) if (card.entity === details.entity) card.addDetails(time, details);
  }

  // Shows the computed status of robots at the requested tick, or why it cannot be computed.
  addInside({ entities, error }) {
    if (error) for (const card of this.cards) if (this.world.isRobot(card.entity)) card.tell(error);
    this.addDetails({ time_s: null, entities });
  }

  // `on`: the shown state is of the past from now on. Plots then end at the shown tick.
  lookBack(on) {
    if (on === this.past) return;
    this.past = on;
    for (const card of this.cards) card.lookBack(on);
    for (const plot of this.swarm?.allPlots ?? []) plot.lookBack(on);
  }

  get plots() {
    return new Set([...this.cards.flatMap((card) => [...card.plots.values()]), ...(this.swarm?.allPlots ?? [])]);
  }
  get hasPlots() {
    return this.plots.size > 0;
  }
  get entitiesOfAttributePlots() {
    return this.cards.filter((card) => [...card.plots.keys()].some((key) => key.startsWith("a."))).map(({ entity }) => entity);
  }
  get plotsWhole() {
    return [...this.plots].some((plot) => plot.whole);
  }

  // Clears the plots for the states of the past, which addPast brings in the order of time.
  beginPast() {
    for (const plot of this.plots) plot.clear();
    for (const card of this.cards) card.last = null;
  }

  // Shows the speed at the shown tick, which the states before it tell.
  endPast() {
    for (const card of this.cards) if (this.world.slots[card.entity] >= 0 && card.last) card.rows.get("pose.speed").number(card.speed);
  }

  addPast(frame, details) {
    for (const card of this.cards) card.addPast(frame, details?.find(({ entity }) => entity === card.entity));
  }

  draw() {
    for (const plot of this.plots) plot.draw();
  }
}
