// The page of web_render: connects to the server, keeps the state, and passes it to the picture and the panels.
import { Connection } from "./connection.js";
import { FrameDecoder } from "./protocol.js";
import { EntityList } from "./ui/list.js";
import { Help } from "./ui/help.js";
import { Inspector } from "./ui/inspector.js";
import { LogPanel } from "./ui/log.js";
import { Processes } from "./ui/processes.js";
import { Toolbar } from "./ui/toolbar.js";
import { Tools } from "./ui/tools.js";
import { h, saveBlob, setText } from "./ui/dom.js";
import { Picture } from "./view/picture.js";
import { choices } from "./view/quality.js";
import { robotValues } from "./view/robot_values.js";
import { readLink, writeLink } from "./link.js";
import { Film } from "./film.js";
import { Legend } from "./ui/legend.js";
import { World } from "./world.js";

const HIDDEN_PERIOD_MS = 1000; // between frames while nobody sees the page
const NEWS_MS = 5000;
const asked = new URLSearchParams(location.search).get("quality");
const linked = readLink(location.hash.slice(1));
const quality = [asked, linked.quality].find((name) => choices.includes(name)) ?? "auto";

const state = { world: null, status: null, control: "read-only", selected: null, connected: false, frames: 0, drawn: 0, newsUntil: 0, linkWaits: true };

const toolbar = new Toolbar({ command, toggle, help: () => help.toggle(), top: () => frameArena("top"), fit: () => frameArena(), quality: (name) => picture.setQuality(name), plan: () => picture.switchView(), list: () => togglePanel() });
const list = new EntityList({ select, approach });
const inspector = new Inspector({ watch, follow, deselect: () => select(null), put, remove: (entity) => remove([entity]), poseOf, swarmChanged: (on) => tools.set("swarm", on) });
const log = new LogPanel();
const processes = new Processes();
const help = new Help();
const banner = h("div.banner", { role: "status" });
const main = h("main", {}, banner);
list.element.append(processes.element);
const app = document.getElementById("app");
app.append(toolbar.element, list.element, main, inspector.element, log.element, help.element);
const picture = new Picture(main, quality, { select, selectAll, approach, move, mayMove: () => state.control === "granted", trouble });
const planNote = h("button.plan-note", { title: "Show it in three dimensions  (V)", onclick: () => picture.switchView() }, "Plan view · 3D: V");
main.append(planNote);
const legend = new Legend();
picture.onColouring = () => legend.show(picture.colouring, state.world);
const film = new Film(picture, { fileName, changed: (on) => tools.set("film", on), trouble });
const colourChoice = h(
  "select",
  { "aria-label": "Colours of robots", onchange: () => colourBy(colourChoice.value) },
  ...["LEDs", ...Object.keys(robotValues)].map((name) => h("option", { value: name }, name)),
);
const tools = new Tools([
  [
    { name: "measures", label: "Measure", key: "M", title: "Drag over the floor: a length and its direction", switches: true, act: () => switchTool("measures") },
    { name: "heat", label: "Heat map", key: "J", title: "Where robots have been since this was switched on", switches: true, act: () => toggleHeat() },
    { name: "swarm", label: "Swarm plots", key: "W", title: "Mean and band of values over the robots", switches: true, act: () => inspector.toggleSwarm() },
    { name: "link", label: "Link", key: "Y", title: "Copy a link that opens this view, without the token", act: () => shareLink() },
    { name: "film", label: "Film", key: "shift + P", title: "Film the picture, until it is pressed again", switches: true, act: () => film.toggle() },
  ],
  [
    { name: "handles", label: "Handles", key: "H", title: "The selected robot has handles that move and turn it", switches: true, control: true, act: () => switchTool("handles") },
    h("label", {}, "Colours: ", colourChoice),
  ],
]);
main.append(tools.element, legend.element);
picture.onQuality = () => {
  toolbar.setQuality(picture.wanted, picture.qualityName);
  planNote.hidden = picture.qualityName !== "plan";
};
picture.onQuality();

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
    if (state.frame && frame.tick < state.frame.tick) sayItBegan();
    state.frames++;
    state.frame = frame;
    picture.addFrame(frame, performance.now());
    inspector.addFrame(frame);
    const { chosen } = picture;
    const robots = chosen.length > 1 ? chosen.filter((entity) => state.world.isRobot(entity)) : state.world.robots;
    inspector.swarm?.addFrame(frame, picture.meter, robots, robots === state.world.robots);
    toolbar.setFrame(frame);
    banner.dataset.waiting = "";
  },
});

