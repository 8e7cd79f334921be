"""Branches: runs that begin as an earlier run was at one of its ticks."""
import json

from harness import CONFIGS, LauncherTest

ONE = ["--single-process"]


class Branches(LauncherTest):
    def go(self, *words, code=0):
        run = self.run_it("run", "--quiet", *words)
        self.assertEqual(run.process.returncode, code, run.stdout + run.stderr)
        self.assert_nothing_left(run)
        return run

    def end_of(self, run):
        return self.assert_finished(run)

    def branch(self, at, out, *words, code=0):
        return self.go("--branch", at, "--output", out, "--hash-log", f"{out}.hashes", *words, code=code)

    def hashes(self, name):
        """Of each tick."""
        lines = (line.split() for line in (self.folder / name).read_text().splitlines() if line[0].isdigit())
        return {int(tick): value for tick, value in lines}

    def origin(self, out):
        return json.loads((self.folder / out / "manifest.json").read_text())["branch_of"]

    def refused(self, *words, says):
        run = self.go(*words, code=2)
        for text in says:
            self.assertIn(text, run.stderr)
        self.assertFalse((self.folder / "runs").exists(), "nothing was started")

    def assert_same_ticks(self, out, tick, begins=None):
        """Each tick of a branch has the hash of the run that it is of."""
        old, new = self.hashes("old.hashes"), self.hashes(f"{out}.hashes")
        begins = tick if begins is None else begins
        self.assertEqual(new, {t: h for t, h in old.items() if t >= begins})
        origin = self.origin(out)
        self.assertEqual((origin["run"], origin["tick"], origin["first_tick"]), (str(self.folder / "old"), tick, begins))
        self.assertEqual(origin["state_hash"], old[tick])
        self.assertEqual(origin["changes"], [])


class Unchanged(Branches):
    def check(self, name, ticks, at, *words, begins=None, code=0):
        self.go(CONFIGS / f"{name}.xml", "--ticks", ticks, "--output", "old", "--hash-log", "old.hashes", *words, code=code)
        for tick in at:
            for way, options in (("cluster", []), ("one", ONE)):
                out = f"{way}_{tick}"
                self.branch(f"old@{tick}", out, *options, code=code)
                self.assert_same_ticks(out, tick, begins)

    def test_a_swarm_at_any_tick_from_the_nearest_state_that_was_saved(self):
        """Slow enough that states are saved on the way."""
        self.check("diffusion_10", 600, [1, 137, 400, 599], "--real-time", 30)

    def test_what_holds_together_in_box2d_which_is_saved_at_each_hundredth_tick(self):
        self.check("gripped_chain", 150, [100])
        self.branch("old@149", "odd")
        self.assert_same_ticks("odd", 149, begins=100)

    def test_ode_at_any_tick(self):
        self.check("handbot_shelf", 130, [77])

    def test_functions_and_behaviours(self):
        self.check("prey_retrieval", 2200, [2107], code=1)

    def test_two_controller_hosts(self):
        self.check("diffusion_10", 300, [123], "--controller-hosts", 2)

    def test_what_users_did_is_done_till_then_and_with_their_events_after_it(self):
        asked = self.folder / "asked.csv"
        asked.write_text("tick,request,entity,numbers,from\n50,move,fb_1,1 1 0,\n123,move,fb_2,2 2 0,\n200,remove,fb_3,,\n")
        self.go(CONFIGS / "diffusion_10.xml", "--ticks", 300, "--output", "old", "--hash-log", "old.hashes", "--events", asked)
        old = self.hashes("old.hashes")
        for tick in (122, 123, 199, 200):
            self.branch(f"old@{tick}", f"all_{tick}", "--events", "old/events.csv")
            self.assert_same_ticks(f"all_{tick}", tick)
            self.branch(f"old@{tick}", f"alone_{tick}")
            alone = self.hashes(f"alone_{tick}.hashes")
            self.assertEqual(alone[tick], old[tick])
            self.assertEqual(alone[300] == old[300], tick == 200, "what was asked later is not done by itself")

    def test_a_branch_of_a_branch_is_shown_computed_again_compared_and_goes_on(self):
        self.check("diffusion_10", 300, [150])
        self.go("--branch", "cluster_150@223", "--output", "second", "--hash-log", "second.hashes")
        old = self.hashes("old.hashes")
        self.assertEqual(self.hashes("second.hashes"), {t: h for t, h in old.items() if t >= 223})
        verified = self.run_it("replay", "second", "--verify")
        self.assertEqual((verified.process.returncode, verified.stdout), (0, "equal: 78 states, computed again\n"))
        compared = self.run_it("diff", "old", "second")
        self.assertEqual((compared.process.returncode, compared.stdout), (0, "equal: 78 states, from tick 223 on\n"), compared.stderr)
        table = self.run_it("export", "second", "--csv", "-", "--until", 223)
        self.assertEqual(table.stdout.splitlines()[1].split(",")[0], "223")
        resumed = self.run_it("resume", "second", "--quiet")
        self.assertEqual(self.assert_finished(resumed), old[300])

    def test_controllers_that_cannot_be_saved_begin_where_the_run_did(self):
        self.go(self.write_faulty("none"), "--ticks", 60, "--output", "old", "--hash-log", "old.hashes")
        told = self.run_it("run", "--branch", "old@40", "--output", "new", "--hash-log", "new.hashes")
        self.assert_same_ticks("new", 40, begins=0)
        self.assertIn("it begins at tick 0", told.stderr)
        refused = self.run_it("run", "--branch", "old@40", "--set", "controllers.c.parameters.tick=3")
        self.assertEqual(refused.process.returncode, 4)
        self.assertIn("robot 'robot_one': its controller cannot be saved", refused.stderr)


