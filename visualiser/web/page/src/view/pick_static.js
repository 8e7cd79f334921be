// Finds the static body that a ray meets first, for the editor, in which static bodies can be selected, too.

const CUT_M = 0.35; // higher parts of walls are cut open
const THIN_M = 0.02; // thickness of flat bodies on the floor
const SMALL_M = 0.12; // size of lights and sounds

// `origin`, `direction`: of the ray, in metres. Returns the entity; null if it meets none.
export function pickStatic(world, origin, direction) {
  let best = null;
  let nearest = Infinity;
  for (const body of world.bodies) {
    if (world.slots[body.entity] >= 0) continue;
    const { low, high } = boxOf(world.look(body.entity), body);
    if (!low) continue;
    const inverse = body.orientation.map((value, i) => (i < 3 ? -value : value));
    const from = turned(inverse, origin.map((value, i) => value - body.position[i]));
    const distance = entry(from, turned(inverse, direction), low, high);
    if (distance !== null && distance < nearest) [best, nearest] = [body.entity, distance];
  }
  return best;
}

// Returns the box in the frame of the body.
function boxOf({ role, form, based }, { size: [x, y, z] }) {
  if (form === "box" && !based) return { low: [-x / 2, -y / 2, -z / 2], high: [x / 2, y / 2, Math.min(z / 2, -z / 2 + Math.max(CUT_M, z / 10))] };
  if (form === "box") return { low: [-x / 2, -y / 2, 0], high: [x / 2, y / 2, z] };
  if (form === "cylinder") return { low: [-x, -x, 0], high: [x, x, z] };
  if (role === "patch" || role === "hole") {
    const [a, b] = y === 0 ? [x, x] : [x / 2, y / 2];
    return { low: [-a, -b, 0], high: [a, b, THIN_M] };
  }
  if (role === "light" || role === "sound") return { low: [-SMALL_M, -SMALL_M, -SMALL_M], high: [SMALL_M, SMALL_M, SMALL_M] };
  return {}; // terrain is selected in the list
}

// Returns the distance along the ray to the box; null if it misses.
function entry(from, direction, low, high) {
  let [near, far] = [0, Infinity];
  for (let k = 0; k < 3; k++) {
    if (Math.abs(direction[k]) < 1e-12) {
      if (from[k] < low[k] || from[k] > high[k]) return null;
      continue;
    }
    const [a, b] = [(low[k] - from[k]) / direction[k], (high[k] - from[k]) / direction[k]];
    near = Math.max(near, Math.min(a, b));
    far = Math.min(far, Math.max(a, b));
  }
  return near <= far ? near : null;
}

// Returns a vector turned by a quaternion x, y, z, w.
function turned([x, y, z, w], [a, b, c]) {
  const [i, j, k] = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * i + y * k - z * j, b + w * j + z * i - x * k, c + w * k + x * j - y * i];
}
