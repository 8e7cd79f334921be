// The entities of the space: identity, pose, attributes. They hold the values that sensors and renderers need; masses,
// speeds and forces are in the engines (CPhysicsEngineEntity). An entity is a thin view on the flat arrays of its
// space. Entities of a const space are read-only.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "common/experiment/experiment.h"
#include "common/math/pose.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class CSwarmanoidSpaceEntity
{
public:
  CSwarmanoidSpaceEntity(CSwarmanoidSpace& space, std::uint32_t index, const EntityConfiguration& configuration,
                         std::uint32_t first_slot);
  virtual ~CSwarmanoidSpaceEntity() = default;
  CSwarmanoidSpaceEntity(const CSwarmanoidSpaceEntity&) = delete;
  CSwarmanoidSpaceEntity& operator=(const CSwarmanoidSpaceEntity&) = delete;

  const std::string& GetId() const { return configuration_.id; }
  EntityKind GetKind() const { return configuration_.kind; }
  std::uint32_t GetIndex() const { return index_; }
  bool IsMovable() const { return configuration_.movable; }
  const EntityConfiguration& GetConfiguration() const { return configuration_; }
  // Returns the size of the body along its axes in metres; cylinders: radius, radius, height. The position is the
  // centre of the base for robots and preys, and of the body for blocks.
  const Vector3& GetSize() const { return configuration_.size; }

  Pose GetPose() const;
  Vector3 GetPosition() const;
  Quaternion GetOrientation() const;

  // Returns the number of an attribute (attributes.h); throws std::out_of_range for a name that the kind does not have,
  // and for an element beyond its number.
  double GetAttribute(std::string_view name, int element = 0) const;
  // Only the owner of the space (the space server, a replica) may call this. Experiment functions use
  // SpaceEditor::SetAttribute.
  void SetAttribute(std::string_view name, double value, int element = 0);
  std::uint32_t SlotOf(std::string_view name, int element = 0) const;
  std::uint32_t FirstSlot() const { return first_slot_; }

protected:
  const CSwarmanoidSpace& Space() const { return space_; }
  const EntityConfiguration& configuration_;

private:
  CSwarmanoidSpace& space_;
  std::uint32_t index_;
  std::uint32_t first_slot_;
};

// A robot is an entity with a controller.
class CRobotEntity : public CSwarmanoidSpaceEntity
{
public:
  using CSwarmanoidSpaceEntity::CSwarmanoidSpaceEntity;
  // Returns the id of the controller in <controllers>; empty for none.
  const std::string& GetControllerId() const { return configuration_.controller; }
};

class CFootBotEntity : public CRobotEntity
{
public:
  using CRobotEntity::CRobotEntity;
  static constexpr int kLeds = 12;
  std::uint32_t GetLedColour(int led) const;
  std::uint32_t GetBeaconColour() const;
  double GetGripperAperture() const;
  // Returns the entity held by the gripper, or nullptr.
  const CSwarmanoidSpaceEntity* GetGrippedEntity() const;
  double GetTurretAngle() const;
};

class CHandBotEntity : public CRobotEntity
{
public:
  using CRobotEntity::CRobotEntity;
  static constexpr int kLeds = 12;
  std::uint32_t GetLedColour(int led) const;
  // Returns the entity held by a hand (0 left, 1 right), or nullptr.
  const CSwarmanoidSpaceEntity* GetGrippedEntity(int hand) const;
};

class CEyeBotEntity : public CRobotEntity
{
public:
  using CRobotEntity::CRobotEntity;
  static constexpr int kLeds = 16;
  std::uint32_t GetLedColour(int led) const;
  bool IsLaserOn() const;
  std::uint32_t GetLaserColour() const;
};

class CBlockEntity : public CSwarmanoidSpaceEntity
{
public:
  using CSwarmanoidSpaceEntity::CSwarmanoidSpaceEntity;
};

class CCylindricPreyEntity : public CSwarmanoidSpaceEntity
{
public:
  using CSwarmanoidSpaceEntity::CSwarmanoidSpaceEntity;
  double GetRadius() const { return GetSize().x(); }
  double GetHeight() const { return GetSize().z(); }
};

class CLightBulbEntity : public CSwarmanoidSpaceEntity
{
public:
  using CSwarmanoidSpaceEntity::CSwarmanoidSpaceEntity;
  double GetIntensity() const { return GetAttribute("intensity"); }
  std::uint32_t GetColour() const;
};

class CSoundSourceEntity : public CSwarmanoidSpaceEntity
{
public:
  using CSwarmanoidSpaceEntity::CSwarmanoidSpaceEntity;
};

// A patch is a coloured area of the floor, such as the nest. A hole is an area without floor.
class CGroundPatchEntity : public CSwarmanoidSpaceEntity
{
public:
  using CSwarmanoidSpaceEntity::CSwarmanoidSpaceEntity;
};

}  // namespace swarmanoid
