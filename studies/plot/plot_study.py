#!/usr/bin/env python3
"""Pictures and a report of a study, from its study.sqlite: what `swarmanoid plot` runs. Needs python3-matplotlib and python3-scipy."""
import argparse
import html
import io
import itertools
import json
import math
import pathlib
import sqlite3
import sys
import time
import warnings
from functools import partial

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import plot_search
from study_style import COLOURS, HEAT, MARKS, MOST_LINES, SIZE, mean_and_band
from study_text import as_html, as_latex, as_markdown, number, probability, with_error


class StudyError(Exception):
    """What a user did wrong, with the cure."""


class Study:
    """The tables of one study."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        path = self.folder / "study.sqlite"
        if not path.is_file():
            raise StudyError(f"'{folder}' is no folder of a study: it has no study.sqlite")
        self.database = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
        self.facts = dict(self.database.execute("SELECT name, value FROM study"))
        self.factors = [(name, kind == "REAL") for name, kind in self.results_between("point", "seed")]
        self.metrics = [name for name, _ in self.results_between("time_s", "exit")]
        self.units = json.loads(self.facts.get("units", "{}"))  # studies of version 1.0 do not have them
        self.states = dict(self.database.execute("SELECT state, COUNT(*) FROM runs GROUP BY state"))
        self.levels = {name: [row[0] for row in self.database.execute(f'SELECT "{name}" FROM runs GROUP BY "{name}" ORDER BY MIN(point)')]
                       for name, _ in self.factors}
        # Use the last row of each run.
        self.last = self.rows("SELECT r.* FROM results r JOIN (SELECT point, seed, MAX(tick) AS tick FROM results GROUP BY point, seed) l "
                              "ON r.point = l.point AND r.seed = l.seed AND r.tick = l.tick ORDER BY r.point, r.seed")
        # Without 'every' each run has only one row, at its end, so there is no course over time.
        self.has_time = any(self.database.execute("SELECT 1 FROM samples GROUP BY point, seed HAVING COUNT(*) > 2 LIMIT 1"))

    def results_between(self, first, last):
        """Name and type of the columns of the view `results` that stand between two of its own."""
        columns = [(row[1], row[2]) for row in self.database.execute("PRAGMA table_info(results)")]
        names = [name for name, _ in columns]
        return columns[names.index(first) + 1:names.index(last)]

    def rows(self, query, values=()):
        cursor = self.database.execute(query, values)
        names = [column[0] for column in cursor.description]
        return [dict(zip(names, row)) for row in cursor]

    def label(self, name):
        """A factor or metric with its unit."""
        return f"{name} ({self.units[name]})" if self.units.get(name) else name

    def varied(self):
        """Factors with more than one value, numbers first."""
        found = [(name, numeric) for name, numeric in self.factors if len(self.levels[name]) > 1]
        return sorted(found, key=lambda factor: not factor[1])


def shown(value):
    return number(value, 6) if isinstance(value, float) else str(value)


def grouped(rows, keys, value):
    """{(values of the keys): [numbers]}, without rows that have none."""
    groups = {}
    for row in rows:
        if row[value] is not None:
            groups.setdefault(tuple(row[key] for key in keys), []).append(row[value])
    return groups


def line(axes, number, xs, values, label):
    """A mean with its band. values: a list of numbers for each x."""
    means, halves = np.array([mean_and_band(v) for v in values]).T
    colour = COLOURS[number % len(COLOURS)]
    axes.plot(xs, means, color=colour, marker=MARKS[number % len(MARKS)], markersize=4, markevery=max(1, len(xs) // 12), label=label)
    axes.fill_between(xs, means - halves, means + halves, color=colour, alpha=0.2, linewidth=0)


def legend(axes, title=None):
    if axes.get_legend_handles_labels()[0]:
        axes.legend(frameon=False, title=title, fontsize=9)


def over_factor(study, metric, factor, by=None):
    """Means over a numeric factor, a line for each value of another one."""
    figure, axes = plt.subplots(figsize=SIZE)
    groups = grouped(study.last, [factor] + ([by] if by else []), metric)
    for number, level in enumerate(study.levels[by] if by else [None]):
        xs = [x for x in sorted(study.levels[factor]) if ((x, level) if by else (x,)) in groups]
        if xs:
            line(axes, number, xs, [groups[(x, level) if by else (x,)] for x in xs], f"{shown(level)}" if by else None)
    axes.set_xlabel(study.label(factor))
    axes.set_ylabel(study.label(metric))
    legend(axes, by and study.label(by))
    return figure, f"{metric} at the end of the runs over {factor}" + (f", by {by}" if by else "") + ": means, and confidence intervals of 95 %."


def courses(rows):
    """{(point, seed): {time: value}} of rows, in the order of time."""
    runs = {}
    for row in rows:
        runs.setdefault((row["point"], row["seed"]), {})[row["time_s"]] = row["value"]
    return runs


def sample_period(runs):
    """The longest time between the first two rows of a run. The last row of a run may come earlier."""
    return max((times[1] - times[0] for times in map(sorted, runs.values()) if len(times) > 1), default=0)


def values_over_time(runs, ended):
    """Times, and for each the values that its mean is of. runs: {name: {time: value or None}}. Each time is the end of a bin of one sample
    period, so that runs with other periods, and last rows between two others, fall into bins. ended: what happens to runs that have ended,
    as --ended says."""
    period = sample_period(runs) or 1.0
    bins = {name: {math.ceil(time / period - 1e-6): course[time] for time in sorted(course)} for name, course in runs.items()}
    ends = {name: max(course) for name, course in runs.items()}
    first_end = math.floor(min(ends.values(), default=0) / period + 1e-6)
    times, values = [], []
    for number_of_bin in sorted({number_of_bin for course in bins.values() for number_of_bin in course}):
        if ended == "stop" and number_of_bin > first_end:
            break
        found = [course[min(number_of_bin, max(course))] for course in bins.values() if min(number_of_bin, max(course)) in course]
        found = [value for value in found if value is not None]
        if found:
            times.append(number_of_bin * period)
            values.append(found)
    return times, values


ENDED = {
    "stop": "A line stops where the first of its runs ends",
    "hold": "Runs that have ended keep their last value",
}


def over_time(study, metric, by, ended="stop"):
    """Means over time, a line for each value of a factor, and below them how many runs go on."""
    levels = study.levels[by] if by else [None]
    if len(levels) > MOST_LINES:
        levels = [levels[i] for i in np.unique(np.linspace(0, len(levels) - 1, MOST_LINES).round().astype(int))]
    figure, (axes, below) = plt.subplots(2, 1, sharex=True, figsize=(SIZE[0], SIZE[1] * 1.25), height_ratios=[4, 1])
    for position, level in enumerate(levels):
        where = f'WHERE "{by}" = ?' if by else ""
        runs = courses(study.rows(f'SELECT point, seed, time_s, "{metric}" AS value FROM results {where}', (level,) if by else ()))
        times, values = values_over_time(runs, ended)
        if not times:
            continue
        line(axes, position, times, values, shown(level) if by else None)
        ends = sorted(max(course) for course in runs.values())
        # Also beyond the end of the line, so that one sees how many runs a stopped line leaves out.
        steps = sorted({0.0, *times, *ends})
        alive = [len(ends) - int(np.searchsorted(ends, time - 1e-9, side="left")) for time in steps]
        below.step([*steps, steps[-1]], [*alive, 0], where="post", color=COLOURS[position % len(COLOURS)], linestyle=("-", "--", "-.", ":")[position % 4])
    axes.set_ylabel(study.label(metric))
    below.set_ylabel("runs")
    below.set_ylim(bottom=0)
    below.yaxis.get_major_locator().set_params(integer=True, nbins=4)
    below.set_xlabel("time (s)")
    legend(axes, by and study.label(by))
    return figure, f"{metric} over time" + (f", by {by}" if by else "") + f": means, and confidence intervals of 95 %. {ENDED[ended]}; below: how many runs go on."


def boxes(study, metric, factor):
    figure, axes = plt.subplots(figsize=SIZE)
    groups = grouped(study.last, [factor], metric)
    levels = [level for level in study.levels[factor] if (level,) in groups]
    axes.boxplot([groups[(level,)] for level in levels], labels=[shown(level) for level in levels], patch_artist=True, widths=0.6,
                 boxprops={"facecolor": "#56b4e9", "alpha": 0.6}, medianprops={"color": "black", "linewidth": 1.5}, flierprops={"markersize": 3})
    if len(levels) > 8:
        axes.tick_params(axis="x", rotation=45)
    axes.set_xlabel(study.label(factor))
    axes.set_ylabel(study.label(metric))
    return figure, f"{metric} at the end of the runs, by {factor}: median, quartiles, whiskers to 1.5 times their distance, and what is beyond."


def heat(study, metric, x, y):
    figure, axes = plt.subplots(figsize=SIZE)
    groups = grouped(study.last, [x, y], metric)
    xs, ys = sorted(study.levels[x]), sorted(study.levels[y])
    means = np.array([[np.mean(groups[(a, b)]) if (a, b) in groups else np.nan for a in xs] for b in ys])
    picture = axes.imshow(means, origin="lower", aspect="auto", cmap=HEAT, interpolation="nearest")
    axes.set_xticks(range(len(xs)), [shown(a) for a in xs], rotation=45 if len(xs) > 8 else 0)
    axes.set_yticks(range(len(ys)), [shown(b) for b in ys])
    axes.grid(False)
    axes.set_xlabel(study.label(x))
    axes.set_ylabel(study.label(y))
    figure.colorbar(picture, label=study.label(metric))
    if means.size <= 60:
        middle = (np.nanmin(means) + np.nanmax(means)) / 2
        for (row, column), value in np.ndenumerate(means):
            if not np.isnan(value):
                axes.text(column, row, number(value, 3), ha="center", va="center", fontsize=8, color="white" if value < middle else "black")
    return figure, f"{metric} at the end of the runs over {x} and {y}: means of all seeds."


def ways(study, point, seed):
    row = study.database.execute("SELECT entities, samples, places FROM ways WHERE point = ? AND seed = ?", (point, seed)).fetchone()
    names = row[0].split(" ")
    places = np.frombuffer(row[2], dtype="<f4").reshape(row[1], len(names), 2)
    figure, axes = plt.subplots(figsize=(4.8, 4.8))
    for entity in range(len(names)):
        colour = COLOURS[entity % len(COLOURS)]
        axes.plot(places[:, entity, 0], places[:, entity, 1], color=colour, linewidth=0.8, alpha=0.7)
        there = np.flatnonzero(~np.isnan(places[:, entity, 0]))
        if len(there):
            axes.plot(*places[there[-1], entity], marker="o", markersize=4, color=colour)
    axes.set_aspect("equal")
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")
    return figure, f"Ways of {len(names)} entities in run {point}-{seed} ({values_of(study, point)}); a dot is where each ended."


def visits(study, metric, point):
    rows = study.database.execute("SELECT columns, rows, cell_m, visits FROM grids WHERE metric = ? AND point = ?", (metric, point)).fetchall()
    columns, lines, cell, _ = rows[0]
    total = sum(np.frombuffer(row[3], dtype="<u4").reshape(lines, columns).astype(float) for row in rows) / len(rows)
    figure, axes = plt.subplots(figsize=(5.4, 4.6))
    picture = axes.imshow(np.where(total > 0, total, np.nan), origin="lower", cmap=HEAT, extent=(0, columns * cell, 0, lines * cell), interpolation="nearest")
    axes.grid(False)
    axes.set_facecolor("#e0e0e0")
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")
    figure.colorbar(picture, label="ticks of entities in a cell, mean of the seeds")
    return figure, f"{metric}: where entities were ({values_of(study, point)}); cells in grey were never visited."


def values_of(study, point):
    row = study.rows("SELECT * FROM runs WHERE point = ? LIMIT 1", (point,))[0]
    return ", ".join(f"{name} = {shown(row[name])} {study.units.get(name, '')}".rstrip() for name, _ in study.factors) or "the only point"


def ends(study, table):
    points = [row[0] for row in study.database.execute(f"SELECT DISTINCT point FROM {table} ORDER BY point")]
    if study.facts.get("search"):
        found = plot_search.Search(study)
        return [point for point in points if point in (found.points[:1] + [found.best])]
    return points if len(points) <= 2 else [points[0], points[-1]]


def with_reference(study, metric, figure, references):
    """Draws a curve of somebody else beside ours: a CSV file with the columns of the picture's axes."""
    for number, reference in enumerate(r for r in references if r["metric"] == metric):
        for ours in figure.axes[0].lines:
            if ours.get_label().startswith("_"):
                ours.set_label("this study")
        figure.axes[0].plot(reference["x"], reference["y"], linestyle="--", color="black", marker=["x", "+"][number % 2], label=reference["name"])
        legend(figure.axes[0])


