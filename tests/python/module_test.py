"""The module against the command `swarmanoid run`, closed forms, and what it refuses."""
import contextlib
import csv
import gc
import importlib.util
import io
import os
import pathlib
import re
import sqlite3
import subprocess
import sys
import threading
import unittest
import unittest.mock

import numpy as np

import scene
import swarmanoid
from world.case import InFolderCase, controller, devices, experiment

CONFIGS = pathlib.Path(os.environ["SWARMANOID_CONFIGS"])
AXLE_M, RADIUS_M = 0.14, 0.029112741
BODY_M = 0.085036758


def hash_of_run(file, *options):
    run = subprocess.run([os.environ["SWARMANOID"], "run", file, "--single-process", "--no-visualisers", "--quiet", *options],
                         capture_output=True, text=True, timeout=200)
    return re.search(r"hash ([0-9a-f]{16})", run.stdout).group(1)


class Equality(InFolderCase):
    def test_same_bits_as_the_command(self):
        # Each engine: the libraries of ODE and Box2D, too, must not take libm's functions.
        for name, ticks in (("diffusion_10", 300), ("diffusion_100_dynamics2d", 50), ("diffusion_100_dynamics3d", 20)):
            with self.subTest(name):
                file = CONFIGS / f"{name}.xml"
                with swarmanoid.Simulation(file, {"framework.seed": 5, "framework.maxclock": ticks}) as simulation:
                    while simulation.step():
                        pass
                    summary = simulation.finish()
                self.assertEqual(summary.ticks, ticks)
                self.assertEqual(summary.hash, hash_of_run(file, "--seed", "5", "--ticks", str(ticks)))
                self.assertEqual(simulation.finish(), summary)

    def test_controllers_in_scripts_have_the_bits_of_the_command(self):
        scripts = {"lua": """state = {}
function step() robot.footbot_wheels.set(5 + math.sin(robot.tick), robot.random.uniform(2, 8)) end
""", "python": """import math
import numpy as np
stateless = True
def step(robots):
    robots.actuators["footbot_wheels"] = np.stack([np.full(len(robots), 5 + math.sin(robots.tick)), robots.uniform(2, 8)], axis=1)
"""}
        for language, text in scripts.items():
            if subprocess.run([os.environ["SWARMANOID"], "list", "plugins", language], capture_output=True).returncode:
                continue  # the build does not have it
            with self.subTest(language):
                pathlib.Path(f"walk.{language}").write_text(text)
                file = experiment(pathlib.Path(f"{language}.xml"), "<maxclock>100</maxclock>",
                                  controller(f"{language}_controller", ["dummy_footbot_wheels"], parameters=f"<script>walk.{language}</script>",
                                             library=language),
                                  '<footbot id="a" position="1,1,0" controller="c"/><footbot id="b" position="2,1,0" controller="c"/>')
                both = [swarmanoid.Simulation(file) for _ in range(2)]
                while all([simulation.step(3) for simulation in both]):
                    pass
                command = hash_of_run(file)
                self.assertEqual([simulation.finish().hash for simulation in both], [command] * 2)

    def test_simulations_side_by_side_do_not_disturb_each_other(self):
        file = CONFIGS / "diffusion_10.xml"
        alone = []
        for seed in (1, 2):
            simulation = swarmanoid.Simulation(file, {"framework.seed": seed, "framework.maxclock": 100})
            alone.append(simulation.run().hash)
        both = [swarmanoid.Simulation(file, {"framework.seed": seed, "framework.maxclock": 100}) for seed in (1, 2)]
        while all([simulation.step(7) for simulation in both]):
            pass
        self.assertEqual([simulation.finish().hash for simulation in both], alone)

    def test_threads_of_python_have_a_simulation_each(self):
        file, hashes = CONFIGS / "diffusion_10.xml", {}

        def run(seed):
            hashes[seed] = swarmanoid.Simulation(file, {"framework.seed": seed, "framework.maxclock": 200}).run().hash

        threads = [threading.Thread(target=run, args=(seed,)) for seed in (1, 2)]
        [thread.start() for thread in threads]
        [thread.join() for thread in threads]
        for seed in (1, 2):
            again = swarmanoid.Simulation(file, {"framework.seed": seed, "framework.maxclock": 200}).run().hash
            self.assertEqual(hashes[seed], again)


