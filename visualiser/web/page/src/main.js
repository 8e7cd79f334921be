// The page of web_render: connects to the server, keeps the state, and passes it to the picture and the panels.
import { Connection } from "./connection.js";
import { FrameDecoder } from "./protocol.js";
import { EntityList } from "./ui/list.js";
import { Help } from "./ui/help.js";
import { Inspector } from "./ui/inspector.js";
import { LogPanel } from "./ui/log.js";
import { Processes } from "./ui/processes.js";
import { Toolbar } from "./ui/toolbar.js";
import { h, setText } from "./ui/dom.js";
import { qualities } from "./view/quality.js";
import { View } from "./view/view.js";
import { World } from "./world.js";

const HIDDEN_PERIOD_MS = 1000; // between frames while nobody sees the page
const asked = new URLSearchParams(location.search).get("quality");
const quality = Object.hasOwn(qualities, asked ?? "") ? asked : "auto";

const state = { world: null, status: null, control: "read-only", selected: null, connected: false, frames: 0, drawn: 0 };

const toolbar = new Toolbar({ command, toggle, help: () => help.toggle(), top: () => frameArena("top"), fit: () => frameArena(), quality: (name) => view.setQuality(name), list: () => togglePanel() });
const list = new EntityList({ select, approach });
const inspector = new Inspector({ watch, follow, deselect: () => select(null) });
const log = new LogPanel();
const processes = new Processes();
const help = new Help();
const banner = h("div.banner", { role: "status" });
const picture = h("main", {}, banner);
list.element.append(processes.element);
const app = document.getElementById("app");
app.append(toolbar.element, list.element, picture, inspector.element, log.element, help.element);
const meshes = await (await fetch("meshes.json")).json();
const view = new View(picture, quality, meshes, { select, approach, move, mayMove: () => state.control === "granted" });
view.onQuality = () => toolbar.setQuality(view.wanted, view.qualityName);
view.onQuality();

let decoder = new FrameDecoder();
const connection = new Connection({
  onOpen() {
    decoder = new FrameDecoder();
    state.connected = true;
    showState();
  },
  onClose() {
    state.connected = false;
    showState();
  },
  onText(message) {
    receive[message.type]?.(message);
  },
  onFrame(buffer) {
    const frame = decoder.decode(buffer);
    if (!frame || !state.world) return;
    state.frames++;
    state.frame = frame;
    view.addFrame(frame, performance.now());
    inspector.addFrame(frame);
    toolbar.setFrame(frame);
    banner.dataset.waiting = "";
  },
});

const receive = {
  welcome({ control }) {
    state.control = control;
    toolbar.setControl(control);
    log.clear();
    sendVisibility();
  },
  world(message) {
    const selected = state.selected === null ? null : state.world.ids[state.selected];
    const camera = state.world?.experiment === message.experiment;
    const { stage } = view;
    const place = camera && !stage.home ? [stage.camera.position.clone(), stage.controls.target.clone()] : null;
    state.world = new World(message);
    document.title = `${message.experiment} · Swarmanoid`;
    toolbar.setWorld(state.world);
    inspector.setWorld(state.world);
    list.setWorld(state.world);
    view.setWorld(state.world);
    if (place) {
      stage.camera.position.copy(place[0]);
      stage.controls.target.copy(place[1]);
      stage.controls.update();
      stage.home = null;
    }
    for (const name of Object.keys(view.shows)) toolbar.setToggle(name, view.shows[name]);
    const again = selected === null ? -1 : state.world.find(selected);
    state.selected = null;
    select(again >= 0 ? again : null);
  },
  status(message) {
    state.status = message;
    processes.update(message);
    showState();
  },
  colours: (message) => view.paint(message),
  watched: (message) => inspector.addDetails(message),
  log: (message) => log.add(message),
  reply: ({ text }) => log.add({ tick: state.frame?.tick ?? null, source: "server", level: "warning", text }),
};

function showState() {
  toolbar.setStatus(state.status, state.connected);
  const ended = state.status?.phase === "finished";
  let text = "";
  if (!state.connected) text = state.world ? "The connection is lost. Trying again; this is the last state." : "Waiting for the server.";
  else if (ended) text = `The run has ended${state.status.ended ? `: ${state.status.ended}` : ""}. This is its last state.`;
  else if (state.status?.phase === "waiting") text = "The run has not begun: it waits for its processes.";
  setText(banner, text);
  banner.hidden = text === "";
  banner.dataset.kind = state.connected ? "calm" : "trouble";
}

// ---- what the user does ----

function command(request) {
  if (state.control === "granted") connection.send(request);
}

function select(entity) {
  state.selected = entity;
  view.select(entity);
  list.select(entity);
  inspector.select(entity);
  inspector.setFollowed(view.followed);
}

function approach(entity) {
  togglePanel(false);
  select(entity);
  view.approach(entity);
}

