"""The benchmark of all that users run: what it says of aims, and that its rows can be measured and written."""
import csv
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest
from importlib.machinery import SourceFileLoader

sys.dont_write_bytecode = True

RUN = pathlib.Path(__file__).resolve().parent / "run"
run = importlib.util.module_from_spec(importlib.util.spec_from_loader("run", SourceFileLoader("run", str(RUN))))
run.__loader__.exec_module(run)
BUILD = sys.argv.pop()


def call(*words):
    return subprocess.run([sys.executable, RUN, "--build", BUILD, *words], capture_output=True, text=True)


class Verdicts(unittest.TestCase):
    FIGURES = {"one process": [90.0, 100.0, 110.0]}

    def test_least(self):
        aim = run.Aim("one process", 0.9, other="one process")
        self.assertEqual(aim.verdict(90, self.FIGURES), "0.9 times one process (aim 0.9: met)")
        self.assertEqual(aim.verdict(45, self.FIGURES), "0.45 times one process (aim 0.9: missed, 50 % of it)")

    def test_most(self):
        self.assertEqual(run.Aim("aim at most", most=0.5).verdict(0.4, {}), "aim at most 0.5: met")
        self.assertEqual(run.Aim("aim at most", most=0.5).verdict(1, {}), "aim at most 0.5: missed, 2.00 times it")

    def test_rows_that_were_not_asked_for_are_not_compared(self):
        self.assertEqual(run.Aim("one process", 0.9, other="one process").verdict(90, {}), "")
        self.assertEqual(run.Cost("a robot", 30, 1, "no sensors").verdict(90, {}), "")

    def test_cost_beyond_another_scene(self):
        self.assertEqual(run.Cost("a robot", 10, 1000, "one process").verdict(50, self.FIGURES), "10,000 ns a robot (aim 10: missed, 1000.00 times it)")


class Runs(unittest.TestCase):
    def test_a_part_is_measured_and_written(self):
        with tempfile.TemporaryDirectory() as folder:
            done = call("--part", "start", "--repetitions", "1", "--output", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            table = (pathlib.Path(folder) / "table.md").read_text()
            self.assertIn("| cluster of 4 processes: from the command to the first tick | ", table)
            with open(pathlib.Path(folder) / "figures.csv", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([row["unit"] for row in rows], ["s", "MB", "s", "s"])
            self.assertTrue(all(0 < float(row["run 1"]) for row in rows))

    def test_a_scene_beside_another_build(self):
        done = call("--previous", BUILD, "--only", "swarm in dynamics3d (50)", "--repetitions", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("times the previous", done.stdout)

    def test_what_is_not_there_is_named(self):
        done = call("--only", "no such row")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no row has 'no such row' in its name", done.stderr)
        done = subprocess.run([sys.executable, RUN, "--build", "/nowhere"], capture_output=True, text=True)
        self.assertIn("/nowhere/bin/swarmanoid is not there", done.stderr)


if __name__ == "__main__":
    unittest.main()
