"""Cameras and the noise of sensors of ARGoS3, against what it computes."""
import math
import re
import statistics

from running import HERE, RunningTest


class Sensors(RunningTest):
    def test_a_perspective_camera_tells_pixels(self):
        self.swarmanoid("run", HERE / "image.argos", "--output", "run")
        sees = re.findall(r"robot '(\w+)' at tick (\d+): sees (.*)", self.said_in("run"))
        # A light a metre along the axis, 0.1 m to the left and 0.2 m up: 480 pixels are as high as the image, which is
        # 2 tan(30 degrees) / sqrt(1 + (4 / 3)^2). What is beyond 2 m is not seen, and nothing before it is enabled.
        height = 2 * math.tan(math.radians(30)) / math.hypot(1, 4 / 3)
        place = f"at {int(320 - 0.1 * 480 / height)},{int(240 - 0.2 * 480 / height)}"
        self.assertEqual({(robot, what) for robot, _, what in sees},
                         {("fb", f"255,0,0 {place}"), ("eb", f"0,255,0 {place}")})
        self.assertEqual(min(int(tick) for _, tick, _ in sees), 3)

    def test_what_a_perspective_camera_cannot_do_is_refused(self):
        up = self.changed("image.argos", ('<foot-bot id="fb">', '<foot-bot id="fb" perspective_camera_front="false">'))
        result = self.swarmanoid("check", up, code=3)
        self.assertRegex(result.stderr, r"image\.argos:\d+:\d+: a perspective camera that looks up has no counterpart")

    def test_noise_is_that_of_argos3(self):
        self.swarmanoid("run", HERE / "noise.argos", "--output", "run")
        rows = [[float(word) for word in line.split()] for line in re.findall(r": reads (.*)", self.said_in("run"))]
        self.assertGreater(len(rows), 900)
        speed, way, distance, bearing, blob, angle = zip(*rows)
        # Uniform on what the wheels do, which stand still.
        self.assertTrue(-2 <= min(speed) < -1.9 and 3.9 < max(speed) <= 4)
        self.assertTrue(-0.1 <= min(way) < -0.095 and 0.095 < max(way) <= 0.1)
        # Vectors of Gaussian length: of 5 cm in any direction, of a tenth of the distance in the plane. Along the line of
        # sight a half of the first, and 1 / sqrt(2) of the second.
        self.assertAlmostEqual(statistics.mean(distance), 25, delta=0.5)
        self.assertAlmostEqual(statistics.stdev(distance), 2.5, delta=0.25)
        self.assertAlmostEqual(statistics.stdev(bearing), 2.5 / 25, delta=0.01)
        self.assertAlmostEqual(statistics.stdev(blob), 2.5 / math.sqrt(2), delta=0.2)
        self.assertAlmostEqual(statistics.stdev(angle), 0.1 / math.sqrt(2), delta=0.008)

    def test_readings_on_demand_are_those_of_every_step(self):
        def said(*changes):
            folder = f"run{len(list(self.folder.glob('run*')))}"
            self.swarmanoid("run", self.changed("glance.argos", *changes), "--output", folder)
            return dict(re.findall(r"'still' .* step (\d+): (.*)", self.said_in(folder)))
        every = said()
        self.assertEqual(len(every), 30)
        # The camera sees LEDs of the other robot from the step after it was enabled on, and counts the steps.
        self.assertIn("picture 0 of 0 ", every["3"])
        self.assertIn("picture 1 of 7 ", every["4"])
        self.assertIn("picture 26 of 7 ", every["29"])
        self.assertGreater(len(set(every.values())), 20)
        third = said(('every="1"', 'every="3"'))
        self.assertEqual(third, {step: of for step, of in every.items() if int(step) % 3 == 0})
        self.assertEqual(said(('every="1"', 'keep="true"')), every)

    def test_batteries_discharge_as_the_file_says_and_are_charged(self):
        self.swarmanoid("run", HERE / "battery.argos", "--output", "run")
        said = self.said_in("run")
        of = {robot: [(float(charge), float(left)) for charge, left in
                      re.findall(rf"'{robot}' at tick \d+: has (\S+) for (\S+)", said)]
              for robot in ("moving", "standing", "noisy")}
        # Parts of 2: 0.01 for a tick, and 0.5 a metre for 1 cm in it from the second on. Charged behind step 50.
        a_tick = (0.01 + 0.5 * 0.01) / 2
        first = of["moving"][0][0]
        self.assertAlmostEqual(first, 0.75 - 0.01 / 2, delta=1e-6)
        for tick in range(10, 50):
            self.assertAlmostEqual(of["moving"][tick][0], first - tick * a_tick, delta=1e-3)
        for tick in range(50, 100):
            self.assertAlmostEqual(of["moving"][tick][0], 1 - (tick - 49) * a_tick, delta=1e-3)
        charge, left = of["moving"][30]
        self.assertAlmostEqual(left, (charge + a_tick) / a_tick * 0.1, delta=0.1)
        # Without <battery> nothing is used.
        self.assertEqual(set(of["standing"]), {(1, math.inf)})
        errors = [charge - (0.5 - 0.002 * (tick + 1)) for tick, (charge, _) in enumerate(of["noisy"])]
        self.assertTrue(-0.2 <= min(errors) < -0.15 and 0.05 < max(errors) <= 0.1, errors)

    def test_what_a_battery_cannot_do_is_refused(self):
        wrong = self.changed("battery.argos", ('discharge_model="time_motion"', 'discharge_model="moon"'))
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        result = self.swarmanoid("check", wrong, code=3)
        self.assertRegex(result.stderr, r"battery\.argos:\d+:\d+: 'moon' is no discharge_model; time, motion and")

    def test_wrong_noise_is_named_with_its_place(self):
        wrong = self.changed("noise.argos", ('"-2:4"', '"4:-2"'), ('noise_std_dev="0.1"', 'noise_std_dev="much"'))
        result = self.swarmanoid("check", wrong, code=3)
        self.assertRegex(result.stderr, r"noise\.argos:14:\d+: 'vel_noise_range' is '4:-2'; write min:max")
        self.assertRegex(result.stderr, r"noise\.argos:16:\d+: 'noise_std_dev' is 'much', no number")
