"""The statistics of tests/bench/beside_argos3, and its scenes here; ARGoS3 is not needed."""
import importlib.util
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from importlib.machinery import SourceFileLoader

sys.dont_write_bytecode = True
from two_samples import Difference, Sample, holm, incomplete_beta, spread_p, student_p, student_quantile  # noqa: E402

SCRIPT = pathlib.Path(__file__).resolve().parent / "beside_argos3"
beside = importlib.util.module_from_spec(importlib.util.spec_from_loader("beside_argos3", SourceFileLoader("beside_argos3", str(SCRIPT))))
beside.__loader__.exec_module(beside)
BUILD = pathlib.Path(sys.argv.pop()) if len(sys.argv) > 1 else None


def normal(mean, deviation, count, seed):
    numbers = random.Random(seed)
    return [numbers.gauss(mean, deviation) for _ in range(count)]


class Statistics(unittest.TestCase):
    def test_the_incomplete_beta_function_has_closed_forms(self):
        for x in (0, 0.01, 0.3, 0.5, 0.9, 1):
            self.assertAlmostEqual(incomplete_beta(1, 1, x), x, places=12)
            self.assertAlmostEqual(incomplete_beta(3, 1, x), x**3, places=12)
            self.assertAlmostEqual(incomplete_beta(1, 4, x), 1 - (1 - x) ** 4, places=12)
            self.assertAlmostEqual(incomplete_beta(0.5, 0.5, x), 2 / math.pi * math.asin(math.sqrt(x)), places=12)

    def test_students_quantiles_are_those_of_tables(self):
        for degrees, quantile in ((1, 12.7062), (4, 2.7764), (9, 2.2622), (99, 1.9842), (1e6, 1.95996)):
            self.assertAlmostEqual(student_quantile(degrees), quantile, places=4)
        # One degree of freedom is Cauchy's distribution.
        self.assertAlmostEqual(student_p(1, 1), 0.5, places=12)

    def test_welch_of_a_worked_example(self):
        # Values by scipy.stats.ttest_ind(equal_var=False).
        difference = Difference(Sample([27.5, 21.0, 19.0, 23.6, 17.0, 17.9]), Sample([27.1, 22.0, 20.8, 23.4, 23.4, 23.5, 25.8, 22.0]))
        self.assertAlmostEqual(difference.value, -2.5, places=9)
        self.assertAlmostEqual(difference.p, 0.20198867735, places=9)

    def test_samples_without_spread(self):
        self.assertEqual(Difference(Sample([2, 2]), Sample([2, 2])).p, 1)
        self.assertEqual(Difference(Sample([2, 2]), Sample([3, 3])).p, 0)
        self.assertEqual(spread_p(Sample([2, 2, 2]), Sample([3, 3, 3])), 1)
        with self.assertRaisesRegex(ValueError, "at least two values, and has 1"):
            Sample([1])

    def test_intervals_hold_the_mean_as_often_as_they_say(self):
        held = sum(abs(sample.mean - 5) < sample.half_width() for sample in (Sample(normal(5, 2, 10, seed)) for seed in range(1000)))
        self.assertAlmostEqual(held / 1000, 0.95, delta=0.02)

    def test_equal_distributions_seldom_differ(self):
        pairs = [(Sample(normal(1, 1, 40, seed)), Sample(normal(1, 1, 40, seed + 10000))) for seed in range(1000)]
        self.assertAlmostEqual(sum(Difference(*pair).p < 0.05 for pair in pairs) / 1000, 0.05, delta=0.02)
        self.assertAlmostEqual(sum(spread_p(*pair) < 0.05 for pair in pairs) / 1000, 0.05, delta=0.02)

    def test_a_difference_of_means_or_spreads_is_found(self):
        self.assertLess(Difference(Sample(normal(1, 1, 100, 1)), Sample(normal(2, 1, 100, 2))).p, 1e-6)
        self.assertLess(spread_p(Sample(normal(1, 1, 100, 1)), Sample(normal(1, 2, 100, 2))), 1e-4)

    def test_holm(self):
        # Holm (1979): the least is multiplied by the number of tests, and the order stays.
        self.assertEqual([round(p, 9) for p in holm([0.01, 0.04, 0.03, 0.005])], [0.03, 0.06, 0.06, 0.02])
        self.assertEqual(holm([0.9, 0.8]), [1.0, 1.0])
        self.assertEqual(holm([]), [])


