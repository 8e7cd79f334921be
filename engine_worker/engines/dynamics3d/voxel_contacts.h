// Contacts of a sphere with the occupied cells of a map, and boxes of cells for other bodies, in the frame of the map.
#pragma once

#include <array>
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

// Appends the contacts cell by cell. Contacts that a neighbouring cell covers are left out, so a plane made of cells
// has one normal and no edges. A centre within the solid is led out through the nearest free face.
void FindVoxelContacts(const VoxelTerrain& terrain, const Vector3& centre, double radius,
                       std::vector<VoxelContact>& contacts);

// Cells from low to high, both counted.
struct CellBox
{
  std::array<int, 3> low;
  std::array<int, 3> high;
};

// Returns the cells that a box (m) reaches, and one more to each side, within the map; empty if it does not reach the
// map.
CellBox CellsAround(const VoxelTerrain& terrain, const Vector3& low, const Vector3& high);
// Covers the occupied cells of a range by few boxes that do not overlap. `taken` is memory to work in.
void MergeCells(const VoxelTerrain& terrain, const CellBox& range, std::vector<bool>& taken,
                std::vector<CellBox>& boxes);
// Returns whether a contact at a point of a box of cells presses against a face that a neighbouring cell covers.
bool IsCovered(const VoxelTerrain& terrain, const CellBox& box, const Vector3& point, const Vector3& normal);

}  // namespace swarmanoid::dynamics3d
