"""What functions, engines and controllers of strangers hand over is checked before it enters the state: the run ends with its
source, the entity, the tick and the value, in one process and as a cluster alike."""
from outside import WAYS, OutsideTest


class State(OutsideTest):
    def functions(self, mode):
        return self.experiment(mode, functions=f'<state_functions id="asks" library="state_functions"><mode>{mode}</mode></state_functions>')

    def engine(self, mode, ticks=20, arena="", limit=""):
        file = self.experiment(mode, ticks=ticks, arena=arena,
                               entities="robot_two" if arena else "")
        text = file.read_text()
        start, end = text.index("<dummy_engine"), text.index("</dummy_engine>") + len("</dummy_engine>")
        text = text[:start] + f'<state_engine id="ground" library="state_engine"><mode>{mode}</mode></state_engine>' + text[end:]
        file.write_text(text.replace('optimization="2D"', f'optimization="2D" {limit}'))
        return file

    def fails(self, file, *words, ways=WAYS):
        for way, options in ways.items():
            with self.subTest(file=file.stem, way=way):
                done = self.run_experiment(file, *options)
                self.assertEqual(done.returncode, 4, done.stderr)
                for word in words:
                    self.assertIn(word, done.stderr)
                self.assertNotIn("finished:", done.stdout)

    def test_functions_are_refused_what_no_state_can_have(self):
        named = "experiment functions 'asks' (state_functions): PreStep at tick 5 failed: "
        one_process = {"one process": WAYS["one process"]}
        for mode, word, ways in [
                ("move_nan", "the footbot 'robot_one' has a pose with x = nan", WAYS),
                ("move_far", "would be at -1e+09, 1, 0, more than 100 m outside the arena", one_process),
                ("move_not_unit", "an orientation of norm 0.5", one_process),
                ("led_12", "the attribute 'led' of 'robot_one' has 12 elements, numbered from 0; there is no element 12", one_process),
                ("led_13", "there is no element 13", WAYS),
                ("led_far", "there is no element 100000000", one_process),
                ("led_negative", "there is no element -1", one_process),
                ("led_nan", "the attribute 'led' 0 of the footbot 'robot_one' is nan", one_process),
                ("gripped_far", "the attribute 'gripped' of the footbot 'robot_one' is 1000000", one_process)]:
            self.fails(self.functions(mode), named, word, ways=ways)

    def test_what_functions_may_do_is_the_same_both_ways(self):
        changed = self.functions("beacon")
        hashes = {way: self.hash_of(self.run_experiment(changed, *options)) for way, options in WAYS.items()}
        self.assertEqual(len(set(hashes.values())), 1, hashes)
        self.assertNotEqual(hashes["cluster"], self.hash_of(self.run_experiment(self.experiment(), "--single-process")))

    def test_an_engine_is_named_with_what_it_gave(self):
        named = "engine 'ground' (state_engine): Update at tick 4 failed: "
        one_process = {"one process": WAYS["one process"]}
        for mode, word, ways in [
                ("nan", "the footbot 'robot_one' has a pose with x = nan", WAYS),
                ("infinite", "the footbot 'robot_one' has a pose with y = inf", one_process),
                ("huge", "the footbot 'robot_one' left the world: it is at 1e+300, 1, 0", WAYS),
                ("fall", "it is at 1, 1, -300, more than 100 m outside the arena", one_process),
                ("nan_quaternion", "the footbot 'robot_one' has a pose with qw = nan", one_process),
                ("half_quaternion", "the footbot 'robot_one' has an orientation of norm 0.5", one_process),
                ("few_poses", "there are 3 numbers for the poses of 1 entities; there must be 7 for each, 7", WAYS),
                ("more_poses", "there are 7000 numbers", one_process),
                ("far_slot", "there is no attribute slot 1000000", one_process),
                ("presence", "the presence of the footbot 'robot_one' is 0", one_process),
                ("bad_grip", "the attribute 'gripped' of the footbot 'robot_one' is 1000000", one_process),
                ("throw", "it has had enough", one_process)]:
            self.fails(self.engine(mode), named, word, ways=ways)

    def test_an_engine_cannot_answer_for_another_or_another_tick(self):
        self.assertEqual(self.hash_of(self.run_experiment(self.engine("other_tick"), "--single-process")),
                         self.hash_of(self.run_experiment(self.engine("right_tick"), "--single-process")))

    def test_readings_of_an_engine_are_numbers(self):
        file = self.engine("nan_reading")
        text = file.read_text().replace("<sensors></sensors>", "<sensors><footbot_encoders>"
                                        "<implementation>engine_footbot_encoders</implementation></footbot_encoders></sensors>")
        file.write_text(text)
        self.fails(file, "engine 'ground' (state_engine): Update at tick 4 failed: the readings of the footbot 'robot_one' on the channel 'footbot_encoders' hold nan",
                   ways={"one process": WAYS["one process"]})

    def test_who_leaves_the_world_is_held_or_removed_the_same_way(self):
        second = '<footbot id="robot_two"><position>3,3,0</position><orientation>0,0,0</orientation></footbot>'
        ends = set()
        for policy, words in [("hold", "it is held where it was before"), ("remove", "it is removed")]:
            file = self.engine("fall", arena=second, limit=f'limit="50" beyond_limit="{policy}"')
            hashes, warnings = set(), set()
            for options in WAYS.values():
                done = self.run_experiment(file, "--output", f"{policy}{len(options)}", *options)
                hashes.add(self.hash_of(done))
                warnings.add(done.stderr)
            self.assertEqual(len(hashes), 1, policy)
            self.assertEqual(len(warnings), 1, "a cluster tells it as one process does")
            told = warnings.pop().splitlines()
            self.assertRegex(told[0], "^swarmanoid: warning: engine 'ground' at tick 4: the footbot 'robot_one' left the world at "
                             f"1, 1, -300, more than 50 m outside the arena; {words}$")
            self.assertEqual(len(told), 1, told)
            self.assertIn(told[0].split(": ", 2)[2], (self.folder / f"{policy}0" / "space_server.log").read_text())
            ends |= hashes
        self.assertEqual(len(ends), 2)

    def test_a_command_that_is_no_number_is_its_controllers_mistake(self):
        for engine in ["dummy_engine", "dynamics2d", "dynamics3d"]:
            self.commands(engine, "footbot_wheels", "dummy_footbot_wheels", WAYS if engine == "dummy_engine" else None)
        for device, implementation in [("footbot_turret", "dummy_footbot_turret"), ("footbot_gripper", "dummy_footbot_gripper")]:
            self.commands("dummy_engine", device, implementation)
        self.commands("dummy_engine", "footbot_preferential_direction", "led_ring_preferential_direction")

    def commands(self, engine, device, implementation, ways=None):
        file = self.experiment(f"{engine}_{device}", controller="state_commands", parameters=f"<actuator>{device}</actuator>",
                               actuators=f"<{device}><implementation>{implementation}</implementation></{device}>", engine=engine)
        if engine == "dynamics3d":
            file.write_text(file.read_text().replace("<perpendicular_axis>z</perpendicular_axis><distance>0</distance>", ""))
        self.fails(file, "robot 'robot_one'", device, "nan", "at tick 5", ways=ways or {"one process": WAYS["one process"]})
