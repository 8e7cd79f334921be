#include "visualiser/interaction/entity_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "common/space/attributes.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

std::string UnitOf(std::string_view attribute)
{
  if (attribute.starts_with("gripped")) return "entity";
  if (attribute == "led" || attribute == "beacon" || attribute.ends_with("colour")) return "colour";
  if (attribute == "laser" || attribute.ends_with("attached")) return "yes/no";
  if (attribute == "rope_length") return "m";
  if (attribute == "intensity" || attribute == "message") return "";
  return "rad";
}

ValueGroup PoseGroup(const CSwarmanoidSpace& space, std::uint32_t entity, const std::optional<EntityMotion>& motion)
{
  const Pose pose = space.GetPose(entity);
  const EulerAngles angles = EulerFromQuaternion(pose.orientation);
  ValueGroup group{ValueGroup::Source::kPose, "pose", {}};
  group.values = {{"x", "m", pose.position.x()},
                  {"y", "m", pose.position.y()},
                  {"z", "m", pose.position.z()},
                  {"alpha", "degrees", RadiansToDegrees(angles.alpha)},
                  {"beta", "degrees", RadiansToDegrees(angles.beta)},
                  {"gamma", "degrees", RadiansToDegrees(angles.gamma)}};
  if (motion && space.GetEntity(entity).IsMovable())
  {
    group.values.push_back({"speed", "m/s", motion->speed});
    group.values.push_back({"turn", "degrees/s", motion->turn});
  }
  return group;
}

}  // namespace

std::vector<ValueGroup> ValuesOf(const CSwarmanoidSpace& space, std::uint32_t entity,
                                 const std::optional<EntityMotion>& motion, const RobotStatus* status)
{
  std::vector<ValueGroup> groups{PoseGroup(space, entity, motion)};
  const CSwarmanoidSpaceEntity& body = space.GetEntity(entity);
  ValueGroup attributes{ValueGroup::Source::kAttributes, "attributes", {}};
  std::uint32_t slot = body.FirstSlot();
  for (const AttributeSpec& spec : AttributesOf(body.GetKind()))
  {
    // Packed bytes are not readable as numbers.
    if (spec.name == "message") break;
    std::string name(spec.name);
    std::replace(name.begin(), name.end(), '_', ' ');
    for (int element = 0; element < spec.count; ++element, ++slot)
      attributes.values.push_back(
          {spec.count > 1 ? fmt::format("{} {}", name, element) : name, UnitOf(spec.name), space.Attributes()[slot]});
  }
  if (!attributes.values.empty()) groups.push_back(std::move(attributes));
  if (status == nullptr) return groups;

  const auto add = [&](ValueGroup::Source source, const DeviceStatus& device)
  {
    ValueGroup group{source, device.type, {}};
    for (const CCI_Reading& reading : device.readings)
      group.values.push_back({reading.name, reading.unit, reading.value});
    groups.push_back(std::move(group));
  };
  for (const DeviceStatus& device : status->sensors) add(ValueGroup::Source::kSensor, device);
  for (const DeviceStatus& device : status->actuators) add(ValueGroup::Source::kActuator, device);
  return groups;
}

std::optional<EntityValue> FindValue(const std::vector<ValueGroup>& groups, const ValueName& name)
{
  for (const ValueGroup& group : groups)
  {
    if (group.source != name.source || group.name != name.group) continue;
    for (const EntityValue& value : group.values)
      if (value.name == name.name) return value;
  }
  return std::nullopt;
}

std::optional<std::uint32_t> WholeNumber(double value, std::uint32_t most)
{
  if (!(value >= 0 && value <= most)) return std::nullopt;
  return static_cast<std::uint32_t>(value);
}

std::string ValueText(const CSwarmanoidSpace& space, const EntityValue& value)
{
  if (value.unit == "yes/no") return value.value != 0 ? "yes" : "no";
  if (value.unit == "colour")
    if (const auto colour = WholeNumber(value.value, 0xffffff))
      return *colour == 0 ? "off" : fmt::format("#{:06x}", *colour);
  if (value.unit == "entity")
  {
    const auto number = WholeNumber(value.value, static_cast<std::uint32_t>(space.Size()));
    return number.value_or(0) == 0 ? "none" : space.GetEntity(*number - 1).GetId();
  }
  // Rounding must not give a minus sign before zeros.
  const double shown = std::abs(value.value) < 5e-4 ? 0 : value.value;
  const std::string text = std::abs(shown) < 1e5 ? fmt::format("{:.3f}", shown) : fmt::format("{:.4g}", shown);
  return value.unit.empty() ? text : text + " " + value.unit;
}

}  // namespace swarmanoid
