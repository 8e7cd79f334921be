// Robots of a few pixels, one point each: a disc in the colour of the LEDs with a rim that stands out from the floor, and
// a nose to the front, as in the plan (plan/dots.js). Positions, orientations and colours are uploaded as they are, so
// that ten thousand robots cost one call and ten thousand vertices.
import * as THREE from "three";
import { LED_OFF, LED_OFF_BY_NIGHT, rgb } from "./look.js";
import { Flag } from "../protocol.js";

const NOSE_FROM = "5.6"; // pixels: on smaller points a nose would hide the colour …
const RIM_FROM = "3.6"; // … as would a rim

const vector = (colour) => `vec3(${rgb(colour).map((channel) => (channel / 255).toFixed(3))})`;

// The attributes that the points of all kinds share. `motion`: see world.js.
export class PointAttributes {
  constructor(motion) {
    this.motion = motion;
    this.position = new THREE.BufferAttribute(motion.positions, 3);
    this.turn = new THREE.BufferAttribute(motion.quaternions, 4);
    this.colour = new THREE.BufferAttribute(new Uint8Array(motion.colours.length), 4);
    for (const attribute of [this.position, this.turn, this.colour]) attribute.setUsage(THREE.DynamicDrawUsage);
  }

  update() {
    this.position.needsUpdate = this.turn.needsUpdate = true;
    if (this.colours === this.motion.colours) return;
    this.colours = this.motion.colours;
    this.colour.array.set(this.colours);
    this.colour.needsUpdate = true;
  }
}

const vertexShader = `
  attribute vec4 turn, colour;
  uniform vec2 body, pixels; // diameter and height in metres; size of the picture
  uniform float scale, least, largest, nearest, night;
  varying vec3 fill;
  varying vec2 ahead;
  varying float width, reach;
  void main() {
    vec3 away = position - cameraPosition;
    float distance = length(away);
    bool absent = mod(floor(colour.a / ${Flag.absent}.0), 2.0) > 0.5;
    gl_PointSize = 0.0;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    if (absent || distance <= nearest) return;
    vec3 middle = position + vec3(0.0, 0.0, 0.5 * body.y);
    vec3 front = vec3(1.0 - 2.0 * (turn.y * turn.y + turn.z * turn.z), 2.0 * (turn.x * turn.y + turn.w * turn.z), 2.0 * (turn.x * turn.z - turn.w * turn.y));
    gl_Position = projectionMatrix * viewMatrix * vec4(middle, 1.0);
    vec4 tip = projectionMatrix * viewMatrix * vec4(middle + 0.5 * body.x * front, 1.0);
    vec2 along = (tip.xy / tip.w - gl_Position.xy / gl_Position.w) * pixels;
    ahead = along / max(length(along), 1e-6);
    float true_width = body.x * scale / distance;
    width = min(max(true_width, least), largest * true_width);
    reach = width < ${NOSE_FROM} ? 1.0 : 1.25; // to the tip of the nose
    gl_PointSize = reach * width;
    bool lit = mod(colour.a, 2.0) > 0.5;
    fill = lit ? colour.rgb / 255.0 : mix(${vector(LED_OFF)}, ${vector(LED_OFF_BY_NIGHT)}, night);
  }`;

const fragmentShader = `
  uniform float night;
  varying vec3 fill;
  varying vec2 ahead;
  varying float width, reach;
  void main() {
    vec2 at = reach * vec2(2.0 * gl_PointCoord.x - 1.0, 1.0 - 2.0 * gl_PointCoord.y);
    float away = length(at);
    float along = dot(at, ahead);
    float across = abs(at.x * ahead.y - at.y * ahead.x);
    bool nose = reach > 1.0 && along > 0.25 && along < 1.25 && across < 0.36 * (1.25 - along) + 0.1;
    vec3 rim = mix(0.42 * fill, 0.5 + 0.5 * fill, night);
    if (width < ${RIM_FROM}) {
      gl_FragColor = vec4(mix(fill, rim, 0.3), 1.0);
      return;
    }
    if (away > 1.0 && !nose) discard;
    float inner = 1.0 - max(1.8 / width, 0.26);
    gl_FragColor = vec4(nose ? vec3(0.94, 0.54, 0.24) : away > inner ? rim : fill, 1.0);
  }`;

export class RobotPoints {
  // `slots`: of the robots of one kind; `body`: its radius and height.
  constructor(group, slots, { radius, height }) {
    this.uniforms = { body: { value: [2 * radius, height] } };
    for (const name of ["scale", "least", "largest", "nearest", "night", "pixels"]) this.uniforms[name] = { value: 0 };
    this.points = new THREE.Points(new THREE.BufferGeometry().setIndex(slots), new THREE.ShaderMaterial({ uniforms: this.uniforms, vertexShader, fragmentShader }));
    this.points.frustumCulled = false;
    group.add(this.points);
  }

  // `attributes`: see PointAttributes.
  use({ position, turn, colour }) {
    this.points.geometry.setAttribute("position", position).setAttribute("turn", turn).setAttribute("colour", colour);
  }

  // `values`: of the uniforms. `nearest`: the distance up to which robots have models.
  show(values) {
    for (const [name, value] of Object.entries(values)) this.uniforms[name].value = value;
  }
}
