// The page of web_render: connects to the server, keeps the state, and passes it to the picture and the panels.
import { Connection } from "./connection.js";
import { LookingBack } from "./looking_back.js";
import { FrameDecoder, isPast } from "./protocol.js";
import { EntityList } from "./ui/list.js";
import { Help } from "./ui/help.js";
import { Inspector } from "./ui/inspector.js";
import { LogPanel } from "./ui/log.js";
import { Processes } from "./ui/processes.js";
import { Timeline } from "./ui/timeline.js";
import { Toolbar } from "./ui/toolbar.js";
import { Tools } from "./ui/tools.js";
import { ViewpointsMenu } from "./ui/viewpoints_menu.js";
import { h, saveBlob, setText } from "./ui/dom.js";
import { listenToKeys } from "./ui/keyboard.js";
import { Picture } from "./view/picture.js";
import { choices } from "./view/quality.js";
import { robotValues } from "./view/robot_values.js";
import { readLink, writeLink } from "./link.js";
import { Film } from "./film.js";
import { copyOrShow } from "./clipboard.js";
import { pageHook } from "./page_hook.js";
import { keepToken, proofOf, takeToken } from "./token.js";
import { Legend } from "./ui/legend.js";
import { World } from "./world.js";

const HIDDEN_PERIOD_MS = 1000; // between frames while nobody sees the page
const NEWS_MS = 5000;
const asked = new URLSearchParams(location.search).get("quality");
let token = takeToken();
const linked = readLink(location.hash.slice(1));
const quality = [asked, linked.quality].find((name) => choices.includes(name)) ?? "auto";

const state = { world: null, status: null, control: "read-only", selected: null, connected: false, frames: 0, drawn: 0, newsUntil: 0, linkWaits: true, challenge: null, watched: [], run: null, live: null };

const toolbar = new Toolbar({ command, toggle, help: () => help.toggle(), top: () => frameArena("top"), fit: () => frameArena(), quality: (name) => picture.setQuality(name), plan: () => picture.switchView(), list: () => togglePanel(), unlock });
const list = new EntityList({ select, approach });
const inspector = new Inspector({ watch, follow, deselect: () => select(null), put, remove: (entity) => remove([entity]), poseOf, swarmChanged: (on) => tools.set("swarm", on) });
const log = new LogPanel();
const processes = new Processes();
const help = new Help();
const banner = h("div.banner", { role: "status" });
const main = h("main", {}, banner);
list.element.append(processes.element);
const app = document.getElementById("app");
const timeline = new Timeline({ look: (tick) => past.look(tick), play: () => past.play(), live: () => past.live(), branch: () => past.branch() });
app.append(toolbar.element, list.element, main, timeline.element, inspector.element, log.element, help.element);
const picture = new Picture(main, quality, { select, selectAll, approach, move, place: (point) => Boolean(editor?.place(point)), mayMove: () => state.control === "granted" && !past.isOn, trouble, send: (request) => connection.send(request) });
const past = new LookingBack({ state, timeline, inspector, toolbar, picture, send: (request) => connection.send(request), tell, changed: showState });
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
const viewpoints = new ViewpointsMenu({ picture, world: () => state.world, tell, left: () => inspector.setFollowed(null) });
const tools = new Tools([
  [
    { name: "measures", label: "Measure", key: "M", title: "Drag over the floor: a length and its direction", switches: true, act: () => switchTool("measures") },
    { name: "rays", label: "Rays", key: "R", title: "Rays of the proximity sensors", switches: true, act: () => toggle("rays") },
    { name: "bodies", label: "Collision", key: "C", title: "Bodies as the engines collide them", switches: true, act: () => toggle("bodies") },
    { name: "links", label: "Range and bearing", key: "X", title: "Who hears whom; half a line comes from one who is not answered", switches: true, act: () => toggle("links") },
    { name: "heat", label: "Heat map", key: "J", title: "Where robots have been since this was switched on", switches: true, act: () => toggleHeat() },
    { name: "swarm", label: "Swarm plots", key: "W", title: "Mean and band of values over the robots", switches: true, act: () => inspector.toggleSwarm() },
    { name: "link", label: "Link", key: "Y", title: "Copy a link that opens this view, without the token", act: () => shareLink() },
    { name: "aboard", label: "On board", key: "O", title: "Look from the selected robot", switches: true, act: () => board() },
    { name: "film", label: "Film", key: "shift + P", title: "Film the picture, until it is pressed again", switches: true, act: () => film.toggle() },
  ],
  [
    { name: "handles", label: "Handles", key: "H", title: "The selected robot has handles that move and turn it", switches: true, control: true, act: () => switchTool("handles") },
    h("label", {}, "Colours: ", colourChoice),
  ],
  [
    h("label", {}, "Viewpoint: ", viewpoints.element),
    { name: "store", label: "Keep view", key: "Ctrl + shift + 0 … 9", title: "Keep this view as the next viewpoint, and copy its XML", act: () => viewpoints.store() },
    { name: "fly", label: "Fly", key: "U", title: "Fly through the viewpoints", act: () => viewpoints.fly() },
  ],
]);
main.append(tools.element, legend.element);
picture.onQuality = () => {
  toolbar.setQuality(picture.wanted, picture.qualityName);
  planNote.hidden = picture.qualityName !== "plan";
};
picture.onQuality();
picture.onBoard = () => tools.set("aboard", picture.aboard !== null);

