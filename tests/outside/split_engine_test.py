"""An engine of a stranger that can be split: its regions are processes that know what the engine tells them alone, and no bit of the
results depends on them."""
import os
import pathlib
import signal
import subprocess
import time

from outside import PREFIX, WAYS, OutsideTest


class SplitEngine(OutsideTest):
    def meeting(self, split, ticks=200):
        others = [f"robot_{k}" for k in range(7)]
        arena = "".join(f'<footbot id="{name}"><position>{0.5 + 0.37 * k},{0.3 + 0.4 * k},0</position><orientation>0,0,0</orientation>'
                        f"<controller>c</controller></footbot>" for k, name in enumerate(others))
        file = self.experiment(f"meeting_{split}", ticks=ticks, arena=arena, entities=" ".join(others))
        text = file.read_text()
        start, end = text.index("<dummy_engine"), text.index("</dummy_engine>") + len("</dummy_engine>")
        file.write_text(text[:start] + f'<meeting_engine id="ground" library="meeting_engine" split="{split}"/>' + text[end:])
        return file

    def test_it_gives_the_same_however_it_is_split(self):
        expected = self.hash_of(self.run_experiment(self.meeting(1), "--single-process"))
        for split in (1, 2, 3, 8):
            for way, options in WAYS.items():
                with self.subTest(split=split, way=way):
                    self.assertEqual(self.hash_of(self.run_experiment(self.meeting(split), *options)), expected)

    def test_a_region_that_dies_is_replaced(self):
        file = self.meeting(3, ticks=10000)
        expected = self.hash_of(self.run_experiment(file, "--single-process"))
        run = subprocess.Popen([str(PREFIX / "bin" / "swarmanoid"), "run", file, "--real-time", "100"], cwd=self.folder, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=self.environment())
        self.addCleanup(lambda: run.poll() is None and run.terminate())
        deadline = time.monotonic() + 60
        while not (region := self.region_that_works(run.pid)):
            self.assertLess(time.monotonic(), deadline, "no region works")
            time.sleep(0.05)
        os.kill(region, signal.SIGKILL)
        stdout, stderr = run.communicate(timeout=120)
        self.assertIn("region 1 of engine 'ground'", stderr)
        self.assertIn("another process takes its place", stderr)
        self.assertIn(expected, stdout)
        self.assertEqual(run.returncode, 0, stderr)

    @staticmethod
    def region_that_works(launcher):
        """Region 1 of the run, once it has taken more of a processor than its start does."""
        parents, regions = {}, []
        for entry in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                words = (entry / "cmdline").read_bytes().decode().split("\0")
                stat = (entry / "stat").read_text().rsplit(")", 1)[1].split()
            except OSError:
                continue
            pid = int(entry.name)
            parents[pid] = int(stat[1])
            if "--region" in words and words[words.index("--region") + 1] == "1" and int(stat[11]) + int(stat[12]) > 20:
                regions.append(pid)
        # Its parent is the launcher, or that of a process that stands between.
        return next((pid for pid in regions if launcher in (parents.get(pid), parents.get(parents.get(pid)))), None)
