// Boxes are tested by separating axes (S. Gottschalk, M. C. Lin and D. Manocha, "OBBTree: a hierarchical structure for
// rapid interference detection", SIGGRAPH 1996). Cylinders with parallel axes are tested exactly. For tilted ones, the
// box within the cylinder stands for it, so that a doubtful placement is accepted rather than refused. BodyGrid keeps a
// list of bodies for each cell that a body's box touches. Bodies over many cells are in a list of their own, and are
// tested each time.
//
// Invariant: two bodies that only touch do not overlap.
#include "common/experiment/body.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace swarmanoid::placement
{
namespace
{

constexpr double kTolerance = 1e-6;     // m
constexpr double kParallel = 1 - 1e-9;  // the cosine between two axes that count as parallel
constexpr double kLeastCell = 0.05;     // m
constexpr double kMostCells = 2e6;
constexpr std::size_t kMostCellsOfBody = 4096;
constexpr std::size_t kMostEntries = 100'000'000;

// Returns whether the projections of two bodies on an axis are disjoint. `axis` may have any length.
bool Apart(const Vector3& axis, const Eigen::Matrix3d& a, const Vector3& half_a, const Eigen::Matrix3d& b,
           const Vector3& half_b, const Vector3& between)
{
  const double length = axis.norm();
  if (length < 1e-9) return false;
  const double reach_a = (a.transpose() * axis).cwiseAbs().dot(half_a);
  const double reach_b = (b.transpose() * axis).cwiseAbs().dot(half_b);
  return std::abs(between.dot(axis)) >= reach_a + reach_b - kTolerance * length;
}

// Does the separating axis test of two boxes: three face normals of each and the nine products of their edges.
bool BoxesOverlap(const Body& a, const Vector3& half_a, const Body& b, const Vector3& half_b)
{
  const Eigen::Matrix3d axes_a = a.orientation.toRotationMatrix();
  const Eigen::Matrix3d axes_b = b.orientation.toRotationMatrix();
  const Vector3 between = b.centre - a.centre;
  for (int i = 0; i < 3; ++i)
  {
    if (Apart(axes_a.col(i), axes_a, half_a, axes_b, half_b, between)) return false;
    if (Apart(axes_b.col(i), axes_a, half_a, axes_b, half_b, between)) return false;
    for (int j = 0; j < 3; ++j)
    {
      if (Apart(axes_a.col(i).cross(axes_b.col(j)), axes_a, half_a, axes_b, half_b, between)) return false;
    }
  }
  return true;
}

// Returns half the extent of the box within a body.
Vector3 InnerHalf(const Body& body)
{
  if (!body.cylinder) return body.half;
  const double side = body.half.x() * std::sqrt(0.5);
  return {side, side, body.half.z()};
}

// Tests a cylinder and another body with parallel z axes.
bool UprightOverlap(const Body& cylinder, const Body& other)
{
  const Vector3 local = other.orientation.conjugate() * (cylinder.centre - other.centre);
  if (std::abs(local.z()) >= cylinder.half.z() + other.half.z() - kTolerance) return false;
  const double radius = cylinder.half.x() - kTolerance;
  const double reach = radius + other.half.x();
  if (other.cylinder) return local.head<2>().squaredNorm() < reach * reach;
  const double dx = std::max(0.0, std::abs(local.x()) - other.half.x());
  const double dy = std::max(0.0, std::abs(local.y()) - other.half.y());
  return dx * dx + dy * dy < radius * radius;
}

}  // namespace

Vector3 Body::HalfExtent() const
{
  const Eigen::Matrix3d axes = orientation.toRotationMatrix();
  return axes.cwiseAbs() * half;
}

std::optional<Body> BodyOf(const EntityConfiguration& entity)
{
  const EntityKindDescription& kind = DescriptionOf(entity.kind);
  if (kind.form == BodyForm::kNone) return std::nullopt;
  Body body;
  body.cylinder = kind.form == BodyForm::kCylinder;
  body.orientation = entity.pose.orientation;
  body.half = body.cylinder ? Vector3(entity.size.x(), entity.size.x(), entity.size.z() / 2) : entity.size / 2;
  body.centre = kind.origin == BodyOrigin::kBase ? entity.pose.Apply({0, 0, body.half.z()}) : entity.pose.position;
  return body;
}

bool Overlap(const Body& a, const Body& b)
{
  const double reach = a.half.norm() + b.half.norm();
  if ((a.centre - b.centre).squaredNorm() >= reach * reach) return false;
  const bool cylinders = a.cylinder || b.cylinder;
  const double parallel = std::abs((a.orientation * Vector3::UnitZ()).dot(b.orientation * Vector3::UnitZ()));
  if (cylinders && parallel > kParallel) return a.cylinder ? UprightOverlap(a, b) : UprightOverlap(b, a);
  return BoxesOverlap(a, InnerHalf(a), b, InnerHalf(b));
}

BodyGrid::BodyGrid(const Vector3& arena_size, double cell)
{
  const double smallest = std::max(cell, kLeastCell);
  const double edge = CellEdge<3>({arena_size.x(), arena_size.y(), arena_size.z()}, smallest, kMostCells);
  cells_ = {{0, 0, arena_size.x(), arena_size.y(), edge}, {0, arena_size.z(), edge}};
  heads_.assign(cells_.Count(), -1);
}

template <class Visit>
void BodyGrid::ForEachRowOf(const Body& body, const Visit& visit) const
{
  const Vector3 half = body.HalfExtent();
  cells_.ForEachRow(Vector3(body.centre - half), Vector3(body.centre + half), visit);
}

void BodyGrid::Add(const Body& body, std::uint32_t name)
{
  const auto number = static_cast<std::uint32_t>(bodies_.size());
  bodies_.push_back(body);
  names_.push_back(name);
  std::size_t cells = 0;
  ForEachRowOf(body, [&](std::uint32_t first, std::uint32_t last) { cells += last + 1 - first; });
  if (cells > kMostCellsOfBody || entries_.size() > kMostEntries)
  {
    large_.push_back(number);
    return;
  }
  ForEachRowOf(body,
               [&](std::uint32_t first, std::uint32_t last)
               {
                 for (std::uint32_t cell = first; cell <= last; ++cell)
                 {
                   entries_.push_back({number, heads_[cell]});
                   heads_[cell] = static_cast<std::int32_t>(entries_.size() - 1);
                 }
               });
}

std::optional<std::uint32_t> BodyGrid::Find(const Body& body) const
{
  std::optional<std::uint32_t> found;
  const auto look_at = [&](std::uint32_t other)
  {
    if (!found && Overlap(bodies_[other], body)) found = names_[other];
  };
  for (const std::uint32_t other : large_) look_at(other);
  ForEachRowOf(body,
               [&](std::uint32_t first, std::uint32_t last)
               {
                 for (std::uint32_t cell = first; cell <= last && !found; ++cell)
                   for (std::int32_t entry = heads_[cell]; entry >= 0; entry = entries_[entry].next)
                     look_at(entries_[entry].body);
               });
  return found;
}

}  // namespace swarmanoid::placement
