"""The launcher of a run is killed, or loses its terminal: all processes end in good order, and `resume` goes on with the same hash."""
import json
import os
import pty
import random
import shutil
import signal
import subprocess

from harness import CONFIGS, GENEROUS_S, SWARMANOID, LauncherTest, children_of, end, stat_of

EXPERIMENT = CONFIGS / "diffusion_10.xml"
# Kills with a random moment each. SWARMANOID_ORPHANS asks for more.
KILLS = int(os.environ.get("SWARMANOID_ORPHANS", "1"))
SEED = int(os.environ.get("SWARMANOID_KILLS_SEED", "1"))
TICKS = 2000


def is_gone(pid):
    stat = stat_of(pid)
    return stat is None or stat[2] == "Z"


class OrphanTest(LauncherTest):
    def begin(self, *options, experiment=EXPERIMENT):
        """A run that is paused at its first tick, and its processes."""
        run = self.start("run", experiment, "--ticks", TICKS, "--paused", "--hash-log", self.folder / "cluster", "--output",
                         self.folder / "out", "--quiet", *options)
        self.wait_for_experiment(experiment.stem)
        return run, children_of(run.process.pid)

    def kill(self, run, pids):
        run.process.kill()
        run.wait()
        self.assert_all_end(pids)

    def assert_all_end(self, pids):
        self.assertGreaterEqual(len(pids), 3)
        self.wait_until("the end of all processes", lambda: all(map(is_gone, pids)))

    def undisturbed(self):
        run = self.run_it("run", EXPERIMENT, "--ticks", TICKS, "--single-process", "--quiet", "--output", "one_out")
        return self.assert_finished(run, TICKS)

    def assert_resumed(self, expected, folder="out"):
        resumed = self.run_it("resume", folder, "--quiet")
        self.assertEqual(resumed.process.returncode, 0, resumed.stderr)
        self.assertNotIn("warning", resumed.stderr)
        self.assertEqual(self.assert_finished(resumed, TICKS), expected)
        self.assert_nothing_left(resumed)


class Killed(OrphanTest):
    def test_at_random_ticks(self):
        seed = random.Random(SEED)
        expected = self.undisturbed()
        for number in range(KILLS):
            moment = seed.randrange(1, TICKS - 300)
            with self.subTest(moment):
                run, pids = self.begin()
                # In the midst of ticks: the run is as quick as it can be.
                stepping = self.start("control", "step", TICKS - 200)
                self.wait_for_tick("cluster", moment, run)
                self.kill(run, pids)
                stepping.wait()
                # They end in good order: no run that comes after them has to tidy up.
                self.assert_nothing_left(run, pids)
                self.assert_resumed(expected)
                shutil.rmtree(self.folder / "out")
                os.unlink(self.folder / "cluster")

    def test_the_journal_and_the_files_of_visualisers_are_whole(self):
        run, pids = self.begin()
        self.control("step", 733)
        self.kill(run, pids)
        self.assert_nothing_left(run, pids)
        verified = self.run_it("replay", "out", "--verify")
        # The state in which the run was paused need not be in it.
        self.assertRegex(verified.stdout, "^equal: 73[34] states, computed again\n$", verified.stderr)
        expected = self.undisturbed()
        table = (self.folder / "out/positions.txt").read_text()
        self.assertTrue((self.folder / "one_out/positions.txt").read_text().startswith(table))
        self.assertRegex(table.splitlines()[-1], r"^73[23]\t\tFootbot\tfb_9\t")
        self.assert_resumed(expected)

    def test_after_a_reset(self):
        run, _ = self.begin()
        self.control("step", 100)
        self.control("reset")
        self.wait_until("the next run", lambda: "reset-1" in self.run_it("list", "experiments", "--json").stdout, run)
        self.control("step", 300)
        self.kill(run, children_of(run.process.pid))
        self.assert_resumed(self.undisturbed(), "out/reset-1")

    def test_a_stopped_process_ends_too(self):
        for program in ("space_server", "engine_worker", "controller_host"):
            with self.subTest(program):
                run, pids = self.begin()
                self.control("step", 100)
                stopped = run.find(program)
                os.kill(stopped, signal.SIGSTOP)
                self.wait_until("the stop", lambda: stat_of(stopped)[2] == "T")
                self.kill(run, pids)
                shutil.rmtree(self.folder / "out")

    def test_a_controller_that_does_not_return_ends_too(self):
        run = self.start("run", self.write_faulty("step_hangs", 50), "--output", "out")
        run.read_until("ControlStep at tick 50")
        self.kill(run, children_of(run.process.pid))
        # The next run removes what it left.
        self.assertEqual(self.run_it("run", EXPERIMENT, "--ticks", 10, "--quiet").process.returncode, 0)
        self.assert_nothing_left(run)

    def test_visualisers_that_are_attached_end(self):
        run, pids = self.begin("--no-visualisers")
        watcher = self.start("attach", "text", "--file", "watched.txt", "--output", self.folder)
        self.wait_until("its first table", lambda: self.has_table("watched.txt"))
        self.kill(run, pids)
        watcher.wait()
        self.assert_nothing_left(run)


class Terminal(OrphanTest):
    def start_plainly(self, words, **streams):
        process = subprocess.Popen([*words, SWARMANOID, "run", EXPERIMENT, "--ticks", str(TICKS), "--paused", "--output", self.folder / "out"],
                                   cwd=self.folder, **streams)
        self.addCleanup(end, process)
        self.wait_for_experiment("diffusion_10")
        return process

    def test_the_run_ends_as_by_an_interrupt_if_it_is_closed(self):
        expected = self.undisturbed()
        ours, theirs = pty.openpty()
        # As a shell's job: in the foreground of the terminal that is about to go.
        process = self.start_plainly(["setsid", "--ctty"], stdin=theirs, stdout=theirs, stderr=theirs)
        os.close(theirs)
        self.control("step", 500)
        pids = children_of(process.pid)
        os.close(ours)
        process.wait(GENEROUS_S)
        self.assert_all_end(pids)
        manifest = json.loads((self.folder / "out/manifest.json").read_text())
        self.assertEqual((manifest["exit_code"], manifest["ticks"]), (130, 500))
        self.assert_resumed(expected)

    def test_nohup_keeps_the_run(self):
        process = self.start_plainly(["nohup"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        process.send_signal(signal.SIGHUP)
        self.control("step", 100)
        self.assertIsNone(process.poll())
        self.control("stop")
        stdout, stderr = process.communicate(timeout=GENEROUS_S)
        self.assertEqual(process.returncode, 0, stderr)
        self.assertRegex(stdout, "finished: 100 ticks")
