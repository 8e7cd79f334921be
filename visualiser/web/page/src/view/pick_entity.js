// Finds the entity under the pointer: the nearest one whose bounding sphere the ray of sight meets.
import * as THREE from "three";
import { extentOf } from "./look.js";

const raycaster = new THREE.Raycaster();

// `x`, `y`: -1 to 1, as in three.js. `slack`: radians by which a ray may miss.
export function pick(world, motion, camera, x, y, slack = 0.004) {
  raycaster.setFromCamera(new THREE.Vector2(x, y), camera);
  const { origin, direction } = raycaster.ray;
  let best = null;
  let nearest = Infinity;
  for (let entity = 0; entity < world.size; entity++) {
    const slot = world.slots[entity];
    if (slot < 0 || !motion.isPresent(slot)) continue;
    const { radius, height } = extentOf(world, entity);
    const dx = motion.positions[3 * slot] - origin.x;
    const dy = motion.positions[3 * slot + 1] - origin.y;
    const dz = motion.positions[3 * slot + 2] + height / 2 - origin.z;
    const along = dx * direction.x + dy * direction.y + dz * direction.z;
    if (along <= 0) continue;
    const away = dx * dx + dy * dy + dz * dz - along * along;
    const reach = Math.max(radius, height / 2) + slack * along;
    const score = along + 2 * Math.sqrt(Math.max(away, 0));
    if (away <= reach * reach && score < nearest) {
      nearest = score;
      best = entity;
    }
  }
  return best;
}

// Returns the point where the ray meets the floor at a height; null if it does not.
export function floorPoint(camera, x, y, height) {
  raycaster.setFromCamera(new THREE.Vector2(x, y), camera);
  return raycaster.ray.intersectPlane(new THREE.Plane(new THREE.Vector3(0, 0, 1), -height), new THREE.Vector3());
}

export function sight(camera, x, y) {
  raycaster.setFromCamera(new THREE.Vector2(x, y), camera);
  return { origin: raycaster.ray.origin.toArray(), direction: raycaster.ray.direction.toArray() };
}
