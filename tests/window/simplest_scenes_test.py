"""Every renderer with a window, of nothing and of one entity of each kind, on an X server without a screen."""
import os
import pathlib
import subprocess
import unittest

import display

display.need("opengl_render")


class SimplestScenes(unittest.TestCase):
    def test_each_window_draws_nothing_and_one_entity_of_each_kind(self):
        server = display.Display()
        self.addCleanup(server.close)
        program = pathlib.Path(os.environ["SWARMANOID_BUILD"]) / "bin" / "tests" / "unit_every_plugin"
        run = subprocess.run([program, "--gtest_filter=SimplestScenes.EachWindow*"], env={**os.environ, **server.environment},
                             capture_output=True, text=True, timeout=500)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("[  PASSED  ] 1 test", run.stdout)
