// The bodies of the robots, made of simple solids: three levels of detail each, colours at the vertices. Metres, base at
// z = 0, front along x. The LEDs are a geometry of their own; its attribute `led` is the number of each.
import * as THREE from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

export const MEAN_LED = 16; // stands for the mean colour of the ring

const palette = {
  rubber: 0x23272e,
  dark: 0x343b45,
  metal: 0x8b95a1,
  light: 0xdde3ea,
  accent: 0xf08a3c,
  glass: 0x11151a,
  board: 0x2f5d50,
};

function part(geometry, colour, [x, y, z] = [0, 0, 0], [rx, ry, rz] = [0, 0, 0]) {
  const plain = geometry.index ? geometry.toNonIndexed() : geometry;
  plain.deleteAttribute("uv");
  plain.applyMatrix4(
    new THREE.Matrix4().compose(
      new THREE.Vector3(x, y, z),
      new THREE.Quaternion().setFromEuler(new THREE.Euler(rx, ry, rz)),
      new THREE.Vector3(1, 1, 1),
    ),
  );
  const { r, g, b } = new THREE.Color(colour);
  const colours = new Float32Array(plain.attributes.position.count * 3);
  for (let i = 0; i < colours.length; i += 3) colours.set([r, g, b], i);
  plain.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  return plain;
}

const box = (x, y, z, colour, place, turn) => part(new THREE.BoxGeometry(x, y, z), colour, place, turn);
// Cylinders and cones of three.js stand along y.
const cylinder = (bottom, top, height, sides, colour, [x, y, z]) =>
  part(new THREE.CylinderGeometry(top, bottom, height, sides), colour, [x, y, z + height / 2], [Math.PI / 2, 0, 0]);
const torus = (radius, tube, sides, colour, place) => part(new THREE.TorusGeometry(radius, tube, 6, sides), colour, place);
const sphere = (radius, sides, colour, place) => part(new THREE.SphereGeometry(radius, sides, sides / 2), colour, place);

