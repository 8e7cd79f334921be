#!/usr/bin/env python3
"""An engine that is split into regions, each computed by a process of its own: every tick has the hash of a run in one process, wherever
the cuts are, which processes die, and on which machines the regions are."""
import os
import pathlib
import shutil
import signal
import unittest

import two_machines
from harness import CONFIGS, GENEROUS_S, REPLACED, LauncherTest

EXPERIMENT = CONFIGS / "diffusion_1000.xml"

class SplitTest(LauncherTest):
    def one_process(self, experiment, ticks, *options, code=0):
        return super().one_process(experiment, ticks, "--no-visualisers", *options, code=code)

    def assert_rest_verified(self, run):
        """A paused run goes on to its end, and its journal holds the states that are computed again."""
        self.control("resume")
        run.wait()
        self.assertEqual(run.process.returncode, 0, run.stderr)
        verified = self.run_it("replay", "out", "--verify")
        self.assertEqual(verified.process.returncode, 0, verified.stderr)
        self.assert_nothing_left(run)

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
        self.assert_same(run, ticks, expected, code=code)

    def test_a_crowd_among_walls(self):
        for split, seed in (("5", 2), ("2x2", 3)):
            with self.subTest(split):
                self.same(CONFIGS / "crowd_in_regions.xml", 150, "--set", f"engines.ground.split={split}", "--seed", seed, hosts=2)

    def test_experiments_with_grips_mirrors_and_many_engines(self):
        for name, engine, ticks, code in (("prey_retrieval", "ground", 400, 1), ("mirrors", "ground", 300, 0), ("three_engines", "left", 200, 0),
                                          ("mirrors", "flat", 300, 0), ("three_engines", "middle", 200, 0), ("gripped_chain", "ground", 150, 0)):
            with self.subTest(name, engine=engine):
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
        self.assert_rest_verified(run)

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


def robots(count, controller):
    return (f'<distribute quantity="{count}"><position method="uniform" min="0.2, 0.2, 0" max="2.8, 2.8, 0"/><orientation method="uniform"/>'
            f'<footbot id="{controller}"><controller>{controller}</controller></footbot></distribute>')


CROWD = (robots(20, "driver") + robots(20, "pusher") + robots(25, "taker") + robots(3, "other") +
         '<distribute quantity="8"><position method="uniform" min="0.2, 0.2, 0" max="2.8, 2.8, 0"/>'
         '<cylindric_prey id="prey" radius="0.06" height="0.1"/></distribute>'
         '<distribute quantity="8"><position method="uniform" min="0.2, 0.2, 0.1" max="2.8, 2.8, 0.1"/>'
         '<block id="box" size="0.15, 0.1, 0.2" movable="true"/></distribute>')


