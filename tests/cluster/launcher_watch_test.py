"""Running experiments are listed, looked at and controlled from outside, and it makes no difference to their results."""
import contextlib
import os
import pty
import signal
import subprocess

from harness import CONFIGS, DIFFUSION, GENEROUS_S, SWARMANOID, LauncherTest


class Watching(LauncherTest):
    def test_pause_step_resume_and_stop(self):
        run = self.start_paused("--ticks", 0)
        self.assertIn("at tick 3", self.control("step", 3))
        self.assertIn("at tick 4", self.control("diffusion_10", "step"))
        self.assertIn("at tick 4", self.control("pause"))
        self.control("speed", 10)
        self.control("resume")
        self.wait_for_tick("hashes", 20, run)
        self.control("pause")
        self.control("stop")
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        self.assert_finished(run)
        self.assert_nothing_left(run)

    def test_control_leaves_results_alone_unless_it_moves_something(self):
        plain = self.assert_finished(self.run_it("run", DIFFUSION, "--ticks", 300, "--quiet"), 300)
        run = self.start_paused("--ticks", 300)
        self.control("step", 7)
        self.control("resume")
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        self.assertEqual(self.assert_finished(run, 300), plain)
        hashes = set()
        for out in ("first", "second"):
            run = self.start_paused("--ticks", 300, "--output", out)
            self.control("step", 7)
            self.control("move", "fb_0", "1.5,1.5,0,0,0,90")
            self.control("resume")
            self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
            hashes.add(self.assert_finished(run, 300))
        self.assertEqual(len(hashes), 1)
        self.assertNotEqual(hashes.pop(), plain)

    def test_refused_requests_say_why(self):
        run = self.start_paused()
        answer = self.run_it("control", "move", "missing", "1,1,0")
        self.assertNotEqual(answer.process.returncode, 0)
        self.assertIn("missing", answer.stderr)
        answer = self.run_it("control", "other", "pause")
        self.assertEqual(answer.process.returncode, 2)
        self.assertIn("no experiment 'other' runs", answer.stderr)
        self.control("stop")
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        answer = self.run_it("control", "pause")
        self.assertEqual(answer.process.returncode, 2)
        self.assertIn("no experiment runs on this machine", answer.stderr)

    def test_of_several_one_is_to_be_named(self):
        first = self.start_paused()
        second = self.start("run", CONFIGS / "sample_footbot.xml", "--quiet", "--paused")
        self.wait_for_experiment("sample_footbot")
        answer = self.run_it("control", "pause")
        self.assertEqual(answer.process.returncode, 2)
        self.assertIn("diffusion_10 (domain ", answer.stderr)
        self.assertIn("sample_footbot (domain ", answer.stderr)
        # At a terminal the number of one is asked for.
        for answer, code in (("2", None), ("3", 2)):
            ours, theirs = pty.openpty()
            command = [SWARMANOID, "attach", "text", "--file", self.folder / "chosen", "--output", self.folder]
            with subprocess.Popen(command, stdin=theirs, stderr=theirs, stdout=subprocess.DEVNULL, cwd=self.folder) as watcher:
                os.write(ours, f"{answer}\n".encode())
                if code is None:
                    self.wait_until("a table", lambda: (self.folder / "chosen").is_file() and (self.folder / "chosen").stat().st_size > 0)
                    watcher.terminate()
                else:
                    self.assertEqual(watcher.wait(GENEROUS_S), code)
                    self.assertIn("'3' is none of 1 to 2", os.read(ours, 65536).decode())
            os.close(ours)
            os.close(theirs)
        self.control("sample_footbot", "stop")
        self.control("diffusion_10", "stop")
        self.assertEqual((first.wait(GENEROUS_S), second.wait(GENEROUS_S)), (0, 0))

    def test_attached_visualisers_see_the_world_and_do_not_hold_it(self):
        run = self.start_paused("--ticks", 0)
        self.control("step", 5)
        watcher = self.start("attach", "text", "diffusion_10", "precision=2", "file=watched.txt", "--output", self.folder)
        self.wait_until("a table", lambda: self.has_table("watched.txt"))
        self.assertIn("\n5\t", (self.folder / "watched.txt").read_text())
        self.control("resume")
        self.wait_for_tick("hashes", 500, run)
        watcher.process.send_signal(signal.SIGSTOP)
        reached = len((self.folder / "hashes").read_text().splitlines())
        self.wait_for_tick("hashes", reached + 2000, run)
        watcher.process.send_signal(signal.SIGCONT)
        self.control("stop")
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        self.assertEqual(watcher.wait(GENEROUS_S), 0, watcher.stderr)

    def test_unknown_visualisers_are_named(self):
        answer = self.run_it("attach", "txt")
        self.assertEqual(answer.process.returncode, 2)
        self.assertIn("did you mean 'text'?", answer.stderr)


class Terminal(LauncherTest):
    def test_progress_is_one_line_that_is_taken_away(self):
        reader, terminal = pty.openpty()
        process = subprocess.Popen([SWARMANOID, "run", str(DIFFUSION), "--real-time", "20", "--ticks", "300"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=terminal)
        os.close(terminal)
        shown = b""
        with contextlib.suppress(OSError):
            while chunk := os.read(reader, 4096):
                shown += chunk
        output = process.communicate()[0].decode()
        self.assertEqual(process.returncode, 0)
        self.assertTrue(output.startswith("finished: 300 ticks"))
        text = shown.decode()
        self.assertNotIn("\n", text)
        self.assertTrue(text.endswith("\r\x1b[K"))
        self.assertRegex(text, r"running: tick \d+ of 300 \(\d+ %\), [\d.]+x real time, .* left, 4 processes")
