#include "controller_host/devices/sensing/neighbour_grid.h"

#include <cmath>

namespace swarmanoid
{
namespace
{

// The circle in the xy plane that holds a body, whatever its tilt.
struct Circle
{
  float x, y, radius;
};

Circle CircleOf(const PoseArrays& poses, std::size_t e, const BodyShape& shape)
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

// The arena, or where it has no size the rectangle around all entities.
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

// Twice the rounding of a coordinate to single precision, anywhere in the extent or not far outside it.
float MarginOf(const Extent& extent)
{
  const double largest = std::max({std::abs(extent.left), std::abs(extent.bottom), std::abs(extent.left + extent.width),
                                   std::abs(extent.bottom + extent.height), 10.0});
  return static_cast<float>(largest * 1e-6);
}

}  // namespace

CellFrame CellFrame::Over(double left, double bottom, double width, double height, double smallest_cell,
                          std::size_t most_cells)
{
  width = std::max(width, smallest_cell);
  height = std::max(height, smallest_cell);
  const auto counts = [&](double cell) { return std::ceil(width / cell) * std::ceil(height / cell); };
  double cell = std::max(smallest_cell, std::sqrt(width * height / static_cast<double>(most_cells)));
  while (counts(cell) > static_cast<double>(most_cells)) cell *= 1.2;
  CellFrame frame;
  frame.left = static_cast<float>(left);
  frame.bottom = static_cast<float>(bottom);
  frame.inverse_size = static_cast<float>(1 / cell);
  frame.columns = static_cast<int>(std::ceil(width / cell));
  frame.rows = static_cast<int>(std::ceil(height / cell));
  return frame;
}

NeighbourGrid::NeighbourGrid(const CSwarmanoidSpace& space, std::span<const BodyShape> shapes)
    : space_(space), shapes_(shapes)
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
  here_ = bodies_;

  // About one body a cell, and no cell smaller than a body (facts: the optimum is flat).
  const Extent extent = ExtentOf(space);
  frame_ = CellFrame::Over(extent.left, extent.bottom, extent.width, extent.height, 2 * largest + 0.02, count_ + 4);
  margin_ = MarginOf(extent);

