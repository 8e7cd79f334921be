// Method: the tangents from the eye to a cylinder turn its middle by a slope of radius / tangent length to either side.
// Their directions, rounded outwards, and the distance of the nearest point, rounded down, are the bytes. The radius is
// first enlarged by more than the exact test rounds.
//
// Invariant: a line that meets the cylinder has a direction and a reach within the bytes.
#include "controller_host/devices/sensing/direction_bytes.h"

namespace swarmanoid
{

void DirectionBytes::Read(const NearBodies& discs, float steps_per_m, bool with_middles)
{
  // A hundredth of a step is far more than what single precision rounds.
  constexpr float kAside = 0.01F;
  if (meets.size() < discs.count + kLanes)
    for (std::vector<std::int32_t>* bytes : {&meets, &middles}) bytes->resize(2 * discs.count + kLanes);
  for (std::size_t i = 0; i < discs.count; i += kLanes)
  {
    const FloatLanes x = LoadLanes(&discs.x[i]);
    const FloatLanes y = LoadLanes(&discs.y[i]);
    const FloatLanes square = x * x + y * y;
    const FloatLanes length = SquareRoot(square);
    // The radius is enlarged by more than the rounding of the exact test.
    const FloatLanes exact = LoadLanes(&discs.radius[i]);
    const FloatLanes more = exact * 1e-4F + (1e-4F + 2e-6F * length);
    const FloatLanes radius = exact + more;

    // The slopes of the tangents. A cylinder that is nearer than this covers all directions.
    const IntLanes is_around = length <= radius * 1.01F;
    const FloatLanes tangent = SquareRoot(is_around ? Everywhere(1.0F) : square - radius * radius);
    const FloatLanes slope = radius / tangent;
    const IntLanes begin = Truncated(TurnInBytes(x + slope * y, y - slope * x, -kAside));
    const IntLanes end = Truncated(TurnInBytes(x - slope * y, y + slope * x, kAside));
    const IntLanes width = is_around ? Everywhere(255) : LowestByte(end - begin);
    const auto in_steps = [](FloatLanes steps)
    { return Truncated(Minimum(Maximum(steps, FloatLanes{}), Everywhere(kFarthestByte))); };
    const IntLanes near = in_steps((length - radius) * steps_per_m - kAside);
    StoreLanes(LowestByte(begin) | width << 8 | near << 16, &meets[i]);
    if (!with_middles) continue;

    const IntLanes turn = LowestByte(Truncated(TurnInBytes(x, y)));
    const FloatLanes steps = length * steps_per_m;
    // The test is sure if a step of direction is wider than the error of the radius by all roundings.
    const IntLanes is_sure = ~is_around & (steps < kFarthestByte - 2) & (3 * more < tangent * (0.8F / 64));
    const IntLanes behind = is_sure ? Truncated(steps + (1 + kAside)) : Everywhere(255);
    StoreLanes(turn | in_steps(steps) << 8 | behind << 16, &middles[i]);
  }
  meets[discs.count] = kMeetsNothing;
}

}  // namespace swarmanoid
