"""Statistics of two samples, for tests/bench/beside_argos3: means and their confidence intervals, tests of means and of spreads, and the
correction for many tests. Sources: Welch (1947), Brown and Forsythe (1974), Holm (1979); Student's distribution by the continued fraction
of the incomplete beta function (Numerical Recipes, 6.4)."""
import functools
import math
import statistics


def incomplete_beta(a, b, x):
    """The regularised incomplete beta function I_x(a, b) for x from 0 to 1."""
    if x <= 0:
        return 0.0
    if x >= 1:
        return 1.0
    if x > (a + 1) / (a + b + 2):  # where the fraction converges slowly
        return 1 - incomplete_beta(b, a, 1 - x)
    front = math.exp(math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x)) / a
    # Lentz's algorithm; tiny stands for a denominator of zero.
    tiny = 1e-300
    c, d, fraction = 1.0, 0.0, 1.0
    for i in range(1000):
        m = i // 2
        if i == 0:
            numerator = 1.0
        elif i % 2 == 0:
            numerator = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        else:
            numerator = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        d = 1 / (1 + numerator * d or tiny)
        c = 1 + numerator / c or tiny
        fraction *= c * d
        if abs(1 - c * d) < 1e-15:
            break
    return front * (fraction - 1)


def student_p(t, degrees):
    """The probability that the absolute value of Student's t is at least |t|."""
    return incomplete_beta(degrees / 2, 0.5, degrees / (degrees + t * t))


@functools.lru_cache
def student_quantile(degrees, level=0.95):
    """The t that absolute values stay below with the probability `level`."""
    low, high = 0.0, 1.0
    while student_p(high, degrees) > 1 - level:
        high *= 2
    while high - low > 1e-10 * high:
        middle = (low + high) / 2
        low, high = (middle, high) if student_p(middle, degrees) > 1 - level else (low, middle)
    return (low + high) / 2


class Sample:
    """The values of one quantity, one for each seed."""

    def __init__(self, values):
        if len(values) < 2:
            raise ValueError(f"a sample needs at least two values, and has {len(values)}")
        self.values = list(values)
        self.mean = statistics.fmean(values)
        self.deviation = statistics.stdev(values)

    def __len__(self):
        return len(self.values)

    def half_width(self, level=0.95):
        """Half of the confidence interval of the mean."""
        return student_quantile(len(self) - 1, level) * self.deviation / math.sqrt(len(self))


class Difference:
    """The difference of the means of two samples of different spreads: `value`, `half_width` of its interval and `p`, by Welch's test."""

    def __init__(self, sample, other, level=0.95):
        self.value = sample.mean - other.mean
        parts = [one.deviation**2 / len(one) for one in (sample, other)]
        self.error = math.sqrt(sum(parts))
        self.level = level
        if self.error == 0:
            self.degrees, self.p = math.inf, 1.0 if self.value == 0 else 0.0
            return
        self.degrees = sum(parts) ** 2 / sum(part**2 / (len(one) - 1) for part, one in zip(parts, (sample, other)))
        self.p = student_p(self.value / self.error, self.degrees)

    @property
    def half_width(self):
        return student_quantile(self.degrees, self.level) * self.error if self.error > 0 else 0.0


def spread_p(sample, other):
    """The probability that samples of one spread differ as much in theirs: Brown and Forsythe's test, by distances from medians."""
    distances = [Sample([abs(value - statistics.median(one.values)) for value in one.values]) for one in (sample, other)]
    return Difference(*distances).p


def holm(probabilities):
    """The probabilities of many tests, corrected so that with no difference at all even the least is below 0.05 in 5 % of the tables."""
    order = sorted(range(len(probabilities)), key=lambda k: probabilities[k])
    corrected = [0.0] * len(probabilities)
    least = 0.0
    for rank, k in enumerate(order):
        least = max(least, min(1.0, probabilities[k] * (len(probabilities) - rank)))
        corrected[k] = least
    return corrected
