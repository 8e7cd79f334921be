// What is drawn over the robots: laser beams, grips, the ring about the selected one, trails and names.
import * as THREE from "three";
import { Flag } from "../protocol.js";
import { extentOf } from "./models.js";

const BEAMS = 256;
// Of trails, in turn: neighbours can be told apart.
const TRAILS = [0x3d8bfd, 0xe08a2e, 0x2fa58a, 0xb65fcf, 0xd9575a, 0x8a9a2f, 0x4fa3c7, 0xa0785a];

// Beams with a spot where they end.
export class Beams {
  constructor(scene, world) {
    this.world = world;
    this.group = new THREE.Group();
    const beam = new THREE.CylinderGeometry(0.006, 0.006, 1, 8, 1, true).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    const look = { transparent: true, depthWrite: false, blending: THREE.NormalBlending };
    this.beams = new THREE.InstancedMesh(beam, new THREE.MeshBasicMaterial({ ...look, opacity: 0.55 }), BEAMS);
    this.spots = new THREE.InstancedMesh(new THREE.CircleGeometry(0.055, 28), new THREE.MeshBasicMaterial({ ...look, opacity: 0.9 }), BEAMS);
    for (const mesh of [this.beams, this.spots]) {
      mesh.frustumCulled = false;
      mesh.count = 0;
      mesh.renderOrder = 3;
      mesh.setColorAt(0, new THREE.Color());
      this.group.add(mesh);
    }
    scene.add(this.group);
  }

  update(frame, motion) {
    const list = frame.beams.slice(0, BEAMS);
    const colour = new THREE.Color();
    const matrix = new THREE.Matrix4();
    const from = new THREE.Vector3();
    const to = new THREE.Vector3();
    const turn = new THREE.Quaternion();
    const up = new THREE.Vector3(0, 0, 1);
    list.forEach((beam, i) => {
      from.fromArray(motion.positions, 3 * this.world.slots[beam.entity]);
      to.set(beam.x, beam.y, beam.z);
      const length = from.distanceTo(to);
      turn.setFromUnitVectors(up, to.clone().sub(from).normalize());
      this.beams.setMatrixAt(i, matrix.compose(from, turn, new THREE.Vector3(1, 1, Math.max(length, 1e-3))));
      this.spots.setMatrixAt(i, matrix.makeTranslation(to.x, to.y, to.z + 0.004));
      colour.set(beam.colour);
      this.beams.setColorAt(i, colour);
      this.spots.setColorAt(i, colour);
    });
    for (const mesh of [this.beams, this.spots]) {
      mesh.count = list.length;
      mesh.instanceMatrix.needsUpdate = true;
      mesh.instanceColor.needsUpdate = true;
    }
  }
}

// A line from each robot to what it holds, and to the ceiling if it is attached there.
export class Grips {
  constructor(scene, world) {
    this.world = world;
    this.lines = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ color: 0xf08a3c, depthTest: false, transparent: true, opacity: 0.9 }),
    );
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 4;
    this.hangers = world.robots.filter((entity) => world.kinds[entity] !== "footbot");
    this.on = true;
    scene.add(this.lines);
  }

  update(frame, motion) {
    const points = [];
    for (const entity of this.hangers) {
      const slot = this.world.slots[entity];
      if (!(frame.colours[4 * slot + 3] & Flag.attached) || !motion.isPresent(slot)) continue;
      const [x, y, z] = motion.positions.subarray(3 * slot, 3 * slot + 3);
      points.push(x, y, z + extentOf(this.world, entity).height, x, y, this.world.arena[2]);
    }
    for (const { robot, held } of frame.grips) {
      for (const entity of [robot, held]) {
        const slot = this.world.slots[entity];
        const place = slot >= 0 ? motion.positions.subarray(3 * slot, 3 * slot + 3) : this.world.bodyOf.get(entity).position;
        points.push(place[0], place[1], place[2] + extentOf(this.world, entity).height * 0.7);
      }
    }
    this.lines.visible = this.on && points.length > 0;
    if (points.length === 0) return;
    this.lines.geometry.dispose();
    this.lines.geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  }
}

// The ring on the floor about the selected entity.
export class SelectionRing {
  constructor(scene) {
    this.mesh = new THREE.Mesh(
      new THREE.RingGeometry(1.25, 1.36, 64),
      new THREE.MeshBasicMaterial({ color: 0x3d8bfd, transparent: true, opacity: 0.95, side: THREE.DoubleSide, depthWrite: false }),
    );
    this.heading = new THREE.Mesh(
      new THREE.CircleGeometry(0.3, 3).translate(1.62, 0, 0),
      this.mesh.material,
    );
    this.mesh.add(this.heading);
    this.mesh.renderOrder = 2;
    this.mesh.visible = false;
    scene.add(this.mesh);
  }

  // place: [x, y, z], or null for none
  update(place, yaw, radius) {
    this.mesh.visible = place !== null;
    if (!place) return;
    this.mesh.position.set(place[0], place[1], place[2] + 0.004);
    this.mesh.rotation.z = yaw;
    this.mesh.scale.setScalar(radius);
  }
}

