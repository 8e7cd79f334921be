// Problem: cut a plane of blocks into rectangles with about equal work.
//
// Method: recursive bisection. A rectangle for n regions is cut across its longer side, where the work of the first
// part is nearest to that of n / 2 regions, until each rectangle has one region. A grid is cut in the same way, first
// into columns, then each column into rows.
//
// Invariant: the cuts follow from the numbers of bodies alone, in integers, so all processes agree.
#include "engine_worker/engines/kinematics2d/region_cuts.h"

#include <algorithm>

namespace swarmanoid::kinematics2d
{
namespace
{

// The cost of a body grows with the number around it: 212 instructions in a tick at 1 per square metre, where some 21
// are in a block, and 782 at 10, as measured. Cells that are empty cost a little, too.
std::uint64_t LoadOf(std::uint64_t bodies) { return 1 + bodies * (150 + 3 * bodies); }

// A rectangle of blocks, from the first to the one behind the last.
struct Part
{
  std::uint32_t left, bottom, right, top;
};

class Cutter
{
public:
  Cutter(std::span<const std::uint32_t> bodies, std::uint32_t columns)
      : bodies_(bodies), columns_(columns), regions_(bodies.size(), 0)
  {
  }

  Part Whole() const { return {0, 0, columns_, static_cast<std::uint32_t>(bodies_.size()) / columns_}; }

  // Cuts a part across its longer side, again and again.
  void Cut(const Part& part, unsigned first, unsigned count)
  {
    if (count == 1) return Fill(part, first);
    const bool upright = part.right - part.left >= part.top - part.bottom;
    const auto [a, b] = Halves(part, upright, count);
    Cut(a, first, count / 2);
    Cut(b, first + count / 2, count - count / 2);
  }

  // Cuts a part into slices in one direction, and calls act(part, number) with each.
  template <class Act>
  void CutSlices(const Part& part, bool upright, unsigned first, unsigned count, const Act& act)
  {
    if (count == 1) return act(part, first);
    const auto [a, b] = Halves(part, upright, count);
    CutSlices(a, upright, first, count / 2, act);
    CutSlices(b, upright, first + count / 2, count - count / 2, act);
  }

  void Fill(const Part& part, unsigned region)
  {
    for (std::uint32_t row = part.bottom; row < part.top; ++row)
      for (std::uint32_t column = part.left; column < part.right; ++column)
        regions_[row * columns_ + column] = static_cast<std::uint8_t>(region);
  }

  std::vector<std::uint8_t> Take() { return std::move(regions_); }

private:
  std::uint64_t LoadIn(const Part& part) const
  {
    std::uint64_t load = 0;
    for (std::uint32_t row = part.bottom; row < part.top; ++row)
      for (std::uint32_t column = part.left; column < part.right; ++column)
        load += LoadOf(bodies_[row * columns_ + column]);
    return load;
  }

  // Returns the part for the first count / 2 regions, and the part for the others. One of them may be empty.
  std::pair<Part, Part> Halves(const Part& part, bool upright, unsigned count) const
  {
    const std::uint64_t wanted = LoadIn(part) * (count / 2);
    const std::uint32_t begin = upright ? part.left : part.bottom;
    const std::uint32_t end = upright ? part.right : part.top;
    std::uint32_t cut = begin;
    std::uint64_t before = 0;
    for (; cut < end; ++cut)
    {
      const Part slice =
          upright ? Part{cut, part.bottom, cut + 1, part.top} : Part{part.left, cut, part.right, cut + 1};
      const std::uint64_t with = before + LoadIn(slice) * count;
      // The cut is put where the sum is nearest to the wanted one.
      if (before >= wanted || (with > wanted && with - wanted > wanted - before)) break;
      before = with;
    }
    return upright
               ? std::pair(Part{part.left, part.bottom, cut, part.top}, Part{cut, part.bottom, part.right, part.top})
               : std::pair(Part{part.left, part.bottom, part.right, cut}, Part{part.left, cut, part.right, part.top});
  }

  std::span<const std::uint32_t> bodies_;
  std::uint32_t columns_;
  std::vector<std::uint8_t> regions_;
};

}  // namespace

std::vector<std::uint8_t> CutPlane(std::span<const std::uint32_t> bodies_in_blocks, std::uint32_t columns,
                                   const EngineSplit& split)
{
  Cutter cutter(bodies_in_blocks, columns);
  if (split.columns == 0)
    cutter.Cut(cutter.Whole(), 0, split.regions);
  else
  {
    const unsigned rows = split.regions / split.columns;
    cutter.CutSlices(cutter.Whole(), true, 0, split.columns,
                     [&](const Part& column, unsigned number)
                     {
                       cutter.CutSlices(column, false, number * rows, rows,
                                        [&](const Part& part, unsigned region) { cutter.Fill(part, region); });
                     });
  }
  return cutter.Take();
}

}  // namespace swarmanoid::kinematics2d
