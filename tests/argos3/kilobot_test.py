"""Kilobots of ARGoS3's plug-in: behaviours in C, controllers in C++, light, messages and their conflicts."""
import math
import os
import re

from running import HERE, RunningTest

WATCH = '<loop_functions library="argos3_kilobots" label="kilobot_watch"/>'


class Kilobots(RunningTest):
    def setUp(self):
        super().setUp()
        for name in ("kilo_gradient", "kilo_blink"):
            (self.folder / name).symlink_to(os.path.join(os.environ["ARGOS_PLUGIN_PATH"], name))

    def run_file(self, *changes, code=0):
        file = self.changed("kilobots.argos", *changes)
        result = self.swarmanoid("run", file, "--output", "run", code=code)
        return result.stdout + result.stderr + self.said_in("run")

    def test_each_robot_counts_its_hops(self):
        said = self.run_file()
        told = {int(uid): tuple(map(int, rest)) for uid, *rest in
                re.findall(r"\[kb(\d)\] sent (\d+) hops (\d+) nearest (\d+)", said)}
        self.assertEqual({uid: hops for uid, (_, hops, _) in told.items()}, {0: 0, 1: 1, 2: 2, 3: 3, 4: 255, 5: 255})
        # Distances are in mm. Robot 4 hears no robot, since the messages of robot 5 end before it.
        self.assertEqual([told[uid][2] for uid in range(6)], [80, 80, 80, 80, 1000, 40])
        # A message each 100 ms: in each fourth step of 1/31 s, if no other robot is in the way.
        self.assertEqual(told[4][0], 93 // 5)
        # The colours of the LEDs are those of the behaviours.
        for robot, colour in (("kb0", "0,85,0"), ("kb2", "170,85,0"), ("kb4", "black")):
            self.assertRegex(said, rf"kilobot {robot} at .* colour {colour}")
        # Debug information and messages of the overhead controller.
        self.assertIn("shown kb3 3", said)
        self.assertEqual(said.count("[kb3] told 77"), 2)
        self.assertNotIn("[kb2] told", said)

    def test_a_cluster_computes_the_same(self):
        file = self.changed("kilobots.argos", (WATCH, ""))
        one = self.hash_of(file, "--single-process", "--output", "one")
        self.assertEqual(self.hash_of(file, "--controller-hosts", 2, "--output", "cluster"), one)

    def test_motors_delays_and_light_are_those_of_argos3(self):
        said = self.run_file(('behavior="kilo_gradient"', 'behavior="kilo_blink"'))
        self.assertIn("[kb3] number 3 light 0 random", said)
        # The delays last 16 and 8 steps, and the loop is called again in the step after.
        rounds = [int(tick) for tick in re.findall(r"\[kb4\] round \d+ at (\d+) ", said)]
        self.assertEqual(rounds[:3], [17, 42, 67])
        # Power 255 is 6 cm/s, and the left motor drives the right leg.
        at = [(float(x), float(y), float(turn)) for x, y, turn in
              re.findall(r"kilobot kb4 at (\S+?),(\S+?),0 (\S+) ", said)]
        turn = (0.012 - 0.024) / 0.025 / 31
        self.assertAlmostEqual(at[20][2] - at[19][2], math.degrees(turn), places=3)
        self.assertAlmostEqual(math.hypot(at[20][0] - at[19][0], at[20][1] - at[19][1]), 0.018 / 31, places=5)
        self.assertRegex(said, r"kilobot kb4 at .* colour red state 3")

    def test_the_light_sensor_is_to_the_left(self):
        said = self.run_file(('behavior="kilo_gradient"', 'behavior="kilo_blink"'),
                             ('<differential_steering implementation="default"/>', ""))
        eye = (0.0092 + 0.0145 * math.cos(math.radians(100)), 0.0145 * math.sin(math.radians(100)), 0.0344)
        for robot, x, heading in (("kb0", 0, 0), ("kb3", 0.2415, math.pi / 2)):
            place = (x + eye[0] * math.cos(heading) - eye[1] * math.sin(heading),
                     eye[0] * math.sin(heading) + eye[1] * math.cos(heading), eye[2])
            way = [lamp - own for lamp, own in zip((0.5, 0.1, 0.3), place)]
            off = abs(math.remainder(math.atan2(way[1], way[0]) - heading - math.radians(100), 2 * math.pi))
            reading = math.floor(1024 * math.exp(-2 * math.hypot(*way)) * (1 - off / math.pi))
            self.assertIn(f"[{robot}] round 1 at 17 light {reading} voltage 0", said)

    def speakers(self, medium, output="run"):
        text = (HERE / "kilobots.argos").read_text().replace("kilobot_controller", "kilo_speaker").replace(WATCH, "")
        text = text.replace('<params behavior="kilo_gradient"/>', "").replace('id="kc"', 'id="kc" library="argos3_kilobots"')
        text = text.replace("0.161,0,0", "0.04,0.05,0").replace("0.2415,0,0", "-0.5,0,0").replace('length="4"', 'length="9.7"')
        (self.folder / "speakers.argos").write_text(text.replace('<kilobot_communication id="air"/>', medium))
        self.swarmanoid("run", "speakers.argos", "--output", output)
        return {int(uid): (int(sent), int(heard), int(distance)) for uid, sent, heard, distance in
                re.findall(r"robot 'kb(\d)' at tick 300: sent (\d+) heard (\d+) from (\d+) light", self.said_in(output))}

    def test_of_three_robots_in_range_each_may_send_a_third_of_the_time(self):
        told = self.speakers('<kilobot_communication id="air"/>')
        # The standard deviation of a sum of 900 draws of 1/3 is 14.
        self.assertAlmostEqual(sum(told[robot][0] for robot in (0, 1, 2)), 900 / 3, delta=50)
        self.assertAlmostEqual(sum(told[robot][1] for robot in (0, 1, 2)), 900 * 2 / 3, delta=100)
        # A robot alone sends in each step.
        self.assertEqual(told[3][:2], (299, 0))

    def test_conflicts_may_be_ignored_and_messages_dropped(self):
        told = self.speakers('<kilobot_communication id="air" ignore_conflicts="true"/>')
        self.assertEqual([told[robot][:2] for robot in (0, 1, 2)], [(299, 598)] * 3)
        told = self.speakers('<kilobot_communication id="air" ignore_conflicts="true" message_drop_prob="0.25"/>', "dropping")
        self.assertAlmostEqual(sum(told[robot][1] for robot in (0, 1, 2)), 3 * 598 * 0.75, delta=75)

    def test_the_end_of_a_behaviour_is_an_error_that_says_how(self):
        said = self.run_file(('behavior="kilo_gradient"', 'behavior="kilo_blink"'), ('id="kb4"', 'id="kb13"'), code=None)
        self.assertRegex(said, r"the behaviour '.*kilo_blink' of the Kilobot 'kb13' ended by signal 6 \(Aborted\)")
        self.assertNotIn("finished:", said)

    def test_mistakes_have_their_place(self):
        wrong = self.changed("kilobots.argos", ("kilo_gradient", "no_such_program"))
        self.assertRegex(self.swarmanoid("check", wrong, code=3).stderr,
                         r"kilobots.argos:\d+:15: the behaviour 'no_such_program' is not found; build it")
        missing = self.changed("kilobots.argos", ('<params behavior="kilo_gradient"/>', ""))
        self.assertIn("<kilobot_controller> has no <params behavior=", self.swarmanoid("check", missing, code=3).stderr)
        radio = self.changed("kilobots.argos", ("<sensors>", '<sensors><range_and_bearing implementation="medium" medium="air"/>'))
        self.assertIn("<range_and_bearing> is no device of <kilobot>, also in ARGoS3", self.swarmanoid("check", radio, code=3).stderr)
