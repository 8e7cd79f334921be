// The eight rangefinders around a Pi-Puck. They are numbered clockwise from the front right.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/math/quaternion.h>
#include <argos3/core/utility/math/vector3.h>

#include <functional>
#include <tuple>

namespace argos
{

class CCI_PiPuckRangefindersSensor : public CCI_Sensor
{
public:
  // Anchor, place in its frame (m), rotation of the z-axis to the direction of view, and range (m).
  using TConfiguration = std::tuple<const char*, CVector3, CQuaternion, Real>;
  struct SInterface
  {
    SInterface(const UInt8& label, const TConfiguration& configuration) : Label(label), Configuration(configuration) {}
    const UInt8 Label;
    const TConfiguration& Configuration;
    Real Proximity = 0;    // distance from the sensor, m; the range if it sees nothing
    Real Illuminance = 0;  // always 0
  };
  // Calls the function for each sensor.
  virtual void Visit(std::function<void(const SInterface&)> function) = 0;
};

}  // namespace argos
