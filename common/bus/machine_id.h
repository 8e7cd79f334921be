// Who may share memory: processes of one user, on one kernel, in one network namespace. Used by the bus.
#pragma once

#include <cstdint>

namespace swarmanoid
{

std::uint16_t MachineId();

}  // namespace swarmanoid