class Arrays(InFolderCase):
    def test_views_follow_the_simulation_without_copies(self):
        simulation = swarmanoid.Simulation(scene.write(self.folder))
        x = simulation.x
        self.assertTrue(np.shares_memory(x, simulation.x))
        self.assertFalse(x.flags.writeable)
        robots = simulation.robots["driver"]
        self.assertEqual(robots.ids, ["a", "b"])
        wheels = robots.actuators["footbot_wheels"]
        wheels[:] = 5
        before = x[simulation.index("a")]
        simulation.step(10)
        self.assertAlmostEqual(x[simulation.index("a")] - before, 10 * 0.1 * 5 * RADIUS_M, 12)
        del simulation, robots
        gc.collect()
        self.assertTrue(np.isfinite(x).all())  # the view keeps what it shows

    def test_entities_by_kind_and_attribute(self):
        simulation = swarmanoid.Simulation(scene.write(self.folder))
        self.assertEqual([simulation.ids[index] for index in simulation.of_kind("footbot")], ["a", "b"])
        np.testing.assert_allclose(simulation.positions("footbot"), [[2, 1, 0], [1, 3, 0]])
        np.testing.assert_allclose(simulation.headings("footbot"), [0, np.pi / 2], atol=1e-12)
        leds = simulation.robots["driver"].actuators["footbot_leds"]
        leds[1, 3] = 0x00FF00
        simulation.step()
        self.assertEqual(simulation.attribute("led", "b")[0, 3], 0x00FF00)
        self.assertEqual(simulation.attribute("led", "footbot").shape, (2, 12))
        self.assertEqual(simulation.attribute("led", "a").sum(), 0)
        with self.assertRaisesRegex(KeyError, "'wall' has no attribute 'led'; it has: colour"):
            simulation.attribute("led", "wall")
        self.assertTrue(simulation.present().all())

    def test_a_turn_is_that_of_a_differential_drive(self):
        simulation = swarmanoid.Simulation(scene.write(self.folder))
        simulation.robots["driver"].actuators["footbot_wheels"][0] = [-1, 1]
        simulation.step(20)
        self.assertAlmostEqual(simulation.headings()[simulation.index("a")], 20 * 0.1 * 2 * RADIUS_M / AXLE_M, 9)

    def test_sensors_are_those_of_the_present_tick(self):
        simulation = swarmanoid.Simulation(scene.write(self.folder))
        gap = 0.04  # between the robot's surface and the wall at x = 2.95
        simulation.move("a", (2.95 - BODY_M - gap, 1, 0))
        simulation.sense()
        robots = simulation.robots["driver"]
        readings = robots.sensors["footbot_proximity"]
        self.assertEqual(readings.shape, (2, 24))
        angle = np.pi / 24  # of the first ray
        distance = (gap + BODY_M * (1 - np.cos(angle))) / np.cos(angle)
        self.assertAlmostEqual(readings[0, 0], 0.0100527 / (distance + 0.000163144), 9)  # docs/devices.md
        self.assertAlmostEqual(readings[0, 23], readings[0, 0], 12)
        self.assertEqual(readings[1].sum(), 0)
        # A step after it senses nothing twice: the same bits as without.
        hashes, beams = [], []
        for look in (False, True):
            other = swarmanoid.Simulation(scene.write(self.folder))
            for _ in range(20):
                if look:
                    other.sense()
                other.robots["driver"].actuators["footbot_wheels"][:] = [3, 4]
                other.step()
            hashes.append(other.hash())
            other.sense()
            beams.append(other.robots["driver"].rows("footbot_distance_scanner")[0])  # of a head that turns
        self.assertEqual(*hashes)
        np.testing.assert_array_equal(*beams)

    def test_a_robot_is_moved_into_another_one_only_if_it_is_allowed(self):
        simulation = swarmanoid.Simulation(scene.write(self.folder))
        place = simulation.positions()[simulation.index("b")]
        with self.assertRaisesRegex(ValueError, "'a' does not fit at .*: the footbot 'b' stands there"):
            simulation.move("a", place)
        simulation.move("a", place, overlap=True)
        simulation.step(60)
        apart = np.subtract(*(simulation.positions()[simulation.index(robot)] for robot in "ab"))
        self.assertGreater(np.linalg.norm(apart), 2 * BODY_M - 1e-3)

    def test_readings_that_differ_in_number_are_rows(self):
        simulation = swarmanoid.Simulation(scene.write(self.folder))
        robots = simulation.robots["driver"]
        robots.actuators["footbot_leds"][1] = 0xFF0000
        simulation.move("b", (2.3, 1, 0))
        simulation.step()
        simulation.sense()
        blobs = robots.rows("footbot_omnidirectional_camera")
        self.assertEqual(robots.columns["footbot_omnidirectional_camera"][:2], ["colour", "distance [m]"])
        self.assertEqual([len(rows) for rows in blobs], [1, 0])
        np.testing.assert_allclose(blobs[0][0], [0xFF0000, 0.3, 0, 0], atol=1e-9)
        with self.assertRaisesRegex(KeyError, "there are: footbot_distance_scanner footbot_omnidirectional_camera"):
            robots.rows("footbot_proximity")


