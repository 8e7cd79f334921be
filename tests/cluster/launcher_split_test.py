#!/usr/bin/env python3
"""An engine whose plane is cut into regions, each computed by a process of its own: every tick has the hash of a run in one process, wherever
the cuts are, whoever dies, and on whichever machines the regions are."""
import os
import pathlib
import random
import signal
import time
import unittest

import two_machines
from harness import CONFIGS, GENEROUS_S, LauncherTest, children_of, words_of

EXPERIMENT = CONFIGS / "diffusion_1000.xml"
REPLACED = "another process takes its place"
KILLS = int(os.environ.get("SWARMANOID_KILLS", "12"))
SEED = int(os.environ.get("SWARMANOID_KILLS_SEED", "1"))

class SplitTest(LauncherTest):
    def one_process(self, experiment, ticks, *options, code=0):
        output = f"one_out{len(os.listdir(self.folder))}"
        run = self.run_it("run", experiment, "--ticks", ticks, "--single-process", "--quiet", "--hash-log", "one", "--output", output,
                          "--no-visualisers", *options)
        self.assertEqual(run.process.returncode, code, run.stderr)
        return self.assert_finished(run, ticks)

    def assert_same(self, run, ticks, expected, code=0):
        if not hasattr(run, "stdout"):
            run.wait()
        self.assertEqual(run.process.returncode, code, run.stderr)
        self.assertEqual(self.assert_finished(run, ticks), expected)
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        self.assert_nothing_left(run)

    def region(self, run, number, dead=()):
        found = []

        def is_there():
            for pid in children_of(run.process.pid):
                words = words_of(pid)
                if "--region" in words and words[words.index("--region") + 1] == str(number) and pid not in dead:
                    found.append(pid)
            return bool(found)

        self.wait_until(f"region {number}", is_there, run)
        return found[-1]

    def leader(self, run):
        return next(pid for pid in children_of(run.process.pid)
                    if (words := words_of(pid)) and os.path.basename(words[0]) == "engine_worker" and "--region" not in words)

    def begin(self, ticks, *options, split=2, experiment=EXPERIMENT, before=()):
        run = self.start("run", experiment, "--set", f"engines.ground.split={split}", "--ticks", ticks, "--paused", "--hash-log", "cluster",
                         "--output", "out", "--no-visualisers", *options, before=before)
        self.wait_for_experiment(experiment.stem)
        return run


