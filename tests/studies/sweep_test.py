"""Whole studies: the same table whenever it is made, hashes as by `run`, nothing lost when something dies."""
import csv
import os
import pathlib
import re
import shutil
import signal
import sqlite3
import statistics
import subprocess
import time

from study_case import CONFIGS, SWARMANOID, StudyCase

FINISHED = re.compile(r"^finished: (\d+) runs, (\d+) failed, [0-9.]+ s, table (\S+)$", re.MULTILINE)


class Sweep(StudyCase):
    def study(self, inside, attributes="", name="study", experiment=CONFIGS / "diffusion_10.xml"):
        path = self.folder / f"{name}.xml"
        path.write_text(f'<study experiment="{experiment}" ticks="60" {attributes}>\n{inside}\n</study>\n')
        return path

    def sweep(self, *words, code=0):
        return self.command("sweep", *words, "--quiet", code=code)

    TWO = ('<factor id="robots" path="arena.distribute.quantity" values="4 8"/>'
           '<factor id="speed" path="controllers.diffusion.parameters.velocity" values="0.05 0.1"/>'
           '<metrics every="20"><distance id="way" aggregate="mean max"/><polarisation id="order"/><coverage id="seen" cell="0.5"/></metrics>')

    def test_the_table_is_the_same_whenever_it_is_made(self):
        study = self.study(self.TWO, 'seeds="1-3"')
        done = self.sweep(study, "--output", "one", "--jobs", "1")
        self.assertEqual(FINISHED.search(done.stdout).groups(), ("12", "0", "one/table.csv"))
        self.sweep(study, "--output", "three", "--jobs", "3")
        # In another order, with an end in between.
        self.sweep(study, "--output", "parts", "--only", "robots == 8 and seed > 1")
        self.assertEqual(len({row["point"] + "-" + row["seed"] for row in self.table("parts")}), 4)
        self.sweep("parts", "--resume")
        bytes_of = {name: (self.folder / name / "table.csv").read_bytes() for name in ("one", "three", "parts")}
        self.assertEqual(bytes_of["one"], bytes_of["three"])
        self.assertEqual(bytes_of["one"], bytes_of["parts"])
        rows = self.table("one")
        self.assertEqual([row["tick"] for row in rows[:4]], ["0", "20", "40", "60"])
        self.assertEqual({(row["robots"], row["speed"]) for row in rows}, {("4", "0.05"), ("4", "0.1"), ("8", "0.05"), ("8", "0.1")})
        for row in rows:
            # No robot is much faster than its wheels; others may push it.
            self.assertLessEqual(float(row["way.max"]), 1.2 * float(row["speed"]) * float(row["time_s"]) + 1e-9)
            self.assertGreaterEqual(float(row["seen"]), 1 / 49)
        # What a run leaves is an empty folder, which goes.
        self.assertEqual(list((self.folder / "one" / "runs").iterdir()), [])

    def test_a_study_is_moved_with_its_experiment_and_alone(self):
        old, new = self.folder / "old", self.folder / "new"
        old.mkdir()
        shutil.copy(CONFIGS / "diffusion_10.xml", old)
        study = self.study('<metrics every="20"><distance id="way"/></metrics>', 'seeds="1-3"', "old/study", "diffusion_10.xml")
        self.sweep(study, "--output", "old/runs/out", "--only", "seed == 1")
        old.rename(new)
        self.sweep("new/runs/out", "--resume", "--only", "seed == 2")
        # Another experiment lies where the first one was.
        old.mkdir()
        (old / "diffusion_10.xml").write_text((new / "diffusion_10.xml").read_text() + "<!-- other -->")
        self.sweep("new/runs/out", "--resume", "--only", "seed == 2")
        (new / "diffusion_10.xml").rename(old / "diffusion_10.xml")
        (new / "runs/out").rename(self.folder / "out")
        self.sweep("out", "--resume")
        self.assertEqual([row["seed"] for row in self.table("out") if row["tick"] == "60"], ["1", "2", "3"])
        (old / "diffusion_10.xml").unlink()
        self.assertIn("diffusion_10.xml", self.sweep("out", "--resume", code=3).stderr)

    def test_hashes_are_those_of_run(self):
        self.sweep(self.study(self.TWO, 'seeds="5"'), "--output", "out")
        for row in self.table("out"):
            if row["tick"] == "60":
                self.command("run", CONFIGS / "diffusion_10.xml", "--single-process", "--quiet", "--seed", "5", "--ticks", "60", "--output",
                             f"run{row['point']}", "--set", f"arena.distribute.quantity={row['robots']}", "--set",
                             f"controllers.diffusion.parameters.velocity={row['speed']}", "--expect-hash", row["hash"])

    def test_clusters_have_the_same_table(self):
        inside = '<metrics every="25"><distance id="way"/><largest_cluster id="c" range="0.5"/><trajectories id="ways"/></metrics>'
        self.sweep(self.study(inside, 'seeds="1-2"', "one"), "--output", "a")
        self.sweep(self.study(inside, 'seeds="1-2" cluster="true" controller_hosts="2"', "other"), "--output", "b")
        self.assertEqual((self.folder / "a/table.csv").read_bytes(), (self.folder / "b/table.csv").read_bytes())
        # Their order is that in which the runs came to their ends.
        ways = "SELECT * FROM ways ORDER BY point, seed"
        self.assertEqual(self.query("a", ways), self.query("b", ways))

    def test_what_functions_publish_is_what_they_write(self):
        inside = '<metrics every="20"><published id="to_nest" name="to_nest"/></metrics>'
        tables = {}
        for name, attributes in (("one", ""), ("cluster", 'cluster="true"')):
            self.sweep(self.study(inside, attributes, name, CONFIGS / "prey_retrieval.xml"), "--output", f"out_{name}")
            tables[name] = (self.folder / f"out_{name}/table.csv").read_bytes()
        self.assertEqual(tables["one"], tables["cluster"])
        # The functions' own file stays in the folder of the run.
        with open(self.folder / "out_one/runs/0-1/retrieval.csv", newline="") as file:
            written = {row["tick"]: min(float(value) for name, value in row.items() if name != "tick") for row in csv.DictReader(file)}
        rows = self.table("out_one")
        self.assertEqual([row["tick"] for row in rows], ["0", "20", "40", "60"])
        self.assertEqual(rows[0]["to_nest"], "", "nothing is published before the first tick")
        for row in rows[1:]:
            self.assertAlmostEqual(float(row["to_nest"]), written[row["tick"]], delta=5.1e-5)

    def test_a_name_that_is_never_published_ends_the_study(self):
        inside = '<metrics every="20"><published id="n" name="to_nets"/></metrics>'
        for attributes in ('seeds="1-50"', 'seeds="1" cluster="true"'):
            done = self.sweep(self.study(inside, attributes, experiment=CONFIGS / "prey_retrieval.xml"), "--output", f"out{len(attributes)}", "--jobs", "1",
                              code=3)
            self.assertIn("study.xml:2:", done.stderr)
            self.assertIn("no experiment function has published 'to_nets' in the 60 ticks of the run", done.stderr)
            self.assertIn("published are: to_nest; did you mean 'to_nest'?", done.stderr)
            self.assertIn("the study ends here, with 0 of", done.stderr)
        # One, and what its process had been given beside it.
        self.assertLess(self.query("out12", "SELECT COUNT(*) FROM runs WHERE state = 'failed'")[0][0], 10)

    def test_two_statements_about_one_value_are_refused(self):
        inside = ('<factor id="a" path="arena.distribute.quantity" values="4 8"/>\n'
                  '<factor id="b" path="arena.distribute[0].quantity" values="5 6"/>')
        done = self.sweep(self.study(inside), "--output", "out", code=3)
        self.assertIn("study.xml:3:1: the factor 'b' sets 'arena.distribute[0].quantity', which the factor 'a' at ", done.stderr)
        self.assertIn("study.xml:2:1 sets, too", done.stderr)
        self.assertFalse((self.folder / "out").exists())
        self.assertIn("'ticks' of <study>", self.sweep(self.study('<set path="framework.maxclock" value="9"/>'), code=3).stderr)

    def test_seeds_are_added_until_the_mean_is_known(self):
        inside = ('<factor id="robots" path="arena.distribute.quantity" values="2 10"/>'
                  '<metrics><polarisation id="order"/><coverage id="seen" cell="0.5"/></metrics>')
        study = self.study(inside, 'seeds="1-3"')
        self.sweep(study, "--output", "one", "--until-ci", "seen=8%", "--jobs", "1")
        self.sweep(study, "--output", "two", "--until-ci", "seen=8%", "--jobs", "3")
        self.assertEqual((self.folder / "one/table.csv").read_bytes(), (self.folder / "two/table.csv").read_bytes())
        seen = {}
        for row in self.table("one"):
            if row["tick"] == "60":
                seen.setdefault(row["point"], []).append(float(row["seen"]))
        for values in seen.values():
            # Three, and then five at a time. Two standard errors are near the interval of so many.
            self.assertEqual(len(values) % 5, 3)
            self.assertLess(1.95 * statistics.stdev(values) / len(values) ** 0.5, 0.08 * statistics.mean(values))
        self.assertGreater(max(map(len, seen.values())), 3)
        few = self.sweep(study, "--output", "few", "--until-ci", "order=0.1%", "--most-seeds", "9", code=9)
        self.assertEqual(len({row["seed"] for row in self.table("few")}), 9)
        self.assertRegex(few.stderr, r"point 0 \(robots=2\): order is 0\.\d+ ± \S+ with 9 seeds\n")
        self.assertIn("2 of 2 points do not reach --until-ci order=0.1% with --most-seeds 9; for more: swarmanoid sweep few --resume", few.stderr)
        self.assertEqual(self.sweep("few", "--resume", "--until-ci", "order=900%").stderr, "")
        self.assertIn("did you mean 'order'?", self.sweep(study, "--output", "bad", "--until-ci", "ordre=5%", code=2).stderr)
        self.assertIn("write COLUMN=PERCENT%", self.sweep(study, "--output", "worse", "--until-ci", "order=5", code=2).stderr)

    def test_a_dry_run_estimates_time_and_disk(self):
        study = self.study('<factor id="robots" path="arena.distribute.quantity" values="2 10"/>'
                           '<metrics every="5"><polarisation id="order"/><distance id="way" aggregate="mean max sum"/></metrics>', 'seeds="1-40"')
        dry = self.sweep(study, "--dry-run", "--jobs", "2")
        self.assertEqual(len(dry.stdout.splitlines()), 80)
        size, unit = re.search(r"estimate: \S+ s a run, \d+ s with 2 at a time, (\S+) (kB|MB) on disk\n", dry.stderr).groups()
        self.assertEqual(os.listdir(self.folder), ["study.xml"])
        self.sweep(study, "--output", "out")
        real = sum(path.stat().st_size for path in (self.folder / "out").rglob("*") if path.is_file())
        self.assertLess(abs(float(size) * {"kB": 1e3, "MB": 1e6}[unit] / real - 1), 0.5)
        endless = self.study('<set path="framework.maxclock" value="0"/>', name="endless", experiment=CONFIGS / "prey_retrieval.xml")
        endless.write_text(endless.read_text().replace('ticks="60" ', ""))
        self.assertIn("there is no estimate of time and disk: its runs end by themselves", self.sweep(endless, "--dry-run").stderr)

    def test_killed_at_any_point_it_goes_on(self):
        study = self.study('<factor id="robots" path="arena.distribute.quantity" from="2" to="11" step="1"/>'
                           '<metrics><distance id="way"/></metrics>', 'seeds="1-20"')
        self.sweep(study, "--output", "whole")
        begin, go_on = ([SWARMANOID, "sweep", study, "--output", "out", "--quiet"], [SWARMANOID, "sweep", "out", "--resume", "--quiet"])
        for kill in range(7):
            # One that was killed before its database was complete has not begun.
            has_begun = (self.folder / "out/study.sqlite").exists()
            process = subprocess.Popen(go_on if has_begun else begin, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            deadline = time.monotonic() + 100
            while not (self.folder / "out/lock").exists() and time.monotonic() < deadline:
                time.sleep(0.001)
            time.sleep(0.002 * 3 ** kill)
            process.send_signal(signal.SIGKILL)
            process.wait()
            if (self.folder / "out/study.sqlite").exists():
                self.assertEqual(self.query("out", "SELECT COUNT(*) FROM runs"), [(200,)])
        self.sweep("out", "--resume")
        self.assertEqual((self.folder / "whole/table.csv").read_bytes(), (self.folder / "out/table.csv").read_bytes())

    def test_a_result_that_was_damaged_on_the_disk_is_named_and_computed_again(self):
        """A flipped bit of a file of SQLite is another value to it."""
        study = self.study('<factor id="robots" path="arena.distribute.quantity" values="2,3"/><metrics><distance id="way"/></metrics>',
                           'seeds="1-3"')
        self.sweep(study, "--output", "out")
        whole = (self.folder / "out/table.csv").read_bytes()
        for damage in ("UPDATE samples SET time_s = time_s + 1 WHERE point = 1 AND seed = 2",
                       "UPDATE runs SET hash = 'f' || substr(hash, 2) WHERE point = 1 AND seed = 2",
                       "DELETE FROM samples WHERE point = 1 AND seed = 2"):
            database = sqlite3.connect(self.folder / "out/study.sqlite")
            with database:
                database.execute(damage)
            database.close()
            told = self.sweep("out", "--resume")
            self.assertIn("the result of run 1-2 does not fit its checksum; it runs again", told.stderr, damage)
            self.assertEqual((self.folder / "out/table.csv").read_bytes(), whole, damage)
        for damage, says in (("UPDATE runs SET robots = 5 WHERE point = 1 AND seed = 2", "different values of the factor 'robots'"),
                             ("UPDATE study SET value = replace(value, '2,3', '2,4') WHERE name = 'study'", "does not fit its checksum")):
            database = sqlite3.connect(self.folder / "out/study.sqlite")
            with database:
                database.execute(damage)
            database.close()
            told = self.sweep("out", "--resume", code=2)
            self.assertIn("is damaged", told.stderr)
            self.assertIn(says, told.stderr)

    def test_one_that_was_killed_before_it_began_begins_again(self):
        study = self.study("", 'seeds="1-2"')
        (self.folder / "out").mkdir()
        for name in ("lock", "study.sqlite.new", "study.sqlite.new-journal"):
            (self.folder / "out" / name).write_text("torn")
        self.assertIn("is no folder of a study", self.sweep("out", "--resume", code=2).stderr)
        self.sweep(study, "--output", "out")
        self.assertEqual(sorted(path.name for path in (self.folder / "out").iterdir() if path.name.startswith("study")), ["study.sqlite"])

    def test_ctrl_c_ends_after_the_runs_that_go_on(self):
        study = self.study("", 'seeds="1-3000"')
        process = subprocess.Popen([SWARMANOID, "sweep", study, "--output", "out", "--quiet"], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        while not (self.folder / "out/runs").exists() and process.poll() is None:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=100)
        self.assertEqual(process.returncode, 130, errors)
        self.assertRegex(errors, r"\d+ of 3000 runs are done; to go on: swarmanoid sweep out --resume")

    def test_one_bad_run_costs_no_other(self):
        if not pathlib.Path(os.environ["TEST_CONTROLLERS"], "libfaulty_controller.so").exists():
            self.skipTest("the faulty controller is not built")
        text = (CONFIGS / "diffusion_10.xml").read_text()
        text = text.replace("footbot_diffusion", "faulty_controller").replace("<velocity>0.05</velocity>", "<fault>none</fault><tick>5</tick>")
        text = re.sub(r"<alpha>.*?</delta>", "", text, flags=re.DOTALL)
        text = text.replace("<maxclock>", f"<controller_path>{os.environ['TEST_CONTROLLERS']}</controller_path><maxclock>")
        (self.folder / "faulty.xml").write_text(text)
        study = self.study('<factor id="fault" path="controllers.diffusion.parameters.fault" values="none step_crashes step_throws step_exits"/>', 'seeds="1-2"',
                           experiment=self.folder / "faulty.xml")
        done = self.sweep(study, "--output", "out", code=4)
        self.assertEqual(FINISHED.search(done.stdout).groups()[:2], ("8", "6"))
        self.assertIn("ControlStep at tick 5 aborted", done.stderr)
        states = self.query("out", "SELECT fault, state, exit, attempts, failure FROM runs ORDER BY point, seed")
        self.assertEqual([row[1] for row in states], ["done"] * 2 + ["failed"] * 6)
        self.assertEqual({row[2] for row in states if row[1] == "failed"}, {4})
        self.assertIn("called exit", states[-1][4])
        self.assertTrue((self.folder / "out/runs/1-1/log.txt").read_text())
        self.sweep("out", "--resume", "--retries", "2", code=4)
        self.assertEqual({row[0] for row in self.query("out", "SELECT attempts FROM runs WHERE state = 'failed'")}, {3})

    def test_what_is_wrong_is_told_before_anything_starts(self):
        for inside, says in (
                ('<factor id="v" path="controllers.diffusion.parameters.velocty" values="1"/>', ["study.xml:2:1: the value 1 of 'v'", "did you mean 'velocity'?"]),
                ('<factor id="v" path="arena.distribute.quantity" values="5 -1"/>', ["study.xml:2:1: the value -1 of 'v'"]),
                ('<set path="controlers.x" value="1"/>', ["controlers", "did you mean 'controllers'?"]),
                ('<metrics><distance id="d" of="footbot*"/></metrics>', ["study.xml:2:", "no entity of the experiment fits 'footbot*'"])):
            done = self.sweep(self.study(inside), "--output", "out", code=3)
            for text in says:
                self.assertIn(text, done.stderr)
        self.assertFalse((self.folder / "out").exists())
        self.assertIn("there is no file", self.sweep(self.folder / "nothing.xml", code=3).stderr.replace("no such file", "no file"))
        study = self.study("", 'seeds="1-2"')
        self.assertIn("there is no 'sed'", self.sweep(study, "--only", "sed > 1", "--dry-run", code=2).stderr)
        self.assertEqual(self.sweep(study, "--only", "seed > 1", "--dry-run").stdout, "0-2 seed=2\n")
        self.sweep(study, "--output", "out")
        self.assertIn("is no empty folder", self.sweep(study, "--output", "out", code=2).stderr)
        self.assertIn("is no folder of a study", self.sweep(self.folder, "--resume", code=2).stderr)

    def test_a_changed_experiment_is_another_study(self):
        shutil.copy(CONFIGS / "diffusion_10.xml", self.folder / "mine.xml")
        study = self.study("", 'seeds="1-2"', experiment=self.folder / "mine.xml")
        self.sweep(study, "--output", "out", "--only", "seed == 1")
        with open(self.folder / "mine.xml", "a") as file:
            file.write("<!-- another one -->\n")
        self.assertIn("has changed since 'out' was begun", self.sweep("out", "--resume", code=2).stderr)
