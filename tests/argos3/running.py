"""What tests of experiments in ARGoS3's XML share: a folder for each, and `swarmanoid` in it."""
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent


class RunningTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def swarmanoid(self, *words, code=0):
        result = subprocess.run([os.environ["SWARMANOID"], *map(str, words)], cwd=self.folder, text=True,
                                capture_output=True)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result

    def hash_of(self, *words):
        return re.search(r"hash ([0-9a-f]{16})", self.swarmanoid("run", *words).stdout).group(1)

    def changed(self, name, *changes):
        text = (HERE / name).read_text()
        for before, after in changes:
            self.assertEqual(text.count(before), 1, before)
            text = text.replace(before, after)
        file = self.folder / name
        file.write_text(text)
        return file

    def said_in(self, folder):
        logs = [*(self.folder / folder).glob("swarmanoid.log"), *(self.folder / folder).glob("controller_host*.log")]
        return "".join(log.read_text() for log in logs)
