// The page as an editor of an experiment file (docs/edit.md). It is loaded when the server says that it edits a file
// instead of showing a run. The server holds the text, makes the changes and checks the file. This module sends
// requests and shows the results.
import { h, setText } from "../ui/dom.js";
import { ElementForm } from "./element_form.js";
import { ScriptPane } from "./script_pane.js";

const LONGEST_REQUEST = 60000; // bytes; the server ends a connection with longer ones

export class Editor {
  // `page`: app, main, picture, left, send(request), choose(entities), showRun(): goes to the page of the run.
  constructor(page) {
    this.page = page;
    this.document = null;
    this.path = ""; // path of the element whose form is shown
    this.kind = null; // kind that the next click on the floor places
    this.many = false; // whether several elements are selected; then no form is shown
    this.waiting = []; // requests that wait for the answer to the previous one
    this.isBusy = false;
    this.form = new ElementForm({ edit: (change) => this.edit(change), open: (path) => this.open(path) });
    this.wantsRun = false; // whether the page goes to the run once its page is open
    this.pane = new ScriptPane({ app: page.app, ask: (request) => this.ask(request), run: () => this.startRun(), shown: (on) => this.scripts.setAttribute("aria-pressed", String(on)) });
    this.addBar();
    this.addPalette();
    this.mistakes = h("div.mistakes", { role: "region", "aria-label": "Mistakes", "aria-live": "polite", tabindex: 0 }); // it may scroll
    page.left.append(this.mistakes);
    page.app.classList.add("editing");
    page.app.append(this.form.element);
    page.picture.edits = true;
  }

  addBar() {
    const button = (label, title, act) => h("button.toggle", { title, onclick: act }, label);
    this.undo = button("Undo", "", () => this.ask({ do: "undo" }));
    this.redo = button("Redo", "", () => this.ask({ do: "redo" }));
    this.save = button("Save", "Write the file  (Ctrl + S)", () => this.ask({ do: "save" }));
    this.check = button("Check", "Make everything as a run does at its start, and throw it away", () => this.ask({ do: "check" }));
    this.run = button("Run", "Run the experiment as it is here, saved or not  (Ctrl + Enter)", () => this.pane.writeAndRun());
    this.runShown = button("Show the run", "", () => this.page.showRun());
    this.runEnd = button("End the run", "", () => this.ask({ do: "end_run" }));
    this.scripts = button("Script", "The scripts of the controllers", () => this.pane.toggle());
    this.scripts.setAttribute("aria-pressed", "false");
    this.file = h("span.file.dim");
    this.bar = h("div.group.edit-bar", {}, this.undo, this.redo, this.save, this.check, this.run, this.runShown, this.runEnd, this.scripts, this.file);
    this.page.app.querySelector("header .space").before(this.bar);
  }

  addPalette() {
    this.kinds = h("select", { "aria-label": "Kind of what is placed", onchange: () => this.arm(this.kinds.value || null) });
    this.palette = h("div.palette", {}, h("label", {}, "Place: ", this.kinds), (this.hint = h("span.dim", { role: "status" })));
    this.page.main.append(this.palette);
  }

  // ---- what the server tells ----

  // Starts once the token was proved, since the server does not answer before.
  begin() {
    this.isBusy = false;
    this.document = null; // another server may count from the start again
    this.page.send({ do: "document" });
    this.show(this.path);
  }

  receive(document) {
    const isNew = this.document?.revision !== document.revision;
    this.document = document;
    this.isBusy = false;
    if (document.added !== null && isNew) {
      this.path = document.added;
      this.many = false;
    }
    this.showBar();
    this.showRunButtons();
    this.pane.receive(document);
    this.showKinds();
    this.showMistakes();
    if (isNew) this.show(this.path);
    this.sendNext();
  }

  receiveScript(script) {
    this.isBusy = false;
    this.pane.receiveText(script);
    this.sendNext();
  }

