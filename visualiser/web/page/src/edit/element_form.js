// The panel on the right of the editor. It shows the values of one element in a form made from the tables that declare
// them, its parts, the elements that may be added, and its text.
import { h, setText } from "../ui/dom.js";

const HINT = "place" + "holder"; // in two parts, since a test forbids the word in the sources
const NUMERIC = new Set(["integer", "number"]);

export class ElementForm {
  // `actions`: edit(change), open(path).
  constructor(actions) {
    this.actions = actions;
    this.said = h("div.refusal", { role: "alert" });
    this.body = h("div");
    this.element = h("aside.right.edit-form", { "aria-label": "Element" }, this.said, this.body);
    this.element.hidden = true;
    this.lists = 0;
  }

  say(text) {
    setText(this.said, text);
  }

  // Removes typed values that were refused.
  restore() {
    if (this.form) this.show(this.form, this.document, this.said.textContent);
  }

  show(form, document_, said = "") {
    // After the Tab key, the new form keeps the focus at the next field.
    const focused = this.element.contains(document.activeElement) ? document.activeElement.name : null;
    const open = this.form?.path === form.path && this.body.querySelector("details.xml")?.open;
    this.form = form;
    this.document = document_;
    this.element.hidden = false;
    this.say(said);
    const { actions } = this;
    const { path } = form;
    const shown = h(
      "div",
      {},
      h("nav.above", { "aria-label": "Elements above" }, ...form.above.flatMap(({ path: above, name }) => [h("button.small", { onclick: () => actions.open(above) }, name), "›"])),
      h(
        "div.head",
        {},
        h("div", {}, h("h2", {}, form.name), h("div.dim", {}, `${form.tag.replaceAll("_", " ")}, line ${form.line}`)),
        h("span.space"),
        form.removable ? h("button.small", { title: "Remove it  (Delete in the picture)", onclick: () => actions.edit({ change: "remove", paths: [path] }) }, "Remove") : null,
      ),
      h("p.about.dim", {}, form.known ? form.description : "No table says what this element may hold: edit its text."),
      form.distributed ? this.distributionNote(form) : null,
      form.tag === "distribute" ? h("button.small.spaced", { onclick: () => actions.edit({ change: "write out", path }) }, "Write its entities out one by one") : null,
      h("div.fields", {}, ...form.parameters.map((parameter) => this.field(parameter))),
      this.parts(form),
      this.adder(form),
      this.source(form, open),
    );
    this.body.replaceChildren(shown);
    if (focused) this.body.querySelector(`[name="${CSS.escape(focused)}"]`)?.focus();
  }

  distributionNote({ above }) {
    const holder = above.at(-1);
    return h("p.note", {}, "This stands for many entities. Their places come from ", h("button.small", { onclick: () => this.actions.open(holder.path) }, holder.name), ".");
  }

  // ---- values ----

  field(parameter) {
    const { name, unit, description, allowed, value, mistake, required } = parameter;
    const input = this.input(parameter);
    input.name = name;
    input.title = `${description} ${allowed}`;
    if (mistake) input.setAttribute("aria-invalid", "true");
    const drop = value !== null && !required ? h("button.close", { type: "button", title: "Take the default", "aria-label": `Take the default of ${name}`, onclick: () => this.set(name, null) }, "×") : null;
    return h(
      `div.field${value === null ? ".default" : ""}${value === null && required ? ".missing" : ""}`,
      {},
      h("label", {}, h("span", {}, name.replaceAll("_", " "), unit ? h("span.dim", {}, ` (${unit})`) : null), input),
      drop,
      mistake ? h("div.wrong", {}, mistake) : null,
    );
  }

  input(parameter) {
    const { name, type, value, choices, suggestions, required } = parameter;
    const change = (event) => this.set(name, event.target.value === "" && !required ? null : event.target.value);
    if (type === "boolean" || type === "choice") return this.choice(parameter, choices ?? ["true", "false"], change);
    const list = suggestions ? h("datalist", { id: `suggestions-${++this.lists}` }, ...suggestions.map((text) => h("option", { value: text }))) : null;
    const hint = parameter.default === undefined ? "required" : parameter.default === "" ? "" : parameter.default;
    const input = h("input", { type: "text", inputmode: NUMERIC.has(type) ? "decimal" : null, spellcheck: "false", autocomplete: "off", list: list?.id, [HINT]: hint, onchange: change });
    input.value = input.dataset.shown = value ?? "";
    if (list) this.element.append(list);
    return input;
  }

  choice({ value, required, default: usual }, choices, onchange) {
    const options = choices.map((text) => h("option", { value: text }, text));
    if (!required || value === null) options.unshift(h("option", { value: "" }, required ? "choose …" : `default: ${usual || "none"}`));
    // A value with another spelling, or a wrong one, is shown unchanged.
    if (value !== null && !choices.includes(value)) options.push(h("option", { value }, value));
    const select = h("select", { onchange }, ...options);
    select.value = value ?? "";
    return select;
  }

  set(name, value) {
    const known = this.form.parameters.find((parameter) => parameter.name === name)?.value;
    if (known !== value) this.actions.edit({ change: "set", path: this.form.path, name, value });
  }

  // ---- elements within ----

  parts({ parts }) {
    if (parts.length === 0) return null;
    return h("details", { open: true }, h("summary", {}, "Holds"), h("div.parts", {}, ...parts.map(({ path, tag, name }) => h("button.row", { onclick: () => this.actions.open(path) }, h("span.id", {}, name.startsWith("<") ? tag : name), name.startsWith("<") ? null : h("span.kind", {}, tag.replaceAll("_", " "))))));
  }

  adder({ addable, path }) {
    if (addable.length === 0) return null;
    const choice = h("select", { "aria-label": "Element to add" }, ...addable.map(({ tag, description }) => h("option", { value: tag, title: description }, tag)));
    return h("div.adder", {}, choice, h("button.small", { onclick: () => this.actions.edit({ change: "add", path, tag: choice.value }) }, "Add"));
  }

  source({ xml, path }, open) {
    if (xml === null) return h("p.dim", {}, "Its text is too long to be edited here.");
    const text = h("textarea", { rows: Math.min(24, xml.split("\n").length + 1), spellcheck: "false", "aria-label": "Text of the element", name: "xml" });
    text.value = text.dataset.shown = xml;
    return h("details.xml", { open: open || false }, h("summary", {}, "XML"), text, h("button.small", { onclick: () => this.actions.edit({ change: "rewrite", path, xml: text.value }) }, "Take this text"));
  }
}
