// The tools over the picture, folded until the user opens them. Each is a button with its key, or a choice.
import { h } from "./dom.js";

export class Tools {
  // `groups`: lists of elements, or of {name, label, key, title, act, control}. `control`: only for pages that may
  // control the run.
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
    this.element = h("details.tools", {}, h("summary", {}, "Tools"), ...groups.map((tools) => h("div.tool-group", {}, ...tools.map(part))));
    this.setControl("read-only");
  }

  set(name, on) {
    this.buttons[name]?.setAttribute("aria-pressed", String(on));
  }

  setControl(control) {
    for (const button of Object.values(this.buttons)) button.disabled = button.dataset.control !== "" && control !== "granted";
  }
}