const receive = {
  welcome({ control }) {
    state.control = control;
    toolbar.setControl(control);
    tools.setControl(control);
    inspector.setControl(control);
    log.clear();
    sendVisibility();
  },
  world(message) {
    const selected = state.selected === null ? null : state.world.ids[state.selected];
    state.world = new World(message);
    document.title = `${message.experiment} · Swarmanoid`;
    toolbar.setWorld(state.world);
    inspector.setWorld(state.world);
    list.setWorld(state.world);
    picture.setWorld(state.world);
    for (const name of Object.keys(picture.shows)) toolbar.setToggle(name, picture.shows[name]);
    const again = selected === null ? -1 : state.world.find(selected);
    state.selected = null;
    select(again >= 0 ? again : null);
  },
  status(message) {
    state.status = message;
    processes.update(message);
    showState();
  },
  colours: (message) => picture.paint(message),
  watched: (message) => inspector.addDetails(message),
  log: (message) => log.add(message),
  reply: ({ text }) => log.add({ tick: state.frame?.tick ?? null, source: "server", level: "warning", text }),
};

function showState() {
  toolbar.setStatus(state.status, state.connected);
  const ended = state.status?.phase === "finished";
  let text = "";
  if (!state.connected && ended) text = "The run has ended; this is its last state. Start the experiment again, and this page goes on.";
  else if (!state.connected) text = state.world ? "The connection is lost. Trying again; this is the last state." : "Waiting for the server.";
  else if (ended) text = `The run has ended${state.status.ended ? `: ${state.status.ended}` : ""}. This is its last state.`;
  else if (state.status?.phase === "waiting") text = "The run has not begun: it waits for its processes.";
  else if (performance.now() < state.newsUntil) text = "The experiment was started again.";
  setText(banner, text);
  banner.hidden = text === "";
  banner.dataset.kind = state.connected || ended ? "calm" : "trouble";
}

// A tick before the last one: a new run of the same experiment at the same address.
function sayItBegan() {
  log.add({ tick: 0, source: "page", level: "info", text: "the experiment was started again" });
  state.newsUntil = performance.now() + NEWS_MS;
  setTimeout(showState, NEWS_MS + 10);
  showState();
}

// ---- what the user does ----

function command(request) {
  if (state.control === "granted") connection.send(request);
}

function select(entity) {
  choose(entity, entity === null ? [] : [entity]);
}

// Several at once: the first of them is shown in the inspector.
function selectAll(entities) {
  choose(entities[0] ?? null, entities);
}

function choose(entity, chosen) {
  state.selected = entity;
  picture.select(entity, chosen);
  list.select(entity, chosen);
  inspector.swarm?.clear();
  inspector.select(entity);
  inspector.setFollowed(picture.followed);
}

function trouble(text) {
  log.add({ tick: state.frame?.tick ?? null, source: "page", level: "warning", text });
}

function approach(entity) {
  togglePanel(false);
  select(entity);
  picture.approach(entity);
}

function follow(entity) {
  const wanted = picture.followed === entity ? null : entity;
  if (wanted !== null) picture.approach(wanted);
  picture.follow(wanted);
  inspector.setFollowed(wanted);
}

function watch(entities) {
  connection?.send({ do: "watch", entities });
}

// Each: {entity, place: [x, y, z], yaw}
function move(changes) {
  for (const { entity, place, yaw } of changes)
    command({ do: "move", entity: state.world.ids[entity], position: [...place], angles: [0, 0, (yaw * 180) / Math.PI] });
}

function toggle(name) {
  picture.show(name, !picture.shows[name]);
  toolbar.setToggle(name, picture.shows[name]);
}

// The length that was measured goes with its tool.
function switchTool(name) {
  picture[name] = !picture[name];
  if (name === "measures") picture.tape = null;
  tools.set(name, picture[name]);
  picture.invalidate();
}

// pose: {x, y, z, heading}, m and degrees
function put(entity, verb, { x, y, z, heading }) {
  command({ do: verb, entity: state.world.ids[entity], position: [x, y, z], angles: [0, 0, heading] });
}

// What the form of a card begins with; for one that is not in the arena, what is looked at.
function poseOf(entity) {
  const place = picture.placeOf(entity);
  const [x, y, z] = place ?? [...picture.view.viewpoint.target.slice(0, 2), 0];
  return { x, y, z, heading: place ? (picture.yawOf(entity) * 180) / Math.PI : 0, present: place !== null };
}

function remove(entities) {
  for (const entity of entities) if (state.world.slots[entity] >= 0 && picture.placeOf(entity)) command({ do: "remove", entity: state.world.ids[entity] });
}

function frameArena(how) {
  if (!state.world) return;
  picture.frameArena(how);
  inspector.setFollowed(null);
}

// Of a picture or film that begins now.
function fileName() {
  return `${state.world.experiment}_${state.frame?.tick ?? 0}`;
}

