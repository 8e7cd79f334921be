"""ros2_controller: a node of another vendor's DDS in the loop. Lock-step gives the same bits again, in one process and as a
cluster; what the node hears is stamped with simulated time; who does not answer in time is dealt with as the file says."""
import collections
import math
import os
import pathlib
import re
import subprocess
import tempfile
import time
import unittest

import stacks
from free_domain import free_domain, release
from peer import Peer

CONFIGS = pathlib.Path(os.environ["SWARMANOID_CONFIGS"])
SWARMANOID = os.environ["SWARMANOID"]
TICKS = 40
# How long a robot waits for a node that says nothing: far longer than a busy machine lets one wait that answers.
TIMEOUT_S = 3
IMPLEMENTATIONS = {"footbot_encoders": "engine_footbot_encoders"}


class Node(Peer):
    """Answers the robots in a domain until it is stopped."""

    def __init__(self, domain, robots, stamped, repeats, silent, others, **environment):
        self.lines = []
        self.latest = collections.defaultdict(lambda: collections.deque(maxlen=8))
        super().__init__([os.environ["ROS2_NODE"], str(domain), "stamped" if stamped else "plain", str(repeats), str(silent[0]),
                          str(silent[1]), str(int(others)), *robots], {**os.environ, **environment})

    def hear(self, words):
        # Until the first answer a robot says the same again, since the first words may be lost.
        if words not in self.latest[words[1]]:
            self.lines.append(words)
        self.latest[words[1]].append(words)


class Case(unittest.TestCase):
    def setUp(self):
        self.domain = free_domain(range(40, 99))
        self.addCleanup(release, self.domain)
        folder = tempfile.TemporaryDirectory(prefix="swarmanoid_ros2_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.environment = {
            **os.environ, "ROS_DOMAIN_ID": str(self.domain), "ROS_LOCALHOST_ONLY": "1",
            "SWARMANOID_PLUGIN_PATH": str(pathlib.Path(SWARMANOID).parent.parent / "lib/swarmanoid")}
        self.runs = 0

    def experiment(self, robots=2, sensors=("footbot_proximity", "footbot_encoders"), actuators=(), **parameters):
        # A machine that stands still is no node that does.
        parameters = {"timeout": 60, "wait": 60, **parameters}
        text = (CONFIGS / "diffusion_10.xml").read_text().replace("<clocktick>", "<canonical_period>20</canonical_period><clocktick>")
        text = text.replace('<footbot_diffusion id="diffusion" library="footbot_diffusion">',
                            '<ros2_controller id="diffusion" library="ros2_controller">')
        text = text.replace("</footbot_diffusion>", "</ros2_controller>").replace('quantity="10"', f'quantity="{robots}"')
        text = re.sub(r"<sensors>.*</sensors>", "<sensors>" + "".join(
            f"<{name}><implementation>{IMPLEMENTATIONS.get(name, 'generic_' + name)}</implementation></{name}>" for name in sensors) + "</sensors>", text, flags=re.S)
        text = text.replace("</actuators>", "".join(
            f"<{name}><implementation>generic_{name}</implementation></{name}>" for name in actuators) + "</actuators>")
        # On a busy machine a node may find no robot, and be silent, for a while.
        text = re.sub(r"<parameters>.*</parameters>", "<parameters>" + "".join(
            f"<{name}>{value}</{name}>" for name, value in {"wait": 60, "timeout": 60, **parameters}.items()) + "</parameters>", text, flags=re.S)
        file = self.folder / "experiment.xml"
        file.write_text(text)
        return file

    def run_it(self, file, *options, ticks=TICKS):
        self.runs += 1
        self.out = self.folder / f"run_{self.runs}"
        return stacks.run([SWARMANOID, "run", file, "--output", self.out, "--ticks", str(ticks), "--quiet", *options], self.logs,
                          env=self.environment)

    def with_node(self, file, *options, robots=("fb_0", "fb_1"), stamped=False, repeats=1, silent=(0, 0), others=False, node=None, **more):
        node = Node(self.domain, robots, stamped, repeats, silent, others, **(node or {}))
        try:
            run = self.run_it(file, *options, **more)
        finally:
            node.stop()
        return run, node.lines

    def hash_of(self, run):
        self.assertEqual(run.returncode, 0, run.stderr)
        return re.search(r"hash ([0-9a-f]{16})", run.stdout + run.stderr).group(1)

    def logs(self):
        return "".join(file.read_text() for file in self.out.rglob("*.log"))


