"""How all pictures of studies look, and the means that they show."""
import matplotlib.pyplot as plt
import numpy as np
from scipy.special import stdtrit

# Okabe and Ito (2008), https://jfly.uni-koeln.de/color/: told apart with all kinds of colour blindness. Each has a mark of its own, too.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
MARKS = ["o", "s", "^", "D", "v", "P", "X"]
HEAT = "cividis"
MOST_LINES = len(COLOURS)
SIZE = (6.4, 4.2)

plt.rcParams.update({"axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False, "figure.constrained_layout.use": True,
                     "axes.formatter.use_mathtext": True, "axes.formatter.useoffset": False, "svg.hashsalt": "swarmanoid", "font.size": 10})


def mean_and_band(values):
    """The mean, and half the width of its confidence interval of 95 %; 0 for one value."""
    values = np.asarray(values, dtype=float)
    if len(values) < 2:
        return float(values.mean()), 0.0
    return float(values.mean()), float(stdtrit(len(values) - 1, 0.975)) * float(values.std(ddof=1)) / np.sqrt(len(values))