// The picture as it is drawn, as a PNG.
function savePicture() {
  picture.toCanvas().toBlob((blob) => saveBlob(blob, `${fileName()}.png`));
}

function colourBy(name) {
  colourChoice.value = name;
  picture.colourBy(name === "LEDs" ? null : name);
  legend.show(picture.colouring, state.world);
}

function toggleHeat() {
  picture.showHeat(!picture.heat);
  tools.set("heat", Boolean(picture.heat));
}

// ---- links ----

// What a link says, once the experiment is there.
function openLink(wanted) {
  if (wanted.view) picture.view.viewpoint = wanted.view;
  if (wanted.select) select(state.world.find(wanted.select) >= 0 ? state.world.find(wanted.select) : null);
  for (const name of wanted.shows ?? []) if (Object.hasOwn(picture.shows, name) && !picture.shows[name]) toggle(name);
  if (wanted.colours && Object.hasOwn(robotValues, wanted.colours)) colourBy(wanted.colours);
}

async function shareLink() {
  const { viewpoint } = picture.view;
  const shows = Object.keys(picture.shows).filter((name) => picture.shows[name]);
  const select = state.selected === null ? null : state.world.ids[state.selected];
  const fragment = writeLink({ view: viewpoint, select, shows, colours: picture.colouring?.name ?? null, quality: picture.isPlan ? "plan" : null });
  state.link = `${location.origin}${location.pathname}#${fragment}`;
  try {
    await navigator.clipboard.writeText(state.link);
    log.add({ tick: state.frame?.tick ?? null, source: "page", level: "info", text: `copied: ${state.link}` });
  } catch {
    prompt("A link to this view", state.link); // the browser lets no page write to the clipboard
  }
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
  v: () => picture.switchView(),
  m: () => switchTool("measures"),
  h: () => state.control === "granted" && switchTool("handles"),
  j: () => toggleHeat(),
  w: () => inspector.toggleSwarm(),
  y: () => shareLink(),
  P: () => film.toggle(),
  Delete: () => remove(picture.chosen),
  PageUp: () => picture.view?.zoom(1),
  PageDown: () => picture.view?.zoom(-1),
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
  if (state.linkWaits && state.frame && picture.view?.world) {
    state.linkWaits = false;
    openLink(linked);
  }
  if (picture.draw(now)) {
    if (state.drawn++ === 0) state.firstPicture = performance.now();
    film.draw();
  }
  inspector.draw();
}
requestAnimationFrame(drawNext);
setInterval(() => picture.motion && list.render(picture.motion), 250);
showState();

function inPage({ x, y }) {
  const box = picture.view.canvas.getBoundingClientRect();
  return { x: box.left + x, y: box.top + y };
}

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
    return picture.qualityName;
  },
  get view() {
    return picture.view === null ? null : picture.isPlan ? "plan" : "3D";
  },
  get selected() {
    return state.selected === null ? null : state.world.ids[state.selected];
  },
  get chosen() {
    return picture.chosen.map((entity) => state.world.ids[entity]);
  },
  get status() {
    return state.status;
  },
  get followed() {
    return picture.followed === null ? null : state.world.ids[picture.followed];
  },
  get camera() {
    return picture.view.eye;
  },
  get viewpoint() {
    return picture.view.viewpoint;
  },
  get shown() {
    return list.shown.length;
  },
  instances: () => picture.view.details,
  select: (id) => select(state.world.find(id)),
  show: (name, on) => picture.shows[name] !== on && toggle(name),
  approach: (id) => approach(state.world.find(id)),
  place: (id) => Array.from(picture.placeOf(state.world.find(id)) ?? []),
  heading: (id) => (picture.yawOf(state.world.find(id)) * 180) / Math.PI,
  get colouring() {
    return picture.colouring && { name: picture.colouring.name, low: picture.colouring.low, high: picture.colouring.high };
  },
  get heat() {
    return picture.heat && { columns: picture.heat.columns, rows: picture.heat.rows, seconds: Array.from(picture.heat.seconds), drawn: Boolean(picture.heat.canvas) };
  },
  get link() {
    return state.link ?? null;
  },
  colourBy,
  get measured() {
    if (!picture.tape) return null;
    const [dx, dy] = [0, 1].map((k) => picture.tape.to[k] - picture.tape.from[k]);
    return { metres: Math.hypot(dx, dy), degrees: (Math.atan2(dy, dx) * 180) / Math.PI };
  },
  get handles() {
    const { handles } = picture.overlay;
    return handles && { move: inPage(handles.move), turn: inPage(handles.turn) };
  },
  project: (id) => inPage(picture.seen(state.world.find(id))),
  projectPoint: (x, y, z) => inPage(picture.view.project(x, y, z)),
  command: (request) => connection.send(request),
};
