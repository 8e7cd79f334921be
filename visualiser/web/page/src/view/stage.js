// The renderer, the camera and the light. Draws when something has changed, and not otherwise.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { themes } from "./look.js";

const OBLIQUE = [0.1, -0.8, 0.8]; // from the target to the camera

export class Stage {
  // smoothEdges stays as it is; all else follows the quality.
  constructor(container, smoothEdges, quality) {
    this.container = container;
    this.renderer = new THREE.WebGLRenderer({ antialias: smoothEdges, powerPreference: "high-performance" });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.domElement.className = "picture";
    container.prepend(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(45, 1, 0.02, 1000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = Math.PI * 0.495;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.invalidate());
    this.controls.addEventListener("start", () => (this.home = null));
    this.controls.listenToKeyEvents(window);
    this.controls.keyPanSpeed = 20;

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

  // Pixels that one radian of the picture takes: for sizes on the screen.
  get pixelsPerRadian() {
    return this.container.clientHeight / ((this.camera.fov * Math.PI) / 180);
  }

  invalidate() {
    this.stale = true;
  }

  // How near and far the camera may be.
  setReach([width, depth]) {
    this.extent = Math.max(width, depth, 1);
    this.camera.near = Math.max(0.01, this.extent / 2000);
    this.camera.far = this.extent * 20 + 50;
    this.camera.updateProjectionMatrix();
    this.controls.maxDistance = this.extent * 6 + 10;
    this.controls.minDistance = 0.15;
  }

  // The whole arena in view. how: "oblique" or "top".
  frameArena(arena, how = "oblique") {
    const [width, depth, height] = arena;
    this.setReach(arena);
    const { camera } = this;
    const direction = how === "top" ? new THREE.Vector3(0, -0.001, 1) : new THREE.Vector3(...OBLIQUE);
    direction.normalize();
    const corners = [0, width].flatMap((x) => [0, depth].flatMap((y) => [0, Math.min(height, 0.3)].map((z) => new THREE.Vector3(x, y, z))));
    const target = new THREE.Vector3(width / 2, depth / 2, 0);
    let distance = this.extent * 2;
    // The corners' rectangle on the screen is centred and then fitted; some rounds, for the perspective changes it.
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
    this.controls.update();
    this.home = [arena, how]; // until the user moves the camera
    this.invalidate();
  }

  // Moves camera and target to look at a point from near by.
  approach(point, distance) {
    this.home = null;
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

  // Metres that the picture shows from top to bottom at the point that is looked at, for each metre of distance.
  get spanOfDistance() {
    return 2 * Math.tan((this.camera.fov * Math.PI) / 360);
  }

  // What is looked at, how much of it, and from where: the same for every view.
  get viewpoint() {
    const away = this.camera.position.clone().sub(this.controls.target);
    return { target: this.controls.target.toArray(), span: away.length() * this.spanOfDistance, direction: away.normalize().toArray() };
  }
  set viewpoint({ target, span, direction }) {
    this.home = null;
    this.controls.target.fromArray(target);
    const from = new THREE.Vector3(...(direction ?? OBLIQUE)).normalize();
    this.camera.position.copy(this.controls.target).addScaledVector(from, span / this.spanOfDistance);
    this.controls.update();
    this.invalidate();
  }

  // The sun stands above what is looked at; so its shadow map covers that, and not the whole arena.
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
