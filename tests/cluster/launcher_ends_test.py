"""How runs end as they should: last line, exit codes, Ctrl-C, run folders, full disks, runs side by side."""
import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import time

from harness import CONFIGS, GENEROUS_S, SWARMANOID, LauncherTest

EXPERIMENT = CONFIGS / "diffusion_10.xml"
NO_MANIFEST = r"cannot write '\S*/manifest.json': No space left on device"


class Ends(LauncherTest):
    def test_one_process_and_clusters_agree_and_keep_their_outputs(self):
        hashes = set()
        for number, options in enumerate([["--single-process"], [], ["--controller-hosts", 3], ["--placement", "spread"]]):
            out = f"out{number}"
            run = self.run_it("run", EXPERIMENT, "--ticks", 200, "--output", out, *options)
            self.assertEqual(run.process.returncode, 0, run.stderr)
            hashes.add(self.assert_finished(run, 200))
            self.assert_nothing_left(run)
            manifest = json.loads((self.folder / out / "manifest.json").read_text())
            self.assertEqual(manifest["exit_code"], 0)
            self.assertEqual(manifest["command"][1:], ["run", str(EXPERIMENT), "--ticks", "200", "--output", out, *map(str, options)])
            self.assertIn(manifest["state_hash"], hashes)
            # Ticks of 10 robots are too short for several threads. Threads of clusters are those of hosts.
            self.assertEqual("threads" in manifest, number == 0)
            self.assertEqual(manifest.get("shared_ticks", 0), 0)
            table = (self.folder / out / "positions.txt").read_text().splitlines()
            self.assertEqual(table[-1].split()[0], "200")
            effective = self.run_it("run", f"{out}/experiment.xml", "--single-process", "--quiet", "--output", out + "again")
            self.assertEqual(self.assert_finished(effective, 200), manifest["state_hash"])
        self.assertEqual(len(hashes), 1, hashes)

    def test_pages_show_what_runs_give(self):
        # Another hash than last time is a change for users: the page and the changelog have to tell it.
        for page, experiment in (("README.md", "prey_retrieval.xml"), ("docs/command.md", "prey_retrieval.xml"),
                                 ("docs/running_a_cluster.md", "diffusion_10.xml")):
            shown = re.search(r"finished: (\d+) ticks, \d+ entities, hash [0-9a-f]{16}",
                              (CONFIGS.parent / page).read_text())
            run = self.run_it("run", CONFIGS / experiment, "--single-process", "--no-visualisers", "--ticks", shown[1])
            self.assertIn(shown[0], run.stdout, page)

    def test_hash_options(self):
        run = self.run_it("run", EXPERIMENT, "--ticks", 50, "--quiet", "--hash-log", "hashes")
        last = self.assert_finished(run)
        lines = (self.folder / "hashes").read_text().splitlines()
        self.assertEqual(lines[-1], f"50 {last}")
        self.assertEqual(len(lines), 51)
        self.assertEqual(self.run_it("run", EXPERIMENT, "--ticks", 50, "--expect-hash", last).process.returncode, 0)
        other = self.run_it("run", EXPERIMENT, "--ticks", 50, "--quiet", "--expect-hash", "12")
        self.assertEqual(other.process.returncode, 5)
        self.assertIn(f"expected 0000000000000012, got {last}", other.stderr)
        self.assertEqual(self.assert_finished(other), last)

    def test_options_change_the_experiment(self):
        first = self.assert_finished(self.run_it("run", EXPERIMENT, "--ticks", 20, "--quiet"), 20)
        seeded = self.assert_finished(self.run_it("run", EXPERIMENT, "--ticks", 20, "--quiet", "--seed", 2), 20)
        self.assertNotEqual(first, seeded)
        run = self.run_it("run", EXPERIMENT, "--set", "framework.maxclock=7", "--quiet", "--no-visualisers", "--output", "out")
        self.assert_finished(run, 7)
        self.assertFalse((self.folder / "out" / "positions.txt").exists())

    def test_a_real_time_factor_holds(self):
        started = time.monotonic()
        self.assert_finished(self.run_it("run", EXPERIMENT, "--ticks", 100, "--real-time", 5, "--quiet"), 100)
        self.assertGreater(time.monotonic() - started, 2.0)

    def test_usage_and_invalid_files(self):
        self.assertEqual(self.run_it("run").process.returncode, 2)
        self.assertEqual(self.run_it("runn").process.returncode, 2)
        self.assertEqual(self.run_it("run", EXPERIMENT, "--expect-hash", "xyz").process.returncode, 2)
        self.assertEqual(self.run_it("run", EXPERIMENT, "--domain", 233).process.returncode, 2)
        self.assertEqual(self.run_it("run", EXPERIMENT, "--single-process", "--paused").process.returncode, 2)
        broken = self.folder / "broken.xml"
        broken.write_text(EXPERIMENT.read_text().replace("<maxclock>1000</maxclock>", "<maxclok>1000</maxclok>")
                          .replace('<subclock>1</subclock>', '<subclock>zero</subclock>'))
        run = self.run_it("run", broken)
        self.assertEqual(run.process.returncode, 3)
        self.assertIn("maxclok", run.stderr)
        self.assertIn("zero", run.stderr)
        self.assertIn("2 errors", run.stderr)
        broken.write_text(EXPERIMENT.read_text().replace('<subclock>1</subclock>', '<subclock>zero</subclock>'))
        self.assertRegex(self.run_it("run", broken).stderr, r"broken\.xml: 1 error\n")


