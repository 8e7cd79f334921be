// The picture of the experiment: its content, independent of the view that draws it. The plan is part of this page. The
// view in three dimensions is loaded on demand, so that a browser that draws in software never waits for it.
import { h } from "../ui/dom.js";
import { keep, kept } from "../storage.js";
import { Motion } from "../world.js";
import { HeatMap } from "./heat_map.js";
import { extentOf } from "./look.js";
import { Overlay } from "./overlay.js";
import { PlanView } from "./plan/plan_view.js";
import { Marks } from "./marks.js";
import { listenToPointer } from "./pointer.js";
import { findGraphics } from "./graphics.js";
import { Governor, isPaced, qualities } from "./quality_levels.js";
import { Colouring, Meter } from "./robot_values.js";
import { TrailRecord } from "./trail_record.js";

const GRAPHICS_WAIT_MS = 100; // for the test for a graphics card; afterwards the plan begins
const GRAPHICS_KEY = "swarmanoid.graphics";
const STEEPEST_GAZE = 1.5; // radians
const DOWN_FROM_ABOVE = -0.6; // initial pitch of the view from a flying robot
const DOWN = -0.05; // initial pitch of the view from other robots
const HIGH_M = 0.5;
const ARROW_GAZE = 0.09; // angle of an arrow key

export class Picture {
  // `actions`: select(entity, further), selectAll(entities), approach(entity), move([{entity, place, yaw}]), mayMove(),
  // trouble(text), send(request), meshes(): the models of robots; hasServer: whether files can be fetched. `wanted`: one
  // of quality_levels.js.
  constructor(container, wanted, actions) {
    this.container = container;
    this.actions = actions;
    this.wanted = wanted;
    this.software = null; // whether WebGL is slow or missing; null: not tested yet
    this.governor = new Governor("high");
    this.shows = { ids: false, trails: false, beams: true, shadows: false, textures: true, rays: false, bodies: false, links: false };
    this.marks = new Marks(this, (request) => actions.send(request));
    this.drawing = null; // drawings of experiment functions, from drawing_reader.js
    this.looksBack = false; // shows a tick for which no drawing is stored
    this.selected = null;
    this.edits = false; // whether static entities may be selected and moved, too
    this.chosen = []; // all selected entities, including the one above
    this.followed = null;
    this.aboard = null; // the robot that carries the camera, in three dimensions
    this.gaze = { yaw: 0, pitch: 0 }; // direction of its camera, radians
    this.flight = null; // flight from viewpoint to viewpoint
    this.colouring = null; // a value that colours robots instead of their LEDs
    this.heat = null; // the heat map, if it is shown
    this.measures = false; // whether a drag measures
    this.handles = false; // whether the selected entity has handles
    this.tape = this.box = null; // the measured length, or the box of a selection
    this.ghosts = []; // positions to which entities are dragged: {entity, place, yaw}
    this.views = {};
    this.view = null; // null until a view can draw
    this.overlay = new Overlay(container, this);
    this.useWantedView();
  }

  // ---- what experiment functions draw ----

  setDrawing(drawing) {
    this.drawing = drawing;
    this.invalidate();
  }

  get shownDrawing() {
    return this.looksBack ? null : this.drawing;
  }

  // ---- which view ----

  get wantsPlan() {
    return this.wanted === "auto" ? this.software !== false : this.wanted === "plan";
  }
  get isPlan() {
    return this.view !== null && this.view === this.views.plan;
  }
  get qualityName() {
    if (this.isPlan || (this.view === null && this.wantsPlan)) return "plan";
    return isPaced(this.wanted) ? this.governor.quality : this.wanted;
  }
  // Returns the quality of the view in three dimensions.
  get quality() {
    return qualities[isPaced(this.wanted) || this.wanted === "plan" ? this.governor.quality : this.wanted];
  }

  // `wanted`: one of quality_levels.js.
  setQuality(wanted) {
    this.wanted = wanted;
    this.useWantedView();
  }

  // Switches from the plan to three dimensions, and back.
  switchView() {
    if (!this.isPlan) return this.setQuality("plan");
    this.setQuality(this.software === false ? "auto" : "3D");
  }

  async useWantedView() {
    const turn = (this.turn = (this.turn ?? 0) + 1);
    if (this.wanted === "auto" && this.software === null) {
      this.graphics ??= findGraphics(this.actions.hasServer).then((software) => {
        this.software = software;
        keep("localStorage", GRAPHICS_KEY, software ? "software" : "card");
        if (this.wanted === "auto" && !software) this.useWantedView();
      });
      // The result of the last visit is most likely still right.
      const wait = kept("localStorage", GRAPHICS_KEY) === "software" ? 0 : GRAPHICS_WAIT_MS;
      if (wait > 0) await Promise.race([this.graphics, new Promise((done) => setTimeout(done, wait))]);
      if (turn !== this.turn) return;
    }
    const name = this.wantsPlan ? "plan" : "solid";
    try {
      this.views[name] ??= name === "plan" ? new PlanView(this.container, this) : await this.loadView3d();
    } catch (error) {
      if (turn !== this.turn) return;
      this.actions.trouble(`There is no view in three dimensions: ${error.message}`);
      this.leaveRobot();
      return this.setQuality("plan");
    }
    if (turn !== this.turn) return;
    if (this.views[name] !== this.view) this.activate(this.views[name]);
    this.views.solid?.setQuality(this.quality);
    this.onQuality?.();
  }

