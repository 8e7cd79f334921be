// Requests ticks of the past from the server, one at a time, and plays them. Requests wait meanwhile, and only the
// newest one is sent.
const SILENCE_MS = 5000; // after this time, an answer is no longer expected

export class Past {
  // `actions`: ask(tick), shown(tick), ended() when the present is reached.
  constructor(actions) {
    this.actions = actions;
    this.wanted = null; // the requested tick; null: the present
    this.asked = null; // the tick whose answer is awaited
    this.playing = null; // {tick, since}: the start of playing, and its time
  }

  get isOn() {
    return this.wanted !== null;
  }

  look(tick, now) {
    this.playing = null;
    this.want(tick, now);
  }

  want(tick, now) {
    this.wanted = tick;
    if (this.asked !== null && now - this.askedAt < SILENCE_MS) return;
    this.ask(now);
  }

  ask(now) {
    this.asked = this.wanted;
    this.askedAt = now;
    this.actions.ask(this.wanted);
  }

  // Handles the state of a tick, or the answer that it cannot be shown.
  answered(now) {
    const { asked } = this;
    this.asked = null;
    if (this.isOn && this.wanted !== asked) this.ask(now);
  }

  play(on, now) {
    this.playing = on ? { tick: this.wanted, since: now } : null;
  }

  // Called for each picture. `last`: the newest tick; `pace`: ticks a second.
  advance(now, last, pace) {
    if (!this.playing || (this.asked !== null && now - this.askedAt < SILENCE_MS)) return;
    const tick = this.playing.tick + Math.floor(((now - this.playing.since) * pace) / 1000);
    if (tick >= last) {
      this.live();
      this.actions.ended();
    } else if (tick !== this.wanted) this.want(tick, now);
  }

  live() {
    this.wanted = this.asked = this.playing = null;
  }
}
