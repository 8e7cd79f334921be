// Problem: find all pairs of bodies that are near each other, in time proportional to the bodies.
//
// Method: the plane is cut into cells at least as wide as the largest reach of a pair, so that partners are in the same
// or in neighbouring cells. A counting sort puts bodies in the order of their cells, and each body searches half of its
// neighbours: the rest of its own cell, the next cell, and three cells of the next row, kLanes bodies at a time. A few
// bodies much wider than the others would widen all cells; they are compared with all others instead.
//
// Invariants: float positions may miss by at most `slack_`, which widens every search, so that no pair is lost. Cells
// and blocks start at multiples of their edges from the origin of the plane, so a block has the same cells in every
// region.
#include "engine_worker/engines/kinematics2d/broad_phase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace swarmanoid::kinematics2d
{
namespace
{

// A body this many times wider than the median one is handled apart, so that it does not widen all cells.
constexpr double kLargeFactor = 3;
constexpr float kFarAway = 1e18F;
constexpr double kMostCells = 1U << 24;

float Square(float x) { return x * x; }

}  // namespace

void Bounds::Include(double x, double y, double radius)
{
  min_x = std::min(min_x, x - radius);
  min_y = std::min(min_y, y - radius);
  max_x = std::max(max_x, x + radius);
  max_y = std::max(max_y, y + radius);
}

PlaneGrid PlaneGrid::For(const Bounds& area, std::span<const double> radii, double largest_margin)
{
  PlaneGrid grid{area, 1, largest_margin};
  const std::size_t count = radii.size();
  if (count > 0)
  {
    std::vector<double> sorted(radii.begin(), radii.end());
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count / 2), sorted.end());
    grid.largest_radius = kLargeFactor * sorted[count / 2];
    for (const double radius : radii)
      if (!(radius > grid.largest_radius)) grid.largest_small_radius = std::max(grid.largest_small_radius, radius);
  }

  // A cell holds one body if the margin allows that, but the number of cells is limited for the sake of memory.
  const double width = std::max(area.max_x - area.min_x, 1e-3);
  const double height = std::max(area.max_y - area.min_y, 1e-3);
  const double per_body = width * height / static_cast<double>(std::max<std::size_t>(count, 1));
  const double smallest = std::max(2 * grid.largest_small_radius + largest_margin, std::sqrt(per_body));
  grid.edge = CellEdge<2>({width, height}, smallest, kMostCells);
  return grid;
}

bool PlaneGrid::IsSound() const
{
  const double width = area.max_x - area.min_x;
  const double height = area.max_y - area.min_y;
  return std::isfinite(width) && std::isfinite(height) && width >= 0 && height >= 0 && edge > 0 &&
         CellsAcross(width, edge) * CellsAcross(height, edge) <= 2 * kMostCells && largest_margin >= 0 &&
         largest_radius >= 0 && largest_small_radius >= 0;
}

void BroadPhase::Configure(const PlaneGrid& grid, std::span<const double> radii)
{
  grid_ = grid;
  const Bounds& area = grid.area;
  const double edge = grid.edge;
  // Cells and blocks start at multiples of their edges from the origin.
  const double first_column = std::floor(area.min_x / edge);
  const double first_row = std::floor(area.min_y / edge);
  const double left = first_column * edge;
  const double bottom = first_row * edge;
  cells_ = {left, bottom, area.max_x - left, area.max_y - bottom, edge, true};
  const auto cut = [](double first, std::uint32_t cells, std::uint32_t& missing, std::uint32_t& number)
  {
    const double block = std::floor(first / kBlock);
    missing = static_cast<std::uint32_t>(first - block * kBlock);
    number = static_cast<std::uint32_t>(block - 2 * std::floor(block / 2));
    return (missing + cells + kBlock - 1) / kBlock;
  };
  block_columns_ = cut(first_column, cells_.columns.Count(), missing_columns_, first_block_column_);
  block_rows_ = cut(first_row, cells_.rows.Count(), missing_rows_, first_block_row_);
  blocks_.resize(BlockCount());
  std::iota(blocks_.begin(), blocks_.end(), 0U);
  sort_.SetCells(cells_.Count() + 1);
  const double extent =
      std::max({std::fabs(area.min_x), std::fabs(area.max_x), std::fabs(area.min_y), std::fabs(area.max_y)});
  slack_ = static_cast<float>(4 * extent * 0x1p-24 + 1e-6);

  SetBodies(radii);
  SetStatics({});
}

void BroadPhase::SetBodies(std::span<const double> radii)
{
  count_ = radii.size();
  radius_.assign(radii.begin(), radii.end());
  large_.clear();
  for (std::size_t k = 0; k < count_; ++k)
    if (IsLarge(radii[k])) large_.push_back(static_cast<std::uint32_t>(k));
  const std::size_t padded = PaddedCount(count_);
  body_.resize(padded, 0);
  sorted_cell_.resize(padded, 0);
  x_.resize(padded, kFarAway);
  y_.resize(padded, kFarAway);
  r_.resize(padded, 0);
}

void BroadPhase::SetStatics(std::span<const Bounds> boxes)
{
  static_boxes_.clear();
  for (const Bounds& box : boxes)
    static_boxes_.push_back({static_cast<float>(box.min_x) - slack_, static_cast<float>(box.min_y) - slack_,
                             static_cast<float>(box.max_x) + slack_, static_cast<float>(box.max_y) + slack_});

  // Large bodies are left out here, since they are compared with all shapes.
  const double reach = grid_.largest_small_radius + grid_.largest_margin + slack_;
  for (std::size_t s = 0; s < boxes.size(); ++s)
  {
    const Bounds& box = boxes[s];
    cells_.ForEachRow(box.min_x - reach, box.min_y - reach, box.max_x + reach, box.max_y + reach,
                      [&](std::uint32_t first, std::uint32_t last)
                      {
                        for (std::uint32_t cell = first; cell <= last; ++cell)
                          statics_.Add(cell, static_cast<std::uint32_t>(s));
                      });
  }
  statics_.Close(cells_.Count());
}

