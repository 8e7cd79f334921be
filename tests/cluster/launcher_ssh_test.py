"""Clusters on two machines by ssh, with real servers of it: two sshd on this machine, of the present user, with keys, ports and folders of
their own. What happens there has to be told here, and nothing may be left there."""
import contextlib
import getpass
import grp
import os
import pathlib
import re
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest

from harness import CONFIGS, GENEROUS_S, LauncherTest, children_of, end, main, skip, stat_of, words_of

SSHD = shutil.which("sshd", path="/usr/sbin:/usr/local/sbin:" + os.environ["PATH"])
SSH = shutil.which("ssh")
BUILD = pathlib.Path(os.environ["SWARMANOID_BUILD"])
TICKS = 40
# Settings of the preset that the programs are built with.
OF_SANITIZERS = " ".join(f'"{name}={os.environ[name]}"' for name in ("ASAN_OPTIONS", "TSAN_OPTIONS") if name in os.environ)


PROGRAMS = ("space_server", "engine_worker", "controller_host", "visualiser")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def environment_of(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
    except OSError:
        return []


def make_key(file):
    subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", file], check=True, stdin=subprocess.DEVNULL)


class Machine:
    """A sshd with its keys."""

    def __init__(self, name, folder, user_key, shared):
        self.name = name
        self.folder = folder / name
        self.folder.mkdir()
        make_key(self.folder / "host_key")
        self.log = self.folder / "sshd.log"
        # Another may take the port between the look and the start.
        for _ in range(20):
            self.port = free_port()
            (self.folder / "sshd_config").write_text(
                f"Port {self.port}\nListenAddress 127.0.0.1\nHostKey {self.folder}/host_key\nPidFile none\n"
                f"AuthorizedKeysFile {user_key}.pub\nPubkeyAuthentication yes\nPasswordAuthentication no\n"
                "KbdInteractiveAuthentication no\nUsePAM no\nStrictModes no\nPermitRootLogin prohibit-password\n"
                f"SetEnv SWARMANOID_SHARED_FOLDER={shared} {OF_SANITIZERS}\n")
            with self.log.open("w") as log:
                self.process = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", SSHD, "-D", "-e", "-f",
                                                 self.folder / "sshd_config"],
                                                stdin=subprocess.DEVNULL, stderr=log, start_new_session=True)
            deadline = time.monotonic() + GENEROUS_S
            while self.process.poll() is None and "Server listening" not in self.log.read_text():
                assert time.monotonic() < deadline, self.log.read_text()
                time.sleep(0.01)
            if self.process.poll() is None:
                return
        raise AssertionError("no sshd: " + self.log.read_text())

    def known_host(self):
        kind, key = (self.folder / "host_key.pub").read_text().split()[:2]
        return f"[127.0.0.1]:{self.port} {kind} {key}\n"

    def descendants(self):
        found, fresh = [], [self.process.pid]
        while fresh:
            children = [child for pid in fresh for child in children_of(pid)]
            found += children
            fresh = children
        return found

    def find(self, program):
        """The process of a program that was started on this machine, or None."""
        for pid in self.descendants():
            words = words_of(pid)
            if words and os.path.basename(words[0]) == program:
                return pid
        return None

    def session_of(self, pid):
        """The sshd that serves the connection of a process."""
        while True:
            parent = stat_of(pid)[0]
            if words_of(parent) and words_of(parent)[0].startswith("sshd:"):
                return parent
            pid = parent


class Ssh(LauncherTest):
    def setUp(self):
        super().setUp()
        key = self.folder / "user_key"
        make_key(key)
        self.machines = {}
        for name in ("alpha", "beta"):
            self.machines[name] = Machine(name, self.folder, key, self.shared)
            self.addCleanup(self.stop, self.machines[name])
        self.alpha, self.beta = self.machines["alpha"], self.machines["beta"]
        (self.folder / "known_hosts").write_text("".join(m.known_host() for m in self.machines.values()))
        config = self.folder / "ssh_config"
        config.write_text("".join(f"Host {m.name}\n  HostName 127.0.0.1\n  Port {m.port}\n" for m in self.machines.values()) +
                          "Host lost\n  HostName 127.0.0.1\n" f"  Port {free_port()}\n"
                          f"Host *\n  User {getpass.getuser()}\n  IdentityFile {key}\n  IdentitiesOnly yes\n"
                          f"  UserKnownHostsFile {self.folder}/known_hosts\n  GlobalKnownHostsFile none\n"
                          "  StrictHostKeyChecking yes\n")
        # The command is the built-in one; only the configuration of ssh is ours.
        programs = self.folder / "bin"
        programs.mkdir()
        (programs / "ssh").write_text(f'#!/bin/sh\nexec {SSH} -F {shlex.quote(str(config))} "$@"\n')
        (programs / "ssh").chmod(0o755)
        self.environment = {"PATH": f"{programs}:{os.environ['PATH']}"}

    def stop(self, machine):
        for pid in machine.descendants():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        end(machine.process)

    def hosts(self, *lines):
        # By its address, so that everything goes over the network as it does between machines. A busy machine is not dead.
        file = self.folder / "hosts.txt"
        file.write_text("\n".join(["options = --interface 127.0.0.1 --lease 30", *lines]) + "\n")
        return file

    def start_on(self, hosts, *options):
        return self.start("run", CONFIGS / "diffusion_10.xml", "--no-visualisers", "--output", f"out{len(self.runs)}", "--hosts", hosts,
                          *options, environment=self.environment)

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
        for machine in self.machines.values():
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
        for lines in (("engine = alpha", "controller_host = beta"), ("space_server = alpha", "controller_host = beta"),
                      ("space_server = alpha", "engine = beta", "controller_host = beta")):
            run = self.run_on(self.hosts(*lines), "--ticks", TICKS)
            self.assertEqual(run.process.returncode, 0, run.stderr)
            self.assertEqual(self.assert_finished(run, TICKS), wanted, lines)
            self.assert_machines_empty()

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
        for program, machine, name in (("engine_worker", self.alpha, "engine 'ground'"),
                                       ("controller_host", self.beta, "controller host 0")):
            run = self.endless()
            os.kill(machine.session_of(machine.find(program)), signal.SIGKILL)
            run.wait()
            self.assert_failed(run, f"^{name} ", f"on {machine.name}")

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
        known = self.folder / "known_hosts"
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


def terminals_are_of_tty():
    """Whether new terminals belong to the group tty: only root can give them to it."""
    ours, theirs = os.openpty()
    group = os.fstat(theirs).st_gid
    os.close(ours)
    os.close(theirs)
    return group == grp.getgrnam("tty").gr_gid


if __name__ == "__main__":
    if SSH is None or SSHD is None:
        skip("ssh and its server are missing (package openssh-server)")
    if os.geteuid() == 0:
        # What the package's service makes when it starts.
        os.makedirs("/run/sshd", mode=0o755, exist_ok=True)
    elif not terminals_are_of_tty():
        skip("a sshd that is not root's cannot hand over terminals: /dev/pts is not mounted with gid=5,mode=620")
    main()
