"""Processes of a run die, and others take their places: every tick has the hash of a run in one process that nobody disturbed."""
import os
import random
import shutil
import signal
import time

from harness import CONFIGS, LauncherTest, main

WORKERS = ["engine_worker", "controller_host", "visualiser"]
# Kills with a random moment each; by hand as many as one likes.
KILLS = int(os.environ.get("SWARMANOID_KILLS", "6"))
SEED = int(os.environ.get("SWARMANOID_KILLS_SEED", "1"))
REPLACED = "another process takes its place"


class RecoveryTest(LauncherTest):
    def undisturbed(self, experiment, ticks, *options):
        run = self.run_it("run", experiment, "--ticks", ticks, "--single-process", "--quiet", "--hash-log", "one", "--output", "one_out",
                          *options)
        return self.assert_finished(run, ticks)

    def assert_same(self, run, ticks, expected, said="", code=0):
        self.assertEqual(run.wait(), code, said + run.stderr)
        self.assertEqual(self.assert_finished(run, ticks), expected)
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        self.assert_nothing_left(run)

    def control(self, *words):
        answer = self.run_it("control", *words)
        self.assertEqual(answer.process.returncode, 0, answer.stderr)

    def alive(self, run, program, dead):
        """The process of the program that is not among those that died."""
        found = []
        self.wait_until(f"a new {program}", lambda: found.append(run.find(program)) or found[-1] not in dead, run)
        return found[-1]


class Once(RecoveryTest):
    def test_each_worker_while_the_run_is_paused(self):
        experiment = CONFIGS / "diffusion_10.xml"
        expected = self.undisturbed(experiment, 400)
        for program in WORKERS:
            with self.subTest(program):
                run = self.start("run", experiment, "--ticks", 400, "--paused", "--hash-log", "cluster", "--output", program)
                self.wait_for_experiment("diffusion_10")
                self.control("step", 250)
                pid = run.find(program)
                os.kill(pid, signal.SIGKILL)
                said = run.read_until(REPLACED)
                self.control("resume")
                self.assert_same(run, 400, expected, said)
                self.assertEqual((self.folder / program / "positions.txt").read_bytes(), (self.folder / "one_out/positions.txt").read_bytes())

    def test_all_workers_at_once(self):
        experiment = CONFIGS / "prey_retrieval.xml"
        ticks = 600
        expected = self.undisturbed(experiment, ticks, "--no-visualisers")
        run = self.start("run", experiment, "--ticks", ticks, "--paused", "--hash-log", "cluster", "--output", "out", "--no-visualisers")
        self.wait_for_experiment("prey_retrieval")
        self.control("step", 333)
        for program in WORKERS[:2]:
            os.kill(run.find(program), signal.SIGKILL)
        said = run.read_until(REPLACED) + run.read_until(REPLACED)
        self.control("resume")
        self.assert_same(run, ticks, expected, said, code=1)  # the prey is not in the nest yet

    def killed_once(self, fault, tick):
        """A run whose controller, which cannot be saved, is killed the first time that it gets there."""
        mark = self.folder / "killed"
        experiment = self.write_faulty(fault, tick)
        experiment.write_text(experiment.read_text().replace("</tick>", f"</tick><mark>{mark}</mark>"))
        mark.touch()
        expected = self.undisturbed(experiment, 300)
        mark.unlink()
        run = self.start("run", experiment, "--ticks", 300, "--hash-log", "cluster", "--output", "out")
        self.assert_same(run, 300, expected)
        return run.stderr

    def test_a_controller_that_cannot_be_saved_in_the_midst_of_its_step(self):
        self.assertIn("controller host 0 was killed by signal 9 (Killed), during robot 'robot_one', controller 'c': ControlStep at tick 150; "
                      + REPLACED, self.killed_once("step_killed_once", 150))

    def test_one_that_dies_after_the_last_tick_when_others_have_left(self):
        self.assertIn("Destroy at tick 299; " + REPLACED, self.killed_once("destroy_killed_once", 0))

    def test_one_that_is_stopped_for_longer_than_the_lease(self):
        experiment = CONFIGS / "diffusion_10.xml"
        expected = self.undisturbed(experiment, 400)
        run = self.start("run", experiment, "--ticks", 400, "--paused", "--hash-log", "cluster", "--output", "out", "--lease", 1)
        self.wait_for_experiment("diffusion_10")
        self.control("step", 120)
        os.kill(run.find("controller_host"), signal.SIGSTOP)
        said = run.read_until(REPLACED)
        self.control("resume")
        self.assert_same(run, 400, expected, said)


