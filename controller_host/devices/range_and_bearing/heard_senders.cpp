// Keeps one array for each quantity, in one block of memory, with room for some lanes behind the last sender. Ways are
// turned into the frame of the receiver by its heading if it is upright, otherwise by its full rotation; range and
// angles are then computed for all senders of many receivers at once.
#include "controller_host/devices/range_and_bearing/heard_senders.h"

#include <algorithm>

#include "common/math/elementary.h"
#include "common/math/lanes.h"

namespace swarmanoid
{

void HeardSenders::Reserve(std::size_t more)
{
  if (place_.size() >= count + more + kLanes) return;
  const std::size_t old = place_.size();
  const std::size_t size = 2 * (count + more) + kLanes;
  place_.resize(size);
  std::vector<double> values(size * kArrays);
  for (std::size_t array = 0; array < kArrays; ++array)
    std::copy_n(values_.data() + array * old, old, values.data() + array * size);
  values_ = std::move(values);
  double* const start = values_.data();
  lanes_ = {place_.data(),    start,
            start + size,     start + 2 * size,
            start + 3 * size, start + 4 * size,
            start + 5 * size, start + 6 * size,
            start + 7 * size};
}

void HeardSenders::Add(std::size_t more, const NeighbourGrid& grid, const Vector3& own, const Heading& heading)
{
  const Lanes to = lanes_;
  const double* const origin_x = grid.OriginX();
  const double* const origin_y = grid.OriginY();
  const double* const origin_z = grid.OriginZ();
  const bool is_level = grid.AllLevel();
  // These local copies are needed because the compiler must assume that stores of lanes change what is referred to.
  const double own_x = own.x(), own_y = own.y(), own_z = own.z();
  const double cos = heading.cos, sin = heading.sin;
  const std::size_t behind = count + more;
  StoreLanes(HalfIntLanes{}, &to.place[behind]);  // the lanes behind the last sender read some place, too
  for (std::size_t i = count; i < behind; i += kDoubleLanes)
  {
    const HalfIntLanes place = LoadAs<HalfIntLanes>(&to.place[i]);
    const DoubleLanes x = Gathered(origin_x, place) - own_x;
    const DoubleLanes y = Gathered(origin_y, place) - own_y;
    DoubleLanes square = x * x + y * y;
    if (!is_level)
    {
      const DoubleLanes z = Gathered(origin_z, place) - own_z;
      square += z * z;
      StoreLanes(z, &to.z[i]);
    }
    StoreLanes(square, &to.square[i]);
    StoreLanes(cos * x + sin * y, &to.x[i]);
    StoreLanes(cos * y - sin * x, &to.y[i]);
  }
  count = behind;
}

void HeardSenders::Move(std::size_t from, std::size_t to)
{
  lanes_.place[to] = lanes_.place[from];
  for (double* const values : {lanes_.x, lanes_.y, lanes_.z}) values[to] = values[from];
}

void HeardSenders::Turn(std::size_t first, const Heading& heading)
{
  double* const x = lanes_.x;
  double* const y = lanes_.y;
  const double* const z = lanes_.z;
  double* const square = lanes_.square;
  // Whole lanes: what stands behind the last one is as harmless.
#pragma GCC ivdep
  for (std::size_t i = first; i < first + (count - first + kLanes - 1) / kLanes * kLanes; ++i)
  {
    square[i] = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
    const double ahead = heading.cos * x[i] + heading.sin * y[i];
    y[i] = heading.cos * y[i] - heading.sin * x[i];
    x[i] = ahead;
  }
}

void HeardSenders::Turn(std::size_t first, const Eigen::Matrix3d& to_body)
{
  for (std::size_t i = first; i < count; ++i)
  {
    const Vector3 way(lanes_.x[i], lanes_.y[i], lanes_.z[i]);
    const Vector3 place(to_body * way);
    lanes_.square[i] = way.x() * way.x() + way.y() * way.y() + way.z() * way.z();
    lanes_.x[i] = place.x();
    lanes_.y[i] = place.y();
    lanes_.z[i] = place.z();
  }
}

void HeardSenders::Measure(bool are_level)
{
  const auto [place, x, y, z, square, range, bearing, elevation, flat] = lanes_;
  const std::size_t whole = (count + kLanes - 1) / kLanes * kLanes;
#pragma GCC ivdep
  for (std::size_t i = 0; i < whole; ++i) range[i] = __builtin_sqrt(square[i]);
  Atan2Each({y, whole}, {x, whole}, {bearing, whole});
  if (are_level || std::all_of(z, z + count, [](double height) { return height == 0; }))
  {
    std::fill_n(elevation, whole, 0.0);
    return;
  }
#pragma GCC ivdep
  for (std::size_t i = 0; i < whole; ++i) flat[i] = __builtin_sqrt(x[i] * x[i] + y[i] * y[i]);
  Atan2Each({z, whole}, {flat, whole}, {elevation, whole});
}

}  // namespace swarmanoid
