// What the X server knows of windows. Apart from the rest: the names of X collide with others.
#pragma once

#include <memory>

namespace swarmanoid
{

// A connection to the display, to be held as long as the window: some servers start anew when the last one is closed.
// Throws std::runtime_error with what to do where there is no display: OGRE would die by a signal.
std::shared_ptr<void> ConnectToDisplay();
// Whether a window is on the screen: not minimised, though it may be covered by others.
bool IsOnScreen(void* display, unsigned long window);

}  // namespace swarmanoid
