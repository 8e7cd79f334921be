// The tools over the picture, folded until the user opens them. Each is a button with its key, or a choice.
import { h } from "./dom.js";

export class Tools {
  // `groups`: a name, and elements or {name, label, key, title, act, control}. `control`: only for pages that may control
  // the run.
  constructor(groups) {
    this.buttons = {};
    const part = (tool) => {
      if (tool instanceof HTMLElement) return tool;
      const keyText = tool.key ? `  (${tool.key})` : "";
      const button = h("button.toggle", { title: `${tool.title}${keyText}`, "aria-pressed": tool.switches ? "false" : null, onclick: tool.act }, tool.label);
      button.dataset.control = tool.control ? "1" : "";
      this.buttons[tool.name] = button;
      return button;
    };
    this.element = h("details.tools", {}, h("summary", {}, "Tools"), ...groups.map(([name, ...tools]) => h("div.tool-group", { role: "group", "aria-label": name }, h("span.dim", {}, name), ...tools.map(part))));
    this.setControl("read-only");
  }

  set(name, on) {
    this.buttons[name]?.setAttribute("aria-pressed", String(on));
  }

  // A tool without anything to do is disabled.
  enable(name, on) {
    this.buttons[name].dataset.idle = on ? "" : "1";
    this.setControl(this.control);
  }

  // Hides tools that the page does not have, and groups without others.
  hide(...names) {
    for (const name of names) this.buttons[name].hidden = true;
    for (const group of this.element.querySelectorAll(".tool-group")) group.hidden = !group.querySelector("button:not([hidden]), select");
  }

  setControl(control) {
    this.control = control;
    for (const button of Object.values(this.buttons)) button.disabled = Boolean(button.dataset.idle) || (button.dataset.control !== "" && control !== "granted");
  }
}
