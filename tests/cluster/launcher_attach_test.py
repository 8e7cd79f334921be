"""Visualisers that come, watch, are stopped and are killed while a run goes on: it gives the same hashes as without them. And what users
change in a run can be repeated."""
import os
import pathlib
import pwd
import re
import shutil
import signal
import socket
import subprocess
import time
import unittest

from harness import DIFFUSION, GENEROUS_S, LauncherTest, end


class Attaching(LauncherTest):
    def watch(self, table, *options):
        return self.start("attach", "text", "--file", table, "--output", self.folder, *options)

    def test_stopped_and_killed_visualisers_leave_the_run_alone(self):
        plain = self.assert_finished(self.run_it("run", DIFFUSION, "--ticks", 4000, "--quiet", "--hash-log", "plain"), 4000)
        run = self.start_paused("--ticks", 4000)
        watchers = [self.watch(f"table_{k}", "--hz", 10, "--columns", "clock,Entity id,X,State") for k in range(4)]
        for k in range(4):
            self.wait_until(f"table {k}", lambda k=k: self.has_table(f"table_{k}"))
        self.control("step", 500)
        watchers[0].process.send_signal(signal.SIGSTOP)
        watchers[1].process.kill()
        self.control("step", 500)
        watchers[2].process.kill()
        self.control("resume")
        # One that is stopped would hold it up for ever.
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        self.assertEqual(self.assert_finished(run, 4000), plain)
        self.assertEqual((self.folder / "hashes").read_text(), (self.folder / "plain").read_text())
        self.assertEqual(watchers[3].wait(GENEROUS_S), 0, watchers[3].stderr)
        watchers[0].process.send_signal(signal.SIGCONT)
        watchers[0].wait(GENEROUS_S)

    def test_one_that_is_attached_survives_the_servers_death_with_its_table(self):
        run = self.start_paused("--no-journal")
        watcher = self.watch("table")
        self.wait_until("a table", lambda: self.has_table("table"))
        os.kill(run.find("space_server"), signal.SIGKILL)
        self.assertEqual(run.wait(GENEROUS_S), 4)
        self.assertEqual(watcher.wait(GENEROUS_S), 4)
        self.assertIn("the space server", watcher.stderr)
        self.assertTrue(self.has_table("table"))

    def test_with_follow_it_goes_on_with_the_next_run_of_the_experiment(self):
        first = self.start_paused("--ticks", 20)
        watcher = self.watch("table", "--follow", "--csv", "--columns", "clock,Entity id,X")
        self.wait_until("a table", lambda: self.has_table("table"))
        self.control("resume")
        self.assertEqual(first.wait(GENEROUS_S), 0, first.stderr)
        watcher.read_until("waiting for its next start")
        (self.folder / "table").unlink()
        second = self.start_paused("--ticks", 20)
        watcher.read_until("was started again")
        self.wait_until("a table of the next run", lambda: self.has_table("table"))
        self.control("resume")
        self.assertEqual(second.wait(GENEROUS_S), 0, second.stderr)
        watcher.read_until("waiting for its next start")
        watcher.process.send_signal(signal.SIGINT)
        self.assertEqual(watcher.wait(GENEROUS_S), 0, watcher.stderr)

    def test_one_that_is_attached_follows_the_run_to_its_next_server(self):
        run = self.start_paused("--ticks", 500)
        watcher = self.watch("table", "--columns", "clock,Entity id,X")
        self.wait_until("a table", lambda: self.has_table("table"))
        self.control("step", 150)
        os.kill(run.find("space_server"), signal.SIGKILL)
        said = watcher.read_until("waiting 15 s for another one in its place") + watcher.read_until("goes on with another space server")
        self.control("resume")
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        self.assertEqual(watcher.wait(GENEROUS_S), 0, said + watcher.stderr)
        self.assertTrue((self.folder / "table").read_text().splitlines()[-1].startswith("500\t"))

    def test_rates_are_kept(self):
        run = self.start_paused("--ticks", 0, "--real-time", 5)
        self.control("resume")
        before = time.monotonic()
        watcher = self.watch("table", "--hz", 4, "--entities", "footbot", "--csv")

        def ticks():
            text = (self.folder / "table").read_text() if (self.folder / "table").exists() else ""
            return {line.split(",")[0] for line in text.splitlines()[1:]}

        # However busy the machine is: never more often than asked, and on and on. 50 ticks of the run pass in a second.
        self.wait_until("eight tables", lambda: len(ticks()) >= 8)
        self.assertLessEqual(len(ticks()), 4 * (time.monotonic() - before) + 2)
        self.control("stop")
        self.assertEqual((run.wait(GENEROUS_S), watcher.wait(GENEROUS_S)), (0, 0))

    def test_status_and_owners_in_a_table(self):
        run = self.start_paused("--ticks", 0, "--controller-hosts", 2)
        self.control("step", 3)
        watcher = self.watch("table", "--columns", "Entity id,Engine,Host", "--entities", "footbot", "--status")
        self.wait_until("a table", lambda: self.has_table("table"))
        self.control("step", 20)
        self.wait_until("tick 23", lambda: "# tick 23, paused" in (self.folder / "table").read_text())
        text = (self.folder / "table").read_text()
        # Half of the robots each, those that start near one another.
        self.assertEqual(sorted(re.findall(r"^fb_\d\t\tground\t(\d)$", text, re.MULTILINE)[:10]), ["0"] * 5 + ["1"] * 5)
        self.control("stop")
        self.assertEqual((run.wait(GENEROUS_S), watcher.wait(GENEROUS_S)), (0, 0))

    def test_a_renderer_of_a_users_library_in_the_file_and_attached(self):
        library = pathlib.Path(os.environ["TEST_CONTROLLERS"]) / "libdistance_render.so"
        text = DIFFUSION.read_text()
        path = self.folder / "own.xml"
        element = f'<visualisations><distance_render id="own" library="{library}" file="distances" every="10"/></visualisations>'
        text = re.sub(r"<visualisations>.*</visualisations>|<visualisations/>", "", text, flags=re.S)
        path.write_text(text.replace("</ahss-config>", element + "</ahss-config>"))
        self.assert_finished(self.run_it("run", path, "--ticks", 20, "--quiet", "--output", "out"), 20)
        self.assertIn("\nfb_0\t\t3.421\n", (self.folder / "out" / "distances").read_text())

        run = self.start_paused("--ticks", 0)
        self.control("step", 3)
        answer = self.run_it("attach", library, "--help")
        self.assertIn("--precision", answer.stdout)
        watcher = self.start("attach", "distance_render", "--file", "table", "--output", self.folder, "--precision", 2,
                             environment={"SWARMANOID_PLUGIN_PATH": str(library.parent)})
        self.wait_until("a table", lambda: self.has_table("table"))
        self.assertRegex((self.folder / "table").read_text(), r"\nfb_9\t\t\d+(\.\d{1,2})?\n")
        self.assertIn("there is no visualiser 'distances'", self.run_it("attach", "distances").stderr)
        self.assertIn("holds no visualiser", self.run_it("attach", library.parent / "libfaulty_controller.so").stderr)
        self.control("stop")
        self.assertEqual((run.wait(GENEROUS_S), watcher.wait(GENEROUS_S)), (0, 0))

    def test_options_of_the_renderer_are_listed_and_checked(self):
        answer = self.run_it("attach", "text", "--help")
        self.assertRegex(answer.stdout, r"--every ticks +A table is written every so many ticks")
        answer = self.run_it("attach", "text", "--every", "x")
        self.assertEqual(answer.process.returncode, 2)
        self.assertIn("every is 'x'; it must be a whole number", answer.stderr)
        answer = self.run_it("attach", "text", "evry=2")
        self.assertEqual(answer.process.returncode, 2)
        self.assertIn("did you mean 'every'?", answer.stderr)

    def test_what_users_did_is_repeated_with_the_same_hashes(self):
        run = self.start_paused("--ticks", 200, "--output", "first")
        self.control("step", 7)
        self.control("move", "fb_0", "1.5,1.3,0,0,0,91.23456789")
        self.control("step", 40)
        self.control("move", "fb_1", "2.5,1.3,0")
        self.control("move", "fb_1", "2.4,1.2,0")
        self.control("step", 60)
        self.control("stop")
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        final = self.assert_finished(run, 107)
        self.assertRegex(run.stderr, rf"(?m)^{pwd.getpwuid(os.geteuid()).pw_name}@{socket.gethostname()}:\d+: stopped at tick 107$")
        events = (self.folder / "first" / "events.csv").read_text()
        self.assertRegex(events, r"\n47,move,fb_1,2.5 1.3 0,[^,]+@[^,]+:\d+,\d+,[^,]+Z,[0-9a-f]{8}\n47,move,fb_1,2.4 1.2 0,")
        hashes = (self.folder / "hashes").read_text()
        for options in ([], ["--single-process"], ["--controller-hosts", 2]):
            again = self.run_it("run", DIFFUSION, "--ticks", 200, "--quiet", "--no-visualisers", "--hash-log", "again", "--events",
                                "first/events.csv", *options)
            self.assertEqual(again.process.returncode, 0, again.stderr)
            self.assertEqual(self.assert_finished(again, 107), final)
            self.assertEqual((self.folder / "again").read_text(), hashes)