function follow(entity) {
  const wanted = view.followed === entity ? null : entity;
  if (wanted !== null) view.approach(wanted);
  view.follow(wanted);
  inspector.setFollowed(wanted);
}

function watch(entities) {
  connection?.send({ do: "watch", entities });
}

function move(entity, point) {
  const heading = (view.motion.yaw(state.world.slots[entity]) * 180) / Math.PI;
  command({ do: "move", entity: state.world.ids[entity], position: [point.x, point.y, view.placeOf(entity)[2]], angles: [0, 0, heading] });
}

function toggle(name) {
  view.show(name, !view.shows[name]);
  toolbar.setToggle(name, view.shows[name]);
}

function frameArena(how) {
  if (!state.world) return;
  view.follow(null);
  inspector.setFollowed(null);
  view.stage.frameArena(state.world.arena, how);
}

// The picture as it is drawn, as a PNG.
function savePicture() {
  view.stage.draw();
  view.stage.renderer.domElement.toBlob((blob) => {
    const link = h("a", { href: URL.createObjectURL(blob), download: `${state.world.experiment}_${state.frame?.tick ?? 0}.png` });
    link.click();
    URL.revokeObjectURL(link.href);
  });
}

// On a narrow screen the list of entities covers the picture only while it is wanted.
function togglePanel(open = !app.classList.contains("list-open")) {
  app.classList.toggle("list-open", open);
  toolbar.setList(open);
}

function changeSpeed(step) {
  const { speed } = toolbar;
  const place = Math.max(0, Math.min(speed.options.length - 1, speed.selectedIndex + step));
  command({ do: "speed", factor: Number(speed.options[place].value) });
}

const steps = (ticks) => command({ do: "step", ticks });

// As in the windows, where they have the same function.
const keys = {
  " ": () => toolbar.pause.click(),
  n: () => steps(1),
  N: () => steps(10),
  "+": () => changeSpeed(1),
  "-": () => changeSpeed(-1),
  f: () => state.selected !== null && follow(state.selected),
  k: () => inspector.togglePin(),
  i: () => toggle("ids"),
  l: () => toggle("trails"),
  b: () => toggle("beams"),
  s: () => toggle("shadows"),
  p: () => savePicture(),
  Home: () => frameArena(),
  End: () => frameArena("top"),
  F1: () => help.toggle(),
  F3: () => togglePanel(),
  g: () => log.toggle(),
  "?": () => help.toggle(),
  "/": () => list.filter.focus(),
  Escape: () => (help.element.hidden ? select(null) : help.toggle(false)),
};
window.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  if (event.key === "Escape") document.activeElement?.blur();
  else if (["INPUT", "SELECT"].includes(event.target.tagName)) return;
  const act = keys[event.key] ?? keys[event.key.toLowerCase()];
  if (!act || !state.world) return;
  event.preventDefault();
  act();
});

function sendVisibility() {
  connection.send({ do: "frame_period", ms: document.hidden ? HIDDEN_PERIOD_MS : 0 });
}
document.addEventListener("visibilitychange", sendVisibility);

// ---- pictures ----

function drawNext(now) {
  requestAnimationFrame(drawNext);
  if (view.draw(now) && state.drawn++ === 0) state.firstPicture = performance.now();
  inspector.draw();
}
requestAnimationFrame(drawNext);
setInterval(() => view.motion && list.render(view.motion), 250);
showState();

// For tests, and for the console of the curious.
window.swarmanoid = {
  get connected() {
    return state.connected;
  },
  get control() {
    return state.control;
  },
  get phase() {
    return state.status?.phase ?? null;
  },
  get experiment() {
    return state.world?.experiment ?? null;
  },
  get robots() {
    return state.world?.robots.length ?? 0;
  },
  get tick() {
    return state.frame?.tick ?? null;
  },
  get time() {
    return state.frame?.time ?? null;
  },
  get frames() {
    return state.frames;
  },
  get drawn() {
    return state.drawn;
  },
  // Milliseconds from the request of the page.
  get firstPicture() {
    return state.firstPicture ?? null;
  },
  get quality() {
    return view.qualityName;
  },
  get selected() {
    return state.selected === null ? null : state.world.ids[state.selected];
  },
  get status() {
    return state.status;
  },
  get followed() {
    return view.followed === null ? null : state.world.ids[view.followed];
  },
  get camera() {
    return view.stage.camera.position.toArray();
  },
  get shown() {
    return list.shown.length;
  },
  instances: () => view.swarm.herds.map(({ slots, layers }) => ({ robots: slots.length, drawn: layers.map((layer) => layer.count) })),
  select: (id) => select(state.world.find(id)),
  show: (name, on) => view.shows[name] !== on && toggle(name),
  approach: (id) => approach(state.world.find(id)),
  place: (id) => Array.from(view.placeOf(state.world.find(id)) ?? []),
  project: (id) => view.project(state.world.find(id)),
  projectPoint: (x, y, z) => view.projectPoint(x, y, z),
  command: (request) => connection.send(request),
};
