// Looks back at ticks of the past on the page: shows them instead of the present, and offers commands for the shown
// tick.
import { Past } from "./past.js";
import { copyOrShow } from "./clipboard.js";

const PACE = 1; // times real time

export class LookingBack {
  // `parts`: state, timeline, inspector, toolbar, picture of the page; send(request); tell(text); changed(): called
  // when the past is shown or left.
  constructor(parts) {
    Object.assign(this, parts);
    this.past = new Past({ ask: (tick) => this.send({ do: "look_back", tick, entities: this.state.watched }), ended: () => this.showPresent() });
  }

  get isOn() {
    return this.past.isOn;
  }

  // Returns the tick; null: the present.
  get wanted() {
    return this.past.wanted;
  }

  get isPlaying() {
    return this.past.playing !== null;
  }

  look(tick) {
    const { past, timeline } = this;
    if (!this.state.world || timeline.element.hidden) return;
    const begins = !past.isOn;
    const within = Math.max(timeline.first, Math.min(timeline.last, tick));
    past.look(within, performance.now());
    timeline.showPlaying(false);
    timeline.show(within);
    if (!begins) return;
    this.picture.looksBack = true;
    this.inspector.lookBack(true);
    this.changed();
  }

  // Requests the tick again, for other details.
  again() {
    if (this.isOn) this.past.want(this.wanted, performance.now());
  }

  // Shows a state of the past that has come.
  show(frame) {
    this.answered();
    if (!this.isOn) return;
    this.state.frame = frame;
    this.picture.showFrame(frame, performance.now());
    this.inspector.addFrame(frame);
    this.toolbar.setFrame(frame);
    this.timeline.show(this.isPlaying ? frame.tick : this.wanted);
  }

  answered() {
    this.past.answered(performance.now());
  }

  play() {
    if (!this.isOn) return this.look(this.timeline.first);
    this.past.play(!this.isPlaying, performance.now());
    this.timeline.showPlaying(this.isPlaying);
  }

  // Called for each picture.
  advance(now) {
    this.past.advance(now, this.timeline.last, PACE / (this.state.world?.tickSeconds ?? 1));
  }

  live() {
    if (!this.isOn) return;
    this.past.live();
    this.showPresent();
  }

  showPresent() {
    const { state } = this;
    this.timeline.showPlaying(false);
    this.timeline.show(null);
    this.picture.looksBack = false;
    this.inspector.lookBack(false);
    if (state.colours) this.picture.paint(state.colours);
    if (state.live) {
      state.frame = state.live;
      this.picture.showFrame(state.live, performance.now());
      this.toolbar.setFrame(state.live);
    }
    this.changed();
  }

  step(ticks) {
    this.look((this.wanted ?? this.timeline.last) + ticks);
  }

  jumpToEvent(forward) {
    const tick = this.timeline.neighbour(this.wanted ?? this.timeline.last + 1, forward);
    if (tick !== null) this.look(tick);
  }

  // Copies the command that starts a new run from here.
  branch() {
    const tick = this.wanted ?? this.state.frame?.tick ?? this.timeline.last;
    const found = this.runAt(tick);
    if (found === null) return;
    this.state.branch = `swarmanoid run --branch ${found}`;
    this.copy(`a new run from tick ${tick}`, this.state.branch);
  }

  // Computes what the journal lacks: the status of the selected robot.
  inspect() {
    const { state } = this;
    const found = this.isOn ? this.runAt(this.wanted) : null;
    const robot = state.selected;
    if (found === null || robot === null || state.world.controllerOf[robot] < 0) return this.tell("look back and select a robot with a controller first");
    state.inspect = `swarmanoid inspect ${found} ${shellWord(state.world.ids[robot])}`;
    this.copy(`what ${state.world.ids[robot]} sensed at tick ${this.wanted}`, state.inspect);
  }

  runAt(tick) {
    return this.timeline.element.hidden || this.state.run === null ? null : `${shellWord(this.state.run)}@${tick}`;
  }

  copy(what, command) {
    this.tell(`${what}: ${command}`);
    copyOrShow(what, command);
  }
}

const shellWord = (text) => (/^[\w./@+-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);