// A ring of `count` lamps between two radii and heights; `gap`: the part of each that stays dark.
function lamps(count, inner, outer, low, high, gap, first = 0, led = (i) => i) {
  const positions = [];
  const numbers = [];
  const quad = (a, b, c, d, number) => {
    positions.push(...a, ...b, ...c, ...a, ...c, ...d);
    for (let i = 0; i < 6; i++) numbers.push(number);
  };
  for (let i = 0; i < count; i++) {
    const step = (2 * Math.PI) / count;
    const pieces = count > 8 ? 1 : 2;
    for (let k = 0; k < pieces; k++) {
      const width = step * (1 - gap);
      const from = first + step * i - width / 2 + (width * k) / pieces;
      const to = from + width / pieces;
      const at = (radius, angle, z) => [radius * Math.cos(angle), radius * Math.sin(angle), z];
      quad(at(outer, from, low), at(outer, to, low), at(outer, to, high), at(outer, from, high), led(i));
      quad(at(outer, from, high), at(outer, to, high), at(inner, to, high), at(inner, from, high), led(i));
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setAttribute("led", new THREE.Float32BufferAttribute(numbers, 1));
  return geometry;
}

const meanLed = () => MEAN_LED;
const fifteenDegrees = Math.PI / 12;

function footbot() {
  const near = mergeGeometries([
    box(0.135, 0.03, 0.052, palette.rubber, [0, 0.058, 0.027]),
    box(0.135, 0.03, 0.052, palette.rubber, [0, -0.058, 0.027]),
    cylinder(0.026, 0.026, 0.03, 14, palette.metal, [0, 0, 0.004]),
    box(0.1, 0.09, 0.03, palette.dark, [0, 0, 0.035]),
    cylinder(0.082, 0.084, 0.012, 28, palette.dark, [0, 0, 0.05]),
    cylinder(0.083, 0.083, 0.003, 28, palette.glass, [0, 0, 0.074]),
    cylinder(0.079, 0.074, 0.03, 28, palette.light, [0, 0, 0.077]),
    cylinder(0.06, 0.056, 0.008, 24, palette.board, [0, 0, 0.107]),
    box(0.03, 0.045, 0.02, palette.accent, [0.076, 0, 0.09]),
    box(0.016, 0.07, 0.008, palette.dark, [0.084, 0, 0.09]),
    box(0.05, 0.012, 0.004, palette.accent, [0.034, 0, 0.1155]),
    cylinder(0.02, 0.018, 0.024, 16, palette.glass, [-0.012, 0, 0.113]),
    sphere(0.017, 12, palette.metal, [-0.012, 0, 0.134]),
  ]);
  const middle = mergeGeometries([
    box(0.135, 0.146, 0.05, palette.rubber, [0, 0, 0.026]),
    cylinder(0.08, 0.075, 0.036, 12, palette.light, [0, 0, 0.074]),
    box(0.03, 0.05, 0.02, palette.accent, [0.076, 0, 0.09]),
    box(0.06, 0.014, 0.004, palette.accent, [0.036, 0, 0.112]),
    cylinder(0.02, 0.016, 0.034, 8, palette.glass, [-0.012, 0, 0.11]),
  ]);
  const far = mergeGeometries([
    cylinder(0.08, 0.08, 0.115, 7, palette.metal, [0, 0, 0]),
    box(0.07, 0.03, 0.01, palette.accent, [0.05, 0, 0.118]),
  ]);
  return [
    { body: near, leds: lamps(12, 0.072, 0.0855, 0.0615, 0.0745, 0.22, fifteenDegrees), pixels: 44 },
    { body: middle, leds: lamps(12, 0.07, 0.0855, 0.055, 0.0765, 0.12, fifteenDegrees), pixels: 13 },
    { body: far, leds: lamps(7, 0, 0.088, 0.05, 0.119, 0, 0, meanLed), pixels: 0 },
  ];
}

function eyebot() {
  const rotors = [
    [0.13, 0.13],
    [-0.13, 0.13],
    [-0.13, -0.13],
    [0.13, -0.13],
  ];
  const solids = (sides, guards) => [
    cylinder(0.055, 0.07, 0.16, sides, palette.light, [0, 0, 0.2]),
    cylinder(0.07, 0.03, 0.06, sides, palette.dark, [0, 0, 0.36]),
    cylinder(0.012, 0.012, 0.15, 6, palette.metal, [0, 0, 0.416]),
    box(0.37, 0.022, 0.016, palette.dark, [0, 0, 0.33], [0, 0, Math.PI / 4]),
    box(0.37, 0.022, 0.016, palette.dark, [0, 0, 0.33], [0, 0, -Math.PI / 4]),
    box(0.05, 0.018, 0.018, palette.accent, [0.075, 0, 0.3]),
    ...rotors.flatMap(([x, y]) => [
      cylinder(0.016, 0.014, 0.05, 8, palette.metal, [x, y, 0.31]),
      box(0.2, 0.016, 0.004, palette.rubber, [x, y, 0.362], [0, 0, x * y > 0 ? 0.5 : -0.9]),
      ...guards(x, y),
    ]),
    ...[0, 1, 2, 3].map((i) => {
      const angle = (i * Math.PI) / 2;
      return box(0.008, 0.008, 0.21, palette.rubber, [0.085 * Math.cos(angle), 0.085 * Math.sin(angle), 0.105], [
        0.28 * Math.sin(angle),
        -0.28 * Math.cos(angle),
        0,
      ]);
    }),
  ];
  const near = mergeGeometries([
    ...solids(20, (x, y) => [torus(0.112, 0.008, 28, palette.light, [x, y, 0.35])]),
    sphere(0.028, 12, palette.glass, [0, 0, 0.185]),
  ]);
  const middle = mergeGeometries(solids(8, (x, y) => [torus(0.112, 0.008, 10, palette.light, [x, y, 0.35])]));
  const far = mergeGeometries([
    cylinder(0.055, 0.07, 0.2, 6, palette.light, [0, 0, 0.2]),
    ...rotors.map(([x, y]) => cylinder(0.11, 0.11, 0.02, 7, palette.metal, [x, y, 0.34])),
  ]);
  return [
    { body: near, leds: lamps(16, 0.06, 0.088, 0.235, 0.26, 0.25), pixels: 60 },
    { body: middle, leds: lamps(16, 0.06, 0.09, 0.23, 0.26, 0.1), pixels: 18 },
    { body: far, leds: lamps(6, 0.05, 0.1, 0.22, 0.27, 0, 0, meanLed), pixels: 0 },
  ];
}

function handbot() {
  const arm = (side, sides) => [
    cylinder(0.014, 0.014, 0.12, sides, palette.metal, [0.1, 0.075 * side, 0.03]),
    box(0.13, 0.026, 0.026, palette.light, [0.1, 0.075 * side, 0.115]),
    box(0.03, 0.05, 0.03, palette.accent, [0.178, 0.075 * side, 0.115]),
    box(0.045, 0.008, 0.022, palette.dark, [0.21, 0.075 * side + 0.02, 0.115]),
    box(0.045, 0.008, 0.022, palette.dark, [0.21, 0.075 * side - 0.02, 0.115]),
  ];
  const near = mergeGeometries([
    box(0.2, 0.12, 0.09, palette.dark, [-0.01, 0, 0.06]),
    box(0.12, 0.16, 0.03, palette.light, [-0.03, 0, 0.12]),
    cylinder(0.045, 0.04, 0.03, 20, palette.board, [-0.03, 0, 0.135]),
    sphere(0.022, 12, palette.glass, [0.05, 0, 0.135]),
    cylinder(0.018, 0.018, 0.02, 10, palette.metal, [-0.09, 0, 0.13]),
    ...arm(1, 10),
    ...arm(-1, 10),
  ]);
  const middle = mergeGeometries([
    box(0.2, 0.12, 0.09, palette.dark, [-0.01, 0, 0.06]),
    box(0.12, 0.16, 0.04, palette.light, [-0.03, 0, 0.125]),
    ...arm(1, 5).slice(1, 3),
    ...arm(-1, 5).slice(1, 3),
  ]);
  const far = mergeGeometries([
    box(0.2, 0.15, 0.13, palette.light, [-0.01, 0, 0.065]),
    box(0.12, 0.16, 0.04, palette.accent, [0.14, 0, 0.1]),
  ]);
  const ring = (gap, led) => lamps(12, 0.04, 0.062, 0.142, 0.156, gap, fifteenDegrees, led).translate(-0.03, 0, 0);
  return [
    { body: near, leds: ring(0.22), pixels: 60 },
    { body: middle, leds: ring(0.1), pixels: 18 },
    { body: far, leds: ring(0, meanLed), pixels: 0 },
  ];
}

// Nearest first; a level is drawn where the robot is at least `pixels` wide.
export const makeModels = () => ({ footbot: footbot(), eyebot: eyebot(), handbot: handbot() });

// For picking, shadows and labels.
export const extents = {
  footbot: { radius: 0.09, height: 0.147 },
  eyebot: { radius: 0.25, height: 0.566 },
  handbot: { radius: 0.2, height: 0.16 },
};

export function extentOf(world, entity) {
  const known = extents[world.kinds[entity]];
  if (known) return known;
  const [x, y, z] = world.bodyOf.get(entity)?.size ?? [0.1, 0.1, 0.1];
  if (world.kinds[entity] === "cylindric_prey") return { radius: x, height: z };
  return { radius: Math.hypot(x, y) / 2 || 0.1, height: z || 0.05 };
}
