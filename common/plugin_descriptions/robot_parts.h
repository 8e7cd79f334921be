// The positions of robot parts that the simulator's own engines collide, in metres. The engines' bodies and their
// descriptions (CollisionBody) both use them.
#pragma once

namespace swarmanoid
{

// The square at the front of a footbot's turret in the engines of planes: its edge, and the distance of its outer face
// from the axis of the turret.
struct GripperSquare
{
  static constexpr double kSide = 0.03;
  static constexpr double kReach = 0.1;
};

// The lengths of body, arm and claw are those of the ARGoS 2 model.
struct HandbotParts
{
  static constexpr double kBaseSide = 0.17;
  static constexpr double kBaseHeight = 0.03;
  static constexpr double kTrunkLength = 0.12;
  static constexpr double kTrunkWidth = 0.10;
  static constexpr double kHeight = 0.16;
  static constexpr double kHeadForward = 0.06;
  static constexpr double kHeadHeight = 0.10;
  static constexpr double kShoulder = 0.05;    // left and right of the head's axis
  static constexpr double kArmLength = 0.196;  // upper arm 0.138 and claw 0.058
  static constexpr double kClawLength = 0.058;
  static constexpr double kClawWidth = 0.038;
  static constexpr double kArmRadius = 0.012;
};

}  // namespace swarmanoid
