// CPhysicsEngine and CPhysicsEngineEntity: what a physics engine is to the simulator. An engine is a closed world with
// a frame of its own; it moves the entities that it owns and reports their global poses. A plug-in: see
// docs/own_engine.md.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/configuration/parameter.h"
#include "common/experiment/experiment.h"
#include "common/messages/assignment.h"
#include "common/messages/regions.h"
#include "common/messages/tick_messages.h"
#include "common/plugins/registry.h"
#include "common/serialisation/bytes.h"
#include "common/space/entity.h"

#ifndef SWARMANOID_OWN_SOURCES
#include <common/space/space.h>  // for plug-ins, which mostly need it
#endif

namespace swarmanoid
{

class CSwarmanoidSpace;
class WorkerPool;

// How an entity takes part in an engine.
enum class EBinding
{
  kOwned,   // the engine moves it
  kMirror,  // movable, but another engine moves it: it follows the space, pushes and is not pushed
  kFixed    // it never moves
};

// The velocity of an entity in the frame of the space.
struct EntityVelocity
{
  Vector3 linear = Vector3::Zero();   // m/s, of its position
  Vector3 angular = Vector3::Zero();  // rad/s
};

// The other self of a space entity inside an engine: masses, speeds, joints. Engines may derive from it or keep flat
// arrays of their own; how it is linked to the engine is up to them.
class CPhysicsEngineEntity
{
public:
  explicit CPhysicsEngineEntity(const CSwarmanoidSpaceEntity& entity) : space_entity_(entity) {}
  virtual ~CPhysicsEngineEntity() = default;
  const CSwarmanoidSpaceEntity& GetSpaceEntity() const { return space_entity_; }

private:
  const CSwarmanoidSpaceEntity& space_entity_;
};

// Everything an engine is made from. The references outlive the engine.
struct EngineSetup
{
  const EngineConfiguration& configuration;
  Parameters parameters;          // of the engine's element, by the table that it registered
  const CSwarmanoidSpace& space;  // this process's replica: entities, poses of the tick that the step starts from
  const EngineLayout& layout;     // the order of owned entities, command and sensor channels
  // The processes that compute the regions of a split engine in a cluster, otherwise nullptr.
  RegionTeam* team = nullptr;
  unsigned threads = 1;  // that the process has for its work
  // The process has a pool (common/threads/worker_pool.h) if it has several threads. Its Shares() says at each tick
  // whether they help.
  WorkerPool* pool = nullptr;
};

// The commands of one step: EngineLayout::commands with the values filled in.
struct EngineCommands
{
  const std::vector<ChannelBlock>& blocks;
  std::span<const double> values;

  // Returns the values of a block, `width` doubles for each of its entities.
  std::span<const double> Of(const ChannelBlock& block) const
  {
    return values.subspan(block.offset, block.entities.size() * static_cast<std::size_t>(block.width));
  }
};

class CPhysicsEngine
{
public:
  virtual ~CPhysicsEngine() = default;

  // Reads the parameters. The simulator calls Init, AddEntity for every entity in entity order, Start, then Update once
  // a tick. A user's mistake throws ConfigurationError.
  virtual void Init(const EngineSetup& setup) = 0;
  // Adds an entity with its pose and size in the space. Throws ConfigurationError if the engine cannot have it.
  virtual void AddEntity(const CSwarmanoidSpaceEntity& entity, EBinding binding) = 0;
  // Called after the last AddEntity, before the first Update or LoadState. Throws ConfigurationError.
  virtual void Start() {}

  // Advances the engine by one clock tick in `subclock` equal steps. Mirrors are first moved to their poses in the
  // space. Fills `update.poses`, sized by the caller: 7 doubles for each of layout.owned (m and unit quaternions,
  // global frame). They are a structure of arrays x y z qx qy qz qw. Adds changes (grips, turret angles …) to
  // update.attributes and fills `sensors` (layout.sensors). The caller checks the result: finite numbers, quaternions
  // of norm 1, and slots and values of attributes as in common/space/attributes.h. A mistake or an exception ends the
  // run with an error that names the engine, the entity, the tick and the value.
  virtual void Update(const EngineCommands& commands, EngineUpdate& update, std::span<double> sensors) = 0;

