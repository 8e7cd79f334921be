"""Random numbers of controllers: distributions, and independence of robots, ticks and seeds."""
import math

from experiment import footbot, mean, probe
from report import Row, scene

GROUP = "Random numbers"


def correlation(xs, ys):
    x0, y0 = mean(xs), mean(ys)
    over = math.fsum((x - x0) * (y - y0) for x, y in zip(xs, ys))
    return over / math.sqrt(math.fsum((x - x0) ** 2 for x in xs) * math.fsum((y - y0) ** 2 for y in ys))


def furthest(sorted_values):
    """Kolmogorov's distance from the uniform distribution, times √n."""
    n = len(sorted_values)
    return math.sqrt(n) * max(max((i + 1) / n - u, u - i / n) for i, u in enumerate(sorted_values))


@scene(GROUP)
def streams(lab):
    draws, ticks = (200, 20) if lab.quick else (500, 100)
    who = probe("c", draws=draws)
    runs = [lab.run(footbot("a", 1.0, 1.0, 0, "c") + footbot("b", 2.0, 1.0, 0, "c"), who, "dummy_engine", ticks, seed=seed, every=ticks) for seed in (1, 2)]
    def numbers(run, robot, kind):
        return [u for now in run.readings(robot, "random") for u in now[kind]]
    first = numbers(runs[0], "a", "uniform")
    n = len(first)
    yield Row("uniform numbers: Kolmogorov's √n D", "below 1.95 with probability 0.999", "Kolmogorov 1933", 0.975, furthest(sorted(first)), 0.975, "p = 0.001")
    bins = [0] * 100
    for u in first:
        bins[int(100 * u)] += 1
    chi = sum((b - n / 100) ** 2 / (n / 100) for b in bins)
    yield Row("uniform numbers: χ² of 100 equal bins", "99 ± √198 z", "Pearson 1900", 99, chi, 3.3 * math.sqrt(198), "p ≈ 0.001")
    gaussian = numbers(runs[0], "a", "gaussian")
    through = sorted(0.5 * (1 + math.erf(g / math.sqrt(2))) for g in gaussian)
    yield Row("normal numbers: Kolmogorov's √n D", "below 1.95 with probability 0.999", "Kolmogorov 1933", 0.975, furthest(through), 0.975, "p = 0.001")
    for name, other in (("two robots", numbers(runs[0], "b", "uniform")), ("two seeds", numbers(runs[1], "a", "uniform")),
                        ("neighbours of a stream", first[1:] + first[:1]), ("two ticks", first[draws:] + first[:draws])):
        yield Row(f"uniform numbers: correlation of {name}", "0 ± z / √n", "independence", 0, correlation(first, other), 3.3 / math.sqrt(n), "p ≈ 0.001")