let decoder = new FrameDecoder();
let editor = null; // if the server edits a file
let loadingEditor = null;
const connection = new Connection({
  onOpen() {
    decoder = new FrameDecoder();
    picture.marks.forget();
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
    if (isPast(buffer)) return past.show(frame);
    if (state.live && frame.tick < state.live.tick) sayItBegan();
    state.frames++;
    state.live = frame;
    if (past.isOn) return;
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
  welcome({ control, challenge, edits }) {
    state.challenge = challenge ?? null;
    log.clear();
    if (edits) startEditor();
    setControl(control);
    prove();
    sendVisibility();
  },
  authority: ({ control }) => setControl(control),
  document: (message) => editor?.receive(message),
  form: (message) => editor?.receiveForm(message),
  world(message) {
    const selected = state.selected === null ? null : state.world.ids[state.selected];
    const chosen = picture.chosen.map((entity) => state.world.ids[entity]);
    const isNew = state.world?.experiment !== message.experiment;
    state.world = new World(message);
    if (isNew) viewpoints.set(state.world.viewpoints);
    document.title = `${message.experiment} · Swarmanoid`;
    toolbar.setWorld(state.world);
    inspector.setWorld(state.world);
    list.setWorld(state.world);
    picture.setWorld(state.world);
    for (const name of Object.keys(picture.shows)) showToggle(name);
    const again = selected === null ? -1 : state.world.find(selected);
    state.selected = null;
    if (editor) showChosen(chosen.map((id) => state.world.find(id)).filter((entity) => entity >= 0));
    else select(again >= 0 ? again : null);
  },
  status(message) {
    if (state.status?.phase === "finished" && message.phase !== "finished") sayItBegan();
    state.status = message;
    processes.update(message);
    showState();
  },
  colours(message) {
    state.colours = message;
    if (!past.isOn) picture.paint(message);
  },
  watched: (message) => past.isOn || inspector.addDetails(message),
  timeline(message) {
    state.run = message.run;
    timeline.set(message, state.world?.tickSeconds);
  },
  past(message) {
    if (!past.isOn) return;
    picture.paint(message.colours);
    inspector.addDetails(message);
  },
  past_inside: (message) => past.isOn && past.wanted === message.tick && inspector.addInside(message),
  marks: (message) => picture.marks.receive(message),
  log: (message) => log.add(message),
  reply({ text }) {
    log.add({ tick: editor ? null : state.frame?.tick ?? null, source: "server", level: "warning", text });
    editor?.refused(text);
    if (past.isOn) past.answered();
  },
};

function showState() {
  toolbar.setStatus(state.status, state.connected);
  const ended = state.status?.phase === "finished";
  let text = "";
  if (!state.connected && ended) text = "The run has ended; this is its last state. Start the experiment again, and this page goes on.";
  else if (state.connected && past.isOn) text = "Looking back. Live, or Q, goes to the present.";
  else if (!state.connected) text = state.world ? "The connection is lost. Trying again; this is the last state." : "Waiting for the server.";
  else if (ended) text = `The run has ended${state.status.ended ? `: ${state.status.ended}` : ""}. This is its last state.`;
  else if (state.status?.phase === "waiting") text = "The run has not begun: it waits for its processes.";
  else if (newsLasts()) text = "The experiment was started again.";
  setText(banner, text);
  banner.hidden = text === "";
  banner.dataset.kind = state.connected || ended ? "calm" : "trouble";
}

// A tick before the last one, or going on after the end: a new run of the same experiment at the same address.
function sayItBegan() {
  log.add({ tick: 0, source: "page", level: "info", text: "the experiment was started again" });
  state.status = null;
  state.live = null;
  state.newsUntil = Infinity;
  showState();
}

// The time of the news begins when nothing more urgent stands in its place.
function newsLasts() {
  if (state.newsUntil === Infinity) {
    state.newsUntil = performance.now() + NEWS_MS;
    setTimeout(showState, NEWS_MS + 10);
  }
  return performance.now() < state.newsUntil;
}

// ---- who may steer ----

function setControl(control) {
  state.control = control;
  if (control === "granted") editor?.begin();
  toolbar.setControl(control);
  tools.setControl(control);
  inspector.setControl(control);
}

// That this page has the token, without telling it.
function prove() {
  if (token && state.challenge) connection.send({ do: "prove", proof: proofOf(token, state.challenge) });
}

function unlock() {
  if (!state.challenge) return;
  const found = /[0-9a-f]{32}/.exec(prompt("The token, or the address that was printed with it") ?? "");
  if (!found) return;
  [token] = found;
  keepToken(token);
  prove();
}

// ---- the editor ----

// There is a file instead of a run.
function startEditor() {
  state.status = { phase: "editing", real_time_factor: 0, speed_wanted: 1, processes: [] };
  loadingEditor ??= import("./edit/editor.js").then(({ Editor }) => {
    for (const name of ["rays", "bodies", "links", "heat", "swarm", "aboard", "film"]) tools.buttons[name].hidden = true;
    for (const name of ["trails", "beams"]) toolbar.toggles[name].hidden = true;
    editor = new Editor({ app, main, picture, left: list.element, send: (request) => connection.send(request), choose: showChosen });
    if (state.control === "granted") editor.begin();
  });
  showState();
}

// ---- what the user does ----

function command(request) {
  if (state.control === "granted" && !editor) connection.send(request);
}

// further: the card of the one before stays.
function select(entity, further = false) {
  if (further && entity !== null) inspector.keepSelected();
  choose(entity, entity === null ? [] : [entity]);
}

// Several at once: the first of them is shown in the inspector.
function selectAll(entities) {
  choose(entities[0] ?? null, entities);
}

function choose(entity, chosen) {
  if (editor) {
    showChosen(chosen);
    editor.many = chosen.length > 1;
    if (!editor.many) editor.select(entity);
    return;
  }
  showChosen(chosen);
  inspector.swarm?.clear();
  inspector.select(entity);
  inspector.setFollowed(picture.followed);
}

function showChosen(chosen) {
  const entity = chosen[0] ?? null;
  state.selected = entity;
  picture.select(entity, chosen);
  list.select(entity, chosen);
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
  state.watched = entities;
  connection?.send({ do: "watch", entities });
  past.again();
}

// Each: {entity, place: [x, y, z], yaw}
function move(changes) {
  if (editor) return editor.move(changes);
  for (const { entity, place, yaw } of changes)
    command({ do: "move", entity: state.world.ids[entity], position: [...place], angles: [0, 0, (yaw * 180) / Math.PI] });
}

function toggle(name) {
  picture.show(name, !picture.shows[name]);
  showToggle(name);
}

// Its button is in the bar or among the tools.
function showToggle(name) {
  toolbar.setToggle(name, picture.shows[name]);
  tools.set(name, picture.shows[name]);
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
  if (editor) return editor.remove();
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

function board() {
  if (picture.aboard !== null) return picture.board(null);
  if (state.selected === null || !state.world.isRobot(state.selected) || !picture.placeOf(state.selected)) return tell("select a robot first: the camera looks from it");
  picture.board(state.selected);
  inspector.setFollowed(null);
}

function tell(text) {
  log.add({ tick: state.frame?.tick ?? null, source: "page", level: "info", text });
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
  if (await copyOrShow("A link to this view", state.link)) tell(`copied: ${state.link}`);
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
  t: () => toggle("textures"),
  r: () => toggle("rays"),
  c: () => toggle("bodies"),
  x: () => toggle("links"),
  o: () => board(),
  u: () => viewpoints.fly(),
  v: () => picture.switchView(),
  m: () => switchTool("measures"),
  h: () => state.control === "granted" && switchTool("handles"),
  j: () => toggleHeat(),
  w: () => inspector.toggleSwarm(),
  y: () => shareLink(),
  P: () => film.toggle(),
  ",": () => past.step(-1),
  ".": () => past.step(1),
  "<": () => past.jumpToEvent(false),
  ">": () => past.jumpToEvent(true),
  z: () => past.play(),
  q: () => past.live(),
  B: () => past.branch(),
  I: () => past.inspect(),
  Delete: () => remove(picture.chosen),
  ArrowLeft: () => picture.step(-1, 0),
  ArrowRight: () => picture.step(1, 0),
  ArrowUp: () => picture.step(0, 1),
  ArrowDown: () => picture.step(0, -1),
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
  Escape: () => (!help.element.hidden ? help.toggle(false) : picture.aboard !== null || picture.flight ? picture.leaveRobot() : select(null)),
};
listenToKeys({
  keys,
  digit: (number, { shiftKey }) => (shiftKey ? viewpoints.store(number) : viewpoints.recall(number)),
  first: (event) => editor?.key(event),
  isReady: () => state.world !== null,
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
    if (state.world.beginsAtViewpoint && !linked.view) picture.stand(viewpoints.all[0]);
    openLink(linked);
  }
  past.advance(now);
  if (picture.draw(now)) {
    if (state.drawn++ === 0) state.firstPicture = performance.now();
    film.draw();
  }
  inspector.draw();
}
requestAnimationFrame(drawNext);

// Another address in the bar of the same page: a token, or a link.
window.addEventListener("hashchange", () => {
  const given = takeToken();
  if (given !== token) {
    token = given;
    prove();
  }
  if (state.world && picture.view?.world) openLink(readLink(location.hash.slice(1)));
});
setInterval(() => picture.motion && list.render(picture.motion), 250);
showState();

window.swarmanoid = pageHook({ state, past, timeline, viewpoints, list, picture, editorOf: () => editor, select, toggle, approach, colourBy, send: (request) => connection.send(request) });
