// Looks back at ticks of the past on the page: shows them instead of the present, and offers commands for the shown
// tick. A page that has its run itself (recording.js) has no present, and always looks back.
import { PlaybackRequests } from "./playback_requests.js";
import { PastHistory } from "./past_history.js";
import { copyOrShow } from "./clipboard.js";

const EARLIER_EVERY_MS = 10; // a server answers 200 requests a second

export class Playback {
  // `parts`: state, actions, timeline, inspector, toolbar, picture of the page; send(request); tell(text); trouble(text); changed():
  // called when the past is shown or left.
  constructor(parts) {
    Object.assign(this, parts);
    const { state, picture, inspector, timeline, actions } = this;
    this.history = new PastHistory({ picture, inspector, timeline, world: () => state.world, countSwarm: (frame) => actions.countSwarm(frame) });
    this.past = new PlaybackRequests({
      ask: (tick, isEarlier) => this.send({ do: "look_back", tick, ...(isEarlier ? { entities: inspector.entitiesOfAttributePlots, earlier: true } : { entities: state.watched }) }),
      ended: () => this.ended(),
      earlier: () => this.history.missing(),
    });
    this.details = null; // of the state that comes next
    this.pace = 1; // times real time
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
    const within = timeline.recorded(tick);
    past.look(within, performance.now());
    timeline.showPlaying(false);
    timeline.show(within);
    if (!begins) return;
    this.history.clear();
    this.picture.lookBack(true);
    this.inspector.lookBack(true);
    this.changed();
  }

  // Requests the tick again, for other details.
  again() {
    if (this.isOn) this.past.want(this.wanted, performance.now());
  }

  // Other plots, trails or colours are shown, which may need other states.
  needsChanged() {
    if (!this.isOn) return;
    this.history.show();
    this.past.askEarlier(performance.now());
  }

  // Takes the details of the state that comes next.
  takeDetails(message) {
    this.details = message.entities;
    if (!this.isOn || this.past.isEarlier) return;
    this.picture.paint(message.colours);
    this.inspector.addDetails(message);
  }

  // Takes a state of the past that has come.
  show(frame) {
    const now = performance.now();
    const { isEarlier } = this.past;
    const { details } = this;
    this.details = null;
    this.answered();
    if (!this.isOn) return;
    this.history.add(frame, details, { isShown: !isEarlier, isPlayed: this.isPlaying, now });
    if (!isEarlier) {
      this.state.frame = frame;
      this.picture.showFrame(frame, now);
      this.inspector.addFrame(frame);
      this.toolbar.setFrame(frame);
      this.timeline.show(this.isPlaying || this.state.recorded ? frame.tick : this.wanted);
    }
    this.askEarlier();
  }

  answered() {
    this.past.answered(performance.now());
  }

  askEarlier() {
    if (this.state.recorded) return this.past.askEarlier(performance.now());
    clearTimeout(this.earlierTimer);
    this.earlierTimer = setTimeout(() => this.past.askEarlier(performance.now()), EARLIER_EVERY_MS);
  }

  // Begins at the first tick if the last one is shown.
  play() {
    const { past, timeline } = this;
    if (!this.isOn || (this.state.recorded && this.wanted >= timeline.last && !this.isPlaying)) {
      this.look(timeline.first);
      if (!this.state.recorded) return;
    }
    past.play(!this.isPlaying, performance.now());
    timeline.showPlaying(this.isPlaying);
  }

  // `pace`: times real time.
  setPace(pace) {
    this.pace = pace;
    this.timeline.showPace(pace);
    if (this.isPlaying) this.past.play(true, performance.now());
  }

  changePace(step) {
    this.setPace(this.timeline.neighbourPace(this.pace, step));
  }

  // Called for each picture.
  advance(now) {
    this.past.advance(now, this.timeline.last, this.pace / (this.state.world?.tickSeconds ?? 1));
  }

  // Playing has come to the last tick.
  ended() {
    if (this.state.recorded) this.look(this.timeline.last);
    else this.live();
  }

  live() {
    if (!this.isOn || this.state.recorded) return;
    this.past.live();
    this.showPresent();
  }

  showPresent() {
    const { state } = this;
    this.timeline.showPlaying(false);
    this.timeline.show(null);
    this.history.clear();
    this.picture.lookBack(false);
    this.inspector.lookBack(false);
    if (state.colours) this.picture.paint(state.colours);
    if (state.live) {
      state.frame = state.live;
      this.picture.showFrame(state.live, performance.now());
      this.toolbar.setFrame(state.live);
    }
    this.changed();
  }

  // `steps`: the number of recorded ticks, backwards if negative.
  step(steps) {
    this.look((this.wanted ?? this.timeline.last) + steps * this.timeline.step);
  }

  jumpToEvent(forward) {
    const tick = this.timeline.neighbour(this.wanted ?? this.timeline.last + 1, forward);
    if (tick !== null) this.look(tick);
  }

  // Starts a new run from here. A page without control copies the command that does.
  branch() {
    const tick = this.wanted ?? this.timeline.last;
    const found = this.runAt(tick);
    if (found === null) return;
    if (this.state.control === "granted") {
      this.tell(`a new run begins from tick ${tick}`);
      return this.send({ do: "branch", tick });
    }
    this.state.branch = `swarmanoid run --branch ${found}`;
    this.copy(`a new run from tick ${tick}`, this.state.branch);
  }

  // Takes the answer: the address of the new run, which has its token, or why there is none.
  branched({ tick, url, error }) {
    if (error) return this.trouble(`no run has begun from tick ${tick}: ${error}`);
    this.tell(`a new run has begun from tick ${tick}`);
    this.timeline.showBranch(tick, url);
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
