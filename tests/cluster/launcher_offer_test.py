#!/usr/bin/env python3
"""Machines that are offered by hand: workers move there and back, die there and with them, and every tick has the hash of a run in one
process that nobody disturbed."""
import csv
import os
import pathlib
import re
import shutil
import signal
import subprocess
import threading
import unittest

import two_machines
from harness import CONFIGS, GENEROUS_S, LauncherTest, children_of, main, stat_of, words_of

EXPERIMENT = CONFIGS / "diffusion_10.xml"
TICKS = 1500
SLOW = 0.2  # two ticks a second: what is left of them outlasts the test
PROGRAMS = os.path.join(os.environ["SWARMANOID_BUILD"], "bin")


class Agent:
    """A process that offers its machine. What it says is read all the time."""

    def __init__(self, folder, *words, program="controller_host", before=(), environment=None):
        self.process = subprocess.Popen([*before, os.path.join(PROGRAMS, program), *map(str, words)], cwd=folder, stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT, text=True, env={**os.environ, **(environment or {})}, start_new_session=True)
        self.said = ""
        self.reader = threading.Thread(target=self.read)
        self.reader.start()

    def read(self):
        for line in self.process.stdout:
            self.said += line

    def wait(self):
        code = self.process.wait(GENEROUS_S)
        self.reader.join(GENEROUS_S)
        self.process.stdout.close()
        return code


class OfferTest(LauncherTest):
    def begin(self, *options, experiment=EXPERIMENT, ticks=TICKS, hosts=2, before=()):
        run = self.start("run", experiment, "--ticks", ticks, "--paused", "--hash-log", "cluster", "--output", "out", "--controller-hosts", hosts,
                         *(["--no-visualisers"] if experiment != EXPERIMENT else []), *options, before=before)
        self.wait_for_experiment(experiment.stem)
        listed = self.run_it("list", "experiments").stdout
        self.domain = re.search(rf"{experiment.stem} +domain (\d+)", listed)[1]
        return run

    def offer(self, name="beta", *words, taken=True, **how):
        agent = Agent(self.folder, "--offer", name, "--domain", self.domain, *words, **how)
        self.addCleanup(lambda: agent.process.poll() is None and (agent.process.kill(), agent.wait()))
        if taken:
            self.wait_until("the offer", lambda: "offered to the run" in agent.said or agent.process.poll() is not None)
            self.assertIn("offered to the run", agent.said)
        return agent

    def machines(self):
        return self.control("machines").split(": ", 1)[1].strip()

    def workers_of(self, agent):
        """Words of those that run as its children, by process id."""
        return {pid: words_of(pid) for pid in children_of(agent.process.pid) if (stat_of(pid) or (0, 0, "Z"))[2] != "Z"}

    def kill_one(self, run, agent, role, name):
        """Of the two workers there; another one takes its place there."""
        killed = next(pid for pid, words in self.workers_of(agent).items() if role in words)
        os.kill(killed, signal.SIGKILL)
        run.read_until(f"{name} on beta was killed by signal 9 (Killed)")
        self.wait_until(f"another {name}", lambda: len(self.workers_of(agent)) == 2 and killed not in self.workers_of(agent), run)

    def assert_undisturbed(self, run, experiment=EXPERIMENT, ticks=TICKS):
        one = self.run_it("run", experiment, "--ticks", ticks, "--single-process", "--quiet", "--hash-log", "one", "--output", "one_out",
                          *(["--no-visualisers"] if experiment != EXPERIMENT else []))
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(self.assert_finished(run, ticks), self.assert_finished(one, ticks))
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        self.assert_nothing_left(run)

    def events(self):
        with (self.folder / "out/events.csv").open() as file:
            return [(row["tick"], row["request"], row["entity"]) for row in csv.DictReader(file)
                    if row["request"] in ("offer", "withdraw", "gone", "refused")]

    def key(self, name):
        path = self.folder / name
        path.write_text(os.urandom(32).hex() + "\n")
        path.chmod(0o600)
        return path


