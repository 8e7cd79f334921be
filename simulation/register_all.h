// Registers all engines, devices and renderers of the simulator with their code, for processes that have all roles: the
// launcher, and simulators of users. A program of one role describes all of them (common/plugin_descriptions), and
// registers only its own.
#pragma once

namespace swarmanoid
{

// Further calls do nothing.
void RegisterBuiltins();

}  // namespace swarmanoid