class Columns(InFolderCase):
    """Each device states its columns itself: no device is without them."""

    def write(self, tag):
        sensors = """<radio implementation="generic_radio" range="4"/><contact implementation="generic_contact" reach="0.01"/>
            <tag_reader implementation="generic_tag_reader" range="1"/><pie_camera implementation="generic_pie_camera" sectors="4"/>"""
        return experiment(self.folder / f"{tag}.xml", "<maxclock>5</maxclock>",
                          controller(tag, ["generic_radio", "generic_report"],
                                     sensors + devices(["generic_footbot_light", "generic_light", "generic_instruction"]), name="l"),
                          """<footbot id="fb_0" position="1,1,0" orientation="0,0,180" controller="l"/>
                          <footbot id="fb_1" position="1.175,1,0" controller="l"/><light_bulb id="bulb" position="1,2,0.3"/>""")

    def test_a_controller_reads_every_sensor_of_its_robot(self):
        seen = {}

        @swarmanoid.controller("reads_everything")
        class Reader:
            def control_step(self, robot):
                robot.set("radio", [1, 3, 7, 8, 9] + [0] * 27)
                for sensor in ("radio", "contact", "tag_reader", "pie_camera", "footbot_light", "light", "instruction"):
                    seen[robot.id, sensor] = robot.read(sensor)
                    seen[robot.id, sensor, "columns"] = robot.columns(sensor)
                for sensor in ("radio", "contact", "tag_reader"):
                    seen[robot.id, sensor, "rows"] = robot.rows(sensor)
                    seen[robot.id, sensor, "ids"] = robot.row_ids(sensor)
                try:
                    robot.rows("light")
                except KeyError as error:
                    seen["refusal"] = str(error)

        simulation = swarmanoid.Simulation(self.write("reads_everything"))
        simulation.step(3)
        packet = seen["fb_0", "radio", "rows"]
        self.assertEqual(packet.shape, (1, 32))
        np.testing.assert_array_equal(packet[0, 1:5], [3, 7, 8, 9])
        self.assertEqual(seen["fb_0", "radio", "ids"], ["fb_1"])
        self.assertEqual(seen["fb_0", "radio", "columns"][:3], ["signal [dB]", "length", "byte 0"])
        np.testing.assert_array_equal(seen["fb_0", "contact"], [1])
        self.assertEqual(seen["fb_0", "contact", "columns"], ["touched"])
        for robot in ("fb_0", "fb_1"):  # they stand back to back
            np.testing.assert_allclose(np.abs(seen[robot, "contact", "rows"]), [[np.pi]], atol=1e-6)
        self.assertEqual(set(seen["fb_0", "tag_reader", "ids"]), {"fb_1"})
        np.testing.assert_allclose(seen["fb_0", "tag_reader", "rows"], [[0.175]], atol=1e-9)
        self.assertEqual(seen["fb_0", "pie_camera"].shape, (7 * 4 * 2,))
        self.assertEqual(seen["fb_0", "pie_camera", "columns"][:2], ["red 0 distance [m]", "red 0 blobs"])
        self.assertEqual(seen["fb_0", "footbot_light"].shape, (24,))
        self.assertEqual(seen["fb_0", "light"].shape, (24,))
        self.assertGreater(seen["fb_0", "light"].max(), 0)
        self.assertEqual(seen["fb_0", "instruction"].shape, (32,))
        self.assertIn("has no rows", seen["refusal"])

    def test_a_program_has_columns_and_rows_of_every_sensor(self):
        simulation = swarmanoid.Simulation(self.write("external_controller"))
        robots = simulation.robots["l"]
        robots.actuators["radio"][1, :3] = [1, 1, 5]
        simulation.step(2)
        simulation.sense()
        self.assertEqual(robots.sensors["pie_camera"].shape, (2, 56))
        self.assertEqual(robots.sensors["contact"].tolist(), [[1], [1]])
        self.assertEqual(robots.row_columns["contact"], ["direction [rad]"])
        self.assertEqual(robots.columns["radio"][0], "signal [dB]")
        self.assertEqual(robots.actuator_columns["radio"][:2], ["sending", "length"])
        self.assertEqual(robots.row_ids("radio"), [["fb_1"], []])
        self.assertEqual(robots.rows("radio")[0][0, 2], 5)


