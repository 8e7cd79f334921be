#include "engine_worker/engines/kinematics2d/broad_phase.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine_worker/engines/kinematics2d/vectors.h"

namespace swarmanoid::kinematics2d
{
namespace
{

// A body this many times wider than the median one is handled apart, so that it does not widen all cells.
constexpr double kLargeFactor = 3;
constexpr float kFarAway = 1e18F;
constexpr std::uint32_t kMostCells = 1U << 24;

float Square(float x) { return x * x; }

}  // namespace

void Bounds::Include(double x, double y, double radius)
{
  min_x = std::min(min_x, x - radius);
  min_y = std::min(min_y, y - radius);
  max_x = std::max(max_x, x + radius);
  max_y = std::max(max_y, y + radius);
}

void BroadPhase::Configure(const Bounds& area, std::span<const double> radii, double largest_margin)
{
  count_ = radii.size();
  largest_margin_ = largest_margin;
  radius_.assign(radii.begin(), radii.end());
  is_large_.assign(count_, 0);
  large_.clear();
  largest_small_radius_ = 0;
  if (count_ > 0)
  {
    std::vector<double> sorted(radii.begin(), radii.end());
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count_ / 2), sorted.end());
    const double limit = kLargeFactor * sorted[count_ / 2];
    for (std::size_t k = 0; k < count_; ++k)
    {
      is_large_[k] = radii[k] > limit;
      if (is_large_[k] != 0)
        large_.push_back(static_cast<std::uint32_t>(k));
      else
        largest_small_radius_ = std::max(largest_small_radius_, radii[k]);
    }
  }

  // One body a cell where the margin allows, and never more cells than memory is good for.
  const double width = std::max(area.max_x - area.min_x, 1e-3);
  const double height = std::max(area.max_y - area.min_y, 1e-3);
  const double per_body = width * height / static_cast<double>(std::max<std::size_t>(count_, 1));
  cell_ = std::max({2 * largest_small_radius_ + largest_margin_, std::sqrt(per_body),
                    std::sqrt(width * height / kMostCells), std::max(width, height) / 65536});
  inverse_cell_ = 1 / cell_;
  min_x_ = area.min_x;
  min_y_ = area.min_y;
  columns_ = static_cast<std::uint32_t>(width * inverse_cell_) + 1;
  rows_ = static_cast<std::uint32_t>(height * inverse_cell_) + 1;
  stride_ = columns_ + 2;
  const double extent =
      std::max({std::fabs(area.min_x), std::fabs(area.max_x), std::fabs(area.min_y), std::fabs(area.max_y)});
  slack_ = static_cast<float>(4 * extent * 0x1p-24 + 1e-6);

  const std::size_t cells = static_cast<std::size_t>(stride_) * (rows_ + 2);
  start_.assign(cells + 2, 0);
  cell_of_.assign(PaddedCount(count_), 0);
  body_.assign(PaddedCount(count_), 0);
  sorted_cell_.assign(PaddedCount(count_), 0);
  x_.assign(PaddedCount(count_), kFarAway);
  y_.assign(PaddedCount(count_), kFarAway);
  r_.assign(PaddedCount(count_), 0);
  pairs_.reserve(4 * count_ + 64);
  static_pairs_.reserve(count_ + 64);
  SetStatics({});
}

std::uint32_t BroadPhase::CellX(double x) const
{
  const double t = (x - min_x_) * inverse_cell_;
  return t > 0 ? static_cast<std::uint32_t>(std::min(t, static_cast<double>(columns_ - 1))) : 0;
}

std::uint32_t BroadPhase::CellY(double y) const
{
  const double t = (y - min_y_) * inverse_cell_;
  return t > 0 ? static_cast<std::uint32_t>(std::min(t, static_cast<double>(rows_ - 1))) : 0;
}

