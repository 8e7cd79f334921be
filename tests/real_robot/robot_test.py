"""The robot program on a stand-in robot made with another vendor's DDS: the same controller libraries as in the simulator."""
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

import free_domain as domains

BUILD = pathlib.Path(os.environ["SWARMANOID_BUILD"])
SOURCE = pathlib.Path(os.environ["SWARMANOID_SOURCE"])
LIBRARIES = os.environ["TEST_LIBRARIES"]
STAND_IN = os.environ["STAND_IN_ROBOT"]
ROBOT = str(BUILD / "bin" / "swarmanoid_robot")

# A robot that turns away early enough never to touch a wall: the stand-in's walls do not hold it.
EXPERIMENT = """<ahss-config>
  <framework><clocktick>50</clocktick><maxclock>40</maxclock><controller_path>{path}</controller_path></framework>
  <controllers>
    <footbot_diffusion id="diffusion" library="{library}">
      <actuators>
        <footbot_wheels><implementation>dummy_footbot_wheels</implementation></footbot_wheels>
      </actuators>
      <sensors>
        <footbot_proximity><implementation>generic_footbot_proximity</implementation></footbot_proximity>
      </sensors>
      <parameters><velocity>0.1</velocity><delta>0.005</delta><alpha>30</alpha></parameters>
    </footbot_diffusion>
  </controllers>
  <arena size="2,2,1" optimization="2D">
    <footbot id="fb"><position>1,1,0</position><orientation>0,0,0</orientation><controller>diffusion</controller></footbot>
  </arena>
  <engines>
    <dummy_engine id="ground"><subclock>1</subclock><perpendicular_axis>z</perpendicular_axis><distance>0</distance></dummy_engine>
  </engines>
  <arena_physics><engine id="ground"><entity id="fb"/></engine></arena_physics>
</ahss-config>
"""


def free_domain():
    return domains.free_domain(range(40, 99))


class StandIn:
    """The stand-in robot, with what it wrote. It ends by itself, long after a test that passes."""
    SECONDS = 90
    NAMES = ("time", "x", "y", "heading", "forward", "turn", "clearance", "commands", "blue", "held", "to_nest")

    def __init__(self, domain, *silence):
        self.process = subprocess.Popen([STAND_IN, str(domain), str(self.SECONDS), *map(str, silence)], stdout=subprocess.PIPE,
                                        text=True)
        self.record = []

    def until(self, condition, what):
        """Reads on to the first state that meets the condition."""
        for line in self.process.stdout:
            self.record.append(dict(zip(self.NAMES, map(float, line.split()))))
            if condition(self.record[-1]):
                return self.record[-1]
        raise AssertionError(f"in {self.SECONDS} s the robot never {what}")

    def stands(self):
        return self.until(lambda state: state["forward"] == 0 and state["turn"] == 0, "stood")

    def drives(self):
        return self.until(lambda state: state["forward"] > 0, "drove")


class RobotTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="swarmanoid_robot_test_"))
        self.domain = free_domain()
        self.environment = {**os.environ, "ROS_DOMAIN_ID": str(self.domain), "ROS_LOCALHOST_ONLY": "1"}
        self.started = []

    def tearDown(self):
        for process in self.started:
            if process.poll() is None:
                process.kill()
            process.communicate()
        shutil.rmtree(self.folder, ignore_errors=True)

    def write(self, text, name="experiment.xml"):
        path = self.folder / name
        path.write_text(text)
        return path

    def experiment(self):
        return self.write(EXPERIMENT.format(path="", library="footbot_diffusion"))

    def stand_in(self, *silence):
        stand_in = StandIn(self.domain, *silence)
        self.started.append(stand_in.process)
        return stand_in

    def start(self, *arguments):
        process = subprocess.Popen([ROBOT, *map(str, arguments)], cwd=self.folder, env=self.environment, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.started.append(process)
        return process

    def run_it(self, *arguments):
        process = self.start(*arguments)
        output, errors = process.communicate(timeout=100)
        return process.returncode, output, errors

    def interrupt(self, process):
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=100)
        return process.returncode, output, errors

    def test_keeps_off_the_walls_and_stops_when_interrupted(self):
        stand_in = self.stand_in()
        process = self.start(self.experiment(), "--robot", "fb_1")
        # It comes near a wall and turns away from it, one wheel standing: half the speed, 0.1 m/s over 0.14 m.
        turned = stand_in.until(lambda r: abs(r["forward"] - 0.05) < 1e-3 and abs(abs(r["turn"]) - 0.1 / 0.14) < 1e-3, "turned away")
        self.assertLess(turned["clearance"], 0.2)
        stand_in.until(lambda r: abs(r["forward"] - 0.1) < 1e-3 and r["turn"] == 0 and r["time"] > turned["time"], "went on")
        stand_in.until(lambda r: r["time"] > turned["time"] + 3, "lived on")
        code, output, errors = self.interrupt(process)
        end = stand_in.stands()
        record = stand_in.record
        self.assertEqual(code, 0, errors)
        self.assertRegex(output, r"^finished: \d+ steps, [0-9.]+ s, \d+ overruns, longest step [0-9.]+ ms, [0-9.]+ s without")
        steps = int(output.split()[1])
        self.assertGreater(sum(abs(b["x"] - a["x"]) + abs(b["y"] - a["y"]) for a, b in zip(record, record[1:])), 0.5)
        self.assertGreater(end["clearance"], 0)
        # One command for each step, and one that stops: before the watchdog of the base would.
        self.assertAlmostEqual(end["commands"], steps + 1, delta=3)

    def test_one_library_file_serves_simulator_and_robot(self):
        # Under a name that nothing else has, so that it cannot come from elsewhere.
        library = self.folder / "libonly_one_of_its_kind.so"
        shutil.copy(BUILD / "lib" / "swarmanoid" / "libfootbot_diffusion.so", library)
        before = library.read_bytes()
        experiment = self.write(EXPERIMENT.format(path=self.folder, library="only_one_of_its_kind"))
        simulated = subprocess.run([BUILD / "bin" / "swarmanoid", "run", experiment, "--single-process", "--output", "run"],
                                   cwd=self.folder, capture_output=True, text=True, timeout=100)
        self.assertEqual(simulated.returncode, 0, simulated.stderr)
        self.assertIn("finished: 40 ticks", simulated.stdout)
        stand_in = self.stand_in()
        process = self.start(experiment, "--steps", 200)
        stand_in.until(lambda r: r["forward"] > 0.09, "drove")
        self.assertIn(str(library), pathlib.Path(f"/proc/{process.pid}/maps").read_text())
        output, errors = process.communicate(timeout=100)
        self.assertIn("finished: 200 steps", output, errors)
        self.assertEqual(library.read_bytes(), before)

    def test_the_retriever_of_the_sample_experiment_brings_a_prey_to_the_nest(self):
        stand_in = self.stand_in()
        process = self.start(SOURCE / "configs" / "prey_retrieval.xml", "--controller", "retriever")
        stand_in.until(lambda r: r["held"], "gripped the prey")
        # All LEDs are blue while it carries, and dark when it is stopped.
        stand_in.until(lambda r: r["held"] and r["blue"] == 12, "was blue")
        stand_in.until(lambda r: r["held"] and r["to_nest"] < 0.4, "came near the nest")
        code, output, errors = self.interrupt(process)
        self.assertEqual(code, 0, errors)
        dark = stand_in.until(lambda r: r["blue"] == 0, "was dark")
        self.assertTrue(dark["held"], "it dropped the prey when it was stopped")

    def test_stands_while_the_scan_is_silent(self):
        stand_in = self.stand_in(1, 5)
        process = self.start(self.experiment())
        began = stand_in.drives()["time"]
        stood = stand_in.until(lambda r: r["time"] > began + 1.5 and r["forward"] == 0, "stood")["time"]
        went_on = stand_in.drives()["time"]
        code, output, errors = self.interrupt(process)
        self.assertEqual(code, 0, errors)
        # The scan is silent from 1 s after the first command on for 5 s; after 1 s of that the robot stands.
        self.assertLess(stood, began + 5.5)
        self.assertGreater(went_on, began + 5.5)
        self.assertRegex(errors, r"warning: sensor 'footbot_proximity': topic rt/scan \(sensor_msgs/msg/LaserScan\) is "
                                 r"silent for \d+\.\d s; the robot stands until it is back")
        self.assertIn("all sensors are back", errors)
        self.assertNotIn(" 0.0 s without sensors", output)

    def test_ends_on_silence_where_asked(self):
        stand_in = self.stand_in(1, 1000)
        code, _, errors = self.run_it(self.experiment(), "--end-on-silence")
        self.assertEqual(code, 4)
        self.assertRegex(errors, r"LaserScan\) is silent for \d+\.\d s; the robot is stopped")
        stand_in.drives()
        stand_in.stands()

    def test_says_what_it_waits_for(self):
        code, _, errors = self.run_it(self.experiment(), "--wait", 1)
        self.assertEqual(code, 4)
        self.assertRegex(errors, r"sensor 'footbot_proximity': nothing heard from topic rt/scan \(sensor_msgs/msg/LaserScan\) "
                                 r"in \d+\.\d s; is its publisher running")

    def test_a_device_without_driver_is_refused_with_those_that_have_one(self):
        text = EXPERIMENT.format(path="", library="footbot_diffusion")
        experiment = self.write(text.replace("<sensors>", "<sensors>\n        <radio/>"))
        code, _, errors = self.run_it(experiment)
        self.assertEqual(code, 3)
        self.assertIn(f"{experiment}:9:9: there is no driver for the sensor <radio> in ros2_drivers; sensors of a "
                      "footbot with a driver: footbot_accelerometer, footbot_encoders, footbot_gripper,", errors)

    def test_a_missing_library_is_refused_with_the_places_searched(self):
        experiment = self.write(EXPERIMENT.format(path="", library="nowhere"))
        code, _, errors = self.run_it(experiment)
        self.assertEqual(code, 3)
        self.assertIn(f"{experiment}:4:", errors)
        self.assertIn("the library 'nowhere' is not found; build it", errors)
        self.assertIn(str(self.folder / "libnowhere.so"), errors)

    def robot_file(self, drivers, controller="diffusion"):
        self.experiment()
        return self.write(f'<ahss-robot id="r1">\n  <experiment file="experiment.xml" controller="{controller}"/>\n'
                          f'  <drivers library="ros2_drivers, test_drivers" path="{LIBRARIES}">{drivers}</drivers>\n</ahss-robot>',
                          "robot.xml")

    def test_drivers_of_a_user(self):
        robot = self.robot_file('<actuators><footbot_wheels driver="printed"><scale>2</scale></footbot_wheels></actuators>')
        self.stand_in()
        code, output, errors = self.run_it(robot, "--steps", 10)
        self.assertEqual(code, 0, errors)
        lines = output.splitlines()
        # 2 * 0.1 m/s over the radius of a wheel.
        self.assertEqual(lines[:10], ["wheels 6.86984 6.86984"] * 10)
        self.assertEqual(lines[10], "wheels stop")

    def test_mistakes_in_the_choice_of_drivers(self):
        for drivers, message in (
                ('<actuators><footbot_wheels driver="printd"/></actuators>',
                 "there is no driver 'printd' for the actuator <footbot_wheels>; there are: printed, ros2; did you mean 'printed'?"),
                ('<actuators><footbot_wheels driver="printed" scael="2"/></actuators>',
                 "the driver of <footbot_wheels> has no parameter 'scael'; it has: scale; did you mean 'scale'?"),
                ('<actuators><footbot_wheels driver="printed" scale="-2"/></actuators>', "it must be"),
                ('<sensors><footbot_proximity timeout_s="soon"/></sensors>', "it must be"),
                ('<actuators><footbot_wheels topic="two words"/></actuators>', "cannot be the name of a ROS 2 topic")):
            with self.subTest(drivers):
                code, _, errors = self.run_it(self.robot_file(drivers), "--check")
                self.assertIn(message, errors)
                self.assertIn(code, (3, 4))

    def test_a_controller_that_fails_stops_the_robot(self):
        experiment = self.write(f"""<ahss-config>
  <framework><controller_path>{LIBRARIES}</controller_path><clocktick>20</clocktick></framework>
  <controllers>
    <failing_controller id="c" library="failing_controller">
      <actuators><footbot_wheels/></actuators><parameters step="5"/>
    </failing_controller>
  </controllers>
</ahss-config>""")
        code, output, errors = self.run_it(experiment, "--kind", "footbot", "--robot", "r1", "--drivers", "test_drivers",
                                           "--driver-path", LIBRARIES)
        self.assertEqual(code, 4)
        self.assertIn("robot 'r1': ControlStep 5 failed: the floor is wet", errors)
        self.assertEqual(output.splitlines(), ["wheels 1 1"] * 5 + ["wheels stop"])

    def test_check_and_help_and_list(self):
        code, output, _ = self.run_it(self.experiment(), "--check", "--robot", "fb_1", "--namespace", "fb_1")
        self.assertEqual((code, output), (0, """robot fb_1 (footbot), controller diffusion of library footbot_diffusion
  sensor footbot_proximity by driver ros2 from topic rt/fb_1/scan (sensor_msgs/msg/LaserScan)
  actuator footbot_wheels by driver ros2 to topic rt/fb_1/cmd_vel (geometry_msgs/msg/Twist)
"""))
        code, output, _ = self.run_it("--help")
        self.assertEqual(code, 0)
        self.assertIn("Examples:", output)
        code, output, _ = self.run_it("--list-drivers")
        self.assertEqual(code, 0)
        self.assertIn("footbot_wheels / ros2", output)
        self.assertEqual(self.run_it()[0], 2)
