// Undoes moves and removals that this page has made in a run, by requests to the run. Each is a step. A step whose
// request the run refuses is forgotten.

const DEGREES = 180 / Math.PI;
const MOST_STEPS = 100;

// Returns the angles about x, y and z in degrees (Z, then Y, then X) of a quaternion [x, y, z, w].
export function anglesOf([x, y, z, w]) {
  const sine = Math.max(-1, Math.min(1, 2 * (w * y - z * x)));
  // If the entity points straight up or down, only the sum of the other two angles is defined.
  if (Math.abs(sine) > 0.999999) return [0, Math.asin(sine) * DEGREES, Math.atan2(2 * (w * z - x * y), 1 - 2 * (x * x + z * z)) * DEGREES];
  return [Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)) * DEGREES, Math.asin(sine) * DEGREES, Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)) * DEGREES];
}

// Returns {position, angles} of a slot in a frame.
export function poseIn(frame, slot) {
  const quaternion = [...frame.quaternions.subarray(4 * slot, 4 * slot + 4)].map((part) => part / 32767);
  const length = Math.hypot(...quaternion) || 1;
  return { position: [...frame.positions.subarray(3 * slot, 3 * slot + 3)], angles: anglesOf(quaternion.map((part) => part / length)) };
}

export class MoveHistory {
  // `page`: command(request), tell(text), changed(may): whether there is a step to undo.
  constructor(page) {
    this.page = page;
    this.clear();
  }

  clear() {
    this.done = []; // steps: {parts: [{id, back, again}], waits: ids whose answer has not come}
    this.undone = [];
    this.showChange();
  }

  showChange() {
    this.page.changed(this.done.length > 0);
  }

  // Adds a step. `parts`: for each entity its id, the request that was made, and the one that undoes it.
  add(parts) {
    this.done = [...this.done.slice(1 - MOST_STEPS), this.sent({ parts })];
    this.undone = [];
    this.showChange();
  }

  sent(step) {
    return { ...step, waits: new Set(step.parts.map(({ id }) => id)) };
  }

  undo() {
    this.shift(this.done, this.undone, "back", "There is no move of this page to undo.");
  }

  redo() {
    this.shift(this.undone, this.done, "again", "There is no undone move to do again.");
  }

  shift(from, to, way, none) {
    const step = from.pop();
    if (!step) return this.page.tell(none);
    to.push(this.sent(step));
    // The last one that was moved makes room first.
    const parts = way === "back" ? [...step.parts].reverse() : step.parts;
    for (const part of parts) this.page.command(part[way]);
    this.showChange();
  }

  // Reads an answer of the run in its log: "moved 'fb_1' at tick 3", or "move: 'fb_1' does not fit …".
  answer(text) {
    const refused = /^(move|add|remove): /.test(text);
    const done = /^(moved|added|removed) '/.test(text);
    const id = /'([^']*)'/.exec(text)?.[1];
    if (!refused && !done) return;
    for (const steps of [this.done, this.undone])
      for (const step of steps) {
        // A refusal may name no entity, such as a place outside the arena.
        const found = step.waits.has(id) ? id : refused && id === undefined ? [...step.waits][0] : undefined;
        if (found === undefined) continue;
        step.waits.delete(found);
        if (refused) this.forget(steps, step, found);
        return;
      }
  }

  forget(steps, step, id) {
    step.parts = step.parts.filter((part) => part.id !== id);
    if (step.parts.length === 0) steps.splice(steps.indexOf(step), 1);
    this.showChange();
  }

  // Returns true if the history has used the key.
  key(event) {
    const key = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || event.altKey || !["z", "y"].includes(key)) return false;
    event.preventDefault();
    if (key === "y" || event.shiftKey) this.redo();
    else this.undo();
    return true;
  }
}
