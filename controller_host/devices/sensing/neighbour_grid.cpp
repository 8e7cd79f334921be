// Problem: give each sensor the bodies within a distance, for all robots in each tick.
//
// Method: a counting sort puts the movable bodies into the order of their cells, with float copies of positions and
// outlines beside them, so that a search reads rows of consecutive memory, kLanes bodies at a time. A cell holds about
// one body. Bodies that never move are listed once, in every cell from which a search of the usual reach may find them.
//
// Invariants: positions in single precision are compared with `margin_` added, so that no body in reach is missed;
// callers test exactly. Within a cell bodies are in entity order, so results do not depend on threads.
#include "controller_host/devices/sensing/neighbour_grid.h"

#include <cmath>
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

// The circle in the xy plane that holds a body, whatever its tilt.
struct Circle
{
  float x, y, radius;
};

inline Circle CircleOf(const PoseArrays& poses, std::size_t e, const BodyShape& shape)
{
  if (IsUpright(poses, e))
    return {static_cast<float>(poses.x[e]), static_cast<float>(poses.y[e]), static_cast<float>(shape.radius)};
  const Quaternion orientation(poses.qw[e], poses.qx[e], poses.qy[e], poses.qz[e]);
  const Vector3 centre = orientation * shape.centre;
  return {static_cast<float>(poses.x[e] + centre.x()), static_cast<float>(poses.y[e] + centre.y()),
          static_cast<float>(BoundingRadius(shape))};
}

struct Extent
{
  double left = 0, bottom = 0, width = 0, height = 0;
};

// The arena, or if it has no size the rectangle around all entities.
Extent ExtentOf(const CSwarmanoidSpace& space)
{
  const Vector3& size = space.GetExperiment().arena_size;
  if (size.x() > 0 && size.y() > 0) return {0, 0, size.x(), size.y()};
  const PoseArrays& poses = space.Poses();
  if (poses.x.empty()) return {};
  const auto [left, right] = std::minmax_element(poses.x.begin(), poses.x.end());
  const auto [bottom, top] = std::minmax_element(poses.y.begin(), poses.y.end());
  return {*left, *bottom, *right - *left, *top - *bottom};
}

// Returns twice the rounding of a coordinate to single precision, anywhere in the extent or slightly outside it.
float MarginOf(const Extent& extent)
{
  const double largest = std::max({std::abs(extent.left), std::abs(extent.bottom), std::abs(extent.left + extent.width),
                                   std::abs(extent.bottom + extent.height), 10.0});
  return static_cast<float>(largest * 1e-6);
}

// Cells over an extent, as small as they may be.
CellFrame FrameOver(const Extent& extent, double smallest, std::size_t most)
{
  const double edge = CellEdge<2>({extent.width, extent.height}, smallest, static_cast<double>(most));
  return {extent.left, extent.bottom, extent.width, extent.height, edge};
}

IntLanes CellsOn(const CellAxis<float>& axis, FloatLanes at)
{
  const FloatLanes cell = (at - axis.start) * axis.inverse_edge;
  return Truncated(Minimum(Maximum(cell, FloatLanes{}), Everywhere(axis.last)));
}

}  // namespace

NeighbourGrid::NeighbourGrid(const CSwarmanoidSpace& space, const BodyShapes& shapes) : space_(space), shapes_(shapes)
{
  double largest = 0.05;
  for (const std::uint32_t e : space.Movable())
    if (shapes[e].kind != Shape::Kind::kNone)
    {
      bodies_.push_back(e);
      all_cylinders_ &= shapes[e].kind == Shape::Kind::kCylinder;
      largest = std::max(largest, shapes[e].radius);
    }
  count_ = bodies_.size();
  here_.reserve(count_);
  if (all_cylinders_ &&
      std::ranges::all_of(bodies_, [&](std::uint32_t e) { return &shapes[e] == &shapes[bodies_[0]]; }))
    shape_of_all_ = bodies_.empty() ? nullptr : &shapes[bodies_[0]];

  // A cell holds about one body, and no cell is smaller than a body. The time hardly depends on the exact size.
  const Extent extent = ExtentOf(space);
  frame_ = FrameOver(extent, 2 * largest + 0.02, count_ + 4);
  margin_ = MarginOf(extent);

  sort_.SetCells(frame_.Count());
  constexpr float kFarAway = 1e18F;
  x_.resize(count_ + kLanes, kFarAway);
  y_.resize(count_ + kLanes, kFarAway);
  radius_.resize(count_ + kLanes, 0);
  low_.resize(count_ + kLanes, 0);
  high_.resize(count_ + kLanes, 0);
  origin_x_.resize(count_ + kLanes, 0);
  origin_y_.resize(count_ + kLanes, 0);
  origin_z_.resize(count_ + kLanes, 0);
  entity_.resize(count_ + kLanes, 0);
}

