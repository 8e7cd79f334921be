"""Runs that loop functions of ARGoS3 begin again."""
import json
import os
import re
import subprocess

from running import HERE, RunningTest


class Reset(RunningTest):
    def trials(self, where):
        file = self.changed("repeat.argos", ('where="post"', f'where="{where}"'))
        if not (self.folder / "scripts").exists():
            (self.folder / "scripts").symlink_to(HERE / "scripts")
        said = self.swarmanoid("run", file, "--output", where)
        rows = [line.split("\t") for line in (self.folder / "trials.tsv").read_text().splitlines()]
        return said, [[row[1:] for row in rows if row[0] == str(trial)] for trial in range(3)]

    def test_a_trial_that_begins_again_is_the_same(self):
        said, (first, second, third) = self.trials("post")
        at_reset, steps = second[0], second[1:]
        # clock, x, steps, resets of the controller, number drawn, resets, and all that was changed.
        self.assertEqual(at_reset[:5] + at_reset[6:],
                         ["reset", "0", "0", "0", "1", "1", "-0.5", "green", "yellow", "black", "0", "-1", "3"])
        # But for the resets and who was removed for good, and for the number that was drawn last.
        same = [[*row[:4], row[5] if row[3] != "0" else "", *row[7:-1]] for row in first]
        self.assertEqual([[*row[:4], row[5] if row[3] != "0" else "", *row[7:-1]] for row in steps], same)
        self.assertEqual((first[0][-1], steps[-1][-1]), ("4", "3"))
        # Of another seed, and as long as the file says.
        self.assertNotEqual([row[5] for row in third[2:8]], [row[5] for row in first[1:7]])
        self.assertEqual((len(first), len(steps), third[-1][:2]), (12, 12, ["post", "8"]))
        self.assertIn("finished: 21 ticks", said.stdout)
        self.assertEqual(re.findall(r"(init|reset after) (\d+)", self.said_in("post")),
                         [("init", "0"), ("reset after", "6"), ("reset after", "6")])

    def rows_of_trials(self, file):
        self.swarmanoid("run", file, "--output", "run")
        rows = [line.split("\t") for line in (self.folder / "trials.tsv").read_text().splitlines()]
        return [[row[1:] for row in rows if row[0] == str(trial)] for trial in range(5)]

    def test_trials_of_one_seed_are_the_same_bit_by_bit_with_noise_and_contacts(self):
        first, again, other, other_again, last = self.rows_of_trials(HERE / "trials.argos")
        self.assertEqual(len(first), 130)
        self.assertEqual([row[0] for row in first], [str(clock) for clock in range(1, 131)])
        # Of seed 3, twice of seed 99, and of seed 3.
        self.assertEqual(again, first)
        self.assertNotEqual(other[0], first[0])
        self.assertEqual(other_again, other)
        self.assertEqual(last, first)
        # They meet, and push the crate.
        self.assertNotEqual(first[0][-1], first[-1][-1])

    def test_the_noise_goes_on_if_the_space_alone_begins_again(self):
        trials = self.rows_of_trials(self.changed("trials.argos", ('reset="simulator"', 'reset="space"')))
        self.assertEqual(len({str(trial[0]) for trial in trials}), 5)

    def test_a_run_begins_again_where_it_is_asked_whether_it_is_over(self):
        trials = self.trials("finished")[1]
        self.assertEqual(trials, self.trials("post")[1])

    def test_a_program_runs_an_experiment_by_itself(self):
        _, (first, _, _) = self.trials("post")
        expected = [row for row in first if row[0] != "reset"]
        file = self.changed("repeat.argos", ('trials="3"', 'trials="1"'))
        # Twice, one behind the other.
        for files in ((file,), (file, file)):
            result = subprocess.run([f"{os.environ['ARGOS_PLUGIN_PATH']}/argos3_searcher", *map(str, files)], cwd=self.folder, text=True, capture_output=True)
            self.assertEqual(result.returncode, 0, result.stderr)
            lines = [line for line in result.stdout.splitlines() if not line.startswith("seed")]
            self.assertEqual([line.rsplit(" ", 1)[0] for line in lines[:8]],
                             ["loaded 0", "first 8", "reset 0", "again 8", "reset 0", "again 8", "one step 1", "0"][:7] + [lines[7].rsplit(" ", 1)[0]])
            self.assertEqual((lines[1].split()[2], lines[0].split()[1:], lines[2].split()[1:]), (lines[3].split()[2], ["0", "0"], ["0", "0"]))
            self.assertEqual(len(lines), 8 * len(files))
        rows = [line.split("\t")[1:] for line in (self.folder / "trials.tsv").read_text().splitlines()]
        self.assertEqual([row[:4] for row in rows[:12]], [row[:4] for row in expected])
        self.assertIn("loaded 8", (self.folder / "said.txt").read_text())

    def test_a_run_with_loop_functions_has_a_journal(self):
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        file = self.changed("repeat.argos")
        done = self.hash_of(file, "--output", "run", "--hash-log", "hashes")
        self.assertEqual(self.hash_of(file, "--output", "none", "--no-journal"), done)
        self.assertFalse((self.folder / "none" / "journal").exists())
        # The journal has each move, addition, removal and reset of loop functions. Computed again, all states are the same.
        self.assertEqual(self.swarmanoid("replay", "run", "--verify").stdout, "equal: 22 states, computed again\n")
        rows = self.swarmanoid("export", "run", "--csv", "poses.csv") and (self.folder / "poses.csv").read_text().splitlines()
        at = {tuple(row.split(",")[0:3:2]): row.split(",")[4:6] for row in rows[1:]}
        self.assertIn(("1", "gone"), at)
        self.assertNotIn(("20", "gone"), at)
        self.swarmanoid("export", "run", "--html", "run.html")
        seen = json.loads(self.swarmanoid("inspect", "run@5", "fb", "--json").stdout)["robots"][0]
        self.assertEqual((seen["id"], seen["controller"]), ("fb", "t"))
        self.assertIn("footbot_wheels", [device["type"] for device in seen["actuators"]])
        self.assertIn("not 99", self.swarmanoid("inspect", "run@99", "fb", code=4).stderr)

    def test_a_program_changes_an_experiment_in_memory(self):
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        file = self.changed("repeat.argos", ('trials="3"', 'trials="1"'))
        said = []
        for words in (("--seed", "11", file, "--seed", "12", file, "--seed", "11", file), (self.seeded(file, 11),)):
            result = subprocess.run([f"{os.environ['ARGOS_PLUGIN_PATH']}/argos3_searcher", *map(str, words)], cwd=self.folder, text=True, capture_output=True)
            self.assertEqual(result.returncode, 0, result.stderr)
            said.append(result.stdout.split("seed ")[1:])
        (eleven, twelve, again), (of_file,) = said
        self.assertEqual((eleven.splitlines()[0], twelve.splitlines()[0]), ("11 robots 4", "12 robots 4"))
        self.assertEqual((eleven, eleven), (again, of_file))
        self.assertNotEqual(eleven.splitlines()[1:], twelve.splitlines()[1:])

    def seeded(self, file, seed):
        copy = self.folder / "seeded.argos"
        copy.write_text(re.sub('random_seed="\\d+"', f'random_seed="{seed}"', file.read_text()))
        return copy

    def test_what_a_program_cannot_load_is_told(self):
        program = f"{os.environ['ARGOS_PLUGIN_PATH']}/argos3_searcher"
        def refused(file):
            result = subprocess.run([program, str(file)], cwd=self.folder, text=True, capture_output=True)
            self.assertEqual(result.returncode, 1, result.stderr)
            return result.stderr
        self.assertIn("none.argos", refused("none.argos"))
        self.assertRegex(refused(HERE / "wander.argos"), "has no <loop_functions>; add them")

    def test_what_does_not_begin_again_has_its_length_in_the_framework(self):
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        converted = self.swarmanoid("convert", HERE / "repeat.argos", "--output", "repeat.xml")
        text = (self.folder / "repeat.xml").read_text()
        self.assertNotIn("maxclock", text)
        self.assertIn(' length="9"', text)
        self.assertIn('maxclock="', self.swarmanoid("convert", HERE / "collect.argos").stdout)

    def test_in_a_cluster_the_controllers_are_out_of_reach(self):
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        self.swarmanoid("convert", self.changed("repeat.argos", ('label="repeater"', 'label="blind"')), "--output", "repeat.xml")
        result = self.swarmanoid("run", "repeat.xml", "--output", "cluster", code=4)
        self.assertRegex(result.stdout + result.stderr, r"controller of 'fb' is not in this process[^\n]*--single-process")
