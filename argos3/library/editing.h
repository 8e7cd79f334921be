// Converts changes of loop functions to our space and back.
#pragma once

#include <argos3/core/utility/datatypes/color.h>

#include "argos3/library/running.h"
#include "common/space/space.h"

namespace swarmanoid::argos3
{

inline SpaceEditor& Editor()
{
  if (TheRunning().editor == nullptr)
    THROW_ARGOSEXCEPTION("entities are changed by loop functions alone, and not in their constructor");
  return *TheRunning().editor;
}

// Our position is the middle of a box; in ARGoS3 it is the middle of the base.
inline Pose PoseOf(const CSwarmanoidSpaceEntity& entity, const argos::CVector3& position,
                   const argos::CQuaternion& orientation)
{
  Pose pose{TheRunning().translation.OurPosition(position), OurOrientation(orientation)};
  if (IsBox(entity)) pose.position += pose.orientation * Vector3(0, 0, entity.GetSize().z() / 2);
  return pose;
}

// Converts in the other direction.
inline argos::SAnchor AnchorOf(const CSwarmanoidSpaceEntity& entity, Pose pose)
{
  if (IsBox(entity)) pose.position -= pose.orientation * Vector3(0, 0, entity.GetSize().z() / 2);
  argos::SAnchor anchor;
  anchor.Position = TheRunning().translation.Argos3Position(pose.position);
  anchor.Orientation = Argos3Orientation(pose.orientation);
  return anchor;
}

inline const CSwarmanoidSpaceEntity& Declared(const std::string& id)
{
  const auto* entity = Editor().GetSpace().FindEntity(TheRunning().OurId(id));
  if (entity == nullptr)
    THROW_ARGOSEXCEPTION("there is no entity '" << id << "': the experiment file declares none, and none was added");
  return *entity;
}

// Returns the object of ARGoS3 in the arena; nullptr for an entity outside the arena.
argos::CBodyEntity* TheirBodyOf(const std::string& our_id);

inline std::uint32_t Rgb(const argos::CColor& colour)
{
  return static_cast<std::uint32_t>(colour.GetRed()) << 16U | static_cast<std::uint32_t>(colour.GetGreen()) << 8U |
         colour.GetBlue();
}

}  // namespace swarmanoid::argos3
