// Whether windows can be opened here. Apart from the rest: the names of X collide with others.
#pragma once

namespace swarmanoid
{

// Throws std::runtime_error with what to do where there is no display: OGRE would die by a signal.
void RequireDisplay();

}  // namespace swarmanoid