void NeighbourGrid::Rebuild(WorkerPool* pool)
{
  ++rebuilds_;
  sorted_from_ = bodies_;
  if (!space_.Absent().empty())
  {
    here_.clear();
    std::ranges::copy_if(bodies_, std::back_inserter(here_),
                         [this](std::uint32_t entity) { return space_.IsPresent(entity); });
    sorted_from_ = here_;
  }
  count_ = sorted_from_.size();
  const std::span<std::uint32_t> cells = sort_.Cells(count_);
  const Facts all =
      InAllParts(pool, [&](std::size_t begin, std::size_t end) { return FindCells(begin, end, cells.data()); });
  largest_radius_ = all.largest;
  all_upright_ = all.upright;
  sort_.Sort([this](std::size_t b, std::uint32_t place) { entity_[place] = sorted_from_[b]; });
  const Facts sorted = InAllParts(pool, [&](std::size_t begin, std::size_t end) { return Gather(begin, end); });
  all_level_ = sorted.level;
  are_alike_ = sorted.alike;
}

template <class Part>
NeighbourGrid::Facts NeighbourGrid::InAllParts(WorkerPool* pool, const Part& part)
{
  facts_.assign(pool == nullptr ? 1 : pool->Parts(), {});
  InParts(pool, count_, kLanes, [&](unsigned k, std::size_t begin, std::size_t end) { facts_[k] = part(begin, end); });
  Facts all;
  for (const Facts& facts : facts_)
  {
    all.largest = std::max(all.largest, facts.largest);
    all.upright &= facts.upright;
    all.level &= facts.level;
    all.alike &= facts.alike;
  }
  return all;
}

NeighbourGrid::Facts NeighbourGrid::FindCells(std::size_t begin, std::size_t end, std::uint32_t* cells) const
{
  const PoseArrays& poses = space_.Poses();
  Facts facts;
  std::size_t b = begin;
  // Several consecutive upright bodies of one shape are processed at a time.
  if (shape_of_all_ != nullptr)
  {
    facts.largest = begin < end ? static_cast<float>(shape_of_all_->radius) : 0;
    const auto follow = [&]
    {
      const std::uint32_t e = sorted_from_[b];
      if (sorted_from_[b + kLanes - 1] - e != kLanes - 1) return false;
      bool upright = true;
      for (std::size_t lane = 0; lane < kLanes; ++lane) upright &= poses.qx[e + lane] == 0 && poses.qy[e + lane] == 0;
      return upright;
    };
    for (; b + kLanes <= end && follow(); b += kLanes)
    {
      const std::size_t e = sorted_from_[b];
      const IntLanes row = CellsOn(frame_.rows, Differences(&poses.y[e], 0));
      const IntLanes column = CellsOn(frame_.columns, Differences(&poses.x[e], 0));
      StoreLanes(row * static_cast<std::int32_t>(frame_.stride) + column, reinterpret_cast<std::int32_t*>(cells + b));
    }
  }
  for (; b < end; ++b)
  {
    const std::uint32_t e = sorted_from_[b];
    const Circle circle = CircleOf(poses, e, shape_of_all_ != nullptr ? *shape_of_all_ : shapes_[e]);
    facts.upright &= IsUpright(poses, e);
    facts.largest = std::max(facts.largest, circle.radius);
    cells[b] = frame_.CellOf(circle.x, circle.y);
  }
  return facts;
}

NeighbourGrid::Facts NeighbourGrid::Gather(std::size_t begin, std::size_t end)
{
  const PoseArrays& poses = space_.Poses();
  Facts facts;
  if (begin == end) return facts;
  const double height = poses.z[entity_[0]];
  for (std::size_t place = begin; place < end; ++place)
  {
    const std::uint32_t e = entity_[place];
    origin_x_[place] = poses.x[e];
    origin_y_[place] = poses.y[e];
    origin_z_[place] = poses.z[e];
    facts.level &= origin_z_[place] == height;
  }
  if (shape_of_all_ != nullptr && all_upright_)
  {
    OutlineAlike(*shape_of_all_, begin, end);
    facts.alike = facts.level;
  }
  else
    facts.alike = OutlineEach(begin, end);
  return facts;
}