class Changed(Branches):
    def setUp(self):
        super().setUp()
        self.go(CONFIGS / "diffusion_10.xml", "--ticks", 300, "--output", "old", "--hash-log", "old.hashes")
        self.old = self.hashes("old.hashes")

    def test_one_process_and_a_cluster_agree_and_leave_the_old_way(self):
        changes = ["--set", "controllers.diffusion.parameters.velocity=0.02", "--ticks", 320]
        self.branch("old@111", "one", *ONE, *changes)
        self.branch("old@111", "cluster", *changes)
        one = self.hashes("one.hashes")
        self.assertEqual(one, self.hashes("cluster.hashes"))
        self.assertEqual((min(one), max(one)), (111, 320))
        self.assertEqual(one[111], self.old[111])
        self.assertNotEqual(one[112], self.old[112])
        self.assertEqual(self.origin("cluster")["changes"], ["framework.maxclock: 320 instead of 300",
                                                             "controllers.diffusion.parameters.velocity: 0.02 instead of 0.05"])
        verified = self.run_it("replay", "cluster", "--verify")
        self.assertEqual(verified.process.returncode, 0, verified.stdout + verified.stderr)

    def test_another_seed_is_another_future(self):
        proximity = "controllers.diffusion.sensors.footbot_proximity"
        noisy = ["--set", f"{proximity}.noise_kind=gaussian", "--set", f"{proximity}.noise_deviation=0.1"]
        self.branch("old@100", "first", *noisy)
        self.branch("old@100", "second", *noisy, "--seed", 2)
        self.assertNotEqual(self.hashes("first.hashes")[300], self.hashes("second.hashes")[300])

    def test_box2d_between_its_hundredths(self):
        self.go(CONFIGS / "gripped_chain.xml", "--output", "chain", "--hash-log", "chain.hashes")
        slower = ["--set", "controllers.chain.parameters.velocity=-0.01"]
        self.branch("chain@120", "one", *ONE, *slower)
        self.branch("chain@120", "cluster", *slower)
        one = self.hashes("one.hashes")
        self.assertEqual(one, self.hashes("cluster.hashes"))
        self.assertEqual(one[120], self.hashes("chain.hashes")[120])

    def test_what_may_not_change(self):
        for setting, name in [("framework.clocktick=50", "framework.clocktick"), ("arena.wall_west.size=0.2,3,1", "arena.wall_west.size"),
                              ("controllers.diffusion.on_failure=stop_robot", "controllers.diffusion.on_failure"),
                              ("arena.size=5,5,1", "arena.size")]:
            with self.subTest(setting):
                self.refused("--branch", "old@100", "--set", setting, says=[f"--branch: {name} cannot change in the middle of a run"])
        other = CONFIGS / "gripped_chain.xml"
        self.refused(other, "--branch", "old@100", says=["cannot change in the middle of a run"])

    def test_what_cannot_be(self):
        self.refused("--branch", "old@301", says=["has ticks 0 to 300, and not 301"])
        self.refused("--branch", "old@300", says=["ended at tick 300; the last one to branch off is 299"])
        self.refused("--branch", "nowhere@3", says=["nowhere", "is no folder of a run"])
        self.refused("--branch", "old", says=["RUN@TICK", "for example --branch runs/first@500"])
        self.refused("--branch", "old@9", "--restore", CONFIGS / "diffusion_10.xml", says=["leave out --restore"])
        self.refused(says=["name an experiment file, or a run to branch off with --branch RUN@TICK"])
        self.go(CONFIGS / "diffusion_10.xml", "--ticks", 20, "--output", "without", "--no-journal")
        self.refused("--branch", "without@3", says=["keep a journal, unless they have --no-journal"])

    def test_a_run_that_used_something_else_then_is_noticed(self):
        """Here its log of events says now what was not done."""
        events = self.folder / "old" / "events.csv"
        events.write_text("tick,request,entity,numbers,from\n" + "".join(f"{tick},move,fb_1,0.4 0.4 0,\n" for tick in range(99, 110)))
        # A slow run has saved states at any ticks, also at several in a row. A branch at a tick that was saved needs no tick computed again.
        for tick in range(100, 110):
            wrong = self.run_it("run", "--quiet", "--branch", f"old@{tick}")
            if wrong.process.returncode != 0:
                break
        self.assertEqual(wrong.process.returncode, 4, wrong.stdout + wrong.stderr)
        self.assertRegex(wrong.stderr, "computed again, tick 1[01][0-9] differs from the journal")


del Branches
