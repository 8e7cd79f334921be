"""The notebooks of docs/notebooks, or of the folder NOTEBOOKS: each cell runs, in order, and comes to something."""
import json
import os
import pathlib
import tempfile
import unittest

import numpy as np

NOTEBOOKS = pathlib.Path(os.environ.get("NOTEBOOKS") or pathlib.Path(__file__).resolve().parents[2] / "docs/notebooks")


class Notebooks(unittest.TestCase):
    def run_all(self, name):
        """What the names of a notebook mean at its end; the pictures that it showed."""
        folder = tempfile.TemporaryDirectory(prefix="swarmanoid_notebooks_")
        self.addCleanup(folder.cleanup)
        os.environ.update(MPLBACKEND="Agg", MPLCONFIGDIR=folder.name)
        # What a notebook makes for itself goes with it.
        self.addCleanup(setattr, tempfile, "tempdir", tempfile.tempdir)
        tempfile.tempdir = folder.name
        import matplotlib.pyplot as plt

        shown = []
        show, plt.show = plt.show, lambda: shown.append(self.picture(plt.gcf()))
        try:
            names = {"__name__": "__main__"}
            for number, cell in enumerate(json.loads((NOTEBOOKS / f"{name}.ipynb").read_text())["cells"]):
                self.assertFalse(cell.get("outputs"), "what a notebook shows is not kept")
                if cell["cell_type"] == "code":
                    exec(compile("".join(cell["source"]), f"{name}.ipynb, cell {number}", "exec"), names)
            return names, shown
        finally:
            plt.show = show
            plt.close("all")

    def picture(self, figure):
        figure.canvas.draw()
        if folder := os.environ.get("NOTEBOOK_PICTURES"):
            figure.savefig(pathlib.Path(folder) / f"{self.id().rsplit('.', 1)[1]}.png")
        return np.asarray(figure.canvas.buffer_rgba())

    def assert_drawn(self, shown, count):
        self.assertEqual(len(shown), count)
        for picture in shown:
            self.assertGreater(len(np.unique(picture.reshape(-1, 4), axis=0)), 20)

    def test_all_of_them_are_tried(self):
        self.assertEqual(sorted(path.stem for path in NOTEBOOKS.glob("*.ipynb")), ["learn_a_behaviour", "plot_a_run", "tune_a_parameter"])

    def test_plot_a_run(self):
        names, shown = self.run_all("plot_a_run")
        self.assert_drawn(shown, 1)
        self.assertEqual(names["ways"].shape, (601, 10, 3))
        self.assertGreater(names["moved"][-1].mean(), 0.05)

    def test_tune_a_parameter(self):
        names, shown = self.run_all("tune_a_parameter")
        self.assert_drawn(shown, 1)
        self.assertTrue(((names["shares"] > 0) & (names["shares"] < 1)).all())
        # Who creeps sees least.
        self.assertEqual(int(names["mean"].argmin()), 0)

    def test_learn_a_behaviour(self):
        names, shown = self.run_all("learn_a_behaviour")
        self.assert_drawn(shown, 1)
        self.assertGreater(names["course"][-1][0], names["course"][0][0])
        self.assertGreater(names["learnt"], names["standing"])
        self.assertGreater(names["learnt"], names["blind"])
