"""Long messages, light sensors, noisy wheels, rays, and vectors of scripts, in experiments of ARGoS3."""
import math
import re

from running import HERE, RunningTest


class Probe(RunningTest):
    def setUp(self):
        super().setUp()
        (self.folder / "scripts").symlink_to(HERE / "scripts")

    def ran(self):
        said = self.swarmanoid("run", HERE / "probe.argos", "--output", "run").stderr
        return said + self.said_in("run")

    def test_messages_may_be_long(self):
        said = self.ran()
        message = lambda robot: " ".join(str((3 * i + ord(robot)) % 256) for i in range(25))
        heard = {robot: re.findall(rf"robot '{robot}' at tick \d+: heard (.*)", said) for robot in "ab"}
        # All 25 bytes, of each other alone: foot-bots send twelve.
        zeros = " ".join(["0"] * 25)
        self.assertEqual((set(heard["a"]), heard["a"][0]), ({message("b"), zeros}, zeros))
        # What loop functions set is heard once.
        changed = " ".join(["0"] * 23 + ["99", "0"])
        self.assertEqual(heard["b"].count(changed), 1)
        self.assertEqual(set(heard["b"]), {message("a"), changed, zeros})
        self.assertIn(f"sends {message('a')} of 25", said)
        self.assertIn(f"set {changed}", said)
        self.assertIn("script hears 1,2,3,4,5,6,7,8,9,10,11,12 sees 24", said)

    def test_long_messages_cross_processes(self):
        text = (HERE / "probe.argos").read_text().replace('<loop_functions library="argos3_prober" label="prober"/>', "")
        file = self.folder / "probe.argos"
        file.write_text(text)
        one = self.hash_of(file, "--single-process", "--output", "one")
        self.assertEqual(self.hash_of(file, "--controller-hosts", 2, "--output", "cluster"), one)
        def heard(folder):
            return set(re.findall(r"'(\w+)' at tick (\d+): heard (.*)", self.said_in(folder)))
        self.assertEqual(heard("cluster"), heard("one"))
        self.assertGreater(len(heard("one")), 15)

    def test_messages_have_a_length(self):
        wrong = self.changed("probe.argos", ('fb" rab_data_size="12"', 'fb" rab_data_size="20000"'))
        self.assertIn("messages have 1 to 10000 bytes here", self.swarmanoid("check", wrong, code=3).stderr)

    def test_light_is_the_inverse_square_from_where_each_sensor_is(self):
        said = self.ran()
        readings = re.search(r"robot 'b' at tick 1: light (.*)", said).group(1).split()
        self.assertEqual(len(readings), 8)
        for i, reading in enumerate(readings):
            outwards = math.radians(22.5 + 45 * i + 90)
            x, y, z = -0.3 - 0.035 * math.cos(outwards), 1 - 0.035 * math.sin(outwards), 0.5 - 0.06
            faces = x * math.cos(outwards) + y * math.sin(outwards) > 0
            self.assertAlmostEqual(float(reading), 0.25 / (x * x + y * y + z * z) if faces else 0, places=5, msg=i)
        # A foot-bot too, whose sixth sensor is at 82.5 degrees.
        at = math.radians(82.5)
        square = (1 - 0.085036758 * math.cos(at)) ** 2 + (1 - 0.085036758 * math.sin(at)) ** 2 + 0.44 ** 2
        self.assertAlmostEqual(float(re.search(r"'fb' at tick 1: script .* sees 24 (\S+)", said).group(1)), 0.25 / square, places=5)

    def test_wheels_of_e_pucks_have_the_noise_of_argos3(self):
        said = self.ran()
        rolled = re.findall(r"robot 'a' at tick \d+: rolled (.*)", said)
        # (5 cm/s + 1 cm/s) * 1.1 from the second step on.
        self.assertEqual((rolled[0], {float(speed) for speed in rolled[1:]}), ("0", {6.6}))
        # A wheel that is told to stand turns while the other one does.
        self.assertIn("wheels 2 0,-0.0265,0 0.0205 0.066 0.01 4", said)
        self.assertIn("the wheels of 'fb' are those of its actuator <differential_steering>, which its controller does not have", said)
        self.assertIn("wheel 2 of 2; the first one is 0", said)

    def test_rays_meet_bodies_in_their_order(self):
        said = self.ran()
        met = re.search(r"init meets true (.*) nearest fb behind a above falsetruefalse0", said).group(1)
        at = {name: -1.5 + 3 * float(t) for name, t in (pair.split("=") for pair in met.split())}
        self.assertEqual(list(at), ["fb", "a", "b", "wall"])
        self.assertAlmostEqual(at["fb"], -1 - 0.085036758, places=4)
        self.assertAlmostEqual(at["b"], 0.3 - 0.035, places=4)
        self.assertAlmostEqual(at["wall"], 0.9, places=4)
        self.assertRegex(said, "step meets true fb=")

    def test_scripts_have_vectors_and_quaternions(self):
        file = self.folder / "vectors.argos"
        text = (HERE / "noise.argos").read_text()
        sensors = text[text.index("<sensors>"):text.index("</sensors>")]
        file.write_text(text.replace(sensors, '<sensors><positioning implementation="default" axis_noise_range="-0.1:0.3"/>')
                        .replace("scripts/noise.lua", "scripts/vectors.lua").replace('<body position="0,0,0" orientation="0,0,0"/>',
                                                                                     '<body position="0,0,0" orientation="90,0,0"/>'))
        self.swarmanoid("run", file, "--output", "run")
        said = self.said_in("run")
        of = lambda word: re.search(rf"robot 'a' at tick 0: {word} (.*)", said).group(1)
        self.assertEqual(of("plane"), "4,6 2,2 6,8 6,8 -3,-4 5 11 2 true 3")
        self.assertEqual(of("itself"), "0.6,0.8 3,8 -1 0,0")
        self.assertRegex(of("space"), r"^1,1,0 0,3,0 0,0,1 1 \S*e-1\d 1 7$")
        self.assertRegex(of("turned"), r"^3.142 0,0,1 1.571 0 0 \S*e-1\d 1 1 0,0,0 1$")
        wrong = of("wrong")
        self.assertRegex(wrong, r"vectors.lua:\d+: .*vector2 expected, got vector3|vector3 expected, got vector2|bad argument")
        self.assertIn("a vector3 has no element 'q'; its elements are xyz", wrong)
        self.assertIn("a vector2 has no element 'length'; its elements are xy", wrong)
        self.assertIn("2 values are given, and 3 are needed", wrong)
        axes = [[float(word) for word in words.split()] for words in re.findall(r"robot 'a' at tick \d+: axis (.*)", said)]
        # Uniform on each part of the axis, which the robot has upright.
        self.assertTrue(-0.1 <= min(axis[0] for axis in axes) < -0.09 and 0.29 < max(axis[0] for axis in axes) <= 0.3)
        self.assertEqual({axis[1] for axis in axes}, {round(math.cos(math.pi / 4), 4)})
        # Robot b, turned by nothing, has no axis to disturb.
        self.assertEqual(set(re.findall(r"robot 'b' at tick \d+: old (.*)", said)), {"0 1"})

    def test_noise_that_argos3_does_not_have_is_told(self):
        file = self.changed("noise.argos", ("</sensors>", '<footbot_distance_scanner implementation="rot_z_only" noise_std_dev="0.1"/></sensors>'))
        self.assertRegex(self.swarmanoid("check", file).stderr, r"noise.argos:17:\d+: note: 'noise_std_dev' of <footbot_distance_scanner> has no effect")
