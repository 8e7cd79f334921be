"""swarmanoid.attach: a program as a member of a run as a cluster."""
import contextlib
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import swarmanoid

CONFIGS = pathlib.Path(os.environ["SWARMANOID_CONFIGS"])
SWARMANOID = os.environ["SWARMANOID"]
EXPERIMENT = CONFIGS / "diffusion_10.xml"
GENEROUS_S = 100


class Attached(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmanoid_attached_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        # Other users' runs on this machine must not be found.
        shared = tempfile.TemporaryDirectory(prefix="swarmanoid-attached-", dir="/dev/shm")
        self.addCleanup(shared.cleanup)
        os.environ["SWARMANOID_SHARED_FOLDER"] = shared.name

    def start(self, *options):
        run = subprocess.Popen([SWARMANOID, "run", EXPERIMENT, "--quiet", "--no-visualisers", "--output", self.folder / "run", *options],
                               cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.addCleanup(self.end, run)
        return run

    def end(self, run):
        if run.poll() is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(run.pid, signal.SIGTERM)
        run.communicate(timeout=GENEROUS_S)

    def attach(self, **options):
        run = swarmanoid.attach("diffusion_10", wait=GENEROUS_S, timeout=GENEROUS_S, **options)
        self.addCleanup(run.close)
        return run

    def hash_of(self, run):
        stdout, stderr = run.communicate(timeout=GENEROUS_S)
        self.assertEqual(run.returncode, 0, stderr)
        return re.search(r"hash ([0-9a-f]{16})", stdout).group(1)

    def command(self, *words):
        done = subprocess.run([SWARMANOID, *words], cwd=self.folder, capture_output=True, text=True, timeout=GENEROUS_S, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_a_run_that_is_steered_is_the_simulation_that_is_steered_alike(self):
        alone = swarmanoid.Simulation(EXPERIMENT, {"framework.seed": 3, "framework.maxclock": 200})
        cluster = self.start("--seed", "3", "--ticks", "200", "--paused")
        run = self.attach()
        self.assertEqual((run.seed, run.max_ticks, run.ids, run.kinds), (3, 200, alone.ids, alone.kinds))

        def same(state):
            self.assertEqual((state.tick, state.hash, state.time), (alone.tick, alone.hash(), alone.time))
            for name in ("x", "y", "z", "qx", "qy", "qz", "qw", "attributes"):
                np.testing.assert_array_equal(getattr(state, name), getattr(alone, name))
            np.testing.assert_array_equal(state.positions("footbot"), alone.positions("footbot"))
            np.testing.assert_array_equal(state.attribute("led", "footbot"), alone.attribute("led", "footbot"))

        same(run.state())
        self.assertEqual(run.step(60).tick, 60)
        alone.step(60)
        before = run.state()
        same(before)
        place = alone.positions("footbot").mean(axis=0)  # a number with all its bits
        place = self.free_place(alone, place)
        answer = run.move("fb_0", place, (0, 0, 30.1))
        self.assertEqual((answer.tick, answer.text), (60, "moved 'fb_0' at tick 60"))
        alone.move("fb_0", place, (0, 0, 30.1))
        same(run.state())
        # States are copies, which stay as they are.
        self.assertNotEqual(before.x[before.index("fb_0")], place[0])
        with self.assertRaisesRegex(ValueError, "read-only"):
            before.x[0] = 1
        run.step(20)
        alone.step(20)
        run.remove("fb_3")
        alone.remove("fb_3")
        same(run.state())
        self.assertEqual(list(run.state().present()), [name != "fb_3" for name in run.ids])
        run.step(20)
        alone.step(20)
        run.add("fb_3", place + [0, 0.5, 0] if place[1] < 2 else place - [0, 0.5, 0])
        alone.add("fb_3", place + [0, 0.5, 0] if place[1] < 2 else place - [0, 0.5, 0])
        same(run.state())
        self.await_status(run, "paused", 100)
        run.resume()
        last, ticks = None, []
        for state in run:
            last = state
            ticks.append(state.tick)
        # Each once, but for the last one, which may have come before as one that others follow.
        self.assertEqual(ticks[:-1], sorted(set(ticks[:-1])))
        alone.step(100)
        same(last)
        self.assertTrue(last.last and run.is_over)
        self.assertIsNone(run.wait())
        expected = alone.finish().hash
        self.assertEqual(self.hash_of(cluster), expected)
        with self.assertRaisesRegex(swarmanoid.RunError, "has ended"):
            run.pause()
        # What was asked is in the journal.
        code, text = self.command("replay", str(self.folder / "run"), "--verify")
        self.assertEqual(code, 0, text)

    def free_place(self, simulation, near):
        """Where no body is, near a point."""
        others = simulation.positions()[:, :2]
        for radius in np.arange(0.1, 3, 0.1):
            for angle in np.arange(0, 2 * np.pi, 0.3):
                place = near + radius * np.array([np.cos(angle), np.sin(angle), 0])
                if np.hypot(*(others - place[:2]).T).min() > 0.6 and (place[:2] > 0.5).all():
                    return place
        raise AssertionError("the arena is full")

    def await_status(self, run, phase, tick):
        deadline = time.monotonic() + GENEROUS_S
        while (run.status()["phase"], run.status()["tick"]) != (phase, tick):
            self.assertLess(time.monotonic(), deadline, run.status())
            time.sleep(0.01)

    def test_the_command_sees_what_the_program_asked(self):
        cluster = self.start("--ticks", "0", "--paused")
        run = self.attach()
        self.assertEqual(run.speed(0.5).text, "0.5 times real time")
        code, text = self.command("control", "step", "5")
        self.assertEqual((code, text), (0, "diffusion_10: paused at tick 5\n"))
        self.assertEqual(run.wait(tick=5, timeout=GENEROUS_S).tick, 5)
        for verb, arguments, message in (("move", ("fb_x", (1, 1, 0)), "there is no entity 'fb_x'"),
                                         ("step", (0,), "no number of ticks"), ("speed", (-1,), "no multiple of real time")):
            with self.assertRaisesRegex(ValueError, message):
                getattr(run, verb)(*arguments)
        with self.assertRaisesRegex(ValueError, "did you mean 'pause'"):
            run.control("pauze")
        self.await_status(run, "paused", 5)
        with self.assertRaisesRegex(TimeoutError, "no new state of 'diffusion_10' within 0.2 s; it is at tick 5, paused"):
            run.wait(tick=6, timeout=0.2)
        with self.assertRaisesRegex(ValueError, "attached to 'diffusion_10' already"):
            swarmanoid.attach("diffusion_10")
        robot = run.robot("fb_0", timeout=GENEROUS_S)
        self.assertEqual(robot.controller, "diffusion")
        self.assertEqual(robot.sensors["footbot_proximity"].values.shape, (24,))
        self.assertEqual(robot.actuators["footbot_wheels"].names, ("left", "right"))
        self.assertEqual([process["name"] for process in run.status()["processes"]][0], "space server")
        # Who leaves ends nothing, and may come again.
        run.close()
        run.close()
        with self.assertRaisesRegex(swarmanoid.RunError, "has left the run"):
            run.pause()
        again = self.attach()
        self.assertEqual(again.state().tick, 5)
        again.stop()
        self.hash_of(cluster)
        self.assertIsNone(again.wait(tick=10**9))

    def test_each_request_of_the_table_is_a_method_that_checks_its_arguments(self):
        good_words = {"name": lambda parameter: "x", "whole": lambda parameter: int(parameter["minimum"]) + 1, "change": lambda parameter: "+1",
                      "number": lambda parameter: parameter["minimum"], "pose": lambda parameter: "1,1,0"}
        self.start("--ticks", "0", "--paused")
        run = self.attach()
        for verb in swarmanoid._module.control_verbs():
            with self.subTest(verb=verb["name"]):
                form = re.escape("write " + verb["form"])
                parameters = [each for each in verb["parameters"] if not each["is_option"]]
                good = [good_words[each["type"]](each) for each in parameters]
                with self.assertRaisesRegex(ValueError, form):
                    run.control(verb["name"], *good, "extra")
                if any(not each["optional"] for each in parameters):
                    with self.assertRaisesRegex(ValueError, form):
                        run.control(verb["name"])
                for number, each in enumerate(parameters):
                    if each["type"] != "name":
                        with self.assertRaisesRegex(ValueError, form):
                            run.control(verb["name"], *good[:number], "1e300", *good[number + 1:])
                with self.assertRaisesRegex(ValueError, "it takes no 'height'"):
                    run.control(verb["name"], *good, height=1)
                method = getattr(run, verb["name"].replace("-", "_"))
                self.assertIn(verb["help"], method.__doc__)
                with self.assertRaises(TypeError):
                    method(*good, *good, "x", "y", "z")
        self.assertEqual(run.pause().tick, 0)
        run.stop()

    def test_a_run_begins_again_with_another_seed(self):
        cluster = self.start("--seed", "3", "--ticks", "50", "--paused")
        run = self.attach()
        first = run.state()
        run.reset(seed=4)
        while (state := run.wait(timeout=GENEROUS_S)).hash == first.hash:
            pass
        alone = swarmanoid.Simulation(EXPERIMENT, {"framework.seed": 4, "framework.maxclock": 50})
        self.assertEqual((run.seed, state.tick, state.hash), (4, 0, alone.hash()))
        run.resume()
        self.assertEqual(self.hash_of(cluster), alone.run().hash)

    def test_a_run_that_fails_says_so(self):
        self.start("--ticks", "0", "--no-recovery", "--no-journal")
        run = self.attach()
        run.state(timeout=GENEROUS_S)
        while not (engines := [each["process"] for each in run.status()["processes"] if each["name"] == "engine 'ground'" and each["process"]]):
            run.wait(timeout=GENEROUS_S)
        os.kill(int(engines[0].split(":")[1]), signal.SIGKILL)
        # Who is heard first: the processes that the run has left fail of it, too.
        with self.assertRaisesRegex(swarmanoid.RunError, "engine 'ground'|the space server has gone|failed at tick"):
            while run.wait(timeout=GENEROUS_S):
                pass
        self.assertTrue(run.is_over)

    def test_keyboard_interrupts_what_waits(self):
        self.start("--ticks", "0", "--paused")
        run = self.attach()
        run.state()
        for wait in (lambda: run.wait(tick=10), lambda: run.speed(0.01) and run.step(10**6)):
            timer = threading.Timer(0.5, signal.raise_signal, [signal.SIGINT])
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                wait()
            timer.join()
        self.assertRegex(run.pause().text, "paused at tick")

    def test_what_is_not_there_is_named(self):
        with self.assertRaisesRegex(ValueError, "no experiment runs on this machine as a cluster"):
            swarmanoid.attach()
        with self.assertRaisesRegex(TimeoutError, "the space server of 'elsewhere' in domain 231 was not heard within 0.3 s"):
            swarmanoid.attach("elsewhere", domain=231, insecure=True, timeout=0.3)
        with self.assertRaisesRegex(ValueError, "0.01 to 30"):
            swarmanoid.attach(hz=100)
        self.start("--ticks", "0", "--paused")
        self.attach().close()
        with self.assertRaisesRegex(ValueError, "leave out --insecure"):
            swarmanoid.attach("diffusion_10", insecure=True)

    def test_a_program_that_ends_leaves_the_run(self):
        cluster = self.start("--ticks", "0", "--paused")
        program = "import swarmanoid; run = swarmanoid.attach('diffusion_10', wait=60, timeout=60); print(run.step(3).tick, run.state().tick)"
        ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=GENEROUS_S, check=False)
        self.assertEqual((ended.returncode, ended.stdout, ended.stderr), (0, "3 3\n", ""))
        self.attach().stop()
        self.hash_of(cluster)
