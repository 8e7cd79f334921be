// The colours of all LEDs in one texture, and the material that shows them. A robot has 20 texels: 16 LEDs and the
// beacon are used.
import * as THREE from "three";
import { BEACON } from "./mesh_geometry.js";
import { Flag, RING_LEDS } from "../protocol.js";

const TEXELS = 20;
const ROBOTS_A_ROW = 64;

export class LedTexture {
  constructor(count) {
    this.width = TEXELS * ROBOTS_A_ROW;
    this.height = Math.max(1, Math.ceil(count / ROBOTS_A_ROW));
    this.bytes = new Uint8Array(this.width * this.height * 4);
    this.texture = new THREE.DataTexture(this.bytes, this.width, this.height, THREE.RGBAFormat, THREE.UnsignedByteType);
    this.texture.magFilter = this.texture.minFilter = THREE.NearestFilter;
    this.shown = new Uint32Array(count);
    this.uneven = new Set();
    this.texture.needsUpdate = true;
  }

  // Updates the texture from a frame. `slotOf`: index of an entity in the frame.
  update(frame, slotOf) {
    const colours = new Uint32Array(frame.colours.buffer, frame.colours.byteOffset, frame.count);
    let changed = false;
    for (let slot = 0; slot < frame.count; slot++) {
      if (colours[slot] === this.shown[slot]) continue;
      this.shown[slot] = colours[slot];
      this.fill(slot, frame.colours.subarray(4 * slot, 4 * slot + 4));
      this.uneven.delete(slot);
      changed = true;
    }
    for (const slot of this.uneven) this.fill(slot, frame.colours.subarray(4 * slot, 4 * slot + 4));
    changed ||= this.uneven.size > 0 || frame.rings.length > 0;
    this.uneven.clear();
    for (const { entity, colours: ring } of frame.rings) {
      const slot = slotOf[entity];
      this.uneven.add(slot);
      for (let led = 0; led < RING_LEDS; led++) {
        const [r, g, b] = ring.subarray(3 * led, 3 * led + 3);
        this.set(slot, led, r, g, b, r + g + b > 0);
      }
    }
    if (changed) this.texture.needsUpdate = true;
  }

  fill(slot, [r, g, b, flags]) {
    for (let led = 0; led < RING_LEDS; led++) this.set(slot, led, r, g, b, flags & Flag.lit);
    this.set(slot, BEACON, r, g, b, flags & Flag.beaconLit);
  }

  set(slot, led, r, g, b, lit) {
    const place = 4 * (Math.floor(slot / ROBOTS_A_ROW) * this.width + (slot % ROBOTS_A_ROW) * TEXELS + led);
    this.bytes[place] = r;
    this.bytes[place + 1] = g;
    this.bytes[place + 2] = b;
    this.bytes[place + 3] = lit ? 255 : 0;
  }

  dispose() {
    this.texture.dispose();
  }
}

export function ledMaterial(texture) {
  return new THREE.ShaderMaterial({
    side: THREE.DoubleSide,
    uniforms: { leds: { value: texture } },
    vertexShader: `
      uniform sampler2D leds;
      attribute float led;
      attribute float slot;
      varying vec4 shine;
      void main() {
        int row = int(slot) / ${ROBOTS_A_ROW};
        int column = (int(slot) - row * ${ROBOTS_A_ROW}) * ${TEXELS} + int(led + 0.5);
        shine = texelFetch(leds, ivec2(column, row), 0);
        gl_Position = projectionMatrix * modelViewMatrix * instanceMatrix * vec4(position, 1.0);
      }`,
    // Colours of LEDs are shown unchanged, whatever the light of the scene.
    fragmentShader: `
      varying vec4 shine;
      void main() {
        vec3 colour = mix(vec3(0.35, 0.38, 0.42), shine.rgb, step(0.5, shine.a));
        gl_FragColor = vec4(colour, 1.0);
      }`,
  });
}
