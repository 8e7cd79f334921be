"""Sensors and actuators that users register by REGISTER_SENSOR and REGISTER_ACTUATOR of ARGoS3."""
import re

from running import HERE, RunningTest


class RegisteredDevices(RunningTest):
    def said(self, robot, folder):
        """The readings of a robot by step: the nearest robot, the body ahead, and the number of blobs."""
        rows = re.findall(rf"'{robot}'[^\n]*step (\d+) nearest (\S+) ahead (\S+) blobs (\d+)", self.said_in(folder))
        return {int(step): (float(nearest), float(ahead), int(blobs)) for step, nearest, ahead, blobs in rows}

    def test_they_read_and_change_the_arena_without_loop_functions(self):
        result = self.swarmanoid("run", HERE / "sense.argos", "--output", "run")
        self.assertIn("runs in one process", result.stderr)
        a, far = self.said("a", "run"), self.said("far", "run")
        self.assertEqual(len(a), 10)
        # b drives away with 5 cm/s, from the step after its first command on. Its body begins 8.5 cm before its middle.
        for step in range(1, 11):
            self.assertAlmostEqual(a[step][0], 0.5 + 0.005 * (step - 1), delta=1e-4)
            self.assertAlmostEqual(a[step][1], a[step][0] - 0.0852, delta=1e-3)
        self.assertEqual({(nearest, ahead) for nearest, ahead, _ in far.values()}, {(0, 0)})
        # The lamps are lit after the second step, and cameras see them in the third one.
        self.assertEqual([a[step][2] > 0 for step in (1, 2, 3, 10)], [False, False, True, True])

    def test_the_implementation_chooses_and_the_hash_is_the_same_each_time(self):
        blind = self.changed("sense.argos", ('<neighbour implementation="default" range="0.9"/>', '<neighbour implementation="blind"/>'))
        self.swarmanoid("run", blind, "--output", "blind")
        self.assertEqual({reading[0] for reading in self.said("a", "blind").values()}, {-1})
        hashes = {self.hash_of(HERE / "sense.argos", "--output", f"run{k}") for k in range(2)}
        self.assertEqual(len(hashes), 1)

    def test_mistakes_name_the_device(self):
        wrong = self.changed("sense.argos", ('range="0.9"', 'range="-1"'))
        result = self.swarmanoid("run", wrong, "--output", "wrong", code=None)
        self.assertNotEqual(result.returncode, 0)
        self.assertRegex(result.stderr, r"sense.argos:\d+:\d+: [^\n]*the range is -1|the range is -1")
        unknown = self.changed("sense.argos", ("neighbour implementation=\"default\"", "neighbour implementation=\"none\""))
        self.assertRegex(self.swarmanoid("check", unknown, code=3).stderr, r"sense.argos:\d+:\d+: the ARGoS3 sensor <neighbour> has no counterpart")

    def test_scripts_and_clusters_are_refused(self):
        script = self.folder / "a.lua"
        script.write_text("function step() end")
        lua = self.changed("sense.argos", ('<senser id="s" library="argos3_senser">', '<lua_controller id="s">'), ("</senser>", "</lua_controller>"),
                           ("<params/>", '<params script="a.lua"/>'), ('<params speed="5"/>', ""))
        self.assertNotEqual(self.swarmanoid("check", lua, code=None).returncode, 0)
        self.swarmanoid("convert", HERE / "sense.argos", "--output", "ours.xml")
        one = self.swarmanoid("run", "ours.xml", "--single-process", "--output", "one")
        self.assertEqual(self.hash_in(one.stdout), self.hash_of(HERE / "sense.argos", "--output", "two"))
        result = self.swarmanoid("run", "ours.xml", "--controller-hosts", 1, "--output", "cluster", code=None)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("in another process; run the experiment with --single-process", result.stdout + result.stderr)
