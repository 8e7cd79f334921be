// The interface of the page for tests and for the browser's console: window.swarmanoid.
import { cameraOf } from "./view/viewpoints.js";

function inPage(picture, { x, y }) {
  const box = picture.view.canvas.getBoundingClientRect();
  return { x: box.left + x, y: box.top + y };
}

// Returns an object with the parts of the page and its actions.
export function pageHook({ state, moves, palette, past, timeline, viewpoints, list, picture, inspector, select, toggle, approach, colourBy, send }) {
  return {
    get past() {
      return past.isOn ? { tick: past.wanted, shown: state.frame?.tick, playing: past.isPlaying } : null;
    },
    get timeline() {
      return timeline.element.hidden ? null : { first: timeline.first, last: timeline.last, events: timeline.events.map(({ tick, what }) => [tick, what]) };
    },
    // Returns the shown plots: of each value its points, and the times of the first and last one.
    get plots() {
      const series = [...inspector.plots].flatMap((plot) => [...plot.series.values()].map((each) => ({ ...each, part: plot.part })));
      return series.map(({ name, times, values, part }) => ({ name, points: times.length, first: times[0] ?? null, last: times.at(-1) ?? null, value: values.at(-1) ?? null, part }));
    },
    // Returns the trail of a robot, as places [x, y].
    trail: (id) => {
      const { trails } = picture;
      const robot = state.world.robots.indexOf(state.world.find(id));
      return Array.from({ length: trails.added - trails.first }, (_, i) => [...trails.sample(trails.first + i).subarray(3 * robot, 3 * robot + 2)]);
    },
    get branch() {
      return state.branch ?? null;
    },
    get inspect() {
      return state.inspect ?? null;
    },
    lookBack: (tick) => past.look(tick),
    goLive: () => past.live(),
    get editor() {
      const { editor } = state;
      return editor && { ...editor.document, shown: editor.path, form: editor.form.form, said: editor.form.said.textContent, busy: editor.isBusy || editor.waiting.length > 0 };
    },
    // Returns the numbers of moves that can be undone and done again, and of those without an answer.
    get moves() {
      const waiting = (steps) => steps.reduce((sum, { waits }) => sum + waits.size, 0);
      return { done: moves.done.length, undone: moves.undone.length, waiting: waiting(moves.done) + waiting(moves.undone) };
    },
    get adding() {
      return palette.element.hidden ? null : { chosen: palette.chosen, options: [...palette.choice.options].map(({ text }) => text), said: palette.hint.textContent };
    },
    get run() {
      return { phase: state.runPhase, failure: state.failure };
    },
    get connected() {
      return state.connected;
    },
    get control() {
      return state.control;
    },
    get phase() {
      return state.status?.phase ?? null;
    },
    get experiment() {
      return state.world?.experiment ?? null;
    },
    get robots() {
      return state.world?.robots.length ?? 0;
    },
    get tick() {
      return state.frame?.tick ?? null;
    },
    get time() {
      return state.frame?.time ?? null;
    },
    get frames() {
      return state.frames;
    },
    get drawn() {
      return state.drawn;
    },
    // Returns the milliseconds from the request of the page.
    get firstPicture() {
      return state.firstPicture ?? null;
    },
    get quality() {
      return picture.qualityName;
    },
    get view() {
      return picture.view === null ? null : picture.isPlan ? "plan" : "3D";
    },
    get aboard() {
      return picture.aboard === null ? null : state.world.ids[picture.aboard];
    },
    get standing() {
      return cameraOf(picture.view.viewpoint);
    },
    get flying() {
      return picture.flight !== null;
    },
    get viewpoints() {
      return viewpoints.cameras;
    },
    // Returns the number of drawn lines of each kind of mark.
    get marks() {
      return Object.fromEntries(picture.marks.lines({ link: 0 }).map(({ name, points }) => [name, points.length / 6]));
    },
    // Returns the shown drawings of experiment functions.
    get drawing() {
      const drawing = picture.shownDrawing;
      const count = (groups, numbers) => groups.reduce((sum, { points }) => sum + points.length / numbers, 0);
      return drawing && { tick: drawing.tick, lines: count(drawing.lines, 6), triangles: count(drawing.triangles, 9), dots: count(drawing.dots, 3), texts: drawing.texts.map(({ text }) => text) };
    },
    get selected() {
      return state.selected === null ? null : state.world.ids[state.selected];
    },
    get chosen() {
      return picture.chosen.map((entity) => state.world.ids[entity]);
    },
    get status() {
      return state.status;
    },
    get followed() {
      return picture.followed === null ? null : state.world.ids[picture.followed];
    },
    get camera() {
      return picture.view.eye;
    },
    get viewpoint() {
      return picture.view.viewpoint;
    },
    get shown() {
      return list.shown.length;
    },
    instances: () => picture.view.details,
    select: (id) => select(state.world.find(id)),
    show: (name, on) => picture.shows[name] !== on && toggle(name),
    approach: (id) => approach(state.world.find(id)),
    place: (id) => Array.from(picture.placeOf(state.world.find(id)) ?? []),
    heading: (id) => (picture.yawOf(state.world.find(id)) * 180) / Math.PI,
    get colouring() {
      return picture.colouring && { name: picture.colouring.name, low: picture.colouring.low, high: picture.colouring.high };
    },
    get heat() {
      return picture.heat && { columns: picture.heat.columns, rows: picture.heat.rows, seconds: Array.from(picture.heat.seconds), drawn: Boolean(picture.heat.canvas) };
    },
    get heatLegend() {
      return document.querySelector(".legends").textContent;
    },
    get link() {
      return state.link ?? null;
    },
    colourBy,
    get measured() {
      if (!picture.tape) return null;
      const [dx, dy] = [0, 1].map((k) => picture.tape.to[k] - picture.tape.from[k]);
      return { metres: Math.hypot(dx, dy), degrees: (Math.atan2(dy, dx) * 180) / Math.PI };
    },
    get handles() {
      const { handles } = picture.overlay;
      return handles && { move: inPage(picture, handles.move), turn: inPage(picture, handles.turn) };
    },
    project: (id) => inPage(picture, picture.seen(state.world.find(id))),
    projectPoint: (x, y, z) => inPage(picture, picture.view.project(x, y, z)),
    command: send,
  };
}
