// Viewpoints 0 to 9, as an experiment file gives them: a position (m), heading, pitch and roll (degrees). Heading 0
// looks along x, 90 along y; a negative pitch looks down. The file also has the flight from one to the next.
export const FIELD_OF_VIEW = 45; // degrees, from top to bottom
const SPAN = 2 * Math.tan((FIELD_OF_VIEW * Math.PI) / 360); // m from top to bottom, for each metre of distance
const LEAST_M = 0.3; // from the eye to the target
const FLIGHT_MS = 3000; // from one viewpoint to the next

const radians = (degrees) => (degrees * Math.PI) / 180;
const degrees = (angle) => (angle * 180) / Math.PI;

export function forwardOf({ heading, pitch }) {
  const [h, p] = [radians(heading), radians(pitch)];
  return [Math.cos(p) * Math.cos(h), Math.cos(p) * Math.sin(h), Math.sin(p)];
}

// Returns the target of such a camera, the shown size and the direction. The target is the point of the floor in the
// middle of the picture, or a point half an arena ahead. `extent`: the longer side of the arena, m.
export function viewOf(camera, extent) {
  const forward = forwardOf(camera);
  const down = forward[2] < -0.02 ? camera.position[2] / -forward[2] : extent / 2;
  const distance = Math.max(LEAST_M, Math.min(down, 1.5 * extent));
  return {
    target: camera.position.map((value, k) => value + distance * forward[k]),
    span: SPAN * distance,
    direction: forward.map((value) => -value),
  };
}

// Returns the camera of a view. A plan looks from above, with north up.
export function cameraOf({ target, span, direction }) {
  const away = direction ?? [0, 0, 1];
  const position = target.map((value, k) => value + (span / SPAN) * away[k]);
  const flat = Math.hypot(away[0], away[1]);
  return { position, heading: flat < 1e-3 ? 90 : degrees(Math.atan2(-away[1], -away[0])), pitch: degrees(Math.atan2(-away[2], flat)), roll: 0 };
}

const digits = (value) => String(Number(value.toFixed(5)) + 0); // avoids -0

// Returns the two elements that give it again in an experiment file.
export function viewpointXml(number, { position, heading, pitch, roll }) {
  const element = (name, values) => `<${name}_${number}>${values.map(digits).join(", ")}</${name}_${number}>`;
  return `${element("camera_view_XYZ", position)}\n${element("camera_view_HPR", [heading, pitch, roll])}`;
}

// A flight through several views, one after another: a smooth curve (Catmull-Rom) of the eye and of its target.
export class Flight {
  constructor(views, start) {
    this.start = start;
    this.stops = views.map(({ target, span, direction }) => ({
      target,
      eye: target.map((value, k) => value + (span / SPAN) * (direction ?? [0, 0, 1])[k]),
    }));
  }

  isOver(now) {
    return now - this.start >= FLIGHT_MS * (this.stops.length - 1);
  }

  // Returns the view at a moment (ms): the last one once the flight is over.
  at(now) {
    const last = this.stops.length - 1;
    const way = Math.min((now - this.start) / FLIGHT_MS, last);
    const leg = Math.min(Math.floor(way), last - 1);
    const t = way - leg;
    const stop = (i) => this.stops[Math.max(0, Math.min(i, last))];
    const curve = (name) =>
      [0, 1, 2].map((k) => {
        const [a, b, c, d] = [-1, 0, 1, 2].map((i) => stop(leg + i)[name][k]);
        return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
      });
    const [target, eye] = [curve("target"), curve("eye")];
    const away = eye.map((value, k) => value - target[k]);
    const distance = Math.max(Math.hypot(...away), 1e-6);
    return { target, span: SPAN * distance, direction: away.map((value) => value / distance) };
  }
}