class Split(SplitTest):
    def same(self, experiment, ticks, *options, hosts=1, code=0):
        expected = self.one_process(experiment, ticks, *options, code=code)
        run = self.run_it("run", experiment, "--ticks", ticks, "--hash-log", "cluster", "--output", f"out{len(os.listdir(self.folder))}",
                          "--no-visualisers", "--controller-hosts", hosts, *options)
        self.assert_same(run, ticks, expected, code)

    def test_a_crowd_among_walls(self):
        for split, seed in (("2", 1), ("5", 2), ("2x2", 3), ("1x3", 4)):
            with self.subTest(split):
                self.same(CONFIGS / "crowd_in_regions.xml", 150, "--set", f"engines.ground.split={split}", "--seed", seed, hosts=2)

    def test_experiments_with_grips_mirrors_and_many_engines(self):
        for name, engine, ticks, code in (("prey_retrieval", "ground", 400, 1), ("mirrors", "ground", 300, 0), ("three_engines", "left", 200, 0),
                                          ("prey_supply", "ground", 300, 0)):
            with self.subTest(name):
                self.same(CONFIGS / f"{name}.xml", ticks, "--set", f"engines.{engine}.split=3", code=code)

    def test_two_engines_that_are_split(self):
        self.same(CONFIGS / "three_planes.xml", 200, "--set", "engines.ground.split=2", "--set", "engines.wall.split=3")

    def test_from_a_checkpoint(self):
        expected = self.one_process(EXPERIMENT, 250)
        first = self.run_it("run", EXPERIMENT, "--set", "engines.ground.split=3", "--ticks", 120, "--checkpoint-every", 100, "--output", "first",
                            "--no-visualisers", "--quiet")
        self.assertEqual(first.process.returncode, 0, first.stderr)
        checkpoint = next(pathlib.Path(self.folder / "first").glob("**/*100*"))
        same = ("--set", "engines.ground.split=3", "--restore", checkpoint)
        other = ("--branch", "first@100", "--set", "engines.ground.split=2")
        for output, options in (("second", (EXPERIMENT, *same)), ("third", other)):
            run = self.run_it("run", *options, "--ticks", 250, "--output", output, "--no-visualisers", "--quiet")
            self.assertEqual(run.process.returncode, 0, run.stderr)
            self.assertEqual(self.assert_finished(run, 250), expected)

    def test_users_move_robots_and_steer(self):
        run = self.begin(200, split="2x2")
        self.control("step", 40)
        self.control("move", "fb_3", "12,9,0")
        self.control("step", 10)
        self.control("remove", "fb_4")
        self.control("step", 10)
        self.control("resume")
        run.wait()
        self.assertEqual(run.process.returncode, 0, run.stderr)
        verified = self.run_it("replay", "out", "--verify")
        self.assertEqual(verified.process.returncode, 0, verified.stderr)
        self.assert_nothing_left(run)

    def test_commands_a_tick_later_and_more_controller_hosts(self):
        expected = self.one_process(EXPERIMENT, 300, "--ahead", 1)
        run = self.begin(300, "--ahead", 1, split=3)
        self.control("step", 120)
        self.assertIn("2 controller hosts share the robots now", self.control("hosts", "+1"))
        self.control("step", 30)
        self.control("resume")
        self.assert_same(run, 300, expected)

    def test_after_everything_died(self):
        expected = self.one_process(EXPERIMENT, 300)
        run = self.begin(300, split=2)
        self.control("step", 170)
        self.kill_all(run)
        resumed = self.run_it("resume", "out", "--quiet")
        self.assertEqual(resumed.process.returncode, 0, resumed.stderr)
        self.assertEqual(self.assert_finished(resumed, 300), expected)

    def test_what_cannot_be_split(self):
        said = self.run_it("check", CONFIGS / "crowd_in_regions.xml").stdout
        self.assertIn("ground (dummy_engine): 805 of the entities, in 4 regions", said)
        for split, said in (("0", "it must be a number of regions from 1 to 32"), ("33", "it must be"), ("2*2", "it must be"), ("8x8", "it must be")):
            answer = self.run_it("run", EXPERIMENT, "--set", f"engines.ground.split={split}", "--ticks", 1)
            self.assertEqual(answer.process.returncode, 3, answer.stderr)
            self.assertIn(said, answer.stderr)
        answer = self.run_it("run", CONFIGS / "diffusion_100_dynamics2d.xml", "--set", "engines.ground.split=2", "--ticks", 1)
        self.assertEqual(answer.process.returncode, 3, answer.stderr)
        self.assertIn("the engine 'ground' (dynamics2d) cannot be split", answer.stderr)


