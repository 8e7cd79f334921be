"""Pictures of the validation page: small SVG files that are the same in every run."""
import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

import report

# Okabe and Ito 2008: told apart by readers with any colour vision; lines and marks differ, too.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#000000"]
MARKS = ["o", "s", "^", "D"]


def draw(figure, folder):
    """Writes one figure of a scene; returns its name, its caption, and its part of the page."""
    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "swarmanoid", "font.size": 9, "path.simplify_threshold": 0.5})
    drawn, axes = plt.subplots(figsize=(5, 3))
    for k, (label, xs, ys) in enumerate(figure.get("series", [])):
        if figure.get("thin"):
            axes.plot(xs, ys, color=COLOURS[k], lw=2, label=label)
        else:
            axes.plot(xs, ys, MARKS[k], color=COLOURS[k], ms=5, label=label)
    for k, (label, xs, ys) in enumerate(figure.get("curves", [])):
        axes.plot(xs, ys, "--", color=COLOURS[-1 - k], lw=1.2, label=label)
    for k, (label, y) in enumerate(figure.get("lines", [])):
        axes.axhline(y, ls=["--", ":", "-."][k % 3], color=COLOURS[-1], lw=1, label=label)
    if figure.get("log"):
        axes.set_xscale("log")
        axes.set_yscale("log")
    else:
        axes.set_ylim(0, 1.1 * axes.get_ylim()[1])
    axes.set_xlabel(figure["x"])
    axes.set_ylabel(figure["y"])
    axes.legend(frameon=False)
    drawn.tight_layout()
    folder.mkdir(parents=True, exist_ok=True)
    drawn.savefig(folder / f"{figure['name']}.svg", metadata={"Date": None})
    plt.close(drawn)
    return figure["name"], figure["caption"], figure.get("part", report.VERIFICATION)