  async loadView3d() {
    this.loading ??= Promise.all([import("./view_3d.js"), this.actions.meshes()]);
    const [{ View3d }, meshes] = await this.loading.catch((error) => {
      this.loading = null; // the next request tries again
      throw error;
    });
    if (this.views.solid) return this.views.solid;
    const view = new View3d(this.container, this, meshes, this.wanted !== "low" && this.wanted !== "least" && this.software === false);
    // Without a card the first picture has a quality that comes soon.
    if (view.stage.isSoftware) this.governor = new Governor("low");
    view.setQuality(this.quality);
    listenToPointer(view, this);
    view.canvas.hidden = true;
    return view;
  }

  activate(view) {
    const before = this.view;
    if (this.aboard !== null && view === this.views.plan) this.board(null);
    const [viewpoint, home] = before && this.world ? [before.viewpoint, before.home] : [null, "oblique"];
    before?.show(false);
    if (view === this.views.plan && !view.listens) {
      listenToPointer(view, this);
      view.listens = true;
    }
    this.view = view;
    view.show(true);
    if (!this.world) return;
    this.prepare(view);
    this.look(home, viewpoint);
    if (this.aboard !== null) view.board(true);
  }

  // Gives a new view the state that it has missed.
  prepare(view) {
    if (view.world !== this.world) view.setWorld(this.world);
    if (this.colours) view.paint(this.colours);
    if (this.motion.frame) view.addFrame(this.motion.frame);
    view.applyShows();
    view.updateHeat();
    this.motion.settled = false;
  }

  look(home, viewpoint) {
    if (home !== null) this.view.frameArena(home);
    else this.view.viewpoint = viewpoint;
  }

  // ---- what is known ----

  setWorld(world) {
    const again = this.world?.experiment === world.experiment && this.view;
    const [viewpoint, home] = again ? [this.view.viewpoint, this.view.home] : [null, "oblique"];
    this.world = world;
    this.motion = new Motion(world.movable.length);
    this.trails = new TrailRecord(world);
    this.meter = new Meter(world);
    this.present = null;
    this.colouring &&= new Colouring(world, this.colouring.name);
    this.heat &&= new HeatMap(world);
    this.trails.on = this.shows.trails;
    this.followed = null;
    if (this.aboard !== null) this.board(null);
    this.flight = null;
    this.ghosts = [];
    this.colours = null;
    this.overlay.setWorld(world);
    this.marks.setWorld(world);
    if (!this.view) return;
    this.prepare(this.view);
    this.look(home, viewpoint);
  }

  paint(colours) {
    this.colours = colours;
    this.view?.paint(colours);
  }

  addFrame(frame, now) {
    if (frame.count !== this.world.movable.length) return;
    this.meter.add(frame);
    this.trails.add(frame);
    if (this.heat?.add(frame)) this.heatChanged();
    this.showFrame(frame, now);
  }

  showFrame(frame, now) {
    const shown = this.colouring ? this.colouring.apply(frame, this.meter) : frame;
    this.motion.add(shown, now);
    this.view?.addFrame(shown);
    this.onColouring?.();
  }

  // ---- looking back ----

  // `on`: the shown states are of the past from now on. Trails and rates of the present are kept meanwhile.
  lookBack(on) {
    if (on === this.looksBack) return;
    this.looksBack = on;
    if (on) {
      this.present = { meter: this.meter, heat: this.heat };
      this.trails.keep();
      if (this.heat) this.heat = new HeatMap(this.world);
    } else {
      this.meter = this.present?.meter ?? new Meter(this.world);
      this.heat &&= this.present?.heat ?? new HeatMap(this.world);
      this.trails.restore();
      this.heatChanged();
    }
    if (this.colouring) this.colouring = new Colouring(this.world, this.colouring.name);
    this.invalidate();
  }

  // Forgets the states of the past. addPast brings them again in the order of time, up to the shown one, and endPast
  // draws them.
  beginPast() {
    this.meter = new Meter(this.world);
    this.trails.clear();
    if (this.heat) this.heat = new HeatMap(this.world);
  }

  addPast(frame) {
    this.meter.add(frame);
    this.trails.add(frame);
    this.heat?.count(frame);
  }

  endPast() {
    this.heat?.draw();
    if (this.heat) this.heatChanged();
    this.invalidate();
  }

  // `name`: one of robot_values.js, or null for the colours of LEDs.
  colourBy(name) {
    this.colouring = name === null ? null : new Colouring(this.world, name);
    if (this.meter.frame) this.showFrame(this.meter.frame, performance.now());
    this.invalidate();
  }

