"""Experiments in ARGoS3's XML, with controllers and loop functions written for it."""
import math
import re
import shutil
import struct
import xml.etree.ElementTree
import zlib
from pathlib import Path

from running import HERE, RunningTest


class Experiments(RunningTest):
    def test_a_cluster_gives_the_hash_of_one_process(self):
        one = self.hash_of(HERE / "wander.argos", "--single-process", "--output", "one")
        cluster = self.hash_of(HERE / "wander.argos", "--controller-hosts", 2, "--output", "cluster")
        self.assertEqual(one, cluster)
        other = self.hash_of(HERE / "wander.argos", "--single-process", "--seed", 8, "--output", "other")
        self.assertNotEqual(one, other)

    def test_the_converted_file_gives_the_same_hash(self):
        self.swarmanoid("convert", HERE / "wander.argos", "--output", "wander.xml")
        self.assertIn(' radius="0.1" ', (self.folder / "wander.xml").read_text(), "numbers are as short as they may be")
        self.assertEqual(self.hash_of("wander.xml", "--single-process", "--output", "converted"),
                         self.hash_of(HERE / "wander.argos", "--single-process", "--output", "direct"))

    def test_a_floor_of_an_image_covers_the_arena(self):
        def chunk(kind, content):
            return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

        arena = '<arena size="4,4,1" center="0,0,0.5">'
        file = self.changed("wander.argos", (arena, arena + '<floor id="floor" source="image" path="floor.png"/>'))
        missing = self.swarmanoid("check", file, code=3)
        self.assertRegex(missing.stderr, r"wander.argos:\d+:\d+: .*floor.png")
        (self.folder / "floor.png").write_bytes(
            b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(b"\0\x40")) + chunk(b"IEND", b""))
        self.swarmanoid("convert", file, "--output", "wander.xml")
        patch = xml.etree.ElementTree.parse(self.folder / "wander.xml").find("arena/ground_patch")
        self.assertEqual(Path(patch.get("picture")).name, "floor.png")
        self.assertEqual([float(part) for part in patch.get("size").split(",")], [4, 4])
        self.assertEqual([float(part) for part in patch.get("position").split(",")], [2, 2, 0])
        self.swarmanoid("run", file, "--single-process", "--output", "run")

    def test_a_foot_bot_slides_along_a_wall_as_fast_as_in_argos3(self):
        # ARGoS3 at 421bd763: y is 0.134, 0.267 and 0.530 m after 2, 4 and 8 s.
        (self.folder / "scripts").symlink_to(HERE / "scripts")
        said = self.swarmanoid("run", HERE / "slide.argos", "--output", "run").stderr + self.said_in("run")
        y = [float(place) for place in re.findall(r"at [-\d.]+ ([-\d.]+)", said)]
        for second, there in ((2, 0.134), (4, 0.267), (8, 0.530)):
            self.assertAlmostEqual(y[10 * second - 1], there, delta=0.002)
        self.assertAlmostEqual((y[79] - y[39]) / 4, (0.530 - 0.267) / 4, delta=0.0003)

    def test_the_order_of_a_step(self):
        """Ten centimetres a second: a controller moves nothing before its first step, PreStep comes before the
        controllers and PostStep behind them, and both see the places that the controllers saw."""
        result = self.swarmanoid("run", HERE / "collect.argos", "--output", "run")
        self.assertIn("one process", result.stderr)
        lines = (self.folder / "collected.tsv").read_text().splitlines()
        self.assertIn("# crate 1.5,1.5,0 0.2,0.4,0.6", lines)
        self.assertEqual(lines[-1], "# moved 4")
        rows = [line.split("\t") for line in lines if not line.startswith("#")]
        self.assertEqual({row[2] for row in rows}, {"fb5", "fb6"})
        first = [row for row in rows if row[2] == "fb5"]
        self.assertEqual([row[:2] for row in first[:3]], [["0", "init"], ["1", "pre"], ["1", "post"]])
        for row in first[1:]:
            steps = int(row[0]) - (row[1] == "pre")
            self.assertEqual(int(row[3]), steps, row)
        # The controller at clock n saw what PostStep of n sees, entities moved in PreStep included.
        self.assertTrue(all(row[7] == "1" for row in first if row[1] == "post"))
        at = {int(row[0]): float(row[5]) for row in first if row[1] == "pre"}
        self.assertAlmostEqual(at[1], -0.5, places=9)
        # Motors need some ticks to get up to speed; then 1 cm a tick.
        self.assertAlmostEqual(at[30] - at[20], 0.1, places=3)
        # All four sensors are beyond x = -0.2 once the robot is 6.3 cm farther, none before it is as near.
        for row in first:
            if row[1] != "post":
                continue
            x = float(row[6])
            if x > -0.2 + 0.064:
                self.assertEqual(row[4], "4", row)
            if x < -0.2 - 0.064:
                self.assertEqual(row[4], "0", row)

    def test_controllers_are_out_of_reach_in_a_cluster(self):
        self.swarmanoid("convert", HERE / "collect.argos", "--output", "collect.xml")
        result = self.swarmanoid("run", "collect.xml", "--output", "cluster", code=4)
        self.assertIn("--single-process", result.stdout + result.stderr)

    def test_robots_leave_and_come_back(self):
        file = self.changed("collect.argos", ('label="collector"', 'label="keeper"'))
        self.swarmanoid("run", file, "--output", "run")
        rows = [line.split("\t") for line in (self.folder / "kept.tsv").read_text().splitlines()]
        self.assertEqual([(int(row[0]), int(row[1])) for row in rows],
                         [(clock, 1 if 3 < clock < 7 else 2) for clock in range(1, 11)])
        self.assertAlmostEqual(float(rows[0][2]), 0.5)
        self.assertAlmostEqual(float(rows[6][2]), 1.2)

    def test_ids_of_distributed_entities_are_those_of_argos3(self):
        """Two groups of one prefix, one without a prefix, and an empty one."""
        group = """<distribute>
            <position method="constant" values="{}"/><orientation method="constant" values="0,0,0"/>
            <entity quantity="{}" max_trials="1" base_num="{}"><foot-bot id="{}"><controller config="r"/></foot-bot></entity>
            </distribute>"""
        more = group.format("-1.5,0,0", 1, 7, "fb") + group.format("-1.5,1,0", 1, 3, "") + group.format("0,0,0", 0, 0, "no")
        file = self.changed("collect.argos", ("</arena>", more + "</arena>"))
        self.swarmanoid("run", file, "--output", "run")
        rows = [line.split("\t") for line in (self.folder / "collected.tsv").read_text().splitlines()]
        self.assertEqual({row[2] for row in rows if row[0] == "0"}, {"fb5", "fb6", "fb7", "3"})
        at = {row[2]: float(row[5]) for row in rows if row[0] == "0"}
        self.assertEqual((at["fb7"], at["3"], at["fb5"]), (-1.5, -1.5, -0.5))

    def test_ticks_are_parts_of_a_second(self):
        file = self.changed("wander.argos", ('ticks_per_second="10"', 'ticks_per_second="60"'))
        self.swarmanoid("convert", file, "--output", "wander.xml")
        framework = xml.etree.ElementTree.parse(self.folder / "wander.xml").find("framework")
        self.assertEqual((framework.get("clocktick"), framework.get("ticks_per_second"), framework.get("maxclock")),
                         (None, "60", "1201"))
        self.assertIn("1/60 s a tick, 1201 ticks", self.swarmanoid("check", file).stdout)
        file.write_text(file.read_text().replace('"60"', '"2000"'))
        self.assertIn("'ticks_per_second' is 2000; it must be from 1 to 1000", self.swarmanoid("check", file, code=3).stderr)

    def test_files_need_not_name_libraries_in_the_search_path(self):
        expected = self.hash_of(HERE / "collect.argos", "--output", "named")
        file = self.changed("collect.argos", ('<runner id="r" library="argos3_collector">', '<runner id="r">'),
                            ('<loop_functions library="argos3_collector" ', "<loop_functions "))
        self.assertEqual(self.hash_of(file, "--output", "unnamed"), expected)
        file.write_text(file.read_text().replace('label="collector"', 'label="kollektor"'))
        result = self.swarmanoid("check", file, code=3)
        self.assertRegex(result.stderr, r"collect\.argos:\d+:\d+: <loop_functions> has no 'library', and no library in the "
                                        r"folders of ARGOS_PLUGIN_PATH names 'kollektor'")

    def test_an_e_puck_senses_as_that_of_argos3(self):
        """A wall 6.5 cm ahead of the middle of a robot of radius 3.5 cm, with sensors at 17 and 50 degrees; black floor
        on the left."""
        self.swarmanoid("run", HERE / "puck.argos", "--output", "run")
        of = dict(re.findall(r"robot 'front' at tick 3: (\w+) (.*)", self.said_in("run")))
        distances = [(0.065 - 0.035 * math.cos(angle)) / math.cos(angle) for angle in (math.radians(17), math.radians(50))]
        near, far = (math.exp(-distance) for distance in distances)
        for read, expected in zip(map(float, of["generic"].split()), [near, far, 0, 0, 0, 0, far, near], strict=True):
            self.assertAlmostEqual(read, expected, places=5)
        own = [(float(angle), float(value)) for angle, value in re.findall(r"CDegrees\((\S+)\)=(\S+)", of["own"])]
        self.assertEqual([round(angle) for angle, _ in own], [17, 50, 90, 150, -150, -90, -50, -17])
        response = 298.701 * distances[0]**2 - 36.8961 * distances[0] + 1.08212
        for (_, value), expected in zip(own, [response, 0, 0, 0, 0, 0, 0, response], strict=True):
            self.assertAlmostEqual(value, expected, places=5)
        self.assertEqual(of["ground"], "1 1 0")
        # Messages of an e-puck have two bytes.
        self.assertEqual(of["leds"], "8 heard 2:7")
        self.assertIn("robot 'back' at tick 3: generic 0 0 0 0 0 0 0 0\n", self.said_in("run"))

    def test_loop_functions_reach_range_and_bearing(self):
        said = self.swarmanoid("run", HERE / "puck.argos", "--output", "run").stderr
        sends = re.findall(r"^sends (.*)", said, re.M)
        # Behind each step what the robot said in it; two bytes and 0.8 m are those of e-pucks.
        self.assertEqual(sends[1:4], ["0 7 of 2 as far as 0.8"] * 3)
        self.assertIn("\nset 200 200\n", said)
        self.assertIn("\nsensors 8 0.035 0.1 8 0.03,0.009\n", said)
        # Others hear what was set behind step 2 in step 3, and its controller says its own again then.
        self.assertRegex(self.said_in("run"), "robot 'back' at tick 3: leds 8 heard 2:200\n")
        self.assertRegex(self.said_in("run"), "robot 'front' at tick 3: leds 8 heard 2:7\n")
        for size in (1, 3):
            self.assertIn(f"messages of 'front' have 2 bytes, not {size}", said)
        self.assertIn("the range of 'front' is 0.8 m for the whole run, not 2; set rab_range in the experiment file", said)

    def test_an_e_puck_drives_in_a_cluster_as_in_one_process(self):
        file = self.changed("puck.argos", ('<loop_functions library="argos3_puck" label="puck_floor"/>', ""),
                            ('<floor id="floor" source="loop_functions" pixels_per_meter="10"/>', ""),
                            ('velocity="0"', 'velocity="5"'), ('position="-0.5,0,0"', 'position="-0.5,0.5,0"'))
        one = self.hash_of(file, "--single-process", "--output", "one")
        self.assertEqual(one, self.hash_of(file, "--output", "cluster"))
        self.swarmanoid("convert", file, "--output", "puck.xml")
        text = self.folder.joinpath("puck.xml").read_text().replace("</ahss-config>", """<visualisations>
            <text_render id="t" file="places.txt" precision="4"/></visualisations></ahss-config>""")
        (self.folder / "puck.xml").write_text(text)
        self.swarmanoid("run", "puck.xml", "--single-process", "--output", "shown")
        rows = [line.split("\t") for line in (self.folder / "shown/places.txt").read_text().splitlines()]
        x = {row[3]: float(row[4]) for row in rows if len(row) > 4 and row[2] == "EPuck"}
        # The arena starts at -1: 5 cm/s for 1.9 s to the left, and 3 cm until the wall stops it.
        self.assertAlmostEqual(x["back"], 0.5 - 0.095, delta=0.006)
        self.assertAlmostEqual(x["front"], 1.03, delta=0.002)

    def test_an_e_puck_need_not_command_its_wheels(self):
        wheels = '<actuators>\n        <differential_steering implementation="default"/>'
        self.swarmanoid("convert", self.changed("puck.argos", (wheels, "<actuators>"), ("<loop_functions library=\"argos3_puck\" label=\"puck_floor\"/>", ""),
                                                ('<floor id="floor" source="loop_functions" pixels_per_meter="10"/>', "")))

    def test_encoders_of_an_e_puck_read_what_its_wheels_were_told(self):
        self.swarmanoid("run", self.changed("puck.argos", ('velocity="0"', 'velocity="5"')), "--output", "run")
        # A step ago: 5 cm/s for 0.1 s, wheels 5.3 cm apart.
        rolled = re.findall(r"robot 'back' at tick \d+: rolled (.*)", self.said_in("run"))
        self.assertEqual(rolled[:3], ["0 0 0 0 5.3", "5 5 0.5 0.5 5.3", "5 5 0.5 0.5 5.3"])

    def test_what_others_do_not_have_is_refused(self):
        file = self.folder / "puck.argos"
        text = (HERE / "puck.argos").read_text().replace("e-puck id", "foot-bot id").replace("</e-puck>", "</foot-bot>")
        file.write_text(text)
        result = self.swarmanoid("check", file, code=3)
        self.assertRegex(result.stderr, r"puck\.argos:\d+:\d+: <ground> has no counterpart [^\n]*; take footbot_motor_ground")

    def test_loop_functions_add_robots_that_the_file_does_not_declare(self):
        self.swarmanoid("run", HERE / "make.argos", "--output", "run")
        lines = (self.folder / "made.tsv").read_text().splitlines()
        # In Init: three robots, the controller of the first, no place for the second where the first is, limits, ticks.
        self.assertEqual(lines[0], "# 3 made0 0 2,2,1 10")
        # Entities may be changed behind the last step, too.
        self.assertEqual(lines[-1], "# over green")
        rows = [line.split("\t") for line in lines[1:-1]]
        self.assertEqual([row[1] for row in rows], ["3"] * 3 + ["2"] * 3 + ["3"] * 4)
        for row in rows:
            clock = int(row[0])
            self.assertEqual(int(row[3]), clock)  # its steps
            self.assertAlmostEqual(float(row[2]), 0.01 * (clock - 1), places=4)  # the object that was added follows it
            # The can shows another colour from the step after it was given.
            # A lamp that loop functions made is near in step 4.
            self.assertEqual(row[4:7], ["1", "1" if clock == 4 else "0", "red"] if clock <= 5 else
                             ["0", "1", "blue"])
        # The place of one that left is taken by another, with a controller of its own.
        self.assertEqual(rows[5][7], "0")
        made = re.findall(r"(Init|Destroy) of (\w+)", self.said_in("run"))
        # They ask for the last controller first, before they add its robot.
        self.assertEqual(made[:5], [("Init", "made2"), ("Init", "made1"), ("Init", "made0"), ("Destroy", "made1"),
                                    ("Init", "late")])
        self.assertEqual(sorted(made[5:]), [("Destroy", "late"), ("Destroy", "made0"), ("Destroy", "made2")])

    def test_the_controller_of_a_robot_that_loop_functions_remove_is_destroyed_at_once(self):
        # At an end before another robot takes its place, the others are destroyed in the order of the reserve.
        self.swarmanoid("run", self.changed("make.argos", ('length="1"', 'length="0.4"')), "--output", "run")
        self.assertEqual(re.findall(r"Destroy of (\w+)", self.said_in("run")), ["made1", "made2", "made0"])

    def test_robots_that_loop_functions_add_come_to_an_end(self):
        result = self.swarmanoid("run", self.changed("make.argos", ('robots="3"', 'robots="101"')), "--output", "run", code=3)
        self.assertRegex(result.stdout + result.stderr, r"all 100 entities of the reserve 'added_m' [^\n]*`swarmanoid convert` writes")
        self.swarmanoid("convert", HERE / "make.argos", "--output", "make.xml")
        result = self.swarmanoid("run", "make.xml", "--output", "cluster", code=4)
        self.assertIn("--single-process", result.stdout + result.stderr)
        # Loop functions that make no robots keep none ready.
        self.assertNotIn("<reserve", self.swarmanoid("convert", HERE / "puck.argos").stdout)

    def test_the_kinematic_engine_may_stand_in_the_place_of_argos3s(self):
        file = self.changed("wander.argos", ('<dynamics2d id="dyn2d"/>', '<dummy_engine id="dyn2d"/>'))
        one = self.hash_of(file, "--single-process", "--output", "one")
        self.assertEqual(self.hash_of(file, "--controller-hosts", 2, "--output", "cluster"), one)
        self.assertNotEqual(self.hash_of(HERE / "wander.argos", "--single-process", "--output", "rigid"), one)
        converted = self.swarmanoid("convert", file).stdout
        self.assertIn('<dummy_engine id="dyn2d"', converted)
        self.assertNotIn("wheel_friction", converted)
        # What only a rigid engine has is refused, and so is an engine that nobody knows.
        friction = self.changed("wander.argos", ('<dynamics2d id="dyn2d"/>', '<dummy_engine id="dyn2d"><friction box_linear_friction="1"/></dummy_engine>'))
        self.assertRegex(self.swarmanoid("check", friction).stderr, r"wander\.argos:\d+:\d+: note: <friction>")
        unknown = self.changed("wander.argos", ('<dynamics2d id="dyn2d"/>', '<physx id="dyn2d"/>'))
        self.assertRegex(self.swarmanoid("check", unknown, code=3).stderr, r"<physx> has no counterpart; .* dummy_engine")

    def test_what_has_no_counterpart_is_named_with_its_place(self):
        file = self.changed("wander.argos", ("<footbot_proximity ", "<footbot_proximty "),
                            ("<cylinder id=\"pillar\"", "<prototype id=\"pillar\""),
                            ("</cylinder>", "</prototype>"))
        text = file.read_text()
        result = self.swarmanoid("check", file, code=3)
        for word, message in (("<footbot_proximty", "did you mean 'footbot_proximity'?"),
                              ("<prototype", "<prototype> has no counterpart")):
            offset = text.index(word)
            line = text.count("\n", 0, offset) + 1
            column = offset - text.rfind("\n", 0, offset) + (word[0] == "<")
            self.assertRegex(result.stderr, rf"wander\.argos:{line}:({column}|{column - 1}): [^\n]*{re.escape(message)}")

    def test_a_library_that_is_not_there(self):
        file = self.changed("wander.argos", ("libargos3_wanderer.so", "build/libnone.so"))
        result = self.swarmanoid("check", file, code=3)
        self.assertRegex(result.stderr, r"wander\.argos:8:\d+: the library 'build/libnone.so' is not found")
        self.assertIn("ARGOS_PLUGIN_PATH", result.stderr)
        searched = [line.strip() for line in result.stderr.partition("searched:\n")[2].splitlines() if line.startswith("    ")]
        self.assertIn(f"{self.folder}/build/libnone.so", searched)
        self.assertIn(f"{self.folder}/build/liblibnone.so.so", searched)
        self.assertEqual(len(searched), len(set(searched)))

    def test_mistakes_of_parameters_name_their_place(self):
        result = self.swarmanoid("check", self.changed("wander.argos", ('velocity="5"', 'speed="5"')), code=3)
        self.assertRegex(result.stderr, r"wander\.argos:18:\d+: [^\n]*<params> has no attribute 'velocity'")
        result = self.swarmanoid("check", self.changed("wander.argos", ('velocity="5"', 'velocity="fast"')), code=3)
        self.assertIn("'fast' is not of the type", result.stderr)

    def test_labels_are_those_of_the_library(self):
        file = self.changed("wander.argos", ("<wanderer id", "<wonderer id"), ("</wanderer>", "</wonderer>"))
        result = self.swarmanoid("check", file, code=3)
        self.assertIn("registers no controller 'wonderer'", result.stderr)
        self.assertIn("did you mean 'wanderer'?", result.stderr)

    def in_lua(self, script, devices=None):
        """wander.argos, whose robots are controlled by a script."""
        text = (HERE / "wander.argos").read_text()
        head, rest = text.split('<wanderer id="w" library="libargos3_wanderer.so">')
        own, tail = rest.split("</wanderer>")
        own = re.sub(r"<params.*</params>", f'<params script="{script}"/>', own, flags=re.DOTALL)
        file = self.folder / "lua.argos"
        file.write_text(f'{head}<lua_controller id="w">{devices + own[own.index("<params"):] if devices else own}</lua_controller>{tail}')
        return file

    def test_without_a_script_robots_stand_still(self):
        file = self.in_lua("")
        file.write_text(file.read_text().replace('<params script=""/>', "<params/>"))
        result = self.swarmanoid("check", file)
        self.assertRegex(result.stderr, r"lua\.argos:\d+:\d+: note: without <params script=.* its robots do nothing")
        self.swarmanoid("run", file, "--single-process", "--output", "run")

    def test_a_script_does_what_the_same_rule_in_cpp_does(self):
        shutil.copytree(HERE / "scripts", self.folder / "scripts")
        file = self.in_lua("scripts/wanderer.lua")
        expected = self.hash_of(HERE / "wander.argos", "--single-process", "--output", "cpp")
        self.assertEqual(self.hash_of(file, "--single-process", "--output", "one"), expected)
        self.assertEqual(self.hash_of(file, "--controller-hosts", 3, "--output", "cluster"), expected)
        self.swarmanoid("convert", file, "--output", "lua.xml")
        self.assertEqual(self.hash_of("lua.xml", "--single-process", "--output", "converted"), expected)

    def test_a_script_starts_programs_and_writes_files_only_if_the_user_trusts_it(self):
        shutil.copytree(HERE / "scripts/modules", self.folder / "modules")
        shutil.copy(HERE / "scripts/limits.lua", self.folder)
        (self.folder / "link_to_passwd").symlink_to("/etc/passwd")
        (self.folder / "trusted.lua").write_text("return false\n")
        file = self.in_lua("limits.lua")
        self.swarmanoid("check", file)
        self.swarmanoid("run", file, "--single-process", "--ticks", 2, "--output", "limited")
        self.assertFalse((self.folder / "made_by_the_script").exists())
        (self.folder / "trusted.lua").write_text("return true\n")
        self.assertRegex(self.swarmanoid("check", file, code=3).stderr, r"limits\.lua:\d+: os\.execute is not for scripts unless .*--trust")
        self.swarmanoid("check", file, "--trust")
        for words in (["--single-process"], ["--controller-hosts", 1]):
            (self.folder / "made_by_the_script").unlink()
            self.swarmanoid("run", file, "--trust", "--ticks", 2, "--output", "trusted" + words[0], *words)
            self.assertTrue((self.folder / "made_by_the_script").exists(), words)

    def test_what_lua_leaves_open_is_the_same_in_every_process(self):
        shutil.copy(HERE / "scripts/order.lua", self.folder)
        file = self.in_lua("order.lua")
        hashes = {self.hash_of(file, "--single-process", "--output", f"one{i}") for i in range(3)}
        hashes.add(self.hash_of(file, "--controller-hosts", 2, "--output", "cluster"))
        self.assertEqual(len(hashes), 1, hashes)
        self.assertNotIn(self.hash_of(file, "--single-process", "--seed", 8, "--output", "other"), hashes)
        # Robots with seeds of their own.
        said = "".join(log.read_text() for log in (self.folder / "cluster").glob("controller_host-*.log"))
        sums = set(re.findall(r"sum\t(\d+)", said))
        self.assertEqual(len(sums), 12)

    def test_a_sensor_of_a_script_is_read_from_its_first_use_on(self):
        shutil.copy(HERE / "scripts/first_use.lua", self.folder)
        devices = """<actuators><differential_steering/></actuators><sensors><footbot_proximity/><footbot_light implementation="rot_z_only"/>
            <positioning/><battery/></sensors>""".replace("/>", ' implementation="default"/>', 1)
        file = self.in_lua("first_use.lua", re.sub(r"<(footbot_proximity|positioning|battery)/>", r'<\1 implementation="default"/>', devices))
        text = re.sub(r"<distribute>.*</distribute>", "", file.read_text(), flags=re.DOTALL)
        file.write_text(text.replace("</arena>", '<foot-bot id="a"><body position="-1,-1,0" orientation="0,0,0"/><controller config="w"/></foot-bot></arena>'))
        one = self.hash_of(file, "--single-process", "--ticks", 10, "--output", "one")
        said = self.said_in("one")
        x = float(re.search(r"x (\S+) steps 8", said).group(1))
        self.assertTrue(-1 < x < -0.9, x)
        self.assertIn("fields battery id light own params positioning proximity random wheels", said)
        self.assertEqual(self.hash_of(file, "--controller-hosts", 2, "--ticks", 10, "--output", "cluster"), one)

    def test_the_devices_of_a_script(self):
        shutil.copy(HERE / "scripts/devices.lua", self.folder)
        devices = """<actuators><differential_steering implementation="default"/><leds implementation="default" medium="leds"/>
            <range_and_bearing implementation="default"/><footbot_turret implementation="default"/><footbot_gripper implementation="default"/></actuators>
            <sensors><differential_steering implementation="default"/><footbot_proximity implementation="default"/><footbot_light implementation="rot_z_only"/>
            <footbot_motor_ground implementation="rot_z_only"/><footbot_base_ground implementation="rot_z_only"/><positioning implementation="default"/>
            <battery implementation="default"/><footbot_turret_encoder implementation="default"/>
            <range_and_bearing implementation="medium" medium="rab"/><colored_blob_omnidirectional_camera implementation="rot_z_only" medium="leds"/></sensors>"""
        file = self.in_lua("devices.lua", devices)
        # Two robots on a line, 0.5 m apart, and a wall behind the other one; both look along it.
        text = re.sub(r"<distribute>.*</distribute>", "", file.read_text(), flags=re.DOTALL)
        robots = "".join(f'<foot-bot id="{name}"><body position="{x},-1,0" orientation="0,0,0"/><controller config="w"/></foot-bot>' for name, x in (("a", -1), ("b", -0.5)))
        file.write_text(text.replace("</arena>", robots + "</arena>"))
        self.swarmanoid("run", file, "--output", "run")
        said = "".join(log.read_text() for log in (self.folder / "run").glob("controller_host*.log"))
        of = {name: re.search(rf": a {name} (.*)", said).group(1) for name in
              ("wheels", "proximity", "light", "motor_ground", "base_ground", "positioning", "battery", "turret", "range_and_bearing", "colored_blob_omnidirectional_camera")}
        self.assertRegex(of["wheels"], r"^\{axis_length=14 distance_left=1 distance_right=1 velocity_left=10 velocity_right=10\}$")
        self.assertEqual(len(re.findall(r"\{angle=\S+ value=0\}", of["proximity"])), 24)
        self.assertIn("24={angle=-0.1309 value=0}", of["proximity"])
        self.assertEqual(len(re.findall("angle=", of["light"])), 24)
        self.assertRegex(of["motor_ground"], r"^\{1=\{offset=\{x=6.3 y=1.16\} value=[01.]+\} 2=")
        self.assertEqual(len(re.findall("offset=", of["base_ground"])), 8)
        x, y = map(float, re.search(r"position=\{(\S+),(\S+),\S+\}", of["positioning"]).groups())
        self.assertAlmostEqual(y, -1, places=3)
        self.assertTrue(-1 < x < -0.89, x)
        self.assertRegex(of["positioning"], r"orientation=\{0,0,0\}")
        self.assertRegex(of["battery"], r"^\{available_charge=\S+ time_left=\S+\}$")
        # In ten ticks, each with 0.4 of the rest of the angle as its speed and 0.2 of the change of the rest against it.
        angle = before = 0
        for _ in range(10):
            error = 0.5 - angle
            angle, before = angle + 0.1 * (0.4 * error + 0.2 * (error - (before or error)) / 0.1), error
        self.assertAlmostEqual(float(re.search(r"rotation=(\S+)\}", of["turret"]).group(1)), angle, places=3)
        # 300 is 44 in a byte. The other one is ahead.
        self.assertRegex(of["range_and_bearing"], r"^\{1=\{data=\{1=1 2=2 3=3 4=4 5=5 6=6 7=7 8=8 9=9 10=44\} horizontal_bearing=0 range=50 vertical_bearing=0\}\}$")
        # The beacon, and the LEDs of the ring on this side.
        blobs = re.findall(r"angle=(\S+) color=\{blue=0 green=255 red=0\} distance=(\S+)\}", of["colored_blob_omnidirectional_camera"])
        self.assertEqual((len(blobs), blobs[0]), (8, ("0", "50")))
        self.assertRegex(said, r": b range_and_bearing .*horizontal_bearing=-?3.14159 range=50 ")
        self.assertRegex(said, r": a ends after 200 steps true")

    def test_a_script_turns_the_distance_scanner(self):
        """A wall 15 cm ahead of the body, another 50 cm to its left; the head turns half a turn a second."""
        shutil.copy(HERE / "scripts/scanner.lua", self.folder)
        file = self.in_lua("scanner.lua", """<actuators><footbot_distance_scanner implementation="default"/></actuators>
            <sensors><footbot_distance_scanner implementation="rot_z_only" noise_range="0:0"/></sensors>""")
        text = re.sub(r"<distribute>.*</distribute>|<cylinder.*</cylinder>", "", file.read_text(), flags=re.DOTALL)
        walls = "".join(f'<box id="{name}" size="{size},0.5" movable="false"><body position="{at},0" orientation="0,0,0"/></box>'
                        for name, size, at in (("ahead", "0.1,1", "0.285036758,0"), ("left", "1,0.1", "0,0.635036758")))
        file.write_text(text.replace("</arena>", walls + """<foot-bot id="a"><body position="0,0,0" orientation="0,0,0"/>
            <controller config="w"/></foot-bot></arena>"""))
        self.swarmanoid("run", file, "--single-process", "--output", "run")
        said = re.findall(r"robot 'a' at tick \d+: (\w+) (.*)", self.said_in("run"))
        self.assertEqual(said[0], ("off", "0 0"))
        turning = [tuple(map(float, text.split())) for word, text in said if word == "turning"]
        self.assertEqual(len(turning), 12)
        step = math.pi / 60
        for number, (angle, _) in enumerate(turning[:6]):
            # Of the short beams that which looks ahead is the second one in the order of angles, from the second tick on.
            self.assertAlmostEqual(angle, -math.pi + (6 + number) * step, places=3)
        for angle, distance in turning[6:]:
            self.assertAlmostEqual(distance, 100 * (0.235036758 / math.cos(angle) - 0.085036758), places=2)
        still = {text for word, text in said if word == "still"}
        self.assertEqual(still, {"0 15", "3.1416 -2", "-1.5708 -2", "1.5708 50"})

    def test_mistakes_in_a_script_are_named_with_file_and_line(self):
        file = self.in_lua("mine.lua")
        self.assertRegex(self.swarmanoid("check", file, code=3).stderr, r"lua\.argos:\d+:\d+: the script 'mine.lua' is not found; .*searched:\n\s+\S+/mine.lua")
        script = self.folder / "mine.lua"
        for text, says in (("function step()\n  x = = 1\nend\n", r"mine\.lua:2: unexpected symbol near '='"),
                           ("function init() end\n", r"mine\.lua: the script has no function step\(\)"),
                           ("function step() end\nfunction init()\n  robot.wheels.set_velocity(1)\nend\n", r"mine\.lua:3: 1 values are given, and 2 are needed"),
                           ("function step() end\nrobot.leds.set_all_colors('redd')\n", r"mine\.lua:2: .*redd"),
                           ("function step() end\nrobot.camera.enable()\n", r"mine\.lua:2: attempt to index a nil value \(field 'camera'\)")):
            script.write_text(text)
            self.assertRegex(self.swarmanoid("check", file, code=3).stderr, says)
        script.write_text("function step()\n  if robot.random.uniform() < 2 then\n    robot.range_and_bearing.set_data(11, 0)\n  end\nend\n")
        for words in (["--single-process"], []):
            result = self.swarmanoid("run", file, *words, "--output", "run" + str(len(words)), code=4)
            self.assertRegex(result.stderr, r"robot 'fb_0', controller 'w': ControlStep at tick 1 failed: mine\.lua:3: there is no byte 11; they are 1 to 10")
