// The three sensors below the front of a Pi-Puck. They are numbered from the left.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/math/quaternion.h>
#include <argos3/core/utility/math/vector3.h>

#include <functional>
#include <string>
#include <tuple>

namespace argos
{

class CCI_PiPuckGroundSensor : public CCI_Sensor
{
public:
  // Anchor, place in its frame (m), rotation of the z-axis to the direction of view, and range (m).
  using TConfiguration = std::tuple<std::string, CVector3, CQuaternion, Real>;
  struct SInterface
  {
    SInterface(UInt8 label, const TConfiguration& configuration) : Label(label), Configuration(configuration) {}
    const UInt8 Label;
    const TConfiguration& Configuration;
    Real Reflected = 0;   // 0 on black, 1 on white
    Real Background = 0;  // always 0
  };
  // Calls the function for each sensor.
  virtual void Visit(std::function<void(const SInterface&)> function) = 0;
};

}  // namespace argos
