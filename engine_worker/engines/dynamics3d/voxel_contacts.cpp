#include "engine_worker/engines/dynamics3d/voxel_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace swarmanoid::dynamics3d
{
namespace
{

using Cell = std::array<int, 3>;

bool IsNeighbourSolid(const VoxelTerrain& terrain, Cell cell, std::size_t axis, int step)
{
  cell[axis] += step;
  return terrain.IsOccupied(cell[0], cell[1], cell[2]);
}

Vector3 LowCorner(const VoxelTerrain& terrain, const Cell& cell)
{
  return terrain.Low() + terrain.CellSize() * Vector3(cell[0], cell[1], cell[2]);
}

// Of a centre inside the cell.
bool FindWayOut(const VoxelTerrain& terrain, const Cell& cell, const Vector3& centre, double radius,
                VoxelContact& contact)
{
  const Vector3 low = LowCorner(terrain, cell);
  double shortest = std::numeric_limits<double>::infinity();
  for (const int axis : {2, 1, 0})  // up first: among equal ways the one that gravity allows
  {
    for (const int step : {1, -1})
    {
      if (IsNeighbourSolid(terrain, cell, static_cast<std::size_t>(axis), step)) continue;
      const double way = step > 0 ? low[axis] + terrain.CellSize() - centre[axis] : centre[axis] - low[axis];
      if (way >= shortest) continue;
      shortest = way;
      contact.normal = Vector3::Zero();
      contact.normal[axis] = step;
    }
  }
  if (std::isinf(shortest)) return false;
  contact.point = centre + contact.normal * shortest;
  contact.depth = radius + shortest;
  return true;
}

bool FindContact(const VoxelTerrain& terrain, const Cell& cell, const Vector3& centre, double radius,
                 VoxelContact& contact)
{
  const Vector3 low = LowCorner(terrain, cell);
  const Vector3 nearest = centre.cwiseMax(low).cwiseMin(low + Vector3::Constant(terrain.CellSize()));
  const Vector3 out = centre - nearest;
  const double square = out.squaredNorm();
  if (square == 0) return FindWayOut(terrain, cell, centre, radius, contact);
  if (square >= radius * radius) return false;
  // An edge or face towards a solid neighbour is inside the solid.
  for (const int axis : {0, 1, 2})
    if (out[axis] != 0 && IsNeighbourSolid(terrain, cell, static_cast<std::size_t>(axis), out[axis] > 0 ? 1 : -1))
      return false;
  const double distance = std::sqrt(square);
  contact.point = nearest;
  contact.normal = out / distance;
  contact.depth = radius - distance;
  return true;
}

}  // namespace

void FindVoxelContacts(const VoxelTerrain& terrain, const Vector3& centre, double radius,
                       std::vector<VoxelContact>& contacts)
{
  const std::array<int, 3> counts = {terrain.CellsX(), terrain.CellsY(), terrain.CellsZ()};
  Cell first;
  Cell last;
  for (const int axis : {0, 1, 2})
  {
    const auto k = static_cast<std::size_t>(axis);
    const double middle = (centre[axis] - terrain.Low()[axis]) / terrain.CellSize();
    const double reach = radius / terrain.CellSize();
    first[k] = static_cast<int>(std::floor(std::clamp(middle - reach, 0.0, 1e9)));
    last[k] = static_cast<int>(std::floor(std::clamp(middle + reach, -1.0, counts[k] - 1.0)));
  }
  VoxelContact contact;
  for (int z = first[2]; z <= last[2]; ++z)
    for (int y = first[1]; y <= last[1]; ++y)
      for (int x = first[0]; x <= last[0]; ++x)
        if (terrain.IsOccupied(x, y, z) && FindContact(terrain, {x, y, z}, centre, radius, contact))
          contacts.push_back(contact);
}

}  // namespace swarmanoid::dynamics3d