class Offers(OfferTest):
    def test_workers_move_there_and_back(self):
        run = self.begin()
        agent = self.offer()
        self.assertEqual(self.machines(), f"here: controller host 0, controller host 1, engine 'ground', space server, visualiser 'positions'; "
                                          f"beta (offered by {os.uname().nodename}:{agent.process.pid}): nobody")
        self.control("step", 300)
        self.assertRegex(self.control("move-host", "1", "beta"), r"controller host 1 is process \S+ now, at tick 300")
        self.control("step", 100)
        self.control("move-engine", "ground", "beta")
        self.control("step", 100)
        workers = list(self.workers_of(agent).values())
        self.assertEqual(sorted(os.path.basename(words[0]) for words in workers), ["controller_host", "engine_worker"])
        # Another host is placed where somebody offers a machine.
        self.assertIn("3 controller hosts", self.control("hosts", "+1"))
        # All processes have started again: until it offers itself anew, the machine of these workers is named all the same.
        listed = r"^here: controller host 0, space server, visualiser 'positions'; beta \(%s\): controller host 1, controller host 2, engine 'ground'$"
        self.assertRegex(self.machines(), listed % "(offered by .*|not offered now)")
        self.wait_until("that it is offered again", lambda: re.match(listed % "offered by .*", self.machines()))
        self.control("step", 100)
        moved = self.control("drain", "beta")
        for worker in ("controller host 1", "controller host 2", "engine 'ground'"):
            self.assertIn(f"{worker} is process", moved)
        self.assertRegex(self.machines(), r"beta \(.*\): nobody$")
        self.control("step", 100)
        self.control("move-host", "2", "beta")
        self.control("hosts", "-1", "beta")
        self.control("resume")
        self.assert_undisturbed(run)
        self.assertEqual(agent.wait(), 0, agent.said)
        self.assertIn("the run has ended", agent.said)
        for text in ("machine 'beta' is offered: workers may be moved there", "controller host 1 moves to beta"):
            self.assertIn(text, run.stderr)
        self.assertEqual(self.events()[0], ("0", "offer", "beta"))
        self.assertNotIn("refused", [event[1] for event in self.events()])

    def test_the_run_ends_with_workers_there(self):
        run = self.begin()
        agent = self.offer("beta", program="engine_worker")
        self.control("move-host", "0", "beta")
        self.control("move-engine", "ground", "beta")
        self.control("resume")
        self.assert_undisturbed(run)
        self.assertEqual(agent.wait(), 0, agent.said)
        self.assertEqual(agent.said.count("ended\n"), 3, agent.said)
        # Their logs are where they always are.
        self.assertTrue((self.folder / "out/controller_host-0.log").exists())

    def test_who_is_killed_there(self):
        run = self.begin()
        agent = self.offer()
        self.control("step", 300)
        self.control("move-host", "1", "beta")
        self.control("move-engine", "ground", "beta")
        # A worker: another process of that machine takes its place, if the run has gone on since it came there, by however little.
        self.control("step", 1)
        self.kill_one(run, agent, "--engine", "engine 'ground'")
        self.control("speed", SLOW)
        self.control("resume")
        self.kill_one(run, agent, "--host", "controller host 1")
        self.control("pause")
        self.control("speed", 0)
        after = self.workers_of(agent)
        # The process that offers the machine: its workers end with it, and are replaced here.
        os.kill(agent.process.pid, signal.SIGKILL)
        agent.wait()
        run.read_until("has no machine any more: nobody answers there")
        self.wait_until("the end of the workers", lambda: not any(stat_of(pid) and stat_of(pid)[2] != "Z" for pid in after))
        self.control("step", 200)
        self.wait_until("that the offer is over", lambda: "beta" not in self.machines())
        self.assertRegex(self.machines(), "^here: [^;]*controller host 1, engine 'ground'")
        # Who offers it again is taken at his word.
        again = self.offer()
        self.control("move-host", "0", "beta")
        self.control("resume")
        self.assert_undisturbed(run)
        self.assertEqual(again.wait(), 0, again.said)
        self.assertIn(("gone", "beta"), [event[1:] for event in self.events()])

    def test_an_offer_is_taken_back(self):
        run = self.begin()
        agent = self.offer()
        self.control("step", 300)
        self.control("move-host", "1", "beta")
        self.control("move-engine", "ground", "beta")
        self.control("step", 100)
        os.kill(agent.process.pid, signal.SIGINT)
        self.assertEqual(agent.wait(), 0, agent.said)
        self.assertRegex(agent.said, r"controller host 1 is process \S+ now, engine 'ground' is process \S+ now, at tick 400|"
                                     r"engine 'ground' is process \S+ now, controller host 1 is process \S+ now, at tick 400")
        self.assertNotIn("beta", self.machines())
        # While the run goes on, and with nobody there.
        self.control("speed", SLOW)
        self.control("resume")
        for name in ("gamma", "delta"):
            agent = self.offer(name)
            if name == "gamma":
                self.control("move-host", "0", "gamma")
            os.kill(agent.process.pid, signal.SIGTERM)
            self.assertEqual(agent.wait(), 0, agent.said)
        self.assertIn("no worker is at delta", agent.said)
        self.control("speed", 0)
        self.assert_undisturbed(run)
        self.assertIn(("400", "withdraw", "beta"), self.events())
        self.assertNotIn("another process takes its place", run.stderr)

    def test_all_start_again_with_workers_there(self):
        run = self.begin()
        agent = self.offer()
        self.control("step", 300)
        self.control("move-host", "1", "beta")
        self.control("step", 100)
        os.kill(run.find("space_server"), signal.SIGKILL)
        run.read_until("all processes start again where the journal ends")
        self.wait_for_experiment("diffusion_10")
        self.wait_until("that it is offered again", lambda: "offered by" in self.machines())
        self.assertRegex(self.machines(), r"beta \(.*\): controller host 1$")
        self.control("move-engine", "ground", "beta")
        self.control("resume")
        self.assert_undisturbed(run)
        self.assertEqual(agent.wait(), 0, agent.said)

    def test_a_controller_that_crashes_there(self):
        """What the worker said of itself is known as if it were here: the robot is stopped, and the run goes on."""
        experiment = self.write_faulty("step_crashes", tick=50)
        experiment.write_text(experiment.read_text().replace('library="faulty_controller"', 'library="faulty_controller" on_failure="stop_robot"'))
        run = self.begin(experiment=experiment, ticks=200, hosts=1)
        agent = self.offer()
        self.control("move-host", "0", "beta")
        self.control("resume")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertIn("robot 'robot_one', controller 'c': ControlStep at tick 50 aborted", run.stderr)
        here = self.run_it("run", experiment, "--ticks", 200, "--hash-log", "here", "--output", "here_out")
        self.assertEqual(self.assert_finished(run, 200), self.assert_finished(here, 200))
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "here").read_text())
        self.assertEqual(agent.wait(), 0, agent.said)

    def refused(self, agent, *says, code=2):
        self.assertEqual(agent.wait(), code, agent.said)
        for text in says:
            self.assertIn(text, agent.said)

    def test_what_cannot_be(self):
        run = self.begin()
        self.offer()
        self.refused(self.offer(taken=False), "machine 'beta' is offered already, by process", "offer it under another name")
        self.refused(self.offer("here", taken=False), "it must be another name: that one is the launcher's machine")
        self.refused(self.offer("a b", taken=False), "it must be a name of up to 63 letters, digits")
        self.refused(self.offer("gamma", "--host", 1, taken=False), "--host: the run says which workers run on a machine that is offered")
        self.refused(self.offer("gamma", "--key-fd", 0, taken=False), "give it by --key FILE")
        self.refused(self.offer("gamma", "--experiment", "others", taken=False), "no run of 'others' was heard in domain", "'diffusion_10' in domain",
                     code=4)
        # As if it had been installed from another package: its libraries are not those of the run.
        (self.folder / "lib").mkdir()
        for library in pathlib.Path(os.environ["SWARMANOID_BUILD"], "lib").glob("libswarmanoid_common.so*"):
            shutil.copy(library, self.folder / "lib")
        self.refused(self.offer("gamma", taken=False, environment={"LD_LIBRARY_PATH": str(self.folder / "lib")}),
                     "machine 'gamma' has another build of Swarmanoid than the run", "install the same package there")
        answer = self.run_it("control", "move-host", "1", "bta")
        self.assertIn("the run has no machine 'bta'; it has here, beta; did you mean 'beta'?", answer.stderr)
        self.assertIn("controller_host --offer NAME", answer.stderr)
        self.control("stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertIn("refused an offer of", run.stderr)

    def test_a_run_whose_processes_cannot_be_moved(self):
        run = self.begin("--no-recovery")
        self.refused(self.offer(taken=False), "no process of this run can be moved")
        self.control("stop")
        self.assertEqual(run.wait(), 0, run.stderr)

    def test_only_who_has_the_key_is_heard(self):
        """As from another machine, where nobody finds the key of the run by himself."""
        elsewhere = {"SWARMANOID_SHARED_FOLDER": str(self.folder / "elsewhere")}
        key = self.key("run.key")
        run = self.begin("--key", key)
        without = self.offer(taken=False, environment=elsewhere)
        other = self.offer("gamma", "--key", self.key("other.key"), taken=False, environment=elsewhere)
        insecure = self.offer("delta", "--insecure", taken=False, environment=elsewhere)
        agent = self.offer("epsilon", "--key", key)
        # The run uses no network, and its memory is in a folder that is not found there.
        far = self.offer("zeta", "--key", key, taken=False, environment=elsewhere)
        self.refused(far, "uses no network: only its user can offer, on its own machine")
        self.refused(insecure, "use programs of one release", code=4)
        for refused in (without, other):
            self.refused(refused, "no run of any experiment was heard", "--key", code=4)
        self.assertIn("it is not sealed by the key of this run", without.said)
        self.assertRegex(self.machines(), r"^here: [^;]*; epsilon \([^;]*\): nobody$")
        self.control("move-host", "1", "epsilon")
        self.control("resume")
        self.assert_undisturbed(run)
        self.assertEqual(agent.wait(), 0, agent.said)
        self.refused_options(key)

    def refused_options(self, key):
        for options in (["--insecure"], ["--single-process"]):
            answer = self.run_it("run", EXPERIMENT, "--key", key, *options)
            self.assertEqual(answer.process.returncode, 2, answer.stderr)
            self.assertIn("--key", answer.stderr)


@unittest.skipUnless(two_machines.possible(), "network namespaces with a relay need root and /dev/net/tun")
class OverANetwork(OfferTest):
    def setUp(self):
        super().setUp()
        self.network = two_machines.TwoMachines(os.environ["SWARMANOID_BUILD"])
        self.addCleanup(self.network.remove)
        self.here, self.there = (("ip", "netns", "exec", name) for name in self.network.names)
        self.network.connect(0, 1)
        self.addCleanup(lambda: self.network.relay.poll() is None and self.network.disconnect())

    def control(self, *words):
        answer = self.run_it("control", "--interface", "link0", "--domain", self.domain, *words, before=self.here)
        self.assertEqual(answer.process.returncode, 0, answer.stderr)
        return answer.stdout

    def test_a_machine_comes_and_is_cut_off_and_comes_again(self):
        (self.folder / "hosts.txt").write_text("options = --interface link0\n")
        key = self.key("run.key")
        run = self.begin("--hosts", "hosts.txt", "--key", key, before=self.here)
        # As on another machine: nothing of the run is found there but by the network.
        agent = self.offer("beta", "--interface", "link0", "--key", key, before=self.there,
                           environment={"SWARMANOID_SHARED_FOLDER": str(self.folder / "elsewhere")})
        self.control("step", 100)
        self.control("move-host", "1", "beta")
        self.control("step", 120)
        self.control("speed", SLOW)
        self.control("resume")
        self.network.disconnect()
        # The run goes on without the machine …
        run.read_until("another process takes its place")
        self.wait_until("that it has gone", lambda: "beta" not in self.machines())
        self.assertRegex(self.machines(), "controller host 1")
        # … and with it once it is heard again.
        self.network.connect(0, 1)
        self.wait_until("that it is back", lambda: "beta (offered by" in self.machines())
        self.control("move-host", "0", "beta")
        self.control("speed", 0)
        self.assert_undisturbed(run)
        self.assertEqual(agent.wait(), 0, agent.said)


if __name__ == "__main__":
    main()
