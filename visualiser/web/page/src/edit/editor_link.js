// The page of a run that the editor has started (docs/edit.md): its second connection, to the editor, and the buttons
// that go back, start the run again, and show scripts.
import { Connection } from "../connection.js";
import { proofOf } from "../token.js";
import { h, setText } from "../ui/dom.js";
import { ScriptPane } from "./script_pane.js";

export class EditorLink {
  // `page`: app, left, token, status(): of the run; leave(): goes to the editor; changed(run): called with the state of the
  // run; trouble(text).
  constructor(page) {
    this.page = page;
    this.token = page.token;
    this.challenge = null;
    this.leaves = false;
    this.back = h("button.toggle", { title: "End the run, and edit the experiment", onclick: () => this.leave() }, "Edit");
    this.again = h("button.toggle", { title: "Start the experiment again, as it is in the editor  (Ctrl + Enter)", onclick: () => this.pane.writeAndRun() }, "Run again");
    this.scripts = h("button.toggle", { title: "The scripts of the controllers", "aria-pressed": "false", hidden: true, onclick: () => this.pane.toggle() }, "Script");
    this.bar = h("div.group.edit-bar", {}, this.back, this.again, this.scripts);
    page.app.querySelector("header .space").before(this.bar);
    this.failure = h("div.mistakes", { role: "region", "aria-label": "Failure", tabindex: 0, hidden: true }); // it may scroll
    page.left.append(this.failure);
    this.pane = new ScriptPane({ app: page.app, ask: (request) => this.ask(request), run: () => this.run(), shown: (on) => this.scripts.setAttribute("aria-pressed", String(on)) });
    this.connection = new Connection({
      onOpen: () => {},
      onClose: () => this.setBusy(true),
      isOver: () => false,
      onText: (message) => this.receive(message),
      onFrame: () => {},
    });
    this.setBusy(true);
  }

  setBusy(busy) {
    this.again.disabled = busy;
  }

  ask(request) {
    this.connection.send(request);
  }

  prove(token = this.token) {
    this.token = token;
    if (this.token && this.challenge) this.ask({ do: "prove", proof: proofOf(this.token, this.challenge) });
  }

  receive(message) {
    const { type } = message;
    if (type === "welcome") {
      this.challenge = message.challenge ?? null;
      this.prove();
    } else if (type === "authority" && message.control === "granted") this.ask({ do: "document" });
    else if (type === "document") this.receiveDocument(message);
    else if (type === "script") this.pane.receiveText(message);
    else if (type === "reply" && !this.pane.refused(message.text)) this.page.trouble(message.text);
  }

  receiveDocument(document) {
    const { run, scripts } = document;
    if (this.leaves && ["none", "ending"].includes(run.phase)) return this.page.leave();
    this.setBusy(run.phase === "starting");
    setText(this.again, run.phase === "starting" ? "Starting …" : "Run again");
    this.scripts.hidden = scripts.length === 0;
    this.pane.receive(document);
    this.failure.hidden = run.failure === "";
    this.failure.replaceChildren(h("h2", {}, "The run has failed"), h("pre.mistake", {}, run.failure));
    this.page.changed(run);
  }

  // The pace stays. The server starts the text of the editor.
  run() {
    const status = this.page.status();
    this.ask({ do: "run", paused: status?.phase === "paused", speed: status?.speed_wanted ?? 1 });
  }

  // With unsaved changes of the script the user decides.
  leave() {
    if (this.pane.isDirty && !confirm("Leave the changes of the script that are not saved?")) return;
    this.pane.discard();
    if (!this.connection.isOpen) return this.page.leave();
    this.leaves = true;
    this.ask({ do: "end_run" });
  }

  // Returns true if the link has used the key.
  key(event) {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.key !== "Enter" || this.again.disabled) return false;
    event.preventDefault();
    this.pane.writeAndRun();
    return true;
  }
}
