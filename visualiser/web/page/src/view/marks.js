// Optional marks of entities beside their bodies, from the server: rays of proximity sensors, the bodies that engines
// collide, and the links of range and bearing. They are lines in metres, for either view.
import { palette } from "./look.js";
import { rotate } from "./turning.js";

const [CYLINDER, HULL] = [1, 2]; // values of the first number of a body
// The limits of requested entities, which are those nearest to the middle of the picture.
const MOST = { rays: 200, bodies: 400, links: 1000 };
const ASK_MS = 300;
const MARGIN_PX = 40; // around the picture
const ANTENNA_M = 0.1; // above the base
const RIM = 24; // pieces of a circle
const MOST_INK = 0.15; // the part of the picture that lines may cover
const FAINTEST = 0.06;
const SAMPLE = 200; // lines whose length in the picture is measured

export class Marks {
  // `send`: send(request).
  constructor(picture, send) {
    this.picture = picture;
    this.send = send;
  }

  setWorld(world) {
    this.world = world;
    this.forget();
  }

  // Forgets the marks and requests them again, for another server or another run.
  forget() {
    this.told = null;
    this.asked = JSON.stringify({ rays: [], bodies: [], links: [] });
    this.askedAt = -Infinity;
  }

  get shown() {
    const { shows } = this.picture;
    return shows.rays || shows.bodies || shows.links;
  }

  // Called for every picture of the browser.
  ask(now) {
    if (now - this.askedAt < ASK_MS || !this.picture.view?.world || !this.picture.motion.frame) return;
    this.askedAt = now;
    const wanted = this.wanted();
    const text = JSON.stringify(wanted);
    if (text === this.asked) return;
    this.asked = text;
    this.send({ do: "marks", ...wanted });
  }

  wanted() {
    const { picture, world } = this;
    const { shows } = picture;
    if (!this.shown) return { rays: [], bodies: [], links: [] };
    const { clientWidth: width, clientHeight: height } = picture.view.canvas;
    const seen = [];
    for (let entity = 0; entity < world.size; entity++) {
      const place = picture.placeOf(entity);
      const at = place && picture.view.project(...place);
      if (!at || at.x < -MARGIN_PX || at.y < -MARGIN_PX || at.x > width + MARGIN_PX || at.y > height + MARGIN_PX) continue;
      seen.push({ entity, away: Math.hypot(at.x - width / 2, at.y - height / 2) });
    }
    seen.sort((a, b) => a.away - b.away);
    // The entities are in the order of the table, so that an unchanged selection causes no new request.
    const nearest = (name, fits) =>
      shows[name] ? seen.map(({ entity }) => entity).filter(fits).slice(0, MOST[name]).sort((a, b) => a - b) : [];
    const isRobot = (entity) => world.isRobot(entity);
    return {
      rays: nearest("rays", isRobot),
      bodies: nearest("bodies", (entity) => world.look(entity).form !== "none"),
      links: nearest("links", isRobot),
    };
  }

  receive(message) {
    this.told = message;
    this.picture.invalidate();
  }

  // Returns a function from a place [x, y, z] in the frame of an entity to the space; null if the entity is not in the
  // arena.
  frameOf(entity) {
    const { picture, world } = this;
    const place = picture.placeOf(entity);
    if (!place) return null;
    const slot = world.slots[entity];
    const [quaternion, at] = slot < 0 ? [world.bodyOf.get(entity).orientation, 0] : [picture.motion.quaternions, 4 * slot];
    return (point) => rotate(point, quaternion, at).map((value, k) => value + place[k]);
  }

  // Returns [{name, colour, points, opacity}]. Six numbers of `points` are a line.
  lines(theme) {
    const { told, picture } = this;
    if (!told || !this.shown) return [];
    const { shows } = picture;
    const [free, hit, bodies, links] = [[], [], [], []];
    if (shows.rays) told.rays.entities.forEach((entity, i) => this.addRays(entity, told.rays.hits[i], free, hit));
    if (shows.rays) told.scans?.forEach((scan) => this.addScan(scan, free, hit));
    if (shows.bodies) told.shapes.entities.forEach((entity, i) => this.addBodies(entity, told.shapes.bodies[told.shapes.models[i]], bodies));
    if (shows.links) this.addLinks(told.links, links);
    return [
      { name: "rays that are free", colour: palette.ray_free, points: free },
      { name: "rays that meet something", colour: palette.ray_hit, points: hit },
      { name: "bodies", colour: palette.collision, points: bodies },
      { name: "links", colour: theme.link, points: links, opacity: this.opacityOf(links) },
    ];
  }

