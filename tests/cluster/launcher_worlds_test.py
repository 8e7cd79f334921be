"""`swarmanoid convert` turns worlds of Gazebo and Webots and floor plans into experiments that are valid and run."""
import os
import pathlib
import re
import shutil
import xml.etree.ElementTree as xml

from harness import LauncherTest

WORLDS = pathlib.Path(__file__).resolve().parent.parent / "worlds"
ROBOTS = """<footbot_diffusion id="diffusion" library="footbot_diffusion"><actuators><footbot_wheels implementation="dummy_footbot_wheels"/>
  </actuators><sensors><footbot_proximity implementation="generic_footbot_proximity"/></sensors></footbot_diffusion>"""


class Worlds(LauncherTest):
    def converted(self, file, *options):
        """The experiment, and the notes by their line."""
        run = self.run_it("convert", WORLDS / file, "--output", "made.xml", *options)
        self.assertEqual((run.process.returncode, run.stdout), (0, ""), run.stderr)
        notes = {}
        for line in run.stderr.splitlines():
            found = re.fullmatch(rf"{WORLDS / file}:(\d+):\d+: note: (.*)", line)
            if found:
                notes.setdefault(int(found[1]), []).append(found[2])
        checked = self.run_it("check", "made.xml")
        self.assertEqual(checked.process.returncode, 0, checked.stderr)
        return xml.parse(self.folder / "made.xml"), notes, run.stderr

    def runs_alike(self, ticks, robots):
        """Adds robots, and compares one process with a cluster."""
        text = (self.folder / "made.xml").read_text()
        text = re.sub(r"(<framework [^>]*/>)", rf"\1<controllers>{ROBOTS}</controllers>", text)
        text = text.replace("</arena>", robots + "</arena>")
        (self.folder / "robots.xml").write_text(text)
        hashes = []
        for way in (["--single-process"], []):
            run = self.run_it("run", "robots.xml", "--ticks", ticks, "--quiet", "--output", f"out{len(way)}", *way)
            self.assertEqual(run.process.returncode, 0, run.stderr)
            hashes.append(self.assert_finished(run))
        self.assertEqual(len(set(hashes)), 1, hashes)

    def line_of(self, file, text):
        return next(number for number, line in enumerate((WORLDS / file).read_text().splitlines(), 1) if text in line)

    def test_a_room_of_gazebo(self):
        made, notes, said = self.converted("room.sdf")
        self.assertIn("7 bodies, 1 light", said)
        ids = [entity.get("id") for entity in made.find("arena")]
        self.assertEqual(ids, ["wall_north", "table.plate", "table.left", "table.right", "crate", "log", "rock", "lamp"])
        crate = made.find("arena/block[@id='crate']")
        self.assertEqual((crate.get("movable"), crate.get("mass"), crate.get("friction")), ("true", "0.4", "0.7"))
        for text in ("<include>", '"sky"', "<sphere>", 'name="rover"', "<physics"):
            self.assertIn(self.line_of("room.sdf", text), notes, text)
        self.runs_alike(40, '<distribute quantity="2"><position min="1.5, 3.5, 0" max="3, 3.9, 0"/><footbot id="fb" controller="diffusion"/></distribute>')

    def test_a_maze_of_webots(self):
        made, notes, said = self.converted("maze.wbt")
        self.assertIn("9 bodies, 1 light", said)
        post = made.find("arena/cylindric_prey[@id='post']")
        self.assertEqual((post.get("movable"), post.get("colour"), post.get("radius")), ("false", "#0080ff", "0.05"))
        for text in ("Viewpoint", "Sphere", "Robot {", "basicTimeStep"):
            self.assertIn(self.line_of("maze.wbt", text), notes, text)
        self.runs_alike(40, '<footbot id="fb" position="1, 2.5, 0" controller="diffusion"/>')

    def test_a_floor_plan(self):
        made, notes, said = self.converted("office.pgm", "--resolution", "0.5", "--height", "0.3")
        self.assertEqual(notes, {})
        self.assertIn("12 x 8 pixels, 6 x 4 m, 6 walls", said)
        self.assertEqual(made.find("arena").get("size"), "6, 4, 1")
        self.runs_alike(100, '<distribute quantity="10"><footbot id="fb" controller="diffusion"/></distribute>')

    def test_a_map_of_ros(self):
        shutil.copy(WORLDS / "office.pgm", self.folder)
        (self.folder / "office.yaml").write_text("image: office.pgm  # by map_saver\nresolution: 0.5\norigin: [-1.5, -2, 0.1]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")
        run = self.run_it("convert", "office.yaml", "--output", "made.xml")
        self.assertEqual(run.process.returncode, 0, run.stderr)
        self.assertIn("office.yaml: 12 x 8 pixels, 6 x 4 m, 6 walls", run.stderr)
        self.assertIn("note: the yaw of the origin, 0.1 rad", run.stderr)
        self.assertIn("The point 0, 0 is at -1.5, -2 in the frame of the map.", (self.folder / "made.xml").read_text())
        picture = self.run_it("convert", "office.pgm", "--resolution", "0.5")
        walls = re.findall("<wall .*/>", picture.stdout)
        self.assertEqual(re.findall("<wall .*/>", (self.folder / "made.xml").read_text()), walls)
        self.runs_alike(40, '<distribute quantity="4"><footbot id="fb" controller="diffusion"/></distribute>')
        self.assertIn("12 x 8 pixels, 3 x 2 m", self.run_it("convert", "office.yaml", "--resolution", "0.25").stderr)
        (self.folder / "office.yaml").write_text("image: office.pgm\nresolution: 0.5\nnegate: 1\n")
        self.assertNotEqual(re.findall("<wall .*/>", self.run_it("convert", "office.yaml").stdout), walls)
        for text, says in (("image: office.pgm\n", "office.yaml:1:1: the map has no resolution"), ("image: absent.png\nresolution: 0.5\n", "absent.png"),
                           ("image: office.pgm\nresolution: 0\n", "office.yaml:2:1: resolution is 0; it must be 1e-06 to 1000")):
            (self.folder / "office.yaml").write_text(text)
            run = self.run_it("convert", "office.yaml")
            self.assertEqual((run.process.returncode, run.stdout), (3, ""), text)
            self.assertIn(says, run.stderr)

    def test_paths_of_meshes_start_at_the_new_file(self):
        (self.folder / "in").mkdir()
        for name in ("room.sdf", "wedge.obj"):
            shutil.copy(WORLDS / name, self.folder / "in")
        (self.folder / "out").mkdir()
        self.assertEqual(self.run_it("convert", "in/room.sdf", "--output", "out/made.xml").process.returncode, 0)
        self.assertIn('mesh="../in/wedge.obj"', (self.folder / "out/made.xml").read_text())
        self.assertEqual(self.run_it("check", "out/made.xml").process.returncode, 0)
        self.assertIn('mesh="in/wedge.obj"', self.run_it("convert", "in/room.sdf").stdout)

    def test_mistakes(self):
        (self.folder / "broken.sdf").write_text("<sdf><world name='w'>\n<model name='m'>")
        (self.folder / "wrong.sdf").write_text("<sdf><model name='m'><static>1</static><link name='l'><collision name='c'>\n"
                                               "<geometry><box><size>1 x 1</size></box></geometry></collision></link></model></sdf>")
        (self.folder / "old.wbt").write_text("#VRML_SIM R2020a utf8\n")
        (self.folder / "broken.wbt").write_text("#VRML_SIM R2023b utf8\nSolid {\n")
        (self.folder / "cut.png").write_bytes(b"\x89PNG\r\n\x1a\n")
        (self.folder / "other.xml").write_text("<robot/>")
        os.mkfifo(self.folder / "pipe.sdf")
        for words, code, text in ((["broken.sdf"], 3, "broken.sdf:2:"),
                                  (["wrong.sdf"], 3, "wrong.sdf:2:16: <size> of <box> is '1 x 1'; it must be 3 numbers"),
                                  (["old.wbt"], 3, "old.wbt:1:1: the world is of Webots R2020a"),
                                  (["broken.wbt"], 3, "broken.wbt:3:1: the end of the file instead of a field of Solid"),
                                  (["cut.png", "--resolution", "1"], 3, "cannot read the PNG 'cut.png'"),
                                  (["cut.png"], 2, "--resolution: a floor plan needs the edge of its pixels"),
                                  (["wrong.sdf", "--resolution", "1"], 2, "is no PNG, JPEG, PGM or map of ROS"),
                                  (["other.xml"], 3, "the root element is <robot>"),
                                  (["absent.sdf"], 3, "absent.sdf: the file cannot be read: there is no such file"),
                                  (["pipe.sdf"], 3, "it is a pipe"),
                                  ([WORLDS / "office.pgm", "--resolution", "-1"], 2, "--resolution"),
                                  ([WORLDS / "office.pgm", "--resolution", "1", "--threshold", "0"], 3, "raise --threshold"),
                                  (["wrong.sdf", "--output", "wrong.sdf"], 2, "it is the file to convert")):
            run = self.run_it("convert", *words)
            self.assertEqual((run.process.returncode, run.stdout), (code, ""), (words, run.stderr))
            self.assertIn(text, run.stderr)
        self.assertFalse((self.folder / "made.xml").exists())
