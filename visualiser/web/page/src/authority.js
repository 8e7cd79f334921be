// Who may steer: what the server grants this page, and the token by which it proves that it may.
import { keepToken, proofOf, takeToken } from "./token.js";

export class Authority {
  // parts: state, toolbar, tools, inspector of the page; send(request)
  constructor(parts) {
    Object.assign(this, parts);
    this.token = takeToken();
    this.challenge = null;
  }

  // Of a connection that begins: what this page may do without a proof, and what one has to answer; null: nothing.
  welcome(control, challenge) {
    this.challenge = challenge;
    this.grant(control);
    this.prove();
  }

  grant(control) {
    const { state } = this;
    state.control = control;
    if (control === "granted") state.editor?.begin();
    for (const part of [this.toolbar, this.tools, this.inspector]) part.setControl(control);
  }

  // That this page has the token, without telling it.
  prove() {
    if (this.token && this.challenge) this.send({ do: "prove", proof: proofOf(this.token, this.challenge) });
  }

  unlock() {
    if (!this.challenge) return;
    const found = /[0-9a-f]{32}/.exec(prompt("The token, or the address that was printed with it") ?? "");
    if (!found) return;
    [this.token] = found;
    keepToken(this.token);
    this.prove();
  }

  // The address in the bar is another one.
  addressChanged() {
    const given = takeToken();
    if (given === this.token) return;
    this.token = given;
    this.prove();
  }
}
