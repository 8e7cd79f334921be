"""Studies by Slurm, which runs on this machine."""
import os
import re
import signal
import subprocess

import slurm
from study_case import StartedStudyCase

setUpModule = slurm.require

FINISHED = re.compile(r"^finished: (\d+) runs, (\d+) failed, [0-9.]+ s, table (\S+)$", re.MULTILINE)


class SweepSlurm(StartedStudyCase):
    @classmethod
    def setUpClass(cls):
        cls.top, cls.slurm = slurm.running_for(cls)

    def setUp(self):
        self.folder = self.top / self.id().rsplit(".", 1)[1]
        self.folder.mkdir()
        self.environment = {**os.environ, **self.slurm.environment}

    def tearDown(self):
        self.slurm.release()  # a case that fails leaves it held
        for job in self.slurm.live():
            self.slurm.ask("scancel", job)
        self.wait_until("an empty queue", lambda: not self.slurm.live())

    def assert_same(self, name, table):
        self.assertEqual((self.folder / name / "table.csv").read_bytes(), table)
        self.assertFalse((self.folder / name / "slurm").exists(), "nothing of the jobs stays")

    def test_the_table_is_that_of_this_machine(self):
        study = self.study("1-12", inside='<factor id="robots" path="arena.distribute.quantity" values="4 8"/>'
                           '<metrics every="20"><distance id="way"/><trajectories id="ways"/></metrics>')
        table = self.here(study)
        out, errors = self.sweep(study, "--output", "out", "--slurm", "--partition=short --time=10 --comment='two words'", "--runs-per-task", "5")
        self.assertEqual(FINISHED.search(out).groups(), ("24", "0", "out/table.csv"))
        job, runs, tasks = re.search(r"^job (\d+) of Slurm: (\d+) runs in (\d+) tasks$", errors, re.MULTILINE).groups()
        self.assertEqual((runs, tasks), ("24", "5"))
        self.assert_same("out", table)
        self.assertEqual(self.query("out", "SELECT * FROM ways ORDER BY point, seed"), self.query("here", "SELECT * FROM ways ORDER BY point, seed"))
        shown = self.slurm.ask("scontrol", "show", "job", job)
        self.assertIn("Comment=two words", shown)
        self.assertIn("TimeLimit=00:10:00", shown)

    def test_jobs_go_on_without_the_command(self):
        study = self.study("1-24", ticks=3000)
        table = self.here(study)
        for number, end_by in enumerate((signal.SIGKILL, signal.SIGHUP, signal.SIGTERM)):
            name = f"out{number}"
            # One task at a time, so that there are others when the first has runs.
            process = self.start(study, "--output", name, "--slurm", "", "--runs-per-task", "3", "--jobs", "1")
            self.wait_for_runs(name, 1, process)
            self.slurm.hold()
            process.send_signal(end_by)
            process.communicate()
            self.assertTrue(self.slurm.live(), "it was too quick")
            if number == 0:
                _, errors = self.sweep(name, "--resume", code=2)
                self.assertRegex(errors, r"the study's jobs \d+ of Slurm go on: go on with --slurm, too, or end them by: scancel \d+")
            self.slurm.release()
            if number < 2:
                _, errors = self.sweep(name, "--resume", "--slurm", "")
                self.assertNotIn("tasks", errors, "nothing is submitted a second time")
            else:
                self.wait_until("the end of the jobs", lambda: not self.slurm.live())
                self.sweep(name, "--resume")
            self.assert_same(name, table)
            self.assertEqual(self.query(name, "SELECT DISTINCT attempts FROM runs"), [(1,)], "each was run once")

    def test_ctrl_c_cancels(self):
        study = self.study("1-20", ticks=3000)
        process = self.start(study, "--output", "out", "--slurm", "--comment=mine", "--runs-per-task", "2")
        self.wait_for_runs("out", 2, process)
        self.slurm.hold()
        process.send_signal(signal.SIGINT)
        _, errors = self.end_of(process, 130)
        self.slurm.release()
        self.assertRegex(errors, r"(?m)^job \d+ of Slurm is cancelled$")
        told = re.search(r"^(\d+) of 20 runs are done; to go on: swarmanoid sweep out --resume --slurm --comment=mine$", errors, re.MULTILINE)
        self.assertTrue(told, errors)
        self.assertEqual(self.done_in("out"), int(told[1]))
        self.assertEqual(self.slurm.live(), [])
        self.assertEqual(self.slurm.workers(), [])
        self.sweep("out", "--resume", "--slurm", "", "--jobs", "2")
        self.assertEqual((self.folder / "out/table.csv").read_bytes(), self.here(study))

    def test_a_cancelled_task_is_told_and_run_again_as_asked(self):
        study = self.study("1-12", ticks=6000)
        table = self.here(study)
        for name, retries in (("out", 0), ("again", 1)):
            process = self.start(study, "--output", name, "--slurm", "", "--runs-per-task", "3", "--jobs", "1", "--retries", retries)
            self.wait_for_runs(name, 1, process)
            task = next(task for task in self.slurm.live() if task.endswith("_3"))
            self.slurm.ask("scancel", task)
            out, errors = self.end_of(process, 0 if retries else 4)
            told = re.findall(rf"^run 0-(\d+) failed with exit code 4: Slurm's task {task} ended before it had a result \(CANCELLED", errors, re.MULTILINE)
            self.assertEqual(sorted(map(int, told)), [10, 11, 12], errors)
            self.assertEqual(FINISHED.search(out)[2], "0" if retries else "3")
            if not retries:
                self.sweep("out", "--resume", "--slurm", "", "--retries", "1")
            self.assert_same(name, table)

    def test_a_task_that_dies_keeps_what_it_had(self):
        study = self.study("1-6", ticks=30000)
        table = self.here(study)
        process = self.start(study, "--output", "out", "--slurm", "", "--runs-per-task", "6", "--retries", "1")
        # Before the command asks for them. What is being written has an ending.
        self.wait_until("results", lambda: len([path for path in self.folder.glob("out/slurm/*/results/*") if not path.suffix]) >= 2)
        for pid in self.slurm.workers():
            os.kill(pid, signal.SIGKILL)
        _, errors = self.end_of(process)
        told = re.findall(r"^run 0-\d+ failed with exit code 4: Slurm's task \d+_0 ended before it had a result \(FAILED on \S+\)", errors, re.MULTILINE)
        self.assertIn(len(told), range(1, 5), errors)
        self.assert_same("out", table)
        self.assertEqual(sorted(row for row, in self.query("out", "SELECT attempts FROM runs")), [1] * (6 - len(told)) + [2] * len(told))

    def test_a_silent_slurm_is_waited_for(self):
        study = self.study("1-20", ticks=6000)
        process = self.start(study, "--output", "out", "--slurm", "", "--runs-per-task", "5", "--jobs", "1")
        self.wait_for_runs("out", 1, process)
        self.slurm.processes["slurmctld"].terminate()
        self.slurm.processes["slurmctld"].wait(60)
        self.wait_until("runs that need no controller", lambda: self.done_in("out") >= 5)
        # Who asks waits long for an answer before that is told.
        self.wait_until("the word of it", lambda: "cannot be asked" in process.said.read_text())
        self.slurm.start("slurmctld", "-D")
        _, errors = self.end_of(process)
        self.assertEqual(len(re.findall(r"^Slurm cannot be asked about job \d+: .*; asked again until it answers$", errors, re.MULTILINE)), 1, errors)
        self.assert_same("out", self.here(study))

    def test_several_cores_of_a_task(self):
        study = self.study("1-8", ticks=600)
        self.sweep(study, "--output", "out", "--slurm", "--cpus-per-task=2", "--runs-per-task", "8")
        self.assert_same("out", self.here(study))

    def test_what_cannot_be_is_told(self):
        study = self.study("1-2")
        (self.folder / "hosts.txt").write_text("runs = alpha\n")
        for options, says in ((["--slurm", "", "--hosts", "hosts.txt"], "--hosts and --slurm: runs are either"),
                              (["--runs-per-task", "2"], "--runs-per-task: only Slurm has tasks"),
                              (["--slurm", "--array=1-3"], "--slurm: '--array=1-3' is given by the study itself; leave it out (--jobs N is the number of tasks"),
                              (["--slurm", "-o x"], "--slurm: '-o' is given by the study itself"),
                              (["--slurm", "--comment='two"], "--slurm: a quote is not closed")):
            _, errors = self.sweep(study, "--output", "none", *options, code=2)
            self.assertIn(says, errors)
            self.assertFalse((self.folder / "none").exists())
        _, errors = self.sweep(study, "--output", "out", "--slurm", "--partition=nowhere", code=4)
        self.assertRegex(errors, r"--slurm: sbatch: error: [^;]*invalid partition[^;]*; what was stored before stays: mend the cause, then go on: "
                         r"swarmanoid sweep out --resume --slurm --partition=nowhere")
        self.assertFalse((self.folder / "out/slurm").exists())
        self.environment["PATH"] = "/nowhere"
        _, errors = self.sweep("out", "--resume", "--slurm", "", code=4)
        self.assertIn("there is no command sbatch here", errors)

    def test_a_full_disk_keeps_what_was_stored(self):
        small = self.folder / "small"
        small.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=600k", "none", small], stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("no file system of limited size can be mounted here")
        self.addCleanup(subprocess.run, ["umount", "-l", small])
        study = self.study("1-40", inside='<metrics every="1"><distance id="way"/><trajectories id="ways"/></metrics>', ticks=600)
        _, errors = self.sweep(study, "--output", "small/out", "--slurm", "", "--runs-per-task", "20", code=4)
        self.assertRegex(errors, r"No space left on device|database or disk is full")
        subprocess.run(["mount", "-o", "remount,size=100m", small], check=True)
        self.wait_until("an empty queue", lambda: not self.slurm.live())
        out, _ = self.sweep("small/out", "--resume", "--slurm", "", "--retries", "3")
        self.assertEqual(FINISHED.search(out).groups()[:2], ("40", "0"))
        self.assertEqual((self.folder / "small/out/table.csv").read_bytes(), self.here(study))
