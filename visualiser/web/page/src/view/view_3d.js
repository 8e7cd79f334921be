// The view in three dimensions: joins stage, arena, swarm and overlays. It is loaded on demand.
import * as THREE from "three";
import { Arena } from "./arena.js";
import { extentOf } from "./look.js";
import { Beams, Grips, MarkLines, Trails } from "./beams_and_trails.js";
import { floorPoint, pick, sight } from "./pick_entity.js";
import { Stage } from "./stage.js";
import { Swarm3d } from "./swarm_3d.js";

const SHADOWS_UP_TO = 2500; // robots
const WHEEL_STEP = 1.2;
const HEAT_M = 0.0015; // above the floor
const ARROW = (5 * Math.PI) / 180; // angle by which an arrow key turns the view
const ABOVE_M = 0.02; // height of the eye above a robot's body …
const FLYING_M = 0.5; // … or below the body of a robot that is higher than this

export class View3d {
  // `picture`: the content that all views show; `meshes`: the models that all renderers share; `smoothEdges`: fixed,
  // while everything else follows the quality. Throws if the browser has no WebGL 2.
  constructor(container, picture, meshes, smoothEdges) {
    this.picture = picture;
    this.meshes = meshes;
    this.quality = picture.quality;
    this.stage = new Stage(container, smoothEdges, this.quality);
    this.canvas = this.stage.renderer.domElement;
    this.stage.onTheme = () => {
      this.rebuildArena();
      if (this.swarm) this.swarm.night = this.stage.isNight;
    };
  }

  setWorld(world) {
    for (const overlay of [this.beams?.group, this.grips?.lines, this.trails?.lines, this.marks?.group, this.drawn?.group]) overlay?.removeFromParent();
    const { scene } = this.stage;
    this.world = world;
    this.beams = new Beams(scene, world);
    this.grips = new Grips(scene, world);
    this.trails = new Trails(scene, this.picture.trails);
    this.marks = new MarkLines(scene);
    this.drawn = null;
    this.rebuildArena();
    this.rebuildSwarm();
    this.stage.setReach(world.arena);
  }

  setQuality(quality) {
    if (quality === this.quality) return;
    this.quality = quality;
    this.stage.setQuality(quality);
    if (!this.world) return;
    this.rebuildArena();
    this.rebuildSwarm();
  }

  rebuildSwarm() {
    const { motion } = this.picture;
    this.swarm?.dispose();
    this.swarm = new Swarm3d(this.stage.scene, this.world, this.quality, this.meshes, this.stage.isNight);
    if (motion.frame) this.swarm.updateColours(motion.frame);
    this.picture.shows.shadows = this.quality.shadows && this.world.robots.length <= SHADOWS_UP_TO;
    this.applyShows();
  }

  rebuildArena() {
    if (!this.world) return;
    this.arena?.dispose();
    const textured = this.picture.shows.textures && !this.quality.plain;
    this.arena = new Arena(this.stage.scene, this.world, this.stage.theme, { ...this.quality, plain: !textured });
    this.textured = this.picture.shows.textures;
    if (this.picture.colours) this.arena.paint(this.picture.colours);
  }

  paint(colours) {
    this.arena.paint(colours);
    this.stage.invalidate();
  }

  // Handles another picture of the heat map, which lies on the floor.
  updateHeat() {
    const canvas = this.picture.heat?.canvas;
    if (!canvas || this.heat?.canvas !== canvas) {
      this.heat?.mesh.removeFromParent();
      this.heat = null;
    }
    if (canvas && !this.heat) {
      const [width, depth] = this.world.arena;
      const map = new THREE.CanvasTexture(canvas);
      map.colorSpace = THREE.SRGBColorSpace;
      map.flipY = false; // the first row has the lowest y
      const mesh = new THREE.Mesh(new THREE.PlaneGeometry(width, depth), new THREE.MeshBasicMaterial({ map, transparent: true, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -1 }));
      mesh.position.set(width / 2, depth / 2, HEAT_M);
      this.stage.scene.add(mesh);
      this.heat = { canvas, map, mesh };
    }
    if (this.heat) this.heat.map.needsUpdate = true;
    this.stage.invalidate();
  }

  applyShows() {
    const { shows } = this.picture;
    if (this.textured !== shows.textures) this.rebuildArena();
    this.beams.group.visible = shows.beams;
    this.stage.castsShadows = this.swarm.castsShadows = shows.shadows && this.quality.shadows;
    this.stage.invalidate();
  }

  addFrame(frame) {
    this.swarm.updateColours(frame);
  }

  // Returns false if nothing has changed. `moved`: whether robots have moved since the last picture.
  draw(moved) {
    if (this.picture.aboard !== null) this.lookFromRobot();
    if (!this.stage.held) this.stage.controls.update();
    if (!moved && !this.stage.stale) return false;
    const { motion, shows } = this.picture;
    this.stage.camera.updateMatrixWorld();
    this.swarm.place(motion, this.stage.camera, this.stage.pixelsPerRadian, this.stage.size, this.stage.renderer.getPixelRatio());
    this.arena.place(motion, this.stage.camera.position);
    if (motion.frame) {
      this.beams.update(motion.frame, motion);
      this.grips.update(motion.frame, motion, shows.beams);
    }
    this.trails.update();
    this.marks.update(this.picture.marks.lines(this.stage.theme));
    this.showDrawing(this.picture.shownDrawing);
    this.stage.draw();
    return true;
  }

