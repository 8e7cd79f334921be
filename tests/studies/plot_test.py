"""Pictures and reports of studies, and the statistics in them against tables and closed forms."""
import contextlib
import importlib.util
import math
import os
import pathlib
import re
import sqlite3
import sys
import unittest
import xml.etree.ElementTree as xml

CONFIGS = pathlib.Path(os.environ["SWARMANOID_CONFIGS"])
SCRIPT = CONFIGS.parent / "studies" / "plot" / "plot_study.py"

if None in map(importlib.util.find_spec, ("matplotlib", "scipy")):
    # The first Python on the path need not be Debian's, which has both.
    if sys.executable != "/usr/bin/python3" and os.path.exists("/usr/bin/python3"):
        os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])
    sys.exit(77)
import numpy as np

from study_case import SWARMANOID, StudyCase  # noqa: E402
from world.case import run_on_a_terminal  # noqa: E402

sys.path.insert(0, str(SCRIPT.parent))
specification = importlib.util.spec_from_file_location("plot_study", SCRIPT)
plot_study = importlib.util.module_from_spec(specification)
specification.loader.exec_module(plot_study)
plot_search, study_text = sys.modules["plot_search"], sys.modules["study_text"]


class Statistics(unittest.TestCase):
    def test_signed_ranks_of_few_pairs_are_counted(self):
        # All above 0: one choice of signs of 2**n, on both sides.
        for n in range(1, 12):
            self.assertAlmostEqual(plot_study.wilcoxon([0.5 + k for k in range(n)])[0], min(1, 2 / 2**n))
        # The ranks 1 and 3 are below 0. Of all sets of ranks, seven have a sum of up to 4: none, 1, 2, 3, 1 + 2, 4, 1 + 3.
        differences = [10, 9, 8, 7, 6, 5, 4, -3, 2, -1]
        self.assertAlmostEqual(plot_study.wilcoxon(differences)[0], 2 * 7 / 1024)
        self.assertAlmostEqual(plot_study.wilcoxon(differences)[1], (51 - 4) / 55)
        self.assertEqual(plot_study.wilcoxon([0, 0]), (1.0, 0.0))
        self.assertAlmostEqual(plot_study.wilcoxon([-1, -2, -3])[1], -1)

    def test_many_pairs_are_near_the_normal_limit(self):
        # Four of equal size have the rank 2.5. Three above: a sum of 7.5, the mean is 5, the variance 4 · 5 · 9 / 24 - (4³ - 4) / 48.
        self.assertAlmostEqual(plot_study.wilcoxon([2, 2, 2, -2])[0], math.erfc((7.5 - 5 - 0.5) / math.sqrt(7.5 - 1.25) / math.sqrt(2)))
        # 51 pairs whose signs alternate are no evidence; 51 with one sign are.
        self.assertGreater(plot_study.wilcoxon([(k + 1) * (-1) ** k for k in range(51)])[0], 0.5)
        self.assertLess(plot_study.wilcoxon([k + 1 for k in range(51)])[0], 1e-9)

    def test_bands_are_those_of_student(self):
        # Student's t of 97.5 %: the closed forms of 1 and 2, tables for others.
        for freedom, quantile in ((1, math.tan(0.475 * math.pi)), (2, 0.95 * math.sqrt(2 / (1 - 0.95**2))), (4, 2.776), (9, 2.262), (29, 2.045)):
            # Half of the values are 1 above their mean, half 1 below, or one is at it: the standard error is known.
            values = [-1.0, 1.0] * ((freedom + 1) // 2) + [0.0] * ((freedom + 1) % 2)
            error = math.sqrt(sum(v * v for v in values) / freedom / (freedom + 1))
            mean, half = plot_study.mean_and_band(values)
            self.assertAlmostEqual(mean, 0)
            self.assertAlmostEqual(half / error, quantile, delta=0.0005)
        self.assertEqual(plot_study.mean_and_band([5.0]), (5.0, 0.0))


class Courses(unittest.TestCase):
    # Three runs with a row every 10 s. One ends between two rows, one at a row, and one goes on.
    RUNS = {(0, 1): {0: 0, 10: 1, 14: 8}, (0, 2): {0: 0, 10: 3, 20: 9}, (0, 3): {0: 0, 10: 5, 20: 7, 30: 6, 40: 5}}

    def test_held_runs_keep_their_last_value(self):
        self.assertEqual(plot_study.values_over_time(self.RUNS, "hold"),
                         ([0, 10, 20, 30, 40], [[0, 0, 0], [1, 3, 5], [8, 9, 7], [8, 9, 6], [8, 9, 5]]))

    def test_stopped_lines_end_with_the_first_run(self):
        self.assertEqual(plot_study.values_over_time(self.RUNS, "stop"), ([0, 10], [[0, 0, 0], [1, 3, 5]]))

    def test_runs_with_other_periods_share_the_bins_of_the_longest(self):
        # Rows every 0.7 s and every 1 s: the first run counts with its last row in each second.
        runs = {1: {round(0.7 * k, 1): k for k in range(6)}, 2: {float(k): 10 * k for k in range(5)}}
        self.assertEqual(plot_study.values_over_time(runs, "stop"), ([0, 1, 2, 3], [[0, 0], [1, 10], [2, 20], [4, 30]]))
        self.assertEqual(plot_study.values_over_time(runs, "hold")[1][-1], [5, 40])

    def test_a_row_without_a_value_counts_for_nothing(self):
        runs = {(0, 1): {0: None, 10: 1}, (0, 2): {0: None, 10: 3, 20: None}}
        self.assertEqual(plot_study.values_over_time(runs, "stop"), ([10], [[1, 3]]))
        self.assertEqual(plot_study.values_over_time({}, "hold"), ([], []))
        self.assertEqual(plot_study.values_over_time({1: {0.0: 4}}, "stop"), ([0], [[4]]))


class Texts(unittest.TestCase):
    def test_numbers_are_written_as_people_do(self):
        for value, text in ((1012.3, "1012"), (0.000488, "0.000488"), (1e-7, "1 × 10⁻⁷"), (0, "0"), (-7.4334, "-7.433"), (999999.6, "1 × 10⁶"), (99.996, "100")):
            self.assertEqual(study_text.number(value), text)
        for mean, half, text in ((306.7, 160, "310 ± 160"), (0.04635, 0.025, "0.046 ± 0.025"), (-7.433, 13, "-7 ± 13"), (-120, 13000, "0 ± 13000"), (0.12, 0.099, "0.120 ± 0.099"),
                                 (1.234e7, 5.2e4, "(1.2340 ± 0.0052) × 10⁷"), (3, 0, "3 ± 0")):
            self.assertEqual(study_text.with_error(mean, half), text)
        self.assertEqual(study_text.probability(3e-7), "p < 0.0001")
        self.assertEqual(study_text.probability(0.0493), "p = 0.049")

    def test_tables_of_papers(self):
        head, rows = ["speed_max (m/s)", "a|b"], [["0.1", "(1.2 ± 0.1) × 10⁻⁷"]]
        self.assertEqual(study_text.as_markdown(head, rows), "| speed_max (m/s) | a\\|b |\n|---|---|\n| 0.1 | (1.2 ± 0.1) × 10⁻⁷ |\n")
        self.assertIn("speed\\_max (m/s) & a|b \\\\\n\\midrule\n0.1 & (1.2 $\\pm$ 0.1) $\\times$ 10$^{-7}$ \\\\\n", study_text.as_latex(head, rows))
        self.assertEqual(study_text.latex_text("50 % & m² \\ #"), "50 \\% \\& m$^{2}$ \\textbackslash{} \\#")

    def test_holms_correction(self):
        # Least first: 4 · 0.005, 3 · 0.01, 2 · 0.03, and 0.04, which may not be below the one before.
        self.assertEqual([round(p, 4) for p in plot_study.holm([0.01, 0.04, 0.03, 0.005])], [0.03, 0.06, 0.06, 0.02])
        self.assertEqual(plot_study.holm([0.9, 0.8]), [1.0, 1.0])
        self.assertEqual(plot_study.holm([]), [])

    def test_a_comparison_says_what_is_larger(self):
        self.assertEqual(plot_study.verdict("speed", "1", "2", 0.5, 0.01, 0.9), "larger with speed=2 than with 1")
        self.assertEqual(plot_study.verdict("speed", "1", "2", -0.5, 0.01, -0.9), "larger with speed=1 than with 2")
        self.assertEqual(plot_study.verdict("speed", "1", "2", 0.5, 0.06, 0.9), "no difference shown: speed=2 less 1")
        self.assertIn("disagree", plot_study.verdict("speed", "1", "2", 0.5, 0.01, -0.1))


class Plot(StudyCase):
    def test_a_study_becomes_pictures_and_a_report(self):
        (self.folder / "study.xml").write_text(f"""<study experiment="{CONFIGS}/diffusion_10.xml" ticks="40" seeds="1-6">
          <factor id="robots" path="arena.distribute.quantity" values="3 6"/>
          <factor id="speed" path="controllers.diffusion.parameters.velocity" values="0.05 0.1"/>
          <metrics every="10"><distance id="way"/><coverage id="seen" cell="0.5"/><trajectories id="ways"/></metrics></study>""")
        self.command("sweep", "study.xml", "--output", "out", "--quiet")
        done = self.command("plot", "out", "--compare", "speed=0.05,0.1")
        self.assertEqual(done.stderr, "")
        # Twice as fast, twice as far: in all 12 pairs.
        self.assertRegex(done.stdout, r"way.mean: larger with speed=0.1 than with 0.05 by 0\.[12]\d* ± \S+ m in 12 pairs; p = 0.00098 "
                                      r"\(Wilcoxon, Holm's correction for 2 tests\), effect \+1.00")
        one = self.command("plot", "out", "--compare", "robots=3,6", "--metric", "way.mean", "--output", "one")
        self.assertRegex(one.stdout, r"way.mean: (no difference shown: robots=6 less 3 is \S+ ± \S+ m|larger with .* m) in 12 pairs; p \S+ \S+ \(Wilcoxon\), effect")
        pictures = sorted(path.name for path in (self.folder / "out/pictures").glob("*.svg"))
        for name in ("way.mean_over_robots.svg", "way.mean_boxes_speed.svg", "way.mean_over_robots_and_speed.svg", "way.mean_over_time.svg", "ways_0-1.svg", "seen_visits_3.svg"):
            self.assertIn(name, pictures)
        for name in pictures:
            xml.parse(self.folder / "out/pictures" / name)
        report = (self.folder / "out/pictures/report.html").read_text()
        self.assertEqual(report.count("<figure>"), len(pictures))
        self.assertIn("<th>speed (m/s)</th><th>runs</th><th>way.mean (m)</th><th>seen</th>", report)
        self.assertIn(">way.mean (m)<", re.sub(r"<!-- (.*?) -->", r">\1<", report), "axes have units")
        table = (self.folder / "out/pictures/table.md").read_text()
        self.assertIn("| robots | speed (m/s) | runs | way.mean (m) | seen |\n|---|", table)
        self.assertRegex(table, r"\n\| 3 \| 0.05 \| 6 \| 0\.\d+ ± 0\.\d+ \|")
        self.assertIn("robots & speed (m/s) & runs & way.mean (m) & seen", (self.folder / "out/pictures/table.tex").read_text())
        for outside in ('src="', '<link', "@import", "<script"):
            self.assertNotIn(outside, report)
        code, seen = run_on_a_terminal([SWARMANOID, "plot", "out", "--compare", "speed=0.05,0.1", "--output", "again"], self.folder)
        self.assertEqual(code, 0, seen)
        self.assertRegex(seen, r"\rdrawing: \d+ %")
        self.assertEqual(report, (self.folder / "again/report.html").read_text())
        with contextlib.closing(sqlite3.connect(self.folder / "out/study.sqlite")) as database, database:
            database.execute("UPDATE samples SET time_s = time_s + 1 WHERE point = 1 AND seed = 2")
        self.assertIn("is damaged: the result of run 1-2 does not fit its checksum; `swarmanoid sweep out --resume` computes it again",
                      self.command("plot", "out", code=2).stderr)

    def test_pictures_over_time_say_how_many_runs_go_on(self):
        # Runs of 25, 40 and 60 ticks: of robots=3, three runs go on until 25 ticks, two until 40 and one until 60.
        (self.folder / "study.xml").write_text(f"""<study experiment="{CONFIGS}/diffusion_10.xml">
          <factor id="robots" path="arena.distribute.quantity" values="3 6"/>
          <factor id="length" path="framework.maxclock" values="25 40 60"/>
          <metrics every="10"><distance id="way"/></metrics></study>""")
        self.command("sweep", "study.xml", "--output", "out", "--quiet")
        study = plot_study.Study(self.folder / "out")
        for ended, last, told in (("hold", 6, "keep their last value"), ("stop", 2, "the first of its runs ends")):
            figure, caption = plot_study.over_time(study, "way.mean", "robots", ended)
            self.assertIn(told, caption)
            above, below = figure.axes
            self.assertAlmostEqual(above.lines[0].get_xdata()[-1], last, msg=ended)
            alive = dict(zip(np.round(below.lines[0].get_xdata(), 6), below.lines[0].get_ydata()))
            self.assertEqual({time: alive[time] for time in (0, 2, 2.5, 4)}, {0: 3, 2: 3, 2.5: 3, 4: 2})
            self.assertEqual((max(alive), alive[max(alive)]), (6, 0), "the last run ends")
            self.command("plot", "out", "--ended", ended, "--format", "png", "--output", ended)
            self.assertTrue((self.folder / ended / "way.mean_over_time.png").is_file())
        # With one row a run there is no time before the end.
        (self.folder / "study.xml").write_text((self.folder / "study.xml").read_text().replace(' every="10"', ""))
        self.command("sweep", "study.xml", "--output", "ends", "--quiet")
        self.assertFalse(plot_study.Study(self.folder / "ends").has_time)

    def test_a_search_becomes_its_course(self):
        (self.folder / "study.xml").write_text(f"""<study experiment="{CONFIGS}/diffusion_10.xml" ticks="30" seeds="1-2">
          <factor id="speed" path="controllers.diffusion.parameters.velocity" from="0.01" to="0.2"/>
          <factor id="robots" path="arena.distribute.quantity" from="1" to="5" step="1"/>
          <metrics><distance id="way" aggregate="sum"/><coverage id="seen" cell="0.5"/></metrics>
          <search metric="way.sum" goal="min" aggregate="max" runs="24" algorithm="sbplx" fresh_seeds="3"/></study>""")
        told = self.command("sweep", "study.xml", "--output", "out", "--quiet").stdout
        found = plot_search.Search(plot_study.Study(self.folder / "out"))
        self.assertEqual(f"best: point {found.best}, ", told[told.index("best:"):][:len(f"best: point {found.best}, ")])
        self.assertEqual(len(found.points), 12)
        self.assertEqual(list(found.best_so_far), sorted(found.best_so_far, reverse=True))
        self.assertAlmostEqual(found.best_so_far[-1], float(told.split("(max of 2 seeds): ")[1].split()[0]), delta=1e-5)
        self.assertEqual(len(found.fresh), 3)
        self.command("plot", "out")
        pictures = sorted(path.name for path in (self.folder / "out/pictures").glob("*.svg"))
        self.assertEqual([name for name in pictures if "visits" not in name],
                         ["way.sum_search.svg", "way.sum_tried_robots.svg", "way.sum_tried_speed.svg", "way.sum_tried_speed_and_robots.svg"])
        for name in pictures:
            xml.parse(self.folder / "out/pictures" / name)

    def test_what_is_wrong_is_told(self):
        (self.folder / "study.xml").write_text(f"""<study experiment="{CONFIGS}/diffusion_10.xml" ticks="5">
          <metrics><distance id="way"/></metrics></study>""")
        self.command("sweep", "study.xml", "--output", "out", "--quiet")
        self.assertIn("no column 'wy'; it has: way.mean", self.command("plot", "out", "--metric", "wy", code=2).stderr)
        self.assertIn("is no folder of a study", self.command("plot", self.folder, code=2).stderr)
        self.assertIn("write FACTOR=A,B", self.command("plot", "out", "--compare", "speed", code=2).stderr)
        (self.folder / "curves.json").write_text('[{"metric": "way.mean", "name": "theirs", "x": [1], "y": []}]')
        self.assertIn("of the same length", self.command("plot", "out", "--reference", "curves.json", code=2).stderr)
