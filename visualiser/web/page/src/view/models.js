// The bodies of the robots: the models that all renderers share (meshes.json), prepared for instancing. They have three
// levels of detail. Robots of a few pixels have a plain cylinder or a disc. Lengths are in metres, the base is at z =
// 0, the front is along x.
//
// Each level has `body` with colours at its vertices, `leds` whose attribute `led` is the number of the LED, and
// `clear` for see-through parts.
import * as THREE from "three";
import { extents, paint } from "./look.js";

export const MEAN_LED = 16; // stands for the mean colour of the ring
export const BEACON = 17;
const BEACON_LIGHT = 16; // in meshes.json
// A level is drawn if the robot is at least so many pixels wide.
const PIXELS = [70, 14, 7];
const DOT_PIXELS = 5;

// Collects vertices without indices.
class Builder {
  constructor() {
    this.positions = [];
    this.normals = [];
    this.colours = [];
    this.leds = [];
  }
  add(position, normal, colour, led) {
    this.positions.push(...position);
    this.normals.push(...normal);
    if (led === null) this.colours.push(...colour);
    else this.leds.push(led);
  }
  build() {
    if (this.positions.length === 0) return null;
    const geometry = new THREE.BufferGeometry();
    const attribute = (name, values, size) => geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, size));
    attribute("position", this.positions, 3);
    attribute("normal", this.normals, 3);
    if (this.leds.length > 0) attribute("led", this.leds, 1);
    else attribute("color", this.colours, 3);
    return geometry;
  }
}

function buildLevel(meshes, parts, level, tint) {
  const builders = { body: new Builder(), leds: new Builder(), clear: new Builder() };
  const colours = meshes.materials.map((material) => new THREE.Color(material.tint && tint !== undefined ? paint(tint) : material.colour));
  const own = new THREE.Color();
  const point = new THREE.Vector3();
  const normal = new THREE.Vector3();
  for (const { model, matrix } of parts) {
    const { positions, normals, materials, shades, index_steps: steps, colours: painted } = meshes.models[model].levels[level];
    const place = new THREE.Matrix4().fromArray(matrix);
    const turn = new THREE.Matrix3().getNormalMatrix(place);
    let i = 0;
    for (const step of steps) {
      i += step;
      const material = meshes.materials[materials[i]];
      point.fromArray(positions, 3 * i).applyMatrix4(place);
      normal.fromArray(normals, 3 * i).applyMatrix3(turn).normalize();
      const colour = (material.painted ? own.set(painted[i]) : colours[materials[i]]).clone().multiplyScalar(shades[i]);
      const light = material.light;
      const builder = light >= 0 ? builders.leds : material.opacity < 1 && material.name === "rotor" ? builders.clear : builders.body;
      builder.add(point.toArray(), normal.toArray(), colour.toArray(), light < 0 ? null : light === BEACON_LIGHT ? BEACON : light);
    }
  }
  return { body: builders.body.build(), leds: builders.leds.build(), clear: builders.clear.build(), pixels: PIXELS[level] };
}

// Builds a cylinder whose upper part has the mean colour of the LEDs, with a nose to the front.
function buildDot({ radius, height }) {
  const sides = 7;
  const body = new Builder();
  const leds = new Builder();
  const grey = new THREE.Color(0x6f7883).toArray();
  const nose = new THREE.Color(0xf08a3c).toArray();
  const middle = height * 0.45;
  for (let i = 0; i < sides; i++) {
    const [a, b] = [i, i + 1].map((k) => (2 * Math.PI * k) / sides);
    const at = (angle, z) => [radius * Math.cos(angle), radius * Math.sin(angle), z];
    const out = [Math.cos((a + b) / 2), Math.sin((a + b) / 2), 0];
    const quad = (builder, low, high, led) => {
      for (const point of [at(a, low), at(b, low), at(b, high), at(a, low), at(b, high), at(a, high)]) builder.add(point, out, grey, led);
    };
    quad(body, 0, middle, null);
    quad(leds, middle, height, MEAN_LED);
    for (const point of [at(a, height), at(b, height), [0, 0, height]]) leds.add(point, [0, 0, 1], grey, MEAN_LED);
  }
  const z = height * 1.02;
  for (const point of [[0, -radius / 3, z], [radius * 1.15, 0, z], [0, radius / 3, z]]) body.add(point, [0, 0, 1], nose, null);
  return { body: body.build(), leds: leds.build(), clear: null, pixels: DOT_PIXELS };
}

// Builds the cheapest model: seventeen vertices.
function buildDisc({ radius, height }) {
  const sides = 6;
  const fan = (r, z) => [[0, 0, z], ...Array.from({ length: sides }, (_, i) => [r * Math.cos((2 * Math.PI * i) / sides), r * Math.sin((2 * Math.PI * i) / sides), z])];
  const fanIndices = Array.from({ length: sides }, (_, i) => [0, i + 1, ((i + 1) % sides) + 1]).flat();
  const flat = (points, indices, name, values, size) => {
    const geometry = new THREE.BufferGeometry().setIndex(indices);
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(points.flat(), 3));
    geometry.setAttribute("normal", new THREE.Float32BufferAttribute(points.flatMap(() => [0, 0, 1]), 3));
    return geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, size));
  };
  const z = height * 1.02;
  const nose = [[0, -radius / 3, z], [radius * 1.15, 0, z], [0, radius / 3, z]];
  const body = [...fan(radius, height * 0.9), ...nose];
  const colour = (hex) => new THREE.Color(hex).toArray();
  const colours = body.flatMap((_, i) => colour(i <= sides ? 0x59626d : 0xf08a3c));
  return {
    body: flat(body, [...fanIndices, ...[1, 2, 3].map((i) => sides + i)], "color", colours, 3),
    leds: flat(fan(radius * 0.8, height), fanIndices, "led", Array(sides + 1).fill(MEAN_LED), 1),
    clear: null,
    pixels: 0,
  };
}

// Returns the models by kind, nearest level first. Those of users' kinds come with the world.
export function makeModels(meshes, looks) {
  const levels = (models, parts, extent, tint) => [...PIXELS.map((_, level) => buildLevel(models, parts, level, tint)), buildDot(extent), buildDisc(extent)];
  const own = Object.entries(meshes.robots).map(([kind, parts]) => [kind, levels(meshes, parts, extents[kind])]);
  const users = Object.entries(looks)
    .filter(([, look]) => look.model)
    .map(([kind, look]) => {
      const part = { model: kind, matrix: new THREE.Matrix4().toArray() };
      return [kind, levels({ ...meshes, models: { [kind]: look.model } }, [part], look, look.colour)];
    });
  return Object.fromEntries([...own, ...users]);
}
