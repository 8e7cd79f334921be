// All movable entities: robots as models at three levels of detail, drawn by instancing, or as points, chosen by their
// size on the screen; preys and blocks. One index of every instance array is one index of the frame.
import * as THREE from "three";
import { extentOf, paint } from "./look.js";
import { hasModel, makeModel, PIXELS } from "./mesh_geometry.js";
import { isPainted, meshGeometry } from "./object_mesh.js";
import { LedTexture, ledMaterial } from "./led_texture.js";
import { PointAttributes, RobotPoints } from "./robot_points.js";
import { Flag } from "../protocol.js";

// Robots are never drawn smaller than this, since those of a large arena would vanish between the pixels.
const LEAST_PIXELS = 3.4;
const LEAST_DRAWN = 2.2; // pixels of a picture with fewer pixels than the page
const LARGEST_SCALE = 8;

// One geometry drawn many times; bodies and LEDs share the matrices.
class Layer {
  constructor(group, level, materials, capacity) {
    this.body = new THREE.InstancedMesh(level.body, materials.body, capacity);
    this.meshes = [this.body];
    if (level.leds) {
      const leds = level.leds;
      this.slots = new THREE.InstancedBufferAttribute(new Float32Array(capacity), 1);
      leds.setAttribute("slot", this.slots);
      const mesh = new THREE.InstancedMesh(leds, materials.leds, capacity);
      mesh.instanceMatrix = this.body.instanceMatrix;
      this.meshes.push(mesh);
    }
    if (level.clear) {
      const mesh = new THREE.InstancedMesh(level.clear, materials.clear, capacity);
      mesh.instanceMatrix = this.body.instanceMatrix;
      this.meshes.push(mesh);
    }
    this.body.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
    for (const mesh of this.meshes) {
      mesh.frustumCulled = false;
      mesh.count = 0;
      group.add(mesh);
    }
    this.matrices = this.body.instanceMatrix.array;
    this.count = 0;
  }

  add(slot, p, q, scale) {
    writeMatrix(this.matrices, 16 * this.count, p, 3 * slot, q, 4 * slot, scale, scale, scale);
    if (this.slots) this.slots.array[this.count] = slot;
    this.count++;
  }

  finish() {
    for (const mesh of this.meshes) {
      mesh.count = this.count;
      mesh.visible = this.count > 0;
    }
    upload(this.body.instanceMatrix, 16 * this.count);
    if (this.slots) upload(this.slots, this.count);
  }
}

function upload(attribute, length) {
  attribute.clearUpdateRanges();
  attribute.addUpdateRange(0, length);
  attribute.needsUpdate = true;
}

function writeMatrix(m, o, p, i, q, k, sx, sy, sz) {
  const [x, y, z, w] = [q[k], q[k + 1], q[k + 2], q[k + 3]];
  const [xx, yy, zz, xy, xz, yz, wx, wy, wz] = [x * x, y * y, z * z, x * y, x * z, y * z, w * x, w * y, w * z];
  m[o] = (1 - 2 * (yy + zz)) * sx;
  m[o + 1] = 2 * (xy + wz) * sx;
  m[o + 2] = 2 * (xz - wy) * sx;
  m[o + 4] = 2 * (xy - wz) * sy;
  m[o + 5] = (1 - 2 * (xx + zz)) * sy;
  m[o + 6] = 2 * (yz + wx) * sy;
  m[o + 8] = 2 * (xz + wy) * sz;
  m[o + 9] = 2 * (yz - wx) * sz;
  m[o + 10] = (1 - 2 * (xx + yy)) * sz;
  m[o + 12] = p[i];
  m[o + 13] = p[i + 1];
  m[o + 14] = p[i + 2];
  m[o + 15] = 1;
}

function softDisc(colour) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const context = canvas.getContext("2d");
  const gradient = context.createRadialGradient(32, 32, 12, 32, 32, 32);
  gradient.addColorStop(0, `rgba(${colour},0.55)`);
  gradient.addColorStop(0.5, `rgba(${colour},0.28)`);
  gradient.addColorStop(1, `rgba(${colour},0)`);
  context.fillStyle = gradient;
  context.fillRect(0, 0, 64, 64);
  return new THREE.CanvasTexture(canvas);
}

