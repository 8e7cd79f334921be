"""Objects of ARGoS3's experiments: with LEDs, distributed, and made by loop functions."""
import re

from running import HERE, RunningTest


class Objects(RunningTest):
    def seen_at(self, tick, said):
        return re.search(rf"at tick {tick}: saw (.*)", said).group(1).split()

    def test_loop_functions_make_boxes_and_cylinders(self):
        self.swarmanoid("run", HERE / "build.argos", "--output", "run")
        lines = (self.folder / "built.tsv").read_text().splitlines()
        # A pillar fits beside the wall alone; the wall and four boxes; the pillar.
        self.assertEqual(lines[0], "# 01 5 1 0.05")
        rows = [line.split("\t") for line in lines[1:]]
        self.assertEqual(len(rows), 100)
        # The robot comes to the wall, which stands still, and stays there.
        self.assertAlmostEqual(float(rows[30][1]), 0.3, delta=0.01)
        self.assertTrue(0.42 < float(rows[-1][1]) < 0.5, rows[-1])
        self.assertEqual({(row[2], row[3]) for row in rows}, {("0.6,0,0", "10")})

    def test_cameras_see_leds_of_boxes_and_cylinders(self):
        self.swarmanoid("run", HERE / "build.argos", "--output", "run")
        said = self.said_in("run")
        blue, green, red = "0,0,255", "0,255,0", "255,0,0"
        self.assertEqual(self.seen_at(1, said), [blue, green, red])
        # The crate is removed in step 10. The next one comes without LEDs.
        self.assertEqual(self.seen_at(15, said), [green, red])
        self.assertEqual(self.seen_at(25, said), [green, red])

    def test_a_robot_that_is_disabled_makes_no_steps(self):
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        said = {}
        for rests in (0, 40):
            file = self.changed("build.argos", ('late="0"', f'late="0" rests="{rests}"'))
            self.swarmanoid("run", file, "--output", f"run{rests}")
            said[rests] = {int(tick) for tick in re.findall(r"at tick (\d+): saw", self.said_in(f"run{rests}"))}
        self.assertEqual(said[0], set(range(1, 101)))
        self.assertEqual(said[40], said[0] - set(range(41, 61)))
        # Nothing but the loop functions is there in the process of a cluster.
        file = self.changed("build.argos", ('late="0"', 'late="0" rests="40"'))
        self.swarmanoid("convert", file, "--output", "ours.xml")
        result = self.swarmanoid("run", "ours.xml", "--output", "cluster", "--controller-hosts", 1, code=4)
        self.assertIn("loop functions reset, enable and disable robots in a run with --single-process", result.stdout + result.stderr)

    def test_as_many_as_init_makes_are_kept_twice(self):
        text = self.swarmanoid("convert", HERE / "build.argos").stdout
        self.assertEqual(re.findall(r'<reserve quantity="(\d+)">\s*<(\w+) id="made_body', text),
                         [("21", "argos3_box"), ("21", "argos3_box"), ("21", "cylindric_prey")])
        late = self.changed("build.argos", ('late="0"', 'late="1"'))
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        result = self.swarmanoid("run", late, "--output", "run", code=4)
        self.assertRegex(result.stdout + result.stderr, r"no box is left for 'other'[^\n]*make one like it in Init")

    def test_init_makes_as_many_as_the_settings_of_the_run_say(self):
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        file = self.changed("build.argos", ('late="0"', 'late="0" more="0"'))
        more = "experiment_functions.argos3_loop_functions.loop_functions.more=50"
        self.swarmanoid("run", file, "--set", more, "--seed", 5, "--output", "run")
        # Fifty of 5 mm, and as many again.
        kept = "arena.reserve[1].quantity=100"
        self.swarmanoid("run", file, "--set", more, "--seed", 5, "--set", kept, "--output", "kept")
        wrong = self.swarmanoid("check", file, "--set", more, "--set", "arena.reserve[9].quantity=1", code=3)
        self.assertIn("reserve", wrong.stderr)

    def test_distributed_boxes_stand_on_the_floor_and_may_lie_beyond_the_arena(self):
        text = self.swarmanoid("convert", HERE / "build.argos").stdout
        # The arena reaches to -1.6, where one may come; its middle is half its height above the floor.
        self.assertRegex(text, r'method="uniform" min="0, [\d.]+, 0.1\d*" max="[\d., ]+, 0.1\d*"')
        self.assertEqual(self.hash_of(HERE / "build.argos", "--output", "one"),
                         self.hash_of(HERE / "build.argos", "--output", "two"))

    def test_the_heaviest_bodies_have_a_billion_kilograms(self):
        heavy = self.changed("build.argos", ('0.1" movable="true" mass="1">\n      <body', '0.1" movable="true" mass="2e9">\n      <body'))
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        result = self.swarmanoid("convert", heavy)
        self.assertRegex(result.stderr, r"build.argos:\d+:\d+: .*a mass of 2000000000 kg is 1000000000 kg here")
        # Of the file and of the loop functions.
        self.assertEqual(len(re.findall(r'mass="1000000000"', result.stdout)), 2)

    def test_an_arena_may_have_no_height(self):
        flat = self.changed("battery.argos", ('size="4,4,1" center="0,0,0.5"', 'size="4.0, 4.0, 0.0" center="0,0,0"'))
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        self.assertIn('<arena size="4, 4, 1"', self.swarmanoid("convert", flat).stdout)
        self.swarmanoid("check", flat)

    def test_robots_on_a_grid_may_stand_as_near_as_their_bodies_allow(self):
        near = self.changed("collect.argos", ('distances="1,1,0"', 'distances="0.2,0.2,0"'))
        self.swarmanoid("check", near)
