// The main module of web_render's page. It makes the parts of the page, joins them, and draws.
import { Actions } from "./actions.js";
import { Authority } from "./authority.js";
import { Connection } from "./connection.js";
import { Film } from "./film.js";
import { FunctionKeys } from "./function_keys.js";
import { readLink, writeLink } from "./link.js";
import { Playback } from "./playback.js";
import { pageHook } from "./page_hook.js";
import { keysOf } from "./page_keys.js";
import { MoveHistory } from "./move_history.js";
import { Reception } from "./reception.js";
import { Recording } from "./recording.js";
import { takeToken } from "./token.js";
import { AddPalette } from "./ui/add_palette.js";
import { Banner } from "./ui/banner.js";
import { h } from "./ui/dom.js";
import { Help } from "./ui/help.js";
import { Inspector } from "./ui/inspector.js";
import { listenToKeys, takesText } from "./ui/keyboard.js";
import { HeatLegend, Legend } from "./ui/legend.js";
import { EntityList } from "./ui/list.js";
import { LogPanel } from "./ui/log_panel.js";
import { Processes } from "./ui/processes.js";
import { Timeline } from "./ui/timeline.js";
import { Toolbar } from "./ui/toolbar.js";
import { Tools } from "./ui/tools.js";
import { ViewpointsMenu } from "./ui/viewpoints_menu.js";
import { Picture } from "./view/scene_picture.js";
import { choices } from "./view/quality_levels.js";
import { robotValues } from "./view/robot_values.js";

const HIDDEN_PERIOD_MS = 1000; // between frames while the page is hidden
const search = new URLSearchParams(location.search);
const asked = search.get("quality");
const isEditorsRun = search.has("run"); // the page shows the run that the editor has started, at the address of the editor
const linked = readLink(location.hash.slice(1));
const quality = [asked, linked.quality].find((name) => choices.includes(name)) ?? "auto";

// `endedHere`: whether this page has ended the run. `failure`, `runPhase`: of the run that the editor has started. `editor`: set if the server edits a file. `recorded`: whether this page has the run itself, and no server.
const recorded = Recording.isHere;
const state = { recorded, world: null, status: null, control: "read-only", selected: null, connected: false, frames: 0, drawn: 0, endedHere: false, failure: "", runPhase: null, linkWaits: true, watched: [], run: null, live: null, editor: null };

const send = (request) => connection.send(request);
const actions = new Actions(state);
const tell = (text) => actions.tell(text);
const trouble = (text) => actions.trouble(text);
const select = (entity, further) => actions.select(entity, further);
const approach = (entity) => actions.approach(entity);
const toggle = (name) => actions.toggle(name);

