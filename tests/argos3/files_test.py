"""Files that ARGoS3 reads although they have mistakes, or names that ours may not have."""
import re

from running import RunningTest

ARENA = '<box id="w" size="0.1,1,0.5" movable="false"><body position="0.5,0,0" orientation="0,0,0"/></box>'
SCRIPT = """function init() end
function step() log(robot.id, " ", robot.params.speed, " ", robot.random.poisson(3)) end
function reset() end
function destroy() end
"""
ROBOTS = """<lua_controller id="my robot"><actuators/><sensors/><params script="s.lua" speed="5 cm"/></lua_controller>"""


class Files(RunningTest):
    def file(self, arena=ARENA, controllers="", before='<?xml version="1.0"?>\n', behind="", name="x.argos"):
        file = self.folder / name
        file.write_bytes((before + f"""<argos-configuration>
<framework><experiment length="1" ticks_per_second="10" random_seed="1"/></framework>
<controllers>{controllers}</controllers>
<arena size="8,8,2" center="0,0,1">
{arena}
</arena>
<physics_engines><dynamics2d id="my engine"/></physics_engines>
<media/>{behind}
</argos-configuration>
""").encode("latin-1"))
        return file

    def test_what_tinyxml_reads_is_read_with_a_note(self):
        declaration = '<?xml version="1.0"?>\n'
        for changes, place, note in (
                ({"behind": "<!!-- off: <x/> --!>"}, "9:9", "what starts with '<!' here ends at the next '>'"),
                ({"before": "\n" + declaration}, "2:1", "the XML declaration is not at the start of the file"),
                ({"before": "<!-- mine -->\n" + declaration}, "2:1", "the XML declaration is not at the start of the file"),
                ({"before": declaration + declaration}, "2:1", "the XML declaration is not at the start of the file"),
                ({"before": declaration + "<!-- -- walls -- -->"}, "2:1", "the comment contains '--'"),
                ({"arena": ARENA.replace('" size', '"size')}, "6:12", "there is no blank before 'size' of <box>"),
                ({"arena": ARENA.replace('"w"', "w")}, "6:6", "the value of 'id' of <box> has no quotes"),
                ({"arena": "<!-- caf\u00e9 -->" + ARENA.replace('"w"', '"caf\u00e9"')}, "6:26", "a byte is not UTF-8 text"),
                ({"arena": ARENA.replace('"w"', '"a&b"')}, "6:11", "the '&' starts no character, and is left out")):
            result = self.swarmanoid("check", self.file(**changes))
            self.assertIn(f"x.argos:{place}: note: {note}", result.stderr)
        # The same content gives the same experiment.
        plain = self.swarmanoid("convert", self.file()).stdout
        self.assertEqual(self.swarmanoid("convert", self.file(arena=ARENA.replace('"w"', "w"))).stdout, plain)

    def test_what_tinyxml_refuses_is_refused(self):
        for arena in (ARENA.replace("</box>", "</bos>"), ARENA.replace('id="w"', 'id="w" id="v"'), ARENA.replace("/></box>", "></box>"),
                      ARENA.replace('"w"', 'w"')):
            self.assertRegex(self.swarmanoid("check", self.file(arena), code=3).stderr, r"/x\.argos:\d+:\d+: ")
        # A file of ours gets no forgiveness.
        (self.folder / "ours.xml").write_text("<ahss-config><framework a=1/></ahss-config>")
        self.swarmanoid("check", "ours.xml", code=3)

    def test_the_root_element_tells_what_a_file_is(self):
        (self.folder / "s.lua").write_text(SCRIPT)
        robot = '<foot-bot id="a"><body position="0,0,0" orientation="0,0,0"/><controller config="my robot"/></foot-bot>'
        hashes = {self.hash_of(self.file(robot, ROBOTS, name=name), *words)
                  for name in ("x.xml", "x.argos") for words in ((), ("--single-process",))}
        self.assertEqual(len(hashes), 1)

    def test_a_file_may_ask_for_real_time(self):
        def pace(*options):
            return float(re.search(r", ([0-9.]+)x real time", self.swarmanoid("run", file, "--single-process", *options).stdout)[1])

        file = self.file()
        file.write_text(file.read_text().replace('random_seed="1"', 'random_seed="1" real_time="true"'))
        self.assertLess(pace(), 1.3)
        self.assertLess(pace("--real-time", 3), 3.5)
        self.assertIn("keeps real time", self.swarmanoid("check", file).stderr)

    def test_distributed_foot_bots_need_room_for_their_bodies_alone(self):
        wall = '<box id="{}" size="4,0.1,0.5" movable="false"><body position="0,{},0" orientation="0,0,0"/></box>'
        group = """<distribute><position method="uniform" min="-1,-0.004,0" max="1,0.004,0"/><orientation method="constant" values="0,0,0"/>
<entity quantity="3" max_trials="100"><foot-bot id="fb"><controller config="my robot"/></foot-bot></entity></distribute>"""
        (self.folder / "s.lua").write_text(SCRIPT)
        # A body is 17 cm wide, and 20 cm with the reach of a gripper of our own experiments.
        for place, code in ((0.14, 0), (0.13, 3)):
            arena = wall.format("north", place) + wall.format("south", -place) + group
            said = self.swarmanoid("check", self.file(arena, ROBOTS), code=code).stderr
            self.assertEqual("does not fit" in said, code != 0, said)

    def test_buzz_is_refused_once_a_file(self):
        buzz = '<buzz_controller id="{}"><actuators/><sensors/><params bytecode_file="a.bo"/></buzz_controller>'
        robot = '<foot-bot id="{0}"><body position="0,{1},0" orientation="0,0,0"/><controller config="{0}"/></foot-bot>'
        file = self.file(controllers=buzz.format("a") + buzz.format("b"), arena=ARENA + robot.format("a", 1) + robot.format("b", 2))
        mistakes = [line for line in self.swarmanoid("check", file, code=3).stderr.splitlines() if line.startswith(str(file)) and "note" not in line]
        self.assertRegex(mistakes[0], r"x.argos:4:14: <buzz_controller> runs Buzz, which has no counterpart here; write the rule in Lua or C\+\+ \(also at 4:")
        self.assertEqual(mistakes[1:], [f"{file}: 1 error"])

    def test_a_floor_of_no_loop_functions_is_white(self):
        (self.folder / "s.lua").write_text("function step() log('grey ', robot.motor_ground[1].value) end")
        robot = '<floor id="f" source="loop_functions" pixels_per_meter="50"/>' \
                '<foot-bot id="a"><body position="0,0,0" orientation="0,0,0"/><controller config="l"/></foot-bot>'
        controller = '<lua_controller id="l"><actuators/><sensors><footbot_motor_ground implementation="rot_z_only"/></sensors>' \
                     '<params script="s.lua"/></lua_controller>'
        result = self.swarmanoid("run", self.file(robot, controller), "--single-process", "--output", "run")
        self.assertIn("robot 'a' at tick 10: grey 1", self.said_in("run"))
        self.assertIn("x.argos:6:1: note: without <loop_functions> the floor is white", result.stderr)

    def test_ids_may_have_any_characters(self):
        (self.folder / "s.lua").write_text("\ufeff" + SCRIPT, encoding="utf-8")
        robot = '<foot-bot id="{}"><body position="{},0,0" orientation="0,0,0"/><controller config="my robot"/></foot-bot>'
        group = '<distribute><position method="uniform" min="-3,1,0" max="3,3,0"/><orientation method="uniform" min="0,0,0" max="360,0,0"/>' \
                '<entity quantity="2" max_trials="99"><foot-bot id="fb"><controller config="my robot"/></foot-bot></entity></distribute>'
        ids = {"fb_0": "fb_0", "robot one": "robot_one", "robot/one": "robot_one.2", "fb#1": "fb_1", "fb7": "fb7"}
        robots = "".join(robot.format(name, x) for x, name in enumerate(ids, -2))
        stderr = self.swarmanoid("run", self.file(robots + group, ROBOTS), "--single-process", "--output", "run").stderr
        said = self.said_in("run")
        # The script sees ARGoS3's ids and parameters, our log has ours.
        for theirs, ours in {**ids, "fb0": "fb.2_0", "fb1": "fb.2_1"}.items():
            self.assertRegex(said, rf"robot '{ours}' at tick 10: {theirs} 5 cm \d+\n")
        for theirs in ("robot one", "robot/one", "fb#1"):
            self.assertIn(f"note: '{theirs}' has the id '{ids[theirs]}' in our tools", stderr)
        self.assertNotIn("'fb7' has the id", stderr)

    def test_numbers_are_read_as_in_argos3(self):
        arena = ARENA.replace("0.1,1,0.5", "0.1,1,0.5,9").replace("0.5,0,0", "-2.5,,0") + ARENA.replace('"w"', '"v"').replace("0.5,0,0", "-3.6.1,1m,0")
        result = self.swarmanoid("convert", self.file(arena))
        self.assertIn("'position' of <body> is '-2.5,,0', which is read as -2.5, 0, 0, as in ARGoS3", result.stderr)
        self.assertIn("x.argos:6:13: note: 'size' of <box> is '0.1,1,0.5,9', which is read as 0.1, 1, 0.5", result.stderr)
        # The arena's corner is our origin.
        self.assertIn('position="1.5, 4, 0.25"', result.stdout)
        self.assertIn('position="0.3999999999999999, 5, 0.25"', result.stdout)
        for wrong in ("1,2", "1 2 3x", ""):
            self.swarmanoid("check", self.file(ARENA.replace("0.5,0,0", wrong)), code=3)

    def test_a_mistake_is_told_once_and_without_what_follows_from_it(self):
        robot = '<drone id="k{}"><body position="{},0,0" orientation="0,0,0"/><controller config="k"/></drone>\n'
        controller = '<lua_controller id="k"><actuators/><sensors><drone_rangefinders implementation="default"/></sensors></lua_controller>' \
                     '<buzz_controller id="b"/>'
        result = self.swarmanoid("check", self.file("".join(robot.format(x, x) for x in range(8)), controller), code=3)
        mistakes = result.stderr.splitlines()
        self.assertEqual(len(mistakes), 3, result.stderr)
        self.assertRegex(mistakes[0], r"x\.argos:4:\d+: <buzz_controller> runs Buzz, which has no counterpart here")
        self.assertRegex(mistakes[1], r"x\.argos:6:1: <drone> has no counterpart; those that have: foot-bot, eye-bot"
                                      r".* \(also at 7:1, 8:1, 9:1, 10:1, 11:1 and 2 other places\)")
        self.assertRegex(mistakes[2], r"x\.argos: 2 errors")
