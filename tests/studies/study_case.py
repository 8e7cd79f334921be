"""What tests of studies share: a folder, the command, the table and the database."""
import csv
import os
import pathlib
import shutil
import sqlite3
import subprocess
import tempfile
import unittest

SWARMANOID = os.environ["SWARMANOID"]
CONFIGS = pathlib.Path(os.environ["SWARMANOID_CONFIGS"])
LIMIT_S = 250


class StudyCase(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="swarmanoid_study_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.environment = {**os.environ, "SWARMANOID_SHARED_FOLDER": str(self.folder)}

    def command(self, *words, code=0):
        done = subprocess.run([SWARMANOID, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=LIMIT_S,
                              env=self.environment)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def table(self, name):
        with open(self.folder / name / "table.csv", newline="") as file:
            return list(csv.DictReader(file))

    def query(self, name, query):
        # To read alone: one that is not there yet is not to be made, which would keep the study from its folder.
        database = sqlite3.connect(f"file:{self.folder / name / 'study.sqlite'}?mode=ro", uri=True, timeout=60)
        try:
            return database.execute(query).fetchall()
        finally:
            database.close()