void NeighbourGrid::OutlineAlike(const BodyShape& shape, std::size_t begin, std::size_t end)
{
  for (std::size_t place = begin; place < end; ++place)
  {
    x_[place] = static_cast<float>(origin_x_[place]);
    y_[place] = static_cast<float>(origin_y_[place]);
    low_[place] = static_cast<float>(origin_z_[place] + shape.low);
    high_[place] = static_cast<float>(origin_z_[place] + shape.high);
    radius_[place] = static_cast<float>(shape.radius);
  }
}

bool NeighbourGrid::OutlineEach(std::size_t begin, std::size_t end)
{
  const PoseArrays& poses = space_.Poses();
  // The shape is that of the first body of all, in every thread.
  const BodyShape& shape_of_first = shapes_[entity_[0]];
  const float radius = CircleOf(poses, entity_[0], shape_of_first).radius;
  const auto low = static_cast<float>(poses.z[entity_[0]] + shape_of_first.low);
  const auto high = static_cast<float>(poses.z[entity_[0]] + shape_of_first.high);
  bool alike = true;
  for (std::size_t place = begin; place < end; ++place)
  {
    const BodyShape& shape = shapes_[entity_[place]];
    const Circle circle = CircleOf(poses, entity_[place], shape);
    x_[place] = circle.x;
    y_[place] = circle.y;
    radius_[place] = circle.radius;
    low_[place] = static_cast<float>(origin_z_[place] + shape.low);
    high_[place] = static_cast<float>(origin_z_[place] + shape.high);
    alike &= (radius_[place] == radius) & (low_[place] == low) & (high_[place] == high);
  }
  return alike;
}

void NeighbourGrid::FindWindows(const std::int32_t* places, double reach, CellWindows& windows) const
{
  const auto [x, y] = MiddlesAt(places);
  const float widest = static_cast<float>(reach) + margin_ + largest_radius_;
  StoreLanes(CellsOn(frame_.rows, y - widest), windows.first_row.data());
  StoreLanes(CellsOn(frame_.rows, y + widest), windows.last_row.data());
  StoreLanes(CellsOn(frame_.columns, x - widest), windows.first_column.data());
  StoreLanes(CellsOn(frame_.columns, x + widest), windows.last_column.data());
}

void FixedBodies::FindCells(const NeighbourGrid& grid, const std::int32_t* places, std::int32_t* cells) const
{
  const auto [x, y] = grid.MiddlesAt(places);
  StoreLanes(CellsOn(frame_.rows, y) * static_cast<std::int32_t>(frame_.stride) + CellsOn(frame_.columns, x), cells);
}

void NearBodies::Reserve(std::size_t bodies)
{
  for (std::vector<float>* values : {&x, &y, &radius, &low, &high}) values->resize(bodies + 2 * kLanes);
  entity.resize(bodies + 2 * kLanes);
  place.resize(bodies + 2 * kLanes);
}

void NeighbourGrid::CollectNear(double x, double y, double reach, std::uint32_t left_out, NearBodies& near) const
{
  near.are_alike = are_alike_;
  near.count = are_alike_ ? Collect<true>(x, y, reach, left_out, near) : Collect<false>(x, y, reach, left_out, near);
  if (!are_alike_ || near.radius[0] != radius_[0] || near.low[0] != low_[0] || near.high[0] != high_[0]) near.alike = 0;
  if (!are_alike_) return;
  for (; near.alike < near.count; near.alike += kLanes)
  {
    StoreLanes(Everywhere(radius_[0]), &near.radius[near.alike]);
    StoreLanes(Everywhere(low_[0]), &near.low[near.alike]);
    StoreLanes(Everywhere(high_[0]), &near.high[near.alike]);
  }
}

