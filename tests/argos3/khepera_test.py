"""Khepera IVs of ARGoS3's plug-in: readings by its formulas, wheels, messages, scripts and loop functions."""
import math
import re

from running import HERE, RunningTest

RADIUS = 0.0704


def infrared(distance):
    return 1 if distance < 0.04 else 0 if distance > 0.12 else 4.14 * math.exp(-33 * distance) - 0.085


def ultrasound(from_ring):
    return min(max((from_ring - 0.25 - 0.25) / 1.75, 0), 1)


def light(x, y, z, heading):
    """Returns the eight readings of kheperaiv_light_rotzonly_sensor.cpp for a lamp at (1, 0.2, 1) of intensity 1."""
    way = (1 - x, 0.2 - y, 1 - z)
    bearing = math.atan2(way[1], way[0]) - heading
    index = int(bearing / (math.pi / 12) + (0.5 if bearing > 0 else -0.5))
    readings = [0] * 8
    for sensor in {(index + offset) % 8 for offset in range(-2, 3)}:
        off = abs(math.remainder(bearing - sensor * math.pi / 4, 2 * math.pi))
        readings[sensor] = math.exp(-2 * math.hypot(*way)) * max(1 - 2 * off / math.pi, 0)
    return readings


class Khepera(RunningTest):
    def values(self, said, robot, word):
        text = re.search(rf"robot '{robot}' at tick \d+: {word} (.*)", said).group(1)
        return [tuple(map(float, pair.split("="))) for pair in text.split()]

    def test_readings_are_those_of_argos3(self):
        self.swarmanoid("run", HERE / "khepera.argos", "--output", "run")
        said = self.said_in("run")
        seen = dict(self.values(said, "k", "proximity"))
        self.assertEqual(list(seen), [0, 45, 90, 135, 180, -135, -90, -45])
        slanted = (RADIUS + 0.06 - RADIUS * math.cos(math.pi / 4)) / math.cos(math.pi / 4)
        for angle, value in ((0, infrared(0.06)), (45, infrared(slanted)), (-45, infrared(slanted)), (90, 0), (180, 0)):
            self.assertAlmostEqual(seen[angle], value, places=4, msg=angle)
        self.assertGreater(infrared(slanted), 0.005)
        far = self.values(said, "k", "ultrasound")
        self.assertEqual([angle for angle, _ in far], [0, 45, 90, -90, -45])
        for (angle, value), expected in zip(far, (0, 0, ultrasound(1), ultrasound(1.505), 0)):
            self.assertAlmostEqual(value, expected, places=4, msg=angle)
        self.assertRegex(said, r"robot 'k' at tick \d+: ground 0.0614,0.01=0 0.0206,0.059=0 0.0206,-0.059=1 0.0614,-0.01=1")
        # The scanner looks over boxes that are less than 0.14 m high. Its second beam of 15 looks to the right.
        beams = [int(text) for text in re.search(r"robot 'k' at tick \d+: lidar (.*)", said).group(1).split()]
        self.assertEqual((len(beams), beams[1]), (15, 148))
        self.assertEqual(set(beams[4:]), {0})
        self.assertIn("robot 'k' at tick 4: off 148", said)
        self.assertRegex(said, r"robot 'k' at tick \d+: leds 3 heard( 10:7){3}\n")  # The box ahead hides a fourth one.

    def test_a_light_reaches_the_sensors_that_it_reaches_in_argos3(self):
        self.swarmanoid("run", HERE / "khepera.argos", "--output", "run")
        said = self.said_in("run")
        for robot, x, y, heading in (("k", 0, 0, 0), ("turned", 2, 0.2, math.pi / 2)):
            for (angle, value), expected in zip(self.values(said, robot, "light"), light(x, y, 0, heading)):
                self.assertAlmostEqual(value, expected, places=5, msg=(robot, angle))
        # A light straight to the left is behind the steps of 15 degrees.
        self.assertLess(max(value for _, value in self.values(said, "turned", "light")), 1e-6)

    def test_wheels_follow_every_command(self):
        said = self.swarmanoid("run", HERE / "khepera.argos", "--output", "run").stderr + self.said_in("run")
        places = lambda robot: [tuple(map(float, text.split(","))) for text in
                                re.findall(rf"at {robot} (\S+) ", said)]
        fast = places("fast")
        self.assertAlmostEqual(fast[-1][0] - fast[-2][0], 0.05, places=4)
        self.assertRegex(said, r"robot 'fast' at tick 3: rolled 50 5 10.54")
        # One wheel stands: the robot turns by the way of the other one over the axle.
        heading = [float(text) for text in re.findall(r"at curve \S+ (\S+) ", said)]
        self.assertAlmostEqual(heading[-1] - heading[-2], math.degrees(0.005 / 0.1054), places=2)

    def test_loop_functions_see_and_make_them(self):
        said = self.swarmanoid("run", HERE / "khepera.argos", "--output", "run").stderr + self.said_in("run")
        self.assertIn("parts 0.3204 2 8 0.0614,-0.01 10", said)
        self.assertIn("at made -2,-2,0", said)
        self.assertRegex(said, r"at k 0,0,0 .* (red|255,0,0)")

    def test_scripts_have_the_same_readings(self):
        text = (HERE / "khepera.argos").read_text().replace('<loop_functions library="argos3_khepera" label="khepera_floor"/>', "")
        text = text.replace('<khepera id="kc" library="argos3_khepera">', '<lua_controller id="kc">').replace("</khepera>", "</lua_controller>")
        text = text.replace('<params left="0" right="0"/>', '<params script="scripts/khepera.lua"/>')
        text = re.sub(r'<params left="\d+" right="\d+"/>', '<params script="scripts/khepera.lua"/>', text)
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        (self.folder / "lua.argos").write_text(text)
        one = self.hash_of("lua.argos", "--single-process", "--output", "one")
        said = re.search(r"robot 'k' at tick 3: lua proximity 8 (\S+) ultrasound (\S+) at (\S+) light 8 ground (\S+) (\S+) lidar 15 (\d+)",
                         self.said_in("one"))
        for text, value in zip(said.groups(), (infrared(0.06), ultrasound(1), math.pi / 2, 1, 0.0614, 148)):
            self.assertAlmostEqual(float(text), value, places=4)
        # A cluster computes the same.
        self.assertEqual(self.hash_of("lua.argos", "--controller-hosts", 2, "--output", "cluster"), one)

    def test_devices_of_other_robots_are_named(self):
        robot = '<foot-bot id="f"><body position="-3,0,0" orientation="0,0,0"/><controller config="kc"/></foot-bot>\n  </arena>'
        wrong = self.changed("khepera.argos", ("</arena>", robot))
        self.assertRegex(self.swarmanoid("check", wrong, code=3).stderr,
                         r"khepera.argos:\d+:9: <kheperaiv_proximity> is a device of <kheperaiv>, and other robots have this controller")
        both = self.changed("khepera.argos", ("<kheperaiv_light implementation", '<light implementation="default"/><kheperaiv_light implementation'))
        self.assertIn("a controller has one sensor for light here", self.swarmanoid("check", both, code=3).stderr)
        real = self.changed("khepera.argos", ("<kheperaiv_light implementation", "<kheperaiv_encoder/><kheperaiv_light implementation"))
        self.assertIn("<kheperaiv_encoder> exists on the real robot alone, also in ARGoS3; take differential_steering",
                      self.swarmanoid("check", real, code=3).stderr)
