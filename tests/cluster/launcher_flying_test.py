"""Robots that fly in gusts: the same hash in one process and in clusters, whichever process dies, from a checkpoint and from the journal."""
from harness import AGAIN, CONFIGS, REPLACED, LauncherTest

TICKS = 150


class FlyingTest(LauncherTest):
    def done(self, name, *options):
        run = self.run_it("run", CONFIGS / "crazyflies.xml", "--ticks", TICKS, "--hash-log", name, "--output", name + "_out", *options)
        self.assertEqual(run.process.returncode, 0, run.stderr)
        return (self.folder / name).read_text()

    def test_the_same_everywhere(self):
        one = self.done("one", "--single-process")
        self.assertNotEqual(one, self.done("calm", "--single-process", "--set", "arena.wind.gusts=0"))
        for name, options in (("threads", ("--single-process", "--threads", 2)), ("cluster", ()), ("hosts", ("--controller-hosts", 2))):
            self.assertEqual(self.done(name, *options), one, name)
        replayed = self.run_it("replay", "hosts_out", "--verify")
        self.assertEqual(replayed.process.returncode, 0, replayed.stdout + replayed.stderr)

    def test_whichever_process_dies(self):
        one = self.done("one", "--single-process", "--checkpoint-every", 100)
        for program, says in (("controller_host", REPLACED), ("engine_worker", REPLACED), ("space_server", AGAIN)):
            with self.subTest(program):
                self.assert_survives(program, says, 90, program, one, CONFIGS / "crazyflies.xml", "--ticks", TICKS, "--controller-hosts", 2)
        self.assert_restored(one, 100)
