"""Experiments for which ARGoS3 421bd763 was run beside: the numbers are its own."""
import math
import re

from running import RunningTest

SCRIPTS = {
    "hear": """function step()
  robot.range_and_bearing.set_data(1, 7)
  log("hears ", #robot.range_and_bearing)
end""",
    "talk": """n = 0
function step()
  n = n + 1
  robot.range_and_bearing.set_data(1, 7)
  log("talks")
end""",
    "see": """function init() robot.colored_blob_omnidirectional_camera.enable() end
function step()
  if beacon then robot.leds.set_single_color(13, "yellow") else robot.leds.set_all_colors("yellow") end
  log("sees ", #robot.colored_blob_omnidirectional_camera)
end""",
    "beacon": "beacon = true\n",
    "common": 'function step() log("common") end',
    "leader": 'function step() log("leader") end',
    "battery": """function step()
  robot.wheels.set_velocity(10, 5)
  log(string.format("charge %.4f", robot.battery.available_charge))
end""",
    "grip": """n = 0
function step()
  n = n + 1
  local v = n < 15 and 10 or -10
  robot.wheels.set_velocity(v, v)
  if n > 10 then robot.gripper.lock_positive() end
  log(string.format("x %.3f, ahead %.2f", robot.positioning.position.x, robot.proximity[1].value))
end""",
    "push": """function step()
  robot.wheels.set_velocity(10, 10)
  local p = robot.positioning.position
  log(string.format("at %.3f %.3f %.1f", p.x, p.y, math.deg(robot.positioning.orientation:toeulerangles())))
end""",
    "where": """function step()
  local p = robot.positioning.position
  log(string.format("at %.3f %.3f %.1f", p.x, p.y, math.deg(robot.positioning.orientation:toeulerangles())))
end""",
    "turn": """function step()
  robot.turret.set_speed_control_mode()
  robot.turret.set_rotation_speed(10)
  log(string.format("turret %.4f", robot.turret.rotation))
end""",
}
SCRIPTS["beacon"] += SCRIPTS["see"]
ACTUATORS = {"leds": ' medium="leds"'}
SENSORS = {"range_and_bearing": ("medium", ' medium="rab"'),
           "colored_blob_omnidirectional_camera": ("rot_z_only", ' medium="leds"')}


def devices(actuators, sensors):
    def sensor(tag):
        implementation, more = SENSORS.get(tag, ("default", ""))
        return f'<{tag} implementation="{implementation}"{more}/>'
    return ("<actuators>" + "".join(f'<{tag} implementation="default"{ACTUATORS.get(tag, "")}/>' for tag in actuators.split()) +
            "</actuators><sensors>" + "".join(map(sensor, sensors.split())) + "</sensors>")


def foot_bot(name, x=0.0, y=0.0, attributes="", controller="", more="", config="l"):
    return (f'<foot-bot id="{name}" {attributes}><body position="{x},{y},0" orientation="0,0,0"/>'
            f'<controller config="{config}">{controller}</controller>{more}</foot-bot>')