def pictures(study, metrics, ended):
    """(name, function that draws it and returns the figure and what it shows). ended: as --ended says."""
    if study.facts.get("search"):
        yield from plot_search.pictures(study)
        metrics = []
    varied = study.varied()
    numeric = [name for name, is_numeric in varied if is_numeric]
    others = [name for name, _ in varied if name not in numeric]
    for metric in metrics:
        if numeric:
            by = next((name for name in others + numeric[1:] if len(study.levels[name]) <= MOST_LINES), None)
            yield f"{metric}_over_{numeric[0]}", partial(over_factor, study, metric, numeric[0], by)
        for name, _ in varied[:2] if varied else []:
            if len(study.levels[name]) <= 40:
                yield f"{metric}_boxes_{name}", partial(boxes, study, metric, name)
        for x, y in itertools.islice(itertools.combinations(numeric, 2), 3):
            yield f"{metric}_over_{x}_and_{y}", partial(heat, study, metric, x, y)
        if study.has_time:
            yield f"{metric}_over_time", partial(over_time, study, metric, varied[0][0] if varied else None, ended)
    for point in ends(study, "ways"):
        seed = study.database.execute("SELECT MIN(seed) FROM ways WHERE point = ?", (point,)).fetchone()[0]
        yield f"ways_{point}-{seed}", partial(ways, study, point, seed)
    for metric, in study.database.execute("SELECT DISTINCT metric FROM grids ORDER BY metric").fetchall():
        for point in ends(study, "grids"):
            yield f"{metric}_visits_{point}", partial(visits, study, metric, point)


