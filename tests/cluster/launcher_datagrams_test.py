#!/usr/bin/env python3
"""A program without the key of a run sends it datagrams of RTPS whose structure is wrong: those of all published vulnerabilities of Fast DDS,
and others changed from right ones (rtps_fuzzer.py). The run goes on with the same processes and the same hash, on one machine and over a
network, with a key and without. Needs root and /dev/net/tun; skipped otherwise."""
import json
import os
import pathlib
import subprocess
import sys

import two_machines
from harness import CONFIGS, GENEROUS_S, REPLACED, SWARMANOID, LauncherTest

setUpModule = two_machines.require

FUZZER = pathlib.Path(__file__).resolve().parent / "rtps_fuzzer.py"
EXPERIMENT = CONFIGS / "diffusion_10.xml"
PROGRAMS = "space_server", "engine_worker", "controller_host"
TICKS = 100
COUNT = 5_000  # datagrams of each attack
RATE = 20_000  # a second
MOST_GROWTH_KB = 16 * 1024


def memory_of(pid):
    """Kilobytes of a process that are in memory."""
    text = pathlib.Path(f"/proc/{pid}/status").read_text()
    return int(text[text.index("VmRSS:"):].split()[1])


class Datagrams(LauncherTest):
    def setUp(self):
        super().setUp()
        self.machines = two_machines.TwoMachines(os.environ["SWARMANOID_BUILD"])
        self.addCleanup(self.machines.remove)

    def on_machine(self, machine, *words):
        answer = subprocess.run(["ip", "netns", "exec", self.machines.names[machine], *map(str, words)], check=False, cwd=self.folder,
                                capture_output=True, text=True, timeout=GENEROUS_S)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        return answer.stdout

    def steer(self, *words):
        self.on_machine(0, SWARMANOID, "control", *words, "--patience", GENEROUS_S)

    def fuzz(self, addresses, seed, *words):
        """From each machine to its own address, whose ports it sees. Returns how many datagrams were sent to each."""
        return [json.loads(self.on_machine(machine, sys.executable, FUZZER, address, COUNT, seed, RATE, *words))["sent"]
                for machine, address in enumerate(addresses)]

    def attack(self, addresses, *options, before=(), network=()):
        """A run that is attacked while it waits and while it goes on."""
        run = self.start("run", EXPERIMENT, "--ticks", TICKS, "--no-visualisers", "--paused", "--real-time", 4, "--hash-log", "cluster",
                         "--output", "out", *options, before=before)
        pids = {program: run.find(program) for program in PROGRAMS}
        self.wait_for_experiment("diffusion_10")
        self.steer(*network, "step", 5)
        memory = {program: memory_of(pid) for program, pid in pids.items()}
        insecure = ["insecure"] if "--insecure" in options else []
        self.assertGreaterEqual(min(self.fuzz(addresses, 1, *insecure)), COUNT)
        for program, pid in pids.items():
            self.assertLess(memory_of(pid) - memory[program], MOST_GROWTH_KB, program)
        self.steer(*network, "resume")
        self.fuzz(addresses, 2, *insecure)  # it may end before that does
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        for text in REPLACED, "start again", "aborted":
            self.assertNotIn(text, run.stderr)
        one = self.run_it("run", EXPERIMENT, "--ticks", TICKS, "--no-visualisers", "--single-process", "--hash-log", "one")
        self.assertEqual(self.assert_finished(run, TICKS), self.assert_finished(one, TICKS))
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        for log in ("space_server", "engine", "controller_host"):
            told = "".join(file.read_text() for file in (self.folder / "out").glob(f"{log}*.log"))
            self.assertRegex(told, rf"dropped a bad RTPS message of {addresses[0][:-1]}\d: .*, at byte \d+ of \d+; it came from port \d+")

    def on_one_machine(self, *options):
        self.attack(["127.0.0.1"], *options, network=options, before=["ip", "netns", "exec", self.machines.names[0]])

    def test_a_run_of_one_machine_goes_on(self):
        self.on_one_machine()

    def test_a_run_without_a_key_goes_on(self):
        self.on_one_machine("--insecure")

    def test_a_run_over_a_network_goes_on(self):
        hosts = self.folder / "hosts.txt"
        hosts.write_text(self.machines.hosts())
        self.machines.connect(0, 0)
        self.addCleanup(self.machines.disconnect)
        self.attack(["10.78.0.1", "10.78.0.2"], "--hosts", hosts, network=["--interface", "link0"])
