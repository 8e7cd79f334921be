// The actions of users by keys, buttons and the picture, on the view of this page and on the run.
import { copyOrShow } from "./clipboard.js";
import { writeLink } from "./link.js";
import { poseIn } from "./move_history.js";
import { saveBlob } from "./ui/dom.js";
import { robotValues } from "./view/robot_values.js";

export class Actions {
  // `state` is that of the page; `reach` adds the parts of the page.
  constructor(state) {
    this.state = state;
  }

  // `parts`: moves, app, toolbar, list, inspector, log, picture, past, legend, tools, colourChoice, functionKeys of the page,
  // and send(request).
  reach(parts) {
    Object.assign(this, parts);
  }

  // ---- the run ----

  command(request) {
    if (this.state.control !== "granted" || this.state.editor) return;
    if (request.do === "stop") this.state.endedHere = true;
    this.send(request);
  }

  step(ticks) {
    this.command({ do: "step", ticks });
  }

  changeSpeed(step) {
    const { speed } = this.toolbar;
    const place = Math.max(0, Math.min(speed.options.length - 1, speed.selectedIndex + step));
    this.command({ do: "speed", factor: Number(speed.options[place].value) });
  }

  watch(entities) {
    this.state.watched = entities;
    this.send({ do: "watch", entities });
    this.past.again();
  }

  // Each change is {entity, place: [x, y, z], yaw}.
  move(changes) {
    const { editor, world } = this.state;
    if (editor) return editor.move(changes);
    this.steer(changes.map(({ entity, place, yaw }) => ({ do: "move", entity: world.ids[entity], position: [...place], angles: [0, 0, (yaw * 180) / Math.PI] })));
  }

  // Moves or removes entities that are in the arena, as one step that can be undone.
  steer(requests) {
    const { world, live, control, editor } = this.state;
    if (control !== "granted" || editor || !live || requests.length === 0) return;
    this.moves.add(requests.map((again) => ({ id: again.entity, again, back: { do: again.do === "remove" ? "add" : "move", entity: again.entity, ...poseIn(live, world.slots[world.find(again.entity)]) } })));
    for (const request of requests) this.command(request);
  }

  // `pose`: {x, y, z, heading} in m and degrees.
  put(entity, verb, { x, y, z, heading }) {
    const request = { do: verb, entity: this.state.world.ids[entity], position: [x, y, z], angles: [0, 0, heading] };
    if (verb === "move") this.steer([request]);
    else this.command(request);
  }

  remove(entities) {
    const { editor, world } = this.state;
    if (editor) return editor.remove();
    this.steer(entities.filter((entity) => world.slots[entity] >= 0 && this.picture.placeOf(entity)).map((entity) => ({ do: "remove", entity: world.ids[entity] })));
  }

  // ---- what is selected ----

  // With `further`, the card of the previously selected entity stays.
  select(entity, further = false) {
    if (further && entity !== null) this.inspector.keepSelected();
    this.choose(entity, entity === null ? [] : [entity]);
  }

  // Selects several entities; the inspector shows the first of them.
  selectAll(entities) {
    this.choose(entities[0] ?? null, entities);
  }

  choose(entity, chosen) {
    const { editor } = this.state;
    this.showChosen(chosen);
    if (editor) {
      editor.many = chosen.length > 1;
      if (!editor.many) editor.select(entity);
      return;
    }
    this.inspector.swarm?.clear();
    this.inspector.select(entity);
    this.inspector.setFollowed(this.picture.followed);
  }

  showChosen(chosen) {
    const entity = chosen[0] ?? null;
    if (entity !== this.state.selected) this.functionKeys.select(entity === null ? null : this.state.world.ids[entity]);
    this.state.selected = entity;
    this.picture.select(entity, chosen);
    this.list.select(entity, chosen);
  }

  // Returns the initial values of a card's form. For an entity outside the arena these are the point that the camera
  // looks at.
  poseOf(entity) {
    const { picture } = this;
    const place = picture.placeOf(entity);
    const [x, y, z] = place ?? [...picture.view.viewpoint.target.slice(0, 2), 0];
    return { x, y, z, heading: place ? (picture.yawOf(entity) * 180) / Math.PI : 0, present: place !== null };
  }

