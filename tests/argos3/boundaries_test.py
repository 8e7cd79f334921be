"""Boundaries of ARGoS3's engines become volumes."""
import re

from running import RunningTest

ONE = '<physics_engines><dynamics2d id="dyn2d"/></physics_engines>'


def engine(name, boundaries):
    return f'<dynamics2d id="{name}">{boundaries}</dynamics2d>'


def sides(*points):
    return "<sides>" + "".join(f'<vertex point="{point}"/>' for point in points) + "</sides>"


def engines(*each):
    return (ONE, f"<physics_engines>{''.join(each)}</physics_engines>")


WEST = sides("-3,-3", "0,-3", "0,3", "-3,3")
EAST = sides("0,-3", "3,-3", "3,3", "0,3")


class Boundaries(RunningTest):
    def test_robots_change_between_engines_with_boundaries(self):
        file = self.changed("wander.argos", engines(engine("west", f'<boundaries><top height="1"/><bottom height="0"/>{WEST}</boundaries>'),
                                                    engine("east", f"<boundaries>{EAST}</boundaries>")))
        text = self.swarmanoid("convert", file).stdout
        # The arena begins at 0, 0 here, and at -2, -2 there.
        self.assertRegex(text, r'<engine id="west" volume="-1, -1, 2, -1, 2, 5, -1, 5" heights="0, 1"')
        self.assertRegex(text, r'<engine id="east" volume="2, -1, 5, -1, 5, 5, 2, 5"')
        self.swarmanoid("run", file, "--output", "run")
        self.assertEqual(self.hash_of(file, "--single-process", "--output", "one"), self.hash_of(file, "--output", "again"))

    def test_without_boundaries_engines_of_a_kind_are_one(self):
        run = self.swarmanoid("convert", self.changed("wander.argos", engines(engine("a", ""), engine("b", ""))))
        self.assertIn("and the one before are one engine here", run.stderr)
        self.assertEqual(re.findall(r'<dynamics2d id="(\w+)"', run.stdout), ["a"])

    def test_mistakes_are_named(self):
        for boundaries, words in ((sides("0,0", "1,0"), "at least three <vertex>"), (sides("0,0", "1,0", "1"), "two numbers with a comma")):
            run = self.swarmanoid("convert", self.changed("wander.argos", engines(engine("a", f"<boundaries>{boundaries}</boundaries>"))), code=3)
            self.assertIn(words, run.stderr)
