"""Names, folders and files on the command line: empty, missing or wrong ones are refused before anything happens, with
their option and a cure; and numbers of ARGoS3's files that mean nothing."""
import os
import pathlib
import re
import subprocess

import harness

WANDER = pathlib.Path(__file__).parent.parent / "argos3" / "wander.argos"
EXPERIMENT = harness.CONFIGS / "diffusion_10.xml"


class Names(harness.LauncherTest):
    def command(self, *arguments):
        return subprocess.run([harness.SWARMANOID, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=harness.GENEROUS_S,
                              check=False)

    def refused(self, arguments, *says, code=2):
        done = self.command(*arguments.split(" "))
        with self.subTest(arguments):
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            for text in says:
                self.assertIn(str(text), done.stderr)
            self.assertLess(len(done.stderr.splitlines()), 5, done.stderr)
        return done

    def commands_of(self, *command):
        """The command and those below it, with the lines of their options that take a value and their positionals, from their help."""
        text = self.command(*command, "--help").stdout
        # Commands stand before the options. What stands after these is no command.
        below = re.findall(r"^  ([a-z][a-z-]+)  ", text.partition("\nOptions:\n")[0], re.MULTILINE)
        # An option with a value has its type behind it, in capitals or as alternatives.
        options = re.findall(r"^  (--[a-z][a-z0-9-]*) ([^ ].*)", text, re.MULTILINE)
        places = re.findall(r"^  ([A-Z][A-Z_@]*) ", text.partition("Arguments:")[2].partition("\n\n")[0], re.MULTILINE)
        yield list(command), options, places
        for name in below:
            yield from self.commands_of(*command, name)

    def test_no_option_and_no_word_is_empty(self):
        checked = 0
        known = set()
        before = sorted(os.listdir(self.folder))
        for command, options, places in self.commands_of():
            for option, line in options:
                # Commands share options. --slurm takes options of sbatch, or none.
                if option != "--slurm" and (option, line) not in known:
                    known.add((option, line))
                    done = self.command(*command, option, "")
                    self.assertEqual(done.returncode, 2, f"{command} {option}: {done.stderr}")
                    self.assertIn(f"{option} is empty", done.stderr, command)
                    checked += 1
            for number, name in enumerate(places):
                done = self.command(*command, *["x"] * number, "")
                self.assertEqual(done.returncode, 2, f"{command} {name}: {done.stderr}")
                self.assertRegex(done.stderr, r"is empty|does not take ''", f"{command} {name}")
                checked += 1
        self.assertGreater(checked, 100, "the help has been read")
        self.assertEqual(sorted(os.listdir(self.folder)), before, "nothing was made")

    def test_runs_and_files_that_are_not_there(self):
        nothing = self.folder / "nothing"
        (self.folder / "empty").mkdir()
        (self.folder / "text.txt").write_text("no run\n")
        for name in ("nothing", "empty", "text.txt"):
            self.refused(f"run {EXPERIMENT} --faults-of {name}", f"--faults-of '{name}'", "name the folder of a run")
            self.refused(f"run {EXPERIMENT} --single-process --faults-of {name}", f"--faults-of '{name}'")
            self.refused(f"run --branch {name}@5", name)
            self.refused(f"resume {name}", "is no folder of a run")
            self.refused(f"replay {name} text", "is no folder of a run")
            self.refused(f"replay {name} --verify", "is no folder of a run")
            self.refused(f"diff {name} {name}", "is no folder of a run")
            self.refused(f"inspect {name}@1 fb_0", "is no folder of a run")
            self.refused(f"export {name} --csv -", "is no folder of a run")
            self.refused(f"plot {name}", "is no folder of a study")
            self.refused(f"sweep {name} --resume", name)
        self.refused(f"run {EXPERIMENT} --restore {nothing}", "--restore is", "no such file")
        self.refused(f"run {EXPERIMENT} --events {nothing}", "--events is", "no such file")
        self.refused(f"run {EXPERIMENT} --hosts {nothing}", "--hosts", "no such file")
        self.refused(f"run {EXPERIMENT} --key {nothing}", "--key is", "no such file")
        self.refused(f"run {EXPERIMENT} --show nothing", "--show: there is no renderer 'nothing_render'")
        self.refused(f"run {nothing}", "no such file", code=3)
        self.refused(f"check {nothing}", "no such file", code=3)
        self.refused(f"convert {nothing}", "no such file", code=3)
        self.refused(f"edit {nothing}", "no such file", code=3)
        self.refused(f"list settings {nothing}", "no such file", code=3)
        self.refused(f"sweep {nothing}", "no such file", code=3)
        self.refused("demo nothing", "nothing")
        self.refused("list nothing", "swarmanoid list has no 'nothing'; it has: plugins, schema, settings, experiments")
        self.refused("list plugin", "did you mean 'plugins'?")
        self.refused("list", "swarmanoid list needs one of: plugins, schema, settings, experiments")
        self.refused("new usr", "did you mean 'user'?")
        self.refused("new", "swarmanoid new needs one of: user, behavior-controller")
        self.refused("control pause nothing", "nothing", code=2)
        self.refused("attach text nothing", "no experiment")

    def test_a_value_is_set_once(self):
        both = "framework.maxclock=5"
        self.refused(f"run {EXPERIMENT} --set {both} --ticks 7", "--ticks 7 and --set framework.maxclock=5 set the same value")
        self.refused(f"check {EXPERIMENT} --set {both} --set framework[0].maxclock=6", "'framework[0].maxclock' is set already", code=3)

    def test_numbers_of_argos_files(self):
        # Without controllers, whose library would have to be found.
        text = re.sub("<wanderer.*</wanderer>", "", WANDER.read_text(), flags=re.DOTALL).replace('<controller config="w"/>', "")
        (self.folder / "good.argos").write_text(text)
        checked = self.command("check", "good.argos")
        self.assertEqual(checked.returncode, 0, checked.stderr)
        for what, good, bad, says in [
                ("length", 'length="20"', 'length="-2"', "'length' of <experiment> is '-2'"),
                ("length", 'length="20"', 'length="nan"', "'length' of <experiment> is 'nan'"),
                ("length", 'length="20"', 'length="1e300"', "'length' of <experiment> is '1e300'"),
                ("ticks", 'ticks_per_second="10"', 'ticks_per_second="-10"', "'ticks_per_second' is -10"),
                ("ticks", 'ticks_per_second="10"', 'ticks_per_second="0"', "'ticks_per_second' is 0"),
                ("ticks", 'ticks_per_second="10"', 'ticks_per_second="100000"', "'ticks_per_second' is 100000"),
                ("seed", 'random_seed="7"', 'random_seed="-7"', "seed"),
                ("arena", 'arena size="4,4,1"', 'arena size="-4,4,1"', "size"),
                ("arena", 'arena size="4,4,1"', 'arena size="0,4,1"', "size"),
                ("arena", 'arena size="4,4,1"', 'arena size="4,4,1e300"', "size"),
                ("box", 'size="4,0.1,0.5" movable="false"><body position="0,2,0"', 'size="4,-0.1,0.5" movable="false"><body position="0,2,0"', "size"),
                ("cylinder", 'radius="0.1"', 'radius="-0.1"', "radius"),
                ("cylinder", 'height="0.5"', 'height="0"', "height"),
                ("mass", 'radius="0.1" height="0.5" movable="false"', 'radius="0.1" height="0.5" movable="true" mass="-1"', "mass"),
                ("quantity", 'quantity="12"', 'quantity="-12"', "quantity"),
                ("trials", 'max_trials="100"', 'max_trials="-1"', "max_trials"),
                ("base_num", 'quantity="12"', 'quantity="12" base_num="-3"', "base_num"),
                ("rab_range", '<foot-bot id="fb">', '<foot-bot id="fb" rab_range="-1">', "'rab_range' of <foot-bot> is -1"),
                ("rab_data_size", '<foot-bot id="fb">', '<foot-bot id="fb" rab_data_size="-1">', "'rab_data_size' is -1"),
                ("std_dev", 'std_dev="360,0,0"', 'std_dev="-360,0,0"', "deviation")]:
            with self.subTest(what, bad=bad):
                # Devices are of robots that have a controller.
                whole = WANDER.read_text() if what.startswith("rab") else text
                self.assertEqual(whole.count(good), 1, good)
                path = self.folder / "bad.argos"
                path.write_text(whole.replace(good, bad))
                done = self.command("check", path)
                self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
                self.assertRegex(done.stderr, r"bad\.argos:\d+:\d+: ")
                self.assertIn(says, done.stderr)
