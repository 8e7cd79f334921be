"""The window of ogre_render does what that of opengl_render does: the same keys and mouse on the same panels. Without a display it says so."""
import display

display.need("ogre_render")

import opengl_window_test  # noqa: E402


class OgreWindow(opengl_window_test.Window):
    KIND = "ogre"

    def test_there_is_one_in_a_process(self):
        run = self.run_it("run", self.experiment(self.window_element() + '<ogre_render id="other"/>'), "--single-process", "--ticks", 3,
                          environment=self.display.environment)
        self.assertEqual(run.process.returncode, 4)
        self.assertIn("'other' (ogre_render): Init at tick 0 failed: a process has one ogre_render at most", run.stderr)
