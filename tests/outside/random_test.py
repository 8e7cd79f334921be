"""Random numbers of a stranger's controllers and experiment functions: no step repeats those of another, and each run of a
seed draws the same ones, in one process, as a cluster, and from a checkpoint."""
import collections

from outside import WAYS, OutsideTest, main

TICKS = 12


class Random(OutsideTest):
    def write(self, name, before="", functions=("one", "two")):
        """An experiment whose robots and functions write to a folder of that name; returns file and folder."""
        folder = self.folder / name
        folder.mkdir()
        second = '<footbot id="robot_two"><position>2,2,0</position><orientation>0,0,0</orientation><controller>c</controller></footbot>'
        listed = "".join(f'<outside_random_functions id="{f}" library="outside_random_functions"><file>{folder}/functions_{f}.txt</file></outside_random_functions>'
                         for f in functions)
        file = self.experiment(name, controller="outside_random", parameters=f"<folder>{folder}</folder>", ticks=TICKS, functions=listed,
                               arena=second + before, entities="robot_two", framework=f"<canonical_period>5</canonical_period>")
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

    def test_others_change_nothing(self):
        _, expected = self.run_one("alone", "--single-process", functions=("two",))
        block = '<block id="far"><position>3.5,3.5,0.1</position><orientation>0,0,0</orientation><size>0.2,0.2,0.2</size></block>'
        _, found = self.run_one("more", "--single-process", before=block)
        for key, numbers in expected.items():
            self.assertEqual(found[key], numbers, key)


if __name__ == "__main__":
    main()
