"""Controllers fail, and the run goes on as on_failure says: the same in one process and as a cluster, where both can survive it; and every process that computes the tick again repeats the first decision."""
import os
import re
import signal

from harness import AGAIN, REPLACED, TEST_CONTROLLERS, LauncherTest
from world.case import controller, experiment

TICKS = 120
HEADER = "tick,request,entity,numbers,from,number,when,check\n"
ROBOTS = ("robot_one", "robot_two", "robot_three")
THREW, DIED, SLOW = "threw an exception: cannot go on", "died", "took more processor time than it may"
ONE = ("--single-process",)


def failed(*faults):
    """The events of a run in which robots failed: tick, robot and how."""
    return HEADER + "".join(f"{tick},failed,{robot},,controller 'c' {how},0,,\n" for tick, robot, how in faults)


class OnFailureTest(LauncherTest):
    AHEAD = 0

    def write(self, fault, tick, policy, budget="", period=100, robots=2):
        """Robots that drive with their LEDs on, and whose controllers fail."""
        policy_attribute = f'on_failure="{policy}" ' if policy else ""
        places = {robot: f"{3 * n + 1},3,0" if n else "1,1,0" for n, robot in enumerate(ROBOTS[:robots])}
        return experiment(
            self.folder / f"{fault}_{policy or 'none'}.xml",
            f"<maxclock>{TICKS}</maxclock><canonical_period>{period}</canonical_period><ahead>{self.AHEAD}</ahead>"
            f"<controller_path>{TEST_CONTROLLERS}</controller_path>",
            controller("faulty_controller", ["generic_wheels", "generic_led_ring"], library="faulty_controller",
                       attributes=policy_attribute + budget,
                       parameters=f"<fault>{fault}</fault><tick>{tick}</tick><drives>1</drives><mark>{self.folder / 'mark'}</mark>"),
            "".join(f'<footbot id="{robot}" position="{place}" controller="c"/>' for robot, place in places.items()), "12,12,1")

    def done(self, experiment, name, *options):
        """The hash and the events of a run, and what it said."""
        run = self.run_it("run", experiment, "--hash-log", name, "--output", name + "_out", *options)
        self.assertEqual(run.process.returncode, 0, run.stderr)
        self.assert_nothing_left(run)
        return self.assert_finished(run, TICKS), self.events(name + "_out"), run.stderr

    def events(self, folder):
        path = self.folder / folder / "events.csv"
        return re.sub(r",[0-9a-f]{8}$", ",", path.read_text(), flags=re.MULTILINE) if path.exists() else ""

    def everywhere(self, name, experiment, *ways):
        """The hash and the events of a run, which are the same in each of the ways."""
        ways = ways or (ONE, (*ONE, "--threads", 2), (), ("--controller-hosts", 2, "--threads", 2))
        found = [self.done(experiment, f"{name}_{n}", *way)[:2] for n, way in enumerate(ways)]
        for n, others in enumerate(found):
            self.assertEqual(others, found[0], ways[n])
            self.assertEqual((self.folder / f"{name}_{n}").read_text(), (self.folder / f"{name}_0").read_text(), ways[n])
        return found[0]

    def stopped(self, tick):
        """The hash of a run in one process whose robots are stopped, since their controllers threw at the tick."""
        return self.done(self.write("step_throws", tick, "stop_robot"), "stopped", *ONE)[0]

    def assert_verified(self, folder):
        again = self.run_it("replay", folder, "--verify")
        self.assertEqual((again.process.returncode, again.stdout), (0, f"equal: {TICKS + 1} states, computed again\n"), again.stderr)
        for tick in (0, 7, 9, TICKS - 1):
            inside = self.run_it("inspect", f"{folder}@{tick}", "robot_one")
            self.assertEqual(inside.process.returncode, 0, inside.stderr)
            self.assertIn(f"robot_one at tick {tick},", inside.stdout)

    def assert_ended(self, experiment, text, *options):
        run = self.run_it("run", experiment, *options)
        self.assertEqual(run.process.returncode, 4, run.stderr)
        self.assertIn(text, run.stderr)
        self.assert_nothing_left(run)


