// The rights to control the run: the grant of the server for this page, and the token by which the page proves its
// right.
import { keepToken, proofOf, takeToken } from "./token.js";

export class Authority {
  // `parts`: state, toolbar, tools, inspector of the page, and send(request).
  constructor(parts) {
    Object.assign(this, parts);
    this.token = takeToken();
    this.challenge = null;
  }

  // Handles a new connection: the rights of this page without a proof, and the challenge to answer; null: none.
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

  // Proves that this page has the token, without sending it.
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

  // Handles another address in the address bar.
  addressChanged() {
    const given = takeToken();
    if (given === this.token) return;
    this.token = given;
    this.prove();
  }
}
