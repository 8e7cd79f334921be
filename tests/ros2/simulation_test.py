"""ros2_render: names, types and stamps as another vendor's DDS hears them; poses as text_render writes them; velocities of a
differential drive."""
import collections
import csv
import math
import os
import pathlib
import tempfile
import unittest

import stacks
from free_domain import free_domain
from peer import Peer

CONFIGS = pathlib.Path(os.environ["SWARMANOID_CONFIGS"])
TICK_S = 0.1
WALLS = {"wall_west": (0, 1.58114, 0.25), "wall_east": (3.16228, 1.58114, 0.25),
         "wall_south": (1.58114, 0, 0.25), "wall_north": (1.58114, 3.16228, 0.25)}  # of diffusion_10.xml


class Listener(Peer):
    """Hears all in a domain of its own until it is stopped."""

    def __init__(self, domain, robot):
        self.lines = collections.defaultdict(list)
        super().__init__([os.environ["ROS2_LISTENER"], str(domain), robot])

    def hear(self, words):
        self.lines[words[0]].append(words[1:])


class Simulation(unittest.TestCase):
    def run_with(self, *options):
        folder = tempfile.TemporaryDirectory(prefix="swarmanoid_ros2_")
        self.addCleanup(folder.cleanup)
        out = pathlib.Path(folder.name) / "run"
        file = pathlib.Path(folder.name) / "experiment.xml"
        text = (CONFIGS / "diffusion_10.xml").read_text()
        if "--ros2" not in options:
            text = text.replace("<visualisations>", "<visualisations>\n    <ros2_render id=\"ros\"/>")
        text = text.replace("<file>positions.txt</file>", "<file>positions.txt</file><format>csv</format>").replace(
            "<precision>4</precision>", "<precision>15</precision>")
        file.write_text(text)
        domain = free_domain(range(40, 99))
        environment = {**os.environ, "ROS_DOMAIN_ID": str(domain), "ROS_LOCALHOST_ONLY": "1",
                       "SWARMANOID_PLUGIN_PATH": str(pathlib.Path(os.environ["SWARMANOID"]).parent.parent / "lib/swarmanoid")}
        listener = Listener(domain, "fb_0")
        try:
            run = stacks.run([os.environ["SWARMANOID"], "run", file, "--output", out, "--ticks", "60", "--real-time", "0.5", "--quiet",
                              *options], env=environment)
        finally:
            listener.stop()
        heard = listener.lines
        self.assertEqual(run.returncode, 0, run.stderr)
        table = {}
        with (out / "positions.txt").open(newline="") as rows:
            for row in csv.DictReader(rows):
                table[int(row["clock"]), row["Entity id"]] = tuple(float(row[name]) for name in ("X", "Y", "Z", "Gamma"))
        return heard, table

    def check(self, heard, table):
        # Discovery takes a while: the first messages are missed, none of the rest is out of order.
        ticks = [round((int(sec) + int(nanosec) * 1e-9) / TICK_S) for sec, nanosec in heard["clock"]]
        self.assertGreater(len(ticks), 20)
        self.assertEqual(ticks, sorted(set(ticks)))
        self.assertEqual(ticks[-1], 60)
        self.assertTrue(all(int(nanosec) % 100_000_000 == 0 for _, nanosec in heard["clock"]))

        for sec, nanosec, frame, child, *numbers in heard["tf"]:
            tick = round((int(sec) + int(nanosec) * 1e-9) / TICK_S)
            x, y, z, qx, qy, qz, qw = map(float, numbers)
            self.assertEqual(frame, "world")
            expected = table[tick, child]
            for number, other in zip((x, y, z), expected):
                self.assertAlmostEqual(number, other, 12)
            self.assertAlmostEqual(math.remainder(2 * math.atan2(qz, qw) - math.radians(expected[3]), 2 * math.pi), 0, 9)
        self.assertEqual({words[3] for words in heard["tf"]}, {f"fb_{k}" for k in range(10)})

        # Who comes late hears where the walls stand, stamped with the start of the run, and in none of the other transforms.
        walls = {words[3]: words for words in heard["static"]}
        self.assertEqual(set(walls), set(WALLS))
        for name, (sec, nanosec, frame, _, *numbers) in walls.items():
            self.assertEqual((sec, nanosec, frame), ("0", "0", "world"))
            x, y, z, qx, qy, qz, qw = map(float, numbers)
            for number, other in zip((x, y, z), WALLS[name]):
                self.assertAlmostEqual(number, other, 12)
            self.assertAlmostEqual(qx * qx + qy * qy + qz * qz + qw * qw, 1, 9)

        # Forward at 0.05 m/s where it goes straight; never sideways.
        velocities = [tuple(map(float, words[6:9])) for words in heard["odom"]]
        self.assertTrue({words[3] for words in heard["odom"]} == {"fb_0"})
        straight = [forward for forward, left, turn in velocities[1:] if abs(turn) < 1e-9]
        self.assertTrue(straight)
        for forward in straight:
            self.assertAlmostEqual(forward, 0.05, 6)
        for forward, left, turn in velocities[1:]:
            self.assertAlmostEqual(left, 0, 6)

        # ROS 2 tells the versions of a message apart by its hash.
        writers = {words[0]: words[1:] for words in heard["writer"]}
        # The fields of the types are not described: with that of Fast DDS, Cyclone DDS would not match its readers.
        fields = "unknown"
        self.assertEqual(writers["rt/clock"], ["rosgraph_msgs::msg::dds_::Clock_",
                                               "typehash=RIHS01_692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564;", fields])
        self.assertEqual(writers["rt/fb_0/odom"], ["nav_msgs::msg::dds_::Odometry_",
                                                   "typehash=RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0;", fields])

        markers = {(words[0], int(words[1])): words for words in heard["marker"]}
        kinds = collections.Counter(name for name, _ in markers)
        self.assertEqual(kinds, {"floor": 1, "block": 4, "footbot": 10})
        robot = next(words for words in markers.values() if words[4] == "fb_0")
        self.assertEqual(robot[2:4], ["3", "0"])  # a cylinder, added
        self.assertEqual([float(word) for word in robot[5:8]], [0, 0, 0.0734499])  # about the middle of its height
        self.assertEqual(float(robot[8]), 0.170074)

    def test_in_one_process(self):
        self.check(*self.run_with("--single-process"))

    def test_as_a_cluster(self):
        self.check(*self.run_with("--ros2", "--show", "text"))
