// The parts of the page's plan that need no browser.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { floorGrid, gridStep, palette } from "../../visualiser/web/page/src/view/look.js";
import { outline } from "../../visualiser/web/page/src/view/plan/bodies.js";
import { DotSprites } from "../../visualiser/web/page/src/view/plan/dots.js";
import { scaleLength } from "../../visualiser/web/page/src/view/overlay.js";
import { TrailRecord } from "../../visualiser/web/page/src/view/trail_record.js";
import { folder } from "./harness.mjs";

globalThis.window = { addEventListener() {} };
const { PlanCamera } = await import("../../visualiser/web/page/src/view/plan/plan_camera.js");

const FLOOR = 0xffe2dfdc; // in memory: alpha, blue, green, red
const canvasOf = (side) => new Uint32Array(side * side).fill(FLOOR);
// Places of pixels of which `wanted` says so about red, green, blue.
function placesOf(pixels, side, wanted) {
  return [...pixels].flatMap((word, i) => (wanted(word & 255, (word >> 8) & 255, (word >> 16) & 255) ? [[i % side, Math.floor(i / side)]] : []));
}
const mean = (places, k) => places.reduce((sum, place) => sum + place[k], 0) / places.length;

test("a dot covers the area of its disc, about its place, in its colour with a darker rim", () => {
  const side = 40;
  for (const [x, y] of [[20, 20], [20.4, 19.7], [20.9, 20.9]]) {
    const pixels = canvasOf(side);
    new DotSprites().draw(pixels, side, side, x, y, 10, 0, 0x00ff00, false);
    const changed = placesOf(pixels, side, (r, g, b) => r !== 0xdc || g !== 0xdf || b !== 0xe2);
    assert.ok(Math.abs(mean(changed, 0) + 0.5 - x) < 0.5 && Math.abs(mean(changed, 1) + 0.5 - y) < 0.5, `${mean(changed, 0)}, ${mean(changed, 1)}`);
    // Coverage of each pixel: how far its red has gone from the floor's to none.
    const area = placesOf(pixels, side, () => true).reduce((sum, _, i) => sum + (0xdc - (pixels[i] & 255)) / 0xdc, 0);
    assert.ok(Math.abs(area - Math.PI * 2.5 ** 2) < 2.5, `${area} pixels`);
    const green = placesOf(pixels, side, (r, g, b) => r < 30 && g > 200 && b < 30);
    const rim = placesOf(pixels, side, (r, g, b) => r < 130 && g > 90 && g < 170 && b < 130);
    assert.ok(green.length >= 4 && rim.length >= 6, `${green.length} and ${rim.length} pixels`);
  }
});

test("the nose of a dot points where the robot looks, y up", () => {
  const side = 60;
  for (const degrees of [0, 90, 180, -90, 45, 725]) {
    const pixels = canvasOf(side);
    new DotSprites().draw(pixels, side, side, 30.5, 30.5, 24, (degrees * Math.PI) / 180, 0x59626c, false);
    const nose = placesOf(pixels, side, (r, g, b) => r > 220 && g < 170 && b < 110);
    assert.ok(nose.length > 5, `${nose.length} pixels`);
    const seen = Math.atan2(30 - mean(nose, 1), mean(nose, 0) - 30);
    const off = Math.abs(Math.atan2(Math.sin(seen - (degrees * Math.PI) / 180), Math.cos(seen - (degrees * Math.PI) / 180)));
    assert.ok(off < 0.25, `${degrees} degrees: ${(seen * 180) / Math.PI}`);
  }
});

test("a dot at the edge writes inside of the picture only", () => {
  const side = 20;
  const whole = canvasOf(side);
  new DotSprites().draw(whole, side, side, 10, 10, 12, 1, 0xff0000, true);
  for (const [x, y] of [[0, 10], [19.9, 10], [10, 0], [10, 19.9], [-4, -4]]) {
    const pixels = canvasOf(side);
    new DotSprites().draw(pixels, side, side, x, y, 12, 1, 0xff0000, true);
    assert.equal(pixels.length, side * side);
    const [dx, dy] = [10 - Math.floor(x), 10 - Math.floor(y)];
    if (x !== Math.floor(x) || y !== Math.floor(y)) continue; // another place in its pixel looks otherwise
    for (let row = 0; row < side; row++)
      for (let column = 0; column < side; column++) {
        const [r, c] = [row + dy, column + dx];
        const expected = r < 0 || c < 0 || r >= side || c >= side ? FLOOR : whole[r * side + c];
        assert.equal(pixels[row * side + column] >>> 0, expected >>> 0, `${column}, ${row} for ${x}, ${y}`);
      }
  }
});