class Table(unittest.TestCase):
    def measured(self, ours):
        return {"foraging": {"ARGoS3": {"items": normal(10, 2, 50, 1), beside.SPEED: [100.0] * 50},
                             "here": {"items": ours, beside.SPEED: [2000.0] * 50}}}

    def test_what_agrees_and_what_differs(self):
        text, agree, rows = beside.table(self.measured(normal(10, 2, 50, 3)))
        self.assertEqual((agree, rows), (1, 1))
        self.assertRegex(text, r"\| foraging \| items \| .* ± .* \(.*\) \| .* ± .* % \| yes \| 20 times \|")
        self.assertIn("| no: mean |", beside.table(self.measured(normal(13, 2, 50, 2)))[0])
        self.assertIn("| no: spread |", beside.table(self.measured(normal(10, 8, 50, 4)))[0])

    def test_speeds_of_crowds(self):
        values = {"ARGoS3": [50.0, 51.0, 49.0], "dynamics2d": [1000.0, 900.0, 5000.0], "dummy_engine": [5000.0]}
        self.assertIn("| diffusion, 1,000 | `dynamics2d` | 50 | 1,000 (20 times) | 5,000 (100 times) |",
                      beside.speed_table({("diffusion, 1,000", "dynamics2d"): values}))
        # A file whose engine has no kinematic counterpart.
        values = {"ARGoS3": [2.0], "dynamics3d": [50.0]}
        self.assertIn("| diffusion, 100 | `pointmass3d` | 2 | 50 (25 times) |  |", beside.speed_table({("diffusion, 100", "pointmass3d"): values}))

    def test_only_the_engine_differs_for_the_kinematic_engine(self):
        rows = {row.name: row for row in beside.speed_rows() if row.engine == "dynamics2d"}
        row = rows["all devices, 1,000"]
        self.assertEqual(row.text_of("dynamics2d"), row.text)
        self.assertEqual(row.text_of("dummy_engine").replace("<dummy_engine ", "<dynamics2d "), row.text)
        self.assertIn("<dummy_engine ", row.text_of("dummy_engine"))

    def test_crowds_have_a_square_metre_for_each_robot(self):
        root = xml.etree.ElementTree.fromstring(beside.crowd("pointmass3d", 100, 20))
        self.assertEqual([box.get("size") for box in root.iter("box")], ["0.1,10,0.5", "0.1,10,0.5", "10,0.1,0.5", "10,0.1,0.5"])
        self.assertEqual(root.find("arena/distribute/entity").get("quantity"), "100")
        self.assertEqual(root.find("framework/experiment").get("length"), "20")
        self.assertIsNotNone(root.find("physics_engines/pointmass3d"))


class Messages(unittest.TestCase):
    def call(self, *words):
        return subprocess.run([sys.executable, SCRIPT, "--build", BUILD, *words], capture_output=True, text=True, env={"PATH": "/nowhere"})

    def test_argos3_must_be_there(self):
        self.assertIn("ARGoS3 was not found: give the folder", self.call("--statistics").stderr)
        done = self.call("--statistics", "--argos3", "/nowhere")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/nowhere/bin/argos3 is not there; --argos3 or ARGOS3_PREFIX", done.stderr)

    def test_examples_must_be_built(self):
        with tempfile.TemporaryDirectory() as folder:
            for needed in ("bin/argos3", "include/argos3/core/simulator/loop_functions.h"):
                path = pathlib.Path(folder) / needed
                path.parent.mkdir(parents=True, exist_ok=True)
                path.touch()
            done = self.call("--speed", "--argos3", folder, "--examples", "/nowhere", "/nowhere")
        self.assertEqual(done.returncode, 1)
        self.assertIn("libfootbot_foraging.so is not there; --examples takes two build folders", done.stderr)

    def test_wrong_options(self):
        self.assertIn("give --statistics or --speed", self.call().stderr)
        self.assertIn("--seeds 2: the comparison of spreads needs at least 3", self.call("--statistics", "--seeds", "2").stderr)


class Scenes(unittest.TestCase):
    def test_each_scene_runs_here_and_writes_its_quantities(self):
        here = beside.Here(BUILD)
        with tempfile.TemporaryDirectory() as folder:
            for row in beside.speed_rows():
                if row.name in ("diffusion, 100", "all devices, 1,000"):
                    for engine in row.ours:
                        text = re.sub(r'length="\d+"', 'length="1"', row.text_of(engine))
                        self.assertGreater(beside.run_one(here, text, 7, folder)[beside.SPEED], 0, row.name)
            for name in beside.SCENES:
                text = re.sub(r'length="\d+"', 'length="3"', beside.scene(name))
                values = beside.run_one(here, text, 7, folder)
                self.assertGreater(len(values), 4, name)
                self.assertGreater(values[beside.SPEED], 0)
                self.assertEqual(beside.run_one(here, text, 7, folder).keys(), values.keys())


if __name__ == "__main__":
    unittest.main()
