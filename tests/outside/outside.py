"""What tests from outside share: the installed commands, a user directory with the plug-ins of this suite, and experiments
of one robot in a folder of each test's own."""
import os
import pathlib
import subprocess

from world.case import FolderCase

PREFIX = pathlib.Path(os.environ["SWARMANOID_PREFIX"])
USER = pathlib.Path(os.environ["SWARMANOID_USER"])
SWARMANOID = PREFIX / "bin" / "swarmanoid"
BUILT = USER / "simulation_build"
# Every fault is tried in both ways.
WAYS = {"one process": ["--single-process"], "cluster": []}


class OutsideTest(FolderCase):
    def environment(self, changes=None):
        return {**self.variables, **(changes or {})}

    def command(self, *arguments, timeout=60, environment=None):
        """Runs a command of the package, or any program, in the folder of the test."""
        words = [str(a) for a in arguments]
        if not words[0].startswith("/"):
            words[0] = str(PREFIX / "bin" / words[0])
        return subprocess.run(words, cwd=self.folder, capture_output=True, text=True, timeout=timeout,
                              env=self.environment(environment))

    def run_experiment(self, file, *options, **more):
        return self.command("swarmanoid", "run", file, "--quiet", *options, **more)

    def hash_of(self, done):
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.hash_in(done.stdout)

    def experiment(self, name="experiment", controller="outside_still", parameters="", sensors="", actuators="", ticks=20,
                   functions="", arena="", engine="dummy_engine", entities="", framework=""):
        """A file with the footbot 'robot_one' in the engine 'ground'; texts are XML that is put in its place."""
        path = self.folder / f"{name}.xml"
        in_engine = "".join(f'<entity id="{i}"/>' for i in ["robot_one", *entities.split()])
        around = f"<experiment_functions>{functions}</experiment_functions>" if functions else ""
        plugins = f"<plugin_path>{BUILT}/functions:{BUILT}/engines:{BUILT}/devices</plugin_path>"
        path.write_text(f"""<ahss-config>
  <framework><clocktick>100</clocktick><maxclock>{ticks}</maxclock><controller_path>{BUILT}/controllers</controller_path>{plugins}{framework}</framework>
  <controllers>
    <{controller} id="c" library="{controller}">
      <actuators>{actuators}</actuators><sensors>{sensors}</sensors>
      <parameters>{parameters}</parameters>
    </{controller}>
  </controllers>
  <arena size="4,4,2" optimization="2D">
    <footbot id="robot_one"><position>1,1,0</position><orientation>0,0,0</orientation><controller>c</controller></footbot>
    {arena}
  </arena>
  <engines>
    <{engine} id="ground"><subclock>1</subclock><perpendicular_axis>z</perpendicular_axis><distance>0</distance></{engine}>
  </engines>
  <arena_physics><engine id="ground">{in_engine}</engine></arena_physics>
  {around}
</ahss-config>
""")
        return path