  receiveForm(form) {
    this.path = form.path;
    this.form.show(form, this.document);
  }

  // Handles a refused request.
  refused(text) {
    this.isBusy = false;
    this.wantsRun = false;
    if (this.pane.refused(text)) return this.sendNext();
    this.form.say(text);
    // If the element is gone, the element above it is shown.
    if (/not there any more/.test(text)) this.open(this.path.split("/").slice(0, -1).join("/"));
    else this.form.restore();
    this.sendNext();
  }

  showBar() {
    const { undo, redo, saved, file, changed_on_disk: changed, mistakes, all_mistakes: all, checking, checked } = this.document;
    this.undo.disabled = undo === null;
    this.undo.title = undo === null ? "Nothing to undo" : `Undo: ${undo}  (Ctrl + Z)`;
    this.redo.disabled = redo === null;
    this.redo.title = redo === null ? "Nothing to do again" : `Do again: ${redo}  (Ctrl + Y)`;
    this.save.disabled = saved && !changed;
    this.check.disabled = checking || mistakes.some(({ kind }) => kind === "mistake");
    setText(this.check, checking ? "Checking …" : checked === "" ? "Checked ✓" : "Check");
    setText(this.file, `${file.split("/").at(-1)}${saved ? "" : " · not saved"}${all > 0 ? ` · ${all} mistake${all === 1 ? "" : "s"}` : ""}`);
    this.file.title = file;
    this.file.classList.toggle("unsaved", !saved);
    document.title = `${saved ? "" : "• "}${file.split("/").at(-1)} · Swarmanoid`;
  }

  showRunButtons() {
    const { run, scripts, mistakes } = this.document;
    const isThere = run.phase === "running";
    if (run.phase === "none") this.wantsRun &&= run.failure === "";
    this.run.disabled = run.phase === "starting" || mistakes.some(({ kind }) => kind === "mistake");
    setText(this.run, run.phase === "starting" ? "Starting …" : "Run");
    this.runShown.hidden = this.runEnd.hidden = !isThere;
    this.scripts.hidden = scripts.length === 0;
    if (!this.wantsRun || !isThere) return;
    this.wantsRun = false;
    this.page.showRun();
  }

  showKinds() {
    const tags = this.document.kinds.filter(({ tag }) => tag !== "distribute" && tag !== "reserve");
    const shown = JSON.stringify(tags);
    if (this.shownKinds === shown) return;
    this.shownKinds = shown;
    this.kinds.replaceChildren(
      h("option", { value: "" }, "nothing"),
      ...tags.map(({ tag, description }) => h("option", { value: tag, title: description }, tag.replaceAll("_", " "))),
    );
    this.kinds.value = this.kind ?? "";
  }

  showMistakes() {
    const { mistakes, checked, hidden, changed_on_disk: changed, run } = this.document;
    const { failure } = run;
    const notes = mistakes.filter(({ kind }) => kind === "note").length;
    const wrong = mistakes.length - notes;
    const title = wrong > 0 ? `Mistakes (${this.document.all_mistakes})` : notes > 0 ? `No mistakes, notes (${notes})` : "No mistakes";
    this.mistakes.replaceChildren(
      ...(changed
        ? [
            h(
              "div.mistake",
              { role: "alert" },
              h("span", {}, "The file has changed on the disk."),
              h("button.small", { title: "Undo brings your text back", onclick: () => this.ask({ do: "reload" }) }, "Read it again"),
              h("button.small", { onclick: () => this.ask({ do: "save", anyway: true }) }, "Save over it"),
            ),
          ]
        : []),
      h("h2", {}, title),
      ...(hidden ? [h("div.dim", {}, hidden)] : []),
      ...(checked ? [h("pre.mistake", {}, checked)] : []),
      ...(failure ? [h("h2", {}, "The run has failed"), h("pre.mistake", {}, failure)] : []),
      ...mistakes.map(({ kind, place, text, path }) =>
        h(`button.mistake.${kind}`, { title: "Show the element", onclick: () => this.open(path) }, h("b", {}, place.split("/").at(-1)), ` ${kind === "note" ? "note: " : ""}${text}`),
      ),
    );
  }

