"""Entities that are added and removed while an experiment runs: the same in one process and in a cluster, and over a
checkpoint."""

from harness import CONFIGS, GENEROUS_S, LauncherTest

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

    def go(self, experiment, output, *options, ticks=600):
        run = self.run_it("run", experiment, "--quiet", "--ticks", ticks, "--output", output, "--hash-log", f"{output}.txt",
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

    def control(self, *words, code=0):
        answer = self.run_it("control", *words)
        self.assertEqual(answer.process.returncode, code, answer.stderr)
        return answer.stdout if code == 0 else answer.stderr

    def shown(self, table):
        """Who is in the last picture of a table of ids."""
        lines = [line.split("\t") for line in (self.folder / table).read_text().splitlines() if not line.startswith("#")]
        return {entity for tick, _, entity in lines if tick == lines[-1][0]}

    def test_users_add_and_remove(self):
        run = self.start("run", CONFIGS / "prey_supply.xml", "--quiet", "--paused", "--ticks", 400, "--no-visualisers", "--output",
                         "asked", "--hash-log", "asked.txt", "--checkpoint-every", 100)
        self.wait_for_experiment("prey_supply")
        self.assertEqual(self.control("add", "prey", "0.3,2.6,0"), "prey_supply: added 'prey_0' at tick 0\n")
        self.assertIn("'prey_1' does not fit at 0.35, 2.6, 0: the cylindric_prey 'prey_0' stands there, at 0.3, 2.6, 0",
                      self.control("add", "prey", "0.35,2.6,0", code=2))
        self.assertIn("outside the arena", self.control("add", "prey", "5,0.5,0", code=2))
        self.assertIn("reserves are: late, prey", self.control("add", "pray", "1,1,0", code=2))
        self.assertIn("'late_0' is not in the arena", self.control("move", "late_0", "1,1,0", code=2))
        self.assertIn("did you mean 'fb_1'?", self.control("remove", "fb1", code=2))
        self.control("step", 30)
        self.assertEqual(self.control("prey_supply", "add", "late", "2.5,2.5,0,0,0,180"), "prey_supply: added 'late_0' at tick 30\n")
        self.assertEqual(self.control("remove", "fb_1"), "prey_supply: removed 'fb_1' at tick 30\n")
        self.assertIn("'fb_1' is not in the arena", self.control("remove", "fb_1", code=2))
        # Who comes late sees those who are there, and no other.
        watcher = self.start("attach", "text", "--file", "late.txt", "--columns", "clock,Entity id", "--entities",
                             "footbot,cylindric_prey", "--output", self.folder)
        expected = {"fb_0", "fb_2", "late_0", "prey_0"}
        self.wait_until("a table of those who are there",
                        lambda: (self.folder / "late.txt").exists() and self.shown("late.txt") == expected)
        self.control("resume")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(watcher.wait(GENEROUS_S), 0, watcher.stderr)
        events = (self.folder / "asked" / "events.csv").read_text()
        self.assertRegex(events, "\n0,add,prey_0,0.3 2.6 0,")
        self.assertRegex(events, "\n30,remove,fb_1,,")

        # Again in one process; and from a checkpoint after it all, as a cluster.
        self.go(CONFIGS / "prey_supply.xml", "again", "--single-process", "--no-visualisers", "--events",
                self.folder / "asked" / "events.csv", ticks=400)
        asked = (self.folder / "asked.txt").read_text()
        self.assertEqual((self.folder / "again.txt").read_text(), asked)
        rest = self.go(self.folder / "asked" / "experiment.xml", "rest", "--no-visualisers", "--restore",
                       self.folder / "asked" / "checkpoint-00000100", ticks=400)
        self.assertEqual(rest.splitlines()[-250:], asked.splitlines()[-250:])

    def test_only_those_who_are_there_are_shown(self):
        self.go(self.experiment("dummy_engine"), "shown", "--single-process")
        lines = (self.folder / "shown" / "positions.txt").read_text().splitlines()
        self.assertEqual([line for line in lines if line.startswith("0\t") and ("late" in line or "prey" in line)], [])
        self.assertEqual(len([line for line in lines if line.startswith("600\t") and "late" in line]), 2)
