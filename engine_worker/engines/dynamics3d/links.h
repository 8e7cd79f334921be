// LinkTable: the joints that come and go during a run: grips, ropes, magnets. Each joint remembers the poses of its
// bodies when it was made. A joint that is made again from other poses would differ in the last bit.
#pragma once

#include <memory>
#include <vector>

#include "common/serialisation/bytes.h"
#include "engine_worker/engines/dynamics3d/ode_world.h"

namespace swarmanoid::dynamics3d
{

enum class ELink : std::uint8_t
{
  kHinge,  // a motor about `axis` through `anchor`: a gripper on its turret or wrist
  kFixed,
  kRope  // holds the distance between `anchor` on body a and `other` on body b; pulls only
};

struct LinkSpec
{
  ELink kind = ELink::kFixed;
  int body_a = 0;
  int body_b = -1;  // -1: the world
  std::uint32_t entity_a = kNoEntity;
  std::uint32_t entity_b = kNoEntity;
  // Values at the time of creation, in the frame of the engine.
  double anchor[3] = {0, 0, 0};
  double axis[3] = {0, 0, 1};
  double other[3] = {0, 0, 0};
  double motor_torque = 0;  // N m, hinges
};

// Movable things that are held do not collide with their holder: the joint keeps them apart.
bool JoinsTwoEntities(const LinkSpec& spec);

class Link
{
public:
  Link(OdeWorld& world, const LinkSpec& spec, std::uint32_t serial);
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  const LinkSpec& Spec() const { return spec_; }
  std::uint32_t Serial() const { return serial_; }

  // Hinges: the speed of body b against body a about the axis that the motor keeps, rad/s, and the speed that it has.
  void SetMotorSpeed(double speed);
  double HingeSpeed() const;

  // Ropes: the free length in metres; the rope is slack while the anchors are nearer.
  void SetLength(double length);
  double Length() const { return length_; }
  // Takes over the length that the rope has in another process; the joint follows with the next step.
  void FollowLength(double length) { length_ = length < 0 ? first_length_ : length; }
  bool IsTaut() const { return taut_; }
  double AnchorDistance() const;
  void TightenOrSlacken();

  // Returns the force (N) and torque (N m) of the joint on body a in the last step, in the frame of the engine.
  Vector3 ForceOnA() const { return VectorOf(feedback_.f1); }
  Vector3 TorqueOnA() const { return VectorOf(feedback_.t1); }

private:
  friend class LinkTable;
  // The joint exists while its bodies are in one world.
  void CreateJoint();
  void DestroyJoint();

  OdeWorld& world_;
  LinkSpec spec_;
  std::uint32_t serial_;
  RawPose pose_a_, pose_b_;  // at creation
  dJointID joint_ = nullptr;
  dJointFeedback feedback_{};
  double length_ = -1;        // -1: of the new joint
  double first_length_ = -1;  // of the new joint
  bool taut_ = true;
};

class LinkTable
{
public:
  explicit LinkTable(OdeWorld& world) : world_(world) {}

  Link& Add(const LinkSpec& spec);
  // Returns the link, or nullptr if it does not exist or was removed. 0 is never a serial.
  Link* Find(std::uint32_t serial);
  const Link* Find(std::uint32_t serial) const;
  void Remove(std::uint32_t serial);
  // Removes the links of an entity for which `ends(spec)` returns true. Returns true if other links of the entity
  // remain.
  template <class Ends>
  bool RemoveIf(std::uint32_t entity, const Ends& ends)
  {
    bool others = false;
    for (std::size_t k = links_.size(); k-- > 0;)
    {
      const LinkSpec& spec = links_[k]->Spec();
      if (spec.entity_a != entity && spec.entity_b != entity) continue;
      if (ends(spec))
        Erase(k);
      else
        others = true;
    }
    return others;
  }
  // Returns whether two entities hang together by links, the world not counted as a member.
  bool AreConnected(std::uint32_t a, std::uint32_t b) const;
  // Marks the entities that have links.
  void Mark(std::vector<std::uint8_t>& has_links) const;
  std::size_t Size() const { return links_.size(); }
  // Calls act(assembly, assembly) for each link between two.
  template <class Act>
  void ForEachPair(const Act& act) const
  {
    for (const auto& link : links_)
      if (const LinkSpec& spec = link->Spec(); spec.body_b >= 0)
        act(world_.RecordOf(spec.body_a).assembly, world_.RecordOf(spec.body_b).assembly);
  }

  // Destroys the joints of assemblies that move to another world: is_moving(assembly).
  template <class IsMoving>
  void DestroyJoints(const IsMoving& is_moving)
  {
    for (const auto& link : links_)
      if (is_moving(world_.RecordOf(link->Spec().body_a).assembly)) link->DestroyJoint();
  }
  // Makes the joints of links that have none. Both bodies of a link must be in one world.
  void CreateJoints();

  void Save(ByteWriter& state) const;
  void Load(ByteReader& state);
  // Calls act(link) for each link, in the order of creation.
  template <class Act>
  void ForEach(const Act& act) const
  {
    for (const auto& link : links_) act(*link);
  }
  static void SaveLink(const Link& link, ByteWriter& state);
  // Ends all links but `count` ones that SaveLink saved, in the order of creation. Links that exist keep their joints.
  void Follow(std::size_t count, ByteReader& state);

private:
  std::unique_ptr<Link> LoadLink(ByteReader& state) const;
  void Erase(std::size_t k);
  void IgnorePair(const LinkSpec& spec);

  OdeWorld& world_;
  std::vector<std::unique_ptr<Link>> links_;  // in the order of creation
  std::uint32_t next_serial_ = 1;
};

}  // namespace swarmanoid::dynamics3d
