"""tests/outcomes.py on JUnit files as ctest writes them."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from outcomes import outcomes

PASSED = '<testcase name="{}" status="run"><system-out>fine</system-out></testcase>'
FAILED = '<testcase name="{}" status="fail"><failure message=""/><system-out>1 != 2</system-out></testcase>'
SKIPPED = '<testcase name="{}" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/><system-out>{}</system-out></testcase>'


class Outcomes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def results(self, name, *cases):
        file = self.folder / name
        file.write_text(f"<testsuite>{''.join(cases)}</testsuite>", encoding="utf-8")
        return file

    def test_passed_and_failed_are_counted(self):
        first = self.results("a.xml", PASSED.format("x"), FAILED.format("y"), PASSED.format("z"))
        self.assertEqual(outcomes(first), (["2 passed, 1 failed"], 1))
        self.assertEqual(outcomes(self.results("b.xml")), (["0 passed, 0 failed"], 0))

    def test_skipped_tests_have_their_reason(self):
        first = self.results("a.xml", SKIPPED.format("g", "a.cpp:3: Skipped\nno musl\n"),
                             SKIPPED.format("u", "test_x ... skipped 'no X server'"), SKIPPED.format("s", "first\nno git\n"),
                             SKIPPED.format("n", ""), PASSED.format("x"))
        self.assertEqual(outcomes(first), (["skipped: g: no musl", "skipped: u: no X server", "skipped: s: no git",
                                            "skipped: n: no reason given", "1 passed, 0 failed, 4 skipped"], 0))

    def test_only_failed_tests_that_pass_again_count_as_passed(self):
        first = self.results("a.xml", FAILED.format("unsteady"), FAILED.format("broken"), PASSED.format("x"))
        again = self.results("b.xml", PASSED.format("unsteady"), FAILED.format("broken"))
        lines, failed = outcomes(first, again)
        self.assertEqual(failed, 1)
        self.assertEqual(lines[-1], "2 passed, 1 failed")
        self.assertEqual([line.split(":")[1] for line in lines[:-1]], [" unsteady"])
        # A test that did not run again, or is skipped then, stays failed.
        self.assertEqual(outcomes(first, self.results("c.xml"))[1], 2)
        self.assertEqual(outcomes(first, self.results("d.xml", SKIPPED.format("broken", "")))[1], 2)


if __name__ == "__main__":
    unittest.main()
