// Registers all engines, devices and renderers of the simulator with their code, for processes that have all roles: the
// launcher, and simulators of users. A program of one role describes all of them (common/plugin_descriptions), and
// registers only its own.
#pragma once

namespace swarmanoid
{

struct Experiment;

// Further calls do nothing.
void RegisterBuiltins();

// Loads the libraries of the experiment's built-in engines, so that copies of this process have them.
void LoadEnginesOf(const Experiment& experiment);

}  // namespace swarmanoid
