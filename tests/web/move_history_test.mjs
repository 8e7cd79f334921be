// Moves of a run that the page undoes.
import assert from "node:assert/strict";
import { test } from "node:test";
import { anglesOf, MoveHistory, poseIn } from "../../visualiser/web/page/src/move_history.js";

const move = (entity, x, y) => ({ do: "move", entity, position: [x, y, 0], angles: [0, 0, 0] });
const part = (id, from, to) => ({ id, back: move(id, ...from), again: move(id, ...to) });

function history() {
  const sent = [];
  const told = [];
  let may = null;
  const moves = new MoveHistory({ command: (request) => sent.push(request), tell: (text) => told.push(text), changed: (can) => (may = can) });
  return { moves, sent, told, may: () => may };
}

test("without a move there is nothing to undo", () => {
  const { moves, sent, told, may } = history();
  assert.equal(may(), false);
  moves.undo();
  moves.redo();
  assert.deepEqual(sent, []);
  assert.equal(told.length, 2);
});

test("a move is undone and done again, the last one first", () => {
  const { moves, sent, may } = history();
  moves.add([part("a", [0, 0], [1, 0])]);
  moves.add([part("a", [1, 0], [2, 0]), part("b", [3, 0], [4, 0])]);
  assert.equal(may(), true);
  moves.undo();
  assert.deepEqual(sent.splice(0), [move("b", 3, 0), move("a", 1, 0)]);
  moves.undo();
  assert.deepEqual(sent.splice(0), [move("a", 0, 0)]);
  assert.equal(may(), false);
  moves.redo();
  assert.deepEqual(sent.splice(0), [move("a", 1, 0)]);
  moves.add([part("c", [5, 5], [6, 6])]);
  moves.redo();
  assert.deepEqual(sent, []); // a new move ends what could be done again
});

test("what the run refuses is no step", () => {
  const { moves, sent, may } = history();
  moves.add([part("a", [0, 0], [1, 0]), part("b", [3, 0], [4, 0])]);
  moves.answer("moved 'b' at tick 7");
  moves.answer("move: 'a' does not fit at 1, 0, 0: the footbot 'b' stands there, at 1, 0, 0; choose a free place");
  moves.undo();
  assert.deepEqual(sent.splice(0), [move("b", 3, 0)]);
  moves.clear();
  moves.add([part("a", [0, 0], [9, 0])]);
  moves.answer("move: 9, 0, 0 is outside the arena, which reaches from 0, 0, 0 to 3, 3, 1");
  assert.equal(may(), false);
  moves.add([part("a", [0, 0], [1, 0])]);
  moves.answer("the run waits for it"); // no answer to a move
  assert.equal(may(), true);
});

test("angles are those of the experiment file: about x, y and z, in degrees", () => {
  const half = Math.SQRT1_2;
  const close = (found, wanted) => found.forEach((angle, i) => assert.ok(Math.abs(angle - wanted[i]) < 1e-9, `${found} is not ${wanted}`));
  close(anglesOf([0, 0, 0, 1]), [0, 0, 0]);
  close(anglesOf([0, 0, half, half]), [0, 0, 90]);
  close(anglesOf([half, 0, 0, half]), [90, 0, 0]);
  close(anglesOf([0, half, 0, half]), [0, 90, 0]);
  // 20 about z, then 30 about y, then 40 about x: the product of three quaternions.
  const product = ([ax, ay, az, aw], [bx, by, bz, bw]) => [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz];
  const about = (axis, degrees) => [0, 1, 2].map((i) => (i === axis ? Math.sin((degrees * Math.PI) / 360) : 0)).concat(Math.cos((degrees * Math.PI) / 360));
  close(anglesOf(product(product(about(2, 20), about(1, 30)), about(0, 40))), [40, 30, 20]);
});

test("the pose of an entity is read from a frame", () => {
  const frame = { positions: new Float32Array([1, 2, 3, 4, 5, 6]), quaternions: new Int16Array([0, 0, 0, 32767, 0, 0, 32767, 0]) };
  const { position, angles } = poseIn(frame, 1);
  assert.deepEqual(position, [4, 5, 6]);
  assert.ok(Math.abs(Math.abs(angles[2]) - 180) < 1e-9);
});
