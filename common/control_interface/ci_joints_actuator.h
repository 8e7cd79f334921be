// CCI_JointsActuator: the joints of any robot whose kind has them, by their names in its URDF file. The type label is
// "joints".
#pragma once

#include <span>
#include <stdexcept>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

// Joints turn or slide: positions are in rad or m, velocities in rad/s or m/s. Until it is commanded, a joint stays
// where it started. A joint without effort moves freely, and ignores commands.
class CCI_JointsActuator : public CCI_ActuatorOf<CCI_JointsActuator>
{
public:
  // Returns the number of joints.
  virtual unsigned GetNumJoints() const = 0;
  // Returns the name of a joint, in the order of the URDF file. Throws std::out_of_range if it does not exist.
  virtual const std::string& GetName(unsigned joint) const = 0;
  // Returns whether a joint slides.
  virtual bool Slides(unsigned joint) const = 0;
  // Return the range of a joint's positions, infinite for one that turns without end, and its largest speed.
  virtual double GetLowest(unsigned joint) const = 0;
  virtual double GetHighest(unsigned joint) const = 0;
  virtual double GetMaxSpeed(unsigned joint) const = 0;
  // Returns whether the experiment wants speeds in the columns (control="velocity"), and not positions.
  virtual bool AreColumnsVelocities() const = 0;
  // Moves a joint to a position at its largest speed. A joint that turns without end takes the shorter way. NaN ends a
  // simulation with an error. Both functions throw std::out_of_range if the joint does not exist.
  virtual void SetPosition(unsigned joint, double position) = 0;
  // Keeps a joint at a velocity until it reaches the end of its range.
  virtual void SetVelocity(unsigned joint, double velocity) = 0;

  // Returns the number of a joint. Throws std::invalid_argument for an unknown name.
  unsigned GetJoint(const std::string& name) const
  {
    for (unsigned joint = 0; joint < GetNumJoints(); ++joint)
      if (GetName(joint) == name) return joint;
    throw std::invalid_argument("the robot has no joint '" + name + "'");
  }
  // Group-level form: a position for each joint, or a velocity, as AreColumnsVelocities says. Throws
  // std::invalid_argument for another count.
  void SetAllActuatorOutputs(std::span<const double> values)
  {
    if (values.size() != GetNumJoints())
      throw std::invalid_argument(std::to_string(values.size()) + " values for " + std::to_string(GetNumJoints()) +
                                  " joints");
    for (unsigned joint = 0; joint < GetNumJoints(); ++joint)
      AreColumnsVelocities() ? SetVelocity(joint, values[joint]) : SetPosition(joint, values[joint]);
  }

  static void Declare(Declaration& columns)
  {
    columns
        .Set(
            {{"#", "rad"}},
            [](CCI_JointsActuator& joints, std::span<const double> values) { joints.SetAllActuatorOutputs(values); },
            &CCI_JointsActuator::GetNumJoints)
        .NameSettings(
            [](const CCI_JointsActuator& joints, std::size_t joint, CCI_Column& column)
            {
              const auto number = static_cast<unsigned>(joint);
              column.name = joints.GetName(number);
              column.unit = joints.Slides(number) ? "m" : "rad";
              if (joints.AreColumnsVelocities()) column.unit += "/s";
            });
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_JointsActuator;