class LockStep(Case):
    def test_same_bits_in_one_process_and_as_a_cluster(self):
        file = self.experiment()
        alone, heard = self.with_node(file, "--single-process")
        again, _ = self.with_node(file, "--single-process")
        cluster, heard_there = self.with_node(file, "--controller-hosts", "2")
        self.assertEqual(self.hash_of(alone), self.hash_of(again))
        self.assertEqual(self.hash_of(alone), self.hash_of(cluster))
        # It drives as the node says: not the run of robots that stand.
        standing, _ = self.with_node(self.experiment(on_timeout="stop", timeout=0.01), "--single-process", silent=(0, 1000))
        self.assertNotEqual(self.hash_of(alone), self.hash_of(standing))
        for lines in (heard, heard_there):
            for robot in ("fb_0", "fb_1"):
                ticks = [round((int(sec) + int(nanosec) * 1e-9) * 10) for kind, name, sec, nanosec, *_ in lines
                         if kind == "scan" and name == robot]
                self.assertEqual(ticks, list(range(TICKS)))

    def test_wheel_odometry(self):
        run, heard = self.with_node(self.experiment(), "--single-process")
        self.hash_of(run)
        rows = [[float(word) for word in words[2:]] for words in heard if words[:2] == ["odom", "fb_0"]]
        self.assertEqual(len(rows), TICKS)
        self.assertEqual({tuple(words[1:]) for words in heard if words[0] == "frame"}, {("fb_0", "fb_0/odom", "fb_0"), ("fb_1", "fb_1/odom", "fb_1")})
        x = y = heading = 0
        for k, (sec, nanosec, at_x, at_y, forward, turn) in enumerate(rows):
            before = (k - 1) * 0.1
            if k > 0:  # what was commanded a tick before, if nothing was near
                self.assertAlmostEqual(forward, 0.05 + 0.03 * math.sin(before), 6)
                self.assertAlmostEqual(turn, 0.5 * math.cos(2 * before), 6)
            half = turn * 0.05
            chord = forward * 0.1 * (math.sin(half) / half if half else 1)
            x += chord * math.cos(heading + half)
            y += chord * math.sin(heading + half)
            heading += 2 * half
            self.assertAlmostEqual(at_x, x, 6)
            self.assertAlmostEqual(at_y, y, 6)

    def test_ros2_render_leaves_odometry_to_it(self):
        file = self.experiment()
        file.write_text(file.read_text().replace("<visualisations>", '<visualisations><ros2_render id="ros"/>'))
        run, heard = self.with_node(file, "--single-process")
        self.hash_of(run)
        self.assertEqual(sum(words[:2] == ["odom", "fb_0"] for words in heard), TICKS)

    def test_odometry_of_what_was_commanded(self):
        run, heard = self.with_node(self.experiment(sensors=("footbot_proximity",)), "--single-process")
        self.hash_of(run)
        rows = [[float(word) for word in words[2:]] for words in heard if words[:2] == ["odom", "fb_0"]]
        self.assertAlmostEqual(rows[2][4], 0.05 + 0.03 * math.sin(0.1), 6)

    def test_late_repetitions_answer_nothing_else(self):
        # The second one of a tick is there when the next tick begins, at the latest when stamps tell them apart.
        file = self.experiment(stamped="true")
        once, _ = self.with_node(file, "--single-process", stamped=True)
        often, _ = self.with_node(file, "--single-process", stamped=True, repeats=3, others=True)
        plain, _ = self.with_node(self.experiment(), "--single-process")
        self.assertEqual(self.hash_of(once), self.hash_of(often))
        self.assertEqual(self.hash_of(once), self.hash_of(plain))

    def test_hold_and_stop(self):
        hashes = set()
        for policy, kept in (("hold", True), ("stop", False)):
            file = self.experiment(robots=1, sensors=("footbot_proximity",), on_timeout=policy, timeout=TIMEOUT_S)
            run, heard = self.with_node(file, "--single-process", robots=("fb_0",), silent=(1.05, 1.25))
            hashes.add(self.hash_of(run))
            rows = [[float(word) for word in words[2:]] for words in heard if words[0] == "odom"]
            self.assertAlmostEqual(rows[12][4], 0.05 + 0.03 * math.sin(1.0) if kept else 0, 6)
            self.assertAlmostEqual(rows[25][4], 0.05 + 0.03 * math.sin(2.4), 6)
            self.assertIn(f"no command within {TIMEOUT_S} s for the readings of 1.1 s", self.logs())
            self.assertIn("the node answers again", self.logs())
        self.assertEqual(len(hashes), 2)

    def test_abort_names_robot_topic_and_tick(self):
        file = self.experiment(robots=1, timeout=TIMEOUT_S)
        for options in (["--single-process"], []):
            run, _ = self.with_node(file, *options, robots=("fb_0",), silent=(1.05, 1000))
            self.assertEqual(run.returncode, 4, run.stderr)
            self.assertIn("robot 'fb_0', controller 'diffusion': ControlStep at tick 11 failed: topic rt/fb_0/cmd_vel "
                          f"(geometry_msgs/msg/Twist): no command within {TIMEOUT_S} s for the readings of 1.1 s; ", run.stderr)

    def test_without_a_node(self):
        run = self.run_it(self.experiment(robots=1, wait=0.2), "--single-process")
        self.assertEqual(run.returncode, 4)
        self.assertIn("publishes topic rt/fb_0/cmd_vel (geometry_msgs/msg/Twist) with reliable quality of service after "
                      "0.2 s: start the node before the run", run.stderr)

    def test_robots_of_a_host_wait_together(self):
        # A node that answers only when it has the readings of all gives the same as one that answers each.
        robots = tuple(f"fb_{k}" for k in range(6))
        file = self.experiment(robots=6)
        each, _ = self.with_node(file, "--single-process", robots=robots)
        together, heard = self.with_node(file, "--single-process", robots=robots, node={"NODE_TOGETHER": "1"})
        self.assertEqual(self.hash_of(each), self.hash_of(together))
        for robot in robots:
            self.assertEqual(sum(words[:2] == ["scan", robot] for words in heard), TICKS)

    def test_what_a_node_that_waits_for_all_has_missed_is_said_again(self):
        # It misses the first odometry of the robot that is asked last, and gives no answer before it has that.
        robots = ("fb_0", "fb_1", "fb_2")
        file = self.experiment(robots=3, timeout=20)
        quick, _ = self.with_node(file, "--single-process", robots=robots)
        late, _ = self.with_node(file, "--single-process", robots=robots, node={"NODE_TOGETHER": "1", "NODE_LATE_ODOMETRY": "500"})
        self.assertEqual(self.hash_of(late), self.hash_of(quick))

    def test_leds_and_beacons(self):
        file = self.experiment(actuators=("footbot_leds", "footbot_beacon"))
        alone, _ = self.with_node(file, "--single-process", node={"NODE_LEDS": "1"})
        cluster, _ = self.with_node(file, node={"NODE_LEDS": "1"})
        self.assertEqual(self.hash_of(alone), self.hash_of(cluster))
        table = self.folder / "leds.csv"
        subprocess.run([SWARMANOID, "export", self.out, "--csv", table, "--columns", "led[0],led[11],beacon", "--entities", "fb_1"],
                       check=True, capture_output=True, env=self.environment)
        rows = [[float(word) for word in (row[0], *row[-3:])] for row in
                (line.split(",") for line in table.read_text().splitlines()[1:])]
        self.assertEqual(len(rows), TICKS + 1)
        for tick, first, last, beacon in rows[1:]:
            red = int((tick - 1) % 10 / 10 * 255 + 0.5) << 16
            self.assertEqual((first, last, beacon), (red, 0x003300, red))

    def test_who_says_nothing_of_the_leds(self):
        # Each topic of commands is part of the answer.
        file = self.experiment(robots=1, actuators=("footbot_leds",), wait=1)
        run, _ = self.with_node(file, "--single-process", robots=("fb_0",))
        self.assertEqual(run.returncode, 4, run.stderr)
        self.assertRegex(run.stderr, r"publishes .*topic rt/fb_0/leds \(std_msgs/msg/Float32MultiArray\) with reliable quality of "
                         "service after 1 s")

    def test_a_node_that_begins_slowly_answers_each_tick_once(self):
        """It hears the first readings twice, and answers twice: the second answer is not for the next tick."""
        file = self.experiment(robots=1)
        quick, _ = self.with_node(file, "--single-process", robots=("fb_0",))
        slow, _ = self.with_node(file, "--single-process", robots=("fb_0",), node={"NODE_FIRST_ANSWER": "1300"})
        self.assertEqual(self.hash_of(slow), self.hash_of(quick))

    def test_a_host_that_dies_asks_the_node_again(self):
        file = self.experiment()
        alone, _ = self.with_node(file, "--single-process", ticks=300)
        node = Node(self.domain, ("fb_0", "fb_1"), False, 1, (0, 0), False)
        out = self.folder / "killed"
        log = self.folder / "killed.log"
        try:
            with log.open("w") as sink:
                # Paced, so that the end is far when the host is killed.
                process = subprocess.Popen([SWARMANOID, "run", file, "--output", out, "--ticks", "300", "--real-time", "2"], stdout=sink, stderr=sink,
                                           env=self.environment)
                def heard(count):
                    while len(node.lines) < count and process.poll() is None:
                        time.sleep(0.01)

                heard(1)
                workers = [line.split() for line in subprocess.run(
                    ["ps", "--ppid", str(process.pid), "-o", "pid=,args="], capture_output=True, text=True).stdout.splitlines()]
                host = next(words[0] for words in workers if "controller_host" in words[1])
                heard(40)
                os.kill(int(host), 9)
                self.assertEqual(stacks.wait_for(process, log.read_text()), 0, log.read_text())
        finally:
            node.stop()
        self.assertIn("another process takes its place", log.read_text())
        self.assertIn(self.hash_of(alone), log.read_text())

    def test_verified_with_the_node(self):
        file = self.experiment()
        run, _ = self.with_node(file)
        self.hash_of(run)
        recorded = self.out
        node = Node(self.domain, ("fb_0", "fb_1"), False, 1, (0, 0), False)
        try:
            verified = stacks.run([SWARMANOID, "replay", recorded, "--verify"], env=self.environment)
        finally:
            node.stop()
        self.assertEqual(verified.returncode, 0, verified.stdout + verified.stderr)

    def test_restored_run(self):
        # Odometry and, by hold, the command before it are part of the state.
        file = self.experiment(on_timeout="hold", timeout=TIMEOUT_S)
        whole, heard = self.with_node(file, "--single-process", "--checkpoint-every", "20", silent=(1.85, 2.15))
        restored, heard_there = self.with_node(file, "--single-process", "--restore", self.out / "checkpoint-00000020",
                                               silent=(1.85, 2.15))
        self.assertEqual(self.hash_of(whole), self.hash_of(restored))
        odometry = [words for words in heard if words[0] == "odom" and float(words[2]) + float(words[3]) * 1e-9 > 1.99]
        self.assertGreaterEqual(len(odometry), 40)
        self.assertEqual(sorted(odometry), sorted(words for words in heard_there if words[0] == "odom"))


