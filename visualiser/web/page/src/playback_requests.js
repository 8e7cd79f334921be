// Requests ticks of the past, one at a time, and plays them. Requests wait meanwhile, and only the newest one is sent.
// While the shown tick is the wanted one, earlier ticks are requested, which trails and plots need.
const SILENCE_MS = 5000; // after this time, an answer is no longer expected

export class PlaybackRequests {
  // `actions`: ask(tick, isEarlier); ended() when playing reaches the last tick; earlier(): a tick that is needed beside the wanted
  // one, or null.
  constructor(actions) {
    this.actions = actions;
    this.wanted = null; // the requested tick; null: the present
    this.asked = null; // the tick whose answer is awaited
    this.isEarlier = false; // whether it was asked for trails and plots
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
    this.isShown = false;
    if (!this.waits(now)) this.ask(tick, now);
  }

  waits(now) {
    return this.asked !== null && now - this.askedAt < SILENCE_MS;
  }

  ask(tick, now, isEarlier = false) {
    Object.assign(this, { asked: tick, askedAt: now, isEarlier });
    this.actions.ask(tick, isEarlier);
  }

  // Handles the state of a tick, or the answer that it cannot be shown.
  answered(now) {
    if (!this.isEarlier && this.asked === this.wanted) this.isShown = true;
    this.asked = null;
    if (this.isOn && !this.isShown) this.ask(this.wanted, now);
  }

  // Requests an earlier tick if nothing else is needed.
  askEarlier(now) {
    if (!this.isOn || !this.isShown || this.waits(now)) return;
    const tick = this.actions.earlier();
    if (tick !== null) this.ask(tick, now, true);
  }

  play(on, now) {
    this.playing = on ? { tick: this.wanted, since: now } : null;
  }

  // Called for each picture. `last`: the newest tick; `pace`: ticks a second.
  advance(now, last, pace) {
    if (!this.playing || this.waits(now)) return;
    const tick = this.playing.tick + Math.floor(((now - this.playing.since) * pace) / 1000);
    if (tick >= last) this.actions.ended();
    else if (tick !== this.wanted) this.want(tick, now);
  }

  live() {
    this.wanted = this.asked = this.playing = null;
  }
}
