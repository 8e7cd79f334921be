"""What tests of studies share: a folder, the command, the table and the database."""
import csv
import os
import pathlib
import sqlite3
import subprocess
import tempfile
import time

from world.case import FolderCase

SWARMANOID = os.environ["SWARMANOID"]
CONFIGS = pathlib.Path(os.environ["SWARMANOID_CONFIGS"])
LIMIT_S = 550


class StudyCase(FolderCase):
    def setUp(self):
        super().setUp()
        self.environment = self.variables

    def command(self, *words, code=0):
        done = subprocess.run([SWARMANOID, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=LIMIT_S,
                              env=self.environment)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def table(self, name):
        with open(self.folder / name / "table.csv", newline="") as file:
            return list(csv.DictReader(file))

    def query(self, name, query):
        # One that is not there yet is not to be made, which would keep the study from its folder. What a killed process left is to be mended.
        database = sqlite3.connect(f"file:{self.folder / name / 'study.sqlite'}?mode=rw", uri=True, timeout=60)
        try:
            return database.execute(query).fetchall()
        finally:
            database.close()


class StartedStudyCase(StudyCase):
    """Of studies that go on while the test watches or disturbs them."""
    def study(self, seeds, ticks=60, inside='<metrics every="20"><distance id="way"/></metrics>', experiment=CONFIGS / "diffusion_10.xml", attributes=""):
        path = self.folder / "study.xml"
        path.write_text(f'<study experiment="{experiment}" ticks="{ticks}" seeds="{seeds}" {attributes}>\n{inside}\n</study>\n')
        return path

    def start(self, *words):
        with tempfile.NamedTemporaryFile("w", dir=self.folder, prefix="said_", delete=False) as said:
            process = subprocess.Popen([SWARMANOID, "sweep", *map(str, words), "--quiet"], cwd=self.folder, stdout=subprocess.PIPE, stderr=said,
                                       text=True, env=self.environment)
        process.said = pathlib.Path(said.name)
        self.addCleanup(lambda: (process.kill(), process.wait(), process.stdout.close()))
        return process

    def end_of(self, process, code=0):
        out, _ = process.communicate(timeout=LIMIT_S)
        errors = process.said.read_text()
        self.assertEqual(process.returncode, code, out + errors)
        return out, errors

    def sweep(self, *words, code=0):
        return self.end_of(self.start(*words), code)

    def here(self, study):
        """The table that it has on this machine alone."""
        self.sweep(study, "--output", "here")
        return (self.folder / "here/table.csv").read_bytes()

    def wait_until(self, what, condition):
        deadline = time.monotonic() + LIMIT_S
        while not condition():
            self.assertLess(time.monotonic(), deadline, "in vain for " + what)
            time.sleep(0.02)

    def done_in(self, name, at="%"):
        """How many runs are done, or those on machines whose name is like `at`."""
        if not (self.folder / name / "study.sqlite").exists():
            return 0
        return self.query(name, f"SELECT COUNT(*) FROM runs WHERE state = 'done' AND host LIKE '{at}'")[0][0]

    def wait_for_runs(self, name, at_least, process, at="%"):
        self.wait_until("runs", lambda: process.poll() is not None or self.done_in(name, at) >= at_least)
        self.assertIsNone(process.poll(), "it ended early")