def wilcoxon(differences):
    """Wilcoxon's signed-rank test of paired differences: p of both sides, and the rank-biserial correlation of the pairs (Kerby,
    Comprehensive Psychology 3 (2014)): 1 if all differences are above 0, -1 if all are below. Exact for up to 50 pairs without equal
    sizes, otherwise normal with the correction for these."""
    from scipy import stats  # takes a second, and only --compare needs it
    kept = np.array([d for d in differences if d != 0], dtype=float)
    if len(kept) == 0:
        return 1.0, 0.0
    ranks = stats.rankdata(np.abs(kept))
    is_exact = len(kept) <= 50 and len(set(ranks)) == len(kept)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # few pairs of equal sizes
        p = stats.wilcoxon(kept, correction=True, method="exact" if is_exact else "approx").pvalue
    return float(p), float((ranks * np.sign(kept)).sum() / ranks.sum())


def level_named(study, factor, text):
    for level in study.levels[factor]:
        if shown(level) == text:
            return level
    raise StudyError(f"--compare: '{factor}' has no value '{text}'; it has: {', '.join(map(shown, study.levels[factor]))}")


def compared(study, request, metrics):
    """[(metric, factor, first, second, pairs, mean difference, half its confidence interval, p, effect)] of FACTOR=A,B: B less A, in pairs
    that have the same seed and the same values of all other factors."""
    factor, _, values = request.partition("=")
    if factor not in study.levels or values.count(",") != 1:
        raise StudyError(f"--compare: write FACTOR=A,B, with one of the factors {', '.join(study.levels) or '(there are none)'}")
    first, second = (level_named(study, factor, value.strip()) for value in values.split(","))
    others = [name for name in study.levels if name != factor] + ["seed"]
    found = []
    for metric in metrics:
        of = {level: {tuple(row[name] for name in others): row[metric] for row in study.last if row[factor] == level and row[metric] is not None}
              for level in (first, second)}
        differences = [of[second][key] - of[first][key] for key in of[first] if key in of[second]]
        if differences:
            found.append((metric, factor, shown(first), shown(second), len(differences), *mean_and_band(differences), *wilcoxon(differences)))
    return found


