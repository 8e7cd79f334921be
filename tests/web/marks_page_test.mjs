// The proof of a token, and the lines of marks and viewpoints, without a browser. node --test
import assert from "node:assert/strict";
import { createHmac } from "node:crypto";
import test from "node:test";
import { proofOf } from "../../visualiser/web/page/src/token.js";
import { Marks } from "../../visualiser/web/page/src/view/marks.js";
import { Flight, cameraOf, viewOf, viewpointXml } from "../../visualiser/web/page/src/view/viewpoints.js";

test("a proof is the HMAC-SHA256 of the challenge, whatever its length", () => {
  for (let length = 0; length < 200; length += 7) {
    const [token, challenge] = ["0123456789abcdef".repeat(2), "é".repeat(length)];
    assert.equal(proofOf(token, challenge), createHmac("sha256", token).update(challenge).digest("hex"), `${length} letters`);
  }
});

// Robots at places, each turned by a quarter to the left.
function pictureOf(places, shows) {
  const [cos, sin] = [Math.SQRT1_2, Math.SQRT1_2];
  const sensors = [[0.1, 0, 0], [0, 0.1, Math.PI / 2]];
  const world = {
    size: places.length,
    slots: places.map((_, i) => i),
    isRobot: () => true,
    look: () => ({ role: "robot", form: "cylinder", proximity: { height: 0.05, range: 0.2, sensors } }),
  };
  const picture = {
    shows: { rays: false, bodies: false, links: false, ...shows },
    placeOf: (entity) => places[entity],
    motion: { quaternions: Float32Array.from(places.flatMap(() => [0, 0, sin, cos])), frame: {} },
    invalidate() {},
    view: { world, canvas: { clientWidth: 100, clientHeight: 100 }, project: (x, y) => ({ x, y, depth: 0 }), pixelsPerMetre: () => 10 },
  };
  const sent = [];
  const marks = new Marks(picture, (request) => sent.push(request));
  marks.setWorld(world);
  return { marks, sent, picture };
}
const near = (list, wanted) => {
  assert.equal(list.length, wanted.length);
  list.forEach((value, i) => assert.ok(Math.abs(value - wanted[i]) < 1e-6, `${list}\n${wanted}`));
};
const nothing = { rays: { entities: [], hits: [] }, shapes: { entities: [], models: [], bodies: [] }, links: { both: [], one: [] } };

test("rays turn with their robot and end at what they meet", () => {
  const { marks } = pictureOf([[1, 2, 0]], { rays: true });
  marks.receive({ ...nothing, rays: { entities: [0], hits: [[1, 0.5]] } });
  const [free, hit] = marks.lines({});
  near(free.points, [1, 2.1, 0.05, 1, 2.3, 0.05]);
  near(hit.points, [0.9, 2, 0.05, 0.8, 2, 0.05]);
});

test("beams of a range scanner turn with their robot", () => {
  const { marks } = pictureOf([[1, 2, 0]], { rays: true });
  marks.receive({ ...nothing, scans: [{ entity: 0, from: [0.1, 0, 0.2], free: [1.1, 0, 0.2], hit: [0.1, 0.5, 0.2] }] });
  const [free, hit] = marks.lines({});
  near(free.points, [1, 2.1, 0.2, 1, 3.1, 0.2]);
  near(hit.points, [1, 2.1, 0.2, 0.5, 2.1, 0.2]);
});

test("a link is whole if both hear each other, and else half a line from the robot that is heard", () => {
  const { marks } = pictureOf([[0, 0, 0], [2, 0, 0], [0, 4, 0]], { links: true });
  marks.receive({ ...nothing, links: { both: [0, 1], one: [2, 0] } });
  near(marks.lines({}).at(-1).points, [0, 0, 0.1, 2, 0, 0.1, 0, 4, 0.1, 0, 2, 0.1]);
});

