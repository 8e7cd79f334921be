"""Searches: the same best point for any number of processes and after any death, and words that repeat it."""
import re
import shlex
import shutil
import signal
import sqlite3
import statistics
import subprocess
import time

from study_case import CONFIGS, SWARMANOID, StudyCase

FACTORS = ('<factor id="speed" path="controllers.diffusion.parameters.velocity" from="0.02" to="0.2" scale="logarithmic"/>'
           '<factor id="robots" path="arena.distribute.quantity" from="1" to="6" step="1"/>'
           '<metrics><coverage id="seen" cell="0.5"/><distance id="way"/></metrics>')


class Search(StudyCase):
    def study(self, search, inside=FACTORS, ticks=60, name="study", seeds="1-3"):
        path = self.folder / f"{name}.xml"
        path.write_text(f'<study experiment="{CONFIGS / "diffusion_10.xml"}" ticks="{ticks}" seeds="{seeds}">\n{inside}\n<search {search}/>\n</study>\n')
        return path

    def best_of(self, name, output):
        """The best point of the table, by hand, and what the search said of it."""
        values = {}
        for row in self.table(name):
            if int(row["seed"]) <= 3:
                values.setdefault(int(row["point"]), []).append(float(row["seen"]))
        means = {point: statistics.fmean(of) for point, of in values.items()}
        best = max(means, key=lambda point: (means[point], -point))
        said = re.search(r"^best: point (\d+), speed=(\S+) robots=(\S+)$", output, re.MULTILINE)
        self.assertEqual(int(said.group(1)), best)
        value = float(re.search(r"^seen \(mean of 3 seeds\): (\S+) in the search", output, re.MULTILINE).group(1))
        self.assertAlmostEqual(value, means[best], delta=1e-5)
        return best

    def test_the_same_for_any_number_of_processes_and_after_any_death(self):
        for algorithm in ("crs", "isres", "cma_es", "sbplx"):
            population = ' population="8"' if algorithm != "sbplx" else ""
            study = self.study(f'metric="seen" runs="75" algorithm="{algorithm}"{population} fresh_seeds="4"', name=algorithm)
            one = self.command("sweep", study, "--output", f"{algorithm}_one", "--jobs", "1", "--quiet")
            three = self.command("sweep", study, "--output", f"{algorithm}_three", "--jobs", "3", "--quiet")
            whole = (self.folder / f"{algorithm}_one/table.csv").read_bytes()
            self.assertEqual(whole, (self.folder / f"{algorithm}_three/table.csv").read_bytes())
            best = self.best_of(f"{algorithm}_one", one.stdout)
            fresh = [row["seed"] for row in self.table(f"{algorithm}_one") if int(row["seed"]) > 3]
            self.assertEqual(fresh, ["4", "5", "6", "7"])
            self.assertEqual({int(row["point"]) for row in self.table(f"{algorithm}_one") if int(row["seed"]) > 3}, {best})
            output = self.killed_again_and_again(study)
            self.assertEqual(whole, (self.folder / "killed/table.csv").read_bytes())
            without_time = [re.sub(r"^finished.*", "", text, flags=re.MULTILINE) for text in (one.stdout, three.stdout, output)]
            self.assertEqual(without_time[0], without_time[1])
            self.assertEqual(without_time[0], without_time[2])
            # Nothing was run twice, and one that is done is told again without a run.
            self.assertEqual(self.query("killed", "SELECT MAX(attempts), COUNT(*) FROM runs"), [(1, len(self.table("killed")))])
            again = self.command("sweep", "killed", "--resume", "--quiet")
            self.assertEqual(re.sub(r"^finished.*", "", again.stdout, flags=re.MULTILINE), without_time[0])
            shutil.rmtree(self.folder / "killed")

    def killed_again_and_again(self, study):
        """The output of a search in the folder `killed` whose processes all ended with it, and that was resumed each time."""
        started = subprocess.Popen([SWARMANOID, "sweep", str(study), "--output", "killed", "--quiet"], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for runs in (5, 30, 60):
            deadline = time.monotonic() + 60
            while time.monotonic() < deadline and started.poll() is None:
                try:
                    if self.query("killed", "SELECT COUNT(*) FROM runs WHERE state = 'done'")[0][0] >= runs:
                        break
                except sqlite3.Error:
                    pass
                time.sleep(0.01)
            started.send_signal(signal.SIGKILL)
            started.wait()
            started = subprocess.Popen([SWARMANOID, "sweep", "killed", "--resume", "--quiet"], cwd=self.folder, text=True,
                                       stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        output = started.communicate(timeout=200)[0]
        self.assertEqual(started.returncode, 0, output)
        return output

    def test_a_race_is_the_same_for_any_number_of_processes_and_after_any_death(self):
        # Robots that are faster see more, and of two variants one stands nearly still.
        inside = ('<factor id="speed" path="controllers.diffusion.parameters.velocity" from="0.02" to="0.2"/>'
                  '<variants id="robots"><variant id="one"><set path="arena.distribute.quantity" value="1"/></variant>'
                  '<variant id="six"><set path="arena.distribute.quantity" value="6"/></variant></variants>'
                  '<metrics><coverage id="seen" cell="0.5"/></metrics>')
        study = self.study('metric="seen" runs="150" algorithm="race" fresh_seeds="4"', inside, name="race", seeds="1-12")
        one = self.command("sweep", study, "--output", "one", "--jobs", "1", "--quiet")
        three = self.command("sweep", study, "--output", "three", "--jobs", "3", "--quiet")
        killed = self.killed_again_and_again(study)
        whole = (self.folder / "one/table.csv").read_bytes()
        self.assertEqual(whole, (self.folder / "three/table.csv").read_bytes())
        self.assertEqual(whole, (self.folder / "killed/table.csv").read_bytes())
        outputs = [re.sub(r"^finished.*", "", text, flags=re.MULTILINE) for text in (one.stdout, three.stdout, killed)]
        self.assertEqual(outputs[0], outputs[1])
        self.assertEqual(outputs[0], outputs[2])
        self.assertEqual(self.query("killed", "SELECT MAX(attempts), COUNT(*) FROM runs"), [(1, len(self.table("killed")))])
        # All six robots see more than one.
        self.assertRegex(one.stdout, r"(?m)^best: point \d+, robots=six speed=\S+$")
        runs = self.query("one", "SELECT robots, COUNT(*) FROM runs WHERE seed <= 12 GROUP BY robots ORDER BY robots")
        self.assertLessEqual(sum(count for _, count in runs), 150)
        self.assertGreater(dict(runs)["six"], 2 * dict(runs)["one"])
        self.command("plot", "one")
        self.assertTrue((self.folder / "one/pictures/seen_search.svg").exists() or list((self.folder / "one/pictures").glob("seen_search*")))

    def test_its_words_repeat_the_best_run(self):
        done = self.command("sweep", self.study('metric="seen" runs="30" algorithm="sbplx" fresh_seeds="0"'), "--output", "out", "--quiet")
        best = self.best_of("out", done.stdout)
        words = shlex.split(re.search(r"^swarmanoid (run .*)$", done.stdout, re.MULTILINE).group(1))
        for row in self.table("out"):
            if int(row["point"]) == best:
                self.command(*words, "--quiet", "--seed", row["seed"], "--output", "run" + row["seed"], "--expect-hash", row["hash"])

    def test_finds_what_is_known_to_be_the_best(self):
        # A robot alone goes as far as its speed lets it before it meets a wall.
        inside = ('<set path="arena.distribute.quantity" value="1"/>'
                  '<factor id="speed" path="controllers.diffusion.parameters.velocity" from="0.01" to="0.1"/><metrics><distance id="way"/></metrics>')
        for goal, sign in (("max", 1), ("min", -1)):
            self.command("sweep", self.study(f'metric="way.mean" goal="{goal}" runs="90" algorithm="bobyqa" fresh_seeds="0"', inside, ticks=20),
                         "--output", goal, "--quiet")
            self.assertEqual(self.query(goal, "SELECT value FROM study WHERE name = 'goal'"), [(goal,)])
            speeds = {float(row["speed"]) for row in self.table(goal)}
            self.assertEqual(max(speeds, key=lambda speed: sign * speed), 0.1 if goal == "max" else 0.01)

    def test_clusters_search_the_same(self):
        study = self.study('metric="seen" runs="9" algorithm="sbplx" fresh_seeds="1"', ticks=10)
        other = self.folder / "cluster.xml"
        other.write_text(study.read_text().replace("<study ", '<study cluster="true" '))
        self.command("sweep", study, "--output", "one", "--quiet")
        self.command("sweep", other, "--output", "cluster", "--quiet")
        self.assertEqual((self.folder / "one/table.csv").read_bytes(), (self.folder / "cluster/table.csv").read_bytes())

    def test_conditions_hold_and_patience_ends(self):
        inside = FACTORS + '<require condition="robots * speed &lt; 0.5"/>'
        done = self.command("sweep", self.study('metric="seen" runs="3000" algorithm="crs" population="6" patience="5" fresh_seeds="0"', inside),
                            "--output", "out", "--quiet")
        for row in self.table("out"):
            self.assertLess(float(row["robots"]) * float(row["speed"]), 0.5)
        best = self.best_of("out", done.stdout)
        self.assertIn("5 points in a row were no better", done.stdout)
        self.assertEqual(max(int(row["point"]) for row in self.table("out")), best + 5)

    def test_whole_numbers_come_to_an_end(self):
        inside = ('<factor id="robots" path="arena.distribute.quantity" from="1" to="3" step="1"/><metrics><coverage id="seen" cell="0.5"/></metrics>')
        self.command("sweep", self.study('metric="seen" runs="3000" algorithm="crs" fresh_seeds="0"', inside, ticks=5), "--output", "out", "--quiet")
        self.assertEqual(sorted({row["robots"] for row in self.table("out")}), ["1", "2", "3"])

    def test_mistakes_and_failures(self):
        study = self.study('metric="seen" runs="30"', FACTORS.replace('to="0.2"', 'to="1e9"').replace("velocity", "velocty"))
        self.assertRegex(self.command("sweep", study, "--output", "out", code=3).stderr, r"study\.xml:2:1: the value .* velocity")
        good = self.study('metric="seen" runs="30"')
        self.assertIn("leave --only", self.command("sweep", good, "--only", "robots > 1", code=2).stderr)
        dry = self.command("sweep", good, "--dry-run")
        self.assertIn("robots: 1 to 6 in steps of 1", dry.stdout)
        self.assertIn("at most 10 points, 30 runs", dry.stderr)
        # If no robot arrives there is no value.
        nowhere = FACTORS.replace("<metrics>", '<metrics><time_to_region id="late" centre="0.2,0.2" radius="0.001" aggregate="min"/>')
        self.assertRegex(self.command("sweep", self.study('metric="late.min" runs="30"', nowhere), "--output", "none", code=3).stderr,
                         r"study\.xml:3:1: where the search begins, .* not all runs have a value")