def holm(probabilities):
    """Probabilities corrected for their number: Holm, Scandinavian Journal of Statistics 6 (1979)."""
    corrected, least = [0.0] * len(probabilities), 0.0
    for rank, place in enumerate(sorted(range(len(probabilities)), key=probabilities.__getitem__)):
        least = max(least, min(1.0, (len(probabilities) - rank) * probabilities[place]))
        corrected[place] = least
    return corrected


SURE = 0.05


def verdict(factor, first, second, mean, p, effect):
    """Which of two values gives more, if p is below SURE, and mean and ranks agree."""
    if p >= SURE:
        return f"no difference shown: {factor}={second} less {first}"
    if mean * effect <= 0:
        return f"different, but mean and ranks disagree: {factor}={second} less {first}"
    more, less = (second, first) if effect > 0 else (first, second)
    return f"larger with {factor}={more} than with {less}"


def comparison(study, requests, metrics):
    """The comparisons that are asked for: lines of text, and heads and rows of a table. All tests together are corrected by Holm's method."""
    rows = [row for request in requests for row in compared(study, request, metrics)]
    corrected = holm([row[-2] for row in rows])
    test = f"Wilcoxon, Holm's correction for {len(rows)} tests" if len(rows) > 1 else "Wilcoxon"
    lines, table = [], []
    for (metric, factor, first, second, pairs, mean, half, p, effect), p_holm in zip(rows, corrected):
        told = verdict(factor, first, second, mean, p_holm, effect)
        by = with_error(abs(mean) if told.startswith("larger") else mean, half)
        unit = f" {study.units[metric]}" if study.units.get(metric) else ""
        lines.append(f"{metric}: {told} by {by}{unit} in {pairs} pairs; {probability(p_holm)} ({test}), effect {effect:+.2f}"
                     if told.startswith("larger") else
                     f"{metric}: {told} is {by}{unit} in {pairs} pairs; {probability(p_holm)} ({test}), effect {effect:+.2f}")
        table.append([study.label(metric), told, by, str(pairs), probability(p_holm), f"{effect:+.2f}"])
    return lines, ["metric", "result", "difference", "pairs", "p", "effect"], table


