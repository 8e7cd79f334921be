"""A simulator of a user's own sees, prints and changes the same in one process and as a cluster, with the hash of the
command's own runs."""
import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import time

from failures_test import FAULTS, FAULTS_OF_CLUSTERS
from outside import BUILT, WAYS, OutsideTest

from signals import send_and_wait

TICKS = 20
WATCH = "the function that looks at each tick: Watch at tick 7"


class OwnSimulator(OutsideTest):
    def watched(self, file, *options, **more):
        return self.command(BUILT / "simulation", file, "--quiet", *options, **more)

    def seen_in(self, done):
        """What it printed, without the last line of the run, which tells times."""
        return re.sub(r"^finished: .*\n", "", done.stdout, flags=re.MULTILINE)

    def test_watch_is_called_alike(self):
        file = self.experiment(ticks=TICKS)
        runs = {way: self.watched(file, "--hash-log", self.folder / f"{way}.txt", *options) for way, options in WAYS.items()}
        hashes = {self.hash_of(done) for done in runs.values()} | {self.hash_of(self.run_experiment(file, "--single-process"))}
        self.assertEqual(len(hashes), 1, hashes)
        one, cluster = (self.seen_in(runs[way]) for way in WAYS)
        self.assertEqual(one, cluster)
        self.assertEqual(one.count("watch "), TICKS + 1)
        self.assertRegex(one, rf"watched {TICKS + 1} ticks, .* in one thread")
        self.assertEqual(*((self.folder / f"{way}.txt").read_text() for way in WAYS))

    def test_changes_count_alike(self):
        file = self.experiment(ticks=TICKS)
        change = {"OUTSIDE_CHANGES": "1"}
        runs = {way: self.watched(file, "--hash-log", self.folder / f"{way}.txt", *options, environment=change)
                for way, options in WAYS.items()}
        hashes = {way: self.hash_of(done) for way, done in runs.items()}
        self.assertEqual(len(set(hashes.values())), 1, hashes)
        self.assertNotIn(self.hash_of(self.run_experiment(file, "--single-process")), hashes.values())
        self.assertEqual(*(self.seen_in(done) for done in runs.values()))
        self.assertEqual(*((self.folder / f"{way}.txt").read_text() for way in WAYS))

    def failing(self, fault, way, *options):
        output = pathlib.Path(tempfile.mkdtemp(prefix="run_", dir=self.folder))
        done = self.watched(self.experiment(ticks=TICKS), "--output", output, *WAYS[way], *options,
                            environment={"OUTSIDE_FAULT": f"watch {fault} 7"})
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertNotIn("finished:", done.stdout)
        first = done.stderr.splitlines()[0]
        manifest = json.loads((output / "manifest.json").read_text())
        self.assertEqual([manifest["exit_code"], manifest["failure"]], [4, first])
        return done, first

    def test_whatever_it_does_the_run_ends_by_its_name(self):
        for way, options in WAYS.items():
            for fault in FAULTS if options else FAULTS_OF_CLUSTERS:
                with self.subTest(fault, way=way):
                    done, first = self.failing(fault, way, "--memory-limit", "640MiB")
                    self.assertRegex(first, "^" + re.escape(WATCH) + " " + FAULTS[fault])
                    if fault.startswith("throw"):
                        self.assertIn("watched 8 ticks", done.stdout, "the program goes on")

    def test_one_that_takes_too_long_ends_the_run(self):
        for way in WAYS:
            with self.subTest(way):
                _, first = self.failing("loop", way, "--step-timeout", "0.5")
                self.assertEqual(first, WATCH + " did not return within 0.5 s (--step-timeout)")

    def test_one_that_never_ends_is_named_and_can_be_ended(self):
        for way, options in WAYS.items():
            with self.subTest(way):
                output = self.folder / way
                run = subprocess.Popen([BUILT / "simulation", self.experiment(ticks=TICKS), "--output", output, *options],
                                       cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                       env=self.environment({"OUTSIDE_FAULT": "watch loop 7"}))
                said = ""
                while "waiting since" not in said:
                    line = run.stderr.readline()
                    self.assertNotEqual(line, "", said)
                    said += line
                self.assertIn(f"for {WATCH}\n", said)
                send_and_wait(run, signal.SIGINT)
                if way == "cluster":
                    while "Ctrl-C again" not in said:
                        said += run.stderr.readline()
                run.send_signal(signal.SIGINT)
                said = run.communicate(timeout=100)[1]
                self.assertIn(f"{WATCH} ", said)
                self.assertEqual(run.returncode, 130, said)
                self.assertEqual(json.loads((output / "manifest.json").read_text())["exit_code"], 130)

    def test_another_failure_meanwhile_stays_the_headline(self):
        """The function of the program does not return, and a process of its cluster dies."""
        output = self.folder / "run"
        run = subprocess.Popen([BUILT / "simulation", self.experiment(ticks=TICKS), "--output", output, "--quiet", "--no-recovery"],
                               cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               env=self.environment({"OUTSIDE_FAULT": "watch loop 7", "OUTSIDE_FAULT_MARK": str(self.folder / "stuck")}))
        while not (self.folder / "stuck").exists():
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        children = pathlib.Path(f"/proc/{run.pid}/task").glob("*/children")
        workers = [int(pid) for list_ in children for pid in list_.read_text().split()
                   if "engine_worker" in pathlib.Path(f"/proc/{pid}/cmdline").read_text()]
        self.assertEqual(len(workers), 1)
        os.kill(workers[0], signal.SIGKILL)
        said = run.communicate(timeout=100)[1].splitlines()
        self.assertRegex(said[0], r"^engine 'ground' was killed by signal 9 \(Killed\)")
        self.assertIn(f"{WATCH} does not return: this process ends without it", said)
        self.assertEqual(run.returncode, 4)
        manifest = json.loads((output / "manifest.json").read_text())
        self.assertEqual([manifest["exit_code"], manifest["failure"]], [4, said[0]])
