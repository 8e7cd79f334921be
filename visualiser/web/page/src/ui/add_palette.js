// The choice of what a click on the floor adds to a run: the next entity of a reserve, or an entity that was taken out
// of the arena.
import { Flag } from "../protocol.js";
import { h, setText } from "./dom.js";

const MOST_REMOVED = 50; // entities in the list

export class AddPalette {
  // `page`: command(request), main.
  constructor(page) {
    this.page = page;
    this.chosen = null; // id of a reserve or of an entity
    this.world = null;
    this.choice = h("select", { "aria-label": "What a click adds", onchange: () => this.arm(this.choice.value || null) });
    this.hint = h("span.dim", { role: "status" });
    this.element = h("div.palette", { hidden: true }, h("label", {}, "Add: ", this.choice), this.hint);
  }

  setWorld(world) {
    this.world = world;
    this.shown = null;
    this.arm(null);
  }

  // Shows what is not in the arena in a frame. `may`: whether this page may add it now.
  show(frame, may) {
    const { world } = this;
    if (!may || !frame || !world) {
      this.element.hidden = true;
      return;
    }
    const isAbsent = (entity) => Boolean(frame.colours[4 * world.slots[entity] + 3] & Flag.absent);
    const reserved = new Set();
    const reserves = world.reserves.map(({ id, first, count }) => {
      const entities = Array.from({ length: count }, (_, i) => first + i);
      for (const entity of entities) reserved.add(entity);
      return { id, label: `${world.kinds[first].replaceAll("_", " ")} ${id} (${entities.filter(isAbsent).length} of ${count} left)` };
    });
    const removed = world.movable.filter((entity) => !reserved.has(entity) && isAbsent(entity)).slice(0, MOST_REMOVED);
    const options = [...reserves, ...removed.map((entity) => ({ id: world.ids[entity], label: `${world.ids[entity]} (removed)` }))];
    this.element.hidden = options.length === 0;
    this.showOptions(options);
  }

  showOptions(options) {
    const shown = JSON.stringify(options);
    if (this.shown === shown) return;
    this.shown = shown;
    this.choice.replaceChildren(h("option", { value: "" }, "nothing"), ...options.map(({ id, label }) => h("option", { value: id }, label)));
    // A removed entity that is back cannot be added again.
    if (this.chosen !== null && !options.some(({ id }) => id === this.chosen)) this.arm(null, this.hint.textContent);
    this.choice.value = this.chosen ?? "";
  }

  arm(id, hint = id === null ? "" : "click on the floor (Esc ends)") {
    this.chosen = id;
    this.choice.value = id ?? "";
    this.say(hint);
    this.page.main.classList.toggle("placing", id !== null);
  }

  say(text, isRefusal = false) {
    setText(this.hint, text);
    this.hint.classList.toggle("wrong", isRefusal);
  }

  // Handles a click on the floor; returns true if it was used.
  place(point) {
    if (this.chosen === null || this.element.hidden || !point) return false;
    const [x, y] = point.map((metres) => Math.round(metres * 1000) / 1000);
    // On a terrain it falls to the ground.
    this.page.command({ do: "add", entity: this.chosen, position: [x, y, Math.ceil(this.world.groundAt(x, y) * 1000) / 1000] });
    return true;
  }

  // Reads an answer of the run in its log.
  answer(text) {
    if (/^add(: |ed ')/.test(text)) this.say(text, text.startsWith("add:"));
  }

  // Returns true if the palette has used the key.
  key(event) {
    if (event.key !== "Escape" || this.chosen === null) return false;
    this.arm(null);
    return true;
  }
}