class Throws(OnFailureTest):
    def test_stop_robot(self):
        undisturbed, none = self.everywhere("undisturbed", self.write("none", 0, "", robots=3), ONE, ("--controller-hosts", 2))
        self.assertEqual(none, "")
        stopped, events = self.everywhere("stopped", self.write("step_throws", 7, "stop_robot", robots=3))
        self.assertNotEqual(stopped, undisturbed)
        self.assertEqual(events, failed(*((7, robot, THREW) for robot in ROBOTS)))
        log = (self.folder / "stopped_2_out/controller_host-0.log").read_text()
        self.assertIn("robot 'robot_one', controller 'c': ControlStep at tick 7 failed: cannot go on; the robot is stopped", log)
        self.assert_verified("stopped_3_out")

    def test_one_that_is_stopped_stands_still(self):
        experiment = self.write("step_throws", 7, "stop_robot")
        experiment.write_text(experiment.read_text().replace("<engines>", """<visualisations><text_render id="t"><file>places.txt</file>
            <precision>9</precision></text_render></visualisations><engines>"""))
        self.done(experiment, "one", *ONE)
        places = [line.split()[3:] for line in (self.folder / "one_out/places.txt").read_text().splitlines() if "robot_one" in line]
        self.assertEqual(len(places), TICKS + 1)
        for tick in range(TICKS):
            self.assertEqual(places[tick] == places[tick + 1], tick >= 7 + self.AHEAD or tick < self.AHEAD, tick)

    def test_restart(self):
        _, events = self.everywhere("all", self.write("life_throws", 30, "restart"))
        self.assertEqual(events, failed(*((tick, robot, THREW) for tick in (30, 61, 92) for robot in ROBOTS[:2])))

    def test_restart_from_the_last_state(self):
        # It fails in its sixteenth step. At the ticks 10 and 20 it remembers ten steps, then fourteen.
        _, events = self.everywhere("all", self.write("life_throws", 15, "restart", period=10, robots=1), ONE, ())
        self.assertEqual(events, failed(*((tick, "robot_one", THREW) for tick in (15, 21, 23, 25))))
        log = (self.folder / "all_1_out/controller_host-0.log").read_text()
        self.assertEqual(log.count("the controller starts again"), 3)
        self.assertEqual(log.count("the robot is stopped"), 1)

    def test_a_host_that_is_replaced_knows(self):
        experiment = self.write("life_throws", 30, "restart")
        expected = self.done(experiment, "one", *ONE)[0]
        run = self.start("run", experiment, "--paused", "--hash-log", "cluster", "--output", "out")
        self.wait_for_experiment(experiment.stem)
        self.control("step", 70)
        os.kill(run.find("controller_host"), signal.SIGKILL)
        said = run.read_until(REPLACED)
        self.run_it("control", "resume")
        self.assertEqual(run.wait(), 0, said + run.stderr)
        self.assertEqual(self.assert_finished(run, TICKS), expected)
        self.assert_verified("out")