  // The code for drawings is loaded for the first drawing, since few experiments have any.
  showDrawing(drawing) {
    if (drawing && !this.drawn && this.Drawing3d) this.drawn = new this.Drawing3d(this.stage.scene);
    if (this.drawn) this.drawn.update(drawing);
    else if (drawing && !this.loadingDrawn) this.loadDrawn();
  }

  async loadDrawn() {
    this.loadingDrawn = true;
    try {
      this.Drawing3d = (await import("./drawing_3d.js")).Drawing3d;
      this.stage.invalidate();
    } catch (error) {
      this.picture.actions.trouble(`What experiment functions draw is not shown: ${error.message}`);
    }
  }

  // Places the camera on the robot that carries it, with the robot's orientation and the user's gaze. If the robot is
  // not in the arena, its last position is kept.
  lookFromRobot() {
    const { aboard, gaze, motion } = this.picture;
    const place = this.picture.placeOf(aboard);
    if (!place) return;
    const turn = new THREE.Quaternion().fromArray(motion.quaternions, 4 * this.world.slots[aboard]);
    const height = place[2] > FLYING_M ? -ABOVE_M : extentOf(this.world, aboard).height + ABOVE_M;
    const eye = new THREE.Vector3(0, 0, height).applyQuaternion(turn).add(new THREE.Vector3(...place));
    turn.multiply(new THREE.Quaternion().setFromEuler(new THREE.Euler(0, -gaze.pitch, gaze.yaw, "ZYX")));
    const { camera } = this.stage;
    const [before, was] = [camera.position.clone(), camera.quaternion.clone()];
    const stale = this.stage.stale;
    this.stage.put(eye, turn);
    this.stage.stale = stale || before.distanceToSquared(eye) > 0 || was.angleTo(camera.quaternion) > 0;
  }

  // `on`: whether a robot carries the camera.
  board(on) {
    this.stage.controls.enabled = !on;
    if (!on) this.stage.release();
  }

  invalidate() {
    this.stage.invalidate();
  }

  show(on) {
    this.canvas.hidden = !on;
    this.stage.controls.enabled = on;
    if (on) this.stage.resize();
  }

  holdCamera(on) {
    this.stage.controls.enabled = !on && this.picture.aboard === null;
  }
  // `camera`: as in viewpoints.js.
  stand(camera) {
    this.stage.stand(camera);
  }
  // Handles arrow keys.
  step(right, up) {
    this.stage.orbit(right * ARROW, up * ARROW);
  }

  get home() {
    return this.stage.home?.[1] ?? null;
  }
  frameArena(how) {
    this.stage.frameArena(this.world.arena, how);
  }
  get viewpoint() {
    return this.stage.viewpoint;
  }
  set viewpoint(viewpoint) {
    this.stage.viewpoint = viewpoint;
  }
  get eye() {
    return this.stage.camera.position.toArray();
  }
  shift(dx, dy, dz) {
    this.stage.shift(new THREE.Vector3(dx, dy, dz));
  }
  zoom(steps) {
    const { viewpoint } = this;
    this.viewpoint = { ...viewpoint, span: viewpoint.span * WHEEL_STEP ** -steps };
  }

  approach(entity, place) {
    const { radius, height } = extentOf(this.world, entity);
    this.stage.approach(new THREE.Vector3(place[0], place[1], place[2] + height / 2), Math.max(9 * radius, 1));
  }

  // Returns the CSS pixels of the canvas and `depth`, the squared distance from the eye; null if the point is not in
  // front of the eye.
  project(x, y, z) {
    this.point ??= new THREE.Vector3();
    const { camera, container } = this.stage;
    const depth = this.point.set(x, y, z).distanceToSquared(camera.position);
    this.point.project(camera);
    if (this.point.z > 1) return null;
    return { x: ((this.point.x + 1) / 2) * container.clientWidth, y: ((1 - this.point.y) / 2) * container.clientHeight, depth };
  }

  // Returns the CSS pixels of a metre at a place.
  pixelsPerMetre(x, y, z) {
    return this.stage.pixelsPerRadian / this.stage.camera.position.distanceTo(new THREE.Vector3(x, y, z));
  }

  ray({ x, y }) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    return [(x / width) * 2 - 1, 1 - (y / height) * 2];
  }
  pick(at) {
    return pick(this.world, this.picture.motion, this.stage.camera, ...this.ray(at));
  }
  // Returns the ray of sight.
  sight(at) {
    return sight(this.stage.camera, ...this.ray(at));
  }
  // Returns [x, y, z] on the plane of that height; null if the ray of sight does not meet it.
  floorPoint(at, height) {
    return floorPoint(this.stage.camera, ...this.ray(at), height)?.toArray() ?? null;
  }

  // Returns how much wider than they are robots are drawn, at most.
  get enlargement() {
    return this.swarm.enlargement;
  }

  get details() {
    return this.swarm.herds.map(({ slots, layers, far }) => ({ robots: slots.length, drawn: [...layers.map((layer) => layer?.count ?? 0), far] }));
  }
}
