// Files of OctoMap occupancy trees, read and written without what OctoMap prints on standard error. Used by
// VoxelTerrain and WriteRoughTerrain, in any process.
#pragma once

#include <octomap/octomap.h>

#include <memory>
#include <string>

namespace swarmanoid
{

// Reads a .bt (occupied or free) or .ot (probabilities) file. Throws std::runtime_error, which names the file, if it
// does not exist, has another ending, is no such map or is incomplete.
std::unique_ptr<octomap::OcTree> ReadOctoMap(const std::string& path);

// Writes a map as .bt. Throws std::runtime_error if the file cannot be written.
void WriteOctoMap(const std::string& path, const octomap::OcTree& map);

}  // namespace swarmanoid