class Handbots(InFolderCase):
    def test_each_joint_of_each_robot_follows_its_own_column(self):
        path = experiment(self.folder / "handbots.xml", "<maxclock>20</maxclock>",
                          controller("external_controller", ["dummy_handbot_arms", "dummy_handbot_head", "dummy_handbot_hands"],
                                     ["generic_handbot_joints"], name="arms"),
                          '<handbot id="hb_0" position="1,1,0" controller="arms"/><handbot id="hb_1" position="3,3,0" controller="arms"/>')
        simulation = swarmanoid.Simulation(path)
        robots = simulation.robots["arms"]
        self.assertEqual(robots.ids, ["hb_0", "hb_1"])
        self.assertEqual(robots.actuator_columns["handbot_arms"],
                         ["left arm [rad/s]", "right arm [rad/s]", "left wrist [rad/s]", "right wrist [rad/s]"])
        rates = np.array([[0.11, 0.22, 0.33, 0.44], [0.4, 0.3, 0.2, 0.1]])
        robots.actuators["handbot_arms"][:] = rates
        robots.actuators["handbot_head"][:, 0] = [0.05, -0.06]
        robots.actuators["handbot_hands"][:] = [[1, 0], [0, 1]]  # each robot closes another one
        simulation.step(10)
        simulation.sense()
        columns = robots.columns["handbot_joints"]
        joints = dict(zip(columns, robots.sensors["handbot_joints"].T))
        for column, name in enumerate(["left arm [rad]", "right arm [rad]", "left wrist [rad]", "right wrist [rad]"]):
            np.testing.assert_allclose(joints[name], 10 * 0.1 * rates[:, column], atol=1e-9, err_msg=name)
        np.testing.assert_allclose(joints["head [rad]"], [0.05, -0.06], atol=1e-9)
        self.assertEqual(joints["left hand [rad]"][0], 0)
        self.assertEqual(joints["right hand [rad]"][1], 0)
        self.assertGreater(min(joints["right hand [rad]"][0], joints["left hand [rad]"][1]), 0)
        # The state has the same angles, by robot and arm.
        np.testing.assert_allclose(simulation.attribute("arm", "handbot"), rates[:, :2], atol=1e-9)
        np.testing.assert_allclose(simulation.attribute("wrist", "hb_1"), rates[1:, 2:], atol=1e-9)