void BroadPhase::SetStatics(std::span<const Bounds> boxes)
{
  static_boxes_.clear();
  for (const Bounds& box : boxes)
    static_boxes_.push_back({static_cast<float>(box.min_x) - slack_, static_cast<float>(box.min_y) - slack_,
                             static_cast<float>(box.max_x) + slack_, static_cast<float>(box.max_y) + slack_});

  // Compressed rows: count the shapes of each cell, sum up, fill. Large bodies ask all shapes instead.
  const double reach = largest_small_radius_ + largest_margin_ + slack_;
  static_start_.assign(start_.size(), 0);
  const auto for_each_cell = [&](const auto& act)
  {
    for (std::size_t s = 0; s < boxes.size(); ++s)
    {
      const Bounds& box = boxes[s];
      for (std::uint32_t row = CellY(box.min_y - reach); row <= CellY(box.max_y + reach); ++row)
        for (std::uint32_t column = CellX(box.min_x - reach); column <= CellX(box.max_x + reach); ++column)
          act(Cell(column, row), static_cast<std::uint32_t>(s));
    }
  };
  for_each_cell([&](std::uint32_t cell, std::uint32_t) { ++static_start_[cell + 1]; });
  for (std::size_t c = 1; c < static_start_.size(); ++c) static_start_[c] += static_start_[c - 1];
  static_shape_.resize(static_start_.back());
  std::vector<std::uint32_t> next(static_start_.begin(), static_start_.end() - 1);
  for_each_cell([&](std::uint32_t cell, std::uint32_t shape) { static_shape_[next[cell]++] = shape; });
}

void BroadPhase::FindPairs(const PoseStore& poses, std::span<const std::uint8_t> present, double margin,
                           WorkerPool* pool)
{
  const float reach = static_cast<float>(margin) + 2 * slack_;
  pairs_.clear();
  static_pairs_.clear();
  Sort(poses, present);
  // Every part in the order of the cells, one after the other: the same pairs whatever the threads.
  parts_.resize(pool == nullptr ? 0 : pool->Threads() - 1);
  for (std::vector<Pair>& part : parts_) part.clear();
  InParts(pool, start_.back(), 1,
          [&](unsigned part, std::size_t begin, std::size_t end)
          { SweepBodies(reach, begin, end, part == 0 ? pairs_ : parts_[part - 1]); });
  for (const std::vector<Pair>& part : parts_) pairs_.insert(pairs_.end(), part.begin(), part.end());
  if (!large_.empty()) FindPairsOfLarge(reach, present, poses);
  if (!static_boxes_.empty()) SweepStatics(reach);
}

void BroadPhase::FindCells(const PoseStore& poses, std::span<const std::uint8_t> present)
{
  const double most_columns = columns_ - 1;
  const double most_rows = rows_ - 1;
  for (std::size_t k = 0; k < count_; k += kDoubles)
  {
    const Doubles column = (LoadDoubles(&poses.x[k]) - min_x_) * inverse_cell_;
    const Doubles row = (LoadDoubles(&poses.y[k]) - min_y_) * inverse_cell_;
    const Ints c = Truncated(Clamped(column, most_columns));
    const Ints r = Truncated(Clamped(row, most_rows));
    Store(&cell_of_[k], (r + 1) * static_cast<std::int32_t>(stride_) + (c + 1));
  }
  // Bodies that take no part go behind the last cell.
  const auto limbo = static_cast<std::int32_t>(start_.size() - 2);
  for (const std::uint32_t body : large_) cell_of_[body] = limbo;
  if (std::find(present.begin(), present.end(), 0) != present.end())
    for (std::size_t k = 0; k < count_; ++k)
      if (present[k] == 0) cell_of_[k] = limbo;
}

void BroadPhase::Sort(const PoseStore& poses, std::span<const std::uint8_t> present)
{
  FindCells(poses, present);
  std::fill(start_.begin(), start_.end(), 0U);
  for (std::size_t k = 0; k < count_; ++k) ++start_[cell_of_[k] + 1];
  std::uint32_t sum = 0;
  for (std::uint32_t& s : start_)
  {
    sum += s;
    s = sum;
  }
  // start_[c + 1] is the end of cell c; filling from the last body backwards leaves the start there.
  for (std::size_t k = count_; k-- > 0;)
  {
    const std::uint32_t at = --start_[cell_of_[k] + 1];
    body_[at] = static_cast<std::uint32_t>(k);
    sorted_cell_[at] = static_cast<std::uint32_t>(cell_of_[k]);
    x_[at] = static_cast<float>(poses.x[k]);
    y_[at] = static_cast<float>(poses.y[k]);
    r_[at] = radius_[k];
  }
  // Now start_[c + 1] is the start of cell c.
}

