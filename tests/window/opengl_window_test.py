"""The window of opengl_render on an X server without a screen, driven by keys and mouse as a person does it."""
import contextlib
import math
import re
import shutil
import time

import display
from harness import CONFIGS, LauncherTest
from world.case import experiment

display.need("opengl_render")

TITLE = "A test of the window"
WIDTH, HEIGHT = 900, 600
# Straight above the middle of the arena, 6 m high: the picture's x is the arena's, and its upper edge is at larger y.
CAMERA_HEIGHT = 6
VIEW = f"<camera_view_XYZ_0>2, 2, {CAMERA_HEIGHT}</camera_view_XYZ_0><camera_view_HPR_0>90, -90, 0</camera_view_HPR_0>"
XML = re.compile(r"<camera_view_XYZ_(\d)>(.*)</camera_view_XYZ_\d>\n<camera_view_HPR_\d>(.*)</camera_view_HPR_\d>")


def on_screen(x, y, z=0.1):
    scale = HEIGHT / (2 * (CAMERA_HEIGHT - z) * math.tan(math.radians(45) / 2))
    return WIDTH / 2 + scale * (x - 2), HEIGHT / 2 - scale * (y - 2)


class Window(LauncherTest):
    KIND = "opengl"  # other windows with the same keys and panels are tested by deriving

    def setUp(self):
        super().setUp()
        self.display = display.Display(f"{WIDTH}x{HEIGHT}")

    def tearDown(self):
        super().tearDown()
        self.display.close()

    def experiment(self, render="", name="window_test"):
        """Two footbots without a controller, fb_a at 2, 2 and fb_b at 3, 1."""
        return experiment(self.folder / f"{name}.xml", "<maxclock>0</maxclock>",
                          arena='<footbot id="fb_a" position="2,2,0"/><footbot id="fb_b" position="3,1,0"/>', size="4,4,1",
                          more=f"<visualisations>{render}</visualisations>")

    def window_element(self, extra=""):
        return (f'<{self.KIND}_render id="mainwindow"><window_size>{WIDTH}, {HEIGHT}</window_size><window_title>{TITLE}</window_title>'
                f"{VIEW}<antialiasing>0</antialiasing>{extra}</{self.KIND}_render>")

    def start_window(self, *options):
        """A run with a window, and with a table that says how far it is."""
        table = '<text_render id="table"><file>table.txt</file></text_render>'
        run = self.start("run", self.experiment(self.window_element() + table), "--output", "out", "--quiet", *options,
                         environment=self.display.environment)
        return run, self.display.window(TITLE, run=run)

    def log(self):
        """What the visualiser of the run has logged."""
        with contextlib.suppress(OSError):
            return "".join(path.read_text() for path in (self.folder / "out").glob("visualiser*.log"))
        return ""

    def wait_for_log(self, text, run):
        self.wait_until(f"'{text}' in the log", lambda: text in self.log(), run)

    def tick(self):
        """The last one in the table, which is complete while the run is paused or slow; -1 before the first one."""
        found = re.findall(r"^(\d+)\t", self.read("out/table.txt"), flags=re.M)
        return int(found[-1]) if found else -1

    def read(self, name):
        with contextlib.suppress(OSError):
            return (self.folder / name).read_text()
        return ""

    def close(self, run, window):
        self.display.ask_to_close(window)
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assert_finished(run)
        self.assert_nothing_left(run)

    def test_viewpoints_are_stored_printed_and_recalled(self):
        run, window = self.start_window("--paused")
        self.display.key("ctrl+shift+3", "Left", "Left", "Prior", "ctrl+shift+4", "ctrl+3", "ctrl+shift+5")
        self.wait_for_log("viewpoint 5 stored", run)
        self.close(run, window)
        views = {number: (place, turn) for number, place, turn in XML.findall(run.stdout)}
        self.assertEqual(views["3"], (f"2, 2, {CAMERA_HEIGHT}", "90, -90, 0"))
        self.assertNotEqual(views["4"], views["3"])
        self.assertEqual(views["5"], views["3"])

    def test_a_click_shows_the_entity_in_an_inspector(self):
        run, window = self.start_window("--paused")
        self.wait_for_log("F1 lists the keys", run)
        corner = "200x300+690+12"
        # Keys wait for the first picture, so this one is finished when the message comes.
        self.display.key("i")
        self.wait_for_log("ids on", run)
        seen = []

        def stands():
            seen.append(self.display.colours_now(corner))
            return seen[-2:-1] == seen[-1:]

        self.wait_until("a picture that stands", stands, run)
        before = seen[-1]
        self.display.click(*on_screen(2, 2))
        self.wait_for_log("selected 'fb_a'", run)
        self.wait_until("the inspector", lambda: self.display.colours_now(corner) != before, run)
        # The inspector hides what is under it from the mouse, but not the robot beside it.
        self.display.click(*on_screen(3, 1))
        self.wait_for_log("selected 'fb_b'", run)
        # Inspectors begin 10 pixels from the upper right corner. The cross stands at the right end of the title.
        self.display.click(WIDTH - 10 - 14, 10 + 10)
        self.wait_until("the inspector gone", lambda: self.display.colours_now(corner) == before, run)
        self.close(run, window)

    def test_keys_switch_what_is_drawn(self):
        run, window = self.start_window("--paused")
        self.display.key("i", "l", "r", "c", "t", "s", "b", "t")
        for text in ("ids on", "trails on", "rays on", "collision models on", "textures off", "shadows off", "laser beams off",
                     "textures on"):
            self.wait_for_log(text, run)
        self.display.key("p")
        self.wait_for_log("written: ", run)
        picture = next((self.folder / "out").glob("picture_*.png"))
        self.assertEqual(self.display.tool("identify", "-format", "%w %h", picture), f"{WIDTH} {HEIGHT}")
        self.close(run, window)

    def test_a_distant_robot_is_drawn_so_large_that_it_is_seen(self):
        view = "<camera_view_XYZ_0>50, 50, 150</camera_view_XYZ_0><camera_view_HPR_0>90, -90, 0</camera_view_HPR_0>"
        window = (f'<{self.KIND}_render id="mainwindow"><window_size>{WIDTH}, {HEIGHT}</window_size><window_title>{TITLE}</window_title>'
                  f"{view}<use_textures>false</use_textures></{self.KIND}_render>")
        file = experiment(self.folder / "far.xml", "<maxclock>0</maxclock>", arena='<footbot id="fb" position="50,50,0"/>', size="100,100,1",
                          more=f"<visualisations>{window}</visualisations>")
        run = self.start("run", file, "--output", "out", "--quiet", "--paused", environment=self.display.environment)
        window = self.display.window(TITLE, run=run)
        self.wait_for_log("F1 lists the keys", run)
        self.display.key("p")
        self.wait_for_log("written: ", run)
        picture = next((self.folder / "out").glob("picture_*.png"))
        area = f"9x9+{WIDTH // 2 - 4}+{HEIGHT // 2 - 4}"
        # The floor is lighter. A robot of its true size has less than a pixel.
        dark = self.display.tool("convert", picture, "-crop", area, "+repage", "-colorspace", "gray", "-threshold", "78%",
                                 "-format", "%[fx:(1-mean)*81]", "info:")
        self.assertGreaterEqual(float(dark), 4)
        self.close(run, window)

    def test_beside_pictures_and_other_windows_in_one_process(self):
        """Each renderer finds its own context current, whatever the others of the thread are drawn by."""
        pictures = [f'<image_render id="{name}"><directory>{name}</directory><size>320, 240</size></image_render>' for name in ("before", "after")]
        other = '<opengl_render id="other"><window_size>300, 200</window_size><window_title>The other one</window_title></opengl_render>'
        run = self.start("run", self.experiment(pictures[0] + self.window_element() + pictures[1] + other), "--output", "out", "--quiet",
                         "--single-process", "--real-time", 2, environment=self.display.environment)
        window = self.display.window(TITLE, run=run)
        self.wait_until("pictures", lambda: len(list((self.folder / "out/after").glob("*.png"))) > 5, run)
        self.display.window(TITLE, run=run)
        self.display.ask_to_close(window)
        self.assertEqual(run.wait(), 0, run.stderr)
        for tick in range(5):
            before, after = ((self.folder / f"out/{name}/frame_{tick:06}.png").read_bytes() for name in ("before", "after"))
            self.assertEqual(before, after)
        alone = self.run_it("run", self.experiment(pictures[0]), "--output", "alone", "--single-process", "--ticks", 3)
        self.assertEqual(alone.process.returncode, 0, alone.stderr)
        self.assertEqual((self.folder / "alone/before/frame_000002.png").read_bytes(), (self.folder / "out/before/frame_000002.png").read_bytes())

    def test_pause_and_steps_by_key(self):
        for way in ((), ("--single-process",)):
            run, window = self.start_window("--real-time", 1, *way)
            self.wait_until("some ticks", lambda: self.tick() > 1, run)
            self.display.key("space")
            paused = self.tick_of_pause(run)
            self.display.key("n")
            self.wait_until("one step", lambda: self.tick() == paused + 1, run)
            if not way:
                self.display.key("shift+n")
                self.wait_until("ten steps", lambda: self.tick() == paused + 11, run)
                self.assertTrue(self.stands_still())
                self.assertEqual(self.tick(), paused + 11)
            stands_at = self.tick()
            self.display.key("ctrl+shift+1", "space")
            self.wait_until("going on", lambda: self.tick() > stands_at + 1, run)
            self.close(run, window)
            self.assertIn("<camera_view_XYZ_1>", run.stdout)
            shutil.rmtree(self.folder / "out")

    def tick_of_pause(self, run):
        self.wait_until("the pause", lambda: ",pause," in self.read("out/events.csv"), run)
        self.wait_until("the last tick before it", self.stands_still, run)
        return self.tick()

    def stands_still(self):
        """At ten ticks a second."""
        before = self.tick()
        time.sleep(1)
        return self.tick() == before

    def test_shift_drag_moves_a_robot(self):
        run, window = self.start_window("--paused")
        self.wait_for_log("F1 lists the keys", run)
        self.display.drag(on_screen(3, 1, 0.05), on_screen(2.5, 2.8, 0.05), hold="shift")
        self.wait_for_log("moved 'fb_b'", run)
        table = self.start("attach", "text", "window_test", "file=table.txt", "precision=2", "--output", self.folder)
        self.wait_until("the table", lambda: "fb_b" in self.read("table.txt"), run)
        x, y = re.search(r"fb_b.*?(-?[\d.]+)\D+([\d.]+)", self.read("table.txt")).groups()
        self.assertAlmostEqual(float(x), 2.5, delta=0.06)
        self.assertAlmostEqual(float(y), 2.8, delta=0.06)
        table.process.kill()
        table.wait()
        self.close(run, window)

    def test_the_timeline_shows_the_past_and_comes_back(self):
        """A robot that was moved stands where it was, before the event, and where it is, in the present."""
        run, window = self.start_window("--real-time", 1)
        self.wait_until("some ticks", lambda: self.tick() > 5, run)
        self.run_it("control", "window_test", "move", "fb_b", "1", "3", "0")
        self.wait_for_log("moved 'fb_b'", run)
        moved = int(re.search(r"moved 'fb_b' at tick (\d+)", self.log())[1])
        # Until the journal on the disk, which has a block twice a second, has the event.
        self.wait_until("the event", self.looks_back_at_it, run)
        self.display.key("comma", "comma")
        self.wait_until("the tick before", lambda: self.picture_of(moved - 2), run)
        self.display.key("q")
        self.wait_for_log("the present again", run)
        self.wait_until("the present", lambda: self.picture_of(moved + 20, 100000), run)
        self.assertEqual([self.has_robot(self.picture_of(moved - 2), x, y) for x, y in ((3, 1), (1, 3))], [True, False])
        self.assertEqual([self.has_robot(self.picture_of(moved + 20, 100000), x, y) for x, y in ((3, 1), (1, 3))], [False, True])
        self.close(run, window)

    def looks_back_at_it(self):
        if "looking back" in self.log():
            return True
        self.display.key("less")
        return False

    def picture_of(self, first, last=None):
        """A picture written by the key P at these ticks; asks for one as long as there is none."""
        for path in re.findall(r"written: (.*\.png)", self.log()):
            if first <= int(re.search(r"(\d+)\.png", path)[1]) <= (last or first):
                return path
        self.display.key("p")
        return None

    def has_robot(self, picture, x, y):
        centre_x, centre_y = on_screen(x, y)
        area = f"30x30+{int(centre_x) - 15}+{int(centre_y) - 15}"
        return int(self.display.tool("convert", picture, "-crop", area, "+repage", "-format", "%k", "info:")) > 60

    def test_each_tick_is_a_frame(self):
        for way in ((), ("--single-process",)):
            name = "frames" + str(len(way))
            extra = f"<write_frames>true</write_frames><frame_directory>{name}</frame_directory><frame_filename>f</frame_filename>"
            run = self.start("run", self.experiment(self.window_element(extra)), "--output", name, "--quiet", "--ticks", 6, *way,
                             environment=self.display.environment)
            self.assertEqual(run.wait(), 0, run.stderr)
            self.assert_finished(run, 6)
            frames = sorted(path.name for path in (self.folder / name / name).iterdir())
            self.assertEqual(frames, [f"f_{tick:06}.png" for tick in range(7)])
            sizes = self.display.tool("identify", "-format", "%w %h\n", *(self.folder / name / name).iterdir())
            self.assertEqual(set(sizes.splitlines()), {f"{WIDTH} {HEIGHT}"})

    def test_leds_shine_in_their_colours(self):
        """At tick 420 of the sample experiment a footbot holds its prey and says so by blue LEDs; nothing else is blue."""
        text = (CONFIGS / "prey_retrieval.xml").read_text()
        element = (f'<{self.KIND}_render id="window" window_size="{WIDTH},{HEIGHT}" write_frames="true" frame_directory="frames" every="420">'
                   "<camera_view_XYZ_0>1.7, -2.3, 3.0</camera_view_XYZ_0><camera_view_HPR_0>74, -30, 0</camera_view_HPR_0>"
                   f"</{self.KIND}_render>")
        path = self.folder / "leds.xml"
        path.write_text(re.sub(r"<visualisations>.*</visualisations>", f"<visualisations>{element}</visualisations>", text, flags=re.S))
        self.run_it("run", path, "--quiet", "--output", "out", "--ticks", 420, "--single-process", environment=self.display.environment)
        blue = [float(self.display.tool("convert", self.folder / "out" / "frames" / f"frame_{tick:06}.png", "-fx",
                                        "b > 0.75 && r < 0.2 && g < 0.2", "-format", "%[fx:mean*w*h]", "info:")) for tick in (0, 420)]
        self.assertEqual(blue[0], 0)
        self.assertGreater(blue[1], 5)

    def test_the_floor_of_a_large_arena_hides_the_ground_below_it(self):
        """From 150 m above, the depth of the floor and of the ground around the arena, 2 cm lower, differ very little."""
        element = (f'<{self.KIND}_render id="window" window_size="{WIDTH},{HEIGHT}" write_frames="true" frame_directory="frames" use_textures="false">'
                   "<camera_view_XYZ_0>50, 50, 150</camera_view_XYZ_0><camera_view_HPR_0>90, -90, 0</camera_view_HPR_0>"
                   f"</{self.KIND}_render>")
        path = experiment(self.folder / "large.xml", "<maxclock>1</maxclock>", size="100,100,1", more=f"<visualisations>{element}</visualisations>")
        run = self.run_it("run", path, "--quiet", "--output", "out", "--single-process", environment=self.display.environment)
        self.assertEqual(run.process.returncode, 0, run.stderr)
        # One of the places of the floor, and one at the left of it.
        seen = [self.display.tool("convert", self.folder / "out/frames/frame_000000.png", "-format",
                                  ",".join(f"%[fx:p{{{x},{y}}}.{channel}]" for channel in "rgb"), "info:").split(",")
                for x, y in ((450, 300), (300, 400), (600, 150), (20, 300))]
        *floor, around = [[float(value) for value in colour] for colour in seen]
        for colour in floor:
            self.assertGreater(max(abs(a - b) for a, b in zip(colour, around)), 0.02, seen)

    def test_an_attached_window_comes_and_goes(self):
        table = '<text_render id="table"><file>table.txt</file></text_render>'
        run = self.start("run", self.experiment(table), "--output", "out", "--quiet", "--real-time", 1)
        self.wait_until("some ticks", lambda: self.tick() > 1, run)
        watcher = self.start("attach", self.KIND, "window_test", f"window_title={TITLE}", f"window_size={WIDTH},{HEIGHT}",
                             "antialiasing=0", environment=self.display.environment)
        self.display.window(TITLE, run=watcher)
        self.display.key("space")
        self.tick_of_pause(run)
        self.display.key("ctrl+q")
        self.assertEqual(watcher.wait(), 0, watcher.stderr)
        self.assertIsNone(run.process.poll())
        self.assertEqual(self.run_it("control", "window_test", "stop").process.returncode, 0)
        self.assertEqual(run.wait(), 0, run.stderr)

    def test_the_listing_of_the_documentation_runs(self):
        listing = """<visualisations>
  <text_render id="text_world">
    <file>experiment_output.txt</file>
    <precision>2</precision>
  </text_render>
  <opengl_render id="mainwindow">
    <window_size>1024, 768</window_size>
    <window_title>Sample Experiment</window_title>
    <camera_view_XYZ_0>3.30811, 3.36071, 1.0</camera_view_XYZ_0>
    <camera_view_HPR_0>39, -34, 0</camera_view_HPR_0>
    <camera_view_XYZ_1>6.2875, 3.33551, 1.25</camera_view_XYZ_1>
    <camera_view_HPR_1>125, -21.5, 0</camera_view_HPR_1>
    <camera_view_XYZ_2>7.05332, 6.88148, 0.83</camera_view_XYZ_2>
    <camera_view_HPR_2>-155, 0, 0</camera_view_HPR_2>
    <use_textures>true</use_textures>
    <write_frames>false</write_frames>
    <frame_directory>Movies</frame_directory>
    <frame_filename>frame</frame_filename>
  </opengl_render>
</visualisations>"""
        path = self.folder / "listing.xml"
        text = (CONFIGS / "diffusion_10.xml").read_text()
        path.write_text(re.sub(r"<visualisations>.*</visualisations>", "", text, flags=re.S)
                        .replace("</ahss-config>", listing + "</ahss-config>"))
        run = self.start("run", path, "--quiet", "--output", "out", "--ticks", 0, environment=self.display.environment)
        window = self.display.window("Sample Experiment", run=run)
        self.display.key("ctrl+1", "ctrl+shift+9")
        self.wait_for_log("viewpoint 9 stored", run)
        self.close(run, window)
        self.assertEqual(XML.findall(run.stdout), [("9", "6.2875, 3.33551, 1.25", "125, -21.5, 0")])
        self.assertFalse((self.folder / "out" / "Movies").exists())

    def test_without_a_display_it_says_what_to_do(self):
        environment = {"DISPLAY": ""}
        for way in ((), ("--single-process",)):
            run = self.start("run", self.experiment(self.window_element()), "--quiet", "--ticks", 3, *way, environment=environment)
            self.assertEqual(run.wait(), 4, run.stderr)
            self.assertIn(f"{self.KIND}_render cannot open a window", run.stderr)
            self.assertIn("image_render draws without one", run.stderr)

    def test_pictures_change_nothing_in_the_run(self):
        options = ("--quiet", "--ticks", 8)
        plain = self.run_it("run", CONFIGS / "diffusion_10.xml", *options, "--no-visualisers")
        text = (CONFIGS / "diffusion_10.xml").read_text()
        text = re.sub(r"<visualisations>.*</visualisations>|<visualisations/>", "", text, flags=re.S)
        path = self.folder / "watched.xml"
        path.write_text(text.replace("</ahss-config>", f"<visualisations>{self.window_element()}</visualisations></ahss-config>"))
        watched = self.run_it("run", path, *options, environment=self.display.environment)
        self.assertEqual(self.assert_finished(watched, 8), self.assert_finished(plain, 8))
