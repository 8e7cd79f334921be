"""Controllers in scripts: the same hash in one process and in clusters, whichever process dies, from a checkpoint, and as in C++."""
import os
import pathlib
import shutil
import signal

from harness import AGAIN, CONFIGS, REPLACED, LauncherTest
from world.case import controller, experiment

TICKS = 300
# The script uses the table `state`, the random numbers of the robot, and local variables that refer to tables of the state.
LUA = """local p = parameters{speed = {default = 5, unit = "rad/s", maximum = 20}, name = "x", fast = false}
state = {turning = 0, seen = {}, name = p.name}
local seen = state.seen

function step()
  local near = 0
  for i = 1, 24 do near = near + robot.footbot_proximity[i] end
  if near > 0 then
    state.turning = math.random(3, 9)
    seen[#seen + 1] = robot.tick
  end
  if #seen > 20 then table.remove(seen, 1) end
  local turn = state.turning > 0 and robot.random.uniform(0, 5) + #seen / 10 or 0
  state.turning = state.turning - 1
  robot.footbot_wheels.set(p.speed + turn, p.speed - turn)
end
"""


# The same in Python, with arrays.
PYTHON = """import numpy as np

p = parameters(speed={"default": 5, "unit": "rad/s", "maximum": 20}, name="x", fast=False)


def init(robots):
    robots.state.turning = np.zeros(len(robots), dtype=int)
    robots.state.seen = np.zeros((len(robots), 3))


def step(robots):
    near = robots.sensors["footbot_proximity"].sum(axis=1) > 0
    state = robots.state
    state.turning = np.where(near, robots.uniform(3, 10).astype(int), state.turning - 1)
    state.seen[near, 0] = robots.tick
    state.seen[near] = state.seen[near][:, [1, 2, 0]]
    turn = np.where(state.turning > 0, robots.uniform(0, 5) + state.seen.sum(axis=1) / 1000, 0)
    wheels = robots.actuators["footbot_wheels"]
    driven = turn != 1  # all
    wheels[driven, 0] = p.speed + turn[driven]
    wheels[driven, 1] = p.speed - turn[driven]
"""
LIBRARIES = pathlib.Path(os.environ["SWARMANOID_BUILD"]) / "lib/swarmanoid"


class InEachLanguage:
    """What a script does, whatever its language is."""

    def setUp(self):
        if not (LIBRARIES / f"lib{self.language}.so").exists():
            self.skipTest(f"the build has no controllers in {self.language}")
        super().setUp()

    def write(self, script, parameters=None, robots=4):
        (self.folder / f"walk.{self.ending}").write_text(script)
        arena = f'<distribute quantity="{robots}"><position method="uniform"/><orientation method="uniform"/><footbot id="fb" controller="c"/></distribute>'
        text = controller(f"{self.language}_controller", ["dummy_footbot_wheels"], ["generic_footbot_proximity"],
                          f"<script>walk.{self.ending}</script>" if parameters is None else parameters, library=self.language)
        return experiment(self.folder / "walk.xml", "", text, arena, size="1.5,1.5,1")

    def done(self, name, file, *options, code=0):
        run = self.run_it("run", file, "--ticks", TICKS, "--hash-log", name, "--output", name + "_out", *options)
        self.assertEqual(run.process.returncode, code, run.stderr)
        return (self.folder / name).read_text()

    def fails(self, script, *options, parameters=None, ticks=TICKS):
        shutil.rmtree(self.folder / "failed", ignore_errors=True)
        run = self.run_it("run", self.write(script, parameters), "--ticks", ticks, "--single-process", "--output", "failed", *options)
        self.assertNotEqual(run.process.returncode, 0, run.stdout)
        return run.stderr

    def test_the_same_everywhere(self):
        file = self.write(self.script, robots=6)
        one = self.done("one", file, "--single-process")
        self.assertEqual(one.count("\n"), TICKS + 1)
        for name, options in (("threads", ("--single-process", "--threads", 2)), ("cluster", ()), ("hosts", ("--controller-hosts", 3))):
            self.assertEqual(self.done(name, file, *options), one, name)
        # Another value of a parameter of the script, and another seed, give another run.
        self.assertNotEqual(self.done("faster", file, "--single-process", "--set", "controllers.c.parameters.speed=6"), one)
        self.assertNotEqual(self.done("seeded", file, "--single-process", "--seed", 2), one)

    def test_whichever_process_dies(self):
        file = self.write(self.script, robots=6)
        one = self.done("one", file, "--single-process")
        for program, says in (("controller_host", REPLACED), ("space_server", AGAIN)):
            with self.subTest(program):
                self.assert_survives(program, says, 170, program, one, file, "--ticks", TICKS, "--controller-hosts", 2)

    def test_from_a_checkpoint(self):
        one = self.done("one", self.write(self.script, robots=6), "--single-process", "--checkpoint-every", 200)
        self.assert_restored(one, 200)

    def test_lists_have_the_parameters_of_the_script(self):
        settings = self.run_it("list", "settings", self.write(self.script)).stdout
        self.assertIn("controllers.c.parameters.speed=5\ta number in rad/s, at most 20", settings)
        plugin = self.run_it("list", "plugins", self.language)
        self.assertEqual((plugin.process.returncode, plugin.stderr), (0, ""))
        self.assertIn(f"controller {self.language}_controller", plugin.stdout)
        schema = self.run_it("list", "schema")  # loads all plug-ins
        self.assertEqual((schema.process.returncode, schema.stderr), (0, ""))
        self.assertIn(f"{self.language}_controller", schema.stdout)


