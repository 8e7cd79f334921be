"""`swarmanoid inspect`: the inside of robots at ticks of a run's past."""
import json
import math

from harness import CONFIGS, LauncherTest


class Inspect(LauncherTest):
    def run_of(self, config, ticks, *options, code=0):
        run = self.run_it("run", CONFIGS / f"{config}.xml", "--ticks", ticks, "--output", "run", "--quiet", "--no-visualisers", *options)
        self.assertEqual(run.process.returncode, code, run.stderr)

    def inspect(self, tick, *words):
        told = self.run_it("inspect", f"run@{tick}", *words, "--json")
        self.assertEqual(told.process.returncode, 0, told.stderr)
        return json.loads(told.stdout)["robots"]

    def readings(self, robot, device):
        devices = {d["type"]: d["readings"] for d in robot["sensors"] + robot["actuators"]}
        return {r["name"]: r["value"] for r in devices[device]}

    def test_whichever_host_and_saved_state_it_is_computed_from(self):
        """Paced, so that states are saved on the way: from them, and from tick 0 of another run, the same comes."""
        self.run_of("prey_retrieval", 430, "--real-time", 20, "--controller-hosts", 2, code=1)
        ticks = (0, 230, 411, 429)
        first = [self.inspect(tick, "fb_1", "eb") for tick in ticks]
        (self.folder / "run").rename(self.folder / "paced")
        self.run_of("prey_retrieval", 430, code=1)
        self.assertEqual([self.inspect(tick, "fb_1", "eb") for tick in ticks], first)
        for robots in first:
            self.assertEqual([robot["controller"] for robot in robots], ["retriever", "guide"])
            self.assertEqual(len(self.readings(robots[0], "footbot_proximity")), 24)
            self.assertTrue(all(math.isfinite(value) for value in self.readings(robots[0], "footbot_wheels").values()))
        self.assertGreater(len({robots[1]["state"] for robots in first}), 1, "the guide has gone on to another state")

    def test_a_table_for_people_and_state_machines(self):
        self.run_of("prey_retrieval", 500, code=1)
        told = self.run_it("inspect", "run@420", "fb_1", "eb")
        self.assertEqual(told.process.returncode, 0, told.stderr)
        self.assertIn("fb_1 at tick 420, 42 s\n  controller retriever\n  state ", told.stdout)
        self.assertIn("\neb at tick 420", told.stdout)
        self.assertRegex(told.stdout, r"\n  sensor footbot_\w+\n    \S+ +\S+")

    def test_what_is_not_there_is_named(self):
        self.run_of("diffusion_10", 20)
        for words, says in ((("run", "fb_1"), "no run and tick"), (("run@5", "fb_99"), "no robot 'fb_99' with a controller"),
                            (("run@5", "wall_0"), "no robot 'wall_0'"), (("none@5", "fb_1"), "no folder of a run")):
            told = self.run_it("inspect", *words)
            self.assertEqual(told.process.returncode, 2, told.stderr)
            self.assertIn(says, told.stderr)
        told = self.run_it("inspect", "run@21", "fb_1")
        self.assertEqual(told.process.returncode, 4)
        self.assertIn("ticks 0 to 20, and not 21", told.stderr)
