// Looking back: asks the server for ticks of the past, one at a time, and plays them. What is wanted meanwhile waits, and
// only the newest of it is asked for.
const SILENCE_MS = 5000; // after which an answer is given up

export class Past {
  // actions: ask(tick), shown(tick), ended() when the present is reached
  constructor(actions) {
    this.actions = actions;
    this.wanted = null; // the tick that is looked at; null: the present
    this.asked = null; // the one of which the answer is awaited
    this.playing = null; // {tick, since}: where it began, and when
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

  // The state of a tick has come, or nothing can be shown of it.
  answered(now) {
    const { asked } = this;
    this.asked = null;
    if (this.isOn && this.wanted !== asked) this.ask(now);
  }

  play(on, now) {
    this.playing = on ? { tick: this.wanted, since: now } : null;
  }

  // Of each picture. last: the newest tick; pace: ticks a second
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
