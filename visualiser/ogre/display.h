// Tests whether windows can be opened. It is a separate file, since the names of X collide with others.
#pragma once

#include <memory>

namespace swarmanoid
{

// Returns a connection to the display. Hold it until the window has its own, since some servers reset when the last
// connection closes. Throws std::runtime_error with the cure if there is no display; OGRE would die by a signal.
std::shared_ptr<void> ConnectToDisplay();

}  // namespace swarmanoid
