"""Batteries: the same hash in one process and in clusters, over a network too, whichever process dies, from a checkpoint and from the journal."""
from harness import AGAIN, CONFIGS, REPLACED, LauncherTest

TICKS = 600
# Small batteries: robots are empty and stop after some 300 ticks, those in the nest are charged and run again.
SETTINGS = ["--set", "controllers.forager.sensors.battery.capacity=150", "--set", "controllers.forager.sensors.battery.start=0.9",
            "--set", "controllers.forager.parameters.recharge=0.6"]


class BatteryTest(LauncherTest):
    def done(self, name, *options, code=0):
        run = self.run_it("run", CONFIGS / "energy_foraging.xml", "--ticks", TICKS, "--hash-log", name, "--output", name + "_out", *SETTINGS, *options)
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
            for tick in (180, 420):
                name = f"{program}_{tick}"
                with self.subTest(name):
                    self.assert_survives(program, says, tick, name, one, CONFIGS / "energy_foraging.xml", "--ticks", TICKS, "--controller-hosts", 2, *SETTINGS)

    def test_from_a_checkpoint(self):
        one = self.done("one", "--single-process", "--checkpoint-every", 200)
        self.assert_restored(one, 200)
