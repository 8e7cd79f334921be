"""Clusters on two machines by ssh, with real servers of it: two sshd on this machine. What happens there has to be told here, and nothing
may be left there."""
import functools
import os
import pathlib
import signal

from harness import CONFIGS, LauncherTest, children_of, words_of
from ssh_machines import Machines, require_servers

setUpModule = functools.partial(require_servers, terminals=True)
BUILD = pathlib.Path(os.environ["SWARMANOID_BUILD"])
TICKS = 40
MOVED_TICKS = 400
PROGRAMS = ("space_server", "engine_worker", "controller_host", "visualiser")


def environment_of(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
    except OSError:
        return []


class Ssh(LauncherTest):
    def setUp(self):
        super().setUp()
        self.ssh = Machines(self.folder, self.shared)
        self.addCleanup(self.ssh.stop)
        self.alpha, self.beta = self.ssh.alpha, self.ssh.beta

    def hosts(self, *lines):
        # By its address, so that everything goes over the network as it does between machines. A busy machine is not dead.
        file = self.folder / "hosts.txt"
        file.write_text("\n".join(["options = --interface 127.0.0.1 --lease 30", *lines]) + "\n")
        return file

    def start_on(self, hosts, *options):
        return self.start("run", CONFIGS / "diffusion_10.xml", "--no-visualisers", "--output", f"out{len(self.runs)}", "--hosts", hosts,
                          *options, environment=self.ssh.environment)

    def run_on(self, hosts, *options):
        run = self.start_on(hosts, *options)
        run.wait()
        return run

    def endless(self, *lines):
        """A run that goes on, with its engine at alpha and its controllers at beta unless said otherwise."""
        hashes = f"hashes{len(self.runs)}"
        run = self.start_on(self.hosts(*(lines or ("engine = alpha", "controller_host = beta"))), "--no-recovery", "--real-time", "20", "--ticks", "0",
                            "--hash-log", self.folder / hashes)
        self.wait_for_tick(hashes, 3, run)
        return run

    def programs_left(self):
        """Of the runs of this test, on any machine. The sshd of a connection that broke goes before the program that it started."""
        ours = f"SWARMANOID_SHARED_FOLDER={self.shared}".encode()
        return [pid for pid in map(int, filter(str.isdigit, os.listdir("/proc")))
                if os.path.basename((words_of(pid) or [""])[0]) in PROGRAMS and ours in environment_of(pid)]

    def assert_machines_empty(self):
        """No program that was started by ssh runs any more; what was told to end needs a moment."""
        for machine in self.ssh.all:
            self.wait_until(f"{machine.name} to be empty", lambda: not machine.descendants())
        self.wait_until("the programs to end", lambda: not self.programs_left())

    def assert_failed(self, run, *texts):
        self.assertEqual(run.process.returncode, 4, run.stderr)
        for text in texts:
            self.assertRegex(run.stderr, "(?m)" + text)
        self.assert_machines_empty()
        self.assertEqual(self.memory() - self.memory_before, set())

    def test_the_hash_is_that_of_one_process(self):
        one = self.run_it("run", CONFIGS / "diffusion_10.xml", "--ticks", TICKS, "--no-visualisers", "--single-process")
        wanted = self.assert_finished(one, TICKS)
        for lines in (("engine = alpha", "controller_host = beta"), ("space_server = alpha", "engine = beta", "controller_host = beta")):
            run = self.run_on(self.hosts(*lines), "--ticks", TICKS)
            self.assertEqual(run.process.returncode, 0, run.stderr)
            self.assertEqual(self.assert_finished(run, TICKS), wanted, lines)
            self.assert_machines_empty()

    def paused(self, *lines):
        """A run that waits at its tick 100."""
        run = self.start_on(self.hosts(*lines), "--paused", "--ticks", MOVED_TICKS)
        self.wait_for_experiment("diffusion_10")
        self.control("step", "100")
        return run

    def control(self, *words):
        answer = self.run_it("control", *words, "--interface", "127.0.0.1")
        self.assertEqual(answer.process.returncode, 0, answer.stderr)

    def assert_undisturbed(self, run):
        one = self.run_it("run", CONFIGS / "diffusion_10.xml", "--ticks", MOVED_TICKS, "--no-visualisers", "--single-process", "--quiet")
        self.run_it("control", "resume", "--interface", "127.0.0.1")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(self.assert_finished(run, MOVED_TICKS), self.assert_finished(one, MOVED_TICKS))
        self.assert_machines_empty()

    def test_workers_move_between_machines(self):
        run = self.paused("engine = alpha", "controller_host = beta")
        self.control("move-host", "0", "alpha")
        self.assertIsNotNone(self.alpha.find("controller_host"))
        self.wait_until("beta to be left", lambda: self.beta.find("controller_host") is None)
        self.control("move-engine", "ground", "here")
        self.wait_until("the engine to leave alpha", lambda: self.alpha.find("engine_worker") is None)
        self.assertIsNotNone(run.find("engine_worker"))
        self.control("step", "50")
        self.control("drain", "alpha")
        # The engine is here already.
        self.assertIsNotNone(self.beta.find("controller_host"))
        self.wait_until("alpha to be left", lambda: not self.alpha.descendants())
        self.assert_undisturbed(run)

    def test_a_worker_that_cannot_be_there_goes_back(self):
        run = self.paused("engine = alpha", "machines = lost")
        self.control("move-engine", "ground", "lost")
        self.assertIsNotNone(self.alpha.find("engine_worker"))
        said = run.read_until("engine 'ground' on lost")
        self.assertIn("engine 'ground' moves to lost", said)
        self.assert_undisturbed(run)

    def test_a_run_whose_launcher_died_is_resumed(self):
        run = self.paused("engine = alpha", "controller_host = beta")
        run.process.kill()
        run.wait()
        self.assert_machines_empty()
        hosts = self.hosts("engine = alpha", "controller_host = beta")
        self.assert_undisturbed(self.start("resume", "out0", "--no-visualisers", "--hosts", hosts, environment=self.ssh.environment))

    def test_an_interrupt_ends_the_run_at_its_tick(self):
        run = self.endless()
        run.process.send_signal(signal.SIGINT)
        run.wait()
        self.assertEqual(run.process.returncode, 130, run.stderr)
        self.assert_finished(run)
        self.assert_machines_empty()

    def test_an_interrupt_ends_a_run_whose_server_is_there(self):
        run = self.endless("space_server = alpha", "engine = beta")
        run.process.send_signal(signal.SIGINT)
        run.wait()
        self.assertEqual(run.process.returncode, 130, run.stderr)
        self.assert_machines_empty()

    def test_a_second_interrupt_and_a_termination_leave_nothing_there(self):
        for signals in ([signal.SIGTERM], [signal.SIGINT, signal.SIGINT], [signal.SIGKILL]):
            run = self.endless()
            for number in signals:
                run.process.send_signal(number)
            run.wait()
            self.assertEqual(run.process.returncode, -9 if signals == [signal.SIGKILL] else 130, run.stderr)
            self.assert_machines_empty()

    def test_a_killed_process_is_named(self):
        run = self.endless()
        os.kill(self.alpha.find("engine_worker"), signal.SIGKILL)
        run.wait()
        self.assert_failed(run, "^engine 'ground' ", "on alpha")

    def test_who_ends_after_the_launcher_leaves_nothing(self):
        # The program of beta stands still from before its connection is gone until the launcher is.
        programs = self.folder / "slow"
        programs.mkdir()
        (programs / "engine_worker").symlink_to(BUILD / "bin" / "engine_worker")
        slow = programs / "controller_host"
        held = self.folder / "held"
        held.touch()
        slow.write_text(f"#!/bin/sh\nexec 3<&0\ntrap 'while [ -e {held} ]; do sleep 0.05; done; kill -CONT $host' HUP\n"
                        f"{BUILD}/bin/controller_host \"$@\" <&3 &\nhost=$!\nwait $host\nwait $host\n")
        slow.chmod(0o755)
        run = self.endless("engine = alpha", "controller_host = beta", f"program_folder = {programs}")
        host = self.beta.find("controller_host")
        os.kill(host, signal.SIGSTOP)
        os.kill(self.alpha.find("engine_worker"), signal.SIGKILL)
        run.wait()
        self.wait_until("the connection to be gone", lambda: not self.beta.descendants())
        self.assertIn(host, self.programs_left())
        self.assertNotEqual(self.memory() - self.memory_before, set())
        held.unlink()
        self.assert_failed(run, "^engine 'ground' ", "on alpha")

    def test_a_broken_connection_is_named(self):
        run = self.endless()
        os.kill(self.beta.session_of(self.beta.find("controller_host")), signal.SIGKILL)
        run.wait()
        self.assert_failed(run, "^controller host 0 ", "on beta")

    def test_a_killed_ssh_is_named(self):
        run = self.endless()
        ssh = next(pid for pid in children_of(run.process.pid) if "alpha" in words_of(pid))
        os.kill(ssh, signal.SIGKILL)
        run.wait()
        self.assert_failed(run, "^engine 'ground' on alpha was killed by signal 9")

    def test_a_machine_that_is_not_there_is_named(self):
        run = self.run_on(self.hosts("engine = lost"), "--ticks", TICKS)
        self.assert_failed(run, "^engine 'ground' ", "on lost", "Connection refused")

    def test_a_machine_with_another_key_is_refused(self):
        known = self.ssh.known_hosts
        lines = known.read_text().splitlines()
        swapped = [line.split(" ", 1)[0] + " " + other.split(" ", 1)[1] for line, other in zip(lines, reversed(lines))]
        known.write_text("\n".join(swapped) + "\n")
        run = self.run_on(self.hosts("engine = alpha"), "--ticks", TICKS)
        self.assert_failed(run, "^engine 'ground' ", "on alpha", "Host key verification failed")

    def test_a_missing_program_is_named(self):
        run = self.run_on(self.hosts("engine = alpha", f"program_folder = {self.folder}/nowhere"), "--ticks", TICKS)
        self.assert_failed(run, "^engine 'ground' ", "on alpha", f"{self.folder}/nowhere/engine_worker.*No such file")

    def test_another_version_is_refused_with_both(self):
        programs = self.folder / "older"
        programs.mkdir()
        (programs / "engine_worker").symlink_to(BUILD / "bin" / "tests" / "other_version_worker")
        run = self.run_on(self.hosts("engine = alpha", f"program_folder = {programs}"), "--ticks", TICKS)
        self.assert_failed(run, "^engine 'ground' ", "on alpha", r"protocol version (\d+), the space server version (?!\1)\d+")
