// NearObjects: which objects a gripper may reach, found by place instead of by trying them all. Sorted at most once a
// tick, when the first gripper asks. Used by engines in the thread that steps them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/space/index/positional_index.h"

namespace swarmanoid
{

class NearObjects
{
public:
  // Adds an object. `extent` (m) is the distance from its origin to its farthest point. Objects are numbered in the
  // order of adding.
  void Add(double extent)
  {
    ++count_;
    largest_extent_ = std::max(largest_extent_, extent);
    index_.reset();
  }

  // The objects may have moved since.
  void Forget() { sorted_ = false; }

  // Returns the numbers of the objects within `distance` (m) of a point, and possibly some more, ascending. The result
  // is valid until the next call. `place_of(k)` returns the origin of object k, or NaN if the object is out of reach
  // for every search.
  template <class PlaceOf>
  std::span<const std::uint32_t> Near(const Experiment& experiment, const Vector3& point, double distance,
                                      const PlaceOf& place_of)
  {
    if (count_ == 0) return {};
    if (index_ == nullptr) index_ = MakePositionalIndex(experiment.optimization, experiment.arena_size, count_);
    if (!sorted_)
    {
      for (std::vector<double>* values : {&x_, &y_, &z_}) values->resize(count_);
      for (std::size_t k = 0; k < count_; ++k)
      {
        const Vector3 place = place_of(k);
        x_[k] = place.x();
        y_[k] = place.y();
        z_[k] = place.z();
      }
      index_->Update({x_, y_, z_});
      sorted_ = true;
    }
    constexpr double kRounding = 1e-6;  // m
    index_->FindWithin(point, distance + largest_extent_ + kRounding, found_);
    return found_;
  }

private:
  std::size_t count_ = 0;
  double largest_extent_ = 0;
  bool sorted_ = false;
  std::unique_ptr<PositionalIndex> index_;
  std::vector<double> x_, y_, z_;
  std::vector<std::uint32_t> found_;
};

}  // namespace swarmanoid
