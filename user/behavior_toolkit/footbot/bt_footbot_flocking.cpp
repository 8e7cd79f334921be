#include "footbot/bt_footbot_flocking.h"

#include <algorithm>
#include <cmath>

#include "ci_colour.h"
#include "common/math/elementary.h"
#include "footbot/bt_footbot_drive.h"

using namespace swarmanoid;

namespace
{

// Forces end at 1.8 times the wanted distance, so that only the first ring of neighbours counts.
constexpr double kReach = 1.8;
// A neighbour that is much too close must outweigh all neighbours that are slightly too far.
constexpr double kForceLimit = 10.0;
constexpr double kLightWeight = 0.3;

}  // namespace

CBTFootbotFlocking::CBTFootbotFlocking(std::uint32_t colour, double wanted_distance, double speed)
    : CCI_Behavior("flocking"), colour_(colour), wanted_distance_(wanted_distance), speed_(speed)
{
}

void CBTFootbotFlocking::Step(CCI_FootBotState& cRobotState)
{
  double x = 0;
  double y = 0;
  unsigned neighbours = 0;
  for (const CCI_ColourBlob& blob : cRobotState.GetColourBlobs())
  {
    if (CCI_Colour::Nearest(blob.colour) != CCI_Colour::Nearest(colour_)) continue;
    if (blob.distance_m > kReach * wanted_distance_ || blob.distance_m <= 0) continue;
    const double ratio = wanted_distance_ / blob.distance_m;
    const double square = ratio * ratio;
    const double force = std::clamp(-4 * (square * square - square) * ratio, -kForceLimit, kForceLimit);
    const SinCos direction = SinCosOf(blob.angle_rad);
    x += force * direction.cos;
    y += force * direction.sin;
    ++neighbours;
  }
  if (neighbours > 0)
  {
    x /= neighbours;
    y /= neighbours;
  }

  double readings[CCI_FootBotState::NUM_LIGHT_SENSORS];
  cRobotState.GetAllLightSensorReadings(readings);
  double light_x = 0;
  double light_y = 0;
  for (unsigned i = 0; i < CCI_FootBotState::NUM_LIGHT_SENSORS; ++i)
  {
    const SinCos direction = SinCosOf(CCI_FootBotState::GetLightSensorAngle(i));
    light_x += readings[i] * direction.cos;
    light_y += readings[i] * direction.sin;
  }
  // Only the direction of the light counts, so that the speed of the flock does not depend on the distance to it.
  const double light = std::sqrt(light_x * light_x + light_y * light_y);
  if (light > 0)
  {
    x += kLightWeight * light_x / light;
    y += kLightWeight * light_y / light;
  }
  const double length = std::sqrt(x * x + y * y);
  if (length < 1e-6)
    cRobotState.SetFootBotWheelsAngularVelocity(0, 0);
  else
    BTFootbotSteer(cRobotState, Atan2(y, x), speed_ * std::min(1.0, 2 * length));
}
