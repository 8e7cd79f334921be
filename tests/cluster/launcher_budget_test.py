"""A journal with a budget: the newest is kept, and what that is enough for works as ever."""
import os
import re
import signal

from harness import CONFIGS, REPLACED, LauncherTest

# A state is saved at each hundredth tick. A hundred ticks take 560 kB, and 930 kB on a busy machine, which writes shorter
# blocks. So the budget always has room for the last two states.
SWARM = [CONFIGS / "diffusion_1000.xml", "--real-time", 20, "--journal-budget", "2MiB"]
BUDGET = 2 << 20
TICKS = 800


class Budget(LauncherTest):
    def setUp(self):
        super().setUp()
        self.expected = self.assert_finished(
            self.run_it("run", SWARM[0], "--ticks", TICKS, "--single-process", "--quiet", "--output", "one", "--no-visualisers"), TICKS)

    def bytes_of(self, out):
        return sum(file.stat().st_size for file in (self.folder / out / "journal").iterdir())

    def go_on(self, out, kill):
        """A run that is paused where the start of its journal is gone; some of its processes are killed there."""
        run = self.start("run", *SWARM, "--ticks", TICKS, "--no-visualisers", "--paused", "--output", out)
        self.wait_for_experiment("diffusion_1000")
        self.control("step", TICKS - 150)
        self.wait_until_the_start_is_gone(out)
        kill(run)
        return run

    def wait_until_the_start_is_gone(self, out):
        """The journal is written after the ticks, and on a busy machine some time after."""
        self.wait_until("the end of the first segment", lambda: not (self.folder / out / "journal" / "0").exists())

    def test_the_oldest_is_deleted_and_what_is_left_is_whole(self):
        run = self.run_it("run", *SWARM, "--ticks", TICKS, "--output", "out", "--no-visualisers")
        self.assertEqual(self.assert_finished(run, TICKS), self.expected)
        self.assert_nothing_left(run)
        self.assertFalse((self.folder / "out" / "journal" / "0").exists())
        self.assertLess(self.bytes_of("out"), BUDGET * 3 // 2)
        late = self.run_it("replay", "out", "text", "--from", 0)
        self.assertEqual(late.process.returncode, 2)
        first = int(re.search(r"--from: the journal begins at tick (\d+); what was before is more than its --journal-budget", late.stderr)[1])
        self.assertGreater(first, 0)
        verified = self.run_it("replay", "out", "--verify")
        self.assertEqual(verified.stdout, f"equal: {TICKS + 1 - first} states, computed again\n", verified.stderr)
        shown = self.run_it("replay", "out", "text", "file=shown.txt", "--from", TICKS - 20)
        self.assertEqual(shown.process.returncode, 0, shown.stderr)
        paced = self.run_it("replay", "out", "text", "status=true", "every=5", "entities=footbot", "--from", TICKS - 20, "--speed", 5)
        self.assertRegex(paced.stdout, rf"# tick {TICKS}, running, [1-9][\d.]*x real time", "a replay says how fast it is")
        refused = self.run_it("run", "--branch", f"out@{first - 1}")
        self.assertEqual(refused.process.returncode, 2)
        self.assertIn(f"has ticks {first} to {TICKS}, and not {first - 1}", refused.stderr)
        branch = self.run_it("run", "--branch", f"out@{TICKS - 33}", "--quiet", "--no-visualisers")
        self.assertEqual(self.assert_finished(branch, TICKS), self.expected)

    def test_each_process_is_replaced(self):
        run = self.go_on("out", lambda run: os.kill(run.find("engine_worker"), signal.SIGKILL))
        run.read_until(REPLACED)
        self.control("step", 20)
        os.kill(run.find("space_server"), signal.SIGKILL)
        run.read_until("all processes start again where the journal ends")
        self.wait_for_experiment("diffusion_1000")
        self.assertFalse((self.folder / "out" / "journal" / "0").exists(), "it goes on, and does not begin again")
        self.assertEqual(self.run_it("control", "resume").process.returncode, 0)
        run.wait()
        self.assertEqual(self.assert_finished(run, TICKS), self.expected)
        self.assert_nothing_left(run)

    def test_a_run_whose_machine_died_is_resumed(self):
        self.go_on("died", self.kill_all)
        resumed = self.run_it("resume", "died", "--quiet", "--no-visualisers")
        self.assertEqual(self.assert_finished(resumed, TICKS), self.expected, resumed.stderr)

    def test_a_visualisation_that_would_draw_from_the_start_ends_the_run_and_resume_goes_on(self):
        file = self.folder / "shown.xml"
        table = "<visualisations><text_render id='t'><file>t.txt</file><every>100</every></text_render></visualisations>"
        file.write_text(SWARM[0].read_text().replace("</ahss-config>", f"{table}</ahss-config>"))
        run = self.start("run", file, *SWARM[1:], "--ticks", TICKS, "--paused", "--output", "out")
        self.wait_for_experiment("shown")
        self.control("step", TICKS - 150)
        self.wait_until_the_start_is_gone("out")
        os.kill(run.find("visualiser"), signal.SIGKILL)
        run.wait()
        self.assertEqual(run.process.returncode, 4)
        self.assertIn("it saves no state, so it would do all ticks again, and of those before", run.stderr)
        self.assert_nothing_left(run)
        resumed = self.run_it("resume", "out", "--quiet")
        self.assertEqual(self.assert_finished(resumed, TICKS), self.expected, resumed.stderr)


class Refused(LauncherTest):
    def test_all_is_kept_and_told_if_a_controller_saves_no_state(self):
        # Slow enough for several states to be saved, however quick the machine is.
        run = self.run_it("run", self.write_faulty("none"), "--ticks", 3000, "--real-time", 100, "--journal-budget", "1KiB", "--output", "out")
        self.assert_finished(run, 3000)
        self.assertTrue((self.folder / "out" / "journal" / "0").exists())
        self.assertRegex(run.stderr, "keeps all: without its start controller host 0 could not be replaced, since it saves no state")

    def test_what_cannot_be_meant(self):
        for words, says in [(["--journal-budget", "much"], "a number of bytes"), (["--journal-budget", "2GB", "--no-journal"], "keeps no journal"),
                            (["--journal-budget", "2GB", "--single-process"], "leave out --single-process")]:
            with self.subTest(words):
                run = self.run_it("run", CONFIGS / "diffusion_10.xml", *words)
                self.assertEqual(run.process.returncode, 2)
                self.assertIn(says, run.stderr)
