// Constants of contacts that ODE and the planar solver share.
#pragma once

namespace swarmanoid::dynamics3d
{

// Faster than this a wheel slips, and its friction works against the slip alone.
inline constexpr double kWheelSlip = 0.02;  // m/s
// A slipping wheel rubs a little more the faster it slips, up to a limit. If it did not, two robots with spinning
// wheels that push each other could move together at any speed.
inline constexpr double kSlipRise = 0.5;     // s/m
inline constexpr double kFastestSlip = 0.6;  // m/s
// Robots that rub against each other yield by this. A robot that rests on wheels could otherwise bear any part of its
// neighbour's weight by rubbing, and the solver would choose the part at random.
inline constexpr double kRubbing = 0.03;  // m/s per N
// Slower collisions give nothing back.
inline constexpr double kLeastBounce = 0.05;  // m/s

}  // namespace swarmanoid::dynamics3d
