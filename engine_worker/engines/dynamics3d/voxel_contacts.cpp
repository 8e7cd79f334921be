// Problem: a floor of cells must act as one plane. Contacts with each cell alone would have normals at the edges inside
// the floor, and robots would stumble.
//
// Method: the point of a cell nearest to the sphere's centre gives its contact. If that point is on a face, edge or
// corner towards an occupied neighbour, it is inside the solid, and the contact is dropped. A centre within a cell
// leaves through its nearest free face, upwards among equal ways. MergeCells grows a box from each free cell along x,
// then y, then z.
//
// Invariant: contacts and boxes are in the order of the cells: z, then y, then x.
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

// kFacing is the largest lean of a normal towards a face, 17 degrees. kLevel means that the normal is the face's to 8
// degrees.
constexpr double kFacing = 0.3;
constexpr double kLevel = 0.99;

bool IsNeighbourSolid(const VoxelTerrain& terrain, Cell cell, std::size_t axis, int step)
{
  cell[axis] += step;
  return terrain.IsOccupied(cell[0], cell[1], cell[2]);
}

Vector3 LowCorner(const VoxelTerrain& terrain, const Cell& cell)
{
  return terrain.Low() + terrain.CellSize() * Vector3(cell[0], cell[1], cell[2]);
}

// Finds the contact for a centre inside the cell, through the nearest free face.
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

CellBox CellsAround(const VoxelTerrain& terrain, const Vector3& low, const Vector3& high)
{
  const std::array<int, 3> counts = {terrain.CellsX(), terrain.CellsY(), terrain.CellsZ()};
  CellBox range{};
  for (const int axis : {0, 1, 2})
  {
    const auto k = static_cast<std::size_t>(axis);
    const auto cell = [&](double at)
    {
      const double place = (at - terrain.Low()[axis]) / terrain.CellSize();
      return static_cast<int>(std::floor(std::clamp(place, -2.0, counts[k] + 1.0)));
    };
    range.low[k] = std::max(cell(low[axis]) - 1, 0);
    range.high[k] = std::min(cell(high[axis]) + 1, counts[k] - 1);
  }
  return range;
}

void MergeCells(const VoxelTerrain& terrain, const CellBox& range, std::vector<bool>& taken,
                std::vector<CellBox>& boxes)
{
  boxes.clear();
  std::array<int, 3> size;
  for (std::size_t k = 0; k < 3; ++k)
  {
    size[k] = range.high[k] - range.low[k] + 1;
    if (size[k] <= 0) return;
  }
  const auto place = [&](int x, int y, int z)
  { return static_cast<std::size_t>(((z - range.low[2]) * size[1] + y - range.low[1]) * size[0] + x - range.low[0]); };
  taken.assign(static_cast<std::size_t>(size[0] * size[1] * size[2]), false);
  const auto is_free = [&](const CellBox& box)
  {
    for (int z = box.low[2]; z <= box.high[2]; ++z)
      for (int y = box.low[1]; y <= box.high[1]; ++y)
        for (int x = box.low[0]; x <= box.high[0]; ++x)
          if (taken[place(x, y, z)] || !terrain.IsOccupied(x, y, z)) return false;
    return true;
  };
  for (int z = range.low[2]; z <= range.high[2]; ++z)
    for (int y = range.low[1]; y <= range.high[1]; ++y)
      for (int x = range.low[0]; x <= range.high[0]; ++x)
      {
        if (taken[place(x, y, z)] || !terrain.IsOccupied(x, y, z)) continue;
        CellBox box{{x, y, z}, {x, y, z}};
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          CellBox next = box;
          for (next.low[axis] = next.high[axis] = box.high[axis] + 1;
               next.low[axis] <= range.high[axis] && is_free(next); ++next.low[axis], ++next.high[axis])
            box.high[axis] = next.high[axis];
        }
        for (int k = box.low[2]; k <= box.high[2]; ++k)
          for (int j = box.low[1]; j <= box.high[1]; ++j)
            for (int i = box.low[0]; i <= box.high[0]; ++i) taken[place(i, j, k)] = true;
        boxes.push_back(box);
      }
}

bool IsCovered(const VoxelTerrain& terrain, const CellBox& box, const Vector3& point, const Vector3& normal)
{
  Cell cell;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto axis = static_cast<Eigen::Index>(k);
    const double place = std::floor((point[axis] - terrain.Low()[axis]) / terrain.CellSize());
    cell[k] = static_cast<int>(std::clamp(place, static_cast<double>(box.low[k]), static_cast<double>(box.high[k])));
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double along = normal[static_cast<Eigen::Index>(k)];
    if (std::abs(along) < kFacing) continue;
    Cell edge = cell;
    edge[k] = along > 0 ? box.high[k] : box.low[k];
    if (std::abs(along) < kLevel && edge[k] != cell[k]) continue;
    if (IsNeighbourSolid(terrain, edge, k, along > 0 ? 1 : -1)) return true;
  }
  return false;
}

}  // namespace swarmanoid::dynamics3d
