"""Random numbers of a stranger's controllers and experiment functions: no step repeats those of another, and each run of a
seed draws the same ones, in one process, as a cluster, and from a checkpoint."""
import collections
import subprocess
import time

from outside import PREFIX, WAYS, OutsideTest

TICKS = 12


class Random(OutsideTest):
    def write(self, name, before="", functions=("one", "two"), told="", crowd=False):
        """An experiment whose robots and functions write to a folder of that name; returns file and folder. `told`: a
        parameter more of the functions; `crowd`: ten robots, placed at random."""
        folder = self.folder / name
        folder.mkdir()
        second = '<footbot id="robot_two"><position>2,2,0</position><orientation>0,0,0</orientation><controller>c</controller></footbot>'
        listed = "".join(f'<outside_random_functions id="{f}" library="outside_random_functions"><file>{folder}/functions_{f}.txt</file>{told}</outside_random_functions>'
                         for f in functions)
        crowded = """<distribute quantity="8"><position method="uniform"/><orientation method="uniform"/>
          <footbot id="robot"><controller>c</controller></footbot></distribute>""" if crowd else ""
        noise = "<noise_kind>gaussian</noise_kind><noise_deviation>0.01</noise_deviation>"
        sensors = f"<footbot_proximity><implementation>generic_footbot_proximity</implementation>{noise}</footbot_proximity>"
        wheels = "<footbot_wheels><implementation>dummy_footbot_wheels</implementation></footbot_wheels>"
        file = self.experiment(name, controller="outside_random", parameters=f"<folder>{folder}</folder>", ticks=TICKS, functions=listed,
                               arena=second + before + crowded, entities="robot_two" + (" robot_?" if crowd else ""), sensors=sensors,
                               actuators=wheels, framework=f"<canonical_period>5</canonical_period>")
        return file, folder

    def drawn(self, folder):
        """By who, step and tick: the numbers."""
        all_ = {}
        for path in folder.glob("*.txt"):
            for line in path.read_text().splitlines():
                step, tick, *numbers = line.split()
                all_[path.stem, step, int(tick)] = numbers
        return all_

    def run_one(self, name, *options, **parts):
        file, folder = self.write(name, **parts)
        return self.hash_of(self.run_experiment(file, "--output", self.folder / f"run_{name}", *options)), self.drawn(folder)

    def test_no_step_repeats_numbers_of_another_in_any_way_of_running(self):
        runs = {way: self.run_one(way.replace(" ", "_"), *options) for way, options in WAYS.items()}
        (first_hash, first), (second_hash, second) = runs.values()
        self.assertEqual(first_hash, second_hash)
        self.assertEqual(first, second)
        steps = collections.Counter(key[:2] for key in first)
        self.assertEqual(steps["robot_one", "ControlStep"], TICKS)
        for who in ["robot_one", "robot_two"]:
            self.assertEqual([steps[who, "Init"], steps[who, "Destroy"]], [1, 1])
        for who in ["functions_one", "functions_two"]:
            self.assertEqual([steps[who, s] for s in ["Init", "PreStep", "PostStep", "IsFinished", "Destroy"]], [1, TICKS, TICKS, TICKS + 1, 1])
        numbers = collections.Counter(n for of_step in first.values() for n in of_step)
        self.assertEqual([n for n, count in numbers.items() if count > 1], [])

    def test_a_restored_run_draws_the_same(self):
        _, expected = self.run_one("whole", "--single-process", "--checkpoint-every", "5")
        checkpoint = self.folder / "run_whole" / "checkpoint-00000005"
        for path in (self.folder / "whole").iterdir():
            path.unlink()
        self.hash_of(self.run_experiment(self.folder / "run_whole" / "experiment.xml", "--single-process", "--restore", checkpoint))
        restored = {key: numbers for key, numbers in self.drawn(self.folder / "whole").items() if key[2] > 5}
        self.assertGreater(len(restored), 6 * TICKS // 2)
        for key, numbers in restored.items():
            self.assertEqual(numbers, expected[key], key)

    def test_a_parameter_of_functions_changes_nothing(self):
        _, expected = self.run_one("plain", "--single-process")
        _, found = self.run_one("told", "--single-process", told="<any>0.5</any>")
        self.assertEqual(found, expected)

    def test_hosts_and_threads_change_nothing(self):
        """Each bit of the state, and all numbers; robots collide, and a sensor is disturbed."""
        ways = {"one process": WAYS["one process"], "one host": [], "two hosts": ["--controller-hosts", "2"], "three hosts": ["--controller-hosts", "3"]}
        runs = {}
        for threads in (1, 3):
            for way, options in ways.items():
                runs[way, threads] = self.run_one(f"{way.replace(' ', '_')}_{threads}", "--set", f"engines.ground.threads={threads}",
                                                  *options, crowd=True)
        expected_hash, expected = runs["one process", 1]
        self.assertEqual(len({who for who, _, _ in expected}), 12)
        for what, (hash_, numbers) in runs.items():
            self.assertEqual(hash_, expected_hash, what)
            self.assertEqual(numbers, expected, what)

    def test_who_attaches_changes_nothing(self):
        """Some from the first tick on, before the run goes on, and some when it is under way."""
        hash_, expected = self.run_one("alone_in_cluster")
        file, folder = self.write("attended")
        run = subprocess.Popen([PREFIX / "bin" / "swarmanoid", "run", file, "--quiet", "--paused", "--output", self.folder / "run_attended"],
                               cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=self.environment())
        attached = []

        def attach(kind, *parameters):
            attached.append(subprocess.Popen([PREFIX / "bin" / "swarmanoid", "attach", kind, "attended", "--output", self.folder, *parameters],
                                             cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=self.environment()))

        def control(*words):
            done = self.command("swarmanoid", "control", *words)
            self.assertEqual(done.returncode, 0, done.stderr)

        try:
            self.until(lambda: "attended" in self.command("swarmanoid", "list", "experiments").stdout, run)
            attach("text", "file=early.txt")
            attach("text", "file=second.txt", "every=2")
            self.until(lambda: all((self.folder / name).exists() and (self.folder / name).read_text() for name in ("early.txt", "second.txt")), run)
            control("step", str(TICKS // 2))
            attach("text", "file=late.txt")
            self.until(lambda: (self.folder / "late.txt").exists() and (self.folder / "late.txt").read_text(), run)
            control("resume")
            out, errors = run.communicate(timeout=60)
            self.assertEqual([one.wait(timeout=100) for one in attached], [0, 0, 0])
        finally:
            for process in [run, *attached]:
                if process.poll() is None:
                    process.kill()
                process.communicate()
        self.assertEqual(self.hash_of(subprocess.CompletedProcess([], run.returncode, out, errors)), hash_)
        self.assertEqual(self.drawn(folder), expected)

    def until(self, condition, run):
        end = time.monotonic() + 60
        while not condition():
            self.assertIsNone(run.poll(), "the run goes on")
            self.assertLess(time.monotonic(), end)
            time.sleep(0.02)

    def test_others_change_nothing(self):
        _, expected = self.run_one("alone", "--single-process", functions=("two",))
        block = '<block id="far"><position>3.5,3.5,0.1</position><orientation>0,0,0</orientation><size>0.2,0.2,0.2</size></block>'
        _, found = self.run_one("more", "--single-process", before=block)
        for key, numbers in expected.items():
            self.assertEqual(found[key], numbers, key)
