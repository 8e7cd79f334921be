// The hash of a state, by which runs are compared: the tick, the poses, the attributes, and which entities are absent,
// and the cells of the fields on the floor. All are numbers in arrays, hashed byte by byte in their order (XXH3, 64
// bits).
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>

#include "common/space/space.h"

namespace swarmanoid
{

std::uint64_t CSwarmanoidSpace::Hash() const
{
  XXH3_state_t state;
  XXH3_64bits_reset(&state);
  XXH3_64bits_update(&state, &tick_, sizeof tick_);
  for (const auto* component : {&poses_.x, &poses_.y, &poses_.z, &poses_.qx, &poses_.qy, &poses_.qz, &poses_.qw})
    XXH3_64bits_update(&state, component->data(), component->size() * sizeof(double));
  attributes_.VisitRuns(first_presence_,
                        [&](std::span<const double> run) { XXH3_64bits_update(&state, run.data(), run.size_bytes()); });
  XXH3_64bits_update(&state, absent_.data(), absent_.size() * sizeof(std::uint32_t));
  fields_.VisitRuns(
      [&](std::size_t cell, std::span<const float> run)
      {
        const std::array<std::uint64_t, 2> place{cell, run.size()};
        XXH3_64bits_update(&state, place.data(), sizeof place);
        XXH3_64bits_update(&state, run.data(), run.size_bytes());
      });
  return XXH3_64bits_digest(&state);
}

}  // namespace swarmanoid
