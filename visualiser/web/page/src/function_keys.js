// Keys and selections that go to experiment functions instead of the page, while that is switched on.
const NAMES = { " ": "Space", ArrowUp: "Up", ArrowDown: "Down", ArrowLeft: "Left", ArrowRight: "Right", Enter: "Return" };
const SAME = ["Escape", "Tab", "Backspace", "Delete", "Insert", "Home", "End", "PageUp", "PageDown", "Shift", "Control", "Alt"];
const SWITCH = "F8";

// As functions know a key (docs/experiment_functions.md); null for what is no key of theirs.
export function nameOfKey(key) {
  if (NAMES[key]) return NAMES[key];
  if (SAME.includes(key) || /^F([1-9]|1[0-2])$/.test(key)) return key;
  return /^[!-~]$/.test(key) ? key.toUpperCase() : null;
}

export class FunctionKeys {
  // actions: command(request), changed(on), selected(): the id of the selected entity or null, writes(element): text
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

  // All that are held: nobody hears of it while the page has no focus.
  release() {
    for (const key of this.held.values()) this.actions.command({ do: "release", key });
    this.held.clear();
  }

  // id: of an entity, or null
  select(id) {
    if (this.on) this.actions.command(id === null ? { do: "deselect" } : { do: "select", entity: id });
  }

  // Of the browser; true if the page has nothing to do with it.
  down(event) {
    if (event.key === SWITCH) return false;
    if (!this.on || event.metaKey || (event.ctrlKey && event.key !== "Control")) return false;
    if (["INPUT", "SELECT", "TEXTAREA"].includes(event.target.tagName)) return false;
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
