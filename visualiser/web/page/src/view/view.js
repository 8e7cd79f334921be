// The picture of the experiment: brings stage, arena, swarm and overlays together, and draws when there is something new.
import * as THREE from "three";
import { Motion } from "../world.js";
import { Arena } from "./arena.js";
import { extentOf } from "./models.js";
import { Beams, Grips, Labels, SelectionRing, Trails } from "./overlays.js";
import { floorPoint, pick } from "./picking.js";
import { Governor, drawsInSoftware, qualities } from "./quality.js";
import { Stage } from "./stage.js";
import { Swarm } from "./swarm.js";

const SHADOWS_UP_TO = 2500; // robots
const RING_PIXELS = 7; // least radius of the ring about the selected entity

export class View {
  // actions: select(entity), approach(entity), move(entity, point)
  // meshes: the models that all renderers share
  // wanted: one of quality.js, or "auto"
  constructor(container, wanted, meshes, actions) {
    this.container = container;
    this.meshes = meshes;
    this.actions = actions;
    const slow = drawsInSoftware();
    this.governor = new Governor(slow ? "low" : "high");
    this.wanted = wanted;
    this.stage = new Stage(container, !slow && wanted !== "low" && wanted !== "least", this.quality, meshes.palette);
    this.stage.onTheme = () => this.rebuildArena();
    this.ring = new SelectionRing(this.stage.scene);
    this.shows = { ids: false, trails: false, beams: true, shadows: false };
    this.selected = null;
    this.followed = null;
    this.listenToPointer();
  }

  setWorld(world) {
    this.labels?.dispose();
    for (const overlay of [this.beams?.group, this.grips?.lines, this.trails?.lines]) overlay?.removeFromParent();
    const { scene } = this.stage;
    this.world = world;
    this.motion = new Motion(world.movable.length);
    this.beams = new Beams(scene, world);
    this.grips = new Grips(scene, world);
    this.trails = new Trails(scene, world);
    this.labels = new Labels(this.container, world);
    this.followed = null;
    this.rebuildArena();
    this.rebuildSwarm();
    for (const name of ["ids", "trails", "beams"]) this.show(name, this.shows[name]);
    this.stage.frameArena(world.arena);
  }

  get qualityName() {
    return this.wanted === "auto" ? this.governor.quality : this.wanted;
  }
  get quality() {
    return qualities[this.qualityName];
  }

  // wanted: one of quality.js, or "auto"
  setQuality(wanted) {
    this.wanted = wanted;
    this.applyQuality();
  }

  applyQuality() {
    this.stage.setQuality(this.quality);
    this.onQuality?.();
    if (!this.world) return;
    this.rebuildArena();
    this.rebuildSwarm();
  }

  rebuildSwarm() {
    this.swarm?.dispose();
    this.swarm = new Swarm(this.stage.scene, this.world, this.quality, this.meshes);
    if (this.motion.frame) this.swarm.updateColours(this.motion.frame);
    this.show("shadows", this.quality.shadows && this.world.robots.length <= SHADOWS_UP_TO);
  }

  rebuildArena() {
    if (!this.world) return;
    this.arena?.dispose();
    this.arena = new Arena(this.stage.scene, this.world, this.stage.theme, this.quality);
    if (this.colours) this.arena.paint(this.colours);
  }

  paint(colours) {
    this.colours = colours;
    this.arena.paint(colours);
    this.stage.invalidate();
  }

  show(name, on) {
    this.shows[name] = on;
    if (name === "ids") this.labels.visible = on;
    if (name === "trails") this.trails.visible = on;
    if (name === "beams") {
      this.beams.group.visible = on;
      this.grips.on = on;
      this.grips.lines.visible &&= on;
    }
    if (name === "shadows") {
      this.stage.castsShadows = on && this.quality.shadows;
      this.swarm.castsShadows = this.stage.castsShadows;
    }
    if (this.motion) this.motion.settled = false;
    this.stage.invalidate();
  }

  addFrame(frame, now) {
    if (frame.count !== this.world.movable.length) return;
    this.motion.add(frame, now);
    this.swarm.updateColours(frame);
    this.trails.add(frame);
  }

  select(entity) {
    this.selected = entity;
    if (this.followed !== null && this.followed !== entity) this.followed = null;
    this.stage.invalidate();
  }

  follow(entity) {
    this.followed = entity;
    if (entity === null) return;
    const place = this.placeOf(entity);
    this.lastFollowed = place && new THREE.Vector3(...place);
  }

  // null while it is not in the arena.
  placeOf(entity) {
    const slot = this.world.slots[entity];
    if (slot < 0) return this.world.bodyOf.get(entity).position;
    return this.motion.frame && this.motion.isPresent(slot) ? this.motion.positions.subarray(3 * slot, 3 * slot + 3) : null;
  }

