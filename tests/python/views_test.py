"""A device of a user's library, whose columns only its interface declares, is in Python, Lua, `inspect`, `list plugins` and what an
attached program sees."""
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import numpy as np

import swarmanoid

LIBRARY = os.environ["SWARMANOID_EVERY_VIEW"]
SWARMANOID = os.environ["SWARMANOID"]
TICK = 7

XML = f"""<ahss-config>
  <framework><clocktick>100</clocktick><maxclock>20</maxclock></framework>
  <controllers>
    <{{tag}} id="c">
      <actuators><every_view library="{LIBRARY}" implementation="test_every_view"/></actuators>
      <sensors><every_view library="{LIBRARY}" implementation="test_every_view"/></sensors>
      <parameters/>
    </{{tag}}>
  </controllers>
  <arena size="4, 4, 2" optimization="2D"><footbot id="fb" position="1,1,0" controller="c"/></arena>
  <engines><dummy_engine id="ground"/></engines>
  <arena_physics><engine id="ground"><all/></engine></arena_physics>
</ahss-config>
"""

ARGOS = f"""<argos-configuration>
  <framework><experiment length="2" ticks_per_second="10" random_seed="1"/></framework>
  <controllers>
    <lua_controller id="c">
      <actuators><every_view library="{LIBRARY}" implementation="test_every_view"/></actuators>
      <sensors><every_view library="{LIBRARY}" implementation="test_every_view"/></sensors>
      <params script="script.lua"/>
    </lua_controller>
  </controllers>
  <arena size="4,4,1" center="2,2,0.5">
    <foot-bot id="fb"><body position="1,1,0" orientation="0,0,0"/><controller config="c"/></foot-bot>
  </arena>
  <physics_engines><dynamics2d id="ground"/></physics_engines>
</argos-configuration>
"""

LUA = """
function step()
  local seen = robot.every_view
  log(seen.count, " ", seen[1], " ", seen[2], " ", #seen > 2)
  for _, echo in ipairs(robot.every_view.rows) do log(echo.id, " ", echo.angle, " ", echo.is_left) end
  robot.every_view.set(seen.count, 2)
end
"""


class EveryView(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmanoid_views_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def command(self, *words):
        run = subprocess.run([SWARMANOID, *words], cwd=self.folder, capture_output=True, text=True, timeout=200)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run.stdout

    def experiment(self, tag):
        file = self.folder / f"{tag}.xml"
        file.write_text(XML.format(tag=tag))
        return file

    def test_a_program_in_python_has_its_columns_and_rows(self):
        simulation = swarmanoid.Simulation(self.experiment("external_controller"))
        robots = simulation.robots["c"]
        self.assertEqual(robots.columns["every_view"], ["count [ticks]", "0 [m]", "1 [m]"])
        self.assertEqual(robots.row_columns["every_view"], ["angle [rad]", "is left"])
        self.assertEqual(robots.actuator_columns["every_view"], ["low [V]", "high [V]"])
        simulation.step(TICK)
        simulation.sense()
        np.testing.assert_array_equal(robots.sensors["every_view"], [[TICK, TICK + 0.25, TICK + 0.5]])
        np.testing.assert_array_equal(robots.rows("every_view")[0], [[1.5, 1], [-1.5, 0]])
        self.assertEqual(robots.row_ids("every_view"), [["left", "right"]])

    def test_a_controller_in_python_reads_and_sets_it(self):
        seen = []

        @swarmanoid.controller("every_view_reader")
        class Reader:
            def control_step(self, robot):
                seen.append(robot.read("every_view").tolist())
                robot.set("every_view", [1, 2])

        swarmanoid.Simulation(self.experiment("every_view_reader")).step(3)
        self.assertEqual(seen, [[tick, tick + 0.25, tick + 0.5] for tick in range(3)])

    def test_list_plugins_has_its_columns(self):
        text = self.command("list", "plugins", LIBRARY, "every_view")
        self.assertIn("  reads count [ticks], 0 [m] … 1 [m]\n  reads of each echo: angle [rad], is left\n", text)
        self.assertIn("  takes low [V], high [V]\n", text)
        listed = {plugin["kind"]: plugin for plugin in json.loads(self.command("list", "plugins", LIBRARY, "every_view", "--json"))}
        self.assertEqual([column["name"] for column in listed["sensor"]["columns"]], ["count", "#"])
        self.assertEqual([column["name"] for column in listed["sensor"]["rows"]], ["angle", "is left"])
        self.assertEqual([column["unit"] for column in listed["actuator"]["columns"]], ["V", "V"])

    def test_scripts_in_lua_and_recorded_runs_have_its_columns(self):
        (self.folder / "every_view.argos").write_text(ARGOS)
        (self.folder / "script.lua").write_text(LUA)
        self.command("run", "every_view.argos", "--output", "run", "--quiet")
        said = "".join(log.read_text() for log in (self.folder / "run").glob("controller_host*.log"))
        self.assertRegex(said, rf"at tick {TICK}: {TICK}(\.0)? {TICK}\.25 {TICK}\.5 false")
        self.assertRegex(said, rf"at tick {TICK}: left 1\.5 1")
        self.assertRegex(said, rf"at tick {TICK}: right -1\.5 0")
        robot = json.loads(self.command("inspect", f"run@{TICK}", "fb", "--json"))["robots"][0]
        readings = {kind: {reading["name"]: (reading["value"], reading["unit"]) for device in robot[kind] for reading in device["readings"]
                           if device["type"] == "every_view"} for kind in ("sensors", "actuators")}
        self.assertEqual(readings["sensors"], {
            "count": (TICK, "ticks"), "0": (TICK + 0.25, "m"), "1": (TICK + 0.5, "m"), "echo left angle": (1.5, "rad"),
            "echo left is left": (1, "yes/no"), "echo right angle": (-1.5, "rad"), "echo right is left": (0, "yes/no")})
        self.assertEqual(readings["actuators"], {"low": (TICK, "V"), "high": (2, "V")})


if __name__ == "__main__":
    unittest.main()
