"""How all pictures of studies look, and the means that they show."""
import matplotlib.pyplot as plt
import numpy as np

# Okabe and Ito (2008), https://jfly.uni-koeln.de/color/: told apart with all kinds of colour blindness. Each has a mark of its own, too.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
MARKS = ["o", "s", "^", "D", "v", "P", "X"]
HEAT = "cividis"
MOST_LINES = len(COLOURS)
SIZE = (6.4, 4.2)

plt.rcParams.update({"axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False, "figure.constrained_layout.use": True,
                     "svg.hashsalt": "swarmanoid", "font.size": 10})


def t_quantile(freedom):
    """Of 97.5 %: Student's t, by Hill's expansion (Communications of the ACM 13 (1970), algorithm 396), within 0.1 % from 3 on."""
    if freedom in (1, 2):
        return {1: 12.706, 2: 4.303}[freedom]
    p, n = 0.05, freedom
    a = 1 / (n - 0.5)
    b = 48 / (a * a)
    c = ((20700 * a / b - 98) * a - 16) * a + 96.36
    d = ((94.5 / (b + c) - 3) / b + 1) * np.sqrt(a * np.pi / 2) * n
    y = (d * p) ** (2 / n)
    if y > 0.05 + a:
        x = -1.959964
        y = x * x
        if n < 5:
            c += 0.3 * (n - 4.5) * (x + 0.6)
        c = (((0.05 * d * x - 5) * x - 7) * x - 2) * x + b + c
        y = (((((0.4 * y + 6.3) * y + 36) * y + 94.5) / c - y - 3) / b + 1) * x
        y = np.expm1(a * y * y)
    else:
        y = ((1 / (((n + 6) / (n * y) - 0.089 * d - 0.822) * (n + 2) * 3) + 0.5 / (n + 4)) * y - 1) * (n + 1) / (n + 2) + 1 / y
    return float(np.sqrt(n * y))


def mean_and_band(values):
    """The mean, and half the width of its confidence interval of 95 %; 0 for one value."""
    values = np.asarray(values, dtype=float)
    if len(values) < 2:
        return float(values.mean()), 0.0
    return float(values.mean()), t_quantile(len(values) - 1) * float(values.std(ddof=1)) / np.sqrt(len(values))
