// Moves the values of bodies when these get new numbers but keep their order: some bodies go, others come between them.
// A run is a row of bodies that moves as a whole.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace swarmanoid::kinematics2d
{

struct Run
{
  std::uint32_t from, to, count;
};

// Gives memory back that far more bodies took before.
template <class Values>
void Trim(Values& values)
{
  if (values.capacity() > 2 * values.size()) values.shrink_to_fit();
}

// Resizes to `size`; values behind all bodies are `behind`, values between the runs are left over.
template <class Values>
void MoveRuns(std::span<const Run> runs, std::size_t size, typename Values::value_type behind, Values& values)
{
  const std::size_t bodies = runs.empty() ? 0 : runs.back().to + runs.back().count;
  values.resize(std::max({values.size(), size, bodies}), behind);
  // First all runs move together at the front, then they move apart from the last one on.
  std::size_t end = 0;
  for (const Run& run : runs)
  {
    if (end != run.from) std::copy_n(values.begin() + run.from, run.count, values.begin() + static_cast<long>(end));
    end += run.count;
  }
  for (auto run = runs.rbegin(); run != runs.rend(); ++run)
  {
    const std::size_t begin = end - run->count;
    if (begin != run->to)
      std::copy_backward(values.begin() + static_cast<long>(begin), values.begin() + static_cast<long>(end),
                         values.begin() + run->to + run->count);
    end = begin;
  }
  values.resize(size, behind);
  Trim(values);
}

}  // namespace swarmanoid::kinematics2d