@unittest.skipUnless(os.geteuid() == 0 and shutil.which("ip"), "needs root and ip")
class AcrossNetworks(LauncherTest):
    def ip(self, *words):
        subprocess.run(["ip", *words], check=True, capture_output=True)

    def test_from_another_network_namespace(self):
        space = f"swarm{os.getpid() % 10000}"
        here, there = f"sw{os.getpid() % 10000}a", f"sw{os.getpid() % 10000}b"
        try:
            self.ip("netns", "add", space)
        except subprocess.CalledProcessError:
            self.skipTest("network namespaces cannot be made here")
        self.addCleanup(lambda: subprocess.run(["ip", "netns", "del", space], capture_output=True))
        self.ip("link", "add", here, "type", "veth", "peer", "name", there, "netns", space)
        self.ip("addr", "add", "10.77.3.1/24", "dev", here)
        self.ip("link", "set", here, "up")
        for words in (["addr", "add", "10.77.3.2/24", "dev", there], ["link", "set", there, "up"], ["link", "set", "lo", "up"]):
            self.ip("-n", space, *words)
        hosts = self.folder / "hosts"
        hosts.write_text(f"options = --interface {here}\n")
        run = self.start("run", DIFFUSION, "--quiet", "--ticks", 0, "--real-time", 2, "--hosts", hosts, "--no-visualisers",
                         "--hash-log", "hashes")
        self.wait_for_tick("hashes", 5, run)
        watcher = subprocess.Popen(["ip", "netns", "exec", space, os.environ["SWARMANOID"], "attach", "text", "--interface", there,
                                    "--file", str(self.folder / "far"), "--entities", "footbot"], stderr=subprocess.PIPE, text=True)
        # One that outlives a test that failed would hold the output that ctest waits for.
        self.addCleanup(end, watcher)
        self.wait_until("the table of the other network", lambda: self.has_table("far"))
        end(watcher)
        run.process.send_signal(signal.SIGINT)
        self.assertEqual(run.wait(GENEROUS_S), 130, run.stderr)
