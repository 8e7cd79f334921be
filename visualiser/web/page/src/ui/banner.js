// A line over the picture about the connection and the run: disconnected, waiting, ended, or started again.
import { h, setText } from "./dom.js";

const NEWS_MS = 5000;

export class Banner {
  // `state`: of the page; isLookingBack(): whether it shows the past; connect(): looks for the next start of the run.
  constructor(state, { isLookingBack, connect }) {
    this.state = state;
    this.isLookingBack = isLookingBack;
    this.message = h("span");
    this.again = h("button.small", { onclick: () => connect() }, "Look for its next start");
    this.element = h("div.banner", { role: "status" }, this.message, this.again);
    this.newsUntil = 0;
  }

  // Shows that the experiment was started again.
  itBegan() {
    this.newsUntil = Infinity;
    this.show();
  }

  show() {
    const { connected, status, endedHere } = this.state;
    const text = this.text();
    setText(this.message, text);
    this.again.hidden = connected || !endedHere;
    this.element.hidden = text === "";
    this.element.dataset.kind = connected || endedHere || status?.phase === "finished" ? "calm" : "trouble";
  }

  text() {
    const { connected, status, world, recorded, endedHere, failure } = this.state;
    if (recorded) return "";
    const ended = status?.phase === "finished";
    if (failure && !connected) return `The run has failed: ${failure.split("\n")[0]}`;
    if (endedHere && (ended || !connected) && !(connected && this.isLookingBack())) return "You have ended the run. This is its last state.";
    if (!connected && ended) return "The run has ended; this is its last state. Start the experiment again, and this page goes on.";
    if (connected && this.isLookingBack()) return "Looking back. Live, or Q, goes to the present.";
    if (!connected) return world ? "The connection is lost. Trying again; this is the last state." : "Waiting for the server.";
    if (ended) return `The run has ended${status.ended ? `: ${status.ended}` : ""}. This is its last state.`;
    if (status?.phase === "waiting") return "The run has not begun: it waits for its processes.";
    return this.newsLasts() ? "The experiment was started again." : "";
  }

  // Starts the display time of the message once no more urgent one is shown.
  newsLasts() {
    if (this.newsUntil === Infinity) {
      this.newsUntil = performance.now() + NEWS_MS;
      setTimeout(() => this.show(), NEWS_MS + 10);
    }
    return performance.now() < this.newsUntil;
  }
}