template <bool kAlike>
std::size_t NeighbourGrid::Collect(double x, double y, double reach, std::uint32_t left_out, NearBodies& near) const
{
  const auto fx = static_cast<float>(x);
  const auto fy = static_cast<float>(y);
  const float own = static_cast<float>(reach) + margin_;
  const IntLanes left_out_lanes = Everywhere(static_cast<int>(left_out));
  const float cut_of_all = radius_[0] + own;
  const FloatLanes square_of_all = Everywhere(cut_of_all * cut_of_all);
  // These local copies are needed because the compiler must assume that stores of lanes change any member.
  const float* const body_x = x_.data();
  const float* const body_y = y_.data();
  const float* const body_radius = radius_.data();
  const float* const body_low = low_.data();
  const float* const body_high = high_.data();
  const double* const origin_x = origin_x_.data();
  const double* const origin_y = origin_y_.data();
  const auto* const body_entity = reinterpret_cast<const std::int32_t*>(entity_.data());
  float* const near_x = near.x.data();
  float* const near_y = near.y.data();
  float* const near_radius = near.radius.data();
  float* const near_low = near.low.data();
  float* const near_high = near.high.data();
  std::int32_t* const near_entity = near.entity.data();
  std::int32_t* const near_place = near.place.data();
  std::size_t count = 0;
  ForEachSpanNear(x, y, reach,
                  [&](std::size_t first, std::size_t behind)
                  {
                    for (std::size_t i = first; i < behind; i += kLanes)
                    {
                      const FloatLanes dx = LoadLanes(body_x + i) - fx;
                      const FloatLanes dy = LoadLanes(body_y + i) - fy;
                      const FloatLanes radius = kAlike ? FloatLanes{} : LoadLanes(body_radius + i);
                      const FloatLanes cut = radius + own;
                      const FloatLanes square = kAlike ? square_of_all : cut * cut;
                      const IntLanes entity = LoadLanes(body_entity + i);
                      const Selection selection(LaneMask((dx * dx + dy * dy <= square) & ~(entity == left_out_lanes) &
                                                         FirstLanes(behind - i)));
                      selection.Store(Differences(origin_x + i, x), near_x + count);
                      selection.Store(Differences(origin_y + i, y), near_y + count);
                      selection.Store(entity, near_entity + count);
                      selection.Store(static_cast<int>(i) + LaneNumbers(), near_place + count);
                      if constexpr (!kAlike)
                      {
                        selection.Store(radius, near_radius + count);
                        selection.Store(LoadLanes(body_low + i), near_low + count);
                        selection.Store(LoadLanes(body_high + i), near_high + count);
                      }
                      count += selection.Count();
                    }
                  });
  return count;
}

FixedBodies::FixedBodies(const CSwarmanoidSpace& space, const BodyShapes& shapes, double reach)
{
  std::vector<std::uint32_t> fixed;
  for (std::uint32_t e = 0; e < space.Size(); ++e)
    if (!space.GetEntity(e).IsMovable() && shapes[e].kind != Shape::Kind::kNone) fixed.push_back(e);

  // Small against the reach, so that few bodies beyond it are listed, but few enough to stay in the cache.
  const double smallest_cell = std::max(0.25, reach / 6);
  constexpr std::size_t kCells = 65536;
  const Extent extent = ExtentOf(space);
  frame_ = FrameOver(extent, smallest_cell, fixed.empty() ? 1 : kCells);
  margin_ = MarginOf(extent);

  // Each body is listed in the cells in the rectangle around its bounding circle or box whose centre is near enough.
  const double edge = 1 / static_cast<double>(frame_.rows.inverse_edge);
  const double around = reach + static_cast<double>(margin_) + edge * 0.70711;
  const std::uint32_t last_column = frame_.columns.Count() - 1;
  const std::uint32_t last_row = frame_.rows.Count() - 1;
  for (const std::uint32_t e : fixed)
  {
    const Pose pose = space.GetPose(e);
    const Eigen::Matrix3d rotation = pose.orientation.toRotationMatrix();
    const Vector3 centre = pose.Apply(shapes[e].centre);
    const Vector3& half = shapes[e].half_size;
    const Vector3 reached = (rotation.cwiseAbs() * half).array() + around;
    const bool upright = pose.orientation.x() == 0 && pose.orientation.y() == 0;
    const auto is_near = [&](std::uint32_t column, std::uint32_t row)
    {
      // Cells at the border stand for all that lies outside, too.
      if (!upright || row == 0 || column == 0 || row == last_row || column == last_column) return true;
      const Vector3 middle(frame_.columns.start + (column + 0.5) * edge, frame_.rows.start + (row + 0.5) * edge,
                           centre.z());
      const Vector3 local = rotation.transpose() * (middle - centre);
      return std::abs(local.x()) <= half.x() + around && std::abs(local.y()) <= half.y() + around;
    };
    frame_.ForEachRow(static_cast<float>(centre.x() - reached.x()), static_cast<float>(centre.y() - reached.y()),
                      static_cast<float>(centre.x() + reached.x()), static_cast<float>(centre.y() + reached.y()),
                      [&](std::uint32_t first, std::uint32_t last)
                      {
                        for (std::uint32_t cell = first; cell <= last; ++cell)
                          if (is_near(cell % frame_.stride, cell / frame_.stride)) lists_.Add(cell, e);
                      });
  }
  lists_.Close(frame_.Count());
}

}  // namespace swarmanoid
