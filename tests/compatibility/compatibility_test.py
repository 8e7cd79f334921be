"""Files of released versions, one folder for each version, are read by this one: an archive, a journal, a checkpoint and a study. The
script `make` beside this file says what they are and makes them."""
import os
import pathlib
import shutil
import subprocess
import tarfile

from world.case import FolderCase

HERE = pathlib.Path(__file__).resolve().parent
VERSIONS = sorted(path for path in HERE.iterdir() if path.is_dir() and path.name[0].isdigit())
# `make` has the same folder.
STUDY_HOME = pathlib.Path("/tmp/swarmanoid_compatibility")
MOST_BYTES = 60_000


class Released(FolderCase):
    def go(self, *words, code=0):
        done = subprocess.run([os.environ["SWARMANOID"], *map(str, words)], cwd=self.folder, capture_output=True, text=True, env=self.variables)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout

    def each_version(self):
        self.assertTrue(VERSIONS)
        for version in VERSIONS:
            with self.subTest(version.name):
                yield version

    def unpack(self, file):
        with tarfile.open(file) as tar:
            tar.extractall(self.folder, filter="data")

    def test_archives_reproduce_each_state(self):
        for version in self.each_version():
            self.assertIn("equal: 201 states, from tick 0 to 200", self.go("reproduce", "--quiet", version / "run.tar.gz"))

    def test_journals_are_computed_again_with_equal_states(self):
        for version in self.each_version():
            self.unpack(version / "run.tar.gz")
            self.assertEqual(self.go("replay", "pair", "--verify"), "equal: 201 states, computed again\n")
            self.assertEqual(len(self.go("export", "pair", "--csv", "-").splitlines()), 1 + 201 * 3)
            shutil.rmtree(self.folder / "pair")

    def test_a_run_goes_on_from_a_checkpoint_with_the_hash_of_the_whole_run(self):
        for version in self.each_version():
            self.unpack(version / "run.tar.gz")
            tick, hash_ = (self.folder / "pair/hashes.txt").read_text().splitlines()[-1].split()
            self.assertEqual(tick, "200")
            self.go("run", version / "pair.xml", "--quiet", "--restore", version / "checkpoint", "--any-build", "--expect-hash", hash_, "--output",
                    f"from_{version.name}")
            shutil.rmtree(self.folder / "pair")

    def test_studies_are_drawn_and_go_on(self):
        for version in self.each_version():
            self.unpack(version / "study.tar.gz")
            before = (self.folder / "study/table.csv").read_text().splitlines()
            self.assertEqual(len(before), 1 + 2 * 3)
            self.assertIn("report", self.go("plot", "study"))
            STUDY_HOME.mkdir(exist_ok=True)
            self.addCleanup(shutil.rmtree, STUDY_HOME, ignore_errors=True)
            shutil.copy(version / "pair.xml", STUDY_HOME)
            self.assertIn("finished: 4 runs, 0 failed", self.go("sweep", "study", "--resume", "--quiet"))
            after = (self.folder / "study/table.csv").read_text().splitlines()
            self.assertEqual(len(after), 1 + 4 * 3)
            self.assertLessEqual(set(before), set(after))
            shutil.rmtree(self.folder / "study")

    def test_the_files_are_small(self):
        for version in self.each_version():
            self.assertLess(sum(path.stat().st_size for path in version.iterdir()), MOST_BYTES)
