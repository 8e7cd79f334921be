"""Spiris of ARGoS3: their flight, camera, messages and battery, and what they do not have."""
import re

from running import HERE, RunningTest


class Spiri(RunningTest):
    def test_it_flies_sees_and_hears(self):
        run = self.swarmanoid("run", HERE / "spiri.argos", "--output", "run")
        said = self.said_in("run") + run.stderr
        numbers = lambda pattern: [[float(number) for number in found.split()] for found in re.findall(rf"robot '\w+' at tick \d+: {pattern} (.*)", said)]
        for value, right in zip(numbers("at")[-1], (1, 0, 2)):
            self.assertAlmostEqual(value, right, delta=0.02)
        flown = numbers("flies")
        self.assertAlmostEqual((flown[-1][0] - flown[-11][0]), 0.5, delta=0.02)
        self.assertAlmostEqual(flown[-1][2], 1, delta=0.02)
        self.assertEqual(numbers("hears")[-1][0], 9)
        self.assertGreater(numbers("hears")[-1][1], 200, "cm, to a robot that flies away")
        # The lamp is 1.668 m ahead of the camera and 5 cm above it: 20.7 of the 692.8 pixels for a tangent of 1.
        column, row, red = numbers("sees")[-1]
        self.assertAlmostEqual(column, 320, delta=2)
        self.assertAlmostEqual(row, 219.3, delta=2)
        self.assertEqual(red, 255)
        self.assertLess(numbers("charge")[-1][0], numbers("charge")[0][0])

    def test_one_process_and_a_cluster_are_equal(self):
        hashes = {self.hash_in(self.swarmanoid("run", HERE / "spiri.argos", "--ticks", 40, "--output", f"run{len(way)}", *way).stdout) for way in ((), ("--single-process",))}
        self.assertEqual(len(hashes), 1)

    def test_devices_that_it_lacks_are_named(self):
        for device in ("leds", "proximity"):
            place = "<battery implementation" if device == "proximity" else "<quadrotor_position implementation"
            wrong = self.changed("spiri.argos", (place, f"<{device}/>{place}"))
            self.assertRegex(self.swarmanoid("check", wrong, code=3).stderr, rf"spiri.argos:\d+:\d+: <{device}> is no device of <spiri>, also in ARGoS3; leave it out")
        wrong = self.changed("spiri.argos", ('<colored_blob_perspective_camera implementation="default" medium="leds"/>', "<colored_blob_omnidirectional_camera/>"))
        self.assertRegex(self.swarmanoid("check", wrong, code=3).stderr, "<colored_blob_omnidirectional_camera> is no sensor of <spiri>")
