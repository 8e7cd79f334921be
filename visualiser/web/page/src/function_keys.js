// Passes keys and selections to experiment functions instead of the page, while this is switched on.
import { takesText } from "./ui/keyboard.js";

const NAMES = { " ": "Space", ArrowUp: "Up", ArrowDown: "Down", ArrowLeft: "Left", ArrowRight: "Right", Enter: "Return" };
const SAME = ["Escape", "Tab", "Backspace", "Delete", "Insert", "Home", "End", "PageUp", "PageDown", "Shift", "Control", "Alt"];
const SWITCH = "F8";

// Returns the name of a key for experiment functions (docs/experiment_functions.md); null for keys that they do not
// get.
export function nameOfKey(key) {
  if (NAMES[key]) return NAMES[key];
  if (SAME.includes(key) || /^F([1-9]|1[0-2])$/.test(key)) return key;
  return /^[!-~]$/.test(key) ? key.toUpperCase() : null;
}

export class FunctionKeys {
  // `actions`: command(request), changed(on), selected(): the id of the selected entity or null, writes(element):
  // whether it takes text.
  constructor(actions) {
    this.actions = actions;
    this.on = false;
    this.held = new Map(); // names by event.code
  }

  toggle(on = !this.on) {
    if (on === this.on) return;
    if (!on) this.release();
    this.on = on;
    const entity = this.actions.selected();
    if (entity !== null) this.actions.command(on ? { do: "select", entity } : { do: "deselect" });
    this.actions.changed(on);
  }

  // Releases all held keys, since a page without focus gets no key events.
  release() {
    for (const key of this.held.values()) this.actions.command({ do: "release", key });
    this.held.clear();
  }

  // `id`: of an entity, or null.
  select(id) {
    if (this.on) this.actions.command(id === null ? { do: "deselect" } : { do: "select", entity: id });
  }

  // Handles a key event; returns true if the page must ignore it.
  down(event) {
    if (event.key === SWITCH) return false;
    if (!this.on || event.metaKey || (event.ctrlKey && event.key !== "Control")) return false;
    if (takesText(event.target)) return false;
    const key = nameOfKey(event.key);
    if (key === null) return false;
    event.preventDefault();
    if (!this.held.has(event.code)) {
      this.held.set(event.code, key);
      this.actions.command({ do: "press", key });
    }
    return true;
  }

  up(event) {
    const key = this.held.get(event.code);
    if (key === undefined) return;
    this.held.delete(event.code);
    this.actions.command({ do: "release", key });
  }
}
