"""A channel that all radios share: what is heard is the same in one process and in clusters, whichever process dies, from a checkpoint and from the journal.
Each robot reports how much it hears, which is part of the hash."""
from harness import AGAIN, CONFIGS, REPLACED, LauncherTest

TICKS = 200
# Half of the links are bad, and every second packet meets another one.
SETTINGS = ["--set", "controllers.sender.sensors.radio.capture=6", "--set", "controllers.sender.sensors.radio.shadowing=6",
            "--set", "controllers.sender.sensors.radio.range=3"]


class SharedChannelTest(LauncherTest):
    def done(self, name, *options, settings=SETTINGS):
        run = self.run_it("run", CONFIGS / "aloha.xml", "--ticks", TICKS, "--hash-log", name, "--output", name + "_out", *settings, *options)
        self.assertEqual(run.process.returncode, 0, run.stderr)
        return (self.folder / name).read_text()

    def test_the_same_everywhere(self):
        one = self.done("one", "--single-process")
        self.assertNotEqual(one, self.done("clear", "--single-process", settings=[]), "what is heard is part of the hash")
        for name, options in (("threads", ("--single-process", "--threads", 2)), ("cluster", ()), ("hosts", ("--controller-hosts", 3))):
            self.assertEqual(self.done(name, *options), one, name)
        replayed = self.run_it("replay", "hosts_out", "--verify")
        self.assertEqual(replayed.process.returncode, 0, replayed.stdout + replayed.stderr)

    def test_whichever_process_dies(self):
        one = self.done("one", "--single-process", "--checkpoint-every", 100)
        for program, says in (("controller_host", REPLACED), ("engine_worker", REPLACED), ("space_server", AGAIN)):
            with self.subTest(program):
                self.assert_survives(program, says, 130, program, one, CONFIGS / "aloha.xml", "--ticks", TICKS, "--controller-hosts", 2, *SETTINGS)
        self.assert_restored(one, 100)
