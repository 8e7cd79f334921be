"""Every driver of ros2_drivers against messages of another vendor's DDS: what comes on a topic is read in the units of the Common
Interface, and what a controller sets goes out in those of ROS 2. The values are those of stand_in_devices.c and
reporting_controller.cpp."""
import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from robot_test import LIBRARIES, ROBOT, free_domain

STAND_IN = os.environ["STAND_IN_DEVICES"]
WHEEL_RADIUS, WHEEL_DISTANCE = 0.029112741, 0.14
STEPS = 40


def infrared(distance):
    """The reading of the infrared sensors of a footbot (docs/devices.md)."""
    return 0 if distance > 0.1 else 1 if distance < 0.009889556 else 0.0100527 / (distance + 0.000163144)


class Devices(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="swarmanoid_devices_test_"))
        self.addCleanup(shutil.rmtree, self.folder, True)

    def run_robot(self, kind, sensors, actuators=(), drivers=""):
        """Readings by sensor and name, and what each topic of an actuator was told, in order and without repetitions. The robot begins
        once its sensors are heard: then those who listen to its actuators have met it, too."""
        elements = lambda types: "".join(f"<{type}/>" for type in types)
        (self.folder / "e.xml").write_text(f"""<ahss-config>
  <framework><controller_path>{LIBRARIES}</controller_path><clocktick>50</clocktick></framework>
  <controllers>
    <reporting_controller id="c" library="reporting_controller">
      <actuators>{elements(actuators)}</actuators><sensors>{elements(sensors)}</sensors>
      <parameters><sensors>{" ".join(sensors)}</sensors><last>{STEPS - 1}</last></parameters>
    </reporting_controller>
  </controllers>
</ahss-config>""")
        (self.folder / "r.xml").write_text(f'<ahss-robot id="r" kind="{kind}"><experiment file="e.xml" controller="c"/>'
                                           f'<drivers>{drivers}</drivers></ahss-robot>')
        domain = free_domain()
        stand_in = subprocess.Popen([STAND_IN, str(domain), "60"], stdout=subprocess.PIPE, text=True)
        environment = {**os.environ, "ROS_DOMAIN_ID": str(domain), "ROS_LOCALHOST_ONLY": "1"}
        robot = subprocess.run([ROBOT, "r.xml", "--steps", str(STEPS), "--wait", "30"], cwd=self.folder, env=environment,
                               capture_output=True, text=True, timeout=90)
        # It ends when the robot has left.
        heard = stand_in.communicate(timeout=100)[0]
        self.assertEqual(robot.returncode, 0, robot.stderr)
        readings, told = {}, {}
        for line in robot.stdout.splitlines():
            if line.count("\t") == 3:
                sensor, name, unit, value = line.split("\t")
                readings.setdefault(sensor, {})[name] = (float(value), unit)
        for line in heard.splitlines():
            topic, value = line.split(" ", 1)
            told.setdefault(topic, []).append(value)
        return readings, told

    def expect(self, readings, sensor, **values):
        for name, value in values.items():
            name = name.replace("_", " ").strip()
            self.assertAlmostEqual(readings[sensor][name][0], value, places=6, msg=f"{sensor}: {name}")

    def expect_numbers(self, told, *values):
        numbers = [float(word) for word in told.split()]
        self.assertEqual(len(numbers), len(values))
        for number, value in zip(numbers, values):
            self.assertAlmostEqual(number, value, delta=1e-5 * max(1, abs(value)))

    def test_sensors_of_a_footbot(self):
        ring = ["footbot_proximity", "footbot_light"]
        others = ["footbot_encoders", "footbot_accelerometer", "footbot_turret_torque", "footbot_turret_encoder", "footbot_gripper",
                  "footbot_ground", "footbot_omnidirectional_camera", "pie_camera", "gyroscope", "positioning", "range_and_bearing"]
        readings, _ = self.run_robot("footbot", ring + others,
                                     drivers='<sensors><footbot_proximity driver="ros2_ranges"/></sensors>')
        # Ranges from the body: too near to be measured is contact, +infinity and what is beyond 0.1 m is nothing.
        near = [infrared(0.021 + 0.005 * i) for i in range(24)]
        near[21:23] = [1, 0]
        for i in range(24):
            self.assertAlmostEqual(readings["footbot_proximity"][str(i)][0], near[i], places=5, msg=f"proximity {i}")
            # Lux over 1000, at most 1.
            self.assertAlmostEqual(readings["footbot_light"][str(i)][0], min(0.05 * i, 1), places=9, msg=f"light {i}")
        self.assertEqual(sum(value == 0 for value in near), 7)
        # A twist of 0.1 m/s and 0.5 rad/s.
        self.expect(readings, "footbot_encoders", left=(0.1 - 0.5 * WHEEL_DISTANCE / 2) / WHEEL_RADIUS,
                    right=(0.1 + 0.5 * WHEEL_DISTANCE / 2) / WHEEL_RADIUS)
        self.assertEqual(readings["footbot_encoders"]["left"][1], "rad/s")
        self.expect(readings, "footbot_accelerometer", forward=0.5, left=-1.25, up=9.81)
        self.expect(readings, "gyroscope", roll=0, pitch=0, yaw=17)
        self.expect(readings, "positioning", x=3, y=-0.5, z=0, heading=math.pi / 2)
        # As in the engines, 25 N and 1.5 N m read as 1, and no more.
        self.expect(readings, "footbot_turret_torque", forward_traction=0.2, left_traction=-1, torque=-0.25)
        self.expect(readings, "footbot_turret_encoder", angle=-math.pi / 2)
        self.expect(readings, "footbot_gripper", aperture=0.3, gripping=1)
        for i, brightness in enumerate((0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 1)):
            self.assertAlmostEqual(readings["footbot_ground"][str(i)][0], brightness, places=6)
        self.expect(readings, "footbot_ground", floor=0xff8000)
        self.expect(readings, "footbot_omnidirectional_camera", blob_0_colour=0xff0000, blob_0_distance=math.sqrt(2),
                    blob_0_angle=math.pi / 4, blob_1_colour=0x0000ff, blob_1_distance=2, blob_1_angle=-math.pi / 2)
        # The stand-in says all again several times a step: each packet counts once for each time.
        packets = readings["range_and_bearing"]
        self.expect(readings, "range_and_bearing", packet_0_range=2.5, packet_0_bearing=math.atan2(2, 1.5), packet_1_range=5,
                    packet_1_bearing=math.pi, **{f"packet_0_byte_{i}": i + 1 for i in range(10)}, packet_1_byte_0=255, packet_1_byte_9=128)
        self.assertNotIn("packet 1 byte 1", packets)
        self.assertNotIn("packet 0 byte 10", packets)
        # Twelve sectors of 30 degrees, counter-clockwise from the front.
        self.assertEqual(set(readings["pie_camera"]), {"red 1 distance", "red 1 blobs", "blue 9 distance", "blue 9 blobs"})

    def test_proximity_from_a_scan(self):
        readings, _ = self.run_robot("footbot", ["footbot_proximity"])
        # Each sensor sees the nearest of the rays in its 15 degrees, counter-clockwise from the front.
        nearest = {}
        for ray in range(32):
            sensor = math.floor((-1.55 + 0.1 * ray) % (2 * math.pi) / math.radians(15))
            distance = 0 if ray == 5 else math.inf if ray == 20 else 0.02 + 0.002 * ray
            nearest[sensor] = min(nearest.get(sensor, math.inf), distance)
        self.assertEqual(set(nearest), {*range(6), *range(18, 24)})
        for i in range(24):
            self.assertAlmostEqual(readings["footbot_proximity"][str(i)][0], infrared(nearest.get(i, math.inf)), places=5, msg=str(i))

    def test_encoders_from_joint_states(self):
        readings, _ = self.run_robot("footbot", ["footbot_encoders"],
                                     drivers='<sensors><footbot_encoders driver="ros2_joint_states"/></sensors>')
        self.expect(readings, "footbot_encoders", left=1.5, right=-2.5)

    def test_sensors_of_an_eyebot_and_a_handbot(self):
        readings, _ = self.run_robot("eyebot", ["eyebot_altitude", "eyebot_camera", "eyebot_pan_tilt_camera"])
        self.expect(readings, "eyebot_altitude", altitude=1.75)
        self.expect(readings, "eyebot_camera", blob_1_distance=2, blob_1_angle=-math.pi / 2)
        self.expect(readings, "eyebot_pan_tilt_camera", blob_1_distance=math.sqrt(5), blob_1_elevation=math.atan2(1, 2))
        readings, _ = self.run_robot("handbot", ["handbot_joints", "handbot_camera", "handbot_proximity"])
        # As above: -infinity is contact, and from 0.05 m on nothing is seen.
        for i in range(24):
            reading = 1 if i == 21 else max(0, 1 - (0.021 + 0.005 * i) / 0.05)
            self.assertAlmostEqual(readings["handbot_proximity"][f"{'left' if i < 12 else 'right'} {i % 12}"][0], reading, places=5, msg=str(i))
        self.expect(readings, "handbot_joints", head=0.1, left_arm=0.2, right_arm=0.3, left_wrist=0.4, right_wrist=0.5, left_hand=0.6,
                    right_hand=0.7, left_hand_holds=1, right_hand_holds=0, rope_attached=1, rope_length=0.8)
        # It looks ahead: distances are along the line of sight.
        self.expect(readings, "handbot_camera", blob_1_distance=math.sqrt(5), blob_1_elevation=math.atan2(1, 2))

    def test_actuators_of_a_footbot(self):
        _, told = self.run_robot("footbot", ["footbot_accelerometer"], ["footbot_wheels", "footbot_beacon", "footbot_gripper",
                                                                          "footbot_turret", "footbot_leds", "range_and_bearing"])
        self.expect_numbers(told["cmd_vel"][0], 3 * WHEEL_RADIUS, 0, 0, 0, 0, 2 * WHEEL_RADIUS / WHEEL_DISTANCE)
        # Cut to 0.3 m/s a wheel.
        self.expect_numbers(told["cmd_vel"][1], 0, 0, 0, 0, 0, 0.6 / WHEEL_DISTANCE)
        self.expect_numbers(told["cmd_vel"][-1], 0, 0, 0, 0, 0, 0)
        self.assertEqual(told["beacon"], ["1 0.502 0 1", "0 0 0 0"])
        self.assertEqual(told["gripper/command"], ["0.25", "1"])
        self.assertEqual(told["turret/velocity"], ["0.5", "-3.14159", "0"])
        self.assertEqual(told["range_and_bearing/send"], ["byte 10 10: 0 1 2 3 4 5 6 7 8 255", "byte 0 0:"])
        self.assertEqual(told["leds"], ["led 12 rgb 3 010 101" + " 010" * 10, "led 12 rgb 3" + " 000" * 12])

    def test_a_preferential_direction_turns_against_the_turret(self):
        # The turret looks to -90 degrees: ahead is 90 degrees on its ring, the three LEDs about it.
        _, told = self.run_robot("footbot", ["footbot_turret_encoder"], ["footbot_preferential_direction"])
        lit = [i for i, led in enumerate(told["leds"][-2].split()[4:]) if led == "100"]
        self.assertEqual(lit, [2, 3])

    def test_actuators_of_an_eyebot(self):
        _, told = self.run_robot("eyebot", ["eyebot_altitude"], ["eyebot_propellers", "eyebot_laser", "eyebot_attachment", "eyebot_leds"])
        # Cut to 90 degrees a second.
        self.expect_numbers(told["cmd_vel"][0], 0.3, -0.2, 0.1, 0, 0, math.pi / 2)
        frame, pose = told["goal_pose"][0].split(" ", 1)
        self.assertEqual(frame, "map")
        self.expect_numbers(pose, 1, 2, 1.5, 0, 0, math.sqrt(0.5), math.sqrt(0.5))
        self.expect_numbers(told["cmd_vel"][-1], 0, 0, 0, 0, 0, 0)
        self.assertEqual(told["laser/color"], ["0 0 0 0", "0 1 0 1", "0 0 0 0"])
        self.expect_numbers(told["laser/pan"][0], -math.pi / 2)
        self.expect_numbers(told["laser/tilt"][0], math.radians(70))
        self.assertEqual(told["attach"], ["no", "yes"])
        self.assertEqual(told["leds"][0], "led 16 rgb 3" + " 100" * 16)

    def test_actuators_of_a_handbot(self):
        _, told = self.run_robot("handbot", ["handbot_joints"], ["handbot_head", "handbot_arms", "handbot_hands", "handbot_rope",
                                                                    "handbot_beacon", "handbot_leds"])
        commands = set(told["joint_commands"])
        self.assertIn("0 positions head 0.5", commands)
        self.assertIn("0 positions head -3", commands)
        self.assertIn("0 positions arm_left 0.1 arm_right 0.2 wrist_left 0.3 wrist_right 3", commands)
        self.assertIn("0 positions arm_left 0 arm_right 0 wrist_left 0 wrist_right 0", commands)
        self.assertEqual(told["hand_left/command"], ["1"])
        self.assertEqual(told["hand_right/command"], ["0"])
        self.assertEqual(told["rope/velocity"], ["0.1", "-0.15", "0"])
        self.assertEqual(told["rope/attach"], ["no", "yes"])
        self.assertEqual(told["beacon"], ["1 1 1 1", "0 0 0 0"])
        self.assertEqual(told["leds"][0], "led 12 rgb 3" + " 001" * 12)
