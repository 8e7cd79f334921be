// Values of all robots from frames. They can colour robots and appear in plots of the swarm.
import { Flag } from "../protocol.js";
import { TRAILS } from "./look.js";

const DEGREES = 180 / Math.PI;
const JUMP_M = 0.5; // a longer way between two frames means that the robot was put there

const yawAt = (q, slot) => 2 * Math.atan2(q[4 * slot + 2], q[4 * slot + 3]);

// of(meter, slot) returns the value; undefined if it is unknown yet. `categories`: the value is one of several
// categories and has no mean.
export const robotValues = {
  speed: { unit: "m/s", of: ({ frame, before, elapsed }, slot) => (before ? step(frame, before, slot) / elapsed : undefined) },
  "turn rate": {
    unit: "°/s",
    of({ frame, before, elapsed }, slot) {
      if (!before) return undefined;
      const turned = yawAt(frame.quaternions, slot) - yawAt(before.quaternions, slot);
      return (Math.abs(Math.atan2(Math.sin(turned), Math.cos(turned))) * DEGREES) / elapsed;
    },
  },
  height: { unit: "m", of: ({ frame }, slot) => frame.positions[3 * slot + 2] },
  "distance from the middle": {
    unit: "m",
    of({ frame, world }, slot) {
      return Math.hypot(frame.positions[3 * slot] - world.arena[0] / 2, frame.positions[3 * slot + 1] - world.arena[1] / 2);
    },
  },
  "LEDs on": { unit: "", of: ({ frame }, slot) => Number((frame.colours[4 * slot + 3] & Flag.lit) !== 0) },
  grips: { unit: "", of: ({ frame }, slot) => Number((frame.colours[4 * slot + 3] & Flag.gripping) !== 0) },
  engine: { categories: true, of: ({ world }, slot) => world.engineOf[world.movable[slot]] },
  "controller host": { categories: true, of: ({ world }, slot) => world.hostOf[world.movable[slot]] },
  controller: { categories: true, of: ({ world }, slot) => world.controllerOf[world.movable[slot]] },
};

function step(frame, before, slot) {
  const [dx, dy, dz] = [0, 1, 2].map((k) => frame.positions[3 * slot + k] - before.positions[3 * slot + k]);
  const way = Math.hypot(dx, dy, dz);
  return way > JUMP_M ? 0 : way;
}

// The newest frame and the one before it, for rates.
export class Meter {
  constructor(world) {
    this.world = world;
    this.frame = this.before = null;
  }

  add(frame) {
    if (this.frame && frame.time <= this.frame.time) {
      if (frame.time < this.frame.time) this.before = null; // another run
      this.frame = frame;
      return;
    }
    this.before = this.frame;
    this.frame = frame;
    this.elapsed = this.before ? frame.time - this.before.time : 0;
  }

  // Returns the value of a robot; undefined if the robot is not in the arena, or the value is unknown yet.
  value(name, entity) {
    const slot = this.world.slots[entity];
    if (!this.frame || this.frame.colours[4 * slot + 3] & Flag.absent) return undefined;
    return robotValues[name].of(this, slot);
  }

  // Returns mean and standard deviation over robots; null if none has a value.
  statistics(name, entities) {
    let [count, sum, squares] = [0, 0, 0];
    for (const entity of entities) {
      const value = this.value(name, entity);
      if (value === undefined) continue;
      count++;
      sum += value;
      squares += value * value;
    }
    if (count === 0) return null;
    const mean = sum / count;
    return { count, mean, deviation: Math.sqrt(Math.max(0, squares / count - mean * mean)) };
  }
}

// The ramp goes from dark blue by green to yellow: matplotlib's viridis at quarters (https://bids.github.io/colormap/).
const RAMP = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];

// `share`: 0 to 1.
export function rampColour(share) {
  const place = Math.max(0, Math.min(1, share)) * (RAMP.length - 1);
  const low = Math.min(Math.floor(place), RAMP.length - 2);
  return RAMP[low].map((channel, k) => Math.round(channel + (place - low) * (RAMP[low + 1][k] - channel)));
}

// Colours robots by one of the values instead of by their LEDs.
export class Colouring {
  constructor(world, name) {
    this.world = world;
    this.name = name;
    this.low = Infinity;
    this.high = -Infinity;
  }

  // Returns the frame with other colours. The range grows with the values.
  apply(frame, meter) {
    const { categories } = robotValues[this.name];
    const values = this.world.robots.map((entity) => meter.value(this.name, entity));
    for (const value of values)
      if (value !== undefined) [this.low, this.high] = [Math.min(this.low, value), Math.max(this.high, value)];
    const colours = frame.colours.slice();
    this.world.robots.forEach((entity, i) => {
      const place = 4 * this.world.slots[entity];
      if (values[i] === undefined) return;
      const colour = categories ? categoryColour(values[i]) : rampColour((values[i] - this.low) / Math.max(this.high - this.low, 1e-9));
      colours.set(colour, place);
      colours[place + 3] = (colours[place + 3] | Flag.lit) & ~Flag.unevenRing;
    });
    return { ...frame, colours, rings: [] };
  }
}

export function categoryColour(number) {
  if (number < 0) return [120, 128, 138];
  const colour = TRAILS[number % TRAILS.length];
  return [(colour >> 16) & 255, (colour >> 8) & 255, colour & 255];
}
