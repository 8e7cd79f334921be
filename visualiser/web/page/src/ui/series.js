// A value over simulated time, for the whole run. With too many points, the older half is thinned out.

export const MOST_POINTS = 20000;

export class Series {
  // `name`: for the legend and the table.
  constructor(name) {
    this.name = name;
    this.clear();
  }

  clear() {
    this.times = [];
    this.values = [];
    this.spreads = []; // for a mean: the standard deviation; else empty
  }

  // Keeps the points while the series has those of the past.
  keep() {
    const { times, values, spreads } = this;
    this.kept = { times, values, spreads };
    this.clear();
  }

  restore() {
    this.clear();
    Object.assign(this, this.kept);
    this.kept = null;
  }

  // `spread`: the standard deviation of a mean. An infinite value, NaN or null makes a gap.
  add(time, value, spread) {
    const last = this.times.at(-1);
    if (last !== undefined && time < last) this.clear(); // another run
    if (time === this.times.at(-1) || !Number.isFinite(value)) return false;
    this.times.push(time);
    this.values.push(value);
    if (spread !== undefined) this.spreads.push(spread);
    if (this.times.length > MOST_POINTS) this.thin();
    return true;
  }

  thin() {
    const half = Math.floor(this.times.length / 2);
    const keeps = (_, i) => i >= half || i % 2 === 0;
    for (const list of ["times", "values", "spreads"]) this[list] = this[list].filter(keeps);
  }

  // Returns the first point at or after a time.
  from(time) {
    let [low, high] = [0, this.times.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[middle] < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  // Returns the point nearest to a time; -1 without points.
  nearest(time) {
    const next = this.from(time);
    if (next === this.times.length || (next > 0 && time - this.times[next - 1] < this.times[next] - time)) return next - 1;
    return next;
  }
}

const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

// Returns all points of several series as a table: a line for each time, with an empty field if a series has no value.
export function toCsv(series, unit) {
  const columns = series.flatMap(({ name, spreads }) => [name, ...(spreads.length > 0 ? [`${name}, standard deviation`] : [])]);
  const lines = [["time (s)", ...columns.map((name) => (unit ? `${name} (${unit})` : name))].map(quoted).join(",")];
  const times = [...new Set(series.flatMap((each) => each.times))].sort((a, b) => a - b);
  const places = series.map(() => 0);
  for (const time of times) {
    const fields = series.flatMap((each, i) => {
      const here = each.times[places[i]] === time;
      const found = here ? [each.values[places[i]], ...(each.spreads.length > 0 ? [each.spreads[places[i]]] : [])] : ["", ...(each.spreads.length > 0 ? [""] : [])];
      if (here) places[i]++;
      return found;
    });
    lines.push([time, ...fields].join(","));
  }
  return `${lines.join("\n")}\n`;
}