  showHeat(on) {
    this.heat = on ? new HeatMap(this.world) : null;
    this.heatChanged();
  }

  heatChanged() {
    this.view?.updateHeat();
    this.onHeat?.();
  }

  // Returns null while the entity is not in the arena.
  placeOf(entity) {
    const slot = this.world.slots[entity];
    if (slot < 0) return this.world.bodyOf.get(entity).position;
    return this.motion.frame && this.motion.isPresent(slot) ? this.motion.positions.subarray(3 * slot, 3 * slot + 3) : null;
  }
  yawOf(entity) {
    const slot = this.world.slots[entity];
    if (slot >= 0) return this.motion.yaw(slot);
    const [x, y, z, w] = this.world.bodyOf.get(entity).orientation;
    return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
  }
  // Returns whether the user may move the entity.
  canMove(entity) {
    return this.edits || this.world.slots[entity] >= 0;
  }

  // ---- what is wanted ----

  show(name, on) {
    this.shows[name] = on;
    if (name === "trails") {
      if (on && !this.trails?.on) this.trails?.clear();
      if (this.trails) this.trails.on = on;
    }
    if (this.motion) this.motion.settled = false;
    if (this.view?.world) this.view.applyShows();
    this.invalidate();
  }

  invalidate() {
    this.view?.invalidate();
  }

  select(entity, chosen = entity === null ? [] : [entity]) {
    this.selected = entity;
    this.chosen = chosen;
    if (this.followed !== null && this.followed !== entity) this.followed = null;
    this.invalidate();
  }

  follow(entity) {
    this.followed = entity;
    const place = entity === null ? null : this.placeOf(entity);
    this.lastFollowed = place && [...place];
  }

  approach(entity) {
    const place = this.placeOf(entity);
    if (!place || !this.view) return;
    this.leaveRobot();
    this.view.approach(entity, place);
    if (this.followed === entity) this.follow(entity);
  }

  // Looks from a robot, in three dimensions; null: from outside again.
  board(entity) {
    this.aboard = entity;
    this.flight = null;
    if (entity === null) this.views.solid?.board(false);
    else {
      this.follow(null);
      this.gaze = { yaw: 0, pitch: this.placeOf(entity)[2] > HIGH_M ? DOWN_FROM_ABOVE : DOWN };
      if (this.isPlan) this.switchView();
      else this.view.board(true);
    }
    this.onBoard?.();
    this.invalidate();
  }

  leaveRobot() {
    this.flight = null;
    if (this.aboard !== null) this.board(null);
  }

  // Turns by radians to the left and up.
  turnGaze(left, up) {
    this.gaze.yaw += left;
    this.gaze.pitch = Math.max(-STEEPEST_GAZE, Math.min(STEEPEST_GAZE, this.gaze.pitch + up));
    this.invalidate();
  }

  // Handles arrow keys: steps to the right and up.
  step(right, up) {
    this.flight = null;
    if (this.aboard !== null) this.turnGaze(-ARROW_GAZE * right, ARROW_GAZE * up);
    else this.view?.step(right, up);
  }

  // `camera`: as in viewpoints.js.
  stand(camera) {
    this.leaveRobot();
    this.follow(null);
    this.view.stand(camera);
  }

  fly(flight) {
    this.leaveRobot();
    this.follow(null);
    this.flight = flight;
  }

  frameArena(how = "oblique") {
    this.leaveRobot();
    this.follow(null);
    this.view?.frameArena(how);
  }

  // ---- drawing ----

  // Called for every picture of the browser. Returns true if the picture has changed.
  draw(now) {
    if (!this.world || !this.view) return false;
    const moved = this.motion.sample(now);
    if (moved && this.followed !== null) this.keepUp();
    if (this.flight) {
      this.view.viewpoint = this.flight.at(now);
      if (this.flight.isOver(now)) this.flight = null;
    }
    this.marks.ask(now);
    const drew = this.view.draw(moved);
    if (drew) this.overlay.draw();
    if (this.governor.observe(now, drew && !this.isPlan) && isPaced(this.wanted)) this.useWantedView();
    return drew;
  }

  // If the entity leaves the arena, the camera waits where the entity was.
  keepUp() {
    const place = this.placeOf(this.followed);
    if (place && this.lastFollowed) this.view.shift(...[0, 1, 2].map((k) => place[k] - this.lastFollowed[k]));
    this.lastFollowed = place && [...place];
  }

  // Returns the CSS pixels of the canvas at the middle of an entity.
  seen(entity) {
    const place = this.placeOf(entity);
    return place && this.view.project(place[0], place[1], place[2] + extentOf(this.world, entity).height / 2);
  }

  // Returns the current picture with the overlay.
  toCanvas() {
    this.invalidate();
    this.view.draw(true);
    const { canvas } = this.view;
    const copy = h("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    this.overlay.draw();
    if (!this.overlay.canvas.hidden) context.drawImage(this.overlay.canvas, 0, 0, copy.width, copy.height);
    return copy;
  }
}
