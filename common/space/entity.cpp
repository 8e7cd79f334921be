#include "common/space/entity.h"

#include <stdexcept>

#include "common/space/attributes.h"
#include "common/space/message_slots.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

std::uint32_t ColourOf(double value) { return static_cast<std::uint32_t>(value); }

}  // namespace

CSwarmanoidSpaceEntity::CSwarmanoidSpaceEntity(CSwarmanoidSpace& space, std::uint32_t index,
                                               const EntityConfiguration& configuration, std::uint32_t first_slot)
    : configuration_(configuration), space_(space), index_(index), first_slot_(first_slot)
{
}

Pose CSwarmanoidSpaceEntity::GetPose() const { return space_.GetPose(index_); }

Vector3 CSwarmanoidSpaceEntity::GetPosition() const { return GetPose().position; }

Quaternion CSwarmanoidSpaceEntity::GetOrientation() const { return GetPose().orientation; }

std::uint32_t CSwarmanoidSpaceEntity::SlotOf(std::string_view name, int element) const
{
  const AttributeSpec* attribute = FindAttribute(GetKind(), name);
  if (attribute == nullptr)
    throw std::out_of_range("entity '" + GetId() + "' (" + std::string(TagName(GetKind())) + ") has no attribute '" +
                            std::string(name) + "'");
  const int further = name == "message" ? FurtherMessageSlots(space_.GetExperiment(), configuration_) : 0;
  if (element < 0 || element >= attribute->count + further)
    throw std::out_of_range("the attribute '" + std::string(name) + "' of '" + GetId() + "' has " +
                            std::to_string(attribute->count + further) +
                            " elements, numbered from 0; there is no element " + std::to_string(element));
  const int offset =
      element < attribute->count ? AttributeOffset(GetKind(), name) : AttributeCount(GetKind()) - attribute->count;
  return first_slot_ + static_cast<std::uint32_t>(offset + element);
}

double CSwarmanoidSpaceEntity::GetAttribute(std::string_view name, int element) const
{
  return space_.Attributes()[SlotOf(name, element)];
}

void CSwarmanoidSpaceEntity::SetAttribute(std::string_view name, double value, int element)
{
  space_.SetAttribute(SlotOf(name, element), value);
}

std::uint32_t CFootBotEntity::GetLedColour(int led) const { return ColourOf(GetAttribute("led", led)); }

std::uint32_t CFootBotEntity::GetBeaconColour() const { return ColourOf(GetAttribute("beacon")); }

double CFootBotEntity::GetGripperAperture() const { return GetAttribute("gripper_aperture"); }

const CSwarmanoidSpaceEntity* CFootBotEntity::GetGrippedEntity() const
{
  const auto held = static_cast<std::size_t>(GetAttribute("gripped"));
  return held == 0 ? nullptr : &Space().GetEntity(held - 1);
}

double CFootBotEntity::GetTurretAngle() const { return GetAttribute("turret_angle"); }

std::uint32_t CHandBotEntity::GetLedColour(int led) const { return ColourOf(GetAttribute("led", led)); }

const CSwarmanoidSpaceEntity* CHandBotEntity::GetGrippedEntity(int hand) const
{
  const auto held = static_cast<std::size_t>(GetAttribute("gripped", hand));
  return held == 0 ? nullptr : &Space().GetEntity(held - 1);
}

std::uint32_t CEyeBotEntity::GetLedColour(int led) const { return ColourOf(GetAttribute("led", led)); }

bool CEyeBotEntity::IsLaserOn() const { return GetAttribute("laser") != 0; }

std::uint32_t CEyeBotEntity::GetLaserColour() const { return ColourOf(GetAttribute("laser_colour")); }

std::uint32_t CLightBulbEntity::GetColour() const { return ColourOf(GetAttribute("colour")); }

}  // namespace swarmanoid