test("the outline of a box that is turned has its four corners", () => {
  const corners = [[1, 0], [0, 1], [-1, 0], [0, -1]];
  const found = outline([...corners, [0, 0], [0.2, 0.3], ...corners]);
  assert.deepEqual(found.map(String).sort(), corners.map(String).sort());
});

test("what lies under the pointer stays there when the plan is zoomed, and metres come back from pixels", () => {
  const camera = new PlanCamera({ addEventListener() {} }, () => {});
  camera.setArena([4, 3, 1]);
  camera.resize(800, 600, 2);
  camera.frameArena("oblique");
  const at = { x: 700, y: 80 };
  const metres = () => [camera.frame.metresX(at.x * 2), camera.frame.metresY(at.y * 2)];
  const before = metres();
  for (const steps of [3, -1.5, 0.2]) {
    const span = camera.span;
    camera.zoom(steps, at);
    assert.ok(Math.abs(camera.span / span - 1.2 ** -steps) < 1e-9);
    metres().forEach((value, k) => assert.ok(Math.abs(value - before[k]) < 1e-9));
  }
  assert.ok(Math.abs(camera.frame.metresX(camera.frame.x(1.25)) - 1.25) < 1e-12);
  assert.ok(camera.frame.y(1) < camera.frame.y(0), "y points up");
});

test("the whole arena is framed, whatever the shape of the picture", () => {
  for (const [width, height] of [[1000, 300], [300, 1000]]) {
    const camera = new PlanCamera({ addEventListener() {} }, () => {});
    camera.resize(width, height, 1);
    camera.setArena([6, 2, 1]);
    camera.frameArena("oblique");
    const { frame } = camera;
    const edges = [frame.x(0), frame.y(2), width - frame.x(6), height - frame.y(0)];
    assert.ok(edges.every((edge) => edge > 0), `${edges}`);
    assert.ok(Math.min(...edges) < 0.08 * Math.max(width, height), "and fills it");
  }
});

test("the bar of the scale is the longest round length that fits", () => {
  for (const [most, expected] of [[1.3, 1], [0.19, 0.1], [0.2, 0.2], [73, 50], [0.0051, 0.005]]) assert.equal(scaleLength(most), expected);
});

test("a trail keeps the last samples in their order", () => {
  const world = { robots: [4], slots: { 4: 0 }, tickSeconds: 0.1 };
  const record = new TrailRecord(world);
  record.on = true;
  for (let i = 0; i < 1000; i++) record.add({ time: 0.2 * i, positions: [i, 0, 0] });
  assert.equal(record.added, 1000);
  assert.equal(record.first, 1000 - record.capacity);
  for (let number = record.first; number < record.added; number++) assert.equal(record.sample(number)[0], number);
  record.add({ time: 0.05, positions: [7, 0, 0] }); // the run has begun again
  assert.equal(record.added, 1);
  assert.equal(record.sample(0)[0], 7);
});

test("no grid has more than 14 cells along a side, nor so few that it tells nothing", () => {
  for (let extent = 0.5; extent < 1000; extent *= 1.07) {
    const cells = extent / gridStep(extent);
    assert.ok(cells <= 14 && (cells > 5 || extent < 1), `${extent} m: ${cells} cells`);
  }
});

test("palette and grid are those of all renderers", { skip: !process.env.WRITE_MESHES }, () => {
  execFileSync(process.env.WRITE_MESHES, [join(folder, "meshes.json")]);
  const meshes = JSON.parse(readFileSync(join(folder, "meshes.json"), "utf8"));
  assert.deepEqual(palette, meshes.palette);
  assert.deepEqual(floorGrid, meshes.floor_grid);
});
