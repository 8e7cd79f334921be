"""The launcher of a run is killed, or loses its terminal, and the run goes on: until somebody adopts it, it ends, or its time is over. If
the process that supervises the run is killed instead, the launcher starts another one."""
import contextlib
import json
import os
import pty
import random
import shutil
import signal
import socket
import subprocess
import time

from harness import CONFIGS, GENEROUS_S, SWARMANOID, LauncherTest, end, main, processes_of, stat_of, supervisor_of, words_of

EXPERIMENT = CONFIGS / "diffusion_10.xml"
# Kills with a random moment each; by hand as many as one likes.
KILLS = int(os.environ.get("SWARMANOID_ORPHANS", "4"))
SEED = int(os.environ.get("SWARMANOID_KILLS_SEED", "1"))
TICKS = 2000
AGAIN = "all processes start again where the journal ends"


def is_gone(pid):
    stat = stat_of(pid)
    return stat is None or stat[2] == "Z"


class OrphanTest(LauncherTest):
    def setUp(self):
        super().setUp()
        self.supervisors = []
        # Sockets of its own: runs of others come and go.
        self.sockets = self.folder / "sockets"
        self.sockets.mkdir()
        self.before = os.environ.get("XDG_RUNTIME_DIR")
        os.environ["XDG_RUNTIME_DIR"] = str(self.sockets)

    def tearDown(self):
        for pid in self.supervisors:
            if any(str(self.folder) in word for word in words_of(pid)):
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
        if self.before is None:
            del os.environ["XDG_RUNTIME_DIR"]
        else:
            os.environ["XDG_RUNTIME_DIR"] = self.before
        super().tearDown()

    def begin(self, *options, ticks=TICKS):
        """A run that is paused at its first tick."""
        run = self.start("run", EXPERIMENT, "--ticks", ticks, "--paused", "--hash-log", self.folder / "cluster", "--output",
                         self.folder / "out", "--quiet", *options)
        self.wait_for_experiment("diffusion_10")
        run.supervisor = supervisor_of(run.process.pid)
        self.assertIsNotNone(run.supervisor)
        self.supervisors.append(run.supervisor)
        return run

    def resume(self):
        # A run that ends at once may be gone before its answer is heard.
        done = self.run_it("control", "resume")
        if done.process.returncode != 0 and "diffusion_10" in self.run_it("list", "experiments").stdout:
            self.control("resume")

    def orphan(self, run):
        run.process.kill()
        run.wait()
        self.wait_until("the run to have no launcher", lambda: "orphaned" in self.run_it("list", "experiments").stdout)

    def adopt(self, *options):
        adopter = self.start("adopt", self.folder / "out", *options)
        adopter.read_until(" processes")
        return adopter

    def refused(self, *words, says):
        done = self.run_it("adopt", *words)
        self.assertEqual(done.process.returncode, 2, done.stderr)
        for text in says:
            self.assertIn(text, done.stderr)

    def undisturbed(self, ticks=TICKS):
        run = self.run_it("run", EXPERIMENT, "--ticks", ticks, "--single-process", "--quiet", "--hash-log", "one", "--output", "one_out")
        return self.assert_finished(run, ticks)

    def assert_same(self, run, expected, ticks=TICKS):
        """The run that this process waits for has ended as one that nobody disturbed."""
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(self.assert_finished(run, ticks), expected)
        self.assert_same_files(expected)

    def assert_same_files(self, expected):
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        self.assertEqual((self.folder / "out/positions.txt").read_bytes(), (self.folder / "one_out/positions.txt").read_bytes())
        manifest = json.loads((self.folder / "out/manifest.json").read_text())
        self.assertEqual((manifest["exit_code"], manifest["state_hash"]), (0, expected))

    def assert_all_gone(self, run):
        self.wait_until("the end of the run", lambda: is_gone(run.supervisor))
        self.assert_nothing_left(run)
        self.assertEqual(list(self.sockets.glob("*/run.*")), [])


