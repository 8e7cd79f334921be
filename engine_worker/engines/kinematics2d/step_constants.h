// The numbers that the kinematic world steps by. They trade accuracy against time and are the same for every
// experiment.
#pragma once

namespace swarmanoid::kinematics2d
{

// In one substep a body goes at most this part of its core's radius, so that two bodies that meet head-on cannot pass
// through each other.
inline constexpr double kWayInCore = 0.5;
// The radius of a core relative to the median one (widest), and relative to the body's own bounding radius (thinnest).
inline constexpr double kWidestCore = 3;
inline constexpr double kThinnestCore = 0.1;
inline constexpr int kMostSubsteps = 1024;
// Metres by which overlapping bodies may be parted in a substep even if nothing moves.
inline constexpr double kSlowestSeparation = 0.0025;
// Outlines nearer than this (metres) are contacts: pushing one may close the gap.
inline constexpr double kContactMargin = 0.02;
// A pair keeps the contacts that are at most this much (metres) less deep than its deepest one.
inline constexpr double kTouchesApart = 0.01;
// Overlap that is left alone, as a part of the smallest core's radius; the solver aims at a quarter of it.
inline constexpr double kAllowedOverlap = 0.004;
inline constexpr double kSolverTolerance = 0.25;
// Bodies that overlap by more than this many times the allowed overlap when a substep begins were put into each other.
inline constexpr double kPutIntoEachOther = 2;
// The wheel contacts of a gripping robot, in metres left and right of its centre. They decide how much its turning
// weighs against its driving when several robots move one prey.
inline constexpr double kGripArm = 0.07;

}  // namespace swarmanoid::kinematics2d