class LuaTest(InEachLanguage, LauncherTest):
    language, ending, script = "lua", "lua", LUA

    def test_the_rule_of_a_controller_in_c_plus_plus_has_its_hash(self):
        # The sums of the C++ code are ordered for its lanes.
        script = (CONFIGS / "scripts/diffusion.lua").read_text()
        start, end = script.index("local function obstacle"), script.index("function step")
        lanes = """local function obstacle(readings)
  local x, y = {0, 0, 0, 0}, {0, 0, 0, 0}
  for i = 1, SENSORS do
    local lane = (i - 1) % 4 + 1
    x[lane] = x[lane] + readings[i] * directions[i].x
    y[lane] = y[lane] + readings[i] * directions[i].y
  end
  return ((x[1] + x[2]) + (x[3] + x[4])) / SENSORS, ((y[1] + y[2]) + (y[3] + y[4])) / SENSORS
end

"""
        (self.folder / "scripts").mkdir()
        (self.folder / "scripts/diffusion.lua").write_text(script[:start] + lanes + script[end:])
        file = self.folder / "diffusion.xml"
        file.write_text((CONFIGS / "diffusion_lua.xml").read_text())
        expected = self.one_process(CONFIGS / "diffusion_10.xml", 600)
        self.assertEqual(self.one_process(file, 600), expected)

    def test_a_script_without_state_is_repeated_and_has_no_checkpoints(self):
        script = "local k = 0\nfunction step()\n  k = k + 1\n  robot.footbot_wheels.set(5 + k % 7, 5)\nend\n"
        file = self.write(script)
        one = self.done("one", file, "--single-process")
        run = self.start("run", file, "--ticks", TICKS, "--paused", "--hash-log", "cluster", "--output", "out")
        self.wait_for_experiment("walk")
        self.control("step", 170)
        os.kill(run.find("controller_host"), signal.SIGKILL)
        said = run.read_until(REPLACED)
        self.control("resume")
        self.assertEqual(run.wait(), 0, said + run.stderr)
        self.assertEqual((self.folder / "cluster").read_text(), one)
        self.assertIn("its controller cannot be saved", self.fails(script, "--checkpoint-every", 100))

    def test_what_a_script_keeps_outside_of_its_state_is_not_lost_silently(self):
        for script, name in (("k = 0 state = {} function step() k = k + 1 end", "the global variable 'k' has changed"),
                             ("state = {} local list = {}\nfunction step() list[#list + 1] = 1 end", "the local variable 'list' of the function in walk.lua:2"),
                             ("state = {} local c = coroutine.create(print) function step() c = c end", "keeps a coroutine"),
                             ("state = {} function step() state.f = step end", "state.f is a function; only numbers"),
                             ("state = {} function step() state.a = {} state.b = {state.a} end", "is the same table as state"),
                             ("state = {} function step() state.a = setmetatable({}, {}) end", "state.a has a metatable"),
                             ("state = {} function step() state.a = state end", "state.a is the same table as state"),
                             ("state = 3 function step() end", "the global `state` is a number")):
            with self.subTest(script):
                self.assertIn(name, self.fails(script, "--checkpoint-every", 100, ticks=100))

    def test_mistakes_name_file_and_line(self):
        for script, parameters, text in (
                ("function step()\n  robot.footbot_wheels.set(5)\nend", "", r"robot 'fb_0', controller 'c': ControlStep at tick 0 failed: walk.lua:2: 1 values are given, and 2 "),
                ("function step()\n  robot.footbot_wheels.set(5, 0 / 0)\nend", "", r"walk.lua:2: value 2 is not finite"),
                ("function step()\n  robot.footbot_wheels.set{5, 'fast'}\nend", "", r"walk.lua:2: value 2 is a string; it must be a number"),
                ("function step()\n  robot.wheels.set(5, 5)\nend", "", r"walk.lua:2: attempt to index a nil value \(field 'wheels'\)"),
                ("function step()\n  robot.k = 1\nend", "", r"walk.lua:2: the table `robot` takes no new field 'k'"),
                ("function step()\n  math.randomseed(3)\nend", "", r"walk.lua:2: random numbers are those of the robot"),
                ("function init()\n  os.execute('true')\nend function step() end", "", r"walk.lua:2: os.execute is not for scripts"),
                ("x =", "", r"walk.xml:\d+:\d+: walk.lua:1: unexpected symbol near <eof>"),
                ("x = 1", "", r"walk.lua: the script has no function step\(\)"),
                (LUA, "<sped>3</sped>", r"walk.xml:\d+:\d+: the controller <lua_controller> has no parameter 'sped'; it has: script, fast, name, speed; did you mean 'speed'"),
                (LUA, "<speed>30</speed>", r"walk.xml:\d+:\d+: 'speed' of the controller <lua_controller> is 30 rad/s; it must be at most 20 rad/s"),
                ("parameters{a = {defalt = 3}}", "", r"walk.lua:1: the parameter 'a' has no field 'defalt'; .* did you mean 'default'"),
                ("parameters{a = {default = 3, maximum = 2}}", "", r"walk.lua:1: .*'a'"),
                ("parameters{a = {unit = 'm'}} function step() end", "", r"walk.xml:\d+:\d+: the controller <lua_controller> lacks the parameter 'a'")):
            with self.subTest(text):
                self.assertRegex(self.fails(script, parameters="<script>walk.lua</script>" + parameters), text)
        file = self.write(LUA, "<script>none.lua</script>")
        self.assertRegex(self.run_it("check", file).stderr, r"walk.xml:\d+:\d+: cannot read '.*none.lua': No such file")

    def test_a_long_list_with_equal_elements_is_sorted_in_one_order(self):
        # Lua's own sort chooses by the time of day in such a list.
        self.fine("""state = {}
function step()
  local list = {}
  for i = 1, 3000 do list[i] = {key = (i * 7919) % 3001 < 2900 and 1 or i % 5, place = i} end
  table.sort(list, function(a, b) return a.key < b.key end)
  for i = 2, #list do
    local a, b = list[i - 1], list[i]
    assert(a.key < b.key or a.key == b.key and a.place < b.place)
  end
  local words = {}
  for i = 1, 300 do words[i] = tostring(i * 37 % 300) end
  table.sort(words)
  for i = 2, #words do assert(words[i - 1] < words[i]) end
end
""")

    def test_random_numbers_are_those_of_the_robot_and_its_tick(self):
        self.fine("""local p = parameters{n = 6}
state = {sum = 0}
function step()
  local die, all = math.random(p.n // 1 | 0), math.random(-3, 3)
  assert(die >= 1 and die <= 6 and all >= -3 and all <= 3 and math.random() < 1)
  assert(robot.random.bernoulli(1) and not robot.random.bernoulli(0))
  assert(math.abs(robot.random.gaussian(5, 0.001) - 5) < 0.1 and robot.random.uniform(2, 3) >= 2)
  assert(not pcall(math.random, 3, 2) and not pcall(math.random, 0))
  assert(robot.time == robot.tick * robot.tick_seconds and robot.kind == "footbot")
end
""")

    def test_a_script_may_guard_its_global_variables(self):
        self.fine("""state = {}
setmetatable(_G, {__index = function(_, name) error("no variable " .. name) end, __newindex = function(_, name) error("no new " .. name) end})
rawset(_G, "step", function() assert(not pcall(function() return nothing end)) end)
""")

    def fine(self, script):
        self.done("fine", self.write(script), "--single-process", "--checkpoint-every", 200)

    def test_devices_are_tables_with_their_columns(self):
        (self.folder / "talk.lua").write_text("""local radio = robot.range_and_bearing
function step()
  radio.set{1, robot.tick % 256, 7, 0, 0, 0, 0, 0, 0, 0, 0}
  local words = {robot.kind, #radio.rows}
  for _, packet in ipairs(radio.rows) do
    words[#words + 1] = string.format("%.2f m %.2f %d %d", packet.range, packet.bearing, packet.byte_0, packet.byte_1)
  end
  log(robot.tick, " hears ", table.concat(words, " "))
end
""")
        text = controller("lua_controller", ["generic_range_and_bearing"], ["generic_range_and_bearing"], "<script>talk.lua</script>", library="lua")
        file = experiment(self.folder / "talk.xml", "", text, '<footbot id="a" position="1,1,0" controller="c"/><footbot id="b" position="2,1,0" controller="c"/>')
        run = self.run_it("run", file, "--ticks", 6, "--single-process", "--output", "out")
        self.assertEqual(run.process.returncode, 0, run.stderr)
        said = "".join(log.read_text() for log in self.folder.glob("out/*.log"))
        self.assertIn("robot 'a' at tick 5: 5 hears footbot 1 1.00 m 0.00 4 7", said)
        self.assertIn("robot 'b' at tick 5: 5 hears footbot 1 1.00 m", said)