class Mistakes(InFolderCase):
    def test_mistakes_of_files_have_their_places(self):
        with self.assertRaisesRegex(swarmanoid.ConfigurationError, "nowhere.xml"):
            swarmanoid.Simulation("nowhere.xml")
        path = scene.write(self.folder)
        path.write_text(path.read_text().replace("maxclock", "maxclok"))
        with self.assertRaisesRegex(swarmanoid.ConfigurationError, r"external_controller.xml:2:\d+: .*maxclok.*did you mean 'maxclock'"):
            swarmanoid.Simulation(path)
        with self.assertRaisesRegex(swarmanoid.ConfigurationError, "framework.sed"):
            swarmanoid.Simulation(CONFIGS / "diffusion_10.xml", {"framework.sed": 3})

    def test_pictures_of_the_floor_must_be_there(self):
        path = scene.write(self.folder)
        patch = '<ground_patch id="floor" size="1, 1" picture="none.png"><position>1, 1, 0</position></ground_patch></arena>'
        path.write_text(path.read_text().replace("</arena>", patch))
        with self.assertRaisesRegex(swarmanoid.ConfigurationError, r"external_controller.xml:\d+:\d+: '.*none.png': .*no such file"):
            swarmanoid.Simulation(path)
        (self.folder / "none.png").write_text("no picture")
        path.write_text(path.read_text().replace("external_controller", "footbot_diffusion").replace(
            'id="driver"', 'id="driver" library="footbot_diffusion"', 1))
        check = subprocess.run([os.environ["SWARMANOID"], "check", path], capture_output=True, text=True)
        self.assertEqual(check.returncode, 3)
        self.assertRegex(check.stderr, r"external_controller.xml:\d+:\d+: patch 'floor': cannot read the picture '.*none.png': it is neither a PNG nor a JPEG")

    def test_what_cannot_be_done_is_refused(self):
        simulation = swarmanoid.Simulation(scene.write(self.folder))
        with self.assertRaisesRegex(ValueError, "missing"):
            simulation.move("missing", (1, 1, 0))
        with self.assertRaisesRegex(KeyError, "no entity 'missing'"):
            simulation.index("missing")
        with self.assertRaises(ValueError):
            simulation.move("a", (float("nan"), 1, 0))
        simulation.robots["driver"].actuators["footbot_wheels"][1, 0] = np.nan
        with self.assertRaisesRegex(swarmanoid.ActivityError, r"robot 'b'.*column 0 \('left \[rad/s\]'\) of the actuator 'footbot_wheels' is not a finite number"):
            simulation.step()

    def test_the_command_says_who_runs_external_controllers(self):
        run = subprocess.run([os.environ["SWARMANOID"], "check", scene.write(self.folder)], capture_output=True, text=True)
        self.assertEqual(run.returncode, 3)
        self.assertIn("external_controller", run.stderr)


@swarmanoid.controller("python_driver")
class Driver:
    """Turns while something is near in front, else goes straight on."""

    def init(self, robot, parameters):
        self.speed = float(parameters["speed"])
        self.steps = 0

    def control_step(self, robot):
        self.steps += 1
        near = robot.read("footbot_proximity")[[0, 1, 22, 23]].max()
        robot.set("footbot_wheels", [self.speed, -self.speed] if near > 0.1 else [self.speed, self.speed])

    def get_state(self):
        return self.steps

    def set_state(self, state):
        self.steps = state

    def status(self):
        return f"{self.steps} steps"


