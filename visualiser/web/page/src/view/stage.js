// The renderer, the camera and the light. It draws only when something has changed.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { isSoftware } from "./graphics.js";
import { themes } from "./look.js";
import { FIELD_OF_VIEW, viewOf } from "./viewpoints.js";

const OBLIQUE = [0.1, -0.8, 0.8]; // from the target to the camera
const STEEPEST = Math.PI / 2 - 0.01; // limit for the arrow keys, and …
const FLATTEST = 0.02;
const radians = Math.PI / 180;
// Rotates the axes of a camera (x right, y up, looking along -z) to those of a robot (x ahead, z up).
const AHEAD = new THREE.Quaternion().setFromRotationMatrix(
  new THREE.Matrix4().makeBasis(new THREE.Vector3(0, -1, 0), new THREE.Vector3(0, 0, 1), new THREE.Vector3(-1, 0, 0)),
);

export class Stage {
  // `smoothEdges` is fixed; everything else follows the quality.
  constructor(container, smoothEdges, quality) {
    this.container = container;
    this.renderer = new THREE.WebGLRenderer({ antialias: smoothEdges, powerPreference: "high-performance" });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.domElement.className = "picture";
    container.prepend(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, 0.02, 1000);
    this.held = false; // whether the camera was placed explicitly, and not by the controls
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = Math.PI * 0.495;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.invalidate());
    this.controls.addEventListener("start", () => {
      this.home = null;
      this.held = false;
    });

    this.hemisphere = new THREE.HemisphereLight();
    this.hemisphere.position.set(0, 0, 1);
    this.sun = new THREE.DirectionalLight(0xffffff, 2);
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = 0.004;
    this.sun.shadow.radius = 3;
    this.scene.add(this.hemisphere, this.sun, this.sun.target);

