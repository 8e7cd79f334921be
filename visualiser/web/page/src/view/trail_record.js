// The recent positions of all robots: the last samples in a ring, for either view.

export const JUMP_M = 0.5; // a longer way between two samples means that the robot was put there

export class TrailRecord {
  constructor(world) {
    this.world = world;
    const count = Math.max(1, world.robots.length);
    this.capacity = Math.max(12, Math.min(240, Math.floor(300000 / count)));
    this.places = new Float32Array(this.capacity * 3 * count);
    this.period = Math.max(world.tickSeconds, world.robots.length > 2000 ? 0.5 : 0.2);
    this.on = false;
    this.clear();
  }

  clear() {
    this.added = 0; // samples since the start; the last `capacity` of them are kept
    this.lastTime = -Infinity;
    this.beginnings = (this.beginnings ?? 0) + 1; // a view with another count starts again
  }

  // Keeps the samples while others are recorded, those of the past.
  keep() {
    const { places, added, lastTime } = this;
    this.kept = { places, added, lastTime };
    this.places = new Float32Array(places.length);
    this.clear();
  }

  restore() {
    Object.assign(this, this.kept);
    this.kept = null;
    this.beginnings++;
  }

  // Returns x, y, z of all robots.
  sample(number) {
    const length = 3 * this.world.robots.length;
    return this.places.subarray((number % this.capacity) * length, (number % this.capacity) * length + length);
  }

  get first() {
    return Math.max(0, this.added - this.capacity);
  }

  add(frame) {
    if (!this.on) return;
    if (frame.time < this.lastTime) this.clear();
    if (frame.time - this.lastTime < this.period - 1e-9) return;
    this.lastTime = frame.time;
    const now = this.sample(this.added);
    const { robots, slots } = this.world;
    for (let i = 0; i < robots.length; i++)
      for (let k = 0; k < 3; k++) now[3 * i + k] = frame.positions[3 * slots[robots[i]] + k];
    this.added++;
  }
}

export function jumped(from, to, i) {
  return Math.abs(to[3 * i] - from[3 * i]) + Math.abs(to[3 * i + 1] - from[3 * i + 1]) > JUMP_M;
}