export class Swarm3d {
  // `quality`: one of quality_levels.js; `night`: whether the floor is dark.
  constructor(scene, world, quality, meshes, night) {
    this.world = world;
    this.quality = quality;
    this.meshes = meshes;
    this.night = night;
    this.group = new THREE.Group();
    scene.add(this.group);
    this.leds = new LedTexture(world.movable.length);
    const Material = quality.lit ? THREE.MeshStandardMaterial : THREE.MeshLambertMaterial;
    const finish = quality.lit ? { roughness: 0.62, metalness: 0.08 } : {};
    this.materials = {
      body: new Material({ vertexColors: true, ...finish }),
      leds: ledMaterial(this.leds.texture),
      clear: new Material({ vertexColors: true, transparent: true, opacity: 0.4, depthWrite: false, ...finish }),
    };

    this.herds = []; // robots of one kind, their levels that were drawn before, and their points
    for (const kind of new Set(world.robots.map((entity) => world.kinds[entity]))) {
      if (!hasModel(meshes, kind, world.looks[kind])) continue;
      const slots = world.robots.filter((entity) => world.kinds[entity] === kind).map((entity) => world.slots[entity]);
      const extent = extentOf(world, world.movable[slots[0]]);
      const layers = PIXELS.slice(quality.finest).map(() => null);
      this.herds.push({ kind, slots, layers, far: 0, diameter: 2 * extent.radius, points: new RobotPoints(this.group, slots, extent) });
    }
    this.things = this.makeThings(Material, finish);
    this.makeShadows();
    this.makeGlows();
  }

  // Makes preys, blocks and users' objects that move: scaled unit solids or meshes.
  makeThings(Material, finish) {
    const { world } = this;
    const unit = {
      cylinder: new THREE.CylinderGeometry(1, 1, 1, 32).rotateX(Math.PI / 2).translate(0, 0, 0.5),
      box: new THREE.BoxGeometry(1, 1, 1),
      "based box": new THREE.BoxGeometry(1, 1, 1).translate(0, 0, 0.5),
    };
    const formOf = ({ role, form, based }) => (role === "robot" ? role : form === "box" && based ? "based box" : form);
    const shapeOf = (entity) => world.bodyOf.get(entity)?.mesh ?? formOf(world.look(entity));
    return [...Object.keys(unit), ...world.meshes.keys()].flatMap((shape) => {
      const entities = world.movable.filter((entity) => shapeOf(entity) === shape);
      if (entities.length === 0) return [];
      const model = world.meshes[shape];
      const painted = model !== undefined && isPainted(model);
      const material = new Material({ ...finish, vertexColors: painted });
      const mesh = new THREE.InstancedMesh(model ? meshGeometry(model) : unit[shape], material, entities.length);
      mesh.instanceColor = new THREE.InstancedBufferAttribute(new Float32Array(3 * entities.length), 3);
      mesh.frustumCulled = false;
      mesh.castShadow = mesh.receiveShadow = true;
      this.group.add(mesh);
      const sizes = entities.map((entity) => {
        const [x, y, z] = world.bodyOf.get(entity).size;
        return world.look(entities[0]).form === "cylinder" ? [x, x, z] : [x, y, z];
      });
      return [{ mesh, sizes, painted, slots: entities.map((entity) => world.slots[entity]) }];
    });
  }

  // Makes a soft dark disc on the ground below each robot. It links distant robots to the floor at no cost.
  makeShadows() {
    const material = new THREE.MeshBasicMaterial({
      map: softDisc("0,0,0"),
      transparent: true,
      depthWrite: false,
      polygonOffset: true,
      polygonOffsetFactor: -2,
    });
    this.shadows = new THREE.InstancedMesh(new THREE.PlaneGeometry(1, 1), material, this.world.robots.length);
    this.shadows.frustumCulled = false;
    this.shadows.renderOrder = 1;
    this.group.add(this.shadows);
  }

  // Makes the light of the LEDs on the floor around a robot.
  makeGlows() {
    const material = new THREE.MeshBasicMaterial({
      map: softDisc("255,255,255"),
      transparent: true,
      opacity: 0.75,
      depthWrite: false,
      polygonOffset: true,
      polygonOffsetFactor: -3,
    });
    const count = this.world.robots.length;
    this.glows = new THREE.InstancedMesh(new THREE.PlaneGeometry(1, 1), material, count);
    this.glows.instanceColor = new THREE.InstancedBufferAttribute(new Float32Array(3 * count), 3);
    this.glows.frustumCulled = false;
    this.glows.renderOrder = 2;
    this.glows.count = 0;
    this.glows.visible = !this.quality.plain;
    this.group.add(this.glows);
    this.shining = [];
  }

  // Draws real shadows instead of the discs.
  set castsShadows(on) {
    this.casts = on;
    this.shadows.visible = !on && !this.quality.plain;
    for (const { layers } of this.herds) for (const layer of layers) if (layer) layer.body.castShadow = layer.body.receiveShadow = on;
  }

  // Returns a level of a herd. It is made when the first robot needs it, since from far away none does.
  layer({ kind, slots, layers }, level) {
    if (!layers[level]) {
      const model = makeModel(this.meshes, kind, this.world.looks[kind], level + this.quality.finest);
      layers[level] = new Layer(this.group, model, this.materials, slots.length);
      layers[level].body.castShadow = layers[level].body.receiveShadow = this.casts;
    }
    return layers[level];
  }

