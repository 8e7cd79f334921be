// The floor with its grid, and the static content: walls, blocks, patches, holes, lights, sounds and terrain. Only
// lights, sounds and patches may appear, disappear and move.
import * as THREE from "three";
import { floorPicture } from "./floor_picture.js";
import { isPainted, meshGeometry } from "./object_mesh.js";
import { gridStep, isBoundaryWall, paint } from "./look.js";
import { BoundaryWall } from "./walls.js";

const FLAT_M = 0.0006; // between one layer on the floor and the next

// Lines are used instead of a texture, since filling a picture with a texture in software costs more than all bodies on
// it.
function gridLines(width, depth, step, colour) {
  const points = [];
  for (let x = step; x < width; x += step) points.push(x, 0, FLAT_M / 2, x, depth, FLAT_M / 2);
  for (let y = step; y < depth; y += step) points.push(0, y, FLAT_M / 2, width, y, FLAT_M / 2);
  const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: colour }));
}

function floorTexture(theme, cells) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 256;
  const context = canvas.getContext("2d");
  context.fillStyle = `#${new THREE.Color(theme.floor).getHexString()}`;
  context.fillRect(0, 0, 256, 256);
  context.strokeStyle = `#${new THREE.Color(theme.line).getHexString()}`;
  context.lineWidth = 3;
  context.strokeRect(0, 0, 256, 256);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.repeat.set(cells[0], cells[1]);
  texture.anisotropy = 8;
  return texture;
}

export class Arena {
  constructor(scene, world, theme, quality) {
    this.world = world;
    this.group = new THREE.Group();
    this.Material = quality.lit ? THREE.MeshStandardMaterial : THREE.MeshLambertMaterial;
    this.finish = quality.lit ? { roughness: 0.85, metalness: 0 } : {};
    this.objects = new Map(); // entity to the mesh with its colour
    this.moving = []; // objects of movable entities
    this.walls = []; // walls at the edge of the arena
    scene.add(this.group);
    this.addFloor(theme, quality);
    let layer = 1;
    for (const body of world.bodies) {
      const slot = world.slots[body.entity];
      if (slot >= 0 && world.look(body.entity).form !== "none") continue;
      const object = this.make(world.look(body.entity), body, layer++ % 40);
      if (!object) continue;
      if (slot >= 0) {
        object.visible = false;
        this.moving.push({ object, slot, height: object.position.z });
      }
      object.position.x += body.position[0];
      object.position.y += body.position[1];
      object.position.z += body.position[2];
      object.quaternion.set(...body.orientation);
      this.group.add(object);
      this.objects.set(body.entity, object);
    }
    this.group.traverse((object) => {
      object.matrixAutoUpdate = false;
      object.updateMatrix();
    });
  }

  place(motion, eye) {
    for (const wall of this.walls) wall.cutFor(eye);
    for (const { object, slot, height } of this.moving) {
      object.visible = motion.isPresent(slot);
      if (!object.visible) continue;
      object.position.fromArray(motion.positions, 3 * slot);
      object.position.z += height;
      object.quaternion.fromArray(motion.quaternions, 4 * slot);
      object.updateMatrix();
    }
  }

  addFloor(theme, quality) {
    const [width, depth] = this.world.arena;
    const step = gridStep(Math.max(width, depth));
    const look = quality.plain ? null : { map: floorTexture(theme, [width / step, depth / step]) };
    const floor = new THREE.Mesh(
      new THREE.PlaneGeometry(width, depth),
      look ? new this.Material({ ...look, ...this.finish }) : new THREE.MeshBasicMaterial({ color: theme.floor }),
    );
    if (!look) this.group.add(gridLines(width, depth, step, theme.line));
    floor.position.set(width / 2, depth / 2, 0);
    floor.receiveShadow = true;
    const rim = new THREE.LineLoop(
      new THREE.BufferGeometry().setFromPoints(
        [[0, 0], [width, 0], [width, depth], [0, depth]].map(([x, y]) => new THREE.Vector3(x, y, 0.001)),
      ),
      new THREE.LineBasicMaterial({ color: theme.rim }),
    );
    this.gridStep = step;
    this.group.add(floor, rim);
  }

  solid(geometry, colour, more = {}) {
    const mesh = new THREE.Mesh(geometry, new this.Material({ color: colour, ...this.finish, ...more }));
    mesh.castShadow = mesh.receiveShadow = true;
    return mesh;
  }

  make({ role, form, based }, body, layer) {
    const [x, y, z] = body.size;
    if (body.mesh !== undefined) return this.makeMesh(form, body);
    if (form === "box" && based) return this.solid(new THREE.BoxGeometry(x, y, z).translate(0, 0, z / 2), paint(body.colour));
    switch (form === "none" ? role : form) {
      case "box":
        return this.makeBox(body);
      case "cylinder":
        return this.solid(new THREE.CylinderGeometry(x, x, z, 32).rotateX(Math.PI / 2).translate(0, 0, z / 2), paint(body.colour));
      case "patch":
        return this.makePatch(x, y, body, layer * FLAT_M);
      case "hole":
        return this.makeHole(x, y);
      case "light":
        return this.makeLight(body.colour);
      case "sound":
        return this.makeSound(body.colour);
      case "terrain":
        return this.makeTerrain(body.terrain);
      default:
        return null;
    }
  }

  makeMesh(form, { mesh, size: [x, y, z], colour }) {
    const model = this.world.meshes[mesh];
    const painted = isPainted(model);
    const geometry = meshGeometry(model).scale(x, form === "cylinder" ? x : y, z);
    return this.solid(geometry, painted ? 0xffffff : paint(colour), { vertexColors: painted });
  }

