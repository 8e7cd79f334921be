// Limits the cost of a picture in three dimensions: the quality follows the frame rate. Without a graphics card the
// page begins with the plan (picture.js).

// Best first. `ratio`: the most drawn pixels for a pixel of the page. `lit`: with gloss. `finest`: the first level of
// detail of robots that is drawn. `coarser`: how much wider than usual a robot must be for its level. `plain`: a floor
// of one colour, and no soft shadows.
export const qualities = {
  high: { ratio: 2, lit: true, shadows: true, finest: 0, coarser: 1, plain: false },
  medium: { ratio: 1, lit: false, shadows: false, finest: 0, coarser: 1, plain: false },
  low: { ratio: 1, lit: false, shadows: false, finest: 1, coarser: 1.5, plain: true },
  least: { ratio: 0.5, lit: false, shadows: false, finest: 2, coarser: 4, plain: true },
};
const names = Object.keys(qualities);

// The choices: plan or three dimensions, depending on this machine; the plan; three dimensions with a quality that
// follows the frame rate; one quality.
export const choices = ["auto", "plan", "3D", ...names];
export const isPaced = (wanted) => wanted === "auto" || wanted === "3D";

const SLOW_MS = 45; // 22 pictures a second
const QUICK_MS = 18;
const FALL_AFTER_MS = 1200;
const RISE_AFTER_MS = 6000;
const FIRST_REST_MS = 30000; // before a quality that was too slow is tried again; doubled each time

// Chooses a quality by the time between consecutive pictures.
export class Governor {
  constructor(quality) {
    this.quality = quality;
    this.barred = new Map(); // by quality: when it may be tried again
    this.rest = FIRST_REST_MS;
    this.begin();
  }

  begin() {
    this.times = []; // times of the last pictures, as many as fill FALL_AFTER_MS
    this.sum = 0;
    this.last = null;
    this.quickSince = null;
  }

  // `drew`: whether there was a picture now. Returns true if the quality has changed.
  observe(now, drew) {
    const took = drew && this.last !== null ? now - this.last : null;
    this.last = drew ? now : null;
    if (took === null) return false;
    this.times.push(took);
    this.sum += took;
    while (this.times.length > 2 && this.sum - this.times[0] >= FALL_AFTER_MS) this.sum -= this.times.shift();
    if (this.sum < FALL_AFTER_MS || this.times.length < 2) return false;

    const typical = [...this.times].sort((a, b) => a - b)[(this.times.length - 1) >> 1];
    this.quickSince = typical < QUICK_MS ? this.quickSince ?? now : null;
    const place = names.indexOf(this.quality);
    if (typical > SLOW_MS && place + 1 < names.length) {
      this.barred.set(this.quality, now + this.rest);
      this.rest *= 2;
      this.quality = names[place + 1];
    } else if (this.quickSince !== null && now - this.quickSince > RISE_AFTER_MS && place > 0 && now > (this.barred.get(names[place - 1]) ?? 0))
      this.quality = names[place - 1];
    else return false;
    this.begin();
    return true;
  }
}