void BroadPhase::SweepBodies(float margin, std::size_t begin, std::size_t end, std::vector<Pair>& pairs) const
{
  // Most searches find nobody or one. Those that do are noted without a branch, and only then taken apart.
  struct Finds
  {
    std::uint32_t body, from, hits;
  };
  constexpr std::size_t kMost = 256;
  std::array<Finds, kMost> finds;
  std::size_t count = 0;
  const auto take_apart = [&]
  {
    for (std::size_t n = 0; n < count; ++n)
    {
      const Finds& find = finds[n];
      ForEachBit(find.hits,
                 [&](unsigned bit)
                 {
                   const std::uint32_t a = body_[find.body];
                   const std::uint32_t b = body_[find.from + bit];
                   pairs.push_back({std::min(a, b), std::max(a, b)});
                 });
    }
    count = 0;
  };
  const std::uint32_t* const start = start_.data() + 1;
  for (auto k = static_cast<std::uint32_t>(begin); k < end; ++k)
  {
    const std::uint32_t cell = sorted_cell_[k];
    const float reach = r_[k] + margin;
    const auto search = [&](std::uint32_t from, std::uint32_t to)
    {
      do {  // most ranges fit one vector
        finds[count] = {k, from, Within(x_[k], y_[k], reach, from, to)};
        count += finds[count].hits != 0 ? 1 : 0;
        if (count == kMost) take_apart();
        from += kFloats;
      } while (from < to);
    };
    // The rest of this cell and the next one; then three cells of the next row.
    search(k + 1, start[cell + 2]);
    search(start[cell + stride_ - 1], start[cell + stride_ + 2]);
  }
  take_apart();
}

void BroadPhase::FindPairsOfLarge(float margin, std::span<const std::uint8_t> present, const PoseStore& poses)
{
  const std::uint32_t* const start = start_.data() + 1;
  for (std::size_t n = 0; n < large_.size(); ++n)
  {
    const std::uint32_t body = large_[n];
    if (present[body] == 0) continue;
    const double x = poses.x[body];
    const double y = poses.y[body];
    const auto near = [&](double other_x, double other_y, float radius)
    {
      return Square(static_cast<float>(other_x - x)) + Square(static_cast<float>(other_y - y)) <
             Square(radius_[body] + radius + margin);
    };
    const double reach = static_cast<double>(radius_[body]) + largest_small_radius_ + static_cast<double>(margin);
    for (std::uint32_t row = CellY(y - reach); row <= CellY(y + reach); ++row)
      for (std::uint32_t k = start[Cell(CellX(x - reach), row)]; k < start[Cell(CellX(x + reach), row) + 1]; ++k)
        if (near(static_cast<double>(x_[k]), static_cast<double>(y_[k]), r_[k]))
          pairs_.push_back({std::min(body, body_[k]), std::max(body, body_[k])});
    for (std::size_t m = n + 1; m < large_.size(); ++m)
    {
      const std::uint32_t other = large_[m];
      if (present[other] != 0 && near(poses.x[other], poses.y[other], radius_[other])) pairs_.push_back({body, other});
    }
    for (std::size_t s = 0; s < static_boxes_.size(); ++s)
    {
      const FloatBox& box = static_boxes_[s];
      const float r = radius_[body] + margin;
      const auto fx = static_cast<float>(x);
      const auto fy = static_cast<float>(y);
      if (fx + r > box.min_x && fx - r < box.max_x && fy + r > box.min_y && fy - r < box.max_y)
        static_pairs_.push_back({body, static_cast<std::uint32_t>(s)});
    }
  }
}

void BroadPhase::SweepStatics(float margin)
{
  const std::uint32_t end = start_.back();
  for (std::uint32_t k = 0; k < end; ++k)
  {
    const std::uint32_t cell = sorted_cell_[k];
    for (std::uint32_t s = static_start_[cell]; s < static_start_[cell + 1]; ++s)
    {
      const FloatBox& box = static_boxes_[static_shape_[s]];
      const float r = r_[k] + margin;
      if (x_[k] + r > box.min_x && x_[k] - r < box.max_x && y_[k] + r > box.min_y && y_[k] - r < box.max_y)
        static_pairs_.push_back({body_[k], static_shape_[s]});
    }
  }
}

}  // namespace swarmanoid::kinematics2d