  // Adds a frame to the plots of the swarm: of the selected robots if there are several, else of all.
  countSwarm(frame) {
    const { inspector, picture, state } = this;
    const { chosen } = picture;
    const robots = chosen.length > 1 ? chosen.filter((entity) => state.world.isRobot(entity)) : state.world.robots;
    inspector.swarm?.addFrame(frame, picture.meter, robots, robots === state.world.robots);
  }

  // ---- where the camera is ----

  approach(entity) {
    this.togglePanel(false);
    this.select(entity);
    this.picture.approach(entity);
  }

  follow(entity) {
    const wanted = this.picture.followed === entity ? null : entity;
    if (wanted !== null) this.picture.approach(wanted);
    this.picture.follow(wanted);
    this.inspector.setFollowed(wanted);
  }

  frameArena(how) {
    if (!this.state.world) return;
    this.picture.frameArena(how);
    this.inspector.setFollowed(null);
  }

  board() {
    const { picture, state } = this;
    if (picture.aboard !== null) return picture.board(null);
    if (state.selected === null || !state.world.isRobot(state.selected) || !picture.placeOf(state.selected)) return this.tell("select a robot first: the camera looks from it");
    picture.board(state.selected);
    this.inspector.setFollowed(null);
  }

  // ---- what is shown ----

  toggle(name) {
    this.picture.show(name, !this.picture.shows[name]);
    if (name === "trails") this.past.needsChanged();
    this.showToggle(name);
  }

  // The button is in the bar or among the tools.
  showToggle(name) {
    this.toolbar.setToggle(name, this.picture.shows[name]);
    this.tools.set(name, this.picture.shows[name]);
  }

  // Switching the tool off also removes the measured length.
  switchTool(name) {
    const { picture } = this;
    picture[name] = !picture[name];
    if (name === "measures") picture.tape = null;
    this.tools.set(name, picture[name]);
    picture.invalidate();
  }

  colourBy(name) {
    this.colourChoice.value = name;
    this.picture.colourBy(name === "LEDs" ? null : name);
    this.past.needsChanged();
    this.legend.show(this.picture.colouring, this.state.world);
  }

  toggleHeat() {
    this.picture.showHeat(!this.picture.heat);
    this.tools.set("heat", Boolean(this.picture.heat));
    this.past.needsChanged();
  }

  // On a narrow screen the list of entities covers the picture only while the user wants it.
  togglePanel(open = !this.app.classList.contains("list-open")) {
    this.app.classList.toggle("list-open", open);
    this.toolbar.setList(open);
  }

  // ---- what is taken along ----

  // Returns the file name of a picture or film that begins now.
  fileName() {
    return `${this.state.world.experiment}_${this.state.frame?.tick ?? 0}`;
  }

  // Saves the current picture as a PNG.
  savePicture() {
    this.picture.toCanvas().toBlob((blob) => saveBlob(blob, `${this.fileName()}.png`));
  }

  // Applies a link once the experiment has been received.
  openLink(wanted) {
    const { picture, state } = this;
    if (wanted.view) picture.view.viewpoint = wanted.view;
    if (wanted.select) this.select(state.world.find(wanted.select) >= 0 ? state.world.find(wanted.select) : null);
    for (const name of wanted.shows ?? []) if (Object.hasOwn(picture.shows, name) && !picture.shows[name]) this.toggle(name);
    if (wanted.colours && Object.hasOwn(robotValues, wanted.colours)) this.colourBy(wanted.colours);
  }

  async shareLink() {
    const { picture, state } = this;
    const { viewpoint } = picture.view;
    const shows = Object.keys(picture.shows).filter((name) => picture.shows[name]);
    const select = state.selected === null ? null : state.world.ids[state.selected];
    const fragment = writeLink({ view: viewpoint, select, shows, colours: picture.colouring?.name ?? null, quality: picture.isPlan ? "plan" : null });
    const address = new URL(location.href);
    Object.assign(address, { search: "", hash: fragment });
    state.link = address.href;
    if (await copyOrShow("A link to this view", state.link)) this.tell(`copied: ${state.link}`);
  }

  // ---- what the page says ----

  tell(text, level = "info") {
    this.log.add({ tick: this.state.frame?.tick ?? null, source: "page", level, text });
  }

  trouble(text) {
    this.tell(text, "warning");
  }
}