  updateColours(frame) {
    this.leds.update(frame, this.world.slots);
    const colour = new THREE.Color();
    for (const { mesh, slots, painted } of this.things) {
      slots.forEach((slot, i) => {
        const [r, g, b] = frame.colours.subarray(4 * slot, 4 * slot + 3);
        mesh.setColorAt(i, colour.set(painted ? 0xffffff : paint((r << 16) | (g << 8) | b)));
      });
      mesh.instanceColor.needsUpdate = true;
    }
    this.shining = this.world.robots.filter((entity) => {
      const slot = this.world.slots[entity];
      const flags = frame.colours[4 * slot + 3];
      return !(flags & Flag.absent) && flags & Flag.lit && frame.positions[3 * slot + 2] < 0.5;
    });
    this.shining.forEach((entity, i) => {
      const place = 4 * this.world.slots[entity];
      colour.setRGB(...[0, 1, 2].map((k) => frame.colours[place + k] / 255), THREE.SRGBColorSpace);
      this.glows.setColorAt(i, colour);
    });
    this.glows.count = this.shining.length;
    this.glows.instanceColor.needsUpdate = this.shining.length > 0;
  }

  // Places all entities as the camera sees them. `pixelsPerRadian`: height of the picture over its angle; `size`: its
  // width and height; `ratio`: drawn pixels for each of them.
  place(motion, camera, pixelsPerRadian, size, ratio) {
    const { positions: p, quaternions: q } = motion;
    if (this.attributes?.motion !== motion) {
      this.attributes = new PointAttributes(motion);
      for (const { points } of this.herds) points.use(this.attributes);
    }
    this.attributes.update();
    const frustum = new THREE.Frustum().setFromProjectionMatrix(
      new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse),
    );
    const planes = frustum.planes;
    const eye = camera.position;
    this.enlargement = 1;
    for (const herd of this.herds) {
      const { slots, layers, diameter, points } = herd;
      for (const layer of layers) if (layer) layer.count = 0;
      const limits = layers.map((_, level) => ((diameter * pixelsPerRadian) / (PIXELS[level + this.quality.finest] * this.quality.coarser)) ** 2);
      const nearest = limits.at(-1);
      points.show({ scale: pixelsPerRadian * ratio, least: Math.max(LEAST_PIXELS * ratio, LEAST_DRAWN), largest: LARGEST_SCALE, nearest: Math.sqrt(nearest), night: Number(this.night), pixels: size });
      herd.far = 0;
      let farthest = 0;
      for (const slot of slots) {
        if (!motion.isPresent(slot)) continue;
        const [x, y, z] = [p[3 * slot], p[3 * slot + 1], p[3 * slot + 2]];
        const distance = (x - eye.x) ** 2 + (y - eye.y) ** 2 + (z - eye.z) ** 2;
        if (distance > nearest) {
          herd.far++;
          farthest = Math.max(farthest, distance);
          continue;
        }
        let hidden = false;
        for (let i = 0; i < 6 && !hidden; i++) {
          const { normal, constant } = planes[i];
          hidden = normal.x * x + normal.y * y + normal.z * z + constant < -2 * diameter;
        }
        if (hidden) continue;
        let level = 0;
        while (distance > limits[level]) level++;
        this.layer(herd, level).add(slot, p, q, 1);
      }
      for (const layer of layers) layer?.finish();
      const least = LEAST_PIXELS / (diameter * pixelsPerRadian);
      this.enlargement = Math.max(this.enlargement, Math.min(Math.sqrt(farthest) * least, LARGEST_SCALE));
    }
    for (const { mesh, sizes, slots } of this.things) {
      slots.forEach((slot, i) => {
        const size = motion.isPresent(slot) ? sizes[i] : [0, 0, 0];
        writeMatrix(mesh.instanceMatrix.array, 16 * i, p, 3 * slot, q, 4 * slot, ...size);
      });
      mesh.instanceMatrix.needsUpdate = true;
    }
    if (this.shadows.visible) this.placeOnFloor(this.shadows, this.world.robots, p, 0.002, 2.75);
    if (this.glows.visible && this.shining.length > 0) this.placeOnFloor(this.glows, this.shining, p, 0.003, 4.6);
  }

  // Places flat squares of so many radii below robots. It skips terrain, whose floor is elsewhere.
  placeOnFloor(mesh, entities, p, height, radii) {
    const flat = [0, 0, 0, 1];
    const point = [0, 0, height];
    entities.forEach((entity, i) => {
      const slot = this.world.slots[entity];
      point[0] = p[3 * slot];
      point[1] = p[3 * slot + 1];
      const size = radii * extentOf(this.world, entity).radius;
      writeMatrix(mesh.instanceMatrix.array, 16 * i, point, 0, flat, 0, size, size, 1);
    });
    mesh.instanceMatrix.needsUpdate = true;
  }

  dispose() {
    this.group.removeFromParent();
    this.group.traverse((object) => {
      object.geometry?.dispose();
      object.material?.dispose();
      object.dispose?.();
    });
    this.leds.dispose();
  }
}