class Groups:
    """Regions of an engine of rigid bodies solve contact groups. `pusher`s drive on, `taker`s grip and pull, another engine moves the `other`s
    among them."""
    engine_tag = ""

    def write(self, name, entities):
        path = self.folder / f"{name}.xml"
        controllers = "".join(f"""<footbot_diffusion id="{id}" library="footbot_diffusion">
      <actuators><footbot_wheels implementation="dummy_footbot_wheels"/></actuators>
      <sensors><footbot_proximity implementation="generic_footbot_proximity"/>{sensors}</sensors>
      <parameters velocity="{velocity}" alpha="{alpha}" delta="{delta}"/>
    </footbot_diffusion>""" for id, velocity, alpha, delta, sensors in (
            ("pusher", 0.2, 0, 1000, '<footbot_encoders implementation="engine_footbot_encoders"/>'), ("driver", 0.2, 7.5, 0.1, ""),
            ("other", 0.1, 7.5, 0.1, "")))
        others = '<entity id="other*"/>' if "other" in entities else ""
        path.write_text(f"""<?xml version="1.0"?>
<ahss-config>
  <framework><clocktick>100</clocktick><maxclock>1000</maxclock></framework>
  <controllers>
    {controllers}
    <footbot_chain id="taker" library="footbot_chain">
      <actuators><footbot_wheels implementation="dummy_footbot_wheels"/><footbot_gripper implementation="dummy_footbot_gripper"/></actuators>
      <sensors><footbot_gripper implementation="generic_footbot_gripper"/></sensors>
      <parameters velocity="-0.1"/>
    </footbot_chain>
  </controllers>
  <arena size="4, 4, 1" optimization="2D">
    <wall id="west" position="0, 1.5, 0.2" size="0.1, 3, 0.4"/><wall id="east" position="3, 1.5, 0.2" size="0.1, 3, 0.4"/>
    <wall id="south" position="1.5, 0, 0.2" size="3, 0.1, 0.4"/><wall id="north" position="1.5, 3, 0.2" size="3, 0.1, 0.4"/>
    {entities}
  </arena>
  <engines><dummy_engine id="beside"/><{self.engine_tag} id="ground"/></engines>
  <arena_physics>
    <engine id="beside">{others}<entity id="west"/><entity id="east"/><entity id="south"/><entity id="north"/></engine>
    <engine id="ground"><all/></engine>
  </arena_physics>
</ahss-config>
""")
        return path

    def test_the_simplest_scenes(self):
        one = '<footbot id="left" position="1.2, 1.5, 0" controller="pusher"/>'
        two = one + '<footbot id="right" position="1.8, 1.5, 0" orientation="0, 0, 180" controller="pusher"/>'
        for name, entities in (("none", ""), ("one", one), ("two", two)):
            experiment = self.write(name, entities)
            expected = self.one_process(experiment, 60)
            for split in (2, 4):
                with self.subTest(name, split=split):
                    run = self.run_it("run", experiment, "--set", f"engines.ground.split={split}", "--ticks", 60, "--hash-log", "cluster",
                                      "--output", f"out_{name}_{split}", "--no-visualisers")
                    self.assert_same(run, 60, expected)

    def test_a_crowd_and_its_checkpoints(self):
        experiment = self.write("crowd", CROWD)
        expected = self.one_process(experiment, 250)
        for split in (2, "2x2"):
            with self.subTest(split):
                same = ("--set", f"engines.ground.split={split}", "--ticks", 250, "--no-visualisers", "--hash-log", "cluster")
                run = self.run_it("run", experiment, *same, "--output", f"first{split}", "--checkpoint-every", 100, "--controller-hosts", 2)
                self.assert_same(run, 250, expected)
                checkpoint = next((self.folder / f"first{split}").glob("**/*00000200*"))
                run = self.run_it("run", experiment, *same, "--output", f"second{split}", "--restore", checkpoint)
                self.assertEqual(run.process.returncode, 0, run.stderr)
                self.assertEqual(self.assert_finished(run, 250), expected)

    def change_engines(self, text, engine):
        shutil.copytree(CONFIGS / "terrain", self.folder / "terrain")
        (self.folder / "patch.xml").write_text(text)
        expected = self.one_process("patch.xml", 400)
        run = self.run_it("run", "patch.xml", "--set", f"engines.{engine}.split=2", "--ticks", 400, "--hash-log", "cluster", "--output", "out", "--no-visualisers")
        self.assert_same(run, 400, expected)

    def test_robots_that_are_moved_removed_and_brought_back(self):
        experiment = self.write("crowd", CROWD)
        run = self.begin(120, split=3, experiment=experiment)
        self.control("step", 40)
        self.control("move", "driver_3", "3.5,3.5,0")
        self.control("step", 10)
        self.control("remove", "taker_4")
        self.control("step", 10)
        self.control("move", "driver_3", "3.2,3.8,0")
        self.assert_rest_verified(run)

    def test_a_region_its_engine_and_several_at_once_die(self):
        experiment = self.write("crowd", CROWD)
        expected = self.one_process(experiment, 280)
        run = self.begin(280, split=3, experiment=experiment)
        self.control("step", 150)
        first = run.find("engine_worker", "--region 1")
        os.kill(first, signal.SIGKILL)
        run.read_until(REPLACED)
        self.control("step", 20)
        for pid in (run.find("engine_worker", "--region 1", dead=[first]), run.find("engine_worker", "--region 2")):
            os.kill(pid, signal.SIGKILL)
        run.read_until(REPLACED)
        run.read_until(REPLACED)
        self.control("step", 20)
        for pid in (run.find("engine_worker", "--engine ground", lacks="--region"), run.find("engine_worker", "--region 0")):
            os.kill(pid, signal.SIGKILL)
        run.read_until(REPLACED)
        run.read_until(REPLACED)
        self.control("step", 20)
        self.control("move-engine", "ground/1")
        self.control("resume")
        self.assert_same(run, 280, expected)
        # Only a process that is killed while it holds a lock of DDS makes all others start again.
        if "while it held shared memory" not in run.stderr:
            self.assertNotIn("all processes start again", run.stderr)


