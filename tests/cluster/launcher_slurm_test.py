#!/usr/bin/env python3
"""A cluster as one job of Slurm: the launcher runs in the job, and has srun start each process as a step of it."""
import os
import pathlib
import signal
import subprocess

from harness import CONFIGS, GENEROUS_S, REPLACED, SWARMANOID, LauncherTest, children_of, words_of
import slurm
from slurm import NODE

setUpModule = slurm.require

EXPERIMENT = CONFIGS / "crowd_in_regions.xml"
STEP = "srun --overlap --quiet --nodes=1 --ntasks=1 --nodelist={host} {command}"


class OneJob(LauncherTest):
    @classmethod
    def setUpClass(cls):
        cls.top, cls.slurm = slurm.running_for(cls)

    def job(self, ticks, *options):
        """salloc waits for the job, and ends it with the command."""
        (self.folder / "hosts.txt").write_text(f"command = {STEP}\noptions = --interface lo\nengine = {NODE}\ncontroller_host = {NODE}\n")
        return subprocess.Popen(["salloc", "--quiet", "--ntasks=4", SWARMANOID, "run", EXPERIMENT, "--hosts", "hosts.txt", "--ticks", str(ticks),
                                 "--output", "out", "--hash-log", "cluster", *options],
                                cwd=self.folder, env={**os.environ, **self.slurm.environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                start_new_session=True)

    def steps(self, *words):
        """Processes that srun started: their parents are Slurm's."""
        found = []
        for entry in os.listdir("/proc"):
            line = words_of(entry) if entry.isdigit() else []
            if line and os.path.basename(line[0]) in ("engine_worker", "controller_host") and " ".join(words) in " ".join(line):
                parent = int(pathlib.Path(f"/proc/{entry}/stat").read_text().rsplit(")", 1)[1].split()[1])
                if words_of(parent)[:1] and words_of(parent)[0].startswith("slurmstepd"):
                    found.append(int(entry))
        return found

    def assert_same(self, run, ticks, said):
        self.assertEqual(run.returncode, 0, said)
        one = self.run_it("run", EXPERIMENT, "--ticks", ticks, "--single-process", "--quiet", "--hash-log", "one", "--output", "one_out")
        self.assertEqual(one.process.returncode, 0, one.stderr)
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        self.wait_until("the end of all steps", lambda: not self.steps("crowd_in_regions"))
        self.wait_until("the end of the job", lambda: not self.slurm.live())

    def test_regions_and_hosts_are_steps(self):
        run = self.job(300)
        steps = []
        self.wait_until("six steps", lambda: steps.append(len(self.steps("crowd_in_regions"))) or steps[-1] == 6 or run.poll() is not None)
        said, _ = run.communicate(timeout=GENEROUS_S)
        self.assertEqual(max(steps), 6, said)
        self.assert_same(run, 300, said)

    def test_a_step_that_dies_is_replaced(self):
        run = self.job(300, "--real-time", "20")
        found = []
        self.wait_until("the first ticks", lambda: (self.folder / "cluster").exists() and (self.folder / "cluster").read_text().count("\n") > 20)
        self.wait_until("a region", lambda: found.extend(self.steps("--region 2")) or found)
        os.kill(found[0], signal.SIGKILL)
        said, _ = run.communicate(timeout=2 * GENEROUS_S)
        self.assertIn("region 2 of engine 'ground'", said)
        self.assertIn(REPLACED, said)
        self.assert_same(run, 300, said)

    def test_an_interrupt_ends_all_steps(self):
        run = self.job(0, "--real-time", "1")
        self.wait_until("six steps", lambda: len(self.steps("crowd_in_regions")) == 6)
        self.wait_until("the first ticks", lambda: (self.folder / "cluster").exists() and (self.folder / "cluster").read_text())
        os.kill(children_of(run.pid)[0], signal.SIGINT)
        said, _ = run.communicate(timeout=GENEROUS_S)
        self.assertIn("stopping", said)
        self.wait_until("the end of all steps", lambda: not self.steps("crowd_in_regions"))
        self.wait_until("the end of the job", lambda: not self.slurm.live())
