#include "visualiser/ogre/display.h"

#include <X11/Xlib.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace swarmanoid
{

std::shared_ptr<void> ConnectToDisplay()
{
  Display* display = XOpenDisplay(nullptr);
  if (display == nullptr)
  {
    const char* name = std::getenv("DISPLAY");
    throw std::runtime_error(
        std::string("ogre_render cannot open a window: ") +
        (name == nullptr || *name == '\0' ? "DISPLAY is not set" : std::string("there is no X server at ") + name) +
        "; run it on a desktop, or use `ssh -X` or `xvfb-run -a`. image_render draws without one, and "
        "`swarmanoid "
        "run --no-visualisers` runs without any visualisation");
  }
  return {display, [](void* open) { XCloseDisplay(static_cast<Display*>(open)); }};
}

}  // namespace swarmanoid
