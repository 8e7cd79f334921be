"""The studies of configs/ that stand beside published numbers agree with them."""
import json
import os
import pathlib
import statistics

from study_case import StudyCase

STUDIES = pathlib.Path(os.environ["SWARMANOID_CONFIGS"]) / "studies"


class Published(StudyCase):
    def test_random_walks_go_as_far_as_those_of_byers(self):
        self.command("sweep", STUDIES / "random_walk.xml", "--output", "out", "--only", "seed <= 4", "--quiet")
        moved = {}
        for row in self.table("out"):
            if row["tick"] == "2000":
                moved.setdefault(float(row["deviation"]), []).append(float(row["moved.mean"]))
        (curve,) = json.loads((STUDIES / "random_walk_reference.json").read_text())
        for deviation, published in zip(curve["x"], curve["y"]):
            self.assertEqual(len(moved[deviation]), 4)
            # 256 walks, whose distances deviate by 52 % as Rayleigh's do: three standard errors.
            self.assertAlmostEqual(statistics.fmean(moved[deviation]) / published, 1, delta=3 * 0.52 / 16)
