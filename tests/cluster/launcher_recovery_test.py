"""Real processes of a run die, and others replace them: every tick has the hash of an undisturbed run in one process. The simulated cluster has the
moments at which they die (tests/simulated_cluster)."""
import contextlib
import csv
import os
import random
import shutil
import signal
import time

from harness import AGAIN, CONFIGS, GENEROUS_S, REPLACED, LauncherTest, children_of

WORKERS = ["engine_worker", "controller_host", "visualiser"]
PROGRAMS = ["engine_worker", "controller_host", "space_server"]
# Kills with a random moment each. SWARMANOID_KILLS asks for more.
KILLS = int(os.environ.get("SWARMANOID_KILLS", "8"))
ENDS = 3
SEED = int(os.environ.get("SWARMANOID_KILLS_SEED", "1"))
# Several hosts get the robots assigned again by position each time that all processes start again.
HOSTS = int(os.environ.get("SWARMANOID_KILLS_HOSTS", "2"))
EXPERIMENT = CONFIGS / os.environ.get("SWARMANOID_KILLS_EXPERIMENT", "diffusion_10.xml")


class Once(LauncherTest):
    def test_each_worker_while_the_run_is_paused(self):
        experiment = CONFIGS / "diffusion_10.xml"
        expected = self.one_process(experiment, 400)
        for program in WORKERS:
            with self.subTest(program):
                run = self.start("run", experiment, "--ticks", 400, "--paused", "--hash-log", "cluster", "--output", program)
                self.wait_for_experiment("diffusion_10")
                self.control("step", 250)
                pid = run.find(program)
                os.kill(pid, signal.SIGKILL)
                said = run.read_until(REPLACED)
                self.control("resume")
                self.assert_same(run, 400, expected, said)
                self.assertEqual((self.folder / program / "positions.txt").read_bytes(), (self.folder / "one_out/positions.txt").read_bytes())

    def test_an_engine_that_solves_groups_in_threads(self):
        for name in ("diffusion_100_dynamics2d", "diffusion_100_dynamics3d"):
            with self.subTest(name):
                experiment = CONFIGS / f"{name}.xml"
                expected = self.one_process(experiment, 200, "--threads", 1)
                run = self.start("run", experiment, "--ticks", 200, "--paused", "--set", "engines.ground.threads=2", "--hash-log", "cluster",
                                 "--output", name)
                self.wait_for_experiment(name)
                self.control("step", 120)
                os.kill(run.find("engine_worker"), signal.SIGKILL)
                said = run.read_until(REPLACED)
                self.control("resume")
                self.assert_same(run, 200, expected, said)

    def killed_once(self, fault, tick):
        """A run whose controller, which cannot be saved, is killed the first time that it gets there."""
        mark = self.folder / "killed"
        experiment = self.write_faulty(fault, tick)
        experiment.write_text(experiment.read_text().replace("</tick>", f"</tick><mark>{mark}</mark>"))
        mark.touch()
        expected = self.one_process(experiment, 300)
        mark.unlink()
        run = self.start("run", experiment, "--ticks", 300, "--hash-log", "cluster", "--output", "out")
        self.assert_same(run, 300, expected)
        return run.stderr

    def test_a_controller_that_cannot_be_saved_in_the_midst_of_its_step(self):
        self.assertIn("controller host 0 was killed by signal 9 (Killed), during robot 'robot_one', controller 'c': ControlStep at tick 150; "
                      + REPLACED, self.killed_once("step_killed_once", 150))

    def test_one_that_dies_after_the_last_tick_when_others_have_left(self):
        self.assertIn("Destroy at tick 299; " + REPLACED, self.killed_once("destroy_killed_once", 0))

    def interrupted(self, fault):
        """The end of a run that is interrupted, and whose controller dies on its way out."""
        experiment = self.write_faulty(fault)
        experiment.write_text(experiment.read_text().replace("</tick>", f"</tick><mark>{self.folder / 'killed'}</mark>"))
        run = self.start("run", experiment, "--ticks", 0, "--hash-log", "hashes", "--output", "out")
        self.wait_for_tick("hashes", 50, run)
        os.kill(run.process.pid, signal.SIGINT)
        run.wait()
        self.assert_nothing_left(run)
        return run

    def test_one_that_dies_while_the_run_stops(self):
        run = self.interrupted("destroy_killed_once")
        self.assertEqual(run.process.returncode, 130, run.stderr)
        self.assertIn(REPLACED, run.stderr)

    def test_one_that_dies_again_and_again_while_the_run_stops(self):
        run = self.interrupted("destroy_crashes")
        self.assertEqual(run.process.returncode, 4, run.stderr)
        self.assertEqual(run.stderr.count(REPLACED), 1)
        self.assertRegex(run.stderr, r"controller 'c': Destroy at tick \d+ aborted; the log of controller host 0")

    def test_one_that_is_stopped_for_longer_than_the_lease(self):
        experiment = CONFIGS / "diffusion_10.xml"
        expected = self.one_process(experiment, 400)
        run = self.start("run", experiment, "--ticks", 400, "--paused", "--hash-log", "cluster", "--output", "out", "--lease", 1)
        self.wait_for_experiment("diffusion_10")
        self.control("step", 120)
        os.kill(run.find("controller_host"), signal.SIGSTOP)
        said = run.read_until(REPLACED)
        self.control("resume")
        self.assert_same(run, 400, expected, said)