def devices(group, **implementations):
    return f"<{group}>" + "".join(f'<{label} implementation="{kind}_{label}"/>' for label, kind in implementations.items()) + f"</{group}>"


def controller(name, actuators, sensors):
    return (f'<ros2_controller id="{name}" library="ros2_controller">{devices("actuators", **actuators)}{devices("sensors", **sensors)}'
            "<parameters><wait>60</wait><timeout>60</timeout></parameters></ros2_controller>")


def footbots(places, actuators, sensors=()):
    """Their controller, and the robots fb_0, fb_1 … on the x axis at `places`."""
    return controller("driver", {"footbot_wheels": "dummy", **actuators},
                      {"footbot_proximity": "generic", "footbot_encoders": "engine", **dict.fromkeys(sensors, "generic")}), [
        f'<footbot id="fb_{k}" position="{x}, 2, 0" orientation="0, 0, 0" controller="driver"/>' for k, x in enumerate(places)]


CEILING = 3
FLIGHT = 2.42  # the top of an eyebot, 0.566 m high, is 1.4 cm below the ceiling then


def eyebots(places, actuators, sensors=()):
    return controller("flyer", {"eyebot_propellers": "dummy", **actuators}, {"eyebot_altitude": "generic", **dict.fromkeys(sensors, "generic")}), [
        f'<eyebot id="eb_{k}" position="{x}, 2, {FLIGHT}" orientation="0, 0, 0" controller="flyer"/>' for k, x in enumerate(places)]


