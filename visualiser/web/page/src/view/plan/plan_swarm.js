// The robots and objects of the plan, at the level of detail for their size: dots in the picture's memory, or sprites
// with the LEDs drawn over them.
import { Flag, RING_LEDS } from "../../protocol.js";
import { LED_OFF, LED_OFF_BY_NIGHT, css, extentOf } from "../look.js";
import { fillBody, shadowOf } from "./bodies.js";
import { DOT_PIXELS, DotSprites } from "./dots.js";
import { makeSprite, ringOf } from "./robots.js";

const LEAST_PIXELS = 6; // CSS pixels; less in dense swarms
const LEAST_OF_SPACING = 0.5; // more would look like a denser swarm
const FLIES_M = 0.05;
const GLOW_RADII = 2.3;

export class PlanSwarm {
  constructor(world) {
    this.world = world;
    this.dots = new DotSprites();
    this.sprites = new Map(); // by kind: {scale, canvas}
    this.glows = new Map(); // by colour
    // The kinds are ordered so that flying robots come last.
    const kinds = [...new Set(world.robots.map((entity) => world.kinds[entity]))];
    this.herds = kinds
      .map((kind) => {
        const robots = world.robots.filter((entity) => world.kinds[entity] === kind);
        return { kind, sample: robots[0], slots: Int32Array.from(robots, (entity) => world.slots[entity]), ...extentOf(world, robots[0]) };
      })
      .sort((a, b) => a.height - b.height);
    this.things = world.movable.filter((entity) => !world.isRobot(entity));
    this.spacing = Math.sqrt((world.arena[0] * world.arena[1]) / Math.max(1, world.robots.length));
    this.rings = new Map(); // slot to the colours of its LEDs
  }

  addFrame(frame) {
    this.rings = new Map(frame.rings.map(({ entity, colours }) => [this.world.slots[entity], colours]));
  }

  // Returns the pixels to which a robot's diameter is limited.
  diameter(herd, frame) {
    const least = Math.min(LEAST_PIXELS * frame.ratio, Math.max(LEAST_OF_SPACING * this.spacing * frame.scale, 2 * frame.ratio));
    return Math.max(2 * herd.radius * frame.scale, least);
  }
  isDots(herd, frame) {
    return this.diameter(herd, frame) < DOT_PIXELS * frame.ratio;
  }

  // Returns the colour of its LEDs; `off` if all LEDs are off.
  colourAt(motion, slot, off) {
    const { colours } = motion;
    if (!(colours[4 * slot + 3] & Flag.lit)) return off;
    return (colours[4 * slot] << 16) | (colours[4 * slot + 1] << 8) | colours[4 * slot + 2];
  }

  // Writes robots that are dots into the memory of the picture.
  writeDots(pixels, frame, motion, dark) {
    this.drawn = { dots: 0, sprites: 0 };
    const off = dark ? LED_OFF_BY_NIGHT : LED_OFF;
    const { positions: p, colours } = motion;
    for (const herd of this.herds) {
      if (!this.isDots(herd, frame)) continue;
      const diameter = Math.round(2 * this.diameter(herd, frame));
      for (const slot of herd.slots) {
        if (colours[4 * slot + 3] & Flag.absent) continue;
        const x = frame.x(p[3 * slot]);
        const y = frame.y(p[3 * slot + 1]);
        if (x < -20 || y < -20 || x > frame.width + 20 || y > frame.height + 20) continue;
        this.dots.draw(pixels, frame.width, frame.height, x, y, diameter, motion.yaw(slot), this.colourAt(motion, slot, off), dark);
        this.drawn.dots++;
      }
    }
  }

  drawThings(context, frame, motion, paints) {
    for (const entity of this.things) {
      const slot = this.world.slots[entity];
      if (!motion.isPresent(slot)) continue;
      const pose = { position: motion.positions.subarray(3 * slot, 3 * slot + 3), orientation: motion.quaternions.subarray(4 * slot, 4 * slot + 4) };
      const body = this.world.bodyOf.get(entity);
      const [r, g, b] = motion.colours.subarray(4 * slot, 4 * slot + 3);
      const [colour, intensity] = paints.get(entity) ?? [(r << 16) | (g << 8) | b, 1];
      fillBody(context, frame, this.world.look(entity), body, pose, colour, intensity);
    }
  }

  drawSprites(context, frame, motion) {
    for (const herd of this.herds) {
      if (this.isDots(herd, frame)) continue;
      const seen = this.visible(herd, frame, motion);
      if (seen.length === 0) continue;
      this.drawn.sprites += seen.length;
      this.drawShadows(context, herd, seen, frame);
      this.drawGlows(context, herd, seen, frame, motion);
      this.drawBodies(context, herd, seen, frame, motion);
      this.drawLeds(context, herd, seen, frame, motion);
    }
  }