class Controllers(InFolderCase):
    def test_a_controller_in_python_does_what_the_same_rule_does_from_outside(self):
        inside = swarmanoid.Simulation(scene.write(self.folder, "python_driver", parameters="<speed>6</speed>"))
        outside = swarmanoid.Simulation(scene.write(self.folder))
        robots = outside.robots["driver"]
        turned = False
        for _ in range(99):
            outside.sense()
            near = robots.sensors["footbot_proximity"][:, [0, 1, 22, 23]].max(axis=1) > 0.1
            turned = turned or near.any()
            robots.actuators["footbot_wheels"][:, 0] = 6
            robots.actuators["footbot_wheels"][:, 1] = np.where(near, -6, 6)
            inside.step()
            outside.step()
        self.assertTrue(turned)
        np.testing.assert_array_equal(inside.x, outside.x)
        np.testing.assert_array_equal(inside.qz, outside.qz)
        self.assertEqual(inside.hash(), outside.hash())

    def test_checkpoints_hold_the_state_of_python(self):
        file = scene.write(self.folder, "python_driver", parameters="<speed>6</speed>")
        period = {"framework.canonical_period": 50}
        whole = swarmanoid.Simulation(file, period, checkpoint_every=50).run()
        rest = swarmanoid.Simulation(file, period, restore="checkpoint-00000050")
        self.assertEqual(rest.tick, 50)
        self.assertEqual(rest.run().hash, whole.hash)

    def test_exceptions_name_the_robot(self):
        @swarmanoid.controller("python_failing")
        class Failing:
            def control_step(self, robot):
                if robot.tick == 3 and robot.id == "b":
                    raise RuntimeError("out of ideas")

        simulation = swarmanoid.Simulation(scene.write(self.folder, "python_failing"))
        with self.assertRaisesRegex(swarmanoid.ActivityError, "(?s)robot 'b'.*tick 3.*out of ideas"):
            simulation.step(10)

    def test_classes_without_the_method_and_devices_without_the_name_are_refused(self):
        with self.assertRaisesRegex(TypeError, r"no method control_step"):
            swarmanoid.controller("python_nothing")(object)

        @swarmanoid.controller("python_misspelt")
        class Misspelt:
            def control_step(self, robot):
                robot.read("footbot_proximty")

        with self.assertRaisesRegex(swarmanoid.ActivityError, "(?s)no sensor 'footbot_proximty'; it has: .*footbot_proximity"):
            swarmanoid.Simulation(scene.write(self.folder, "python_misspelt")).step()


