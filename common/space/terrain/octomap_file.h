// Files of OctoMap occupancy trees, read and written without what OctoMap prints on standard error. Used by
// VoxelTerrain and WriteRoughTerrain, in any process.
#pragma once

#include <octomap/octomap.h>

#include <memory>
#include <string>

namespace swarmanoid
{

// A .bt (occupied or free) or .ot (probabilities) file. Throws std::runtime_error naming a file that is not there, has
// another ending, is none or is cut short.
std::unique_ptr<octomap::OcTree> ReadOctoMap(const std::string& path);

// Writes a map as .bt. Throws std::runtime_error if the file cannot be written.
void WriteOctoMap(const std::string& path, const octomap::OcTree& map);

}  // namespace swarmanoid