class FailedExperiments(LauncherTest):
    def test_the_reason_of_the_functions_is_shown_and_kept(self):
        expected = "the experiment failed by its own measure: experiment functions 'goal' say: no prey is in the nest at the last tick"
        for output, options in (("cluster", []), ("one", ["--single-process"])):
            run = self.run_it("run", CONFIGS / "prey_retrieval.xml", "--ticks", 20, "--no-visualisers", "--output", output, *options)
            self.assertEqual(run.process.returncode, 1, run.stderr)
            self.assertIn(expected, run.stderr)
            self.assertEqual(json.loads((self.folder / output / "manifest.json").read_text())["failure"], expected)


class Interrupts(LauncherTest):
    def test_once_keeps_a_whole_result(self):
        for options in ([], ["--single-process"]):
            with self.subTest(options):
                out = "out" + str(len(options))
                run = self.start("run", EXPERIMENT, "--ticks", 0, "--quiet", "--real-time", 100, "--hash-log", out + ".hashes",
                                 "--output", out, *options)
                self.wait_for_tick(out + ".hashes", 50, run)
                run.process.send_signal(signal.SIGINT)
                self.assertEqual(run.wait(), 130, run.stderr)
                last = self.assert_finished(run)
                log = (self.folder / (out + ".hashes")).read_text().splitlines()
                self.assertEqual(log[-1].split()[1], last)
                table = (self.folder / out / "positions.txt").read_text()
                self.assertTrue(table.endswith("\n"))
                self.assertEqual(table.splitlines()[-1].split()[0], log[-1].split()[0])
                self.assertEqual(json.loads((self.folder / out / "manifest.json").read_text())["exit_code"], 130)
                self.assert_nothing_left(run)

    def test_while_it_starts_and_while_it_is_paused(self):
        run = self.start("run", EXPERIMENT, "--quiet")
        run.find("space_server")
        run.process.send_signal(signal.SIGINT)
        self.assertEqual(run.wait(GENEROUS_S), 130, run.stderr)
        run = self.start("run", EXPERIMENT, "--quiet", "--paused")
        self.wait_until("the pause", lambda: "paused at tick 0" in self.run_it("control", "pause").stdout)
        run.process.send_signal(signal.SIGINT)
        self.assertEqual(run.wait(GENEROUS_S), 130, run.stderr)
        self.assert_finished(run, 0)
        self.assert_nothing_left(run)

    def test_sigterm_ends_a_run(self):
        run = self.start("run", EXPERIMENT, "--ticks", 0, "--quiet", "--hash-log", "hashes")
        self.wait_for_tick("hashes", 50, run)
        run.process.terminate()
        self.assertEqual(run.wait(GENEROUS_S), 130, run.stderr)
        self.assert_nothing_left(run)

    def test_a_reader_of_the_screen_that_leaves_ends_the_run(self):
        experiment = self.folder / "screen.xml"
        experiment.write_text(EXPERIMENT.read_text().replace("<file>positions.txt</file>", ""))
        run = self.start("run", experiment, "--ticks", 0, "--quiet")
        self.assertIn("Footbot", "".join(run.process.stdout.readline() for _ in range(20)))
        run.process.stdout.close()
        run.process.stdout = None
        self.assertEqual(run.wait(GENEROUS_S), 130, run.stderr)
        self.assert_nothing_left(run)

    def test_errors_without_a_reader_are_kept_in_the_manifest(self):
        # A terminal that is gone, or a log on a full disk: each write fails.
        experiment = self.write_faulty("step_throws", 5)
        for output, options in (("cluster", ["--quiet"]), ("one", ["--single-process"])):
            with open("/dev/full", "w") as full:
                done = subprocess.run([SWARMANOID, "run", experiment, "--output", output, *options], cwd=self.folder,
                                      stdout=subprocess.DEVNULL, stderr=full, check=False)
            manifest = json.loads((self.folder / output / "manifest.json").read_text())
            self.assertEqual((done.returncode, manifest["exit_code"]), (4, 4), options)
            self.assertIn("cannot go on", manifest["failure"])


