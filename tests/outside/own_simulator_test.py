"""A simulator of a user's own sees, prints and changes the same in one process and as a cluster, with the hash of the
command's own runs."""
import re

from outside import BUILT, WAYS, OutsideTest, main

TICKS = 20


class OwnSimulator(OutsideTest):
    def watched(self, file, *options, **more):
        return self.command(BUILT / "simulation", file, "--quiet", *options, **more)

    def seen_in(self, done):
        """What it printed, without the last line of the run, which tells times."""
        return re.sub(r"^finished: .*\n", "", done.stdout, flags=re.MULTILINE)

    def test_watch_is_called_alike(self):
        file = self.experiment(ticks=TICKS)
        runs = {way: self.watched(file, "--hash-log", self.folder / f"{way}.txt", *options) for way, options in WAYS.items()}
        hashes = {self.hash_of(done) for done in runs.values()} | {self.hash_of(self.run_experiment(file, "--single-process"))}
        self.assertEqual(len(hashes), 1, hashes)
        one, cluster = (self.seen_in(runs[way]) for way in WAYS)
        self.assertEqual(one, cluster)
        self.assertEqual(one.count("watch "), TICKS + 1)
        self.assertRegex(one, rf"watched {TICKS + 1} ticks, .* in one thread")
        self.assertEqual(*((self.folder / f"{way}.txt").read_text() for way in WAYS))

    def test_changes_count_alike(self):
        file = self.experiment(ticks=TICKS)
        change = {"OUTSIDE_CHANGES": "1"}
        runs = {way: self.watched(file, "--hash-log", self.folder / f"{way}.txt", *options, environment=change)
                for way, options in WAYS.items()}
        hashes = {way: self.hash_of(done) for way, done in runs.items()}
        self.assertEqual(len(set(hashes.values())), 1, hashes)
        self.assertNotIn(self.hash_of(self.run_experiment(file, "--single-process")), hashes.values())
        self.assertEqual(*(self.seen_in(done) for done in runs.values()))
        self.assertEqual(*((self.folder / f"{way}.txt").read_text() for way in WAYS))

    def test_its_mistakes_end_the_run(self):
        file = self.experiment(ticks=TICKS)
        for way, options in WAYS.items():
            done = self.watched(file, *options, environment={"OUTSIDE_FAILS": "7"}, timeout=60)
            self.assertEqual(done.returncode, 4, way + done.stderr)
            self.assertIn("the stranger's own mistake", done.stderr, way)
            self.assertNotIn("finished:", done.stdout, way)
            self.assertIn("watched 8 ticks", done.stdout, way)


if __name__ == "__main__":
    main()
