// The numbers of one entity as people read them: its pose, its attributes, and the status of a robot's controller and
// devices. Each number has a name, by which plots find it again at a later tick.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "idl/robot_status.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

struct EntityValue
{
  std::string name;
  std::string unit;  // as in CCI_Reading; "entity": 1 + its index, 0 for none
  double value = 0;
};

struct ValueGroup
{
  enum class Source
  {
    kPose,
    kAttributes,
    kSensor,
    kActuator
  };

  Source source;
  std::string name;  // the type, for a device
  std::vector<EntityValue> values;
};

struct EntityMotion
{
  double speed = 0;  // m/s
  double turn = 0;   // degrees/s, change of the heading
};

// Returns the values in groups. `motion` is nothing if it is unknown. `status` is that of a watched robot, otherwise
// nullptr.
std::vector<ValueGroup> ValuesOf(const CSwarmanoidSpace& space, std::uint32_t entity,
                                 const std::optional<EntityMotion>& motion, const RobotStatus* status);

// The name of one of these numbers.
struct ValueName
{
  std::uint32_t entity = 0;
  ValueGroup::Source source = ValueGroup::Source::kPose;
  std::string group;
  std::string name;

  bool operator==(const ValueName&) const = default;
};

// Returns nullopt if the groups do not contain the value now.
std::optional<EntityValue> FindValue(const std::vector<ValueGroup>& groups, const ValueName& name);

// Returns the number of a colour or an entity, up to `most`; nullopt for other numbers. Readings of controllers may be
// any number: an infinite one is a range without an echo.
std::optional<std::uint32_t> WholeNumber(double value, std::uint32_t most);

// Returns "0.123 m", "inf m", "yes", "#ff0000", or the id of an entity.
std::string ValueText(const CSwarmanoidSpace& space, const EntityValue& value);

}  // namespace swarmanoid
