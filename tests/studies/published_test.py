"""The studies of configs/ that stand beside published numbers agree with them."""
import csv
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import tempfile
import unittest

SWARMANOID = os.environ["SWARMANOID"]
STUDIES = pathlib.Path(os.environ["SWARMANOID_CONFIGS"]) / "studies"


class Published(unittest.TestCase):
    def test_random_walks_go_as_far_as_those_of_byers(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="swarmanoid_published_"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        done = subprocess.run([SWARMANOID, "sweep", STUDIES / "random_walk.xml", "--output", folder / "out", "--only", "seed <= 4", "--quiet"],
                              capture_output=True, text=True, timeout=250)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        moved = {}
        with open(folder / "out/table.csv", newline="") as file:
            for row in csv.DictReader(file):
                if row["tick"] == "2000":
                    moved.setdefault(float(row["deviation"]), []).append(float(row["moved.mean"]))
        (curve,) = json.loads((STUDIES / "random_walk_reference.json").read_text())
        for deviation, published in zip(curve["x"], curve["y"]):
            self.assertEqual(len(moved[deviation]), 4)
            # 256 walks, whose distances deviate by 52 % as Rayleigh's do: three standard errors.
            self.assertAlmostEqual(statistics.fmean(moved[deviation]) / published, 1, delta=3 * 0.52 / 16)


if __name__ == "__main__":
    unittest.main()
