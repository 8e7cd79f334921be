// The states before the shown tick of the past, for trails and plots. They are requested one by one, the missing ones
// first, and kept while they are near. Playing forward adds the shown states.
const MOST_STATES = 240; // before the shown one
const WINDOW_S = 60; // for plots of the last minute, and trails
const KEPT_BYTES = 32e6;
const FEWEST_KEPT = 60;
const STATE_BYTES = 24; // of an entity
const SHOW_AGAIN_MS = 150;

export class PastHistory {
  // `parts`: picture, inspector, timeline of the page; world(); countSwarm(frame): adds it to the plots of the swarm.
  constructor(parts) {
    Object.assign(this, parts);
    this.clear();
  }

  clear() {
    this.states = new Map(); // by tick: {frame, details}
    this.tick = null; // the shown one
    this.shownAt = 0;
    this.isStale = false;
  }

  get isNeeded() {
    const { trails, colouring, heat } = this.picture;
    return trails.on || colouring !== null || heat !== null || this.inspector.hasPlots;
  }

  // Returns the first tick of the window, and the ticks between two states. The second is a power of two, so that kept
  // states stay useful while the window grows.
  window() {
    const { first, step: recorded = 1, last } = this.timeline;
    const seconds = this.world().tickSeconds;
    const isWhole = this.picture.heat !== null || this.inspector.plotsWhole;
    const length = isWhole ? last - first : Math.min(last - first, Math.ceil(WINDOW_S / seconds));
    const begin = Math.max(first, this.tick - length);
    const most = Math.max(8, Math.min(MOST_STATES, this.mostKept / 2));
    return { begin, step: recorded * 2 ** Math.max(0, Math.ceil(Math.log2(length / recorded / most))) };
  }

  get mostKept() {
    return Math.max(FEWEST_KEPT, Math.floor(KEPT_BYTES / STATE_BYTES / Math.max(1, this.world().movable.length)));
  }

  // Returns the tick of a missing state; null: none is missing.
  missing() {
    if (this.tick === null || !this.isNeeded) return null;
    const { begin, step } = this.window();
    const entities = this.inspector.entitiesOfAttributePlots;
    const suits = (state) => state === null || entities.every((entity) => state.details?.some((each) => each.entity === entity));
    const parts = new Set([...this.states].filter(([, state]) => suits(state)).map(([tick]) => Math.floor(tick / step)));
    for (let part = Math.ceil(begin / step); part * step < this.tick; part++) if (!parts.has(part)) return part * step;
    return null;
  }

  // Takes a state of the past. `isShown`: it is the wanted one; otherwise it was requested for this object. `isPlayed`:
  // it follows the one before in playing.
  add(frame, details, { isShown, isPlayed, now }) {
    this.states.set(frame.tick, { frame, details });
    if (!isShown) {
      this.isStale = true;
      if (now - this.shownAt > SHOW_AGAIN_MS || this.missing() === null) this.show(now);
      return;
    }
    const before = this.tick;
    this.tick = frame.tick;
    this.forget();
    // A played state is added at once. The states that playing has left out are not requested.
    if (isPlayed && before !== null && frame.tick > before && !this.isStale) {
      const { step } = this.window();
      for (let part = Math.floor(before / step) + 1; part < Math.floor(frame.tick / step); part++) this.states.set(part * step, null);
      this.use({ frame, details });
      this.picture.endPast();
      this.inspector.endPast();
    } else this.show(now);
  }

  // Drops the states that are farthest from the shown one.
  forget() {
    if (this.states.size <= this.mostKept) return;
    const far = [...this.states.keys()].sort((a, b) => Math.abs(b - this.tick) - Math.abs(a - this.tick));
    for (const tick of far.slice(0, this.states.size - Math.floor(0.8 * this.mostKept))) this.states.delete(tick);
  }

  // Gives trails and plots all states up to the shown one.
  show(now = performance.now()) {
    if (this.tick === null) return;
    this.shownAt = now;
    this.isStale = false;
    const { begin } = this.window();
    const ticks = [...this.states.keys()].filter((tick) => tick >= begin && tick <= this.tick && this.states.get(tick)).sort((a, b) => a - b);
    this.picture.beginPast();
    this.inspector.beginPast();
    for (const tick of ticks) this.use(this.states.get(tick));
    this.picture.endPast();
    this.inspector.endPast();
  }

  use({ frame, details }) {
    this.picture.addPast(frame);
    this.inspector.addPast(frame, details);
    this.countSwarm(frame);
  }
}