const toolbar = new Toolbar({
  command: (request) => actions.command(request),
  toggle,
  help: () => help.toggle(),
  top: () => actions.frameArena("top"),
  fit: () => actions.frameArena(),
  quality: (name) => picture.setQuality(name),
  plan: () => picture.switchView(),
  list: () => actions.togglePanel(),
  unlock: () => authority.unlock(),
});
const list = new EntityList({ select, approach });
const inspector = new Inspector({
  watch: (entities) => actions.watch(entities),
  follow: (entity) => actions.follow(entity),
  deselect: () => select(null),
  put: (entity, verb, pose) => actions.put(entity, verb, pose),
  remove: (entity) => actions.remove([entity]),
  poseOf: (entity) => actions.poseOf(entity),
  swarmChanged: (on) => tools.set("swarm", on),
  plotsChanged: () => past.needsChanged(),
  isRecorded: recorded,
});
const log = new LogPanel();
const processes = new Processes();
const help = new Help();
const banner = new Banner(state, { isLookingBack: () => past.isOn, connect: () => connection.connect() });
const main = h("main", {}, banner.element);
list.element.append(processes.element);
const app = document.getElementById("app");
const timeline = new Timeline({ look: (tick) => past.look(tick), play: () => past.play(), step: (ticks) => past.step(ticks), pace: (factor) => past.setPace(factor), live: () => past.live(), branch: () => past.branch() });
app.append(toolbar.element, list.element, main, timeline.element, inspector.element, log.element, help.element);
const picture = new Picture(main, quality, {
  select,
  selectAll: (entities) => actions.selectAll(entities),
  approach,
  move: (changes) => actions.move(changes),
  place: (point) => (state.editor ?? palette).place(point),
  mayMove: () => state.control === "granted" && !past.isOn,
  trouble,
  send,
  meshes: () => (recorded ? Recording.meshes() : fetch("meshes.json").then((answer) => answer.json())),
  hasServer: !recorded,
});
const past = new Playback({ state, actions, timeline, inspector, toolbar, picture, send, tell, trouble, changed: showState });
const planNote = h("button.plan-note", { title: "Show it in three dimensions  (V)", onclick: () => picture.switchView() }, "Plan view · 3D: V");
main.append(planNote);
const palette = new AddPalette({ command: (request) => actions.command(request), main });
main.append(palette.element);
const legend = new Legend();
const heatLegend = new HeatLegend();
picture.onHeat = () => heatLegend.show(picture.heat);
picture.onColouring = () => legend.show(picture.colouring, state.world);
const film = new Film(picture, { fileName: () => actions.fileName(), changed: (on) => tools.set("film", on), trouble });
const colourChoice = h(
  "select",
  { "aria-label": "Colours of robots", onchange: () => actions.colourBy(colourChoice.value) },
  ...["LEDs", ...Object.keys(robotValues)].map((name) => h("option", { value: name }, name)),
);
const viewpoints = new ViewpointsMenu({ picture, world: () => state.world, tell, left: () => inspector.setFollowed(null) });
const tools = new Tools([
  [
    "Show",
    { name: "bodies", label: "Collision", key: "C", title: "Bodies as the engines collide them", switches: true, act: () => toggle("bodies") },
    { name: "heat", label: "Heat map", key: "J", title: "Where robots have been since this was switched on, or before the tick that is looked at", switches: true, act: () => actions.toggleHeat() },
    { name: "links", label: "Range and bearing", key: "X", title: "Which robots hear each other; half a line comes from a robot that hears no answer", switches: true, act: () => toggle("links") },
    { name: "rays", label: "Rays", key: "R", title: "Rays of proximity sensors and range scanners", switches: true, act: () => toggle("rays") },
    h("label", {}, "Colours: ", colourChoice),
  ],
  [
    "Examine",
    { name: "measures", label: "Measure", key: "M", title: "Drag over the floor: a length and its direction", switches: true, act: () => actions.switchTool("measures") },
    { name: "swarm", label: "Swarm plots", key: "W", title: "Mean and band of values over the robots", switches: true, act: () => inspector.toggleSwarm() },
  ],
  [
    "Camera",
    { name: "fly", label: "Fly", key: "U", title: "Fly through the viewpoints", act: () => viewpoints.fly() },
    { name: "store", label: "Keep view", key: "Ctrl + shift + 0 … 9", title: "Keep this view as the next viewpoint, and copy its XML", act: () => viewpoints.store() },
    { name: "aboard", label: "On board", key: "O", title: "Look from the selected robot", switches: true, act: () => actions.board() },
    h("label", {}, "Viewpoint: ", viewpoints.element),
  ],
  [
    "Steer",
    { name: "handles", label: "Handles", key: "H", title: "The selected robot has handles that move and turn it", switches: true, control: true, act: () => actions.switchTool("handles") },
    { name: "undo", label: "Undo move", key: "Ctrl + Z", title: "Move back what this page has moved, or put back what it has removed", control: true, act: () => moves.undo() },
    { name: "function_keys", label: "Keys to functions", key: "F8", title: "Keys and selections go to the experiment functions", switches: true, control: true, act: () => functionKeys.toggle() },
  ],
  [
    "Save",
    { name: "film", label: "Film", key: "shift + P", title: "Film the picture, until it is pressed again", switches: true, act: () => film.toggle() },
    { name: "link", label: "Link", key: "Y", title: "Copy a link that opens this view, without the token", act: () => actions.shareLink() },
    { name: "picture", label: "Picture", key: "P", title: "Save the picture (PNG)", act: () => actions.savePicture() },
  ],
]);
const moves = new MoveHistory({ command: (request) => actions.command(request), tell, changed: (may) => tools.enable("undo", may) });
// On a phone the bar has no room for the options of the view.
const narrow = window.matchMedia("(max-width: 620px)");
const placeViews = () => (narrow.matches ? tools.element.firstElementChild.after(toolbar.views) : toolbar.element.append(toolbar.views));
narrow.addEventListener("change", placeViews);
placeViews();
main.append(tools.element, h("div.legends", {}, legend.element, heatLegend.element));
picture.onQuality = () => {
  toolbar.setQuality(picture.wanted, picture.qualityName);
  planNote.hidden = picture.qualityName !== "plan";
};
picture.onQuality();
picture.onBoard = () => tools.set("aboard", picture.aboard !== null);