class Adopted(OrphanTest):
    def test_at_random_ticks(self):
        seed = random.Random(SEED)
        expected = self.undisturbed()
        for number in range(KILLS):
            run = self.begin()
            stepper = self.start("control", "step", TICKS - 200, "--patience", GENEROUS_S)
            moment = seed.randrange(1, TICKS - 300)
            # In the midst of ticks: the run is as quick as it can be.
            self.wait_for_tick("cluster", moment, run)
            self.orphan(run)
            self.assertEqual(stepper.wait(), 0, stepper.stderr)
            adopter = self.adopt()
            self.resume()
            with self.subTest(moment):
                self.assert_same(adopter, expected)
                self.assert_all_gone(run)
            shutil.rmtree(self.folder / "out")
            os.unlink(self.folder / "cluster")

    def test_one_after_the_other(self):
        expected = self.undisturbed()
        run = self.begin()
        launcher = run
        for _ in range(3):
            self.control("step", 300)
            self.orphan(launcher)
            launcher = self.adopt()
        self.resume()
        self.assert_same(launcher, expected)
        self.assert_all_gone(run)

    def test_workers_that_die_meanwhile_are_replaced(self):
        expected = self.undisturbed()
        run = self.begin()
        self.control("step", 700)
        victims = [run.find(program) for program in ("engine_worker", "controller_host", "visualiser")]
        run.process.kill()
        for pid in victims:
            os.kill(pid, signal.SIGKILL)
        run.wait()
        adopter = self.adopt()
        self.resume()
        self.assert_same(adopter, expected)
        self.assert_all_gone(run)

    def test_the_new_launcher_replaces_who_dies_and_says_so(self):
        expected = self.undisturbed()
        run = self.begin()
        self.control("step", 700)
        self.orphan(run)
        adopter = self.adopt()
        host = next(pid for pid in processes_of(run.supervisor) if os.path.basename(words_of(pid)[0]) == "controller_host")
        os.kill(host, signal.SIGKILL)
        adopter.read_until("controller host 0 was killed by signal 9 (Killed)")
        self.resume()
        self.assert_same(adopter, expected)

    def test_ctrl_c_is_for_the_run(self):
        run = self.begin()
        self.control("step", 100)
        self.orphan(run)
        adopter = self.adopt()
        adopter.process.send_signal(signal.SIGINT)
        self.assertEqual(adopter.wait(), 130, adopter.stderr)
        self.assert_finished(adopter, 100)
        self.assert_all_gone(run)

    def test_visualisers_that_are_attached_notice_nothing(self):
        run = self.begin("--no-visualisers")
        watcher = self.start("attach", "text", "--file", "watched.txt", "--output", self.folder)
        self.wait_until("its first table", lambda: self.has_table("watched.txt"))
        self.orphan(run)
        adopter = self.adopt()
        self.control("step", 50)
        self.resume()
        self.assertEqual(adopter.wait(), 0, adopter.stderr)
        self.assertEqual(watcher.wait(), 0, watcher.stderr)
        self.assertNotIn("waiting", watcher.stderr)

    def test_the_only_one_needs_no_name(self):
        run = self.begin()
        self.orphan(run)
        adopter = self.start("adopt")
        adopter.read_until(" processes")
        self.control("stop")
        self.assertEqual(adopter.wait(), 0, adopter.stderr)


