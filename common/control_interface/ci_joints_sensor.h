// CCI_JointsSensor: the joints of any robot whose kind has them, by their names in its URDF file. The type label is
// "joints".
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

// Joints turn or slide: positions are in rad or m, velocities in rad/s or m/s, efforts in N m or N.
class CCI_JointsSensor : public CCI_SensorOf<CCI_JointsSensor>
{
public:
  static constexpr std::size_t NUM_PER_JOINT = 3;  // position, velocity, effort

  // Returns the number of joints.
  virtual unsigned GetNumJoints() const = 0;
  // Returns the name of a joint, in the order of the URDF file. Throws std::out_of_range if it does not exist.
  virtual const std::string& GetName(unsigned joint) const = 0;
  // Returns whether a joint slides.
  virtual bool Slides(unsigned joint) const = 0;
  // Returns position, velocity and effort of each joint, valid until the next control step.
  virtual std::span<const double> GetAllSensorReadings() const = 0;

  // Returns the number of a joint. Throws std::invalid_argument for an unknown name.
  unsigned GetJoint(const std::string& name) const
  {
    for (unsigned joint = 0; joint < GetNumJoints(); ++joint)
      if (GetName(joint) == name) return joint;
    throw std::invalid_argument("the robot has no joint '" + name + "'");
  }
  // Returns the position of a joint. The position of one that turns without end is between -pi and pi.
  double GetPosition(unsigned joint) const { return GetAllSensorReadings()[NUM_PER_JOINT * Checked(joint)]; }
  double GetVelocity(unsigned joint) const { return GetAllSensorReadings()[NUM_PER_JOINT * Checked(joint) + 1]; }
  // Returns what the motor exerted at the end of the last tick. Planes do not compute it; it is 0 there.
  double GetEffort(unsigned joint) const { return GetAllSensorReadings()[NUM_PER_JOINT * Checked(joint) + 2]; }

  static void Declare(Declaration& columns)
  {
    columns.AddNamed({{"# position", "rad"}, {"# velocity", "rad/s"}, {"# effort", "N m"}},
                     &CCI_JointsSensor::GetAllSensorReadings,
                     [](const CCI_JointsSensor& sensor, std::size_t joint, CCI_Column& column)
                     {
                       const auto number = static_cast<unsigned>(joint);
                       column.name.replace(0, 1, sensor.GetName(number));
                       if (sensor.Slides(number))
                         column.unit = column.unit == "rad" ? "m" : column.unit == "rad/s" ? "m/s" : "N";
                     });
  }

private:
  std::size_t Checked(unsigned joint) const
  {
    if (joint >= GetNumJoints())
      throw std::out_of_range("joint " + std::to_string(joint) + " of " + std::to_string(GetNumJoints()));
    return joint;
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_JointsSensor;