class GroupsOfDynamics2d(Groups, SplitTest):
    engine_tag = "dynamics2d"

    def test_robots_that_change_their_engine(self):
        text = (CONFIGS / "rough_patch.xml").read_text().replace("<dummy_engine", "<dynamics2d").replace("</dummy_engine>", "</dynamics2d>")
        self.assertIn('<dynamics2d id="field"', text)
        self.change_engines(text, "field")


class GroupsOfDynamics3d(Groups, SplitTest):
    engine_tag = "dynamics3d"

    def test_robots_that_change_their_engine(self):
        self.change_engines((CONFIGS / "rough_patch.xml").read_text(), "patch")

    def test_ropes_arms_and_terrain(self):
        for name, engine, ticks in (("handbot_shelf", "room", 300), ("rough_terrain", "ground", 60)):
            with self.subTest(name):
                expected = self.one_process(CONFIGS / f"{name}.xml", ticks)
                run = self.run_it("run", CONFIGS / f"{name}.xml", "--set", f"engines.{engine}.split=3", "--ticks", ticks, "--hash-log", "cluster",
                                  "--output", f"out_{name}", "--no-visualisers")
                self.assert_same(run, ticks, expected)


class Moves(SplitTest):
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
        self.assertRegex(self.control("machines"), r"beta: no")
        self.control("resume")
        self.assert_same(run, 400, expected)


@unittest.skipUnless(two_machines.possible(), "network namespaces with a relay need root and /dev/net/tun")
class OverANetwork(SplitTest):
    def test_regions_on_two_machines_with_loss(self):
        self.run_on_two_machines(EXPERIMENT, 200)

    def test_regions_of_dynamics3d_on_two_machines_with_loss(self):
        self.run_on_two_machines(CONFIGS / "rough_terrain.xml", 60)

    def run_on_two_machines(self, experiment, ticks):
        network = two_machines.TwoMachines(os.environ["SWARMANOID_BUILD"])
        self.addCleanup(network.remove)
        expected = self.one_process(experiment, ticks)
        for loss in (0, 0.01):
            with self.subTest(loss=loss):
                network.connect(loss, 0.2)
                self.addCleanup(lambda: network.relay.poll() is None and network.disconnect())
                (self.folder / "hosts.txt").write_text(network.hosts() + f"region ground/0 = {network.names[0]}\n")
                run = self.run_it("run", experiment, "--set", "engines.ground.split=2", "--ticks", ticks, "--hosts", "hosts.txt", "--hash-log", "cluster",
                                  "--output", f"out{loss}", "--no-visualisers", before=("ip", "netns", "exec", network.names[0]), timeout=3 * GENEROUS_S)
                self.assert_same(run, ticks, expected)
                network.disconnect()
