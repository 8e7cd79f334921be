// The bar at the top: the experiment, its clock and pace, the controls, and the view options.
import { choices } from "../view/quality_levels.js";
import { clockText, h, icon, setText } from "./dom.js";

const SPEEDS = [0.25, 0.5, 1, 2, 5, 10, 50, 0];

export class Toolbar {
  // `actions`: command(request), toggle(name), help(), top(), fit(), quality(name), plan(), list(), unlock().
  constructor(actions) {
    this.actions = actions;
    this.name = h("span.name", {}, "Swarmanoid");
    this.phase = h("span.pill", { role: "status" }, "connecting");
    this.clock = h("span.number", { title: "Simulated time" });
    this.tick = h("span.number.dim", { title: "Tick of the picture" });
    this.pace = h("span.number.dim.pace", { title: "Simulated seconds in a second" });
    this.pause = h("button.icon", { onclick: () => actions.command({ do: this.isPaused ? "resume" : "pause" }) }, icon("pause"));
    this.step = h("button.icon", { title: "One tick  (N)", "aria-label": "One tick", onclick: () => actions.command({ do: "step", ticks: 1 }) }, icon("step"));
    this.speed = h(
      "select",
      { title: "Speed", "aria-label": "Speed", onchange: () => actions.command({ do: "speed", factor: Number(this.speed.value) }) },
      ...SPEEDS.map((factor) => h("option", { value: factor }, factor === 0 ? "max" : `${factor}×`)),
    );
    this.stop = h(
      "button.icon",
      {
        title: "End the run",
        "aria-label": "End the run",
        onclick: () => confirm("End the run? Its last state stays.") && actions.command({ do: "stop" }),
      },
      icon("stop"),
    );
    this.reset = h(
      "button.icon",
      {
        title: "Begin again at tick 0",
        "aria-label": "Begin again at tick 0",
        onclick: () => confirm("Begin the run again at tick 0, with the same seed?") && actions.command({ do: "reset" }),
      },
      icon("reset"),
    );
    this.lock = h("button.lock", { onclick: () => actions.unlock() }, "read-only");
    this.toggles = {};
    const toggle = (name, label, key) => {
      const button = h("button.toggle", { title: `${label}  (${key.toUpperCase()})`, "aria-pressed": "false", onclick: () => actions.toggle(name) }, label);
      this.toggles[name] = button;
      return button;
    };
    this.list = h("button.list-button", { title: "Entities  (F3)", "aria-label": "Entities", "aria-expanded": "false", onclick: () => actions.list() }, "☰");
    this.quality = h(
      "select.quality",
      { "aria-label": "Quality of the picture", onchange: () => actions.quality(this.quality.value) },
      ...choices.map((name) => h("option", { value: name }, name)),
    );
    this.element = h(
      "header",
      {},
      h("div.group.title", {}, this.list, h("img.logo", { src: document.querySelector?.("link[rel=icon]")?.href ?? "favicon.svg", alt: "" }), this.name, this.phase),
      h("div.group", {}, this.clock, this.tick, this.pace),
      h("div.group.controls", {}, this.pause, this.step, this.speed, this.stop, this.reset, this.lock),
      h("div.space"),
      (this.views = h(
        "div.group.views",
        {},
        toggle("ids", "Ids", "i"),
        toggle("trails", "Trails", "l"),
        toggle("beams", "Beams", "b"),
        toggle("shadows", "Shadows", "s"),
        this.quality,
        (this.plan = h("button.toggle", { title: "Plan view: from above, quick without a graphics card  (V)", "aria-pressed": "false", onclick: () => actions.plan() }, "Plan")),
        (this.top = h("button.toggle", { title: "From above  (End)", onclick: () => actions.top() }, "Top")),
        h("button.toggle", { title: "The whole arena  (Home)", onclick: () => actions.fit() }, "Fit"),
        h("button.toggle", { title: "Keys  (F1)", "aria-label": "Keys", onclick: () => actions.help() }, "?"),
      )),
    );
    this.setControl("read-only");
  }

  setList(open) {
    this.list.setAttribute("aria-expanded", String(open));
  }

  // `wanted`: the user's choice; `chosen`: the drawn quality.
  setQuality(wanted, chosen) {
    this.quality.value = wanted;
    const [auto] = this.quality.options;
    setText(auto, wanted === "auto" ? `auto: ${chosen}` : "auto");
    this.quality.title = "Quality of the picture; auto follows the speed of this machine";
    this.plan.setAttribute("aria-pressed", String(chosen === "plan"));
    this.top.hidden = this.toggles.shadows.hidden = chosen === "plan";
  }

  setToggle(name, on) {
    this.toggles[name]?.setAttribute("aria-pressed", String(on));
  }

  // `control`: "granted", "token needed", "wrong token" or "read-only".
  setControl(control) {
    const granted = control === "granted";
    for (const element of [this.pause, this.step, this.speed, this.stop, this.reset]) element.disabled = !granted;
    this.lock.hidden = granted || this.pause.hidden;
    setText(this.lock, control === "read-only" || control === "granted" ? "read-only" : control);
    this.lock.title = {
      "read-only": "This page may only look. Start it with --allow-control to steer the run.",
      "token needed": "Only the address with the token, as it was printed, may steer the run. Click to give it.",
      "wrong token": "That is not the token of this server. Click to give the one of the address that was printed last.",
      granted: "",
    }[control];
  }

  // For a run that the page itself has, and nobody can steer.
  setRecorded() {
    for (const element of [this.pause, this.step, this.speed, this.stop, this.reset, this.lock]) element.hidden = true;
  }

  setWorld(world) {
    setText(this.name, world.experiment);
    this.world = world;
  }

  setFrame(frame) {
    setText(this.clock, clockText(frame.time));
    const last = this.world?.lastTick;
    setText(this.tick, last ? `tick ${frame.tick} of ${last}` : `tick ${frame.tick}`);
  }

  setStatus(status, connected) {
    const phase = connected ? status?.phase ?? "connecting" : "disconnected";
    this.isPaused = phase === "paused";
    setText(this.phase, phase === "unknown" ? "running" : phase);
    this.phase.dataset.phase = phase;
    const shape = this.isPaused ? "resume" : "pause";
    if (this.pause.dataset.shape !== shape) this.pause.replaceChildren(icon(shape));
    this.pause.dataset.shape = shape;
    this.pause.title = this.isPaused ? "Go on  (space)" : "Pause  (space)";
    this.pause.setAttribute("aria-label", this.isPaused ? "Go on" : "Pause");
    if (!status) return;
    const factor = status.real_time_factor;
    setText(this.pace, factor > 0 ? `${factor >= 100 ? factor.toFixed(0) : factor.toPrecision(2)}× real time` : "");
    if (document.activeElement !== this.speed) {
      const wanted = String(status.speed_wanted);
      if (![...this.speed.options].some((option) => option.value === wanted))
        this.speed.append(h("option", { value: wanted }, `${Number(status.speed_wanted.toPrecision(3))}×`));
      if (this.speed.value !== wanted) this.speed.value = wanted;
    }
  }
}