class PythonTest(InEachLanguage, LauncherTest):
    language, ending, script = "python", "py", PYTHON

    def test_what_a_script_keeps_outside_of_its_state_is_not_lost_silently(self):
        stateless = "stateless = True\nk = [0]\ndef step(robots):\n  k[0] += 1\n"
        for script, name in ((stateless, "walk.py: the global variable 'k' has changed since the start"),
                             ("def step(robots):\n  pass\n", "its controller cannot be saved"),
                             ("def init(robots):\n  robots.state.f = print\ndef step(robots):\n  pass\n", "walk.py:2: TypeError: the state 'f' has the type object"),
                             ("def init(robots):\n  robots.state.f = [1, 2]\ndef step(robots):\n  pass\n", "walk.py:2: ValueError: the state 'f' has 2 rows for 1 robots")):
            with self.subTest(script):
                self.assertIn(name, self.fails(script, "--checkpoint-every", 100, ticks=100))

    def test_mistakes_name_file_and_line(self):
        step = "def step(robots):\n"
        for script, parameters, text in (
                (step + "  robots.actuators['footbot_wheels'] = [[1, 2, 3]]\n", "", r"robot 'fb_0', controller 'c': ControlStep at tick 0 failed: ValueError: the actuator "
                 r"'footbot_wheels' takes an array of 4 robots and 2 columns"),
                (step + "  robots.actuators['footbot_wheels'][2] = 1, float('inf')\n", "", r"column 1 of the actuator 'footbot_wheels' of the robot 'fb_2' is not finite"),
                (step + "  robots.sensors['wheels']\n", "", r"walk.py:2: KeyError: the robots have no sensor 'wheels'; they have: footbot_proximity"),
                (step + "  helper()\ndef helper():\n  nothing\n", "", r"walk.py:4: NameError: name 'nothing' is not defined"),
                ("x = = 1\n", "", r"walk.xml:\d+:\d+: walk.py:1: invalid syntax"),
                ("x = 1\n", "", r"walk.py: the script has no function step\(robots\)"),
                (PYTHON, "<sped>3</sped>", r"walk.xml:\d+:\d+: the controller <python_controller> has no parameter 'sped'; it has: script, fast, name, speed; did you mean 'speed'"),
                (PYTHON, "<speed>30</speed>", r"walk.xml:\d+:\d+: 'speed' of the controller <python_controller> is 30 rad/s; it must be at most 20 rad/s"),
                ("p = parameters(a=3 + len('x'))\n", "", r"walk.xml:\d+:\d+: walk.py:1: the parameter 'a' must be declared by numbers"),
                ("p = parameters(a={'defalt': 3})\n", "", r"walk.xml:\d+:\d+: the parameter 'a' has no field 'defalt'; .* did you mean 'default'")):
            with self.subTest(text):
                self.assertRegex(self.fails(script, parameters="<script>walk.py</script>" + parameters), text)
        file = self.write(PYTHON, "<script>none.py</script>")
        self.assertRegex(self.run_it("check", file).stderr, r"walk.xml:\d+:\d+: cannot read '.*none.py': No such file")

    def test_a_robot_that_is_switched_off_keeps_its_row(self):
        file = self.write(PYTHON, robots=4)
        one = self.done("one", file, "--single-process")
        off = '<faults><fault id="off" entities="fb_2" kind="off" from="100" to="150"/></faults>'
        file.write_text(file.read_text().replace("</ahss-config>", off + "</ahss-config>"))
        faulty = self.done("faulty", file, "--single-process")
        self.assertNotEqual(faulty, one)
        self.assertEqual(self.done("hosts", file, "--controller-hosts", 3), faulty)

    def test_a_controller_that_fails_starts_again_alone(self):
        script = PYTHON.replace("    near =", "    if robots.tick == 150 and robots.ids == ['fb_1']:\n        raise ValueError('once')\n    near =")
        file = self.write(script, robots=4)
        file.write_text(file.read_text().replace('library="python"', 'library="python" on_failure="restart"'))
        one = self.done("one", file, "--single-process")
        self.assertIn("walk.py:13: ValueError: once", (self.folder / "one_out/events.csv").read_text())
        self.assertEqual(self.done("hosts", file, "--controller-hosts", 3), one)