  // Returns the opacity of lines. The more of the picture they cover, the fainter they are.
  opacityOf(points) {
    const { view } = this.picture;
    const count = points.length / 6;
    const step = Math.max(1, Math.floor(count / SAMPLE));
    let [length, sampled] = [0, 0];
    for (let i = 0; i < count; i += step, sampled++) {
      const [ax, ay, az, bx, by, bz] = points.slice(6 * i, 6 * i + 6);
      length += Math.hypot(bx - ax, by - ay, bz - az) * view.pixelsPerMetre(ax, ay, az);
    }
    if (length === 0) return 1;
    const { clientWidth, clientHeight } = view.canvas;
    const ink = ((length / sampled) * count) / (clientWidth * clientHeight);
    return Math.min(1, Math.max(FAINTEST, MOST_INK / ink));
  }

  addRays(entity, hits, free, hit) {
    const at = this.frameOf(entity);
    const { height, range, sensors } = this.world.look(entity).proximity;
    if (!at) return;
    sensors.forEach(([x, y, direction], i) => {
      const reach = range * hits[i];
      const list = hits[i] < 1 ? hit : free;
      list.push(...at([x, y, height]), ...at([x + reach * Math.cos(direction), y + reach * Math.sin(direction), height]));
    });
  }

  // The beams of a range scanner: the ends of those that are free and of those that meet something, in the frame of the robot.
  addScan({ entity, from, free: ends, hit: hits }, free, hit) {
    const at = this.frameOf(entity);
    if (!at) return;
    for (const [places, list] of [[ends, free], [hits, hit]])
      for (let i = 0; i < places.length; i += 3) list.push(...at(from), ...at(places.slice(i, i + 3)));
  }

  addBodies(entity, model, list) {
    const frame = this.frameOf(entity);
    if (!frame) return;
    for (const [form, ...numbers] of model) {
      if (form === HULL) {
        for (let i = 0; i < numbers.length; i += 3) list.push(...frame(numbers.slice(i, i + 3)));
        continue;
      }
      const [px, py, pz, qx, qy, qz, qw, hx, hy, hz] = numbers;
      const at = (x, y, z) => frame(rotate([x * hx, y * hy, z * hz], [qx, qy, qz, qw]).map((value, k) => value + [px, py, pz][k]));
      if (form === CYLINDER) addCylinder(list, at);
      else addBox(list, at);
    }
  }

  // Adds a whole line if both robots hear each other; else the half at the robot that is heard.
  addLinks({ both, one }, list) {
    const antenna = (entity) => this.frameOf(entity)?.([0, 0, ANTENNA_M]);
    const add = (from, to, part) => {
      const [a, b] = [antenna(from), antenna(to)];
      if (a && b) list.push(...a, ...a.map((value, k) => value + part * (b[k] - value)));
    };
    for (let i = 0; i < both.length; i += 2) add(both[i], both[i + 1], 1);
    for (let i = 0; i < one.length; i += 2) add(one[i], one[i + 1], 0.5);
  }
}

function addBox(list, at) {
  for (const a of [-1, 1])
    for (const b of [-1, 1]) {
      list.push(...at(-1, a, b), ...at(1, a, b));
      list.push(...at(a, -1, b), ...at(a, 1, b));
      list.push(...at(a, b, -1), ...at(a, b, 1));
    }
}

function addCylinder(list, at) {
  const rim = (i, z) => at(Math.cos((2 * Math.PI * i) / RIM), Math.sin((2 * Math.PI * i) / RIM), z);
  for (let i = 0; i < RIM; i++) {
    for (const z of [-1, 1]) list.push(...rim(i, z), ...rim(i + 1, z));
    if (i % 6 === 0) list.push(...rim(i, -1), ...rim(i, 1));
  }
}