  makeBox(body) {
    const colour = paint(body.colour);
    if (!isBoundaryWall(body, this.world.arena))
      return this.solid(new THREE.BoxGeometry(...body.size), colour);
    const wall = new BoundaryWall(body, this.world.arena, colour, (...words) => this.solid(...words));
    this.walls.push(wall);
    return wall.object;
  }

  // If y is 0, the shape is a disc of radius x.
  flatShape(x, y) {
    return y === 0 ? new THREE.CircleGeometry(x, 64) : new THREE.PlaneGeometry(x, y);
  }

  makePatch(x, y, body, height) {
    const look = body.picture ? { color: body.colour, map: pictureTexture(body.picture) } : { color: paint(body.colour) };
    const mesh = new THREE.Mesh(
      this.flatShape(x, y),
      new this.Material({ ...look, ...this.finish, polygonOffset: true, polygonOffsetFactor: -1 }),
    );
    mesh.receiveShadow = true;
    mesh.position.z = height;
    return mesh;
  }

  makeHole(x, y) {
    const mesh = new THREE.Mesh(this.flatShape(x, y), new THREE.MeshBasicMaterial({ color: 0x07090c }));
    const rim = new THREE.LineLoop(
      new THREE.BufferGeometry().setFromPoints(
        y === 0
          ? Array.from({ length: 64 }, (_, i) => new THREE.Vector3(x * Math.cos((i * Math.PI) / 32), x * Math.sin((i * Math.PI) / 32), 0))
          : [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => new THREE.Vector3((a * x) / 2, (b * y) / 2, 0)),
      ),
      new THREE.LineBasicMaterial({ color: 0x6b7683 }),
    );
    rim.position.z = 0.002;
    mesh.add(rim);
    mesh.position.z = 0.001;
    return mesh;
  }

  makeLight(colour) {
    const bulb = new THREE.Mesh(new THREE.SphereGeometry(0.06, 20, 12), new THREE.MeshBasicMaterial({ color: colour }));
    const glow = new THREE.Sprite(
      new THREE.SpriteMaterial({ map: glowTexture(), color: colour, transparent: true, depthWrite: false, opacity: 0.7 }),
    );
    glow.scale.setScalar(0.5);
    bulb.add(glow);
    return bulb;
  }

  makeSound(colour) {
    const group = this.solid(new THREE.ConeGeometry(0.06, 0.12, 20).rotateX(Math.PI / 2).translate(0, 0, 0.06), colour);
    for (const radius of [0.12, 0.18]) {
      const wave = new THREE.Mesh(new THREE.TorusGeometry(radius, 0.004, 6, 40), new THREE.MeshBasicMaterial({ color: colour }));
      wave.position.z = 0.1;
      group.add(wave);
    }
    return group;
  }

  // The heights are at the middles of cells; cells without ground are left out.
  makeTerrain({ low, high, columns, rows, heights }) {
    const positions = new Float32Array(3 * columns * rows);
    for (let row = 0; row < rows; row++)
      for (let column = 0; column < columns; column++) {
        const i = row * columns + column;
        positions[3 * i] = low[0] + ((column + 0.5) * (high[0] - low[0])) / columns;
        positions[3 * i + 1] = low[1] + ((row + 0.5) * (high[1] - low[1])) / rows;
        positions[3 * i + 2] = heights[i] ?? 0;
      }
    const shade = new THREE.Color();
    const colours = new Float32Array(3 * columns * rows);
    for (let i = 0; i < columns * rows; i++) {
      const share = (positions[3 * i + 2] - low[2]) / Math.max(high[2] - low[2], 1e-6);
      shade.set(0x6d6a5c).lerp(new THREE.Color(0xc6bba2), share).toArray(colours, 3 * i);
    }
    const indices = [];
    for (let row = 0; row + 1 < rows; row++)
      for (let column = 0; column + 1 < columns; column++) {
        const corners = [0, 1, columns, columns + 1].map((offset) => row * columns + column + offset);
        if (corners.some((corner) => heights[corner] === null)) continue;
        const [a, b, c, d] = corners;
        indices.push(a, b, d, a, d, c);
      }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
    geometry.setIndex(indices);
    geometry.computeVertexNormals();
    return this.solid(geometry, 0xffffff, { side: THREE.DoubleSide, vertexColors: true });
  }

  paint({ entities, colours, intensities }) {
    entities.forEach((entity, i) => {
      const object = this.objects.get(entity);
      if (!object?.material) return;
      const { role } = this.world.look(entity);
      const shines = role === "light" || role === "sound";
      const shownAsIs = shines || object.material.map;
      if (!object.material.vertexColors) object.material.color.set(shownAsIs ? colours[i] : paint(colours[i]));
      if (role !== "light") return;
      const [glow] = object.children;
      glow.material.color.set(colours[i]);
      glow.visible = intensities[i] > 0;
      if (intensities[i] <= 0) object.material.color.multiplyScalar(0.25);
    });
  }

  dispose() {
    this.group.removeFromParent();
    this.group.traverse((object) => {
      object.geometry?.dispose();
      object.material?.map?.dispose();
      object.material?.dispose();
    });
  }
}

function pictureTexture(picture) {
  const texture = new THREE.CanvasTexture(floorPicture(picture));
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.magFilter = THREE.NearestFilter;
  texture.anisotropy = 8;
  return texture;
}

function glowTexture() {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const context = canvas.getContext("2d");
  const gradient = context.createRadialGradient(32, 32, 4, 32, 32, 32);
  gradient.addColorStop(0, "rgba(255,255,255,0.9)");
  gradient.addColorStop(1, "rgba(255,255,255,0)");
  context.fillStyle = gradient;
  context.fillRect(0, 0, 64, 64);
  return new THREE.CanvasTexture(canvas);
}