class Devices(Case):
    """What ros2_node commands by the tick (Command in node.c), and what it does to the robots."""

    def world(self, ground=("", ()), sky=("", ()), bodies=()):
        engines = [(name, height, pattern) for name, height, pattern, there in (("ground", 0, "fb_*", ground[1]), ("sky", FLIGHT, "eb_*", sky[1])) if there]
        file = self.folder / "devices.xml"
        file.write_text(
            "<ahss-config><framework><canonical_period>20</canonical_period><clocktick>100</clocktick><maxclock>1000</maxclock></framework>"
            f'<controllers>{ground[0]}{sky[0]}</controllers><arena size="4, 4, {CEILING}" optimization="2D">{"".join([*ground[1], *sky[1], *bodies])}</arena>'
            "<engines>" + "".join(f'<dummy_engine id="{name}" subclock="1" perpendicular_axis="z" distance="{height}"/>' for name, height, _ in engines)
            + "</engines><arena_physics>" + "".join(
                f'<engine id="{name}"><entity id="{pattern}"/>' + ('<entity id="prey"/>' if bodies else "") + "</engine>" for name, _, pattern in engines)
            + '</arena_physics><visualisations><text_render id="positions" file="positions.txt"/></visualisations></ahss-config>')
        return file

    def commanded(self, file, words, robots):
        """Runs it in one process and as a cluster, that of which `table` reads the journal; what the node heard of both."""
        node = {"NODE_COMMANDS": words}
        alone, heard = self.with_node(file, "--single-process", robots=robots, node=node)
        cluster, heard_there = self.with_node(file, robots=robots, node=node)
        self.assertEqual(self.hash_of(alone), self.hash_of(cluster))
        return heard, heard_there

    def table(self, entity, columns):
        """Row t is what was commanded for the readings of tick t; not what was there before the first."""
        done = subprocess.run([SWARMANOID, "export", self.out, "--csv", "-", "--columns", columns, "--entities", entity], check=True,
                              capture_output=True, text=True, env=self.environment)
        rows = [[float(word) for word in line.split(",")[4:]] for line in done.stdout.splitlines()[1:]]
        self.assertEqual(len(rows), TICKS + 1)
        return rows[1:]

    def test_gripper(self):
        prey = '<cylindric_prey id="prey" position="2.205, 2, 0" orientation="0, 0, 0" radius="0.1" height="0.1"/>'
        file = self.world(footbots([2], {"footbot_gripper": "dummy"}, ["footbot_gripper"]), bodies=[prey])
        for heard in self.commanded(file, "gripper", ("fb_0",)):
            self.assertEqual([words[2] for words in heard if words[0] == "holding"], ["0", "1", "0"])
        # It closes for ticks 10 to 19 and backs off at 5 cm/s from tick 12 on: eight ticks with the prey, which is then left.
        for tick, ((x, gripped, aperture), (prey_x,)) in enumerate(zip(self.table("fb_0", "x,gripped,gripper_aperture"), self.table("prey", "x"))):
            closed = 10 <= tick < 20
            self.assertEqual((tick, gripped), (tick, 2 if closed else 0))  # 1 + the place of the prey among the entities
            self.assertAlmostEqual(aperture, 0 if closed else math.pi / 2, 9)
            self.assertAlmostEqual(x, 2 - 0.005 * max(tick - 11, 0), 9)
            self.assertAlmostEqual(prey_x, 2.205 - 0.005 * min(max(tick - 11, 0), 8), 9)

    def test_turret(self):
        file = self.world(footbots([2], {"footbot_turret": "dummy"}, ["footbot_turret_encoder"]))
        # 0.4 rad/s for ten ticks, -0.8 rad/s for twenty, then none.
        angles = [0.04 * min(tick, 10) - 0.08 * min(max(tick - 10, 0), 20) for tick in range(TICKS + 1)]
        for heard in self.commanded(file, "turret", ("fb_0",)):
            encoder = [float(words[4]) for words in heard if words[0] == "turret"]
            self.assertEqual(len(encoder), TICKS)
            for angle, expected in zip(encoder, angles):
                self.assertAlmostEqual(angle, expected, 6)
        for (angle,), expected in zip(self.table("fb_0", "turret_angle"), angles[1:]):
            self.assertAlmostEqual(angle, expected, 9)

    def test_laser(self):
        file = self.world(sky=eyebots([2], {"eyebot_laser": "generic"}))
        self.commanded(file, "laser", ("eb_0",))
        for tick, (on, colour, pan, tilt) in enumerate(self.table("eb_0", "laser,laser_colour,laser_pan,laser_tilt")):
            # Off without alpha, which leaves the colour; red until it is told another.
            self.assertEqual((tick, on, colour), (tick, 5 <= tick < 25, 0xff0000 if tick < 5 else 0x33ff00 if tick < 15 else 0x33ff99))
            self.assertAlmostEqual(pan, 0.05 * tick - 1, 9)
            self.assertAlmostEqual(tilt, 0.02 * tick, 9)

    def test_magnet(self):
        file = self.world(sky=eyebots([2], {"eyebot_attachment": "dummy"}))
        self.commanded(file, "attach", ("eb_0",))
        x = 2
        for tick, (at, attached) in enumerate(self.table("eb_0", "x,attached")):
            self.assertEqual((tick, attached), (tick, 10 <= tick < 20))
            # Told to fly at 10 cm/s, always; it hangs while it is attached.
            x += 0 if attached else 0.01
            self.assertAlmostEqual(at, x, 9)

    def test_bytes(self):
        device = {"range_and_bearing": "generic"}
        # All see each other; the footbots are 1.5 m apart, the eyebot 2.42 m above one.
        file = self.world(footbots([1.5, 3], device, device), eyebots([1.5], device, device))
        robots = ("fb_0", "fb_1", "eb_0")
        for heard in self.commanded(file, "bytes", robots):
            received = sorted((words[1], round(int(words[2]) * 10 + int(words[3]) / 1e8), [int(word) for word in words[4:]])
                              for words in heard if words[0] == "packet")
            # What was commanded for tick t is there at tick t + 1. No bytes for ticks 20 to 29: silence.
            self.assertEqual(received, sorted(
                (robot, tick + 1, [robots.index(other) * 80, tick, 0, 255, 1, 2, 3, 4, 5, 6]) for robot in robots for other in robots
                if other != robot for tick in range(TICKS - 1) if not 20 <= tick < 30))

    def test_columns_of_a_device_without_a_message_of_its_own(self):
        file = self.world(footbots([2], {"directional_leds": "generic"}, ["battery"]))
        for heard in self.commanded(file, "columns", ("fb_0",)):
            tables = [words for words in heard if words[0] == "table"]
            self.assertEqual(len(tables), TICKS)
            self.assertEqual(set(" ".join(words[3:]) for words in tables), {"charge, time left [s]"})
            for tick, words in enumerate(tables):  # it falls by 1e-4 a second
                self.assertAlmostEqual(float(words[2]), 1 - 1e-5 * tick, 6)
        for tick, leds in enumerate(self.table("fb_0", "led[0],led[1],led[2]")):
            self.assertEqual(leds, [tick, 0xff8040, 0])

    def test_the_brightness_of_the_floor(self):
        control, robots = footbots([2], {}, ["footbot_ground"])
        file = self.world((control, [*robots, '<ground_patch id="white" position="2, 2, 0" size="2, 2" colour="#ffffff"/>']))
        for heard in self.commanded(file, "floor", ("fb_0",)):
            self.assertEqual({tuple(words[2:]) for words in heard if words[0] == "floor"}, {("1",) * 8})

    def test_a_range_scanner_is_a_scan_and_a_cloud(self):
        control, robots = footbots([2], {}, ["range_scanner"])
        file = self.world((control, [*robots, '<block id="fb_wall" position="3.1, 2, 0.25" size="0.2, 1, 0.5" movable="false"/>']))
        for heard in self.commanded(file, "scanner", ("fb_0",)):
            scans = {tuple(float(word) for word in words[2:]) for words in heard if words[0] == "laser"}
            self.assertEqual(len(scans), 1)
            first, step, shortest, longest, *ranges = scans.pop()
            self.assertAlmostEqual(first, -math.pi, 6)
            self.assertAlmostEqual(step, math.radians(1), 6)
            self.assertEqual((shortest, longest, len(ranges)), (0, 10, 360))
            seen = {}
            for beam, distance in enumerate(ranges):
                if math.isfinite(distance):
                    seen[beam - 180] = distance
                    self.assertAlmostEqual(distance, 1 / math.cos(math.radians(beam - 180)), 6)
            self.assertEqual(sorted(seen), list(range(-26, 27)))  # the wall ends at 26.6 degrees
            clouds = {tuple(words[2:]) for words in heard if words[0] == "points"}
            self.assertEqual(len(clouds), 1)
            frame, *numbers = clouds.pop()
            self.assertEqual(frame, "fb_0")
            points = [[float(number) for number in numbers[i:i + 4]] for i in range(0, len(numbers), 4)]
            self.assertEqual(len(points), len(seen))
            for angle, (x, y, z, ring) in zip(sorted(seen), points):
                self.assertAlmostEqual(x, 1, 6)
                self.assertAlmostEqual(y, math.tan(math.radians(angle)), 6)
                self.assertAlmostEqual(z, 0.1, 6)
                self.assertEqual(ring, 0)

    def test_wrong_commands(self):
        # For tick 12 the node says nine bytes, and numbers that are none.
        for ground, sky, words, robot, text in (
                ({"range_and_bearing": "generic"}, None, "bytes", "fb_0", "rt/fb_0/range_and_bearing/send .*a command has 9 bytes; it takes 10, or none"),
                ({"directional_leds": "generic"}, None, "columns", "fb_0", "rt/fb_0/directional_leds/set .*a command has 11 numbers; it takes 12"),
                ({"footbot_turret": "dummy"}, None, "turret", "fb_0", "rt/fb_0/turret/velocity .*a command is not a finite number"),
                ({"footbot_gripper": "dummy"}, None, "gripper", "fb_0", "rt/fb_0/gripper/command .*a command is not a finite number"),
                (None, {"eyebot_laser": "generic"}, "laser", "eb_0", "rt/eb_0/laser/pan .*a command is not a finite number")):
            file = self.world(ground=footbots([2], ground)) if ground else self.world(sky=eyebots([2], sky))
            run, _ = self.with_node(file, "--single-process", robots=(robot,), node={"NODE_COMMANDS": words + " wrong"})
            self.assertEqual(run.returncode, 4, run.stderr)
            self.assertRegex(run.stderr, f"robot '{robot}', .*ControlStep at tick 12 failed: .*{text}")


