"""Fields on the floor: the same hash in one process and in clusters, over a network too, whichever process dies, from a checkpoint and from the journal."""
from harness import AGAIN, CONFIGS, REPLACED, LauncherTest

TICKS = 500
# Robots that leave at once are on the bridges after 150 ticks. The functions wipe the trails, which then begin again.
SETTINGS = ["--set", "controllers.ant.parameters.departures=0.2", "--set", "experiment_functions.count.wipe_at=300",
            "--set", "arena.trail.evaporation=0.01", "--set", "arena.trail.diffusion=0.01"]


class FloorFieldTest(LauncherTest):
    def done(self, name, *options, code=0):
        run = self.run_it("run", CONFIGS / "two_bridges.xml", "--ticks", TICKS, "--hash-log", name, "--output", name + "_out", *SETTINGS, *options)
        self.assertEqual(run.process.returncode, code, run.stderr)
        return (self.folder / name).read_text()

    def test_the_same_everywhere(self):
        one = self.done("one", "--single-process")
        self.assertEqual(one.count("\n"), TICKS + 1)
        for name, options in (("threads", ("--single-process", "--threads", 2)), ("cluster", ()), ("hosts", ("--controller-hosts", 3))):
            self.assertEqual(self.done(name, *options), one, name)
        replayed = self.run_it("replay", "hosts_out", "--verify")
        self.assertEqual(replayed.process.returncode, 0, replayed.stdout + replayed.stderr)

    def test_whichever_process_dies(self):
        one = self.done("one", "--single-process")
        for program, says in (("controller_host", REPLACED), ("engine_worker", REPLACED), ("space_server", AGAIN)):
            for tick in (280, 420):
                name = f"{program}_{tick}"
                with self.subTest(name):
                    self.assert_survives(program, says, tick, name, one, CONFIGS / "two_bridges.xml", "--ticks", TICKS, "--controller-hosts", 2, *SETTINGS)

    def test_from_a_checkpoint(self):
        one = self.done("one", "--single-process", "--checkpoint-every", 200)
        self.assert_restored(one, 200)

    def test_a_branch_at_any_tick(self):
        one = self.done("one")
        run = self.run_it("run", "--branch", "one_out@333", "--output", "branch_out", "--hash-log", "branch", "--single-process")
        self.assertEqual(run.process.returncode, 0, run.stderr)
        branch = (self.folder / "branch").read_text()
        self.assertTrue(one.endswith(branch[branch.index("\n") + 1:]))
