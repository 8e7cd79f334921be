"""The window of ogre_render does what that of opengl_render does: the same keys and mouse on the same panels. Without a display it says so."""
import display

display.need("ogre_render")

import opengl_window_test  # noqa: E402
from harness import main  # noqa: E402


class OgreWindow(opengl_window_test.Window):
    KIND = "ogre"


if __name__ == "__main__":
    main()