class GivingUp(RecoveryTest):
    def test_a_crash_that_comes_again_is_named(self):
        run = self.run_it("run", self.write_faulty("step_crashes", 7), "--output", "out")
        self.assertEqual(run.process.returncode, 4)
        told = "robot 'robot_one', controller 'c': ControlStep at tick 7 aborted"
        self.assertIn(f"{told}; {REPLACED}", run.stderr)
        self.assertIn(f"{told}; the log of controller host 0 is {self.folder}/out/controller_host-0.log", run.stderr)
        self.assertEqual(run.stderr.count(REPLACED), 1)

    def test_if_nobody_is_to_be_replaced(self):
        for options in (["--no-recovery"], ["--retries", 0], ["--no-journal"]):
            with self.subTest(options):
                run = self.start("run", CONFIGS / "diffusion_10.xml", "--ticks", 0, "--quiet", "--hash-log", "hashes", *options)
                pid = run.find("engine_worker")
                self.wait_for_tick("hashes", 100, run)
                os.kill(pid, signal.SIGKILL)
                self.assertEqual(run.wait(), 4)
                self.assertIn("engine 'ground' was killed by signal 9 (Killed)", run.stderr)
                os.unlink(self.folder / "hashes")


class Resumed(RecoveryTest):
    def test_after_all_were_killed_by_the_death_of_the_launcher(self):
        experiment = CONFIGS / "diffusion_10.xml"
        for moment in (20, 1500):
            with self.subTest(moment):
                out = f"out{moment}"
                run = self.start("run", experiment, "--ticks", 2000, "--paused", "--hash-log", "cluster", "--output", out, "--quiet",
                                 "--checkpoint-every", 400)
                self.wait_for_experiment("diffusion_10")
                self.control("step", 10)
                self.control("move", "fb_0", "1.5,1.3,0,0,0,91.25")
                self.control("step", moment - 10)
                self.control("remove", "fb_1")
                run.process.kill()
                run.wait()
                expected = self.undisturbed(experiment, 2000, "--events", f"{out}/events.csv")
                shutil.rmtree(self.folder / "one_out")
                again = self.run_it("resume", out, "--quiet")
                self.assertEqual(again.process.returncode, 0, again.stderr)
                self.assertRegex(again.stderr, "going on from tick 0\n" if moment < 100 else "going on from tick 1[2-5]00\n")
                self.assertEqual(self.assert_finished(again, 2000), expected)
                self.assert_nothing_left(again)


class Soak(RecoveryTest):
    def test_kills_and_stops_at_random_moments(self):
        seed = random.Random(SEED)
        ticks = 4000 + 3000 * KILLS
        experiment = CONFIGS / "diffusion_10.xml"
        expected = self.undisturbed(experiment, ticks, "--no-visualisers")
        run = self.start("run", experiment, "--ticks", ticks, "--hash-log", "cluster", "--output", "out", "--no-visualisers",
                         "--retries", 1000, "--lease", 10)
        self.wait_for_tick("cluster", 10, run)
        try:
            for _ in range(KILLS):
                # Mostly in the midst of ticks, else while others are still taking places.
                if seed.random() < 0.8:
                    written = (self.folder / "cluster").stat().st_size
                    self.wait_until("the next tick", lambda: (self.folder / "cluster").stat().st_size > written, run)
                time.sleep(seed.random() * 0.1)
                victims = seed.sample(WORKERS[:2], seed.choice([1, 1, 2]))
                stop = seed.random() < 0.1 and KILLS > 10  # each takes the lease
                for program in victims:
                    os.kill(run.find(program), signal.SIGSTOP if stop else signal.SIGKILL)
                for _ in victims:
                    run.read_until(REPLACED)
            self.assert_same(run, ticks, expected)
        except AssertionError as ended:
            # Who dies with a lock of shared memory takes the run along (docs/recovery.md): then it is resumed.
            self.assertIn("while it held shared memory of the run", str(ended))
            self.assertEqual(run.process.wait(60), 4)
            again = self.run_it("resume", "out", "--no-visualisers", "--quiet")
            self.assertEqual(self.assert_finished(again, ticks), expected)


if __name__ == "__main__":
    main()
