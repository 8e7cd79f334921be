// The bodies of the robots: the models that all renderers share (meshes.json), prepared for instancing. They have three
// levels of detail; robots of a few pixels are points (robot_points.js). Lengths are in metres, the base is at z = 0,
// the front is along x.
//
// Each level has `body` with colours at its vertices, `leds` whose attribute `led` is the number of the LED, and
// `clear` for see-through parts.
import * as THREE from "three";
import { paint } from "./look.js";

export const BEACON = 16;
const BEACON_LIGHT = 16; // in meshes.json
// A level is drawn if the robot is at least so many pixels wide.
export const PIXELS = [70, 14, 7];

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
  return { body: builders.body.build(), leds: builders.leds.build(), clear: builders.clear.build() };
}

// Returns a level of the model of a kind, nearest level first. The models of users' kinds come with the world.
export function makeModel(meshes, kind, look, level) {
  if (!look.model) return buildLevel(meshes, meshes.robots[kind], level);
  const part = { model: kind, matrix: new THREE.Matrix4().toArray() };
  return buildLevel({ ...meshes, models: { [kind]: look.model } }, [part], level, look.colour);
}

export const hasModel = (meshes, kind, look) => Boolean(look.model || meshes.robots[kind]);