class Dies(OnFailureTest):
    FAULTS = {"step_crashes": "aborted", "step_exits": "called exit(0)"}
    CURE = "; in one process on_failure can help with exceptions alone: run it as a cluster, without --single-process"

    def test_stop_robot(self):
        expected = self.stopped(7)
        for hosts, (fault, what) in enumerate(self.FAULTS.items(), 1):
            with self.subTest(fault, hosts=hosts):
                name = f"{fault}{hosts}"
                experiment = self.write(fault, 7, "stop_robot")
                found, events, said = self.done(experiment, name, "--controller-hosts", hosts)
                for robot in ROBOTS[:2]:
                    self.assertIn(f"robot '{robot}', controller 'c': ControlStep at tick 7 {what}", said)
                    self.assertIn(f"'{robot}' at tick 7: its controller 'c' died", said)
                self.assertEqual(said.count(REPLACED), 2)
                self.assertEqual(events, failed(*((7, robot, DIED) for robot in ROBOTS[:2])))
                self.assertEqual(found, expected)
                self.assert_verified(name + "_out")
        # In one process, too, once it is known.
        self.assertEqual(self.done(experiment, "known", *ONE, "--faults-of", name + "_out")[:2], (expected, events))

    def test_restart(self):
        # It dies at each tick from the seventh on: three lives more, then it is stopped.
        _, events, said = self.done(self.write("step_crashes", 7, "restart", robots=1), "cluster")
        self.assertEqual(said.count(REPLACED), 4)
        self.assertEqual(events, failed(*((tick, "robot_one", DIED) for tick in range(7, 11))))
        self.assert_verified("cluster_out")



class Ends(OnFailureTest):
    def test_abort(self):
        faults = {"step_throws": ("", "failed: cannot go on"), **{fault: ("abort", what) for fault, what in Dies.FAULTS.items()}}
        for fault, (policy, what) in faults.items():
            for how in ((), ONE):
                self.assert_ended(self.write(fault, 7, policy), f"robot 'robot_one', controller 'c': ControlStep at tick 7 {what}", *how)

    def test_no_process_is_replaced(self):
        for option in (("--no-recovery",), ("--retries", 0), ("--no-journal",)):
            self.assert_ended(self.write("step_crashes", 7, "stop_robot"), "ControlStep at tick 7 aborted; for its on_failure, processes that die must be "
                              "replaced: leave out --no-recovery, --no-journal and --retries 0", *option)

    def test_in_one_process_the_cure_is_named(self):
        for policy in ("stop_robot", "restart"):
            for fault, what in Dies.FAULTS.items():
                self.assert_ended(self.write(fault, 7, policy), f"robot 'robot_one', controller 'c': ControlStep at tick 7 {what}{Dies.CURE}", *ONE)
        self.assert_ended(self.write("step_hangs", 7, "stop_robot", 'time_budget_ms="100"'), f"(--step-timeout){Dies.CURE}", *ONE, "--step-timeout", 1)


class TakesTooLong(OnFailureTest):
    BUDGET = 'time_budget_ms="100"'

    def test_abort(self):
        for how in ((), ONE):
            self.assert_ended(self.write("step_spins", 7, "", self.BUDGET),
                              "robot 'robot_one', controller 'c': ControlStep at tick 7 took more processor time than its 100 ms", *how)

    def test_stop_robot(self):
        expected = self.stopped(7)
        found, events = self.everywhere("all", self.write("step_spins", 7, "stop_robot", self.BUDGET))
        self.assertEqual(events, failed(*((7, robot, SLOW) for robot in ROBOTS[:2])))
        self.assertEqual(found, expected)

    def test_one_that_does_not_come_back(self):
        for policy in ("abort", "stop_robot"):
            with self.subTest(policy):
                experiment = self.write("step_hangs", 7, policy, robots=1)
                text = "robot 'robot_one', controller 'c': ControlStep at tick 7 did not return within 1 s (--step-timeout)"
                if policy == "abort":
                    self.assert_ended(experiment, text, "--step-timeout", 1)
                    continue
                _, events, said = self.done(experiment, policy, "--step-timeout", 1)
                self.assertIn(text, said)
                self.assertEqual(events, failed((7, "robot_one", DIED)))
                self.assert_verified(policy + "_out")

    def test_one_with_a_budget_that_does_not_come_back(self):
        experiment = self.write("step_hangs", 7, "stop_robot", self.BUDGET, robots=1)
        alone = self.start("run", experiment, *ONE)  # both wait for 10 s
        _, events, said = self.done(experiment, "cluster")
        self.assertIn("ControlStep at tick 7 did not return within 10 s (time_budget_ms)", said)
        self.assertEqual(events, failed((7, "robot_one", DIED)))
        self.assertEqual(alone.wait(), 4)
        self.assertIn(f"(time_budget_ms){Dies.CURE}", alone.stderr)

    def test_restart_is_refused(self):
        for how in ((), ONE):
            run = self.run_it("run", self.write("step_spins", 7, "restart", self.BUDGET), *how)
            self.assertEqual(run.process.returncode, 3)
            self.assertRegex(run.stderr, r"step_spins_restart.xml:\d+:\d+: the controller 'c' has a time_budget_ms and on_failure=\"restart\"")