class AllAgain(LauncherTest):
    """The space server dies, alone or with others: all processes start again, and the files of the run do not show it."""

    def disturbed(self, victims, name, *options, stop=False):
        """A run that was paused at tick 250, when its processes died, and in which a user did something before and after."""
        run = self.start("run", CONFIGS / "diffusion_10.xml", "--ticks", 400, "--paused", "--hash-log", "cluster", "--output", name, *options)
        self.wait_for_experiment("diffusion_10")
        self.control("step", 120)
        self.control("move", "fb_0", "1.5,1.3,0,0,0,91.25")
        self.control("step", 130)
        self.control("move", "fb_1", "2.5,1.3,0,0,0,-3.5")
        for pid in [run.find(program) for program in victims]:
            # A worker ends by itself once it sees that the server is gone.
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGSTOP if stop else signal.SIGKILL)
        said = run.read_until(AGAIN)
        self.wait_for_experiment("diffusion_10")
        self.control("remove", "fb_2")
        self.assertEqual(self.control("step", 50), "diffusion_10: paused at tick 300\n")
        self.run_it("control", "resume")  # the run may end before its answer is heard
        self.assertEqual(run.wait(), 0, said + run.stderr)
        self.assertFalse((self.folder / "one_out").exists())
        expected = self.one_process(CONFIGS / "diffusion_10.xml", 400, "--events", f"{name}/events.csv")
        self.assert_same(run, 400, expected, said)
        self.assertEqual((self.folder / name / "positions.txt").read_bytes(), (self.folder / "one_out/positions.txt").read_bytes())
        events = [line.split(",")[:3] for line in (self.folder / name / "events.csv").read_text().splitlines()[1:]]
        self.assertEqual(events, [["0", "step", ""], ["120", "move", "fb_0"], ["120", "step", ""], ["250", "move", "fb_1"],
                                  ["250", "remove", "fb_2"], ["250", "step", ""], ["300", "resume", ""]])
        shutil.rmtree(self.folder / "one_out")
        return said

    def test_the_server(self):
        self.assertRegex(self.disturbed(["space_server"], "out"), r"space server was killed by signal 9 \(Killed\) at tick \d+; " + AGAIN)

    def test_all(self):
        self.disturbed(["controller_host", "visualiser", "space_server", "engine_worker"], "out")

    def test_the_server_is_stopped_for_longer_than_the_lease(self):
        self.disturbed(["space_server"], "out", "--lease", 1, stop=True)

    def test_a_step_that_is_awaited_ends_where_it_was_to_end(self):
        run = self.start("run", CONFIGS / "diffusion_10.xml", "--ticks", 400, "--paused", "--real-time", 20, "--hash-log", "cluster", "--output", "out")
        self.wait_for_experiment("diffusion_10")
        step = self.start("control", "step", 100)
        table = self.folder / "out/positions.txt"
        self.wait_until("the tenth tick", lambda: table.exists() and "\n10\t" in table.read_text(), run)
        os.kill(run.find("space_server"), signal.SIGKILL)
        said = run.read_until(AGAIN)
        self.assertEqual(step.wait(), 0, step.stderr)
        self.assertEqual(step.stdout, "diffusion_10: paused at tick 100\n")
        self.control("speed", 0)
        self.run_it("control", "resume")
        self.assert_same(run, 400, self.one_process(CONFIGS / "diffusion_10.xml", 400), said)

    def test_sensors_of_engines_and_functions_and_checkpoints(self):
        experiment = CONFIGS / "prey_retrieval.xml"
        ticks = 600
        run = self.start("run", experiment, "--ticks", ticks, "--paused", "--hash-log", "cluster", "--output", "out", "--no-visualisers",
                         "--checkpoint-every", 100)
        self.wait_for_experiment("prey_retrieval")
        said = ""
        for _ in range(2):
            self.control("step", 220)
            os.kill(run.find("space_server"), signal.SIGKILL)
            said += run.read_until(AGAIN)
            self.wait_for_experiment("prey_retrieval")
        self.control("resume")
        expected = self.one_process(experiment, ticks, "--no-visualisers", "--checkpoint-every", 100, code=1)
        self.assert_same(run, ticks, expected, said, code=1)
        for tick in range(100, ticks, 100):
            name = f"checkpoint-{tick:08}"
            self.assertEqual((self.folder / "out" / name).read_bytes(), (self.folder / "one_out" / name).read_bytes(), tick)


