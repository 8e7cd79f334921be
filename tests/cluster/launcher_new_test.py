"""What `swarmanoid new` makes builds and runs."""
import os
import pathlib
import re
import shutil
import subprocess

from harness import CONFIGS, LauncherTest

BUILD = os.environ["SWARMANOID_BUILD"]


class New(LauncherTest):
    def test_a_controller_builds_and_runs(self):
        self.assertEqual(self.run_it("new", "user", "mine").process.returncode, 0)
        self.folder = self.folder / "mine"
        for sample in [*self.folder.glob("controllers/*"), *self.folder.glob("functions/*")]:
            shutil.rmtree(sample)  # tests/package builds them
        made = self.run_it("new", "controller", "wall_follower")
        self.assertEqual(made.process.returncode, 0, made.stderr)
        built = subprocess.run(["./build.sh", f"-DCMAKE_PREFIX_PATH={BUILD}", f"-DSwarmanoid_DIR={BUILD}"], cwd=self.folder,
                               capture_output=True, text=True)
        self.assertEqual(built.returncode, 0, built.stdout + built.stderr)
        run = self.run_it("run", "experiments/wall_follower.xml", "--quiet", "--ticks", 100)
        self.assertEqual(run.process.returncode, 0, run.stderr)
        cluster = self.assert_finished(run, 100)
        one = self.run_it("run", "experiments/wall_follower.xml", "--quiet", "--ticks", 100, "--single-process")
        self.assertEqual(self.assert_finished(one, 100), cluster)
        again = self.run_it("new", "controller", "wall_follower")
        self.assertEqual(again.process.returncode, 2)
        self.assertIn("is there already", again.stderr)
        self.folder = self.folder.parent

    def test_scripts_in_both_languages_have_one_rule_and_one_hash(self):
        self.assertEqual(self.run_it("new", "user", "mine").process.returncode, 0)
        outside, self.folder = self.folder, self.folder / "mine"
        hashes = []
        for language, name in (("lua", "avoid"), ("python", "evade")):
            if not (pathlib.Path(BUILD) / f"lib/swarmanoid/lib{language}.so").exists():
                continue
            made = self.run_it("new", language, name)
            self.assertEqual(made.process.returncode, 0, made.stderr)
            for options in (("--single-process",), ("--controller-hosts", 2)):
                run = self.run_it("run", f"experiments/{name}.xml", "--quiet", "--ticks", 200, *options)
                self.assertEqual(run.process.returncode, 0, run.stderr)
                hashes.append(self.assert_finished(run, 200))
        self.folder = outside
        self.assertEqual(len(set(hashes)), 1, hashes)

    def test_an_experiment_is_valid_and_runs(self):
        self.assertEqual(self.run_it("new", "experiment", "first_try").process.returncode, 0)
        self.assertEqual(self.run_it("check", "first_try.xml").process.returncode, 0)
        run = self.run_it("run", "first_try.xml", "--quiet", "--output", "out")
        self.assertEqual(run.process.returncode, 0, run.stderr)
        self.assert_finished(run, 600)
        self.assertTrue((self.folder / "out" / "first_try.txt").exists())

    def test_what_is_written_is_xml_for_other_programs_too(self):
        made = [("user", "mine"), ("experiment", "first_try"), ("terrain", "moor", "--holes", "1", "--seed", "7")]
        made_inside = [("controller", "follower"), ("functions", "spreading"), ("engine", "gliding"), ("renderer", "plan"), ("device", "compass"),
                       ("entity", "rover"), ("lua", "avoid"), ("python", "evade"),
                       *(("behavior-controller", f"{robot}_watch", "--robot", robot) for robot in ("footbot", "handbot", "eyebot"))]
        for words in made:
            self.assertEqual(self.run_it("new", *words).process.returncode, 0, words)
        run = self.run_it("run", "first_try.xml", "--quiet", "--single-process", "--ticks", 2, "--output", "out", "--set",
                          "visualisations.table.file=<ä> & \"b\"\n--> ]]>")
        self.assertEqual(run.process.returncode, 0, run.stderr)
        (self.folder / "schema.xml").write_text(self.run_it("list", "schema").stdout)
        outside, self.folder = self.folder, self.folder / "mine"
        for words in made_inside:
            self.assertEqual(self.run_it("new", *words).process.returncode, 0, words)
        self.folder = outside
        files = sorted(str(path.relative_to(outside)) for path in outside.rglob("*") if path.suffix in (".xml", ".argos"))
        self.assertEqual(len(files), 18, files)
        checked = subprocess.run(["xmllint", "--noout", "--nonet", *files], cwd=outside, capture_output=True, text=True)
        self.assertEqual((checked.returncode, checked.stderr), (0, ""))

    def test_a_terrain_is_made_without_a_word_too_many_and_runs(self):
        made = self.run_it("new", "terrain", "moor", "--size", "1.2,1", "--holes", "1", "--seed", "7")
        self.assertEqual((made.process.returncode, made.stderr), (0, ""))
        self.assertTrue((self.folder / "terrain" / "moor.bt").exists())
        run = self.run_it("run", "moor.xml", "--quiet", "--ticks", 50)
        self.assertEqual((run.process.returncode, run.stderr), (0, ""))
        cluster = self.assert_finished(run, 50)
        one = self.run_it("run", "moor.xml", "--quiet", "--ticks", 50, "--single-process")
        self.assertEqual(self.assert_finished(one, 50), cluster)
        again = self.run_it("new", "terrain", "moor")
        self.assertEqual(again.process.returncode, 2)
        self.assertIn("is there already", again.stderr)

    def test_the_terrain_of_the_sample_is_made_by_the_command_that_it_names(self):
        sample = (CONFIGS / "rough_holes.xml").read_text()
        command = re.search(r"<\?command swarmanoid new terrain (.*)\?>", sample).group(1)
        made = self.run_it("new", "terrain", *command.split())
        self.assertEqual(made.process.returncode, 0, made.stderr)
        self.assertEqual((self.folder / "terrain" / "rough_holes.bt").read_bytes(),
                         (CONFIGS / "terrain" / "rough_holes.bt").read_bytes())
        self.assertEqual((self.folder / "rough_holes.xml").read_text(), sample)

    def test_bad_names_and_places_are_told_with_the_cure(self):
        answer = self.run_it("new", "experiment", "First-Try")
        self.assertEqual(answer.process.returncode, 2)
        self.assertIn("small letters", answer.stderr)
        answer = self.run_it("new", "controller", "follower")
        self.assertEqual(answer.process.returncode, 2)
        self.assertIn("swarmanoid new user", answer.stderr)
