// The rights to control the run: the grant of the server for this page, and the token by which the page proves its
// right.
import { keepToken, proofOf, takeToken } from "./token.js";

export class Authority {
  // `parts`: state, toolbar, tools, inspector of the page, and send(request). `token`: the known one, or null.
  // editorLink(): the connection to the editor that has started the run, or null. The users' token is then the editor's.
  constructor(parts) {
    Object.assign(this, parts);
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

  use(token) {
    this.token = token;
    this.prove();
  }

  unlock() {
    const link = this.editorLink();
    if (!this.challenge && !link) return;
    const found = /[0-9a-f]{32}/.exec(prompt("The token, or the address that was printed with it") ?? "");
    if (!found) return;
    keepToken(found[0]);
    if (link) return link.prove(found[0]);
    this.use(found[0]);
  }

  // Handles another address in the address bar.
  addressChanged() {
    const given = takeToken();
    const link = this.editorLink();
    if (given === (link ?? this).token) return;
    if (link) return link.prove(given);
    this.use(given);
  }
}