  // ---- what the user does ----

  startRun() {
    if (this.run.disabled) return;
    this.wantsRun = true;
    this.ask({ do: "run" });
  }

  edit(change) {
    this.ask({ do: "edit", ...change });
  }

  // Sends requests one after the other, since an edit refers to the text that the previous request has made.
  ask(request) {
    if (new TextEncoder().encode(JSON.stringify(request)).length > LONGEST_REQUEST) return this.form.say("This text is too long to be edited here.");
    this.waiting.push(request);
    this.sendNext();
  }

  sendNext() {
    if (this.isBusy || this.waiting.length === 0 || !this.document) return;
    this.isBusy = true;
    const request = this.waiting.shift();
    this.page.send(request.do === "edit" ? { ...request, revision: this.document.revision } : request);
  }

  open(path) {
    this.many = false;
    this.show(path);
  }

  show(path) {
    this.path = path;
    this.page.send({ do: "form", path });
    this.chooseShown();
  }

  // Selects the entities of the shown element in the picture.
  chooseShown() {
    if (!this.document || this.many) return;
    const number = this.document.paths.indexOf(this.path);
    const entities = number < 0 ? [] : this.document.path_of.flatMap((each, entity) => (each === number ? [entity] : []));
    this.page.choose(entities);
  }

  // Handles a click in the picture or the list.
  select(entity) {
    if (entity === null) return this.open(this.document?.arena ?? "");
    const path = this.pathOf(entity);
    if (path !== undefined) this.open(path);
  }

  pathOf(entity) {
    return this.document?.paths[this.document.path_of[entity]];
  }

  // `changes`: {entity, place: [x, y, z], yaw} for each entity.
  move(changes) {
    const places = changes.map(({ entity, place, yaw }) => ({ path: this.pathOf(entity), position: [...place], heading: (yaw * 180) / Math.PI }));
    if (places.every(({ path }) => path !== undefined)) this.edit({ change: "place", places });
  }

  remove() {
    const { picture } = this.page;
    const paths = [...new Set(picture.chosen.map((entity) => this.pathOf(entity)))];
    if (paths.length > 0) this.edit({ change: "remove", paths });
  }

  arm(kind) {
    this.kind = kind;
    this.kinds.value = kind ?? "";
    setText(this.hint, kind === null ? "" : "click on the floor (Esc ends)");
    this.page.main.classList.toggle("placing", kind !== null);
  }

  // Handles a click on the floor; returns true if it placed an entity.
  place(point) {
    if (this.kind === null || !point || !this.document || this.document.arena === null) return false;
    this.edit({ change: "add", path: this.document.arena, tag: this.kind, at: point.slice(0, 2).map((metres) => Math.round(metres * 1000) / 1000) });
    return true;
  }

  // Returns true if the editor has used the key.
  key(event) {
    const { tagName, value, dataset } = event.target;
    const typing = ["INPUT", "TEXTAREA"].includes(tagName) && value !== dataset.shown;
    const key = event.key.toLowerCase();
    if (event.key === "Escape" && this.kind !== null) this.arm(null);
    else if (!(event.ctrlKey || event.metaKey) || event.altKey) return false;
    else if (key === "enter") {
      document.activeElement?.blur(); // the typed text belongs to the experiment
      this.pane.writeAndRun();
    }
    else if (key === "s") {
      document.activeElement?.blur(); // the typed text belongs to the change
      this.ask({ do: "save" });
    } else if (typing) return false; // a field undoes its own typed text
    else if (key === "z") this.ask({ do: event.shiftKey ? "redo" : "undo" });
    else if (key === "y") this.ask({ do: "redo" });
    else return false;
    event.preventDefault();
    return true;
  }
}