def compared_html(head, rows):
    if not rows:
        return ""
    correction = f" p has Holm's correction for {len(rows)} tests." if len(rows) > 1 else ""
    return ("<h2>Compared in pairs</h2><p>Differences of runs with the same seed and otherwise the same values: mean with its confidence interval of 95 %, "
            f"Wilcoxon's signed-rank test, rank-biserial correlation.{correction}</p>{as_html(head, rows)}")


def mean_and_deviation(values):
    if not values:
        return ""
    return with_error(float(np.mean(values)), float(np.std(values, ddof=1))) if len(values) > 1 else number(values[0])


def summary(study):
    """The table of all points: mean and deviation of each metric at the end of the runs. Returns its head and rows."""
    names = [name for name, _ in study.factors]
    head = [*map(study.label, names), "runs", *map(study.label, study.metrics)]
    table = []
    for _, rows in itertools.groupby(study.last, key=lambda row: row["point"]):
        rows = list(rows)
        values = [[row[metric] for row in rows if row[metric] is not None] for metric in study.metrics]
        table.append([shown(rows[0][name]) for name in names] + [str(len(rows))] + list(map(mean_and_deviation, values)))
    return head, table


MOST_ROWS = 500  # of the report's table


PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>{name}</title><style>
body {{ font: 15px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; color: #202020; background: #fff; overflow-wrap: anywhere }}
figure {{ display: inline-block; margin: 0 1rem 1.5rem 0; vertical-align: top; max-width: min(32rem, 100%) }}
figure svg {{ max-width: 100%; height: auto }}
figcaption {{ color: #505050; font-size: 0.9em }}
table {{ border-collapse: collapse; font-size: 0.9em; overflow-wrap: normal }}
th, td {{ padding: 0.15rem 0.7rem; text-align: right; border-bottom: 1px solid #d8d8d8; white-space: nowrap }}
.wide {{ overflow-x: auto }}
pre {{ background: #f4f4f4; padding: 0.8rem; white-space: pre-wrap }}
</style></head><body>
<h1>{name}</h1>
<p>{runs}. Swarmanoid {version}{revision}.</p>
{figures}
{comparisons}
<h2>At the end of the runs</h2>
<p>Mean and standard deviation over the seeds.</p>
{table}
<h2>The study</h2>
<pre>{study}</pre>
</body></html>
"""


def inline(figure):
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    svg = text.getvalue()
    return svg[svg.index("<svg"):]


def read_references(path, metrics):
    """[{metric, name, x, y}] of a JSON file beside the study."""
    with open(path, encoding="utf-8") as file:
        found = json.load(file)
    for reference in found:
        missing = {"metric", "name", "x", "y"} - set(reference)
        if missing or len(reference["x"]) != len(reference["y"]):
            raise StudyError(f"{path}: each curve has 'metric', 'name', and 'x' and 'y' of the same length")
        if reference["metric"] not in metrics:
            raise StudyError(f"{path}: the study has no metric '{reference['metric']}'; it has: {', '.join(metrics)}")
    return found


class Progress:
    """One line on a terminal with the share that is done and the time that is left, as the command shows it; nothing in a pipe."""

    def __init__(self, work, steps):
        self.work, self.steps, self.begin = work, steps, time.monotonic()
        self.shown = sys.stderr.isatty()

    def show(self, done):
        if not self.shown:
            return
        seconds = (time.monotonic() - self.begin) * (self.steps - done) / done if done else 0
        left = f", {seconds:.0f} s left" if seconds >= 1 else ""
        print(f"\r{self.work}: {100 * done // self.steps} %{left}\033[K", end="", file=sys.stderr, flush=True)

    def clear(self):
        if self.shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def main():
    parser = argparse.ArgumentParser(prog="swarmanoid plot", description=__doc__)
    parser.add_argument("folder")
    parser.add_argument("--metric", action="append", default=[])
    parser.add_argument("--reference", default="")
    parser.add_argument("--compare", action="append", default=[])
    parser.add_argument("--format", choices=["svg", "png"], default="svg")
    parser.add_argument("--ended", choices=list(ENDED), default="stop")
    parser.add_argument("--output", default="")
    options = parser.parse_args()
    study = Study(options.folder)
    for metric in options.metric:
        if metric not in study.metrics:
            raise StudyError(f"--metric: the study has no column '{metric}'; it has: {', '.join(study.metrics) or 'none'}")
    if not study.last:
        raise StudyError(f"no run of '{options.folder}' has a result yet")
    references = read_references(options.reference, study.metrics) if options.reference else []
    lines, compared_head, compared_rows = comparison(study, options.compare, options.metric or study.metrics)
    for text in lines:
        print(text)
    output = pathlib.Path(options.output) if options.output else study.folder / "pictures"
    output.mkdir(parents=True, exist_ok=True)
    figures = []
    planned = list(pictures(study, options.metric or study.metrics, options.ended))
    progress = Progress("drawing", len(planned))
    for number, (name, draw) in enumerate(planned):
        progress.show(number)
        figure, caption = draw()
        metric = next((m for m in study.metrics if name.startswith(m + "_over_") and "_and_" not in name and not name.endswith("_over_time")), None)
        with_reference(study, metric, figure, references)
        figure.savefig(output / f"{name}.{options.format}", dpi=150, metadata={"Date": None} if options.format == "svg" else None)
        figures.append(f"<figure>{inline(figure)}<figcaption>{html.escape(caption)}</figcaption></figure>")
        plt.close(figure)
    progress.clear()
    revision = study.facts.get("revision", "")
    runs = ", ".join(f"{count} runs {state}" for state, count in sorted(study.states.items()))
    head, table = summary(study)
    tables = [(head, table)] + ([(compared_head, compared_rows)] if compared_rows else [])
    for ending, written in (("md", as_markdown), ("tex", as_latex)):
        (output / f"table.{ending}").write_text("\n".join(written(*each) for each in tables), encoding="utf-8")
    shown_rows = table[:MOST_ROWS] + ([["The others stand in table.md."]] if len(table) > MOST_ROWS else [])
    report = output / "report.html"
    report.write_text(PAGE.format(name=html.escape(study.facts["name"]), runs=runs, version=study.facts["version"],
                                  revision=f" ({revision})" if revision else "", figures="\n".join(figures),
                                  comparisons=compared_html(compared_head, compared_rows), table=as_html(head, shown_rows),
                                  study=html.escape(study.facts["study"])), encoding="utf-8")
    print(f"{len(figures)} pictures in {output}, report {report}")


if __name__ == "__main__":
    try:
        main()
    except (StudyError, sqlite3.Error, OSError, json.JSONDecodeError) as error:
        print(f"swarmanoid plot: {error}", file=sys.stderr)
        sys.exit(2)
