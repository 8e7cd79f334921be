#!/usr/bin/env python3
"""Runs over two machines, with somebody on their network who has no key: he overhears everything, says it again, changes it, speaks in the
name of its processes, and sends noise. He reads nothing, and the hash is that of one process. The same is tried on a run without a key, where
he reads all. Needs root and /dev/net/tun; skipped otherwise."""
import json
import os
import pathlib
import shutil
import subprocess
import sys

import two_machines
from harness import CONFIGS, GENEROUS_S, REPLACED, SWARMANOID, LauncherTest

setUpModule = two_machines.require

ATTACKER = pathlib.Path(__file__).resolve().parent / "rtps_attacker.py"
PROGRAMS = pathlib.Path(os.environ["SWARMANOID_BUILD"]) / "bin"
EXPERIMENT = CONFIGS / "diffusion_10.xml"
SECRETS = "footbot_diffusion,<arena,fb_3"  # of the World
TICKS = 80
FORGED = r"dropped a bad RTPS message of '(engine|space|controller).*somebody without the key of this run spoke in its name.*10\.78\.0\.1"


class WireAttacks(LauncherTest):
    def setUp(self):
        super().setUp()
        self.machines = two_machines.TwoMachines(os.environ["SWARMANOID_BUILD"])
        self.addCleanup(self.machines.remove)

    def attack(self, *attacks, interface="link0"):
        attacker = subprocess.Popen(["ip", "netns", "exec", self.machines.names[0], sys.executable, ATTACKER, interface, str(GENEROUS_S), *attacks],
                                    stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env={**os.environ, "SECRETS": SECRETS})
        self.addCleanup(self.end_attack, attacker)
        self.assertEqual(attacker.stdout.readline(), "listening\n")
        return attacker

    @staticmethod
    def end_attack(attacker):
        attacker.kill()
        attacker.wait()
        attacker.stdin.close()
        attacker.stdout.close()

    def report(self, attacker):
        """What he has done until now, which is his end."""
        text, _ = attacker.communicate(timeout=GENEROUS_S)
        return json.loads(text)

    def start_over_network(self, *options, words=()):
        hosts = self.folder / "hosts.txt"
        hosts.write_text(self.machines.hosts(" ".join(["--lease 60", *options])))
        self.machines.connect(0, 0)
        self.addCleanup(self.machines.disconnect)
        return self.start("run", EXPERIMENT, "--ticks", TICKS, "--no-visualisers", "--hosts", hosts, "--real-time", 2, "--hash-log", "cluster",
                          "--output", "out", *words)

    def steer(self, *words):
        """As a member of the run on the first machine, which is on its way."""
        self.wait_for_experiment("diffusion_10")
        subprocess.run(["ip", "netns", "exec", self.machines.names[0], SWARMANOID, "control", "--interface", "link0", *words], check=True,
                       capture_output=True, timeout=GENEROUS_S)

    def run_under(self, *attacks):
        attacker = self.attack(*attacks)
        run = self.start_over_network()
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        report = self.report(attacker)
        one = self.run_it("run", EXPERIMENT, "--ticks", TICKS, "--no-visualisers", "--single-process", "--hash-log", "one")
        self.assertEqual(self.assert_finished(run, TICKS), self.assert_finished(one, TICKS))
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        self.assertEqual(report["read"], [])
        self.assertGreater(report["heard"]["datagrams"], TICKS)
        for attack in attacks:
            self.assertGreater(report["sent"].get(attack, 0), 10, report)
        return run

    def told(self):
        return "".join(log.read_text() for log in (self.folder / "out").glob("*.log"))

    def test_a_listener_reads_nothing(self):
        self.run_under()

    def test_without_a_key_he_reads_all(self):
        attacker = self.attack()
        run = self.start_over_network("--insecure")
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        self.assertEqual(self.report(attacker)["read"], sorted(SECRETS.split(",")))

    def test_what_was_said_is_not_heard_again(self):
        self.run_under("repeat", "noise")

    def test_what_is_changed_is_not_believed_and_told(self):
        self.run_under("change")
        self.assertRegex(self.told(), FORGED)

    def test_no_process_leaves_or_ends_by_the_word_of_another(self):
        run = self.run_under("part", "dispose", "break")
        self.assertNotIn(REPLACED, run.stderr)

    def test_no_process_is_made_deaf(self):
        self.run_under("gap", "ahead", "read")
        # Each receiver tells the first bad message of a sender, whichever of them that is.
        self.assertRegex(self.told(), FORGED + r"|10\.78\.0\.1: a GAP of more than")

    def start_program(self, machine, program, *words, shared=None):
        """In the network of that machine, by hand; what it says goes to the file that is returned with it."""
        log = self.folder / f"{len(list(self.folder.glob('*.out')))}.out"
        with log.open("w") as file:
            process = subprocess.Popen(["ip", "netns", "exec", self.machines.names[machine], PROGRAMS / program, *map(str, words), "--interface",
                                        "link0", "--lease", "60"], cwd=self.folder, stdout=file, stderr=file,
                                       env={**os.environ, "SWARMANOID_SHARED_FOLDER": str(shared or self.shared)})
        self.addCleanup(self.end_program, process)
        return process, log

    @staticmethod
    def end_program(process):
        process.kill()
        process.wait()

    def write_key(self, name, digit):
        key = self.folder / name
        key.write_text(digit * 64 + "\n")
        key.chmod(0o600)
        return key

    def test_another_space_server_is_not_believed(self):
        """Without a key, and with the key of another run: while the workers wait for theirs, and while the run goes on."""
        self.machines.connect(0, 0)
        self.addCleanup(self.machines.disconnect)
        right = self.write_key("right", "1")
        strangers = {"insecure": ["--insecure"], "other": ["--key", self.write_key("wrong", "2")]}
        server_words = [EXPERIMENT, "--no-visualisers", "--ticks", TICKS]

        def invade(name, number):
            return self.start_program(1, "space_server", *server_words, *strangers[name], "--output", f"stranger{name}{number}",
                                      shared=f"{self.shared}-{name}{number}")

        def told(log, text):
            self.wait_until(f"{log.name}: {text}", lambda: text in log.read_text())

        early = {name: invade(name, 1) for name in strangers}
        workers = [self.start_program(0, "engine_worker", "--engine", "ground", "--key", right),
                   self.start_program(0, "controller_host", "--key", right)]
        for _, log in workers:
            self.wait_until("two refusals", lambda log=log: log.read_text().count("dropped a bad World message of 'space server'") == 2)
        server, server_log = self.start_program(0, "space_server", *server_words, "--key", right, "--hash-log", "cluster", "--real-time", 2,
                                                "--output", "out", "--paused")
        self.steer("step", "5")
        late = {name: invade(name, 2) for name in strangers}
        for name, (process, log) in [*early.items(), *late.items()]:
            # Who has no key says that it is none of its messages.
            told(log, "dropped a bad Join message of 'engine 'ground''")
            self.assertIsNone(process.poll(), name)
        for _, log in workers:
            self.wait_until("four refusals", lambda log=log: log.read_text().count("dropped a bad World message of 'space server'") == 4)
        self.steer("resume")
        self.assertEqual(server.wait(GENEROUS_S), 0, server_log.read_text())
        for process, log in workers:
            self.assertEqual(process.wait(GENEROUS_S), 0, log.read_text())
        self.run_it("run", EXPERIMENT, "--ticks", TICKS, "--no-visualisers", "--single-process", "--hash-log", "one")
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        for folder in self.shared.parent.glob(f"{self.shared.name}-*"):
            shutil.rmtree(folder)

    def test_a_run_of_one_machine_goes_on(self):
        """Over its loopback interface; what travels through memory is out of reach."""
        attacks = "repeat", "noise", "change", "part", "gap", "ahead", "read", "dispose", "break"
        attacker = self.attack(*attacks, interface="lo")
        run = subprocess.run(["ip", "netns", "exec", self.machines.names[0], SWARMANOID, "run", EXPERIMENT, "--ticks", str(TICKS), "--no-visualisers",
                              "--real-time", "2", "--hash-log", "cluster", "--output", "out", "--lease", "60"], check=False, cwd=self.folder,
                             capture_output=True, text=True, timeout=GENEROUS_S)
        self.assertEqual(run.returncode, 0, run.stderr)
        report = self.report(attacker)
        self.run_it("run", EXPERIMENT, "--ticks", TICKS, "--no-visualisers", "--single-process", "--hash-log", "one")
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        self.assertEqual(report["read"], [])
        for attack in "repeat", "noise", "part", "dispose", "break":
            self.assertGreater(report["sent"].get(attack, 0), 10, report)
        self.assertRegex(self.told(), "somebody without the key of this run spoke in its name, or about it; it came from 127.0.0.1 ")

    def test_a_share_reaches_another_machine(self):
        run = self.start_over_network(words=["--paused"])
        self.steer("step", "5")
        made = subprocess.run(["ip", "netns", "exec", self.machines.names[0], SWARMANOID, "share", "--watch", "--json", "--interface", "link0"],
                              check=True, capture_output=True, text=True, timeout=GENEROUS_S)
        ticket = json.loads(made.stdout)["ticket"]
        self.assertEqual(ticket.split(",")[5], "10.78.0.1")
        watcher = self.start("attach", "text", "--file", "table", "--output", self.folder, before=["ip", "netns", "exec", self.machines.names[1]],
                             environment={"SWARMANOID_SHARE": ticket, "SWARMANOID_SHARED_FOLDER": f"{self.shared}-elsewhere"})
        self.wait_until("the table of the other machine", lambda: self.has_table("table"), watcher)
        self.steer("resume")
        self.assertEqual(watcher.wait(GENEROUS_S), 0, watcher.stderr)
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
