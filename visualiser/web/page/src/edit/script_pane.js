// The scripts, in Lua or Python, of the experiment beside the picture: text, line numbers, and the line of an error.
import { h, setText } from "../ui/dom.js";

const LONGEST_SCRIPT = 60000; // bytes of a request; the server ends a connection with longer ones

// Returns the line and the text of an error about a script in a message, or null. `name`: of the script.
export function errorIn(failure, name) {
  const file = name.split("/").at(-1).replaceAll(/[.*+?^${}()|[\]\\]/g, "\\$&");
  const found = new RegExp(`(?:^|[^\\w-])${file}:(\\d+): ?(.*)`, "m").exec(failure);
  return found && { line: Number(found[1]), text: found[2] };
}

export class ScriptPane {
  // `page`: app, ask(request), run(): starts the experiment again; shown(open).
  constructor(page) {
    this.page = page;
    this.scripts = [];
    this.file = null;
    this.read = ""; // the text as it was read or saved
    this.after = null; // what follows the answer to a request
    this.error = null;
    this.choice = h("select", { "aria-label": "Script", onchange: () => this.open(this.choice.value) });
    this.save = h("button.small", { title: "Write the script  (Ctrl + S)", onclick: () => this.write() }, "Save");
    this.runs = h("button.small", { title: "Write the script, and start the run again  (Ctrl + Enter)", onclick: () => this.writeAndRun() }, "Save and run");
    this.over = h("button.small", { hidden: true, onclick: () => this.write(this.after, true) }, "Save over it");
    this.again = h("button.small", { hidden: true, onclick: () => this.open(this.file) }, "Read it again");
    this.said = h("button.script-error", { role: "alert", title: "Go to the line", onclick: () => this.goToError() });
    this.lines = h("pre.script-lines", { "aria-hidden": "true" });
    this.band = h("div.script-band", { hidden: true });
    this.text = h("textarea", {
      spellcheck: "false",
      wrap: "off",
      autocomplete: "off",
      "aria-label": "Text of the script",
      title: "Tab indents; Esc, then Tab, leaves",
      oninput: () => this.changed(),
      onscroll: () => this.place(),
      onkeydown: (event) => this.key(event),
    });
    this.element = h(
      "aside.script-pane",
      { "aria-label": "Script", hidden: true },
      h("div.head", {}, this.choice, this.save, this.runs, h("span.space"), h("button.close", { title: "Close", "aria-label": "Close the script", onclick: () => this.toggle(false) }, "×")),
      this.said,
      h("div.script-again", {}, this.again, this.over),
      h("div.script-text", {}, this.band, this.lines, this.text),
    );
    page.app.append(this.element);
    // The text is only in this page until it is saved.
    window.addEventListener("beforeunload", (event) => this.isDirty && event.preventDefault());
  }

  get isDirty() {
    return this.text.value !== this.read;
  }

  // Forgets changes that are not saved.
  discard() {
    this.read = this.text.value;
  }

  toggle(on = this.element.hidden) {
    this.element.hidden = !on;
    this.page.app.classList.toggle("scripting", on);
    this.page.shown(on);
    if (on && this.file === null && this.scripts.length > 0) this.open(this.scripts[0].file);
    if (on) this.text.focus();
  }

  // Shows the scripts of a document of the server, and the error of its last run.
  receive({ scripts, run }) {
    const shown = JSON.stringify(scripts);
    if (this.shown !== shown) {
      this.shown = shown;
      this.scripts = scripts;
      this.choice.replaceChildren(...scripts.map(({ name, file }) => h("option", { value: file, title: file }, name)));
      if (!scripts.some(({ file }) => file === this.file) && !this.isDirty) this.file = null;
      if (this.file === null && !this.element.hidden && scripts.length > 0) this.open(scripts[0].file);
      this.choice.value = this.file ?? "";
    }
    if (run.failure === this.failure) return;
    this.failure = run.failure;
    // The pane opens with the script in which the run has failed.
    const failed = this.scripts.find(({ name }) => errorIn(this.failure, name));
    if (failed && failed.file !== this.file && !this.isDirty) this.open(failed.file);
    if (failed && this.element.hidden) this.toggle(true);
    this.showError();
  }

