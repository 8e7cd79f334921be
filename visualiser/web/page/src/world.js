// The page's knowledge of the experiment: the table of entities, which is fixed, and the newest state, which changes.
import { Flag } from "./protocol.js";

// A longer way between two frames is no motion: the entity was put there.
const JUMP_M = 0.5;

export class World {
  constructor(message) {
    this.experiment = message.experiment;
    this.arena = message.arena;
    this.tickSeconds = message.tick_seconds;
    this.lastTick = message.last_tick;
    this.engines = message.engines;
    this.hosts = message.hosts;
    this.controllers = message.controllers;
    this.attributes = message.attributes;
    this.bodies = message.bodies;
    this.viewpoints = message.viewpoints;
    this.reserves = message.reserves ?? []; // {id, first, count}: the entities of each reserve
    this.beginsAtViewpoint = message.begins_at_viewpoint;
    this.ids = message.entities.id;
    this.kinds = message.entities.kind.map((kind) => message.kinds[kind]);
    this.looks = message.looks; // by kind: its properties, and how it is drawn
    this.engineOf = message.entities.engine;
    this.hostOf = message.entities.host;
    this.controllerOf = message.entities.controller;
    this.meshes = message.meshes ?? []; // meshes of the bodies
    this.bodyOf = new Map(this.bodies.map((body) => [body.entity, body]));

    this.movable = []; // by index in a frame: the entity
    this.slots = new Int32Array(this.ids.length).fill(-1); // by entity: the index in a frame
    message.entities.movable.forEach((moves, entity) => {
      if (!moves) return;
      this.slots[entity] = this.movable.length;
      this.movable.push(entity);
    });
    this.robots = this.ids.map((_, entity) => entity).filter((entity) => this.isRobot(entity));
  }

  get size() {
    return this.ids.length;
  }
  look(entity) {
    return this.looks[this.kinds[entity]];
  }
  isRobot(entity) {
    return this.look(entity).role === "robot";
  }
  // Returns the height of the ground (m) at a position: that of a terrain, otherwise 0. Around the position the highest
  // cell counts, since a robot is as wide as some cells.
  groundAt(x, y) {
    const heights = this.bodies.flatMap((body) => (body.terrain ? [terrainHeight(body, x, y)] : [])).filter((height) => height !== null);
    return heights.length > 0 ? Math.max(...heights) : 0;
  }
  find(id) {
    return this.ids.indexOf(id);
  }
  engineName(entity) {
    const engine = this.engines[this.engineOf[entity]];
    return engine ? `${engine.id} (${engine.tag})` : "none";
  }
  hostName(entity) {
    return this.hostOf[entity] < 0 ? "none" : `controller host ${this.hostOf[entity]}`;
  }
  controllerName(entity) {
    const controller = this.controllers[this.controllerOf[entity]];
    return controller ? `${controller.id} (${controller.tag})` : "none";
  }
}

function terrainHeight({ position, orientation: [qx, qy, qz, qw], terrain: { low, high, columns, rows, heights } }, x, y) {
  const yaw = Math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz));
  const [dx, dy] = [x - position[0], y - position[1]];
  const inside = [dx * Math.cos(yaw) + dy * Math.sin(yaw), dy * Math.cos(yaw) - dx * Math.sin(yaw)];
  const cell = (k, count) => Math.floor(((inside[k] - low[k]) / (high[k] - low[k])) * count);
  const [column, row] = [cell(0, columns), cell(1, rows)];
  let top = null;
  for (let r = Math.max(row - 1, 0); r <= Math.min(row + 1, rows - 1); r++)
    for (let c = Math.max(column - 1, 0); c <= Math.min(column + 1, columns - 1); c++) {
      const height = heights[r * columns + c] ?? null;
      if (height !== null) top = Math.max(top ?? -Infinity, position[2] + height);
    }
  return column >= 0 && column < columns && row >= 0 && row < rows ? top : null;
}

// The drawn state between the last two frames.
export class Motion {
  constructor(count) {
    this.positions = new Float32Array(3 * count);
    this.quaternions = new Float32Array(4 * count);
    this.colours = new Uint8Array(4 * count);
    this.frame = null;
    this.previous = null;
    this.arrived = 0;
    this.interval = 33;
  }

  add(frame, now) {
    this.previous = this.frame;
    if (this.frame) this.interval = Math.min(250, 0.7 * this.interval + 0.3 * (now - this.arrived));
    this.frame = frame;
    this.arrived = now;
    this.colours = frame.colours;
    this.settled = false;
  }

  // Fills positions and quaternions for a moment (ms). Returns false if nothing has changed since the last call.
  sample(now) {
    const { frame, previous } = this;
    if (!frame || this.settled) return false;
    const blend = previous ? Math.min(1, (now - this.arrived) / Math.max(this.interval, 1)) : 1;
    this.settled = blend >= 1;
    const scale = 1 / 32767;
    if (blend >= 1) {
      this.positions.set(frame.positions);
      for (let i = 0; i < this.quaternions.length; i++) this.quaternions[i] = frame.quaternions[i] * scale;
      return true;
    }
    const [p0, p1, q0, q1] = [previous.positions, frame.positions, previous.quaternions, frame.quaternions];
    for (let i = 0; i < frame.count; i++) {
      const [p, q] = [3 * i, 4 * i];
      const far =
        Math.abs(p1[p] - p0[p]) > JUMP_M || Math.abs(p1[p + 1] - p0[p + 1]) > JUMP_M || Math.abs(p1[p + 2] - p0[p + 2]) > JUMP_M;
      const t = far ? 1 : blend;
      for (let k = 0; k < 3; k++) this.positions[p + k] = p0[p + k] + t * (p1[p + k] - p0[p + k]);
      const dot = q0[q] * q1[q] + q0[q + 1] * q1[q + 1] + q0[q + 2] * q1[q + 2] + q0[q + 3] * q1[q + 3];
      const near = (dot < 0 ? -1 : 1) * (1 - t);
      let length = 0;
      for (let k = 0; k < 4; k++) {
        const value = near * q0[q + k] + t * q1[q + k];
        this.quaternions[q + k] = value;
        length += value * value;
      }
      const norm = length > 0 ? 1 / Math.sqrt(length) : 0;
      for (let k = 0; k < 4; k++) this.quaternions[q + k] *= norm;
    }
    return true;
  }

  // Returns whether a movable entity is in the arena.
  isPresent(slot) {
    return !(this.colours[4 * slot + 3] & Flag.absent);
  }

  yaw(slot) {
    const q = this.quaternions;
    const i = 4 * slot;
    return Math.atan2(2 * (q[i + 3] * q[i + 2] + q[i] * q[i + 1]), 1 - 2 * (q[i + 1] ** 2 + q[i + 2] ** 2));
  }

  // Returns "#rrggbb" for an entity that shines or is painted, null for others.
  colour(slot, isRobot) {
    const c = 4 * slot;
    if (isRobot && !(this.colours[c + 3] & Flag.lit)) return null;
    return `rgb(${this.colours[c]},${this.colours[c + 1]},${this.colours[c + 2]})`;
  }
}
