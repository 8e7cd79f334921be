// All engines, devices and renderers of the simulator with their code, for processes that have all roles: the launcher,
// and simulators of users. A program of one role describes them all (common/plugin_descriptions) and registers its own.
#pragma once

namespace swarmanoid
{

// Idempotent.
void RegisterBuiltins();

}  // namespace swarmanoid