class LookingBack(LauncherTest):
    def test_a_run_is_computed_again_shown_again_and_compared(self):
        for name in ("plain", "moved"):
            run = self.start("run", CONFIGS / "diffusion_10.xml", "--ticks", 300, "--paused", "--output", name)
            self.wait_for_experiment("diffusion_10")
            self.control("step", 120)
            if name == "moved":
                self.control("move", "fb_7", "1.5,1.3,0,0,0,91.25")
            self.control("stop") if name == "plain" else self.run_it("control", "resume")
            self.assertEqual(run.wait(), 0, run.stderr)
        for name, states in (("plain", 121), ("moved", 301)):
            again = self.run_it("replay", name, "--verify")
            self.assertEqual((again.process.returncode, again.stdout), (0, f"equal: {states} states, computed again\n"), again.stderr)
            shown = self.run_it("replay", name, "text", "--file", "again.txt", "--precision", 4)
            self.assertEqual(shown.process.returncode, 0, shown.stderr)
            self.assertEqual((self.folder / "again.txt").read_bytes(), (self.folder / name / "positions.txt").read_bytes())
        same = self.run_it("diff", "moved", "moved")
        self.assertEqual((same.process.returncode, same.stdout), (0, "equal: 301 states\n"))
        other = self.run_it("diff", "plain", "moved")
        self.assertEqual(other.process.returncode, 5)
        self.assertRegex(other.stdout, r"^tick 120: x of 'fb_7' is \S+ and 1\.5; the commands of the tick before do not differ\n$")
        (self.folder / "moved/events.csv").unlink()
        wrong = self.run_it("replay", "moved", "--verify")
        self.assertEqual(wrong.process.returncode, 5)
        self.assertRegex(wrong.stdout, r"^tick 120: x of 'fb_7' is 1\.5 and \S+ \(in the journal, and computed again\)\n$")

    def test_runs_of_different_length_are_compared_to_the_end_of_the_shorter(self):
        for name, ticks in (("short", 40), ("long", 60)):
            run = self.run_it("run", CONFIGS / "diffusion_10.xml", "--ticks", ticks, "--no-visualisers", "--quiet", "--output", name)
            self.assertEqual(run.process.returncode, 0, run.stderr)
        for tick, name in ((20, "early"), (50, "late")):
            run = self.run_it("run", "--branch", f"long@{tick}", "--ticks", 60, "--no-visualisers", "--quiet", "--output", name)
            self.assertEqual(run.process.returncode, 0, run.stderr)
        for runs, code, said in ((("short", "long"), 5, "equal to the end of short, at tick 40\n"),
                                 (("long", "short"), 5, "equal to the end of short, at tick 40\n"),
                                 (("early", "short"), 5, "equal to the end of short, at tick 40\n"),
                                 (("long", "late"), 0, "equal: 11 states, from tick 50 on\n")):
            compared = self.run_it("diff", *runs)
            self.assertEqual((compared.process.returncode, compared.stdout, compared.stderr), (code, said, ""), runs)
        for runs in (("short", "late"), ("late", "short")):
            compared = self.run_it("diff", *runs)
            self.assertEqual((compared.process.returncode, compared.stdout), (2, ""), runs)
            self.assertIn("the journals have no tick in common: 'short' ends at tick 40, 'late' begins at 50", compared.stderr)