class Learning(InFolderCase):
    def environment(self, **more):
        return swarmanoid.Environment(scene.write(self.folder, ticks=50), sensors=["footbot_proximity"],
                                      actuators=["footbot_wheels"], reward=lambda simulation, robots: simulation.x[simulation.of_kind("footbot")],
                                      **more)

    def test_shapes_and_ends(self):
        environment = self.environment(frame_skip=10)
        observations, info = environment.reset(seed=4)
        self.assertEqual(info["seed"], 4)
        self.assertEqual(observations.shape, (2, 24))
        self.assertEqual(environment.action_shape, (2, 2))
        actions = np.full((2, 2), 4.0)
        for step in range(5):
            observations, rewards, terminated, truncated, _ = environment.step(actions)
            self.assertEqual(list(truncated), [step == 4] * 2)
            self.assertFalse(terminated.any())
        self.assertAlmostEqual(rewards[0], 2 + 50 * 0.1 * 4 * RADIUS_M, 9)
        with self.assertRaisesRegex(ValueError, r"the agents take \(2, 2\)"):
            environment.step(np.zeros(3))
        _, info = environment.reset()
        self.assertEqual(info["seed"], 5)
        self.assertEqual(environment.simulation.tick, 0)

    def test_spaces_hold_observations_and_actions(self):
        environment = self.environment(action_low=[-3, -5], action_high=10)
        self.assertEqual(environment.single_observation_space.shape, (24,))
        self.assertEqual(environment.single_action_space.shape, (2,))
        self.assertEqual((environment.observation_space.shape, environment.action_space.shape), ((2, 24), (2, 2)))
        np.testing.assert_array_equal(environment.action_space.low, [[-3, -5], [-3, -5]])
        np.testing.assert_array_equal(environment.single_action_space.high, [10, 10])
        self.assertIs(environment.action_space, environment.action_space)
        self.assertEqual(environment.action_columns[0].split(".")[0], "footbot_wheels")
        self.assertEqual(len(environment.observation_columns), 24)
        observations, _ = environment.reset()
        environment.action_space.seed(4)
        for _ in range(10):
            self.assertIn(observations, environment.observation_space)
            self.assertIn(observations[0], environment.single_observation_space)
            actions = environment.action_space.sample()
            self.assertIn(actions, environment.action_space)
            observations = environment.step(actions)[0]
        self.assertNotIn(np.full((2, 2), 11.0), environment.action_space)
        # Whatever Gymnasium is here, its spaces are used.
        if importlib.util.find_spec("gymnasium"):
            from gymnasium.spaces import Box
            self.assertIsInstance(environment.observation_space, Box)

    def test_an_episode_is_cut_at_its_tick_and_not_before(self):
        for more, cut in (({"max_ticks": 20}, 20), ({"max_ticks": 19, "frame_skip": 5}, 20), ({"max_ticks": 300}, 50), ({}, 50)):
            with self.subTest(more):
                environment = self.environment(**more)
                for _ in range(2):  # the next episode is as long
                    environment.reset()
                    truncated = np.zeros(2, dtype=bool)
                    while not truncated.any():
                        self.assertLess(environment.simulation.tick, cut)
                        truncated = environment.step(np.zeros((2, 2)))[3]
                    self.assertEqual((environment.simulation.tick, list(truncated)), (cut, [True, True]))

    def test_agents_that_are_done_at_the_last_tick_are_not_cut(self):
        environment = self.environment(max_ticks=3, done=lambda simulation, robots: [simulation.tick >= 3, False])
        environment.reset()
        ends = [tuple(map(list, environment.step(np.zeros((2, 2)))[2:4])) for _ in range(3)]
        self.assertEqual(ends, [([False, False], [False, False])] * 2 + [([True, False], [False, True])])

    def test_the_swarm_may_be_done(self):
        environment = self.environment(done=lambda simulation, robots: simulation.tick >= 3)
        environment.reset()
        ends = [environment.step(np.zeros((2, 2)))[2].any() for _ in range(3)]
        self.assertEqual(ends, [False, False, True])

    def test_episodes_of_one_seed_are_equal(self):
        def episode():
            environment = self.environment()
            observations, _ = environment.reset(seed=9)
            seen = [observations]
            for step in range(50):
                seen.append(environment.step(np.full((2, 2), 10.0 + step))[0])
            return np.array(seen)

        first = episode()
        self.assertGreater(first.max(), 0)  # the wall was seen
        np.testing.assert_array_equal(first, episode())

    def test_what_is_not_there_is_named(self):
        with self.assertRaisesRegex(ValueError, "no sensor 'footbot_light' with columns; they have: footbot_proximity"):
            swarmanoid.Environment(scene.write(self.folder), sensors=["footbot_light"])
        with self.assertRaisesRegex(ValueError, "has 0 external controllers"):
            swarmanoid.Environment(CONFIGS / "diffusion_10.xml")