class Folders(LauncherTest):
    def test_an_old_run_is_not_written_over(self):
        self.run_it("run", EXPERIMENT, "--ticks", 5, "--output", "out")
        run = self.run_it("run", EXPERIMENT, "--ticks", 5, "--output", "out")
        self.assertEqual(run.process.returncode, 2)
        self.assertIn("not empty", run.stderr)

    def mount(self, options):
        if os.geteuid() != 0:
            self.skipTest("mounting needs root")
        place = self.folder / "disk"
        place.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", options, "none", place], stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("mounting is not allowed here")
        self.mounts.append(place)
        return place

    def test_a_read_only_folder_is_told_with_the_cure(self):
        self.mount("ro,size=1m")
        run = self.run_it("run", EXPERIMENT, "--output", "disk/out")
        self.assertEqual(run.process.returncode, 2)
        self.assertIn("'disk/out': Read-only file system", run.stderr)
        self.assertIn("--output", run.stderr)

    def test_a_full_disk_ends_the_run_and_is_named(self):
        for options in ([], ["--single-process"]):
            place = self.mount("size=256k") if not options else self.folder / "disk"
            for path in place.glob("*"):
                subprocess.run(["rm", "-r", path])
            run = self.run_it("run", EXPERIMENT, "--ticks", 100000, "--quiet", "--output", "disk/out", *options)
            self.assertEqual(run.process.returncode, 4, run.stderr)
            self.assertIn("No space left on device", run.stderr)
            self.assert_nothing_left(run)

    def test_a_disk_that_is_full_before_the_manifest_is_named(self):
        disk = self.mount("size=1m")
        for options in ([], ["--single-process"]):
            self.leave_pages(disk, 1)  # for experiment.xml
            run = self.run_it("run", EXPERIMENT, "--ticks", 50, "--quiet", "--no-visualisers", "--output", "disk/out", *options)
            self.assertEqual(run.process.returncode, 2, run.stderr)
            self.assertRegex(run.stderr, NO_MANIFEST)
            self.assertEqual(os.listdir(disk / "out"), ["experiment.xml"])
            self.assert_nothing_left(run)
            shutil.rmtree(disk / "out")

    def test_a_run_whose_last_manifest_a_full_disk_does_not_take_fails_with_its_result(self):
        disk = self.mount("size=1m")
        cluster = self.start("run", EXPERIMENT, "--ticks", 50, "--paused", "--quiet", "--no-visualisers", "--no-journal", "--output", "disk/cluster")
        self.wait_for_experiment("diffusion_10")
        self.control("step", 5)  # from here on the log of events has its page
        self.leave_pages(disk, 0)
        self.control("resume")
        cluster.wait()
        self.leave_pages(disk, 2)  # for experiment.xml and the first manifest
        single = self.run_it("run", EXPERIMENT, "--ticks", 50, "--quiet", "--no-visualisers", "--single-process", "--output", "disk/single")
        for run, out in ((cluster, disk / "cluster"), (single, disk / "single")):
            self.assertEqual(run.process.returncode, 4, run.stderr)
            self.assertRegex(run.stderr, NO_MANIFEST)
            self.assert_finished(run, 50)
            self.assertNotIn("exit_code", json.loads((out / "manifest.json").read_text()), "the first manifest is kept")
            self.assertFalse((out / "manifest.json.new").exists())
            self.assert_nothing_left(run)

    def leave_pages(self, disk, count):
        """Fills a disk but for so many pages, each of which takes a small file."""
        filler = disk / "filler"
        with filler.open("ab", buffering=0) as file, contextlib.suppress(OSError):
            while file.write(bytes(os.sysconf("SC_PAGESIZE"))):
                pass
        os.truncate(filler, filler.stat().st_size - count * os.sysconf("SC_PAGESIZE"))


class SideBySide(LauncherTest):
    def test_two_of_one_name_do_not_disturb_each_other(self):
        alone = self.assert_finished(self.run_it("run", EXPERIMENT, "--ticks", 2000, "--quiet"), 2000)
        before = set((self.folder / "runs").iterdir())
        runs = [self.start("run", EXPERIMENT, "--ticks", 2000, "--quiet") for _ in range(2)]
        for run in runs:
            self.assertEqual(run.wait(), 0, run.stderr)
            self.assertEqual(self.assert_finished(run, 2000), alone)
        self.assert_nothing_left(runs[0])
        folders = set((self.folder / "runs").iterdir()) - before
        self.assertEqual(len(folders), 2)
        # Of one name in one domain they would hear each other.
        domains = {json.loads((folder / "manifest.json").read_text())["domain"] for folder in folders}
        self.assertEqual(len(domains), 2)
