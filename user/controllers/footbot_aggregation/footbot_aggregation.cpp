#include "footbot_aggregation.h"

#include <algorithm>

#include "common/math/elementary.h"

using namespace swarmanoid;

int CFootBotAggregation::Init(const TConfigurationTree t_tree)
{
  wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
  beacon_ = &GetRobot()->Actuator<CCI_FootBotBeaconActuator>("footbot_beacon");
  camera_ = &GetRobot()->Sensor<CCI_FootBotOmnidirectionalCameraSensor>("footbot_omnidirectional_camera");
  radius_m_ = t_tree.GetNumber("radius");
  free_m_s_ = t_tree.GetVector2("free");
  seen_m_s_ = t_tree.GetVector2("seen");
  return RETURN_OK;
}

void CFootBotAggregation::ControlStep()
{
  beacon_->SetColour(CCI_Colour::RED);
  const Vector2& speeds = SeesRobot() ? seen_m_s_ : free_m_s_;
  wheels_->SetFootBotWheelsLinearVelocity(speeds.x(), speeds.y());
}

// Returns whether the line straight ahead meets a body, whose beacon is in its middle.
bool CFootBotAggregation::SeesRobot() const
{
  const auto blobs = camera_->GetAllBlobs();
  return std::any_of(blobs.begin(), blobs.end(),
                     [&](const CCI_ColourBlob& blob)
                     {
                       const SinCos direction = SinCosOf(blob.angle_rad);
                       return direction.cos > 0 && std::abs(direction.sin) * blob.distance_m <= radius_m_;
                     });
}

REGISTER_CONTROLLER(CFootBotAggregation,
                    {.label = "footbot_aggregation",
                     .brief = "one of two pairs of wheel speeds, by whether another robot's beacon is straight ahead",
                     .parameters = {
                         {.name = "free",
                          .type = swarmanoid::ParameterType::kVector2,
                          .unit = "m/s",
                          .default_value = "-0.0983, -0.1508",
                          .description = "Left and right wheel if no robot is ahead: the robot drives on a circle.",
                          .minimum = -1000,
                          .maximum = 1000},
                         {.name = "seen",
                          .type = swarmanoid::ParameterType::kVector2,
                          .unit = "m/s",
                          .default_value = "0.1757, -0.1757",
                          .description = "Left and right wheel if a robot is ahead: it turns on the spot.",
                          .minimum = -1000,
                          .maximum = 1000},
                         {.name = "radius",
                          .unit = "m",
                          .default_value = "0.085036758",
                          .description = "Radius of the bodies that it sees.",
                          .minimum = 0,
                          .maximum = 1e6}}})