  cell_.resize(count_);
  body_x_.resize(count_);
  body_y_.resize(count_);
  body_radius_.resize(count_);
  start_.resize(frame_.Cells() + 2);
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

void NeighbourGrid::Rebuild()
{
  const PoseArrays& poses = space_.Poses();
  here_.clear();
  std::ranges::copy_if(bodies_, std::back_inserter(here_),
                       [this](std::uint32_t entity) { return space_.IsPresent(entity); });
  count_ = here_.size();
  // Counts two places up: after the scatter below, start_[c] is where cell c begins.
  std::fill(start_.begin(), start_.end(), 0U);
  float largest = 0;
  bool upright = true;
  for (std::size_t b = 0; b < count_; ++b)
  {
    const std::uint32_t e = here_[b];
    const Circle circle = CircleOf(poses, e, shapes_[e]);
    upright &= IsUpright(poses, e);
    body_x_[b] = circle.x;
    body_y_[b] = circle.y;
    body_radius_[b] = circle.radius;
    largest = std::max(largest, circle.radius);
    cell_[b] = static_cast<std::uint32_t>(frame_.Row(circle.y) * frame_.columns + frame_.Column(circle.x));
    ++start_[cell_[b] + 2];
  }
  largest_radius_ = largest;
  all_upright_ = upright;
  for (std::size_t c = 2; c < start_.size(); ++c) start_[c] += start_[c - 1];
  for (std::size_t b = 0; b < count_; ++b)
  {
    const std::uint32_t place = start_[cell_[b] + 1]++;
    x_[place] = body_x_[b];
    y_[place] = body_y_[b];
    radius_[place] = body_radius_[b];
    const std::uint32_t e = here_[b];
    entity_[place] = e;
    origin_x_[place] = poses.x[e];
    origin_y_[place] = poses.y[e];
    origin_z_[place] = poses.z[e];
    low_[place] = static_cast<float>(poses.z[e] + shapes_[e].low);
    high_[place] = static_cast<float>(poses.z[e] + shapes_[e].high);
  }
  bool alike = true;
  bool level = true;
  for (std::size_t place = 1; place < count_; ++place)
  {
    level &= origin_z_[place] == origin_z_[0];
    alike &= (radius_[place] == radius_[0]) & (low_[place] == low_[0]) & (high_[place] == high_[0]);
  }
  are_alike_ = alike;
  all_level_ = level;
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
  if (are_alike_)
    for (std::size_t i = 0; i < near.count; i += kLanes)
    {
      StoreLanes(Everywhere(radius_[0]), &near.radius[i]);
      StoreLanes(Everywhere(low_[0]), &near.low[i]);
      StoreLanes(Everywhere(high_[0]), &near.high[i]);
    }
}

template <bool kAlike>
std::size_t NeighbourGrid::Collect(double x, double y, double reach, std::uint32_t left_out, NearBodies& near) const
{
  const auto fx = static_cast<float>(x);
  const auto fy = static_cast<float>(y);
  const float own = static_cast<float>(reach) + margin_;
  const IntLanes left_out_lanes = Everywhere(static_cast<int>(left_out));
  // Local copies: stores of lanes may change anything, for all that the compiler knows.
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
                      const FloatLanes radius = kAlike ? Everywhere(body_radius[0]) : LoadLanes(body_radius + i);
                      const FloatLanes cut = radius + own;
                      const IntLanes entity = LoadLanes(body_entity + i);
                      const Selection selection(LaneMask((dx * dx + dy * dy <= cut * cut) &
                                                         ~(entity == left_out_lanes) & FirstLanes(behind - i)));
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

FixedBodies::FixedBodies(const CSwarmanoidSpace& space, std::span<const BodyShape> shapes, double reach)
{
  std::vector<std::uint32_t> fixed;
  for (std::uint32_t e = 0; e < space.Size(); ++e)
    if (!space.GetEntity(e).IsMovable() && shapes[e].kind != Shape::Kind::kNone) fixed.push_back(e);

  // Small against the reach, so that few bodies beyond it are listed, but few enough to stay in the cache.
  const double smallest_cell = std::max(0.25, reach / 6);
  constexpr std::size_t kCells = 65536;
  const Extent extent = ExtentOf(space);
  frame_ = CellFrame::Over(extent.left, extent.bottom, extent.width, extent.height, smallest_cell,
                           fixed.empty() ? 1 : kCells);
  margin_ = MarginOf(extent);

  // For each body the rectangle of cells around its bounding circle or box; in it, the cells whose centre is near
  // enough.
  const double cell = 1 / static_cast<double>(frame_.inverse_size);
  const double around = reach + static_cast<double>(margin_) + cell * 0.70711;
  std::vector<std::vector<std::uint32_t>> lists(frame_.Cells());
  for (const std::uint32_t e : fixed)
  {
    const BodyShape& shape = shapes[e];
    const Pose pose = space.GetPose(e);
    const Eigen::Matrix3d rotation = pose.orientation.toRotationMatrix();
    const Vector3 centre = pose.Apply(shape.centre);
    const Vector3& half = shape.half_size;
    const Vector3 world_half = rotation.cwiseAbs() * half;
    const bool upright = pose.orientation.x() == 0 && pose.orientation.y() == 0;
    const int first_column = frame_.Column(static_cast<float>(centre.x() - world_half.x() - around));
    const int last_column = frame_.Column(static_cast<float>(centre.x() + world_half.x() + around));
    const int first_row = frame_.Row(static_cast<float>(centre.y() - world_half.y() - around));
    const int last_row = frame_.Row(static_cast<float>(centre.y() + world_half.y() + around));
    for (int row = first_row; row <= last_row; ++row)
      for (int column = first_column; column <= last_column; ++column)
      {
        const bool at_border = row == 0 || column == 0 || row == frame_.rows - 1 || column == frame_.columns - 1;
        const Vector3 middle(frame_.left + (column + 0.5) * cell, frame_.bottom + (row + 0.5) * cell, centre.z());
        const Vector3 local = rotation.transpose() * (middle - centre);
        const bool near = std::abs(local.x()) <= half.x() + around && std::abs(local.y()) <= half.y() + around;
        // Cells at the border stand for all that lies outside, too.
        if (near || at_border || !upright) lists[static_cast<std::size_t>(row * frame_.columns + column)].push_back(e);
      }
  }

  start_.push_back(0);
  for (const auto& list : lists)
  {
    entities_.insert(entities_.end(), list.begin(), list.end());
    start_.push_back(static_cast<std::uint32_t>(entities_.size()));
  }
}

}  // namespace swarmanoid