    const dark = window.matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", () => this.applyTheme(dark.matches));
    this.applyTheme(dark.matches);
    this.home = null;
    this.setQuality(quality);
    new ResizeObserver(() => this.resize()).observe(container);
  }

  setQuality({ ratio }) {
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, ratio));
    this.resize();
  }

  applyTheme(dark) {
    this.theme = dark ? themes.dark : themes.light;
    this.scene.background = new THREE.Color(this.theme.background);
    this.hemisphere.color.set(this.theme.sky);
    this.hemisphere.groundColor.set(this.theme.ground);
    this.hemisphere.intensity = this.theme.hemisphere;
    this.sun.intensity = this.theme.sun;
    this.onTheme?.();
    this.invalidate();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.container;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (this.home) this.frameArena(...this.home);
    this.invalidate();
  }

  get size() {
    return [this.container.clientWidth, this.container.clientHeight];
  }
  get isNight() {
    return this.theme === themes.dark;
  }
  // Returns whether the processor draws.
  get isSoftware() {
    return isSoftware(this.renderer.getContext());
  }

  // Returns the pixels of one radian of the picture, for sizes on the screen.
  get pixelsPerRadian() {
    return this.container.clientHeight / ((this.camera.fov * Math.PI) / 180);
  }

  invalidate() {
    this.stale = true;
  }

  // Sets how near and far the camera may be.
  setReach([width, depth]) {
    this.extent = Math.max(width, depth, 1);
    this.camera.near = Math.max(0.01, this.extent / 2000);
    this.camera.far = this.extent * 20 + 50;
    this.camera.updateProjectionMatrix();
    this.controls.maxDistance = this.extent * 6 + 10;
    this.controls.minDistance = 0.15;
  }

  // Shows the whole arena. `how`: "oblique" or "top".
  frameArena(arena, how = "oblique") {
    const [width, depth, height] = arena;
    this.setReach(arena);
    const { camera } = this;
    const direction = how === "top" ? new THREE.Vector3(0, -0.001, 1) : new THREE.Vector3(...OBLIQUE);
    direction.normalize();
    const corners = [0, width].flatMap((x) => [0, depth].flatMap((y) => [0, Math.min(height, 0.3)].map((z) => new THREE.Vector3(x, y, z))));
    const target = new THREE.Vector3(width / 2, depth / 2, 0);
    let distance = this.extent * 2;
    // The rectangle of the corners on the screen is centred and then fitted. Several rounds are needed, since the
    // perspective changes it.
    for (let round = 0; round < 6; round++) {
      camera.position.copy(target).addScaledVector(direction, distance);
      camera.lookAt(target);
      camera.updateMatrixWorld();
      const box = new THREE.Box2();
      for (const corner of corners) box.expandByPoint(corner.clone().project(camera));
      const size = box.getSize(new THREE.Vector2());
      const centre = box.getCenter(new THREE.Vector2());
      const half = Math.tan((camera.fov * Math.PI) / 360) * distance;
      target.addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 0), centre.x * half * camera.aspect);
      target.y += (centre.y * half) / Math.max(direction.z, 0.3);
      distance *= Math.max(size.x / 2 / 0.93, size.y / 2 / 0.9);
    }
    camera.position.copy(target).addScaledVector(direction, distance);
    this.controls.target.copy(target);
    this.held = false;
    this.controls.update();
    this.home = [arena, how]; // until the user moves the camera
    this.invalidate();
  }

  // Places the camera exactly, until the user moves it. Unlike the controls, it may be below the floor or roll.
  // `camera`: as in viewpoints.js.
  stand(camera) {
    const { position, heading, pitch, roll } = camera;
    const turn = new THREE.Quaternion().setFromEuler(new THREE.Euler(roll * radians, -pitch * radians, heading * radians, "ZYX"));
    this.put(new THREE.Vector3(...position), turn);
  }

  // `turn`: rotation of the axes of a robot.
  put(position, turn) {
    this.home = null;
    this.held = true;
    this.camera.position.copy(position);
    this.camera.quaternion.copy(turn).multiply(AHEAD);
    this.camera.updateMatrixWorld();
    const ahead = new THREE.Vector3(0, 0, -1).applyQuaternion(this.camera.quaternion);
    const pitch = Math.asin(Math.max(-1, Math.min(1, ahead.z))) / radians;
    const heading = Math.atan2(ahead.y, ahead.x) / radians;
    this.controls.target.fromArray(viewOf({ position: position.toArray(), heading, pitch }, this.extent).target);
    this.invalidate();
  }

  // Returns from an explicitly placed camera to the controls.
  release() {
    if (!this.held) return;
    this.held = false;
    this.controls.update();
    this.invalidate();
  }

  // Turns the camera about its target by radians, like the arrow keys of the windows.
  orbit(right, up) {
    this.release();
    const { viewpoint } = this;
    const [x, y, z] = viewpoint.direction;
    const azimuth = Math.atan2(y, x) - right;
    const height = Math.max(FLATTEST, Math.min(STEEPEST, Math.asin(z) + up));
    this.viewpoint = { ...viewpoint, direction: [Math.cos(height) * Math.cos(azimuth), Math.cos(height) * Math.sin(azimuth), Math.sin(height)] };
  }

  // Moves camera and target to look at a point from nearby.
  approach(point, distance) {
    this.home = null;
    this.held = false;
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    if (direction.z < 0.35) direction.setZ(0.35).normalize();
    this.controls.target.copy(point);
    this.camera.position.copy(point).addScaledVector(direction, distance);
    this.controls.update();
    this.invalidate();
  }

  shift(delta) {
    this.home = null;
    this.controls.target.add(delta);
    this.camera.position.add(delta);
    this.invalidate();
  }

  // Returns the metres that the picture shows from top to bottom at the target, for each metre of distance.
  get spanOfDistance() {
    return 2 * Math.tan((this.camera.fov * Math.PI) / 360);
  }

  // Returns the target, the shown size, and the direction: the same for every view.
  get viewpoint() {
    const away = this.camera.position.clone().sub(this.controls.target);
    return { target: this.controls.target.toArray(), span: away.length() * this.spanOfDistance, direction: away.normalize().toArray() };
  }
  set viewpoint({ target, span, direction }) {
    this.home = null;
    this.held = false;
    this.controls.target.fromArray(target);
    const from = new THREE.Vector3(...(direction ?? OBLIQUE)).normalize();
    this.camera.position.copy(this.controls.target).addScaledVector(from, span / this.spanOfDistance);
    this.controls.update();
    this.invalidate();
  }

  // Places the sun above the target, so that its shadow map covers the visible part and not the whole arena.
  aimSun() {
    const distance = this.camera.position.distanceTo(this.controls.target);
    const reach = Math.min(Math.max(distance * 0.95, 0.8), (this.extent ?? 10) * 1.1);
    const { sun } = this;
    sun.target.position.copy(this.controls.target);
    sun.position.copy(this.controls.target).add(new THREE.Vector3(-0.45, -0.6, 1).multiplyScalar(reach * 2 + 3));
    const box = sun.shadow.camera;
    [box.left, box.right, box.bottom, box.top] = [-reach, reach, -reach, reach];
    box.near = 0.1;
    box.far = reach * 7 + 10;
    box.updateProjectionMatrix();
  }

  get castsShadows() {
    return this.sun.castShadow;
  }
  set castsShadows(on) {
    this.sun.castShadow = on;
    this.invalidate();
  }

  draw() {
    this.aimSun();
    this.renderer.render(this.scene, this.camera);
    this.stale = false;
  }
}
