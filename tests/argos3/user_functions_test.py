"""Qt user functions of ARGoS3: what they draw in pictures, and keys that they get."""
import re
import shutil
import struct
import zlib

from running import HERE, RunningTest

WAYS = 'label="shown_ways" width="4"'
LOOP = '<loop_functions library="libargos3_shower.so" label="ways"/>'


def read_png(file):
    """Rows of red, green and blue of a PNG of eight bits."""
    data = file.read_bytes()
    at, content = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", data[at + 8:at + 18])
        if kind == b"IDAT":
            content += data[at + 8:at + 8 + length]
        at += length + 12
    assert depth == 8 and colour in (2, 6)
    size = 3 if colour == 2 else 4
    raw, before, rows = zlib.decompress(content), bytearray(size * width), []
    for y in range(height):
        start = y * (size * width + 1)
        kind, line = raw[start], bytearray(raw[start + 1:start + 1 + size * width])
        for x in range(len(line)):
            left = line[x - size] if x >= size else 0
            corner = before[x - size] if x >= size else 0
            if kind == 4:
                guess = left + before[x] - corner
                paeth = min((left, before[x], corner), key=lambda value: abs(guess - value))
            line[x] = (line[x] + (0, left, before[x], (left + before[x]) // 2, paeth if kind == 4 else 0)[kind]) & 255
        rows.append([tuple(line[x:x + 3]) for x in range(0, len(line), size)])
        before = line
    return rows


def places_of(rows, colour):
    """The pixels that are nearly of a colour: x to the right, y upwards, of a picture of 2 by 2 about its middle."""
    half = len(rows) / 2
    return [((x - half) / half, (half - y) / half) for y, row in enumerate(rows) for x, pixel in enumerate(row)
            if all(abs(a - b) < 40 for a, b in zip(pixel, colour))]


def spans_of(places):
    return [max(values) - min(values) for values in zip(*places)]


MAGENTA, CYAN, YELLOW = (255, 0, 255), (0, 255, 255), (255, 255, 0)
# In the light on what faces upwards.
CYAN_TOP, GREEN_TOP = (0, 235, 235), (0, 235, 0)


class UserFunctions(RunningTest):
    def picture(self, file, *words, at=100, size=300):
        """Of a tick of the run of a file, straight from above: x to the right, y upwards."""
        self.swarmanoid("convert", file, "--output", "converted.xml")
        text = (self.folder / "converted.xml").read_text()
        element = f'<image_render id="picture" camera="top" size="{size}, {size}" at="{at}" file="top.png"/>'
        (self.folder / "seen.xml").write_text(
            text.replace("</ahss-config>", f"<visualisations>{element}</visualisations></ahss-config>"))
        shutil.rmtree(self.folder / "seen", ignore_errors=True)
        self.swarmanoid("run", "seen.xml", "--single-process", "--output", "seen", *words)
        return read_png(self.folder / "seen" / "top.png")

    def labelled(self, label, *changes):
        return self.changed("show.argos", (WAYS, f'label="{label}"'), *changes)

    def events(self, *events):
        (self.folder / "events.csv").write_text("tick,request,entity,numbers,from,number,when\n" +
                                                "".join(f"{tick},{verb},{what},,,,\n" for tick, verb, what in events))
        return "--events", "events.csv"

    def test_pictures_show_what_loop_functions_remember(self):
        moving = self.changed("show.argos", ("<params/>", '<params speed="10"/>'))
        rows = self.picture(moving)
        disc, body, ways = (places_of(rows, colour) for colour in (CYAN, GREEN_TOP, MAGENTA))
        self.assertTrue(len(disc) > 100 and all(x > 0 and y > 0 for x, y in disc), "at 1, 1")
        self.assertTrue(len(body) > 20 and all(x < 0 and y < 0 for x, y in body), "at -1, -1")
        # One robot goes along x from 0, 0, the other along y from 0, -1, both for a metre.
        along_x = [place for place in ways if abs(place[1]) < 0.02 and place[0] > 0.1]
        along_y = [place for place in ways if abs(place[0]) < 0.02 and place[1] < -0.1]
        self.assertTrue(along_x and along_y, ways)
        self.assertEqual(places_of(self.picture(moving, at=2), MAGENTA), [], "no robot has moved yet")

    def test_what_is_in_the_frame_of_an_entity_stands_and_turns_with_it(self):
        rows = self.picture(self.labelled("ids"))
        marks = places_of(rows, MAGENTA)
        # That of fb0 lies to its right and points upwards; that of fb1, which is turned by a quarter, lies above it.
        first = [place for place in marks if place[1] > -0.2]
        second = [place for place in marks if place[1] <= -0.2]
        self.assertTrue(first and second, marks)
        self.assertTrue(all(x > 0 for x, _ in first), first)
        self.assertTrue(all(x < 0.02 for x, _ in second), second)
        for a, b in zip(spans_of(first), reversed(spans_of(second))):
            self.assertAlmostEqual(a, b, delta=0.02)
        lid = places_of(rows, CYAN_TOP)
        self.assertGreater(len(lid), 100)
        self.assertTrue(all(x < 0 and y > 0 for x, y in lid), "on the crate")
        for span in spans_of(lid):
            self.assertAlmostEqual(span / spans_of(lid)[0], 1, delta=0.15)

    def test_texts_are_in_the_picture(self):
        dark = [len(places_of(self.picture(self.labelled(label)), (0, 0, 0))) for label in ("ids", "driver")]
        self.assertGreater(dark[0], dark[1] + 20)

    def test_lines_and_areas_of_opengl_are_shown(self):
        rows = self.picture(self.labelled("raw"))
        area = places_of(rows, MAGENTA)
        self.assertTrue(len(area) > 300 and all(x < 0 for x, _ in area), "turned by a quarter about -1, -1")
        width, height = spans_of(area)
        self.assertAlmostEqual(height / width, 5, delta=1)
        line = places_of(rows, CYAN)
        self.assertTrue(len(line) > 100 and all(x > 0 and y > 0 for x, y in line))
        # Each corner behind the second one adds a triangle: they fill a square.
        strip = places_of(rows, YELLOW)
        self.assertTrue(len(strip) > 1000 and all(x > 0 and y < 0 for x, y in strip))
        width, height = (150 * span + 1 for span in spans_of(strip))
        self.assertAlmostEqual(len(strip) / (width * height), 1, delta=0.05)

    def test_keys_drive_the_robot_that_is_selected(self):
        file = self.labelled("driver", (LOOP, ""))
        self.swarmanoid("convert", file, "--output", "driven.xml")
        text = (self.folder / "driven.xml").read_text()
        table = '<visualisations><text_render id="table" file="table.tsv" format="tsv" columns="clock, Entity id, X, Y" entities="footbot"/></visualisations>'
        (self.folder / "driven.xml").write_text(text.replace("</ahss-config>", table + "</ahss-config>"))
        events = self.events((10, "press", "I"), (20, "select", "fb0"), (20, "press", "I"), (40, "release", "I"),
                            (50, "select", "fb1"), (50, "press", "Shift"), (50, "press", "Up"), (60, "press", "A"),
                            (60, "release", "Shift"), (60, "press", "A"), (70, "deselect", ""))
        self.swarmanoid("run", "driven.xml", "--single-process", "--output", "run", *events)
        rows = [line.split("\t") for line in (self.folder / "run" / "table.tsv").read_text().splitlines()[1:]]
        place = {(int(row[0]), row[1]): (float(row[2]), float(row[3])) for row in rows}
        x = {tick: place[tick, "fb0"][0] - 2 for tick in (20, 40, 60, 100)}
        self.assertAlmostEqual(x[20], 0, delta=0.001, msg="no robot is selected")
        self.assertAlmostEqual(x[40], 0.2, delta=0.02, msg="10 cm/s for 2 s")
        self.assertAlmostEqual(x[60], x[100], delta=0.01, msg="the key was let go")
        self.assertAlmostEqual(place[70, "fb1"][1] - place[50, "fb1"][1], 0.4, delta=0.05, msg="20 cm/s: with Shift")
        self.assertAlmostEqual(place[100, "fb1"][1], place[72, "fb1"][1], delta=0.02, msg="deselected")
        self.assertEqual((self.folder / "driver.txt").read_text().split(), ["+fb0", "-fb0", "+fb1", "A", "a", "-fb1"])

    def test_a_file_without_loop_functions_has_its_user_functions(self):
        file = self.labelled("ids", (LOOP, ""))
        result = self.swarmanoid("run", file, "--output", "run")
        self.assertIn("one process", result.stderr)
        self.assertIn("user functions alone have an effect", result.stderr)
        self.assertEqual(self.hash_of(file, "--output", "again"), re.search(r"hash ([0-9a-f]{16})", result.stdout).group(1))

    def test_the_hash_does_not_depend_on_who_looks(self):
        self.assertEqual(self.hash_of(HERE / "show.argos", "--output", "unseen"),
                         self.hash_of(HERE / "show.argos", "--show", "text", "--output", "seen"))

    def test_mistakes_are_named(self):
        unknown = self.swarmanoid("run", self.labelled("missing"), "--output", "a", code=3)
        self.assertRegex(unknown.stderr, r"registers no Qt user functions 'missing'; registered: driver, ids")
        nowhere = self.changed("show.argos", ('<user_functions library="libargos3_shower.so"',
                                              '<user_functions library="libnowhere.so"'))
        missing = self.swarmanoid("check", nowhere, code=3)
        self.assertRegex(missing.stderr, r"show.argos:\d+:\d+: .*libnowhere.so")
        # The library of the loop functions may have them.
        self.swarmanoid("check", self.changed("show.argos", ('<user_functions library="libargos3_shower.so"', "<user_functions")))
        nowhere = self.changed("show.argos", ('<user_functions library="libargos3_shower.so"', '<user_functions library="libnowhere.so"'))
        # They are not needed without visualisers.
        note = r"show.argos:\d+:\d+: note: the library of the user functions 'shown_ways' is not found, and none is needed"
        self.assertRegex(self.swarmanoid("check", nowhere, "--no-visualisers").stderr, note)
        self.assertRegex(self.swarmanoid("run", nowhere, "--no-visualisers", "--output", "none").stderr, note)
        early = self.swarmanoid("run", self.labelled("too_early"), "--output", "b", code=3)
        self.assertRegex(early.stdout + early.stderr, r"DrawPoint is called outside of what draws")
        meddler = self.swarmanoid("run", self.labelled("meddler"), "--show", "text", "--output", "c", code=4)
        self.assertRegex(meddler.stdout + meddler.stderr, r"Draw at tick \d+ failed: entities are changed by loop functions")
