"""Entities that are added and removed while an experiment runs: the same in one process and in a cluster, and over a
checkpoint."""
from harness import CONFIGS, LauncherTest, main

ENGINES = {
    "dummy_engine": "<dummy_engine id=\"ground\"><perpendicular_axis>z</perpendicular_axis><distance>0</distance></dummy_engine>",
    "dynamics2d": "<dynamics2d id=\"ground\"><perpendicular_axis>z</perpendicular_axis><distance>0</distance></dynamics2d>",
    "dynamics3d": "<dynamics3d id=\"ground\"><step_ms>10</step_ms></dynamics3d>",
}


class Reserve(LauncherTest):
    def experiment(self, engine):
        text = (CONFIGS / "prey_supply.xml").read_text()
        start, end = text.index("<engines>") + len("<engines>"), text.index("</engines>")
        path = self.folder / f"supply_{engine}.xml"
        path.write_text(text[:start] + ENGINES[engine] + text[end:])
        return path

    def go(self, experiment, output, *options):
        run = self.run_it("run", experiment, "--quiet", "--ticks", 600, "--output", output, "--hash-log", f"{output}.txt",
                          *options)
        self.assertEqual(run.process.returncode, 0, run.stderr)
        self.assert_finished(run)
        return (self.folder / f"{output}.txt").read_text()

    def test_clusters_and_one_process_agree_at_every_tick(self):
        for engine in ENGINES:
            with self.subTest(engine):
                experiment = self.experiment(engine)
                alone = self.go(experiment, f"{engine}_alone", "--single-process")
                cluster = self.go(experiment, f"{engine}_cluster", "--controller-hosts", 2)
                self.assertEqual(alone, cluster)
                events = (self.folder / f"{engine}_alone" / "supply.csv").read_text()
                self.assertEqual(events, (self.folder / f"{engine}_cluster" / "supply.csv").read_text())
                self.assertIn("added,late_1", events)
                self.assertGreaterEqual(events.count("added,prey"), 5)
                self.assertIn("delivered", events)

    def test_a_checkpoint_holds_who_is_there(self):
        experiment = self.experiment("dummy_engine")
        whole = self.go(experiment, "whole", "--single-process", "--checkpoint-every", 300)
        rest = self.go(experiment, "rest", "--restore", self.folder / "whole" / "checkpoint-00000300")
        self.assertEqual(whole.splitlines()[-250:], rest.splitlines()[-250:])

    def test_only_those_who_are_there_are_shown(self):
        self.go(self.experiment("dummy_engine"), "shown", "--single-process")
        lines = (self.folder / "shown" / "positions.txt").read_text().splitlines()
        self.assertEqual([line for line in lines if line.startswith("0\t") and ("late" in line or "prey" in line)], [])
        self.assertEqual(len([line for line in lines if line.startswith("600\t") and "late" in line]), 2)


if __name__ == "__main__":
    main()