class FreeRunning(Case):
    def test_newest_command(self):
        file = self.experiment(mode="free_running")
        run, heard = self.with_node(file, "--single-process", "--real-time", "1", ticks=120)
        self.hash_of(run)
        rows = [[float(word) for word in words[2:]] for words in heard if words[:2] == ["odom", "fb_0"]]
        self.assertGreater(max(row[4] for row in rows), 0.04)

    def test_goes_on_without_a_node(self):
        run = self.run_it(self.experiment(mode="free_running"), "--single-process")
        self.hash_of(run)


class RealRobotProgram(Case):
    def test_it_drives_a_simulated_robot(self):
        # The controller and the drivers of a real robot at one end, the simulated robot at the other.
        file = self.experiment(robots=1, sensors=("footbot_proximity",), mode="free_running")
        file.write_text(file.read_text().replace("<precision>4</precision>", "<precision>6</precision>"))
        robot = subprocess.Popen([os.environ["SWARMANOID_ROBOT"], CONFIGS / "diffusion_10.xml", "--controller", "diffusion", "--robot",
                                  "fb_0", "--namespace", "fb_0"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                 env=self.environment)
        try:
            run = self.run_it(file, "--single-process", "--real-time", "1", ticks=80)
        finally:
            robot.send_signal(2)
            text = stacks.output_of(robot)[0]
        self.hash_of(run)
        self.assertRegex(text, r"finished: [1-9]\d* steps")
        places = {int(line.split()[0]): [float(word) for word in line.split()[3:5]]
                  for line in (self.out / "positions.txt").read_text().splitlines() if "fb_0" in line}
        # 0.05 m/s ahead, or it turns at a wall: it has not stood still.
        self.assertGreater(math.dist(places[0], places[80]), 0.05)


class Refused(Case):
    def test_isolated_runs(self):
        run = self.run_it(self.experiment(), "--isolated")
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertIn("--isolated: no node of ROS 2 could reach the robots of the controller 'diffusion'", run.stderr)
        for tag, text in (("ros2_render", "no node of ROS 2 could hear"), ("foxglove_render", "no program could connect to")):
            file = self.experiment()
            file.write_text((CONFIGS / "diffusion_10.xml").read_text().replace("<visualisations>", f'<visualisations><{tag} id="shown"/>'))
            run = self.run_it(file, "--isolated")
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn(f"--isolated: {text} ", run.stderr)

    def test_names_and_settings(self):
        for parameters, text in (
                ({"namespace": "a//b"}, "'/a//b/fb_0/cmd_vel' cannot be the name of a ROS 2 topic"),
                ({"on_timeout": "wait"}, "'on_timeout' of the controller <ros2_controller> is 'wait'; it must be one of hold, stop, abort")):
            run = self.run_it(self.experiment(robots=1, **parameters), "--single-process")
            self.assertEqual(run.returncode, 3, run.stderr)
            self.assertIn(text, run.stderr)
