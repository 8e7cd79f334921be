#!/usr/bin/env python3
"""Robots that change their engine: every tick has the hash of a run in one process, whichever process dies at the moment of the change, with
split engines, late commands and a network."""
import csv
import os
import signal
import unittest

import two_machines
from harness import CONFIGS, GENEROUS_S, REPLACED, LauncherTest

EXPERIMENT = CONFIGS / "rough_patch.xml"


class VolumesTest(LauncherTest):
    def one_process(self, ticks, *options):
        return super().one_process(EXPERIMENT, ticks, "--no-visualisers", *options)

    def change(self, ticks):
        """The first tick at which a robot is in the patch, and so belongs to its engine."""
        run = self.run_it("run", EXPERIMENT, "--ticks", ticks, "--single-process", "--quiet", "--output", "looked",
                          "--set", "visualisations.positions.every=1", "--set", "visualisations.positions.format=csv")
        self.assertEqual(run.process.returncode, 0, run.stderr)
        with open(self.folder / "looked/positions.txt", encoding="utf-8") as table:
            for row in csv.DictReader(table):
                if row["Entity id"].startswith(("south", "north")) and all(1.4 < float(row[axis]) < 3.6 for axis in ("X", "Y")):
                    return int(row["clock"])
        self.fail(f"no robot came into the patch in {ticks} ticks")

    def begin(self, ticks, output, *options):
        run = self.start("run", EXPERIMENT, "--ticks", ticks, "--paused", "--hash-log", "cluster", "--output", output, "--no-visualisers", *options)
        self.wait_for_experiment(EXPERIMENT.stem)
        return run


class Volumes(VolumesTest):
    def test_clusters_have_the_hash_of_one_process(self):
        ticks = 300
        for options in (("--controller-hosts", 2), ("--set", "engines.field.split=2"), ("--ahead", 1)):
            with self.subTest(options):
                expected = self.one_process(ticks, *(options if options[0] == "--ahead" else ()))
                run = self.run_it("run", EXPERIMENT, "--ticks", ticks, "--hash-log", "cluster", "--output", f"out{len(os.listdir(self.folder))}",
                                  "--no-visualisers", *options)
                self.assert_same(run, ticks, expected)

    def test_an_engine_dies_when_a_robot_changes_its_engine(self):
        ticks = 200
        tick = self.change(ticks)
        expected = self.one_process(ticks)
        for name, step in (("field", tick), ("patch", tick), ("patch", tick + 1), ("field", tick - 1)):
            with self.subTest(f"{name} at tick {step}"):
                run = self.begin(ticks, f"{name}{step}")
                self.control("step", step)
                os.kill(run.find("engine_worker", "--engine", name), signal.SIGKILL)
                said = run.read_until(REPLACED)
                self.control("resume")
                self.assert_same(run, ticks, expected, said)

    def test_all_die_after_a_change_and_the_run_is_repeated(self):
        ticks = 250
        expected = self.one_process(ticks)
        run = self.begin(ticks, "out", "--controller-hosts", 2)
        self.control("step", self.change(ticks) + 1)
        self.kill_all(run)
        resumed = self.run_it("resume", "out", "--quiet")
        self.assertEqual(resumed.process.returncode, 0, resumed.stderr)
        self.assertEqual(self.assert_finished(resumed, ticks), expected)
        verified = self.run_it("replay", "out", "--verify")
        self.assertEqual(verified.process.returncode, 0, verified.stderr)

    def test_leaving_all_volumes_names_the_robot(self):
        run = self.run_it("run", EXPERIMENT, "--ticks", 600, "--no-visualisers", "--quiet", "--set", "arena_physics.patch.volume=1.3, 1.3, 2.5, 3.7")
        self.assertEqual(run.process.returncode, 4, run.stderr)
        self.assertRegex(run.stderr, r"the footbot '\w+' left the volumes of all engines that can move it: it is at [-\d., e]+, and they are 'field' within")


@unittest.skipUnless(two_machines.possible(), "network namespaces with a relay need root and /dev/net/tun")
class OverANetwork(VolumesTest):
    def test_engines_on_two_machines_with_loss(self):
        """Engines and hosts hear parts of the state."""
        ticks = 200
        network = two_machines.TwoMachines(os.environ["SWARMANOID_BUILD"])
        self.addCleanup(network.remove)
        expected = self.one_process(ticks)
        network.connect(0.01, 0.2)
        self.addCleanup(lambda: network.relay.poll() is None and network.disconnect())
        (self.folder / "hosts.txt").write_text(network.hosts() + f"engine patch = {network.names[0]}\n")
        run = self.run_it("run", EXPERIMENT, "--ticks", ticks, "--hosts", "hosts.txt", "--controller-hosts", 2, "--hash-log", "cluster", "--output", "out",
                          "--no-visualisers", before=("ip", "netns", "exec", network.names[0]), timeout=3 * GENEROUS_S)
        self.assert_same(run, ticks, expected)
