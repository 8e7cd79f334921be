// Which wall or patch a ray meets: against steps along the ray that ask where it is in a body.
import assert from "node:assert/strict";
import test from "node:test";
import { World } from "../../visualiser/web/page/src/world.js";
import { pickStatic } from "../../visualiser/web/page/src/view/pick_static.js";

const looks = [
  { role: "object", form: "box", based: false },
  { role: "object", form: "cylinder", based: true },
  { role: "patch", form: "none", based: false },
];

function worldOf(bodies) {
  return { bodies: bodies.map((body, entity) => ({ ...body, entity })), slots: new Int32Array(bodies.length).fill(-1), look: (entity) => looks[bodies[entity].look] };
}

const level = (yaw) => [0, 0, Math.sin(yaw / 2), Math.cos(yaw / 2)];

test("from above, bodies are where they stand and as they are turned", () => {
  const down = [0, 0, -1];
  const world = worldOf([
    { look: 0, size: [4, 0.2, 0.5], position: [2, 2, 0.25], orientation: level(Math.PI / 4) },
    { look: 2, size: [1, 1, 0], position: [4, 0, 0], orientation: level(0) },
    { look: 2, size: [0.5, 0, 0], position: [0, 4, 0], orientation: level(0) },
    { look: 1, size: [0.3, 0.3, 1], position: [0.1, 4, 0], orientation: level(0) },
  ]);
  const at = (x, y) => pickStatic(world, [x, y, 10], down);
  assert.equal(at(3, 3), 0);
  assert.equal(at(1, 3), null);
  assert.equal(at(4.4, -0.4), 1);
  assert.equal(at(0.1, 4), 3); // it stands on the disc
  assert.equal(at(-0.3, 4), 2);
  world.slots[3] = 0; // robots and preys are picked otherwise
  assert.equal(at(0.1, 4), 2);
});

test("the first body of a slanted ray, as steps along it find it", () => {
  let seed = 1;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  let met = 0;
  for (let round = 0; round < 120; round++) {
    const bodies = Array.from({ length: 4 }, () => ({ look: 0, size: [0.2 + random(), 0.2 + random(), 0.2 + 0.1 * random()], position: [3 * random(), 3 * random(), 0.15], orientation: level(6 * random()) }));
    const origin = [3 * random(), -2, 2];
    const direction = [random() - 0.5, 1, -0.3 - random()];
    const inside = (point, share) => bodies.findIndex(({ size, position, orientation }) => {
      const yaw = 2 * Math.atan2(orientation[2], orientation[3]);
      const [dx, dy, dz] = point.map((value, k) => value - position[k]);
      const [x, y] = [dx * Math.cos(yaw) + dy * Math.sin(yaw), dy * Math.cos(yaw) - dx * Math.sin(yaw)];
      return [x, y, dz].every((value, k) => Math.abs(value) <= (share * size[k]) / 2);
    });
    const first = (share) => {
      for (let t = 0; t < 6; t += 0.004) {
        const body = inside(origin.map((value, k) => value + t * direction[k]), share);
        if (body >= 0) return body;
      }
      return null;
    };
    // Rays that only graze a body, and bodies that overlap, have no clear answer.
    const [larger, smaller] = [first(1.03), first(0.97)];
    if (larger !== smaller) continue;
    assert.equal(pickStatic(worldOf(bodies), origin, direction), larger);
    if (larger !== null) met++;
  }
  assert.ok(met > 15, String(met));
});

test("the ground is the highest cell of a terrain about a place, and the floor elsewhere", () => {
  const terrain = { low: [-1, -0.5, 0], high: [1, 0.5, 0.4], columns: 4, rows: 2, heights: [0.1, 0.1, 0.1, 0.4, 0.1, 0.1, 0.1, null] };
  const entities = { id: ["hill"], kind: [0], movable: [0], engine: [-1], host: [-1], controller: [-1] };
  const at = (x, y, orientation) => new World({ kinds: ["terrain"], looks: { terrain: { role: "terrain" } }, bodies: [{ entity: 0, position: [5, 5, 0.5], orientation, terrain }], entities }).groundAt(x, y);
  const near = (found, wanted) => assert.ok(Math.abs(found - wanted) < 1e-9, `${found} is not ${wanted}`);
  near(at(4.1, 4.6, level(0)), 0.6);
  near(at(5.9, 4.6, level(0)), 0.9);
  near(at(5.4, 4.6, level(0)), 0.9); // a cell beside it is higher
  near(at(3.9, 5, level(0)), 0);
  near(at(5, 6.1, level(0)), 0);
  near(at(5.4, 5.9, level(Math.PI / 2)), 0.9);
  near(new World({ kinds: [], looks: {}, bodies: [], entities: { id: [], kind: [], movable: [] } }).groundAt(0, 0), 0);
});
