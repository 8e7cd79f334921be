"""Runs that go on from a checkpoint end as if nothing had happened, in one process and as a cluster, whichever took it."""
import re
import shutil

from harness import CONFIGS, LauncherTest


class Checkpoints(LauncherTest):
    def go(self, experiment, output, *options, ticks=200, code=0):
        run = self.run_it("run", experiment, "--quiet", "--ticks", ticks, "--output", output, *options)
        self.assertEqual(run.process.returncode, code, run.stderr)
        self.assert_nothing_left(run)
        return self.assert_finished(run, ticks)

    def check(self, name, at=100, **how):
        """`at`: the checkpoint from which runs go on, a multiple of 100 and at least 100 ticks before the end."""
        experiment = CONFIGS / f"{name}.xml"
        whole = self.go(experiment, f"{name}_whole", "--single-process", **how)
        files = []
        for way, options in (("one", ["--single-process"]), ("cluster", [])):
            output = f"{name}_{way}"
            self.assertEqual(self.go(experiment, output, "--checkpoint-every", 100, *options, **how), whole)
            files.append(self.folder / output / f"checkpoint-{at:08}")
            self.assertTrue((self.folder / output / f"checkpoint-{at + 100:08}").exists())
        self.assertEqual(files[0].read_bytes(), files[1].read_bytes(), "one process and a cluster write the same file")
        for way, options in (("one", ["--single-process"]), ("cluster", [])):
            self.assertEqual(self.go(experiment, f"{name}_again_{way}", "--restore", files[1], *options, **how), whole)

    def test_kinematic_engine_with_an_own_visualiser(self):
        self.check("diffusion_10")

    def test_kinematic_engine_with_a_gripped_prey_behaviours_and_experiment_functions(self):
        self.check("prey_retrieval", at=2100, ticks=2200, code=1)  # the prey is on its way, and not in the nest yet

    def test_box2d_with_ten_grips(self):
        self.check("gripped_chain", ticks=200)

    def test_ode_with_a_book_in_the_hand_and_a_rope(self):
        self.check("handbot_shelf", at=200, ticks=350)

    def test_three_engines_with_contacts(self):
        self.check("three_engines")

    def test_other_content_of_a_file_is_refused(self):
        shutil.copy(CONFIGS / "rough_terrain.xml", self.folder)
        shutil.copytree(CONFIGS / "terrain", self.folder / "terrain")
        experiment = self.folder / "rough_terrain.xml"
        self.go(experiment, "first", "--single-process", "--checkpoint-every", 100)
        checkpoint = self.folder / "first/checkpoint-00000100"
        self.go(experiment, "same", "--single-process", "--restore", checkpoint)
        hills = self.folder / "terrain/hills.png"
        hills.write_bytes(hills.read_bytes() + b"\0")
        for way in (["--single-process"], []):
            run = self.run_it("run", experiment, "--quiet", "--ticks", 200, "--output", f"other{len(way)}", "--restore", checkpoint, *way)
            self.assertEqual(run.process.returncode, 2, run.stderr)
            self.assertIn("it was taken with another content of the file 'terrain/hills.png'; go on with that one", run.stderr)

    def test_three_engines_with_mirrors(self):
        self.check("mirrors")

    def test_what_holds_together_is_moved_cut_and_removed(self):
        """In each engine: the whole with its prey, then one of them alone, then the prey goes; from a checkpoint with holds too."""
        events = self.folder / "asked.csv"
        events.write_text("tick,request,entity,numbers,from\n120,move,prey,3.2 1.5 0,\n140,detach,fb_9,4.5 0.4 0,\n160,remove,prey,,\n")
        chain = (CONFIGS / "gripped_chain.xml").read_text()
        for engine in ["dummy_engine", "dynamics2d", "dynamics3d"]:
            file = self.folder / f"chain_{engine}.xml"
            text = re.sub(r"<(/?)dynamics2d", rf"<\1{engine}", chain)
            if engine == "dynamics3d":
                text = re.sub(r"<(perpendicular_axis|distance)>.*?</\1>", "", text)
            file.write_text(text)
            asked = ["--events", events]
            whole = self.go(file, f"{engine}_whole", "--single-process", "--checkpoint-every", 100, *asked)
            self.assertNotEqual(self.go(file, f"{engine}_left_alone", "--single-process"), whole)
            saved = self.folder / f"{engine}_whole" / "checkpoint-00000100"
            for way, options in (("one", ["--single-process"]), ("cluster", [])):
                self.assertEqual(self.go(file, f"{engine}_again_{way}", "--restore", saved, *asked, *options), whole)

    def test_two_controller_hosts(self):
        experiment = CONFIGS / "diffusion_10.xml"
        whole = self.go(experiment, "whole", "--controller-hosts", 2, "--checkpoint-every", 100)
        file = self.folder / "whole" / "checkpoint-00000100"
        self.assertEqual(self.go(experiment, "again", "--controller-hosts", 2, "--restore", file), whole)
        for number, options in enumerate(([], ["--single-process"], ["--controller-hosts", 3])):
            self.assertEqual(self.go(experiment, f"others{number}", *options, "--restore", file), whole)

    def test_a_restored_run_may_be_longer(self):
        experiment = CONFIGS / "diffusion_10.xml"
        self.go(experiment, "short", "--single-process", "--checkpoint-every", 100)
        longer = self.go(experiment, "longer", "--restore", self.folder / "short" / "checkpoint-00000200", ticks=300)
        self.assertEqual(longer, self.go(experiment, "whole", "--single-process", ticks=300))

    def test_what_cannot_be_done_is_said_before_the_run(self):
        experiment = CONFIGS / "diffusion_10.xml"
        odd = self.run_it("run", experiment, "--checkpoint-every", 30)
        self.assertEqual(odd.process.returncode, 2)
        self.assertIn("take 100 or change that", odd.stderr)
        self.go(experiment, "first", "--single-process", "--checkpoint-every", 100)
        file = self.folder / "first" / "checkpoint-00000100"
        other = self.run_it("run", experiment, "--seed", 2, "--restore", file)
        self.assertEqual(other.process.returncode, 2)
        self.assertIn("another seed", other.stderr)
        cut = self.folder / "cut"
        cut.write_bytes(file.read_bytes()[:-5])
        self.assertEqual(self.run_it("run", experiment, "--restore", cut).process.returncode, 2)
        for options in (["--single-process"], []):
            refused = self.run_it("run", self.write_faulty("none"), "--checkpoint-every", 100, *options)
            self.assertEqual(refused.process.returncode, 4)
            self.assertIn("robot 'robot_one': its controller cannot be saved", refused.stderr)
            self.assert_nothing_left(refused)
