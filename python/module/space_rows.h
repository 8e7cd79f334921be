// Which row or slot of the arrays is whose: the same for a simulation of this process and for a run that it looks on
// at.
#pragma once

#include <string>
#include <vector>

#include <pybind11/pybind11.h>

namespace swarmanoid
{
class CSwarmanoidSpace;
}

namespace swarmanoid::python
{

// Of all entities, in the order of the space.
std::vector<std::string> IdsOf(const CSwarmanoidSpace& space);
std::vector<std::string> KindsOf(const CSwarmanoidSpace& space);
// Slot of its first element and number of elements. Throws pybind11::index_error and, with the names that there are,
// key_error.
pybind11::tuple SlotOf(const CSwarmanoidSpace& space, std::size_t index, const std::string& attribute);

}  // namespace swarmanoid::python