class BesideArgos3(RunningTest):
    def file(self, script, actuators, sensors, arena, media='<led id="leds"/><range_and_bearing id="rab"/>', seconds=1,
             engine="", configs="l", name="x.argos", ticks=10):
        for scripted, text in SCRIPTS.items():
            (self.folder / f"{scripted}.lua").write_text(
                ("" if "function init" in text else "function init() end\n") + text + "\nfunction reset() end\nfunction destroy() end\n")
        controllers = "".join(f'<lua_controller id="{config}">{devices(actuators, sensors)}<params script="{script}.lua"/></lua_controller>'
                              for config in configs)
        file = self.folder / name
        file.write_text(f"""<?xml version="1.0"?>
<argos-configuration>
<framework><system threads="0"/><experiment length="{seconds}" ticks_per_second="{ticks}" random_seed="1"/></framework>
<controllers>{controllers}</controllers>
<arena size="8,8,2" center="0,0,1">{arena}</arena>
<physics_engines><dynamics2d id="d">{engine}</dynamics2d></physics_engines>
<media>{media}</media>
</argos-configuration>""")
        return file

    runs = 0

    def said(self, *words, **more):
        self.runs += 1
        folder = f"run_{self.runs}"
        result = self.swarmanoid("run", self.file(*words, **more), "--single-process", "--output", folder)
        said = {}
        for robot, text in re.findall(r"robot '(\w+)' at tick \d+: (.*)", self.said_in(folder)):
            said.setdefault(robot, []).append(text)
        return said, result.stderr

    def test_the_range_of_a_message_is_that_of_its_sender(self):
        for of_a, of_b, heard in ((0.5, 5, (1, 0)), (5, 0.5, (0, 1)), (5, 5, (1, 1)), (0.5, 0.5, (0, 0))):
            for config in "lm":  # a controller for both, or one for each
                arena = (foot_bot("a", attributes=f'rab_range="{of_a}"') +
                         foot_bot("b", 1, attributes=f'rab_range="{of_b}"', config=config))
                said, _ = self.said("hear", "range_and_bearing", "range_and_bearing", arena, configs="lm")
                self.assertEqual((said["a"][-1], said["b"][-1]), tuple(f"hears {n}" for n in heard), (of_a, of_b, config))

    def test_a_medium_may_let_messages_through_walls(self):
        wall = '<box id="w" size="0.05,3,1" movable="false"><body position="0.5,0,0" orientation="0,0,0"/></box>'
        arena = wall + foot_bot("a") + foot_bot("b", 1)
        for checks, heard in (("", 0), ('check_occlusions="true"', 0), ('check_occlusions="false"', 1)):
            said, _ = self.said("hear", "range_and_bearing", "range_and_bearing", arena,
                                media=f'<range_and_bearing id="other"/><range_and_bearing id="rab" {checks}/>')
            self.assertEqual((said["a"][-1], said["b"][-1]), (f"hears {heard}", f"hears {heard}"), checks)

    def test_messages_stay_in_their_medium_and_have_their_size(self):
        """ARGoS3's robots hear robots of their medium with messages of their size."""
        arena = (foot_bot("a") + foot_bot("b", 0.3, config="m") + foot_bot("c", 0.6) + foot_bot("d", 0.9, config="m") +
                 foot_bot("e", 1.2, attributes='rab_data_size="4"') + foot_bot("f", 1.5, attributes='rab_data_size="4"'))
        file = self.file("hear", "range_and_bearing", "range_and_bearing", arena, configs="lm",
                         media='<range_and_bearing id="rab" check_occlusions="false"/><range_and_bearing id="far" check_occlusions="false"/>')
        first, second = file.read_text().split('<lua_controller id="m"')
        file.write_text(first + '<lua_controller id="m"' + second.replace('medium="rab"', 'medium="far"', 1))
        self.swarmanoid("run", file, "--single-process", "--output", "run")
        said = self.said_in("run")
        for robot in "abcdef":
            self.assertIn(f"robot '{robot}' at tick 10: hears 1", said)

    def test_a_robot_without_the_receiver_is_not_heard(self):
        file = self.file("talk", "range_and_bearing", "", foot_bot("a") + foot_bot("b", 0.5, config="m"), configs="lm")
        hears = devices("range_and_bearing", "range_and_bearing")
        first, second = file.read_text().split('<lua_controller id="m">')
        second = second.replace(devices("range_and_bearing", ""), hears).replace("talk.lua", "hear.lua")
        file.write_text(first + '<lua_controller id="m">' + second)
        stderr = self.swarmanoid("run", file, "--single-process", "--output", "run").stderr
        self.assertIn("robot 'b' at tick 10: hears 0", self.said_in("run"))
        self.assertRegex(stderr, r"x\.argos:\d+:\d+: note: without the sensor <range_and_bearing> .* no robot hears them")

    def test_parameters_at_a_robot_replace_those_of_its_controller(self):
        arena = foot_bot("a", controller='<params script="leader.lua"/>') + foot_bot("b", 1)
        said, _ = self.said("common", "differential_steering", "", arena)
        self.assertEqual((set(said["a"]), set(said["b"])), ({"leader"}, {"common"}))

    def test_robots_of_a_distribution_have_attributes_of_their_own(self):
        of = '<distribute><position method="constant" values="{0},0,0"/><orientation method="constant" values="0,0,0"/>' \
             '<entity quantity="1" max_trials="1"><foot-bot id="{1}" rab_range="{2}"><controller config="l"/></foot-bot></entity></distribute>'
        said, _ = self.said("hear", "range_and_bearing", "range_and_bearing", of.format(0, "a", 0.5) + of.format(1, "b", 5))
        self.assertEqual((said["a_0"][-1], said["b_0"][-1]), ("hears 1", "hears 0"))

    def test_apertures_are_of_one_robot(self):
        arena = foot_bot("a", attributes='omnidirectional_camera_aperture="50"') + foot_bot("b", 0.5)
        said, _ = self.said("beacon", "leds", "colored_blob_omnidirectional_camera", arena)
        # 0.2887 m tan 50 degrees is 0.34 m.
        self.assertEqual((said["a"][-1], said["b"][-1]), ("sees 0", "sees 1"))

    def test_the_omnidirectional_camera_sees_a_square_at_every_height(self):
        for x, y, beacons, least, most in ((0.3, 0, 1, 7, 8), (0.5, 0, 1, 7, 8), (0.7, 0, 1, 7, 7), (0.78, 0.78, 1, 1, 8), (0.8, 0, 0, 0, 6)):
            arena = foot_bot("a") + foot_bot("b", x, y)
            said, _ = self.said("beacon", "leds", "colored_blob_omnidirectional_camera", arena)
            self.assertEqual(said["a"][-1], f"sees {beacons}", (x, y))
            said, _ = self.said("see", "leds", "colored_blob_omnidirectional_camera", arena)
            for robot in "ab":
                self.assertTrue(least <= int(said[robot][-1].split()[1]) <= most, (x, y, robot, said[robot][-1]))

    def test_movable_boxes_are_gripped(self):
        leds = '<leds medium="leds"><led offset="0,0,0.2" anchor="origin" color="red"/></leds>'
        body = '<body position="0.25,0,0" orientation="0,0,0"/>'
        for thing in (f'<box id="w" size="0.2,0.2,0.2" movable="true" mass="1">{body}</box>',
                      f'<box id="w" size="0.2,0.2,0.2" movable="true" mass="1">{body}{leds}</box>',
                      f'<cylinder id="w" radius="0.1" height="0.2" movable="true" mass="1">{body}</cylinder>'):
            said, _ = self.said("grip", "differential_steering footbot_gripper footbot_turret", "footbot_proximity positioning",
                                thing + foot_bot("a"), seconds=6)
            x, ahead = map(float, re.match(r"x (\S+), ahead (\S+)", said["a"][-1]).groups())
            self.assertGreater(ahead, 0.5, thing)
            self.assertAlmostEqual(x, -0.3, delta=0.05)

    def test_the_ground_resists_a_movable_thing_whatever_its_mass(self):
        for mass, x in ((1, 0.789), (5, 0.788), (100, 0.753)):
            box = f'<box id="w" size="0.2,0.2,0.2" movable="true" mass="{mass}"><body position="0.3,0,0" orientation="0,0,0"/></box>'
            said, _ = self.said("push", "differential_steering", "positioning", box + foot_bot("a"), seconds=8)
            self.assertAlmostEqual(float(said["a"][-1].split()[1]), x, delta=0.02, msg=mass)
        # Nothing moves a box that the ground holds with more than the motors have.
        said, _ = self.said("push", "differential_steering", "positioning", box.replace("100", "1") + foot_bot("a"), seconds=8,
                            engine='<friction box_linear_friction="20"/>')
        self.assertLess(float(said["a"][-1].split()[1]), 0.13)

    def test_batteries_have_the_attributes_of_their_model(self):
        for battery, charges in (('discharge_model="time" delta="0.002"', (0.4940, 0.4600, 0.3800)),
                                 ('delta="0.002"', (0.4940, 0.4600, 0.3800)),
                                 ('discharge_model="time_motion" time_factor="0.001" pos_factor="0.1" orient_factor="0.01"', (0.4949, 0.4591, 0.3748)),
                                 # The same without the part of time.
                                 ('discharge_model="motion" pos_delta="0.1" orient_delta="0.01"', (0.4979, 0.4791, 0.4348))):
            said, stderr = self.said("battery", "differential_steering", "battery",
                                     foot_bot("a", more=f'<battery start_charge="0.5" {battery}/>'), seconds=8)
            for tick, charge in zip((3, 20, 60), charges):
                self.assertAlmostEqual(float(said["a"][tick - 1].split()[1]), charge, delta=3e-4, msg=battery)
            self.assertNotIn("no effect", stderr)
        _, stderr = self.said("battery", "differential_steering", "battery", foot_bot("a", more='<battery factor="0.002"/>'))
        self.assertRegex(stderr, r"x\.argos:\d+:\d+: note: 'factor' of <battery> has no effect here")

    def test_grids_begin_at_the_largest_coordinates(self):
        grid = '<distribute><position method="grid" center="{}" distances="{}" layout="{}"/>{}' \
               '<entity quantity="{}" max_trials="10"><foot-bot id="fb"><controller config="l"/></foot-bot></entity></distribute>'
        north = '<orientation method="constant" values="90,0,0"/>'
        said, _ = self.said("where", "differential_steering", "positioning", grid.format("1,2,0", "0.5,0.7,0", "3,2,1", north, 5))
        at = {robot: tuple(map(float, lines[0].split()[1:])) for robot, lines in said.items()}
        self.assertEqual(at, {"fb_0": (1.5, 2.35, 90), "fb_1": (1, 2.35, 90), "fb_2": (0.5, 2.35, 90), "fb_3": (1.5, 1.65, 90), "fb_4": (1, 1.65, 90)})
        headings = '<orientation method="grid" center="0,0,0" distances="30,0,0" layout="4,1,1"/>'
        said, _ = self.said("where", "differential_steering", "positioning", grid.format("0,0,0", "0.5,0.5,0", "2,2,1", headings, 4))
        self.assertEqual([float(said[f"fb_{i}"][0].split()[3]) for i in range(4)], [45, 15, -15, -45])

    def test_dynamics2d_keeps_the_heading_of_what_is_tilted(self):
        tilted = '<distribute><position method="constant" values="2,0,0"/><orientation method="constant" values="30,20,10"/>' \
                 '<entity quantity="1" max_trials="1"><foot-bot id="fb"><controller config="l"/></foot-bot></entity></distribute>'
        arena = foot_bot("a").replace('orientation="0,0,0"', 'orientation="30,20,10"') + tilted
        said, stderr = self.said("where", "differential_steering", "positioning", arena)
        for robot in ("a", "fb_0"):
            self.assertEqual(said[robot][0].split()[3], "30.0", robot)
        self.assertRegex(stderr, r"x\.argos:\d+:\d+: note: dynamics2d keeps the heading alone")

    def test_boxes_are_tilted_at_random(self):
        box = '<distribute><position method="uniform" min="-3,-3,1" max="3,3,1"/><orientation method="uniform" min="0,0,0" max="360,60,0"/>' \
              '<entity quantity="40" max_trials="100"><box id="b" size="0.1,0.1,0.1" movable="false"/></entity></distribute>'
        file = self.file("common", "differential_steering", "", box)
        file.write_text(file.read_text().replace("dynamics2d", "pointmass3d"))
        converted = self.swarmanoid("convert", file).stdout
        self.assertIn('<orientation method="uniform" axes="zyx" min="0, 0, 0" max="360, 60, 0"/>', converted)
        self.swarmanoid("check", file)

    def test_a_turret_turns_by_revolutions_a_minute(self):
        said, _ = self.said("turn", "footbot_turret", "footbot_turret_encoder", foot_bot("a"), seconds=1)
        # 10 of them, for nine ticks.
        self.assertAlmostEqual(float(said["a"][-1].split()[1]), 0.9 * 10 * 2 * math.pi / 60, delta=0.11)

    def test_ticks_are_parts_of_a_second(self):
        for ticks in (10, 30, 60):
            said, _ = self.said("push", "differential_steering", "positioning", foot_bot("a"), seconds=4, ticks=ticks)
            self.assertEqual(len(said["a"]), 4 * ticks)
            # Steps before the last one moved it by 10 cm/s; the start from rest costs less than 2 mm.
            self.assertAlmostEqual(float(said["a"][-1].split()[1]), 0.1 * (4 - 1 / ticks), delta=0.002, msg=ticks)

    def test_what_has_no_effect_is_named(self):
        arena = (foot_bot("a", attributes='colour="red"', more="<wheels/><battery/>") +
                 '<box id="w" size="0.2,0.2,0.2" movable="false" weight="1"><body position="1,0,0" orientation="0,0,0" angle="1"/><door/></box>')
        file = self.file("common", "differential_steering", "", arena, engine='<spatial_hash cell_size="1"/>',
                         media='<led id="leds" index="grid" grid_size="1,1,1"/>')
        notes = self.swarmanoid("check", file).stderr
        for what in ("'colour' of <foot-bot>", "<wheels> of <foot-bot>", "<battery> has no effect without the sensor", "'weight' of <box>",
                     "'angle' of <body>", "<door> of <box>", "<spatial_hash> of <dynamics2d>", "'index' of <led>", "'grid_size' of <led>"):
            self.assertRegex(notes, rf"x\.argos:\d+:\d+: note: {re.escape(what)}")

    def test_implementations_must_exist(self):
        file = self.file("common", "differential_steering", "positioning", foot_bot("a"))
        file.write_text(file.read_text().replace('<positioning implementation="default"', '<positioning implementation="no_such_thing"'))
        self.assertRegex(self.swarmanoid("check", file, code=3).stderr,
                         r"x\.argos:\d+:\d+: <positioning> has no implementation 'no_such_thing'; it has 'default'")
