// Receives frames and messages of the server, and passes them to the parts of the page.
import { FrameDecoder, isPast } from "./protocol.js";
import { isDrawing, readDrawing } from "./view/drawing_reader.js";
import { World } from "./world.js";

export class Reception {
  // `parts`: state, actions, authority, toolbar, list, inspector, log, processes, timeline, viewpoints, banner,
  // picture, past, palette, moves of the page; startEditor(); greet(): called once the server has sent its welcome; showState().
  constructor(parts) {
    Object.assign(this, parts);
    this.decoder = new FrameDecoder();
  }

  // Handles the begin or the end of a connection.
  connected(isOpen) {
    if (isOpen) {
      this.decoder = new FrameDecoder();
      this.picture.marks.forget();
      this.picture.setDrawing(null);
    }
    this.state.connected = isOpen;
    if (isOpen) this.state.endedHere = false;
    this.showState();
  }

  frame(buffer) {
    const { state, past, picture, inspector } = this;
    if (isDrawing(buffer)) return picture.setDrawing(readDrawing(buffer));
    const frame = this.decoder.decode(buffer);
    if (!frame || !state.world) return;
    if (isPast(buffer)) return past.show(frame);
    if (state.live && frame.tick < state.live.tick) this.itBegan();
    state.frames++;
    state.live = frame;
    if (past.isOn) return;
    state.frame = frame;
    picture.addFrame(frame, performance.now());
    inspector.addFrame(frame);
    this.actions.countSwarm(frame);
    this.toolbar.setFrame(frame);
  }

  message(message) {
    if (Object.hasOwn(receivers, message.type)) receivers[message.type](this, message);
  }

  // Handles a tick before the last one, or a tick after the end: a new run of the same experiment at the same address.
  itBegan() {
    const { state } = this;
    this.log.add({ tick: 0, source: "page", level: "info", text: "the experiment was started again" });
    state.status = null;
    state.live = null;
    this.moves.clear();
    this.banner.itBegan();
    this.showState();
  }

  setWorld(message) {
    const { state, picture, actions } = this;
    const selected = state.selected === null ? null : state.world.ids[state.selected];
    const chosen = picture.chosen.map((entity) => state.world.ids[entity]);
    const isNew = state.world?.experiment !== message.experiment;
    state.world = new World(message);
    this.palette.setWorld(state.world);
    this.moves.clear();
    if (isNew) this.viewpoints.set(state.world.viewpoints);
    document.title = `${message.experiment} · Swarmanoid`;
    for (const part of [this.toolbar, this.inspector, this.list, picture]) part.setWorld(state.world);
    for (const name of Object.keys(picture.shows)) actions.showToggle(name);
    const again = selected === null ? -1 : state.world.find(selected);
    state.selected = null;
    if (state.editor) actions.showChosen(chosen.map((id) => state.world.find(id)).filter((entity) => entity >= 0));
    else actions.select(again >= 0 ? again : null);
  }
}

// The handlers of messages, by type.
const receivers = {
  welcome({ log, authority, startEditor, greet }, { control, challenge, edits }) {
    log.clear();
    if (edits) startEditor();
    authority.welcome(control, challenge ?? null);
    greet();
  },
  authority: ({ authority }, { control }) => authority.grant(control),
  document: ({ state }, message) => state.editor?.receive(message),
  form: ({ state }, message) => state.editor?.receiveForm(message),
  script: ({ state }, message) => state.editor?.receiveScript(message),
  world: (page, message) => page.setWorld(message),
  status(page, message) {
    const { state } = page;
    if (state.status?.phase === "finished" && message.phase !== "finished") page.itBegan();
    state.status = message;
    page.processes.update(message);
    page.showState();
  },
  colours({ state, past, picture }, message) {
    state.colours = message;
    if (!past.isOn) picture.paint(message);
  },
  watched: ({ past, inspector }, message) => past.isOn || inspector.addDetails(message),
  timeline({ state, timeline, past }, message) {
    state.run = message.run;
    timeline.set(message, state.world?.tickSeconds);
    if (!state.recorded || past.isOn) return;
    state.world.lastTick = message.last;
    past.look(message.first);
  },
  past: ({ past }, message) => past.takeDetails(message),
  branched: ({ past }, message) => past.branched(message),
  past_inside: ({ past, inspector }, message) => past.isOn && past.wanted === message.tick && inspector.addInside(message),
  marks: ({ picture }, message) => picture.marks.receive(message),
  log({ log, palette, moves }, message) {
    log.add(message);
    palette.answer(message.text);
    moves.answer(message.text);
  },
  reply({ state, log, past }, { text }) {
    log.add({ tick: state.editor ? null : state.frame?.tick ?? null, source: "server", level: "warning", text });
    state.editor?.refused(text);
    if (past.isOn) past.answered();
  },
};
