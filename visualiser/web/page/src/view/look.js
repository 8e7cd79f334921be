// The look of bodies and floor in 3D and in plan: constants for both views, without any library.

// The palette of all renderers (visualiser/scene/material.h); a test compares the two.
export const palette = {
  sky: 0xe9eef4,
  floor: 0xdcdfe2,
  floor_line: 0xc3c8ce,
  outside: 0xe4e8ec,
  wall: 0xeae6de,
  hole: 0x1c2026,
  selection: 0xf2a33a,
  label: 0x20262e,
  collision: 0x1f8f5f,
  ray_free: 0x6fa8dc,
  ray_hit: 0xd9483b,
};

// The themes for day, which is that palette, and for night, which only the page has.
export const themes = {
  light: { background: palette.sky, sky: 0xffffff, ground: 0xb9c0c9, sun: 2.1, hemisphere: 1.5, floor: palette.floor, line: palette.floor_line, rim: 0x9aa5b1, link: 0x6a48b8 },
  dark: { background: 0x11161d, sky: 0xdfe9f5, ground: 0x2b323c, sun: 1.9, hemisphere: 1.35, floor: 0x3a444f, line: 0x4c5763, rim: 0x687482, link: 0xb59cff },
};

export const SELECTION = 0x3d8bfd;
export const GRIP = 0xf08a3c;
export const LED_OFF = 0x59626c;
export const LED_OFF_BY_NIGHT = 0xc3ccd6;
// The colours of trails in turn; neighbours are easy to distinguish.
export const TRAILS = [0x3d8bfd, 0xe08a2e, 0x2fa58a, 0xb65fcf, 0xd9575a, 0x8a9a2f, 0x4fa3c7, 0xa0785a];

export const css = (colour) => `#${(colour & 0xffffff).toString(16).padStart(6, "0")}`;
export const rgb = (colour) => [(colour >> 16) & 255, (colour >> 8) & 255, colour & 255];

// Sizes for picking, labels and the choice of the level of detail.
export const extents = {
  footbot: { radius: 0.09, height: 0.147 },
  eyebot: { radius: 0.25, height: 0.566 },
  handbot: { radius: 0.2, height: 0.16 },
};

export function extentOf(world, entity) {
  const look = world.look(entity);
  if (look.role === "robot") return extents[world.kinds[entity]] ?? look;
  const [x, y, z] = world.bodyOf.get(entity)?.size ?? [0.1, 0.1, 0.1];
  if (look.form === "cylinder") return { radius: x, height: z };
  return { radius: Math.hypot(x, y) / 2 || 0.1, height: z || 0.05 };
}

// Returns a paint with the same hue, less saturated, as all renderers use it for floors, walls, blocks and preys.
export function paint(colour) {
  const channels = rgb(colour);
  const grey = 0.3 * channels[0] + 0.59 * channels[1] + 0.11 * channels[2];
  return channels.reduce((sum, channel) => sum * 256 + Math.round(0.52 * channel + 0.26 * grey + 0.22 * 205), 0);
}

// The lines of the floor, as in all renderers (visualiser/scene/floor_grid.h); a test compares the two.
export const floorGrid = { spacings: [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100], most_cells: 14 };

// Returns the metres between them in an arena whose longer side is `extent`.
export function gridStep(extent) {
  const { spacings, most_cells: cells } = floorGrid;
  return spacings.find((spacing) => extent <= cells * spacing) ?? spacings.at(-1);
}

const TALL_M = 0.25; // lower walls hide nothing …
const TALL_PART = 0.08; // … or in a small arena, lower than this part of its size

// Returns whether a body is a wall at the edge of the arena. It must be long and tall. It must be within half a
// thickness, and a fiftieth of the arena's size, of one of the arena's sides.
export function isBoundaryWall({ size: [x, y, z], position }, arena) {
  const thickness = Math.min(x, y);
  if (z < Math.min(TALL_M, TALL_PART * Math.max(arena[0], arena[1])) || Math.max(x, y) < 4 * thickness) return false;
  return [0, 1].some((axis) => {
    const toSide = Math.min(Math.abs(position[axis]), Math.abs(arena[axis] - position[axis]));
    return toSide <= thickness / 2 + 0.02 * arena[axis];
  });
}