class Exported(LauncherTest):
    def table(self, *options):
        done = self.run_it("export", "out", "--csv", "-", *options)
        self.assertEqual((done.process.returncode, done.stderr), (0, ""))
        return list(csv.DictReader(done.stdout.splitlines()))

    def test_what_a_visualiser_wrote_in_the_run(self):
        run = self.run_it("run", CONFIGS / "diffusion_10.xml", "--ticks", 60, "--quiet", "--output", "out", "--set", "visualisations.positions.format=csv",
                          "--set", "visualisations.positions.precision=6")
        self.assertEqual(run.process.returncode, 0, run.stderr)
        with (self.folder / "out/positions.txt").open(newline="") as file:
            shown = {(row["clock"], row["Entity id"]): row for row in csv.DictReader(file)}
        exported = self.table()
        self.assertEqual([(row["tick"], row["entity"]) for row in exported], list(shown))
        for row in exported:
            for column, title in (("x", "X"), ("y", "Y"), ("gamma", "Gamma")):
                self.assertAlmostEqual(float(row[column]), float(shown[row["tick"], row["entity"]][title]), delta=0.51e-6)
            self.assertAlmostEqual(float(row["time_s"]), 0.1 * int(row["tick"]))

    def test_columns_entities_and_ticks(self):
        run = self.run_it("run", CONFIGS / "prey_retrieval.xml", "--ticks", 40, "--quiet", "--output", "out", "--no-visualisers")
        self.assertIn(run.process.returncode, (0, 1), run.stderr)
        rows = self.table("--columns", "led[3],qw,laser", "--every", 10, "--from", 15, "--until", 30)
        self.assertEqual(list(rows[0]), ["tick", "time_s", "entity", "kind", "led[3]", "qw", "laser[0]"])
        self.assertEqual({row["tick"] for row in rows}, {"20", "30"})
        self.assertEqual({row["kind"] for row in rows if row["laser[0]"] != ""}, {"eyebot"})
        some = self.table("--entities", "fb_?", "--until", 0)
        self.assertTrue(some)
        self.assertTrue(all(row["entity"].startswith("fb_") and row["tick"] == "0" for row in some))

    def test_what_cannot_be_meant(self):
        run = self.run_it("run", CONFIGS / "diffusion_10.xml", "--ticks", 5, "--quiet", "--output", "out")
        self.assertEqual(run.process.returncode, 0, run.stderr)
        (self.folder / "there.csv").write_text("mine")
        for options, says in ((["--csv", "there.csv"], "'there.csv' is there already"), ([], "--csv table.csv"),
                              (["--csv", "-", "--columns", "lde"], "did you mean 'led'?"), (["--csv", "-", "--entities", "x*"], "no entity"),
                              (["--csv", "-", "--from", "6"], "--from")):
            done = self.run_it("export", "out", *options)
            self.assertEqual((done.process.returncode, done.stdout.count("\n") < 2), (2, True), done.stdout)
            self.assertIn(says, done.stderr)
        self.assertEqual((self.folder / "there.csv").read_text(), "mine")


class GivingUp(LauncherTest):
    def test_a_crash_that_comes_again_is_named(self):
        run = self.run_it("run", self.write_faulty("step_crashes", 7), "--output", "out")
        self.assertEqual(run.process.returncode, 4)
        told = "robot 'robot_one', controller 'c': ControlStep at tick 7 aborted"
        self.assertIn(f"{told}; {REPLACED}", run.stderr)
        self.assertIn(f"{told}; the log of controller host 0 is {self.folder}/out/controller_host-0.log", run.stderr)
        self.assertEqual(run.stderr.count(REPLACED), 1)

    def test_without_replacements_the_run_ends(self):
        for options in (["--retries", 0], ["--no-journal"]):
            with self.subTest(options):
                run = self.start("run", CONFIGS / "diffusion_10.xml", "--ticks", 0, "--quiet", "--hash-log", "hashes", *options)
                pid = run.find("engine_worker")
                self.wait_for_tick("hashes", 100, run)
                os.kill(pid, signal.SIGKILL)
                self.assertEqual(run.wait(), 4)
                self.assertIn("engine 'ground' was killed by signal 9 (Killed)", run.stderr)
                os.unlink(self.folder / "hashes")