const functionKeys = new FunctionKeys({
  command: (request) => actions.command(request),
  selected: () => (state.selected === null ? null : state.world.ids[state.selected]),
  changed: (on) => tools.set("function_keys", on),
});
window.addEventListener("keyup", (event) => functionKeys.up(event));
window.addEventListener("blur", () => functionKeys.release());
let editorLink = null;
const token = takeToken();
const authority = new Authority({ state, toolbar, tools, inspector, send, token: isEditorsRun ? null : token, editorLink: () => editorLink });
actions.reach({ moves, app, toolbar, list, inspector, log, picture, past, legend, tools, colourChoice, functionKeys, send });
const reception = new Reception({ state, actions, authority, toolbar, list, inspector, log, processes, timeline, viewpoints, banner, picture, past, palette, moves, startEditor, greet: sendVisibility, showState });
const connection = new (recorded ? Recording : Connection)({
  onOpen: () => reception.connected(true),
  onClose: () => reception.connected(false),
  isOver: () => state.endedHere || (isEditorsRun && state.runPhase !== "running"),
  onText: (message) => reception.message(message),
  onFrame: (buffer) => reception.frame(buffer),
  onPast: (frame) => past.show(frame),
  onFailure: (error) => failed(error),
}, isEditorsRun ? "run/stream" : "stream");
if (isEditorsRun)
  import("./edit/editor_link.js").then(({ EditorLink }) => {
    editorLink = new EditorLink({
      app,
      left: list.element,
      token,
      status: () => state.status,
      leave: () => changePage(false),
      // `run`: of the editor's document.
      changed(run) {
        state.failure = run.failure;
        state.runPhase = run.phase;
        if (run.token && run.token !== authority.token) authority.use(run.token);
        if (run.phase === "running") connection.connect();
        showState();
      },
      trouble,
    });
  });
if (recorded) {
  tools.hide("undo", "function_keys", "handles", "rays", "bodies", "links");
  for (const part of [toolbar, timeline]) part.setRecorded();
}

// The run of this page cannot be read.
function failed(error) {
  trouble(`The run in this page cannot be shown: ${error.message}`);
  log.toggle();
}
listenToKeys({
  keys: keysOf({ state, actions, toolbar, inspector, picture, viewpoints, past, film, help, log, list, functionKeys }),
  digit: (number, { shiftKey }) => (shiftKey ? viewpoints.store(number) : viewpoints.recall(number)),
  first: (event) => functionKeys.down(event) || (state.editor ?? editorLink)?.key(event) || (!state.editor && (palette.key(event) || (!takesText(event.target) && state.control === "granted" && moves.key(event)))),
  isReady: () => state.world !== null,
});

function showState() {
  toolbar.setStatus(state.status, state.connected);
  banner.show();
}

// The server edits a file instead of showing a run.
let loadingEditor = null;
function startEditor() {
  state.status = { phase: "editing", real_time_factor: 0, speed_wanted: 1, processes: [] };
  loadingEditor ??= import("./edit/editor.js").then(({ Editor }) => {
    tools.hide("undo", "function_keys", "rays", "bodies", "links", "heat", "swarm", "aboard", "film");
    for (const name of ["trails", "beams"]) toolbar.toggles[name].hidden = true;
    palette.element.remove(); // the editor has its own
    state.editor = new Editor({ app, main, picture, left: list.element, send, showRun: () => changePage(true), choose: (chosen) => actions.showChosen(chosen) });
    if (state.control === "granted") state.editor.begin();
  });
  showState();
}

// Goes from the editor to its run, or back, with the same view.
function changePage(toRun) {
  const address = new URL(location.href);
  if (toRun) address.searchParams.set("run", "1");
  else address.searchParams.delete("run");
  if (picture.wanted !== "auto") address.searchParams.set("quality", picture.wanted);
  const select = state.selected === null ? null : state.world.ids[state.selected];
  address.hash = picture.view?.world ? writeLink({ view: picture.view.viewpoint, select }) : "";
  location.assign(address);
}

function sendVisibility() {
  send({ do: "frame_period", ms: document.hidden ? HIDDEN_PERIOD_MS : 0 });
}
document.addEventListener("visibilitychange", sendVisibility);

function drawNext(now) {
  requestAnimationFrame(drawNext);
  if (state.linkWaits && state.frame && picture.view?.world) {
    state.linkWaits = false;
    if (state.world.beginsAtViewpoint && !linked.view) picture.stand(viewpoints.all[0]);
    actions.openLink(linked);
  }
  past.advance(now);
  if (picture.draw(now)) {
    if (state.drawn++ === 0) state.firstPicture = performance.now();
    film.draw();
  }
  inspector.draw();
}
requestAnimationFrame(drawNext);

// The user entered another address of the same page: a token, or a link.
window.addEventListener("hashchange", () => {
  authority.addressChanged();
  if (state.world && picture.view?.world) actions.openLink(readLink(location.hash.slice(1)));
});
setInterval(() => {
  if (picture.motion) list.render(picture.motion);
  palette.show(state.live, !recorded && !state.editor && state.control === "granted" && !past.isOn);
}, 250);
showState();

window.swarmanoid = pageHook({ state, moves, palette, past, timeline, viewpoints, list, picture, inspector, select, toggle, approach, colourBy: (name) => actions.colourBy(name), send });