  visible(herd, frame, motion) {
    const reach = 3 * this.diameter(herd, frame);
    const seen = [];
    for (const slot of herd.slots) {
      if (!motion.isPresent(slot)) continue;
      const [x, y] = [frame.x(motion.positions[3 * slot]), frame.y(motion.positions[3 * slot + 1])];
      if (x > -reach && y > -reach && x < frame.width + reach && y < frame.height + reach) seen.push({ slot, x, y, z: motion.positions[3 * slot + 2] });
    }
    return seen.sort((a, b) => a.z - b.z);
  }

  // Draws shadows of robots above the floor. The higher a robot is, the further its shadow is from it.
  drawShadows(context, herd, seen, frame) {
    context.fillStyle = "rgb(0 0 0 / 0.2)";
    context.beginPath();
    for (const { x, y, z } of seen) {
      if (z < FLIES_M) continue;
      const [dx, dy] = shadowOf(frame, z);
      const radius = herd.radius * frame.scale;
      context.moveTo(x + dx + radius, y + dy);
      context.arc(x + dx, y + dy, radius, 0, 2 * Math.PI);
    }
    context.fill();
  }

  drawGlows(context, herd, seen, frame, motion) {
    const reach = GLOW_RADII * herd.radius * frame.scale;
    for (const { slot, x, y, z } of seen) {
      const colour = this.colourAt(motion, slot, null);
      if (colour === null || z > 0.5) continue;
      context.drawImage(this.glow(colour), x - reach, y - reach, 2 * reach, 2 * reach);
    }
  }

  glow(colour) {
    if (!this.glows.has(colour)) {
      if (this.glows.size > 64) this.glows.clear();
      const canvas = document.createElement("canvas");
      canvas.width = canvas.height = 64;
      const context = canvas.getContext("2d");
      const gradient = context.createRadialGradient(32, 32, 10, 32, 32, 32);
      gradient.addColorStop(0, `${css(colour)}90`);
      gradient.addColorStop(1, `${css(colour)}00`);
      context.fillStyle = gradient;
      context.fillRect(0, 0, 64, 64);
      this.glows.set(colour, canvas);
    }
    return this.glows.get(colour);
  }

  drawBodies(context, herd, seen, frame, motion) {
    let sprite = this.sprites.get(herd.kind);
    if (sprite?.scale !== frame.scale) {
      sprite = { scale: frame.scale, canvas: makeSprite(this.world, herd.sample, frame.scale) };
      this.sprites.set(herd.kind, sprite);
    }
    const half = sprite.canvas.width / 2;
    for (const { slot, x, y } of seen) {
      const yaw = motion.yaw(slot);
      const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
      context.setTransform(cos, -sin, sin, cos, x, y);
      context.drawImage(sprite.canvas, -half, -half);
    }
    context.setTransform(1, 0, 0, 1, 0, 0);
  }

  // Draws LEDs. Rings of one colour share one path for each colour; the others are drawn LED by LED.
  drawLeds(context, herd, seen, frame, motion) {
    const ring = ringOf(this.world, herd.sample);
    const radius = ring.radius * frame.scale;
    context.lineWidth = ring.width * frame.scale;
    const paths = new Map();
    const pathOf = (colour) => paths.get(colour) ?? paths.set(colour, new Path2D()).get(colour);
    for (const { slot, x, y } of seen) {
      const leds = this.rings.get(slot);
      if (leds) this.traceLeds(pathOf, ring, leds, x, y, motion.yaw(slot), radius);
      else {
        const colour = this.colourAt(motion, slot, null);
        if (colour === null) continue;
        const path = pathOf(colour);
        path.moveTo(x + radius, y);
        path.arc(x, y, radius, 0, 2 * Math.PI);
      }
    }
    for (const [colour, path] of paths) {
      context.strokeStyle = css(colour);
      context.stroke(path);
    }
  }

  traceLeds(pathOf, ring, leds, x, y, yaw, radius) {
    const spacing = (2 * Math.PI) / ring.leds;
    for (let led = 0; led < Math.min(ring.leds, RING_LEDS); led++) {
      const colour = (leds[3 * led] << 16) | (leds[3 * led + 1] << 8) | leds[3 * led + 2];
      if (colour === 0) continue;
      const from = -(yaw + led * spacing); // the middle of the first LED is half a spacing left of the front
      const path = pathOf(colour);
      path.moveTo(x + radius * Math.cos(from), y + radius * Math.sin(from));
      path.arc(x, y, radius, from, from - spacing, true);
    }
  }
}