class WithoutALauncher(OrphanTest):
    def test_it_comes_to_its_end(self):
        expected = self.undisturbed()
        run = self.begin()
        self.control("step", 300)
        self.orphan(run)
        self.resume()
        self.assert_all_gone(run)
        self.assert_same_files(expected)
        said = (self.folder / "out/orphaned.log").read_text()
        self.assertIn(f"the launcher (process {run.process.pid}) has gone", said)
        self.assertIn(f"hash {expected}", said.splitlines()[-1])
        self.refused("out", says=["has ended already", "exit code 0"])

    def test_its_time_is_over(self):
        run = self.begin("--orphan-timeout", 1, ticks=0)
        self.control("step", 500)
        run.process.kill()
        run.wait()
        self.assert_all_gone(run)
        self.assertEqual(json.loads((self.folder / "out/manifest.json").read_text())["exit_code"], 130)
        self.assertIn("nobody has adopted the run within 1 s", (self.folder / "out/orphaned.log").read_text())
        self.refused("out", says=["has ended already", "exit code 130", "swarmanoid resume"])
        expected = self.undisturbed(800)
        again = self.run_it("resume", "out", "--ticks", 800, "--quiet")
        self.assertEqual(again.process.returncode, 0, again.stderr)
        self.assertEqual(self.assert_finished(again, 800), expected)

    def test_the_terminal_is_closed(self):
        expected = self.undisturbed()
        ours, theirs = pty.openpty()
        words = ["run", EXPERIMENT, "--ticks", TICKS, "--paused", "--hash-log", self.folder / "cluster", "--output", self.folder / "out"]
        # As a shell's job: in the foreground of the terminal that is about to go.
        process = subprocess.Popen(["setsid", "--ctty", SWARMANOID, *map(str, words)], cwd=self.folder, stdin=theirs, stdout=theirs, stderr=theirs)
        self.addCleanup(end, process)
        os.close(theirs)
        self.wait_for_experiment("diffusion_10")
        supervisor = supervisor_of(process.pid)
        self.supervisors.append(supervisor)
        os.close(ours)
        process.wait(GENEROUS_S)
        self.wait_until("the run to have no launcher", lambda: "orphaned" in self.run_it("list", "experiments").stdout)
        adopter = self.adopt()
        self.resume()
        self.assert_same(adopter, expected)
        self.wait_until("the end of the run", lambda: is_gone(supervisor))

    def test_nohup_keeps_the_launcher(self):
        process = subprocess.Popen(["nohup", SWARMANOID, "run", EXPERIMENT, "--ticks", "300", "--paused", "--quiet", "--output",
                                    self.folder / "out"], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(end, process)
        self.wait_for_experiment("diffusion_10")
        process.send_signal(signal.SIGHUP)
        self.control("step", 100)
        self.assertIsNone(process.poll())
        self.assertNotIn("orphaned", self.run_it("list", "experiments").stdout)
        self.resume()
        stdout, stderr = process.communicate(timeout=GENEROUS_S)
        self.assertEqual(process.returncode, 0, stderr)
        self.assertRegex(stdout, "finished: 300 ticks")

    def test_lists_tell_it(self):
        run = self.begin()
        before = json.loads(self.run_it("list", "experiments", "--json").stdout)
        self.assertEqual([(row["orphaned"], row["folder"]) for row in before], [(False, str(self.folder / "out"))])
        self.orphan(run)
        self.assertRegex(self.run_it("list", "experiments").stdout,
                         rf"orphaned, ends in [1-4] min \d+ s: swarmanoid adopt {self.folder}/out\n")
        row = json.loads(self.run_it("list", "experiments", "--json").stdout)[0]
        self.assertTrue(row["orphaned"])
        self.assertTrue(0 < row["ends_in_s"] < 300, row)
        self.control("stop")
        self.assert_all_gone(run)


class Refused(OrphanTest):
    def test_what_is_no_run(self):
        self.refused(says=["no run of this machine has lost its launcher"])
        self.refused("nothing", says=["is no folder of a run", "swarmanoid list experiments"])

    def test_a_run_with_a_launcher(self):
        run = self.begin()
        self.refused("out", says=[f"still has its launcher, process {run.process.pid} on {socket.gethostname()}"])
        self.orphan(run)
        adopter = self.adopt()
        self.refused("out", says=[f"still has its launcher, process {adopter.process.pid} on "])
        self.control("stop")
        self.assertEqual(adopter.wait(), 0, adopter.stderr)

    def test_a_run_that_ends_with_its_launcher(self):
        self.start("run", EXPERIMENT, "--ticks", 0, "--paused", "--quiet", "--output", "out", "--orphan-timeout", 0)
        self.wait_for_experiment("diffusion_10")
        self.refused("out", says=["goes on with its launcher, and ends with it", "--orphan-timeout 0"])

    def test_a_run_in_one_process(self):
        one = self.run_it("run", EXPERIMENT, "--ticks", 10, "--single-process", "--quiet", "--output", "out")
        self.assertEqual(one.process.returncode, 0)
        self.refused("out", says=["has ended already"])

    def test_a_run_that_died(self):
        run = self.begin()
        self.control("step", 200)
        self.orphan(run)
        os.kill(run.supervisor, signal.SIGKILL)
        self.wait_until("its end", lambda: is_gone(run.supervisor) and "no experiment runs" in self.run_it("list", "experiments").stdout)
        self.refused("out", says=["died with all of its processes", f"swarmanoid resume {self.folder}/out"])
        self.assertEqual([path.name for path in self.sockets.rglob("*.socket")], [])

    def test_strangers_are_not_heard(self):
        run = self.begin()
        path = next(self.sockets.glob("*/run.*.socket"))
        self.assertEqual(path.parent.stat().st_mode & 0o777, 0o700)
        for sent in (b"", b"\xff\xfe", b"[]", b'{"adopt":7}', b'{"adopt":true}', b'{"signal":9}', b'{"signal":"x"}', b"x" * 70000):
            with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as stranger:
                stranger.connect(str(path))
                if sent:
                    stranger.send(sent)
        self.control("step", 100)
        self.assertIsNone(run.process.poll())
        self.assertNotIn("orphaned", self.run_it("list", "experiments").stdout)
        self.control("stop")
        self.assertEqual(run.wait(), 0, run.stderr)

    def test_a_run_that_has_a_launcher_is_not_taken_from_it(self):
        """As by a second one that looked before the first one took it."""
        run = self.begin()
        path = next(self.sockets.glob("*/run.*.socket"))
        with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as second, (self.folder / "said").open("w") as said:
            second.settimeout(GENEROUS_S)
            second.connect(str(path))
            socket.send_fds(second, [b'{"adopt":true}'], [said.fileno(), said.fileno()])
            answer = json.loads(second.recv(65536))
            self.assertEqual((answer["adopted"], answer["launcher"]), (False, run.process.pid))
        self.control("stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assert_finished(run)
        self.assertEqual((self.folder / "said").read_text(), "")


class SupervisorKilled(OrphanTest):
    def test_all_start_again(self):
        expected = self.undisturbed()
        seed = random.Random(SEED)
        for _ in range(2):
            run = self.begin()
            stepper = self.start("control", "step", TICKS - 200, "--patience", GENEROUS_S)
            self.wait_for_tick("cluster", seed.randrange(1, TICKS - 300), run)
            os.kill(run.supervisor, signal.SIGKILL)
            said = run.read_until(AGAIN)
            self.assertIn("the process that supervises the run was killed by signal 9 (Killed)", said)
            self.wait_until("another one", lambda: supervisor_of(run.process.pid) not in (None, run.supervisor), run)
            run.supervisor = supervisor_of(run.process.pid)
            self.supervisors.append(run.supervisor)
            self.assertEqual(stepper.wait(), 0, stepper.stderr)
            self.assertIn(f"paused at tick {TICKS - 200}", stepper.stdout)
            self.resume()
            self.assert_same(run, expected)
            self.assert_all_gone(run)
            shutil.rmtree(self.folder / "out")
            os.unlink(self.folder / "cluster")

    def test_not_without_recovery(self):
        run = self.begin("--no-recovery")
        self.control("step", 100)
        os.kill(run.supervisor, signal.SIGKILL)
        self.assertEqual(run.wait(), 4)
        self.assertIn(f"swarmanoid resume {self.folder}/out", run.stderr)
        self.assert_nothing_left(run)


if __name__ == "__main__":
    main()