class Resumed(LauncherTest):
    def test_after_the_launcher_was_killed_with_all_its_processes(self):
        experiment = CONFIGS / "diffusion_10.xml"
        for moment in (20, 400):
            with self.subTest(moment):
                out = f"out{moment}"
                run = self.start("run", experiment, "--ticks", 600, "--paused", "--hash-log", "cluster", "--output", out, "--quiet",
                                 "--checkpoint-every", 200)
                self.wait_for_experiment("diffusion_10")
                self.control("step", 10)
                self.control("move", "fb_0", "1.5,1.3,0,0,0,91.25")
                self.control("step", moment - 10)
                self.control("remove", "fb_1")
                self.kill_all(run)
                expected = self.one_process(experiment, 600, "--events", f"{out}/events.csv")
                again = self.run_it("resume", out, "--quiet")
                self.assertEqual(again.process.returncode, 0, again.stderr)
                self.assertRegex(again.stderr, "going on from tick 0\n" if moment < 100 else "going on from tick [1-4]00\n")
                self.assertEqual(self.assert_finished(again, 600), expected)
                self.assert_nothing_left(again)

    def test_after_an_interrupt_at_a_tick_at_which_all_save_their_states(self):
        expected = self.one_process(CONFIGS / "diffusion_10.xml", 300)
        run = self.start("run", CONFIGS / "diffusion_10.xml", "--ticks", 300, "--paused", "--quiet", "--output", "out")
        self.wait_for_experiment("diffusion_10")
        self.control("step", 99)
        time.sleep(0.6)  # they save them twice a second
        self.control("step", 1)
        run.process.send_signal(signal.SIGINT)
        self.assertEqual(run.wait(), 130, run.stderr)
        self.assert_finished(run, 100)
        again = self.run_it("resume", "out", "--quiet")
        self.assertEqual(again.process.returncode, 0, again.stderr)
        self.assertEqual(self.assert_finished(again, 300), expected)


class Soak(LauncherTest):
    def newest(self):
        """The last tick of the hash log, which is cut where a run goes on."""
        log = self.folder / "cluster"
        lines = log.read_bytes().rsplit(b"\n", 2) if log.exists() else []
        return int(lines[-2].split()[0]) if len(lines) > 1 and lines[-2] else 0

    def test_kills_and_stops_at_random_moments(self):
        seed = random.Random(SEED)
        ticks = int(os.environ.get("SWARMANOID_KILLS_TICKS", 8000 * KILLS))
        run = self.start("run", EXPERIMENT, "--ticks", ticks, "--hash-log", "cluster", "--output", "out", "--no-visualisers",
                         "--retries", 1000, "--lease", 10, "--controller-hosts", HOSTS)
        self.wait_for_tick("cluster", 10, run)
        said, waits = "", []
        for _ in range(KILLS):
            time.sleep(seed.random() * 0.3)
            before = self.newest()
            victims = seed.sample(PROGRAMS, seed.choice([1, 1, 2]))
            stop = seed.random() < 0.1  # each takes the lease
            for program in victims:
                os.kill(run.find(program), signal.SIGSTOP if stop else signal.SIGKILL)
            since = time.monotonic()
            line = ""
            while REPLACED not in line and AGAIN not in line:
                line = run.process.stderr.readline()
                said += line
                self.assertNotEqual(line, "", "the run ended: " + said)
            # Mostly in the midst of ticks, else while others are still taking places.
            if seed.random() < 0.8:
                self.wait_until("the next tick", lambda: self.newest() > before, run)
                waits.append(time.monotonic() - since)
        expected = self.one_process(EXPERIMENT, ticks, "--no-visualisers", timeout=GENEROUS_S + 20 * KILLS)
        self.assertEqual(run.wait(GENEROUS_S + 20 * KILLS), 0, said + run.stderr)
        self.assert_same(run, ticks, expected, said)
        again = said.count(AGAIN)
        print(f"{KILLS} kills, {said.count(REPLACED)} replaced, {again} times all again, median to the next tick "
              f"{sorted(waits)[len(waits) // 2]:.2f} s", flush=True)

    def test_kills_while_the_run_ends(self):
        seed = random.Random(SEED)
        ticks = 1500
        expected = self.one_process(EXPERIMENT, ticks, "--no-visualisers")
        killed = 0
        for _ in range(ENDS):
            run = self.start("run", EXPERIMENT, "--ticks", ticks, "--hash-log", "cluster", "--output", "out", "--no-visualisers")
            run.find(PROGRAMS[-1])
            processes = children_of(run.process.pid)
            self.wait_until("the last ticks", lambda: run.process.poll() is not None or self.newest() > 0.95 * ticks)
            time.sleep(seed.random() * 0.1)
            with contextlib.suppress(ProcessLookupError):
                os.kill(seed.choice(processes), signal.SIGKILL)
                killed += 1
            self.assert_same(run, ticks, expected)
            shutil.rmtree(self.folder / "out")
            os.unlink(self.folder / "cluster")
        self.assertGreater(killed, 0)
