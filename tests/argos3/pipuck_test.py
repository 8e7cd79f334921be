"""Pi-Pucks of ARGoS3: readings by its formulas, wheels, LEDs, scripts and loop functions."""
import math
import re
import shutil

from running import HERE, RunningTest

RADIUS, AXLE, RANGE = 0.0362, 0.0565, 0.1
# Place and direction of the rangefinders on the right, from the front on (ci_pipuck_rangefinders_sensor.cpp).
RIGHT = (((0.0333, -0.0096), (0.976, -0.218)), ((0.0234, -0.0264), (0.683, -0.730)), ((0, -0.035), (0, -1)), ((-0.028, -0.0212), (-0.776, -0.630)))


def to_circle(place, direction, middle):
    """Returns the distance along a ray to a robot."""
    length = math.hypot(*direction)
    x, y = place[0] - middle, place[1]
    along = (x * direction[0] + y * direction[1]) / length
    return -along - math.sqrt(along * along - x * x - y * y + RADIUS * RADIUS)


def expected():
    """Returns the eight readings of the robot at the origin: a robot ahead, a box on the right, a low one on the left."""
    ahead = to_circle(*RIGHT[0], 0.1)
    slanted = (0.095 - 0.0264) / (0.730 / math.hypot(0.683, 0.730))
    return ahead, slanted, 0.06, RANGE, RANGE, RANGE, RANGE, ahead


class PiPuck(RunningTest):
    def test_readings_are_those_of_argos3(self):
        self.swarmanoid("run", HERE / "pipuck.argos", "--output", "run")
        said = self.said_in("run")
        sensors = re.search(r"robot 'k' at tick \d+: ranges (.*)", said).group(1).split()
        self.assertEqual(len(sensors), 8)
        for number, (text, distance) in enumerate(zip(sensors, expected())):
            label, seen, place, direction, reach, lux = text.split(":")
            self.assertEqual((int(label), float(reach), float(lux)), (number, RANGE, 0))
            self.assertAlmostEqual(float(seen), distance, places=5, msg=number)
            (x, y), (dx, dy) = RIGHT[min(number, 7 - number)]
            side = 1 if number < 4 else -1
            for value, right in zip(map(float, place.split(",")), (x, side * y, 0.0333)):
                self.assertAlmostEqual(value, right, places=6)
            for value, right in zip(map(float, direction.split(",")), (dx, side * dy, 0)):
                self.assertAlmostEqual(value, right, places=2)
        self.assertRegex(said, r"robot 'k' at tick \d+: ground 0:0:0.03,0.01,0.002:origin:-1 1:1:0.03,0,0.002:origin:-1 2:1:0.03,-0.01,0.002:origin:-1")

    def test_cameras_see_no_directional_leds_as_in_argos3(self):
        shutil.copytree(HERE / "scripts", self.folder / "scripts")
        for heading in (0, 45, 90, 135):
            file = self.changed("pipuck.argos", ('position="0.1,0,0" orientation="90,0,0"', f'position="0.1,0,0" orientation="{heading},0,0"'))
            self.swarmanoid("run", file, "--output", f"run{heading}")
            self.assertEqual(set(re.findall(r"robot 'watcher' at tick \d+: blobs (\d+)", self.said_in(f"run{heading}"))), {"0"}, heading)

    def test_wheels_and_leds_follow_the_commands(self):
        said = self.swarmanoid("run", HERE / "pipuck.argos", "--output", "run").stderr + self.said_in("run")
        fast = [float(x) for x in re.findall(r"at fast ([^,]+),", said)]
        self.assertAlmostEqual(fast[-1] - fast[-2], 0.05, places=4)
        heading = [float(text) for text in re.findall(r"at curve \S+ (\S+) ", said)]
        self.assertAlmostEqual(heading[-1] - heading[-2], math.degrees(0.005 / AXLE), places=2)
        self.assertRegex(said, r"robot 'curve' at tick 3: speeds 0 0.05")
        self.assertRegex(said, r"at k 0,0,0 \S+ size 0.0724,0.0724,0.08 lit( true){3} false( true){5} false")

    def test_scripts_have_the_same_readings(self):
        text = (HERE / "pipuck.argos").read_text()
        text = text.replace('<loop_functions library="argos3_pipucks" label="pipuck_floor"/>', "")
        text = text.replace('<pipuck id="pc" library="argos3_pipucks">', '<lua_controller id="pc">')
        text = text.replace("</sensors>\n      <params left=\"0\" right=\"0\"/>\n    </pipuck>", "</sensors>\n      <params left=\"0\" right=\"0\"/>\n    </lua_controller>")
        text = re.sub(r'<params left="\S+" right="\S+"/>', '<params script="scripts/pipuck.lua"/>', text)
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        (self.folder / "lua.argos").write_text(text)
        one = self.hash_of("lua.argos", "--single-process", "--output", "one")
        said = self.said_in("one")
        ranges = re.search(r"robot 'curve' at tick 3: lua ranges(.*)", said).group(1).split()
        self.assertEqual([float(value) for value in ranges], [RANGE] * 8)
        # All turn in their places by less than 1.1 degrees until then.
        seen = float(re.search(r"robot 'k' at tick 3: lua ranges \S+ \S+ (\S+)", said).group(1))
        self.assertAlmostEqual(seen, expected()[2], places=2)
        self.assertRegex(said, r"robot 'fast' at tick 3: lua place -0.035 looks -1.0\d* from origin ground 3 1.0 0.01 speeds 0.0 0.05 time 0.3\d* 0.0")
        # A cluster computes the same.
        self.assertEqual(self.hash_of("lua.argos", "--controller-hosts", 2, "--output", "cluster"), one)

    def test_devices_without_a_counterpart_are_named(self):
        place = "<pipuck_system implementation"
        for device, error in (("pipuck_imu", r"<pipuck_imu> has no counterpart here, and reads 0 in ARGoS3; leave it out"),
                              ("pipuck_front_camera", r"<pipuck_front_camera> has no counterpart here; leave it out"),
                              ("battery", r"<battery> is no device of <pipuck>, also in ARGoS3; leave it out")):
            wrong = self.changed("pipuck.argos", (place, f"<{device}/>{place}"))
            self.assertRegex(self.swarmanoid("check", wrong, code=3).stderr, r"pipuck.argos:16:9: " + error)
        wrong = self.changed("pipuck.argos", ('<foot-bot id="watcher"><body position="0.4,0,0" orientation="0,0,0"/><controller config="wc"/>',
                                              '<foot-bot id="watcher"><body position="0.4,0,0" orientation="0,0,0"/><controller config="pc"/>'))
        self.assertIn("<pipuck_leds> is a device of <pipuck>, and other robots have this controller",
                      self.swarmanoid("check", wrong, code=3).stderr)