  // An owned entity was put elsewhere from outside; its pose is to be read from the space.
  virtual void EntityMoved(std::uint32_t entity) = 0;
  // A mirror was put elsewhere from outside, so its last way says nothing about the next one.
  virtual void MirrorMoved(std::uint32_t /*entity*/) {}

  // The next three calls are for engines with PluginDescription::hands_over, and entities that change their engine. The
  // engine gets each of these twice: by AddEntity as kMirror, then as kOwned. One of the two bodies touches others, and
  // the other one touches nothing. After Start all are handed over that other engines move at first.
  //
  // From now on the engine moves the entity. The space has its pose and attributes, such as the angle of its turret. It
  // has no grips, rope or magnet. Called before Update and LoadState.
  virtual void TakeOver(std::uint32_t entity, const EntityVelocity& velocity);
  // From now on another engine moves the entity, which is a mirror here. What the engine reports about it is ignored.
  // Called before Update and LoadState.
  virtual void HandOver(std::uint32_t entity);
  // Returns the velocity of an owned entity after Update, or nothing for an engine without velocities: then that of the
  // way of the last tick counts.
  virtual std::optional<EntityVelocity> VelocityOf(std::uint32_t /*entity*/) const { return std::nullopt; }

  // Saves a checkpoint. After Canonicalise, SaveState and LoadState into an engine made from the same experiment, all
  // further updates have the same bits as without them.
  virtual void SaveState(ByteWriter& state) const = 0;
  // Restores a saved state. Throws std::runtime_error for data that is not a state of this experiment.
  virtual void LoadState(ByteReader& state) = 0;
  // Drops everything that the saved state does not hold (caches, contact order). Called at the same ticks in every run.
  virtual void Canonicalise() = 0;
  // The run begins again (SpaceEditor::BeginAgain), after EntityMoved was called for each moved entity. State that does
  // not follow from the space must return to the state of a new engine.
  virtual void BeginAgain() { Canonicalise(); }
  // Returns true if Canonicalise has nothing to drop at any tick: then SaveState is exact after each Update.
  virtual bool IsAlwaysCanonical() const { return false; }

  // Makes a region of an engine that can be split (PluginDescription::can_split), in a process of its own. The region
  // belongs to an engine of the same tag with a team, and gets all data in its first task. Only this function is called
  // on such an object, which has no space and no experiment; or, if RegionsKnowEntities, after Init, AddEntity and
  // Start, and the object outlives the region. `exchange` outlives the result.
  virtual std::unique_ptr<EngineRegion> MakeRegion(unsigned region, RegionExchange& exchange);
  // Returns true if the process of a region must make the whole engine first, with all its entities.
  virtual bool RegionsKnowEntities() const { return false; }

  // Returns numbers about the last update for diagnosis, such as contacts or pairs, in one short line; it may be empty.
  virtual std::string StatusText() const { return {}; }
};

template <>
PluginRegistry<CPhysicsEngine>& PluginRegistry<CPhysicsEngine>::Instance();

// Registers an engine; REGISTER_PHYSICS_ENGINE makes one.
struct PhysicsEngineRegistration
{
  PhysicsEngineRegistration(const PluginDescription& description, std::unique_ptr<CPhysicsEngine> (*create)())
  {
    PluginRegistry<CPhysicsEngine>::Instance().Add(description, create);
  }
};

}  // namespace swarmanoid

using swarmanoid::CPhysicsEngine;
using swarmanoid::CPhysicsEngineEntity;

// REGISTER_PHYSICS_ENGINE(CMyEngine, description) registers an engine; description is a PluginDescription expression.
#define REGISTER_PHYSICS_ENGINE(CLASS, ...)                                                                      \
  namespace                                                                                                      \
  {                                                                                                              \
  const ::swarmanoid::PhysicsEngineRegistration registration_of_##CLASS(                                         \
      __VA_ARGS__, []() -> std::unique_ptr<::swarmanoid::CPhysicsEngine> { return std::make_unique<CLASS>(); }); \
  }
