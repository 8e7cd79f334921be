// The marks of the 3D view beside bodies: laser beams, grips and trails.
import * as THREE from "three";
import { Flag } from "../protocol.js";
import { GRIP, TRAILS, extentOf, rgb } from "./look.js";
import { jumped } from "./trail_record.js";

const BEAMS = 256;

// Beams with a spot at their ends.
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

// Lines from each robot to what it holds, and to the ceiling if it is attached there.
export class Grips {
  constructor(scene, world) {
    this.world = world;
    this.lines = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ color: GRIP, depthTest: false, transparent: true, opacity: 0.9 }),
    );
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 4;
    this.hangers = world.robots.filter((entity) => world.kinds[entity] !== "footbot");
    scene.add(this.lines);
  }

  update(frame, motion, on) {
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
    this.lines.visible = on && points.length > 0;
    if (!this.lines.visible) return;
    this.lines.geometry.dispose();
    this.lines.geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  }
}

// Lines that marks.js makes. Bodies do not hide the lines around them.
export class MarkLines {
  constructor(scene) {
    this.group = new THREE.Group();
    this.lines = new Map(); // by name
    scene.add(this.group);
  }

  update(list) {
    for (const line of this.lines.values()) line.visible = false;
    for (const { name, colour, points, opacity = 1 } of list) {
      if (points.length === 0) continue;
      if (!this.lines.has(name)) this.lines.set(name, this.make());
      const line = this.lines.get(name);
      line.visible = true;
      line.material.color.set(colour);
      line.material.opacity = opacity;
      line.geometry.dispose();
      line.geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    }
  }

  make() {
    const line = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ depthTest: false, transparent: true }));
    line.frustumCulled = false;
    line.renderOrder = 4;
    this.group.add(line);
    return line;
  }
}

// The trails: line segments in blocks, one block a sample. The oldest block is overwritten, and lines fade with age.
const RAISED_M = 0.006;

export class Trails {
  constructor(scene, record) {
    this.record = record;
    const count = Math.max(1, record.world.robots.length);
    this.samples = record.capacity;
    this.block = 6 * count;
    this.positions = new THREE.BufferAttribute(new Float32Array(this.block * this.samples), 3).setUsage(THREE.DynamicDrawUsage);
    const born = new Float32Array(2 * count * this.samples);
    for (let i = 0; i < born.length; i++) born[i] = Math.floor(i / (2 * count));
    const tints = new Uint8Array(6 * count * this.samples);
    for (let i = 0; i < 2 * count * this.samples; i++) tints.set(rgb(TRAILS[Math.floor((i % (2 * count)) / 2) % TRAILS.length]), 3 * i);
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
    this.drawn = 0; // number of drawn samples
    scene.add(this.lines);
  }

  // Adds the samples that were recorded since the last call.
  update() {
    const { record } = this;
    this.lines.visible = record.on;
    if (!record.on) return;
    if (this.beginning !== record.beginnings) {
      this.beginning = record.beginnings;
      this.positions.array.fill(0);
      this.drawn = 0;
    }
    if (this.drawn === record.added) return;
    for (let number = Math.max(this.drawn, record.first + 1, 1); number < record.added; number++) this.write(number);
    this.drawn = record.added;
    this.material.uniforms.head.value = (record.added - 1) % this.samples;
    this.lines.geometry.setDrawRange(0, (Math.min(record.added, this.samples) * this.block) / 3);
  }

  // Writes the line from the previous sample to this one.
  write(number) {
    const { array } = this.positions;
    const start = (number % this.samples) * this.block;
    const [from, to] = [this.record.sample(number - 1), this.record.sample(number)];
    for (let i = 0; i < to.length / 3; i++) {
      const begin = jumped(from, to, i) ? to : from;
      for (let k = 0; k < 3; k++) {
        const raised = k === 2 ? RAISED_M : 0;
        array[start + 6 * i + k] = begin[3 * i + k] + raised;
        array[start + 6 * i + 3 + k] = to[3 * i + k] + raised;
      }
    }
    // Ranges accumulate until the next picture uploads them.
    this.positions.addUpdateRange(start, this.block);
    this.positions.needsUpdate = true;
  }
}
