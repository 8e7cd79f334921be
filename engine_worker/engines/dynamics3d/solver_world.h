// SolverWorld: one world of ODE with the bodies of some assemblies (ode_world.h), stepped so that equal states give
// equal next states whatever came before: contacts are made in the order of the solids' numbers. Islands that few
// iterations would leave soft are solved with more, each by itself; objects at rest sleep until something that is awake
// touches them. The world knows which of its assemblies and static solids can meet (solver_groups.h). One thread at a
// time steps a world; several threads may step several worlds.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine_worker/engines/dynamics3d/ode_world.h"
#include "engine_worker/engines/rigid_bodies/islands.h"

namespace swarmanoid::dynamics3d
{

class SolverWorld
{
public:
  static constexpr std::uint32_t kHome = 0xffffffff;
  // A step is cut if a solid goes farther than this part of its least width.
  static constexpr double kPartOfWidth = 0.25;

  // `number`: among the worlds of groups, or kHome.
  explicit SolverWorld(OdeWorld& all, std::uint32_t number = kHome);
  ~SolverWorld();
  SolverWorld(const SolverWorld&) = delete;
  SolverWorld& operator=(const SolverWorld&) = delete;

  dWorldID World() const { return world_; }
  std::uint32_t Number() const { return number_; }

  // Two assemblies, or an assembly and a static solid, that can meet before the groups are found again.
  struct NearAssemblies
  {
    std::uint32_t first, second;
  };
  struct NearStatic
  {
    std::uint32_t assembly;
    const Solid* solid;
  };

  // Sets the assemblies whose bodies are in this world, ascending.
  void SetMembers(std::vector<std::uint32_t> members);
  std::span<const std::uint32_t> Members() const { return members_; }
  void ForgetNear();
  void Add(const NearAssemblies& near) { near_.push_back(near); }
  void Add(const NearStatic& near) { near_statics_.push_back(near); }
  // Adds two entities of this world that do not collide, since one holds the other.
  void AddHeld(std::uint32_t low, std::uint32_t high) { held_.emplace_back(low, high); }

  // Advances the world by one step of `seconds`. `number` counts the steps since the start of the experiment; it
  // decides the order of constraints.
  void Step(double seconds, std::uint64_t number);
  // Returns into how many equal parts a step must be cut so that no body passes through another one.
  int PartsOfStep(double seconds);
  int ContactCount() const { return static_cast<int>(contacts_.size()); }

private:
  struct Pair
  {
    std::uint32_t a;
    std::uint32_t b;
    bool done;
  };
  struct Contact
  {
    dContact joint;
    int body_a;  // -1: none
    int body_b;
    std::uint32_t pair;
    bool is_spinning;  // a wheel that slips on slippery ground
  };
  struct IslandMember
  {
    std::uint32_t island;
    std::uint32_t number;
  };

  const Solid& SolidAt(std::uint32_t number) const { return *all_.Solids()[number]; }
  // Returns the geom of a solid, or this world's copy if threads cannot share it.
  dGeomID GeomOf(const Solid& solid);
  BodyRecord& RecordOf(int body) { return all_.RecordOf(body); }
  const BodyRecord& RecordOf(int body) const { return all_.RecordOf(body); }
  std::uint32_t PositionOf(int body) const { return all_.AssemblyOf(body).position; }
  std::uint32_t PositionOfEntity(std::uint32_t entity) const;
  bool IsObject(int body) const { return RecordOf(body).owner.kind == EBody::kObject; }
  bool IsMechanism(int body) const { return RecordOf(body).owner.kind == EBody::kMechanism; }
  static Box BoxOf(const Solid& solid) { return solid.body < 0 ? solid.box : BoxAround(solid.geom); }
  bool IsAwake(const Solid& solid) const;
  bool IsIgnored(std::uint32_t a, std::uint32_t b) const;
  bool HasToStep() const;
  template <class Act>
  void ForEachNear(const Act& act);
  void CollectPairs();
  double LargestWay(const Solid& solid, double seconds) const;
  void MakeContacts(const Solid& a, const Solid& b, std::uint32_t pair);
  Vector3 WayOf(const Solid& a, const Solid& b) const;
  bool Accept(const dContactGeom& contact, const Solid& a, const Solid& b) const;
  void AddContact(const dContactGeom& geometry, const Solid& a, const Solid& b, std::uint32_t pair);
  void FindContacts();
  void FindDelicateIslands();
  void Attach(const Contact& contact);
  int DelicateIterations(int objects) const;
  void Solve(double seconds, int iterations, std::uint64_t number);
  void SolveOthers(double seconds, std::uint64_t number);
  void SolveDelicateIslands(double seconds, std::uint64_t number);
  void RestObjects(double seconds);
  void PutToSleep(int body);

  OdeWorld& all_;
  const WorldSettings& settings_;
  std::uint32_t number_;
  dWorldID world_ = nullptr;
  dThreadingImplementationID threading_ = nullptr;
  dJointGroupID contact_joints_ = nullptr;
  std::vector<std::pair<const Solid*, dGeomID>> copies_;
  std::vector<std::uint32_t> members_;
  std::vector<int> bodies_;  // of the members, ascending
  bool has_objects_ = false, has_mechanisms_ = false;
  std::vector<NearAssemblies> near_;
  std::vector<NearStatic> near_statics_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> held_;  // entities
  double step_seconds_ = 0;
  // Values of the last step. Islands are numbered by the position of their first member.
  std::vector<Box> boxes_;  // of the members
  std::vector<Pair> pairs_;
  std::vector<Contact> contacts_;
  Islands islands_;
  std::vector<bool> is_delicate_;              // by island
  std::vector<IslandMember> island_bodies_;    // of delicate islands
  std::vector<IslandMember> island_contacts_;  // of delicate islands
  std::vector<bool> is_in_island_;             // by contact
};

}  // namespace swarmanoid::dynamics3d