test("links that would fill the picture are faint", () => {
  const side = 12; // robots, half a metre from each other
  const { marks } = pictureOf(Array.from({ length: side * side }, (_, i) => [(i % side) / 2, Math.floor(i / side) / 2, 0]), { links: true });
  const opacity = (both) => {
    marks.receive({ ...nothing, links: { both, one: [] } });
    return marks.lines({}).at(-1).opacity;
  };
  assert.equal(opacity([]), 1);
  assert.equal(opacity([0, 1, 1, 2]), 1);
  const all = Array.from({ length: side * (side - 1) }, (_, i) => [i, i + side]).flat(); // 66 m, at 10 pixels a metre, on 100 x 100
  assert.equal(opacity(all), 1);
  const ten = opacity(Array.from({ length: 10 }, () => all).flat());
  assert.ok(Math.abs(ten - 0.15 / 0.66) < 1e-6, `${ten}`);
  assert.ok(opacity(Array.from({ length: 200 }, () => all).flat()) >= 0.06);
});

test("a body is drawn where it is in its entity", () => {
  const { marks } = pictureOf([[1, 1, 0]], { bodies: true });
  marks.receive({ ...nothing, shapes: { entities: [0], models: [0], bodies: [[[0, 0.5, 0, 0, 0, 0, 0, 1, 0.2, 0.1, 0.3]]] } });
  const { points } = marks.lines({}).find(({ name }) => name === "bodies");
  assert.equal(points.length, 12 * 6);
  const extent = (k) => [Math.min(...points.filter((_, i) => i % 3 === k)), Math.max(...points.filter((_, i) => i % 3 === k))];
  near([...extent(0), ...extent(1), ...extent(2)], [0.9, 1.1, 1.3, 1.7, -0.3, 0.3]);
});

test("only robots in the picture are asked for, once, and none if nothing is shown", () => {
  const places = [[50, 50, 0], [60, 50, 0], [500, 50, 0], null];
  const { marks, sent, picture } = pictureOf(places, { rays: true });
  marks.ask(1000);
  marks.ask(2000);
  assert.deepEqual(sent, [{ do: "marks", rays: [0, 1], bodies: [], links: [] }]);
  picture.shows.rays = false;
  marks.ask(3000);
  assert.deepEqual(sent[1], { do: "marks", rays: [], bodies: [], links: [] });
  marks.ask(4000);
  assert.equal(sent.length, 2);
});

test("a viewpoint is kept as it was, through a view and through XML", () => {
  for (const camera of [{ position: [3, 3, 1], heading: 39, pitch: -34, roll: 0 }, { position: [1, 2, 0.5], heading: -155, pitch: 0, roll: 0 }, { position: [1, 2, 0.5], heading: 10, pitch: 20, roll: 0 }]) {
    const again = cameraOf(viewOf(camera, 10));
    for (const name of ["heading", "pitch"]) assert.ok(Math.abs(again[name] - camera[name]) < 1e-9, name);
    near(again.position, camera.position);
  }
  assert.equal(
    viewpointXml(7, { position: [-2.683521, 1, 6.51374], heading: 62, pitch: -38, roll: -0 }),
    "<camera_view_XYZ_7>-2.68352, 1, 6.51374</camera_view_XYZ_7>\n<camera_view_HPR_7>62, -38, 0</camera_view_HPR_7>",
  );
});

test("a flight passes each viewpoint at its time and ends at the last", () => {
  const views = [0, 30, 80].map((heading, i) => viewOf({ position: [i, 2 * i, 1 + i], heading, pitch: -30 }, 10));
  const flight = new Flight(views, 100);
  views.forEach((view, i) => {
    const now = flight.at(100 + 3000 * i);
    near([...now.target, now.span, ...now.direction], [...view.target, view.span, ...view.direction]);
  });
  assert.ok(!flight.isOver(6099) && flight.isOver(6100));
  near(flight.at(9000).target, views[2].target);
});
