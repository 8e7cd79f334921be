"""Runs with loop functions of ARGoS3, which need one process: they are watched, steered and reset from outside as clusters are."""
import os
import pathlib
import re
import unittest

from harness import GENEROUS_S, LauncherTest

ARGOS3 = pathlib.Path(__file__).resolve().parent.parent / "argos3"
LIBRARIES = pathlib.Path(os.environ["SWARMANOID_BUILD"]) / "tests/argos3/libraries"
COLLECT = ARGOS3 / "collect.argos"


class LoopFunctions(LauncherTest):
    def setUp(self):
        super().setUp()
        os.environ["ARGOS_PLUGIN_PATH"] = str(LIBRARIES)

    def begin(self, *options, file=COLLECT):
        run = self.start("run", file, "--quiet", *options)
        self.wait_for_experiment(file.stem)
        return run

    def has_robots(self, table):
        path = self.folder / table
        return path.exists() and "fb_1" in path.read_text()

    def test_a_table_that_comes_and_goes_changes_nothing(self):
        plain = self.run_it("run", COLLECT, "--quiet", "--single-process", "--hash-log", "plain", "--output", "plain_out")
        run = self.begin("--paused", "--hash-log", "hashes", "--output", "out")
        watchers = [self.start("attach", "text", "--file", f"table_{k}", "--output", self.folder, "--status") for k in range(2)]
        for k in range(2):
            self.wait_until(f"table {k}", lambda k=k: self.has_robots(f"table_{k}"))
        self.assertEqual(self.control("step", 50).strip(), "collect: paused at tick 50")
        watchers[1].process.kill()
        self.control("resume")
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        self.assertEqual(watchers[0].wait(GENEROUS_S), 0, watchers[0].stderr)
        self.assertEqual(self.assert_finished(run), self.assert_finished(plain))
        self.assertEqual((self.folder / "hashes").read_text(), (self.folder / "plain").read_text())
        self.assertIn("paused", (self.folder / "table_0").read_text())
        self.assert_nothing_left(run)

    def test_requests_are_logged_and_repeated_with_the_same_hash(self):
        run = self.begin("--paused", "--output", "first")
        self.control("step", 20)
        self.control("move", "fb_0", "2.5,3,0")
        self.control("resume")
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        moved = self.assert_finished(run)
        events = (self.folder / "first/events.csv").read_text()
        self.assertRegex(events, r"\n20,move,fb_0")
        again = self.run_it("run", COLLECT, "--quiet", "--events", self.folder / "first/events.csv", "--output", "again")
        self.assertEqual(self.assert_finished(again), moved)

    def test_visualisers_follow_a_reset(self):
        run = self.begin("--paused", "--ticks", 30, "--output", "out")
        watcher = self.start("attach", "text", "--file", "table", "--output", self.folder, "--csv", "--columns", "clock,Entity id,X")
        self.wait_until("a table", lambda: self.has_robots("table"))
        ticks = lambda: [line.split(",")[0] for line in (self.folder / "table").read_text().splitlines()[1:]]
        self.control("step", 20)
        self.wait_until("tick 20", lambda: "20" in ticks())
        self.control("reset")
        self.wait_until("the next run", lambda: (self.folder / "out/reset-1/manifest.json").exists())
        self.wait_for_experiment("collect")
        # The second run begins at tick 0 and ends at 30. It may end only when the visualiser is attached to it.
        self.wait_until("its first state", lambda: "0" in ticks()[ticks().index("20"):])
        self.control("resume")
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        self.assertEqual(watcher.wait(GENEROUS_S), 0, watcher.stderr)
        self.assertEqual(ticks()[-1], "30")
        self.assert_nothing_left(run)

    def test_a_run_that_fails_tells_its_visualisers(self):
        # Init of the loop functions needs the element.
        (self.folder / "failing.argos").write_text(COLLECT.read_text().replace('<home x="-0.5"/>', ""))
        run = self.begin("--paused", file=self.folder / "failing.argos")
        watcher = self.start("attach", "text", "--file", "table", "--output", self.folder)
        self.wait_until("a table", lambda: self.has_robots("table"))
        self.control("resume")
        self.assertEqual(run.wait(GENEROUS_S), 3, run.stderr)
        self.assertEqual(watcher.wait(GENEROUS_S), 4)
        for said in (run.stderr, watcher.stderr):
            self.assertRegex(said, r"(?m)(^|: )(\S*/)?failing\.argos:16:3: <loop_functions> has no <home>")
        self.assert_nothing_left(run)

    def test_grants_and_two_runs_of_one_experiment(self):
        first, second = self.begin("--paused"), self.begin("--paused")
        self.wait_until("both", lambda: self.run_it("list", "experiments").stdout.count("collect") == 2)
        domains = re.findall(r"domain (\d+)", self.run_it("list", "experiments").stdout)
        self.assertEqual(len(set(domains)), 2)
        token = self.run_it("share", "collect", "--domain", domains[0], "--watch")
        self.assertEqual(token.process.returncode, 0, token.stderr)
        for domain in domains:
            self.control("collect", "stop", "--domain", domain)
        for run in (first, second):
            self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)


if __name__ == "__main__":
    unittest.main()
