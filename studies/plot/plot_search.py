"""Pictures of a search: its course, and what it tried of each factor. A part of plot_study.py."""
import itertools
from functools import partial

import matplotlib.pyplot as plt
import numpy as np

import study_style as style


def aggregated(name, values):
    """Of a point's seeds, as <search aggregate> says."""
    simple = {"mean": np.mean, "median": np.median, "min": np.min, "max": np.max, "sum": np.sum, "count": len}
    if name in simple:
        return float(simple[name](values))
    if name == "deviation":
        return float(np.std(values, ddof=1)) if len(values) > 1 else float("nan")
    return float(np.quantile(values, int(name[1:]) / 100))


class Search:
    """The points of a study with a <search>: what the algorithm learned of each, in its order. The points of a race have different numbers of seeds."""

    def __init__(self, study):
        self.label = study.label
        self.metric, self.goal, self.aggregate = (study.facts[name] for name in ("search", "goal", "aggregate"))
        seeds = [int(seed) for seed in study.facts["seeds"].split()]
        values, fresh = {}, {}
        self.factors = {}
        for row in study.last:
            (values if row["seed"] in seeds else fresh).setdefault(row["point"], []).append(row[self.metric])
            self.factors[row["point"]] = {name: row[name] for name, _ in study.factors}
        self.is_race = study.facts.get("algorithm") == "race"
        # Keep only points with all seeds, except of a race, and all values.
        self.points = [p for p in sorted(values) if (self.is_race or len(values[p]) == len(seeds)) and None not in values[p]]
        self.runs = [len(values[p]) for p in self.points]
        self.values = [aggregated(self.aggregate, values[p]) for p in self.points]
        better = np.maximum if self.goal == "max" else np.minimum
        self.best_so_far = better.accumulate(self.values) if self.values else []
        self.best = self.points[int(np.argmax(self.values) if self.goal == "max" else np.argmin(self.values))] if self.values else None
        if self.is_race and self.points:
            # The winner has the fresh seeds. Before its end, it is the best of the points that ran most often.
            sign = 1 if self.goal == "max" else -1
            self.best = max(self.points, key=lambda p: (len(fresh.get(p, [])), len(values[p]), sign * self.values[self.points.index(p)]))
        self.fresh = [value for value in fresh.get(self.best, []) if value is not None]


def course(search):
    figure, axes = plt.subplots(figsize=style.SIZE)
    if search.is_race:
        seen = axes.scatter(search.points, search.values, c=search.runs, cmap=style.HEAT, s=18)
        figure.colorbar(seen, label="seeds that it ran with")
        axes.plot(search.best, search.values[search.points.index(search.best)], marker="*", markersize=15, color=style.COLOURS[1], linestyle="", label="winner")
    else:
        axes.plot(search.points, search.values, linestyle="", marker="o", markersize=4, color=style.COLOURS[5], label="each point")
        axes.step(search.points, search.best_so_far, where="post", color=style.COLOURS[0], label="best so far")
    if len(search.fresh) > 1:
        mean, half = style.mean_and_band(search.fresh)
        colour = style.COLOURS[1]
        axes.axhline(mean, color=colour, linestyle="--", linewidth=1.2, label=f"the best with {len(search.fresh)} fresh seeds: mean")
        axes.axhspan(mean - half, mean + half, color=colour, alpha=0.2, linewidth=0)
    axes.set_xlabel("point, in the order of the search")
    axes.set_ylabel(f"{search.label(search.metric)}, {search.aggregate} of the seeds")
    axes.legend(fontsize=9)
    if search.is_race:
        return figure, (f"The races for the {'most' if search.goal == 'max' else 'least'} {search.metric}: each point, and the number of seeds that it ran with before it "
                        "was dropped. The band is the confidence interval of 95 % of the winner's mean with fresh seeds.")
    return figure, (f"The course of the search for the {'most' if search.goal == 'max' else 'least'} {search.metric}: each point, and the best one so far. The best "
                    "value of a search is flattered, since chance helped to choose it; the band is the confidence interval of 95 % of its mean with fresh seeds.")


def tried(search, factor):
    """What was tried of one factor."""
    figure, axes = plt.subplots(figsize=style.SIZE)
    xs = [search.factors[p][factor] for p in search.points]
    picture = axes.scatter(xs, search.values, c=range(len(xs)), cmap=style.HEAT, s=22)
    axes.plot(search.factors[search.best][factor], search.values[search.points.index(search.best)], marker="*", markersize=15, color=style.COLOURS[1],
              linestyle="", label="best")
    axes.set_xlabel(search.label(factor))
    axes.set_ylabel(search.label(search.metric))
    figure.colorbar(picture, label="order of the search")
    axes.legend()
    return figure, f"{search.metric} over what the search tried of {factor}; later points are lighter."


def tried_pair(search, x, y):
    figure, axes = plt.subplots(figsize=style.SIZE)
    picture = axes.scatter([search.factors[p][x] for p in search.points], [search.factors[p][y] for p in search.points], c=search.values, cmap=style.HEAT, s=30)
    best = search.factors[search.best]
    axes.plot(best[x], best[y], marker="*", markersize=15, color=style.COLOURS[1], linestyle="", label="best")
    axes.set_xlabel(search.label(x))
    axes.set_ylabel(search.label(y))
    figure.colorbar(picture, label=search.label(search.metric))
    axes.legend()
    return figure, f"{search.metric} of all that the search tried of {x} and {y}."


def pictures(study):
    """(name, function that draws it), as those of plot_study.py."""
    search = Search(study)
    if not search.points:
        return
    yield f"{search.metric}_search", partial(course, search)
    searched = [name for name, numeric in study.varied() if numeric]
    for factor, _ in study.varied():
        yield f"{search.metric}_tried_{factor}", partial(tried, search, factor)
    for x, y in itertools.islice(itertools.combinations(searched, 2), 6):
        yield f"{search.metric}_tried_{x}_and_{y}", partial(tried_pair, search, x, y)
