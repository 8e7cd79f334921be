// Contacts of a sphere with the occupied cells of a map, in the frame of the map.
#pragma once

#include <vector>

#include "common/space/terrain/terrain.h"

namespace swarmanoid::dynamics3d
{

struct VoxelContact
{
  Vector3 point = Vector3::Zero();    // of the solid, nearest to the sphere's centre
  Vector3 normal = Vector3::UnitZ();  // out of the solid
  double depth = 0;                   // m, positive where the sphere reaches into the solid
};

// Appends the contacts cell by cell, but for those that a neighbouring cell covers: a plane made of cells has one
// normal and no edges. A centre within the solid is led out through the nearest free face.
void FindVoxelContacts(const VoxelTerrain& terrain, const Vector3& centre, double radius,
                       std::vector<VoxelContact>& contacts);

}  // namespace swarmanoid::dynamics3d
