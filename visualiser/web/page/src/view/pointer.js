// The actions of the pointer in any view. A click selects, a double click moves the camera there, and shift with a drag
// moves a robot or selects by a box. Everything else moves the camera.
import { pickStatic } from "./pick_static.js";

const CLICK_PIXELS = 4;
const TURN_A_PIXEL = 0.005; // radians that the view from a robot turns
const TURN_A_STEP = Math.PI / 24; // angle that a dragged entity turns for 100 pixels of the wheel

// Drags entities over the floor, together with the other selected ones.
class Carry {
  constructor(picture, view, entity, at) {
    const [x, y, z] = picture.placeOf(entity);
    this.picture = picture;
    this.view = view;
    this.entity = entity;
    this.height = z;
    this.at = at;
    this.turned = false;
    this.start = view.floorPoint(at, z) ?? [x, y, z];
    const others = picture.chosen.includes(entity) ? picture.chosen : [entity];
    this.carried = others.flatMap((each) => {
      const place = picture.canMove(each) && picture.placeOf(each);
      return place ? [{ entity: each, place: [...place], yaw: picture.yawOf(each) }] : [];
    });
  }
  move(at) {
    this.at = at;
    const point = this.view.floorPoint(at, this.height);
    if (!point) return;
    const [dx, dy] = [point[0] - this.start[0], point[1] - this.start[1]];
    this.picture.ghosts = this.carried.map(({ entity, place: [x, y, z], yaw }) => ({ entity, place: [x + dx, y + dy, z], yaw }));
  }
  // Turns each entity about itself by the wheel.
  turn(angle) {
    for (const each of this.carried) each.yaw += angle;
    this.turned = true;
    this.move(this.at);
  }
  end(clicked) {
    const { ghosts, actions, chosen } = this.picture;
    this.picture.ghosts = [];
    if ((!clicked || this.turned) && ghosts.length > 0) actions.move(ghosts);
    // The selection comes last, since the panel that opens moves the picture.
    if (!chosen.includes(this.entity)) actions.select(this.entity);
  }
}

// Turns the selected entity by the end of its arrow.
class Turn {
  constructor(picture, view) {
    this.picture = picture;
    this.view = view;
    this.entity = picture.selected;
    this.place = [...picture.placeOf(this.entity)];
  }
  move(at) {
    const point = this.view.floorPoint(at, this.place[2]);
    if (!point) return;
    const yaw = Math.atan2(point[1] - this.place[1], point[0] - this.place[0]);
    this.picture.ghosts = [{ entity: this.entity, place: this.place, yaw }];
  }
  end(clicked) {
    const { ghosts, actions } = this.picture;
    this.picture.ghosts = [];
    if (!clicked && ghosts.length > 0) actions.move(ghosts);
  }
}

// Turns the view from the robot that carries the camera.
class Gaze {
  constructor(picture, at) {
    this.picture = picture;
    this.last = at;
    this.isCamera = true; // a click still selects
  }
  move(at) {
    this.picture.turnGaze((at.x - this.last.x) * TURN_A_PIXEL, (at.y - this.last.y) * TURN_A_PIXEL);
    this.last = at;
  }
  end() {}
}

class Box {
  constructor(picture, at) {
    this.picture = picture;
    this.from = at;
  }
  move(at) {
    const { from } = this;
    this.picture.box = { left: Math.min(from.x, at.x), top: Math.min(from.y, at.y), right: Math.max(from.x, at.x), bottom: Math.max(from.y, at.y) };
  }
  end(clicked) {
    const { picture } = this;
    const { box } = picture;
    picture.box = null;
    if (clicked || !box) return picture.actions.select(null);
    picture.actions.selectAll(
      picture.world.robots.filter((entity) => {
        const at = picture.seen(entity);
        return at && at.x >= box.left && at.x <= box.right && at.y >= box.top && at.y <= box.bottom;
      }),
    );
  }
}

