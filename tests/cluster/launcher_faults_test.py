"""Processes of a run are killed, stopped, or fail by themselves: the run ends at once, says why, and leaves nothing."""
import os
import signal

from harness import CONFIGS, LauncherTest, stat_of

from signals import send_and_wait

PROGRAMS = ["space_server", "engine_worker", "controller_host", "visualiser"]
LONG = ["--ticks", "0", "--hash-log", "hashes", "--output", "out", "--no-recovery", "--lease", "600"]  # longer than the test waits
NAMES = {"space_server": "space server", "engine_worker": "engine 'ground'", "controller_host": "controller host 0",
         "visualiser": "visualiser 'positions'"}


class Kills(LauncherTest):
    def kill(self, program, moment):
        run = self.start("run", CONFIGS / "diffusion_10.xml", *LONG, "--quiet")
        pid = run.find(program)
        pids = [run.find(other) for other in PROGRAMS]
        if moment == "mid-run":
            self.wait_for_tick("hashes", 200, run)
        os.kill(pid, signal.SIGKILL)
        self.assertEqual(run.wait(), 4, run.stderr)
        first = run.stderr.splitlines()[0]
        self.assertRegex(first, rf"^{NAMES[program]} was killed by signal 9 \(Killed\)(, during .*)? at tick \d+; its log is {self.folder}/out/")
        self.assertEqual(run.stdout, "")
        self.assert_nothing_left(run, pids)

    def test_each_while_the_cluster_starts(self):
        for program in PROGRAMS:
            with self.subTest(program):
                self.tearDown()
                self.setUp()
                self.kill(program, "start")

    def test_each_in_mid_run(self):
        for program in PROGRAMS:
            with self.subTest(program):
                self.tearDown()
                self.setUp()
                self.kill(program, "mid-run")

    def test_about_the_last_tick(self):
        for program in ("space_server", "controller_host"):
            with self.subTest(program):
                self.tearDown()
                self.setUp()
                run = self.start("run", CONFIGS / "diffusion_10.xml", "--quiet", "--ticks", 600, "--hash-log", "hashes")
                pid = run.find(program)
                self.wait_for_tick("hashes", 590)
                try:
                    os.kill(pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
                # Too late to do harm, or in time: both are told truly.
                if run.wait() == 0:
                    self.assert_finished(run, 600)
                else:
                    self.assertEqual(run.process.returncode, 4)
                    self.assertIn(f"{NAMES[program]} was killed by signal 9", run.stderr)
                    self.assertEqual(run.stdout, "")
                self.assert_nothing_left(run)

    def test_a_killed_launcher_takes_all_with_it(self):
        run = self.start("run", CONFIGS / "diffusion_10.xml", *LONG)
        pids = [run.find(program) for program in PROGRAMS]
        self.wait_for_tick("hashes", 100, run)
        run.process.kill()
        run.wait()
        self.wait_until("the end of its processes", lambda: all((stat_of(pid) or "  Z")[2] == "Z" for pid in pids))
        self.assert_nothing_left(run, pids)

    def test_one_that_is_asked_to_end_by_a_signal_is_named(self):
        for program in ["visualiser", "engine_worker"]:
            with self.subTest(program):
                self.tearDown()
                self.setUp()
                run = self.start("run", CONFIGS / "diffusion_10.xml", *LONG, "--quiet")
                pid = run.find(program)
                self.wait_for_tick("hashes", 50, run)
                os.kill(pid, signal.SIGTERM)
                self.assertEqual(run.wait(), 4, run.stderr)
                self.assertRegex(run.stderr.splitlines()[0], rf"^{NAMES[program]} failed at tick \d+: interrupted by a signal; its log is ")


class Stalls(LauncherTest):
    def test_a_stopped_process_is_named_and_the_run_goes_on_with_it(self):
        # Paused, it waits: a process that is stopped with a lock of shared memory ends the run (docs/wire.md).
        run = self.start("run", CONFIGS / "diffusion_10.xml", "--ticks", 100, "--paused")
        self.wait_for_experiment("diffusion_10")
        self.control("step", 20)
        pid = run.find("controller_host")
        os.kill(pid, signal.SIGSTOP)
        self.control("resume")
        said = run.read_until("waiting for controller host 0")
        os.kill(pid, signal.SIGCONT)
        self.assertEqual(run.wait(), 0, said + run.stderr)
        hash_after = self.assert_finished(run, 100)
        plain = self.run_it("run", CONFIGS / "diffusion_10.xml", "--ticks", 100, "--quiet", "--single-process")
        self.assertEqual(self.assert_finished(plain), hash_after)

    def test_a_stopped_process_does_not_survive_the_end(self):
        run = self.start("run", CONFIGS / "diffusion_10.xml", *LONG, "--quiet")
        pids = [run.find(program) for program in PROGRAMS]
        self.wait_for_tick("hashes", 100, run)
        os.kill(run.pids["controller_host"], signal.SIGSTOP)
        os.kill(run.pids["engine_worker"], signal.SIGKILL)
        self.assertEqual(run.wait(), 4)
        self.assert_nothing_left(run, pids)


class Controllers(LauncherTest):
    def failing(self, fault, tick=0, *options):
        return self.run_it("run", self.write_faulty(fault, tick), "--quiet", *options)

    def both_ways(self, fault, tick=0):
        cluster = self.failing(fault, tick)
        self.assert_nothing_left(cluster)
        return [cluster, self.failing(fault, tick, "--single-process")]

    def test_throwing_in_init_names_the_robot(self):
        for run in self.both_ways("init_throws"):
            self.assertEqual(run.process.returncode, 4, run.stderr)
            self.assertIn("robot_one", run.stderr)
            self.assertIn("cannot begin", run.stderr)

    def test_failing_in_init_names_the_robot(self):
        for run in self.both_ways("init_fails"):
            self.assertEqual(run.process.returncode, 4, run.stderr)
            self.assertIn("robot_one", run.stderr)

    def test_throwing_in_a_step_names_robot_and_tick(self):
        for run in self.both_ways("step_throws", 17):
            self.assertEqual(run.process.returncode, 4, run.stderr)
            self.assertIn("robot_one", run.stderr)
            self.assertIn("17", run.stderr)
            self.assertIn("cannot go on", run.stderr)

    def test_crashing_names_the_robot_and_the_tick(self):
        for run in self.both_ways("step_crashes", 17):
            self.assertEqual(run.process.returncode, 4)
            self.assertRegex(run.stderr, "^robot 'robot_one', controller 'c': ControlStep at tick 17 aborted")

    def test_leaving_is_no_end_of_the_run(self):
        for run in self.both_ways("step_exits", 17):
            self.assertEqual(run.process.returncode, 4)
            self.assertRegex(run.stderr, r"^robot 'robot_one', controller 'c': ControlStep at tick 17 called exit\(0\)")

    def test_one_that_never_returns_is_waited_for_and_can_be_killed(self):
        run = self.start("run", self.write_faulty("step_hangs", 17), "--paused", "--lease", 600)
        # The answer to a step names the process that the run waits for.
        self.wait_for_experiment("faulty")
        step = self.run_it("control", "step", 30)
        self.assertEqual(step.process.returncode, 4)
        self.assertRegex(step.stderr, r"does not answer; it is at tick 17 and waits for controller host 0 since \d+ s \(.*robot_one")
        send_and_wait(run.process, signal.SIGINT)
        said = run.read_until("Ctrl-C again")
        self.assertIsNone(run.process.poll())
        run.process.send_signal(signal.SIGINT)
        self.assertEqual(run.wait(), 130)
        self.assertIn("waiting for controller host 0", said + run.stderr)
        self.assertIn("robot_one", said + run.stderr)
        self.assert_nothing_left(run)

    def test_a_missing_library_is_an_error_of_the_file(self):
        path = self.write_faulty("none")
        path.write_text(path.read_text().replace('library="faulty_controller"', 'library="no_such_library"'))
        run = self.run_it("run", path)
        self.assertEqual(run.process.returncode, 3)
        self.assertRegex(run.stderr, rf"{path}:\d+:\d+: ")
        self.assertIn("no_such_library", run.stderr)
        self.assertFalse((self.folder / "runs").exists())
