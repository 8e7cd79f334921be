#!/usr/bin/env python3
"""readme_test.py SOURCE BUILD: runs the commands that README.md shows, in a checkout of links, and compares what the page says of them. Those that
build or install are for other tests; a command that is neither run here nor named so is a mistake."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
README = (SOURCE / "README.md").read_text()
# build_framework builds; the others of these it stands for are run below. The editor, which waits for a browser, is run by tests/web.
NOT_RUN = {"build/bin/swarmanoid edit configs/prey_retrieval.xml", "./build_framework run", "./build_framework test", "./build_framework package", "./build_framework user NAME"}
LOOKING = re.compile(r"^build/bin/swarmanoid attach (\w+)")


def commands():
    lines = re.findall(r"^    (\./build_framework .*|build/bin/.*)$", README, re.MULTILINE)
    return [line.split(" #")[0].strip() for line in lines]


class Readme(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)
        (self.folder / "build").symlink_to(BUILD)
        (self.folder / "configs").symlink_to(SOURCE / "configs")
        self.environment = {**os.environ, "SWARMANOID_SHARED_FOLDER": f"/dev/shm/swarmanoid-test-{os.getpid()}"}

    def tearDown(self):
        shutil.rmtree(self.environment["SWARMANOID_SHARED_FOLDER"], ignore_errors=True)
        self.scratch.cleanup()

    def run_it(self, command, **options):
        return subprocess.run(command, shell=True, cwd=self.folder, env=self.environment, capture_output=True, text=True, check=False,
                              timeout=100, **options)

    def test_the_sample_ends_with_the_hash_of_the_page(self):
        shown = re.search(r"^    finished: (\d+) ticks, (\d+) entities, hash ([0-9a-f]{16})", README, re.MULTILINE).groups()
        said = self.run_it("build/bin/swarmanoid run configs/prey_retrieval.xml --quiet").stdout
        self.assertEqual(re.search(r"finished: (\d+) ticks, (\d+) entities, hash ([0-9a-f]{16})", said).groups(), shown)

    def test_each_command_of_the_page_works(self):
        others = [command for command in commands() if command not in NOT_RUN]
        self.assertGreater(len(others), 3)
        runs = [command for command in others if not LOOKING.match(command)]
        for command in runs:
            if "--real-time" in command or command.endswith("doctor"):
                continue
            with self.subTest(command):
                done = self.run_it(command)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

        slow = next(command for command in runs if "--real-time" in command)
        with subprocess.Popen("exec " + slow + " --quiet", shell=True, cwd=self.folder, env=self.environment) as run:
            while "diffusion_10 " not in self.run_it("build/bin/swarmanoid list experiments").stdout:
                self.assertIsNone(run.poll(), "the run ended before it was looked at")
            for command in filter(LOOKING.match, others):
                with self.subTest(command):
                    self.look_on(command)
            run.send_signal(signal.SIGINT)

    def look_on(self, command):
        kind = LOOKING.match(command).group(1)
        if kind == "opengl" and "DISPLAY" not in os.environ:
            return
        if not (BUILD / "lib" / "swarmanoid" / f"libswarmanoid_{kind}_render.so").exists() and kind != "text":
            return
        said = self.run_it("timeout --preserve-status --signal=INT 4 " + command)
        self.assertIn(said.returncode, (0, 130), said.stdout + said.stderr)
        if kind == "text":
            self.assertIn("Footbot", said.stdout)
        if kind == "web":
            self.assertIn("http://127.0.0.1:", said.stdout)
        if "--video" in command:
            self.assertGreater((self.folder / command.split("--video ")[1]).stat().st_size, 1000)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
