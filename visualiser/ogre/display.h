// Whether windows can be opened here. Apart from the rest: the names of X collide with others.
#pragma once

#include <memory>

namespace swarmanoid
{

// A connection to the display, to be held until the window has one of its own: some servers start anew when the last
// one is closed. Throws std::runtime_error with what to do if there is no display: OGRE would die by a signal.
std::shared_ptr<void> ConnectToDisplay();

}  // namespace swarmanoid
