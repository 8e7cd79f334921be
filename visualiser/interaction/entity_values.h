// The numbers of one entity as people read them: where it is, its attributes, and what goes on inside a robot. Each
// has a name by which it is found again at a later tick, for plots.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/messages/robot_status.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

struct EntityValue
{
  std::string name;
  std::string unit;  // as of CCI_Reading; "entity": 1 + its index, 0 for none
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
  std::string name;  // of a device: its type
  std::vector<EntityValue> values;
};

struct EntityMotion
{
  double speed = 0;  // m/s
  double turn = 0;   // degrees/s, of the heading
};

// motion: nothing if it is not known. status: of a robot that is watched, otherwise nullptr.
std::vector<ValueGroup> ValuesOf(const CSwarmanoidSpace& space, std::uint32_t entity,
                                 const std::optional<EntityMotion>& motion, const RobotStatus* status);

// One of these numbers.
struct ValueName
{
  std::uint32_t entity = 0;
  ValueGroup::Source source = ValueGroup::Source::kPose;
  std::string group;
  std::string name;

  bool operator==(const ValueName&) const = default;
};

// nullopt where the groups do not have it (now).
std::optional<EntityValue> FindValue(const std::vector<ValueGroup>& groups, const ValueName& name);

// A number that stands for a colour or an entity, up to `most`; nullopt if it is none of them. Readings of
// controllers may be any number: an infinite one is a range without an echo.
std::optional<std::uint32_t> WholeNumber(double value, std::uint32_t most);

// "0.123 m", "inf m", "yes", "#ff0000", the id of an entity.
std::string ValueText(const CSwarmanoidSpace& space, const EntityValue& value);

}  // namespace swarmanoid
