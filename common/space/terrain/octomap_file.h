// Reads and writes files of OctoMap occupancy trees without OctoMap's own prints on standard error. VoxelTerrain and
// WriteRoughTerrain use it, in any process.
#pragma once

#include <octomap/octomap.h>

#include <memory>
#include <string>

namespace swarmanoid
{

// Reads a .bt (occupied or free) or .ot (probabilities) file of an OcTree, ColorOcTree or OcTreeStamped. Throws
// std::runtime_error, which names the file, if it does not exist, has another ending, is no such map or is incomplete.
std::unique_ptr<octomap::OcTree> ReadOctoMap(const std::string& path);

// Writes a map as .bt. Throws std::runtime_error if the file cannot be written.
void WriteOctoMap(const std::string& path, const octomap::OcTree& map);

}  // namespace swarmanoid