class WhoDies(SplitTest):
    def test_a_region_its_engine_and_several_at_once(self):
        expected = self.one_process(EXPERIMENT, 400)
        run = self.begin(400, split=3)
        self.control("step", 150)
        first = self.region(run, 1)
        os.kill(first, signal.SIGKILL)
        run.read_until(REPLACED)
        self.control("step", 50)
        second = self.region(run, 1, dead=[first])
        for pid in (second, self.region(run, 2)):
            os.kill(pid, signal.SIGKILL)
        run.read_until(REPLACED)
        run.read_until(REPLACED)
        self.control("step", 50)
        for pid in (self.leader(run), self.region(run, 0)):
            os.kill(pid, signal.SIGKILL)
        run.read_until(REPLACED)
        run.read_until(REPLACED)
        self.control("resume")
        self.assert_same(run, 400, expected)
        self.assertNotIn("all processes start again", run.stderr)

    def test_a_region_that_comes_after_the_last_tick(self):
        expected = self.one_process(EXPERIMENT, 200)
        run = self.begin(200, "--retries", 50)
        self.control("step", 150)
        dead = [self.region(run, 0), self.leader(run)]
        for pid in dead:
            os.kill(pid, signal.SIGKILL)
        late = self.region(run, 0, dead=dead)
        os.kill(late, signal.SIGSTOP)
        # On a busy machine it may have joined the run already, and the engine would wait for it. Then the next ones are tried.
        while list(self.shared.rglob(f"process.{late}")):
            for pid in (late, self.leader(run)):
                dead.append(pid)
                os.kill(pid, signal.SIGKILL)
            late = self.region(run, 0, dead=dead)
            os.kill(late, signal.SIGSTOP)
        for _ in range(len(dead)):
            run.read_until(REPLACED)
        # The engine does without its regions until all are there.
        self.control("resume")
        self.wait_for_tick("cluster", 199, run)
        run.read_until("waiting for engine 'ground', region 0 of engine 'ground', region 1")
        os.kill(late, signal.SIGCONT)
        self.assert_same(run, 200, expected)

    def test_one_that_is_stopped_for_longer_than_the_lease(self):
        expected = self.one_process(EXPERIMENT, 300)
        run = self.begin(300, "--lease", 1)
        self.control("step", 150)
        os.kill(self.region(run, 0), signal.SIGSTOP)
        self.control("resume")
        run.read_until(REPLACED)
        self.assert_same(run, 300, expected)

    def test_kills_at_random_moments(self):
        ticks = 250 * KILLS
        expected = self.one_process(EXPERIMENT, ticks)
        run = self.start("run", EXPERIMENT, "--set", "engines.ground.split=3", "--ticks", ticks, "--hash-log", "cluster", "--output", "out",
                         "--no-visualisers", "--retries", 1000, "--lease", 10)
        self.wait_for_tick("cluster", 1, run)
        seed = random.Random(SEED)
        killed = 0
        while killed < KILLS and run.process.poll() is None:
            time.sleep(seed.uniform(0, 0.6))
            pids = [pid for pid in children_of(run.process.pid)
                    if (words := words_of(pid)) and os.path.basename(words[0]) in ("engine_worker", "controller_host", "space_server")]
            for pid in seed.sample(pids, min(len(pids), seed.choice([1, 1, 1, 2]))):
                try:
                    os.kill(pid, signal.SIGKILL)
                    killed += 1
                except ProcessLookupError:
                    pass
        run.wait(10 * GENEROUS_S)
        self.assertGreaterEqual(killed, KILLS // 2)
        self.assert_same(run, ticks, expected)

    def test_regions_move(self):
        expected = self.one_process(EXPERIMENT, 400)
        reach = self.folder / "reach.sh"
        reach.write_text('#!/bin/sh\nshift\nexec sh -c "$*"\n')
        reach.chmod(0o755)
        (self.folder / "hosts.txt").write_text(f"command = {reach} {{host}} {{shell_command}}\nmachines = beta\nregion ground/1 = beta\n"
                                               "options = --interface lo\n")
        run = self.begin(400, "--hosts", "hosts.txt")
        self.assertRegex(self.control("machines"), r"beta: region 1 of engine 'ground'")
        self.control("step", 100)
        self.assertRegex(self.control("move-engine", "ground/1", "here"), r"region 1 of engine 'ground' is process \S+ now, at tick 100")
        self.control("step", 100)
        self.control("move-engine", "ground", "beta")
        self.control("move-engine", "ground/0", "beta")
        self.control("step", 100)
        self.control("drain", "beta")
        self.assertRegex(self.control("machines"), r"beta: nobody")
        self.control("resume")
        self.assert_same(run, 400, expected)


@unittest.skipUnless(two_machines.possible(), "network namespaces with a relay need root and /dev/net/tun")
class OverANetwork(SplitTest):
    def test_regions_on_two_machines_with_loss(self):
        network = two_machines.TwoMachines(os.environ["SWARMANOID_BUILD"])
        self.addCleanup(network.remove)
        expected = self.one_process(EXPERIMENT, 200)
        for loss in (0, 0.01):
            with self.subTest(loss=loss):
                network.connect(loss, 0.2)
                self.addCleanup(lambda: network.relay.poll() is None and network.disconnect())
                (self.folder / "hosts.txt").write_text(network.hosts() + f"region ground/0 = {network.names[0]}\n")
                run = self.run_it("run", EXPERIMENT, "--set", "engines.ground.split=2", "--ticks", 200, "--hosts", "hosts.txt", "--hash-log", "cluster",
                                  "--output", f"out{loss}", "--no-visualisers", before=("ip", "netns", "exec", network.names[0]), timeout=3 * GENEROUS_S)
                self.assert_same(run, 200, expected)
                network.disconnect()