  open(file) {
    if (this.isDirty && this.file !== null && file !== this.file && !confirm("Leave the changes that are not saved?")) {
      this.choice.value = this.file;
      return;
    }
    this.ask({ do: "script", file }, null);
  }

  write(after = null, anyway = false) {
    if (this.file === null) return;
    const request = { do: "save_script", file: this.file, text: this.text.value, anyway };
    if (new TextEncoder().encode(JSON.stringify(request)).length > LONGEST_SCRIPT) return this.say("This script is too long to be saved here.");
    this.ask(request, after);
  }

  writeAndRun() {
    const run = () => this.page.run();
    if (this.isDirty) this.write(run);
    else run();
  }

  ask(request, after) {
    this.asked = request;
    this.after = after;
    this.page.ask(request);
  }

  // Handles the text that was read or saved.
  receiveText({ file, text }) {
    const { asked, after } = this;
    this.asked = this.after = null;
    this.read = text;
    // What the user has typed since Save stays.
    if (asked?.do !== "save_script" || file !== this.file) this.text.value = text;
    this.file = file;
    this.choice.value = file;
    this.over.hidden = this.again.hidden = true;
    this.say("");
    this.changed();
    this.showError();
    after?.();
  }

  // Handles a refused request. Returns true if it was one of this pane.
  refused(text) {
    if (!this.asked) return false;
    this.over.hidden = this.again.hidden = !/another program/.test(text);
    this.asked = null;
    this.choice.value = this.file ?? "";
    this.say(text);
    return true;
  }

  say(text) {
    setText(this.said, text);
    this.said.hidden = text === "";
  }

  showError() {
    const script = this.scripts.find(({ file }) => file === this.file);
    this.error = script ? errorIn(this.failure ?? "", script.name) : null;
    if (this.error) this.say(`Line ${this.error.line}: ${this.error.text}`);
    else if (/^Line \d+: /.test(this.said.textContent)) this.say("");
    this.number();
    if (this.error) this.goToError(false);
  }

  goToError(focus = true) {
    if (!this.error) return;
    const before = this.text.value.split("\n").slice(0, this.error.line - 1).join("\n").length;
    const start = this.error.line > 1 ? before + 1 : 0;
    if (focus) this.text.focus();
    this.text.setSelectionRange(start, start);
    this.text.scrollTop = Math.max(0, (this.error.line - 4) * this.lineHeight);
    this.place();
  }

  changed() {
    const { isDirty } = this;
    this.save.disabled = !isDirty;
    setText(this.runs, isDirty ? "Save and run" : "Run");
    this.element.classList.toggle("unsaved", isDirty);
    this.number();
  }

  // Writes the line numbers.
  number() {
    const count = this.text.value.split("\n").length;
    if (this.lines.childElementCount !== count) this.lines.replaceChildren(...Array.from({ length: count }, (_, i) => h("span", {}, `${i + 1}\n`)));
    for (const wrong of this.lines.querySelectorAll(".wrong")) wrong.classList.remove("wrong");
    if (this.error) this.lines.children[this.error.line - 1]?.classList.add("wrong");
    this.place();
  }

  get lineHeight() {
    return parseFloat(getComputedStyle(this.text).lineHeight);
  }

  // Moves the numbers and the mark with the text.
  place() {
    this.lines.style.transform = `translateY(${-this.text.scrollTop}px)`;
    this.band.hidden = !this.error;
    if (this.error) this.band.style.transform = `translateY(${(this.error.line - 1) * this.lineHeight - this.text.scrollTop}px)`;
  }

  key(event) {
    const isCommand = (event.ctrlKey || event.metaKey) && !event.altKey;
    if (isCommand && event.key === "Enter") this.writeAndRun();
    else if (isCommand && event.key.toLowerCase() === "s") this.write();
    else if (event.key === "Tab" && !event.shiftKey && !isCommand) document.execCommand("insertText", false, "  "); // the browser can undo it
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
