"""What tests of experiments in ARGoS3's XML share: a folder for each, and `swarmanoid` in it."""
import os
import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent
from world.case import FolderCase


class RunningTest(FolderCase):
    def swarmanoid(self, *words, code=0):
        result = subprocess.run([os.environ["SWARMANOID"], *map(str, words)], cwd=self.folder, text=True,
                                capture_output=True)
        if code is not None:
            self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result

    def hash_of(self, *words):
        return self.hash_in(self.swarmanoid("run", *words).stdout)

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