void BroadPhase::Sort(const PoseStore& poses, std::span<const std::uint8_t> present, WorkerPool* pool)
{
  const std::span<std::uint32_t> cell = sort_.Cells(count_);
  InParts(pool, count_, kPadding,
          [&](unsigned, std::size_t begin, std::size_t end)
          {
            const std::size_t count = end - begin;
            cells_.FindCells({poses.x.data() + begin, count}, {poses.y.data() + begin, count}, cell.data() + begin);
          });
  const auto limbo = static_cast<std::uint32_t>(cells_.Count());
  for (const std::uint32_t body : large_) cell[body] = limbo;
  if (std::find(present.begin(), present.end(), 0) != present.end())
    for (std::size_t k = 0; k < count_; ++k)
      if (present[k] == 0) cell[k] = limbo;
  sort_.Sort([&](std::size_t k, std::uint32_t at) { body_[at] = static_cast<std::uint32_t>(k); });
  InParts(pool, count_, kPadding,
          [&](unsigned, std::size_t begin, std::size_t end)
          {
            for (std::size_t at = begin; at < end; ++at)
            {
              const std::uint32_t k = body_[at];
              sorted_cell_[at] = cell[k];
              x_[at] = static_cast<float>(poses.x[k]);
              y_[at] = static_cast<float>(poses.y[k]);
              r_[at] = radius_[k];
            }
          });
}

void BroadPhase::FindPairs(double margin, std::span<const std::uint32_t> blocks, PairList& found) const
{
  const float reach = ReachOf(margin);
  found.pairs.clear();
  found.ends.clear();
  for (const std::uint32_t block : blocks)
  {
    SweepBlock(reach, block, found.pairs);
    if (!static_boxes_.empty()) SweepStatics(reach, block, found.pairs);
    found.ends.push_back(static_cast<std::uint32_t>(found.pairs.size()));
  }
}

void BroadPhase::SweepBlock(float reach, std::uint32_t block, std::vector<Pair>& pairs) const
{
  // Most searches find at most one body. Those with a find are recorded without a branch, and evaluated afterwards.
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
  const std::uint32_t* const start = sort_.Starts();
  const auto sweep = [&](std::uint32_t begin, std::uint32_t end)
  {
    for (std::uint32_t k = begin; k < end; ++k)
    {
      const std::uint32_t cell = sorted_cell_[k];
      const auto search = [&](std::uint32_t from, std::uint32_t to)
      {
        do {  // most ranges fit one vector
          finds[count] = {k, from, Within(k, reach, from, to)};
          count += finds[count].hits != 0 ? 1 : 0;
          if (count == kMost) take_apart();
          from += kLanes;
        } while (from < to);
      };
      // The search covers the rest of this cell and the next one, then three cells of the next row.
      search(k + 1, start[cell + 2]);
      search(start[cell + cells_.stride - 1], start[cell + cells_.stride + 2]);
    }
  };
  ForEachRowOf(block, [&](std::uint32_t first, std::uint32_t last) { sweep(start[first], start[last + 1]); });
  take_apart();
}

void BroadPhase::SweepStatics(float reach, std::uint32_t block, std::vector<Pair>& pairs) const
{
  const std::uint32_t* const start = sort_.Starts();
  ForEachRowOf(block,
               [&](std::uint32_t first, std::uint32_t last)
               {
                 if (statics_.In(first, last).empty()) return;
                 for (std::uint32_t cell = first; cell <= last; ++cell)
                 {
                   const std::span<const std::uint32_t> shapes = statics_.In(cell);
                   if (shapes.empty()) continue;
                   for (std::uint32_t k = start[cell]; k < start[cell + 1]; ++k)
                     for (const std::uint32_t shape : shapes)
                       if (static_boxes_[shape].IsNear(x_[k], y_[k], r_[k] + reach))
                         pairs.push_back({body_[k], static_cast<std::uint32_t>(count_) + shape});
                 }
               });
}

void BroadPhase::FindPairsOfLarge(double distance, const PoseStore& poses, std::span<const std::uint8_t> present,
                                  std::vector<Pair>& pairs) const
{
  pairs.clear();
  const float margin = ReachOf(distance);
  const std::uint32_t* const start = sort_.Starts();
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
    const double reach = static_cast<double>(radius_[body]) + grid_.largest_small_radius + static_cast<double>(margin);
    cells_.ForEachRow(x - reach, y - reach, x + reach, y + reach,
                      [&](std::uint32_t first, std::uint32_t last)
                      {
                        for (std::uint32_t k = start[first]; k < start[last + 1]; ++k)
                          if (near(static_cast<double>(x_[k]), static_cast<double>(y_[k]), r_[k]))
                            pairs.push_back({std::min(body, body_[k]), std::max(body, body_[k])});
                      });
    for (std::size_t m = n + 1; m < large_.size(); ++m)
    {
      const std::uint32_t other = large_[m];
      if (present[other] != 0 && near(poses.x[other], poses.y[other], radius_[other])) pairs.push_back({body, other});
    }
    for (std::size_t s = 0; s < static_boxes_.size(); ++s)
      if (static_boxes_[s].IsNear(static_cast<float>(x), static_cast<float>(y), radius_[body] + margin))
        pairs.push_back({body, static_cast<std::uint32_t>(count_ + s)});
  }
}

}  // namespace swarmanoid::kinematics2d
