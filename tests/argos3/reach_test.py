"""What loop functions of ARGoS3 reach into: scripts, grippers, the experiment file."""
import re

from running import HERE, RunningTest


class Reach(RunningTest):
    def test_loop_functions_reach_scripts_grippers_and_the_file(self):
        said = self.swarmanoid("run", HERE / "read.argos", "--output", "run").stderr
        self.assertIn("file: argos-configuration 11", said)
        steps = re.findall(r"step (\d+): (\d+) (\w+)", said)
        # The script counts on from what the loop functions wrote.
        self.assertEqual([int(counted) for _, counted, _ in steps[:3]], [1, 102, 203])
        self.assertEqual(steps[0][2], "nothing")
        self.assertEqual(steps[-1][2], "can")

    def test_the_converted_file_has_what_is_asked_for(self):
        self.swarmanoid("convert", HERE / "read.argos", "--output", "read.xml")
        self.assertEqual(self.hash_of("read.xml", "--single-process", "--output", "converted"),
                         self.hash_of(HERE / "read.argos", "--output", "direct"))
        # Others do not carry it.
        self.assertNotIn("<configuration", self.swarmanoid("convert", HERE / "make.argos").stdout)