  approach(entity) {
    const place = this.placeOf(entity);
    if (!place) return;
    const { radius, height } = extentOf(this.world, entity);
    this.stage.approach(new THREE.Vector3(place[0], place[1], place[2] + height / 2), Math.max(9 * radius, 1));
    if (this.followed === entity) this.follow(entity);
  }

  // Called for every picture of the browser.
  draw(now) {
    if (!this.world) return false;
    const drew = this.drawWhatChanged(now);
    if (this.governor.observe(now, drew) && this.wanted === "auto") this.applyQuality();
    return drew;
  }

  drawWhatChanged(now) {
    this.stage.controls.update();
    const moved = this.motion.sample(now);
    if (moved && this.followed !== null) {
      // One that leaves the arena is waited for where it was.
      const at = this.placeOf(this.followed);
      const place = at && new THREE.Vector3(...at);
      if (place && this.lastFollowed) this.stage.shift(place.clone().sub(this.lastFollowed));
      this.lastFollowed = place;
    }
    if (!moved && !this.stage.stale) return false;
    this.stage.camera.updateMatrixWorld();
    this.swarm.place(this.motion, this.stage.camera, this.stage.pixelsPerRadian);
    this.arena.place(this.motion, this.stage.camera.position);
    if (this.motion.frame) {
      this.beams.update(this.motion.frame, this.motion);
      this.grips.update(this.motion.frame, this.motion);
    }
    this.placeRing();
    this.stage.draw();
    this.labels.update(this.stage.camera, this.motion, this.selected);
    return true;
  }

  placeRing() {
    const place = this.selected === null ? null : this.placeOf(this.selected);
    if (!place) return this.ring.update(null);
    const slot = this.world.slots[this.selected];
    const distance = this.stage.camera.position.distanceTo(new THREE.Vector3(...place));
    const least = (RING_PIXELS * distance) / this.stage.pixelsPerRadian;
    this.ring.update(place, slot >= 0 ? this.motion.yaw(slot) : 0, Math.max(extentOf(this.world, this.selected).radius, least));
  }

  // Where an entity is in the picture, in CSS pixels of the page.
  project(entity) {
    const [x, y, z] = this.placeOf(entity);
    return this.projectPoint(x, y, z + extentOf(this.world, entity).height / 2);
  }

  projectPoint(x, y, z) {
    const point = new THREE.Vector3(x, y, z).project(this.stage.camera);
    const box = this.stage.renderer.domElement.getBoundingClientRect();
    return { x: box.left + ((point.x + 1) / 2) * box.width, y: box.top + ((1 - point.y) / 2) * box.height };
  }

  ray(event) {
    const box = this.stage.renderer.domElement.getBoundingClientRect();
    return [((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2];
  }

  pick(event) {
    return this.world && this.motion.frame ? pick(this.world, this.motion, this.stage.camera, ...this.ray(event)) : null;
  }

  // A click selects, shift and drag moves a robot, everything else is the camera's.
  listenToPointer() {
    const canvas = this.stage.renderer.domElement;
    let start = null;
    canvas.addEventListener(
      "pointerdown",
      (event) => {
        start = event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
        if (!event.shiftKey || event.button !== 0) return;
        const entity = this.pick(event);
        if (entity === null || !this.actions.mayMove()) return;
        this.dragged = entity;
        this.stage.controls.enabled = false;
        canvas.setPointerCapture(event.pointerId);
      },
      true,
    );
    canvas.addEventListener("pointermove", (event) => {
      if (this.dragged === undefined) return;
      const height = this.placeOf(this.dragged)[2];
      this.dropPoint = floorPoint(this.stage.camera, ...this.ray(event), height);
      if (!this.dropPoint) return;
      this.ring.update(this.dropPoint.toArray(), 0, extentOf(this.world, this.dragged).radius);
      this.stage.draw();
    });
    canvas.addEventListener("pointerup", (event) => {
      const clicked = start && Math.hypot(event.clientX - start.x, event.clientY - start.y) < 4;
      if (this.dragged !== undefined) {
        if (this.dropPoint && !clicked) this.actions.move(this.dragged, this.dropPoint);
        // Only now: the panel that opens moves the picture.
        this.actions.select(this.dragged);
        this.dragged = this.dropPoint = undefined;
        this.stage.controls.enabled = true;
        this.stage.invalidate();
      } else if (clicked) this.actions.select(this.pick(event));
      start = null;
    });
    canvas.addEventListener("dblclick", (event) => {
      const entity = this.pick(event);
      if (entity !== null) this.actions.approach(entity);
    });
  }
}