class SlowOnce(OnFailureTest):
    """One robot takes too long once, and never would again: that it did comes from the first run alone."""

    def slow_once(self):
        return self.write("step_spins_once", 40, "stop_robot", TakesTooLong.BUDGET, period=10)

    def paused_after_the_fault(self, *options):
        run = self.start("run", self.slow_once(), "--paused", "--hash-log", "cluster", "--output", "out", *options)
        self.wait_for_experiment("step_spins_once_stop_robot")
        self.control("step", 70)
        self.assertEqual([line for line in self.events("out").splitlines() if "failed" in line], failed((40, "robot_one", SLOW)).splitlines()[1:])
        return run

    def repeated(self, *options):
        """The hash, from a run in one process."""
        found, events, _ = self.done(self.slow_once(), "again", *ONE, "--faults-of", "out", *options)
        self.assertEqual(events, failed((40, "robot_one", SLOW)))
        return found


class OnceDecided(SlowOnce):
    def test_by_a_host_that_takes_a_place_and_by_all_that_start_again(self):
        for program, said in (("controller_host", REPLACED), ("space_server", AGAIN)):
            with self.subTest(program):
                run = self.paused_after_the_fault()
                os.kill(run.find(program), signal.SIGKILL)
                text = run.read_until(said)
                self.wait_for_experiment("step_spins_once_stop_robot")
                self.run_it("control", "resume")
                self.assertEqual(run.wait(), 0, text + run.stderr)
                self.assertEqual(self.events("out").count("failed"), 1)
                self.assertEqual(self.assert_finished(run, TICKS), self.repeated())
                self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "again").read_text())
                for name in ("out", "again_out", "again", "cluster", "mark"):
                    os.rename(self.folder / name, self.folder / f"{name}_{program}")


class OfEarlierRuns(SlowOnce):
    def test_of_another_run(self):
        experiment = self.slow_once()
        first = self.done(experiment, "first")[0]
        os.rename(self.folder / "first_out", self.folder / "out")
        self.assert_verified("out")
        self.assertEqual(self.repeated(), first)
        self.assertEqual(self.done(experiment, "cluster", "--faults-of", "out", "--controller-hosts", 2)[0], first)
        self.assertNotEqual(self.done(experiment, "unknown", *ONE)[0], first)
        for folder, text in (("nowhere", "nowhere"), ("out", "of another experiment")):
            run = self.run_it("run", experiment, "--faults-of", folder, "--seed", 9)
            self.assertEqual(run.process.returncode, 2, run.stderr)
            self.assertIn(f"--faults-of '{folder}': ", run.stderr)
            self.assertIn(text, run.stderr)

    def test_by_a_run_that_is_resumed(self):
        run = self.paused_after_the_fault()
        # A resumed run computes the ticks again that the journal lacks, and then no step is slow.
        self.wait_until("the journal with the fault", lambda: self.run_it("replay", "out", "text", "file=shown.txt", "--from", 50).process.returncode == 0, run)
        self.kill_all(run)
        resumed = self.run_it("resume", "out")
        self.assertEqual(resumed.process.returncode, 0, resumed.stderr)
        self.assertEqual(self.assert_finished(resumed, TICKS), self.repeated())


# The same if commands act a tick later: a failure is part of the commands of its step.
class ThrowsAhead(Throws):
    AHEAD = 1


class DiesAhead(Dies):
    AHEAD = 1


class OnceDecidedAhead(OnceDecided):
    AHEAD = 1
