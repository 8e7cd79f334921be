"""Users reset a run: it begins again at tick 0, and is what a new run with that seed would be."""
import csv
import json
import os
import signal

from harness import CONFIGS, LauncherTest

EXPERIMENT = CONFIGS / "diffusion_10.xml"
TICKS = 600


class Resets(LauncherTest):
    def begin(self, *options):
        run = self.start("run", EXPERIMENT, "--ticks", TICKS, "--paused", "--hash-log", "cluster", "--output", "out", *options)
        self.wait_for_experiment("diffusion_10")
        return run

    def await_reset(self, run, number):
        """Until the run goes by the name of the next one: who asks earlier may ask the one that ends."""
        said = run.read_until(f"reset-{number}")
        return said + run.read_until("paused")

    def resume(self, run):
        """However late the space server is there, and however soon the run has ended."""
        self.wait_until("the run to go on", lambda: run.process.poll() is not None or self.run_it("control", "resume").process.returncode == 0)

    def assert_fresh(self, run, seed, number, said=""):
        """The last run has the bits of a new one with the seed."""
        one = self.run_it("run", EXPERIMENT, "--ticks", TICKS, "--seed", seed, "--single-process", "--quiet", "--hash-log", "one", "--output", "one_out")
        self.assertEqual(run.wait(), 0, said + run.stderr)
        self.assertEqual(self.assert_finished(run, TICKS), self.assert_finished(one, TICKS))
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        last = self.folder / f"out/reset-{number}"
        self.assertEqual((last / "positions.txt").read_bytes(), (self.folder / "one_out/positions.txt").read_bytes())
        self.assertEqual(json.loads((last / "manifest.json").read_text())["seed"], seed)
        self.assert_nothing_left(run)

    def events(self, folder):
        with (self.folder / folder / "events.csv").open() as file:
            return [(int(row["tick"]), row["request"], row["entity"]) for row in csv.DictReader(file)]

    def test_with_other_seeds_and_the_same_one(self):
        run = self.begin("--controller-hosts", 2)
        self.control("step", 100)
        watcher = self.start("attach", "text", "--file", "table", "--output", self.folder)
        self.wait_until("a table", lambda: self.has_table("table"))
        self.assertIn("reset at tick 100: it begins again with seed 9", self.control("reset", "--seed", 9))
        said = self.await_reset(run, 1)
        self.control("step", 70)
        self.assertIn("with seed 9", self.control("reset"))
        said += self.await_reset(run, 2)
        self.resume(run)
        self.assertEqual(watcher.wait(), 0, watcher.stderr)
        self.assert_fresh(run, 9, 2, said)
        self.assertIn(f"\n{TICKS}\t", (self.folder / "table").read_text())
        self.assertEqual(run.stdout.count("finished:"), 1)
        # Each of the runs is whole.
        self.assertEqual(self.events("out"), [(0, "step", ""), (100, "reset", "9")])
        self.assertEqual(self.events("out/reset-1"), [(0, "step", ""), (70, "reset", "9")])
        manifest = json.loads((self.folder / "out/manifest.json").read_text())
        self.assertEqual((manifest["ticks"], manifest["exit_code"]), (100, 0))
        manifest = json.loads((self.folder / "out/reset-2/manifest.json").read_text())
        self.assertEqual(manifest["reset_of"], {"run": str(self.folder / "out/reset-1"), "tick": 70, "paused": True, "real_time_factor": 0})
        for folder, states in (("out", 101), ("out/reset-1", 71), ("out/reset-2", TICKS + 1)):
            verified = self.run_it("replay", folder, "--verify")
            self.assertIn(f"equal: {states} states", verified.stdout, verified.stderr)
        # Who repeats the first run comes as far as it did, and no farther.
        again = self.run_it("run", EXPERIMENT, "--ticks", TICKS, "--events", "out/events.csv", "--output", "again")
        self.assertEqual(self.assert_finished(again, 100), manifest_hash(self.folder / "out"))
        self.assertFalse((self.folder / "again/reset-1").exists())

    def test_processes_die_after_it(self):
        run = self.begin()
        self.control("step", 100)
        self.control("reset", "--seed", 4)
        said = self.await_reset(run, 1)
        self.control("step", 300)
        server = run.find("space_server")
        os.kill(server, signal.SIGKILL)
        said += run.read_until("all processes start again where the journal ends")
        self.resume(run)
        self.assert_fresh(run, 4, 1, said)

    def test_the_server_dies_when_it_has_written_it_down(self):
        """Who goes on with the run finds the request in its events, and obeys."""
        run = self.begin()
        self.control("step", 100)
        server = run.find("space_server")
        with (self.folder / "out/events.csv").open("a") as file:
            file.write("100,reset,5,,somebody@here:1,1,,\n")
        os.kill(server, signal.SIGKILL)
        said = self.await_reset(run, 1)
        self.resume(run)
        self.assert_fresh(run, 5, 1, said)

    def test_from_a_checkpoint_and_without_a_journal(self):
        first = self.run_it("run", EXPERIMENT, "--ticks", 200, "--checkpoint-every", 100, "--quiet", "--output", "first")
        self.assertEqual(first.process.returncode, 0, first.stderr)
        run = self.begin("--restore", "first/checkpoint-00000100", "--no-journal")
        self.control("step", 50)
        self.control("reset")
        said = self.await_reset(run, 1)
        self.resume(run)
        self.assert_fresh(run, 1, 1, said)

    def test_who_would_not_begin_again_says_so(self):
        run = self.begin()
        answer = self.run_it("control", "reset", "7")
        self.assertEqual(answer.process.returncode, 2)
        self.assertIn("write reset [--seed N]", answer.stderr)
        answer = self.run_it("control", "stop", "--seed", "7")
        self.assertEqual(answer.process.returncode, 2)
        self.assertIn("stop: it takes no 'seed'; write stop", answer.stderr)
        self.control("stop")
        self.assertEqual(run.wait(), 0, run.stderr)


def manifest_hash(folder):
    return json.loads((folder / "manifest.json").read_text())["state_hash"]
