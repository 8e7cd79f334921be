"""Only processes of the same user may steer a run, from any folder. Also runs in a network of their own."""
import os
import pathlib
import shutil
import subprocess
import unittest

from harness import DIFFUSION, GENEROUS_S, SWARMANOID, LauncherTest, children_of

OTHER_USER = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]


def can_isolate():
    """Returns true if this system lets any user's process have a network of its own."""
    return subprocess.run(["unshare", "-n" if os.geteuid() == 0 else "-Un", "true"], check=False, capture_output=True).returncode == 0


class Security(LauncherTest):
    def start_paused(self, *options):
        return super().start_paused("--ticks", 50, "--real-time", 5, "--output", "out", *options)

    def resume(self):
        answer = self.run_it("control", "resume")
        self.assertEqual(answer.process.returncode, 0, answer.stderr)

    def plain(self):
        return self.assert_finished(self.run_it("run", DIFFUSION, "--ticks", 50, "--quiet", "--single-process", "--no-visualisers"), 50)

    def test_the_key_is_told_to_processes_alone(self):
        run = self.start_paused()
        keys = list(self.shared.glob("*/key"))
        self.assertEqual(len(keys), 1)
        self.assertEqual(keys[0].stat().st_mode & 0o777, 0o600)
        self.assertEqual(keys[0].parent.stat().st_mode & 0o777, 0o700)
        key = keys[0].read_text().strip()
        self.assertRegex(key, "^[0-9a-f]{64}$")
        self.wait_until("all processes", lambda: len(children_of(run.process.pid)) == 3)
        for pid in [run.process.pid, *children_of(run.process.pid)]:
            for name in ("cmdline", "environ"):
                self.assertNotIn(key, pathlib.Path(f"/proc/{pid}/{name}").read_bytes().decode(errors="replace"))
        self.resume()
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        self.assertEqual(self.assert_finished(run, 50), self.plain())
        for file in (self.folder / "out").rglob("*"):
            if file.is_file():
                self.assertNotIn(key.encode(), file.read_bytes(), file)
                self.assertNotIn(b"give the key", file.read_bytes(), file)

    def test_who_uses_no_key_or_one_too_many_is_told_at_once(self):
        for of_run, of_others, said in ([], ["--insecure"], "leave out --insecure"), (["--insecure"], [], "give --insecure here"):
            run = self.start_paused(*of_run)
            for command in ["control", "resume"], ["attach", "text"]:
                answer = self.run_it(*command, *of_others)
                self.assertEqual(answer.process.returncode, 2, answer.stderr)
                self.assertIn(said, answer.stderr)
            # As one of another machine would ask.
            domain = self.run_it("list", "experiments").stdout.split("domain")[1].split()[0]
            key = self.folder / "key"
            key.write_text("1" * 64 + "\n")
            key.chmod(0o600)
            answer = self.run_it("control", "diffusion_10", "resume", "--patience", 1, "--domain", domain, *(of_others or ["--key", key]),
                                 environment={"SWARMANOID_SHARED_FOLDER": f"{self.shared}-elsewhere"})
            self.assertEqual(answer.process.returncode, 4, answer.stderr)
            self.assertIn("does not answer", answer.stderr)
            self.assertIn("--key", answer.stderr)
            answer = self.run_it("control", "stop", "--patience", 60, *of_run)
            self.assertEqual(answer.process.returncode, 0, answer.stderr)
            self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
            shutil.rmtree(self.folder / "out")

    @unittest.skipUnless(os.geteuid() == 0, "only root can be another user")
    def test_another_user_is_refused_and_told_why(self):
        if subprocess.run([*OTHER_USER, "test", "-x", SWARMANOID], check=False).returncode != 0:
            self.skipTest("other users cannot start the command that is tested")
        run = self.start_paused()
        domain = self.run_it("list", "experiments").stdout.split("domain")[1].split()[0]
        answer = subprocess.run([*OTHER_USER, SWARMANOID, "control", "diffusion_10", "stop", "--domain", domain], check=False,
                                capture_output=True, text=True, cwd="/", timeout=GENEROUS_S)
        self.assertEqual(answer.returncode, 4, answer.stderr)
        self.assertIn("no key of it is given", answer.stderr)
        self.resume()
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        self.assert_finished(run, 50)

    @unittest.skipUnless(shutil.which("unshare") and can_isolate(), "needs network namespaces")
    def test_an_isolated_run_is_found_by_its_user_and_hidden_from_others(self):
        run = self.start_paused("--isolated")
        server = run.find("space_server")
        self.assertNotEqual(os.readlink(f"/proc/{server}/ns/net"), os.readlink("/proc/self/ns/net"))
        # No socket of its domain is to be reached from here. Other runs may use the same domain.
        domain = int(self.run_it("list", "experiments").stdout.split("domain")[1].split()[0])
        port = f":{7400 + 250 * domain:04X} "
        here, there = ({line.split()[9] for line in pathlib.Path(f"/proc/{process}/net/udp").read_text().splitlines() if port in line}
                       for process in ("self", server))
        self.assertTrue(there)
        self.assertFalse(here & there)
        watcher = self.start("attach", "text", "--file", "table", "--output", self.folder)
        self.wait_until("a table", lambda: self.has_table("table"), watcher)
        page = self.run_it("attach", "web", "--wait", 0)
        self.assertEqual(page.process.returncode, 2)
        self.assertIn("no browser could reach a page", page.stderr)
        self.resume()
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        self.assertEqual(watcher.wait(GENEROUS_S), 0, watcher.stderr)
        self.assertEqual(self.assert_finished(run, 50), self.plain())

    def test_the_user_who_stops_a_run_is_named(self):
        run = self.start_paused()
        self.assertEqual(self.run_it("control", "stop").process.returncode, 0)
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        self.assertRegex(run.stderr, r"(?m)^[^@\s]+@[^:\s]+:\d+: stopped at tick 0$")
        self.assertRegex((self.folder / "out" / "events.csv").read_text(), r"(?m)^0,stop,,,[^@,]+@[^,]+:\d+,\d+,\d{4}-\d\d-\d\dT[\d:]{8}Z,[0-9a-f]{8}$")