// Measures a length along the floor.
class Tape {
  constructor(picture, view, at) {
    this.picture = picture;
    this.view = view;
    this.from = view.floorPoint(at, 0);
  }
  move(at) {
    const to = this.view.floorPoint(at, 0);
    if (this.from && to) this.picture.tape = { from: this.from, to };
  }
  end(clicked) {
    if (clicked) this.picture.tape = null;
  }
}

// In the editor, walls, patches and lights can be selected, too, unless a robot or prey is there.
function pickAt(picture, view, at) {
  const entity = view.pick(at);
  if (entity !== null || !picture.edits) return entity;
  const { origin, direction } = view.sight(at);
  return pickStatic(picture.world, origin, direction);
}

function dragFor(picture, view, event, at) {
  if (picture.measures) return new Tape(picture, view, at);
  const mayMove = picture.actions.mayMove();
  const handle = mayMove ? picture.overlay.handleAt(at) : null;
  if (handle === "turn") return new Turn(picture, view);
  if (handle === "move") return new Carry(picture, view, picture.selected, at);
  if (picture.aboard !== null && !event.shiftKey) return new Gaze(picture, at);
  if (!event.shiftKey) return null;
  const entity = pickAt(picture, view, at);
  if (entity !== null && picture.placeOf(entity)) return mayMove ? new Carry(picture, view, entity, at) : null;
  return new Box(picture, at);
}

// Returns the point of the ground under the pointer; null if there is none.
function groundPoint(view, at, world) {
  let point = view.floorPoint(at, 0);
  // On a slope each step comes nearer to the point that is seen.
  for (let steps = 0; point && steps < 4; steps++) {
    const height = world.groundAt(point[0], point[1]);
    if (height === 0) break;
    const [x, y] = view.floorPoint(at, height) ?? point;
    point = [x, y, height];
  }
  return point;
}

export function listenToPointer(view, picture) {
  const { canvas } = view;
  let start = null;
  let drag = null;
  const placeOf = (event) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const pick = (event) => (picture.world && picture.motion.frame ? pickAt(picture, view, placeOf(event)) : null);
  canvas.addEventListener(
    "pointerdown",
    (event) => {
      if (!event.isPrimary) {
        start = null; // two fingers are no click
        return;
      }
      picture.flight = null;
      start = event.button === 0 ? placeOf(event) : null;
      if (!start || !picture.world || !picture.motion.frame) return;
      drag = dragFor(picture, view, event, start);
      if (!drag) return;
      view.holdCamera(true);
      canvas.setPointerCapture(event.pointerId);
    },
    true,
  );
  canvas.addEventListener("pointermove", (event) => {
    if (!drag || !event.isPrimary) return;
    drag.move(placeOf(event));
    picture.invalidate();
  });
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (!drag?.turn) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      drag.turn((-Math.sign(event.deltaY) * TURN_A_STEP * Math.min(Math.abs(event.deltaY), 100)) / 100);
      picture.invalidate();
    },
    { capture: true, passive: false },
  );
  const end = (event, cancelled) => {
    if (!event.isPrimary) return;
    const at = placeOf(event);
    const clicked = start !== null && Math.hypot(at.x - start.x, at.y - start.y) < CLICK_PIXELS;
    if (drag) {
      view.holdCamera(false);
      drag.end(clicked || cancelled);
      picture.invalidate();
    }
    const placed = clicked && !cancelled && !drag && picture.world && picture.actions.place(groundPoint(view, at, picture.world));
    if (clicked && !cancelled && !placed && (!drag || drag.isCamera)) picture.actions.select(pick(event), event.ctrlKey);
    start = drag = null;
  };
  canvas.addEventListener("pointerup", (event) => end(event, false));
  canvas.addEventListener("pointercancel", (event) => end(event, true));
  canvas.addEventListener("dblclick", (event) => {
    const entity = pick(event);
    if (entity !== null) picture.actions.approach(entity);
  });
}
