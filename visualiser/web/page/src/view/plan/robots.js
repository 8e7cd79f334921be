// Robots seen from above, in metres with the front along x. Each is drawn once for each size into a sprite. Lengths are
// those of the models (visualiser/scene/*_mesh.cpp).
import { css, extentOf, paint } from "../look.js";

const DARK = "#353b44";
const SHELL = "#e3e5ea";
const METAL = "#9aa2ad";
const RUBBER = "#23272d";
const GLASS = "#7f93a6";
const FOOTBOT = "#3b78b0";
const EYEBOT = "#3f9a86";
const HANDBOT = "#d98736";
const NOSE = "#f08a3c";
const LED_OFF = "#59626c";

// Rings of LEDs: radius and width in metres, the first LED's angle as a part of the spacing.
export const rings = {
  footbot: { radius: 0.0785, width: 0.015, leds: 12 },
  eyebot: { radius: 0.2475, width: 0.02, leds: 16 },
  handbot: { radius: 0.08, width: 0.013, leds: 12 },
};
export const ringOf = (world, entity) => {
  const { radius } = extentOf(world, entity);
  return rings[world.kinds[entity]] ?? { radius: 0.87 * radius, width: 0.2 * radius, leds: 16 };
};

function disc(context, x, y, radius, fill) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fillStyle = fill;
  context.fill();
}

function ring(context, x, y, radius, width, colour) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.lineWidth = width;
  context.strokeStyle = colour;
  context.stroke();
}

function box(context, x, y, width, height, fill) {
  context.fillStyle = fill;
  context.fillRect(x, y - height / 2, width, height);
}

function wedge(context, from, to, half, fill) {
  context.beginPath();
  context.moveTo(from, -half);
  context.lineTo(to, 0);
  context.lineTo(from, half);
  context.closePath();
  context.fillStyle = fill;
  context.fill();
}

function softShadow(context, radius) {
  const gradient = context.createRadialGradient(0, 0, 0.7 * radius, 0, 0, 1.3 * radius);
  gradient.addColorStop(0, "rgb(0 0 0 / 0.4)");
  gradient.addColorStop(1, "rgb(0 0 0 / 0)");
  disc(context, 0, 0, 1.3 * radius, gradient);
}

const drawings = {
  footbot(context) {
    softShadow(context, 0.088);
    for (const side of [-1, 1]) box(context, -0.063, side * 0.07, 0.126, 0.028, RUBBER);
    box(context, 0.07, 0, 0.037, 0.034, DARK);
    disc(context, 0, 0, 0.087, DARK);
    ring(context, 0, 0, 0.0785, 0.015, LED_OFF);
    disc(context, 0, 0, 0.067, SHELL);
    disc(context, 0, 0, 0.052, FOOTBOT);
    disc(context, 0, 0, 0.034, SHELL);
    wedge(context, 0.03, 0.068, 0.02, NOSE);
    disc(context, 0, 0, 0.02, DARK);
    disc(context, 0, 0, 0.012, GLASS);
  },
  eyebot(context) {
    for (let i = 0; i < 4; i++) {
      const angle = Math.PI / 4 + (i * Math.PI) / 2;
      const [x, y] = [0.1553 * Math.cos(angle), 0.1553 * Math.sin(angle)];
      context.save();
      context.rotate(angle);
      box(context, 0.03, 0, 0.21, 0.018, METAL);
      context.restore();
      disc(context, x, y, 0.084, "rgb(108 119 131 / 0.28)");
      ring(context, x, y, 0.086, 0.008, i === 0 || i === 3 ? EYEBOT : SHELL);
      disc(context, x, y, 0.014, DARK);
    }
    ring(context, 0, 0, 0.2475, 0.024, SHELL);
    ring(context, 0, 0, 0.2475, 0.018, LED_OFF);
    disc(context, 0, 0, 0.058, EYEBOT);
    disc(context, 0, 0, 0.052, SHELL);
    wedge(context, 0.04, 0.11, 0.035, NOSE);
    disc(context, 0, 0, 0.018, DARK);
  },
  handbot(context) {
    softShadow(context, 0.095);
    for (const side of [-1, 1]) {
      box(context, 0.05, side * 0.05, 0.14, 0.022, METAL);
      box(context, 0.185, side * 0.063, 0.045, 0.01, DARK);
      box(context, 0.185, side * 0.037, 0.045, 0.01, DARK);
    }
    disc(context, 0, 0, 0.0865, DARK);
    ring(context, 0, 0, 0.08, 0.013, LED_OFF);
    disc(context, -0.025, 0, 0.05, SHELL);
    box(context, -0.025, 0, 0.073, 0.1, SHELL);
    box(context, -0.02, 0, 0.06, 0.072, HANDBOT);
    for (const side of [-1, 1]) ring(context, -0.035, side * 0.06, 0.029, 0.006, DARK);
    box(context, 0.048, 0, 0.03, 0.09, DARK);
    wedge(context, 0.02, 0.06, 0.03, SHELL);
  },
};

// Draws a robot of a user's kind: a disc in its paint.
function drawOther(context, { radius, colour }) {
  softShadow(context, radius);
  disc(context, 0, 0, radius, DARK);
  ring(context, 0, 0, 0.87 * radius, 0.2 * radius, LED_OFF);
  disc(context, 0, 0, 0.75 * radius, css(paint(colour ?? 0xb0b8c2)));
  wedge(context, 0.35 * radius, 0.98 * radius, 0.3 * radius, NOSE);
}

// Returns a picture of one robot of a kind, with its front to the right. `scale`: pixels a metre.
export function makeSprite(world, entity, scale) {
  const { radius } = extentOf(world, entity);
  const half = Math.ceil(1.4 * Math.max(radius, 0.17 * (world.kinds[entity] === "handbot")) * scale) + 1;
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 2 * half;
  const context = canvas.getContext("2d");
  context.setTransform(scale, 0, 0, -scale, half, half);
  (drawings[world.kinds[entity]] ?? ((target) => drawOther(target, world.look(entity))))(context);
  return canvas;
}
