// The entities and attributes of the rows and slots of arrays, for a simulation of this process and for an observed
// run.
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

// Return the ids and kinds of all entities, in the order of the space.
std::vector<std::string> IdsOf(const CSwarmanoidSpace& space);
std::vector<std::string> KindsOf(const CSwarmanoidSpace& space);
// Returns the slot of the attribute's first element, and the number of elements. Throws pybind11::index_error, or
// key_error with the names that exist.
pybind11::tuple SlotOf(const CSwarmanoidSpace& space, std::size_t index, const std::string& attribute);

}  // namespace swarmanoid::python