class Runs(InFolderCase):
    """With pandas, or what stands for it."""

    def test_hashes_are_texts_and_numbers_keep_their_bits(self):
        text = "entity,hash,x,none\n7,1234567890123456,0.1234567890123456789,\n8,12e4567890123456,1e-310,\n"
        for hide in (False, True):
            hidden = {"pandas": None} if hide else {}
            with unittest.mock.patch.dict(sys.modules, hidden):
                table = swarmanoid.runs._table(io.StringIO(text))
            self.assertEqual(list(table["entity"]), ["7", "8"])
            self.assertEqual(list(table["hash"]), ["1234567890123456", "12e4567890123456"])
            self.assertEqual(list(table["x"]), [0.1234567890123456789, 1e-310])
            self.assertTrue(np.isnan(np.asarray(table["none"], dtype=float)).all())

    def test_the_folder_of_a_run(self):
        subprocess.run([os.environ["SWARMANOID"], "run", CONFIGS / "diffusion_10.xml", "--single-process", "--ticks", "20",
                        "--output", "first", "--quiet"], check=True, capture_output=True)
        run = swarmanoid.Run("first")
        self.assertEqual(run.manifest["ticks"], 20)
        with self.assertRaises(FileNotFoundError):
            swarmanoid.Run("second")
        with self.assertRaisesRegex(ValueError, "journal"):
            run.journal()

    def test_a_journal_has_the_state_of_each_tick(self):
        settings = ["--seed", "5", "--ticks", "30", "--output", "cluster", "--quiet"]
        subprocess.run([os.environ["SWARMANOID"], "run", CONFIGS / "diffusion_10.xml", *settings], check=True, capture_output=True)
        journal = swarmanoid.Run("cluster").journal(["x", "y", "qz", "led[3]"], entities="fb_*", every=10)
        self.assertEqual(list(journal), ["tick", "time_s", "entity", "kind", "x", "y", "qz", "led[3]"])
        self.assertEqual(len(journal["tick"]), 40)
        with swarmanoid.Simulation(CONFIGS / "diffusion_10.xml", {"framework.seed": 5}) as simulation:
            while True:
                of_tick = np.asarray(journal["tick"]) == simulation.tick
                rows = [simulation.index(id) for id in np.asarray(journal["entity"])[of_tick]]
                for name in ("x", "y", "qz"):
                    np.testing.assert_array_equal(np.asarray(journal[name])[of_tick], getattr(simulation, name)[rows])
                if simulation.tick == 30:
                    break
                simulation.step(10)
        last = swarmanoid.Run("cluster").journal(first=30, last=30)
        self.assertEqual(set(last["tick"]), {30})
        self.assertEqual(set(last["kind"]), {"footbot", "block"})
        with self.assertRaisesRegex(ValueError, "there is no column 'leds'.*did you mean 'led'"):
            swarmanoid.Run("cluster").journal(["leds"])
        self.assertIsNone(swarmanoid.Run("cluster").events())

    def test_the_folder_of_a_study(self):
        pathlib.Path("study.xml").write_text(f"""<study experiment="{CONFIGS / 'diffusion_10.xml'}" ticks="40" seeds="1-3">
            <factor id="robots" path="arena.distribute.quantity" values="4 8"/>
            <metrics every="20"><distance id="way"/><coverage id="seen" cell="0.5"/><trajectories id="ways"/></metrics></study>""")
        subprocess.run([os.environ["SWARMANOID"], "sweep", "study.xml", "--output", "out", "--quiet"], check=True, capture_output=True)
        study = swarmanoid.Study("out")
        table = study.table()
        with open("out/table.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(table), list(rows[0]))
        for name in ("robots", "seed", "tick", "way.mean", "seen"):
            np.testing.assert_array_equal(np.asarray(table[name], dtype=float), [float(row[name]) for row in rows])
        self.assertEqual([str(each) for each in table["hash"]], [row["hash"] for row in rows])
        runs = study.runs()
        self.assertEqual([str(each) for each in runs["state"]], ["done"] * 6)
        ids, ways = study.ways(1, 3)
        self.assertEqual((len(ids), ways.shape), (8, (3, 8, 2)))
        with swarmanoid.Simulation(CONFIGS / "diffusion_10.xml", {"arena.distribute.quantity": 8, "framework.seed": 3}) as simulation:
            simulation.step(40)
            np.testing.assert_array_equal(ways[-1], simulation.positions("footbot")[:, :2].astype(np.float32))
        visits, cell_m = study.visits("seen", 1, 3)
        self.assertEqual(cell_m, 0.5)
        self.assertAlmostEqual((visits > 0).mean(), float(rows[-1]["seen"]))
        with self.assertRaises(KeyError):
            study.ways(7, 1)
        with self.assertRaisesRegex(FileNotFoundError, "is no folder of a study"):
            swarmanoid.Study("nothing")
        with contextlib.closing(sqlite3.connect("out/study.sqlite")) as database, database:
            database.execute("UPDATE samples SET time_s = time_s + 1 WHERE point = 1 AND seed = 2")
        with self.assertRaisesRegex(ValueError, "run 1-2 does not fit its checksum"):
            swarmanoid.Study("out")