// Where the robots have been: line segments in blocks, one block a sample, the oldest overwritten, fading with age.
export class Trails {
  constructor(scene, world) {
    this.world = world;
    const count = Math.max(1, world.robots.length);
    this.samples = Math.max(12, Math.min(240, Math.floor(300000 / count)));
    this.block = 6 * count;
    this.positions = new THREE.BufferAttribute(new Float32Array(this.block * this.samples), 3).setUsage(THREE.DynamicDrawUsage);
    const born = new Float32Array(2 * count * this.samples);
    for (let i = 0; i < born.length; i++) born[i] = Math.floor(i / (2 * count));
    const tints = new Uint8Array(6 * count * this.samples);
    for (let i = 0; i < 2 * count * this.samples; i++) {
      const tint = TRAILS[Math.floor((i % (2 * count)) / 2) % TRAILS.length];
      tints.set([tint >> 16, (tint >> 8) & 255, tint & 255], 3 * i);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("tint", new THREE.BufferAttribute(tints, 3, true));
    geometry.setAttribute("position", this.positions);
    geometry.setAttribute("born", new THREE.BufferAttribute(born, 1));
    this.material = new THREE.ShaderMaterial({
      transparent: true,
      depthWrite: false,
      uniforms: {
        head: { value: 0 },
        samples: { value: this.samples },
      },
      vertexShader: `
        attribute float born;
        attribute vec3 tint;
        uniform float head, samples;
        varying float strength;
        varying vec3 colour;
        void main() {
          colour = tint;
          strength = 1.0 - mod(head - born + samples, samples) / samples;
          gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        }`,
      fragmentShader: `
        varying vec3 colour;
        varying float strength;
        void main() { gl_FragColor = vec4(colour, sqrt(strength)); }`,
    });
    this.lines = new THREE.LineSegments(geometry, this.material);
    this.lines.frustumCulled = false;
    this.lines.visible = false;
    scene.add(this.lines);
    this.clear();
  }

  clear() {
    this.head = 0;
    this.filled = 0;
    this.last = null;
    this.lastTime = -Infinity;
  }

  get visible() {
    return this.lines.visible;
  }
  set visible(on) {
    if (on && !this.lines.visible) this.clear();
    this.lines.visible = on;
  }

  add(frame) {
    if (!this.visible) return;
    if (frame.time < this.lastTime) this.clear();
    const period = Math.max(this.world.tickSeconds, this.world.robots.length > 2000 ? 0.5 : 0.2);
    if (frame.time - this.lastTime < period - 1e-9) return;
    this.lastTime = frame.time;
    const { array } = this.positions;
    const now = new Float32Array(3 * this.world.robots.length);
    this.world.robots.forEach((entity, i) => {
      const slot = 3 * this.world.slots[entity];
      now[3 * i] = frame.positions[slot];
      now[3 * i + 1] = frame.positions[slot + 1];
      now[3 * i + 2] = frame.positions[slot + 2] + 0.006;
    });
    if (this.last) {
      const start = this.head * this.block;
      for (let i = 0; i < this.world.robots.length; i++) {
        const jumped = Math.abs(now[3 * i] - this.last[3 * i]) + Math.abs(now[3 * i + 1] - this.last[3 * i + 1]) > 0.5;
        for (let k = 0; k < 3; k++) {
          array[start + 6 * i + k] = (jumped ? now : this.last)[3 * i + k];
          array[start + 6 * i + 3 + k] = now[3 * i + k];
        }
      }
      // Ranges gather until the next picture uploads them.
      this.positions.addUpdateRange(start, this.block);
      this.positions.needsUpdate = true;
      this.material.uniforms.head.value = this.head;
      this.head = (this.head + 1) % this.samples;
      this.filled = Math.min(this.filled + 1, this.samples);
      this.lines.geometry.setDrawRange(0, (this.filled * this.block) / 3);
    } else this.lines.geometry.setDrawRange(0, 0);
    this.last = now;
  }
}

// Names beside the nearest entities, on a canvas over the picture.
export class Labels {
  constructor(container, world) {
    this.world = world;
    this.canvas = document.createElement("canvas");
    this.canvas.className = "labels";
    container.append(this.canvas);
    this.context = this.canvas.getContext("2d");
    this.visible = false;
  }

  update(camera, motion, selected) {
    const ratio = window.devicePixelRatio || 1;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    const { context } = this;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    if (!this.visible && selected === null) return;
    const found = [];
    const point = new THREE.Vector3();
    const consider = (entity) => {
      const slot = this.world.slots[entity];
      if (slot < 0 || !motion.isPresent(slot)) return;
      point.fromArray(motion.positions, 3 * slot);
      const distance = point.distanceToSquared(camera.position);
      point.z += extentOf(this.world, entity).height + 0.02;
      point.project(camera);
      if (Math.abs(point.x) > 1 || Math.abs(point.y) > 1 || point.z > 1) return;
      found.push({ entity, distance, x: ((point.x + 1) / 2) * width, y: ((1 - point.y) / 2) * height });
    };
    if (this.visible) for (const entity of this.world.movable) consider(entity);
    else consider(selected);
    found.sort((a, b) => a.distance - b.distance);
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "bottom";
    const taken = [];
    for (const { entity, x, y } of found.slice(0, 400)) {
      if (taken.length >= 150) break;
      const text = this.world.ids[entity];
      const half = text.length * 3.4 + 4;
      if (entity !== selected && taken.some((other) => Math.abs(other.y - y) < 14 && Math.abs(other.x - x) < half + other.half)) continue;
      taken.push({ x, y, half });
      context.lineWidth = 3;
      context.strokeStyle = getComputedStyle(this.canvas).getPropertyValue("--label-edge");
      context.fillStyle = entity === selected ? "#3d8bfd" : getComputedStyle(this.canvas).color;
      context.strokeText(text, x, y);
      context.fillText(text, x, y);
    }
  }

  dispose() {
    this.canvas.remove();
  }
}
