// The positions of the ground sensors of ARGoS3's e-puck: for its row, and for floors that loop functions paint.
#pragma once

#include <array>

namespace swarmanoid::argos3
{

struct GroundPlace
{
  double x, y;  // m, in the frame of the robot
};
inline constexpr std::array<GroundPlace, 3> kEPuckGround{{{0.03, -0.009}, {0.03, 0}, {0.03, 0.009}}};

}  // namespace swarmanoid::argos3
