"""E-pucks of argos3-epuck: readings by its formulas, emitters, camera, LEDs, wheels and scripts."""
import math
import re

from running import HERE, RunningTest

ANGLES = [180 / divisor for divisor in (10.5884, 3.5999, 2, 1.2, 0.8571, 0.6667, 0.5806, 0.5247)]


def infrared(distance):
    return min(max(298.701 * distance ** 2 - 36.8961 * distance + 1.08212, 0), 1) if distance <= 0.05 else 0


class DemiurgeEPuck(RunningTest):
    def said(self, robot, word):
        return re.search(rf"robot '{robot}' at tick 3: {word}(?: (.*))?\n", self.log).group(1) or ""

    def ran(self, *changes, output="run"):
        file = self.changed("demiurge.argos", *changes)
        self.notes = self.swarmanoid("run", file, "--output", output).stderr
        self.log = self.notes + self.said_in(output)

    def test_readings_are_those_of_the_plug_in(self):
        self.ran()
        seen = [tuple(map(float, pair.split("="))) for pair in self.said("a", "proximity").split()]
        for i, (angle, value) in enumerate(seen):
            self.assertAlmostEqual(angle, ANGLES[i], places=2)
            direction = math.radians(11.25 + 45 * i)
            up = math.sin(direction)
            distance = (0.06 - 0.036 * up) / up if up > 0 else 1
            self.assertAlmostEqual(value, infrared(distance), places=4, msg=i)
        self.assertGreater(seen[2][1], 0.3)
        distance = math.hypot(0.2, 1, 0.5) / 2
        lamp = math.atan2(-1, 0.2)
        for angle, value in zip(ANGLES, map(float, self.said("a", "light").split())):
            off = abs(math.remainder(math.radians(angle) - lamp, 2 * math.pi))
            expected = math.exp(-2 * distance) * max(1 - 2 * off / math.pi, 0)
            self.assertAlmostEqual(value, expected, places=4, msg=angle)
        self.assertEqual((self.said("a", "ground"), self.said("b", "ground")), ("0 1 1", "0 0 0"))
        self.assertIn("'nothing' of <epuck_range_and_bearing> has no effect here", self.notes)

    def test_each_emitter_sends_in_its_direction(self):
        self.ran()
        packets = lambda robot: [tuple(map(float, packet.split(","))) for packet in self.said(robot, "heard").split()]
        # Robot b, which hides robot e, sends to its left alone, where robot a is.
        distance, bearing, data = min(packets("a"))
        self.assertEqual([data for _, _, data in sorted(packets("a"))], [96, 14])
        self.assertAlmostEqual(distance, 28 - 7, places=4)
        self.assertAlmostEqual(bearing, 0, places=6)
        self.assertEqual(data, 96)
        self.assertEqual({data for _, _, data in packets("e")}, {14})
        self.assertEqual({data for _, _, data in packets("c")}, {14})
        self.assertEqual({round(distance, 3) for distance, _, _ in packets("c")},
                         {round(100 * math.hypot(0.28, 0.4) - 7, 3), round(100 * math.hypot(0.12, 0.4) - 7, 3)})
        self.assertEqual(self.said("d", "heard"), "")

    def test_the_camera_sees_the_coloured_leds(self):
        self.ran()
        expected = [(0.28 - 0.0311769, 0.018, "255:0:0"), (0.28 + 0.0311769, 0.018, "0:255:0"), (0.28, -0.036, "0:0:255")]
        blobs = sorted(self.said("a", "sees").split(), key=lambda text: text.split(",")[2], reverse=True)
        expected.sort(key=lambda led: led[2], reverse=True)
        self.assertEqual(len(blobs), 3)
        for text, (x, y, colour) in zip(blobs, expected):
            distance, angle, seen, area = text.split(",")
            self.assertEqual(seen, colour)
            self.assertAlmostEqual(float(distance), 100 * math.hypot(x, y), places=3)
            self.assertAlmostEqual(float(angle), math.atan2(y, x), places=4)
            self.assertEqual(int(area), int(95.644 * math.exp(-0.11 * 100 * math.hypot(x, y))))
        # Red LED 0 is the first one clockwise, the last one here.
        self.assertRegex(self.log, r"at c \S+ leds 11 255")
        self.assertRegex(self.log, r"at a \S+ leds 11 0")

    def test_wheels_are_not_limited_and_have_noise(self):
        self.ran()
        x = [float(text) for text in re.findall(r"at d ([^,]+),", self.log)]
        self.assertAlmostEqual(x[-1] - x[-2], 0.04, places=4)
        self.ran(('<epuck_wheels implementation="default"/>', '<epuck_wheels implementation="default" noise_std_dev="0.1"/>'), output="noisy")
        x = [float(text) for text in re.findall(r"at d ([^,]+),", self.log)]
        steps = [after - before for before, after in zip(x[2:], x[3:])]
        self.assertGreater(max(steps) - min(steps), 0.002)
        self.assertAlmostEqual(sum(steps) / len(steps), 0.04, delta=0.01)

    def test_scripts_have_the_names_of_the_plug_in(self):
        text = (HERE / "demiurge.argos").read_text().replace('<loop_functions library="argos3_demiurge" label="demiurge_floor"/>', "")
        text = text.replace('<demiurge_puck id="pc" library="argos3_demiurge">', '<lua_controller id="pc">').replace("</demiurge_puck>", "</lua_controller>")
        text = re.sub(r'<params velocity="\d+"/>', '<params script="scripts/demiurge.lua"/>', text)
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        (self.folder / "lua.argos").write_text(text)
        one = self.hash_of("lua.argos", "--single-process", "--output", "one")
        self.assertRegex(self.said_in("one"), r"robot 'a' at tick 3: lua 8 8 ground 1(\.0)? 1(\.0)? heard 8 from [\d.]+ sees 1")
        self.assertEqual(self.hash_of("lua.argos", "--controller-hosts", 2, "--output", "cluster"), one)

    def test_devices_that_are_missing_name_others(self):
        for device, instead in (("epuck_ircom", "take epuck_range_and_bearing"), ("epuck_encoder", "take differential_steering")):
            wrong = self.changed("demiurge.argos", ("<epuck_light ", f"<{device}/><epuck_light "))
            self.assertRegex(self.swarmanoid("check", wrong, code=3).stderr,
                             rf"demiurge.argos:\d+:9: <{device}> has no counterpart here; {instead}")
