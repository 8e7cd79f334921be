// The trails of the plan, on a separate canvas. A new sample is drawn on top of the earlier ones, which fade a little.
// All are drawn again only if the view has moved.
import { TRAILS, css } from "../look.js";
import { jumped } from "../trail_record.js";

const LEFT_AT_THE_END = 0.12; // strength of a trail, when its sample is removed

export class TrailLayer {
  constructor() {
    this.canvas = document.createElement("canvas");
    this.context = this.canvas.getContext("2d", { willReadFrequently: true });
  }

  // Returns true if trails are visible.
  update(frame, record) {
    if (!record.on || record.added < 2) return false;
    const { canvas, context } = this;
    const key = `${frame.key} ${record.beginnings}`;
    if (key !== this.key) {
      this.key = key;
      [canvas.width, canvas.height] = [frame.width, frame.height];
      this.drawn = record.first;
    }
    for (let number = Math.max(this.drawn, record.first) + 1; number < record.added; number++) {
      context.globalCompositeOperation = "destination-out";
      context.fillStyle = `rgb(0 0 0 / ${1 - LEFT_AT_THE_END ** (1 / record.capacity)})`;
      context.fillRect(0, 0, canvas.width, canvas.height);
      context.globalCompositeOperation = "source-over";
      this.drawSample(frame, record, number);
    }
    this.drawn = record.added - 1;
    return true;
  }

  drawSample(frame, record, number) {
    const [from, to] = [record.sample(number - 1), record.sample(number)];
    const { context } = this;
    context.lineWidth = 1.4 * frame.ratio;
    for (let tint = 0; tint < TRAILS.length; tint++) {
      context.beginPath();
      for (let i = tint; i < to.length / 3; i += TRAILS.length) {
        if (jumped(from, to, i)) continue;
        context.moveTo(frame.x(from[3 * i]), frame.y(from[3 * i + 1]));
        context.lineTo(frame.x(to[3 * i]), frame.y(to[3 * i + 1]));
      }
      context.strokeStyle = css(TRAILS[tint]);
      context.stroke();
    }
  }
}
