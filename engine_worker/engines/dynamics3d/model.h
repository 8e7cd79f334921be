// Model: an entity inside the dynamics3d engine: its bodies, joints and the control that drives them. All poses and
// vectors are in the frame of the engine unless said otherwise.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "common/space/wind.h"
#include "engine_worker/engines/dynamics3d/links.h"
#include "engine_worker/engines/dynamics3d/ode_world.h"
#include "engine_worker/physics_engine.h"

namespace swarmanoid::dynamics3d
{

class Model;

// The position of the engine's frame in the space.
class Frame
{
public:
  Frame() = default;
  explicit Frame(const Pose& in_space) : in_space_(in_space), inverse_(in_space.Inverse()) {}
  Pose ToSpace(const Pose& local) const { return in_space_.Compose(local); }
  Pose ToLocal(const Pose& global) const { return inverse_.Compose(global); }
  Vector3 PointToLocal(const Vector3& global) const { return inverse_.Apply(global); }
  Vector3 VectorToSpace(const Vector3& local) const { return in_space_.orientation * local; }
  Vector3 VectorToLocal(const Vector3& global) const { return inverse_.orientation * global; }

private:
  Pose in_space_;
  Pose inverse_;
};

// Objects that all models of an engine share. The engine owns it, and it outlives the models.
struct Scene
{
  OdeWorld& world;
  LinkTable& links;
  const CSwarmanoidSpace& space;
  Frame frame;
  Vector3 up = Vector3::UnitZ();  // the space's z axis
  double tick_seconds = 0.1;
  double density = 200;  // kg/m³, of movable objects without a mass of their own
  double time_s = 0;     // of the run, at the start of this tick
  Wind wind;
  std::vector<Model*> models;  // by entity; nullptr for those without a body

  bool CanBeHeld(std::uint32_t entity) const;
};

// Writes the attributes of one entity that differ from those in the space.
class AttributeReport
{
public:
  AttributeReport(const CSwarmanoidSpaceEntity& entity, AttributeChanges& changes) : entity_(entity), changes_(changes)
  {
  }
  // Differences up to `tolerance` are not worth a message. Call in the order of the slots.
  void Set(std::string_view name, double value, int element = 0, double tolerance = 0);

private:
  const CSwarmanoidSpaceEntity& entity_;
  AttributeChanges& changes_;
};

class Model : public CPhysicsEngineEntity
{
public:
  Model(Scene& scene, const CSwarmanoidSpaceEntity& entity)
      : CPhysicsEngineEntity(entity), scene_(scene), assembly_(scene.world.BeginAssembly(Entity()))
  {
  }

  std::uint32_t Entity() const { return GetSpaceEntity().GetIndex(); }
  std::uint32_t AssemblyNumber() const { return assembly_; }

  // Puts all bodies at rest where the entity's own position and orientation say.
  virtual void Place(const Pose& pose);
  // Moves all bodies rigidly so that the entity has this pose, at rest.
  void Carry(const Pose& pose);
  Pose CurrentPose() const;

  // A model is left out while it touches nothing and does not move: an owned one whose entity another engine moves, and
  // the mirror of an entity that this engine moves.
  bool IsLeftOut() const { return is_left_out_; }
  // Leaves all bodies out of the world, or puts them back.
  virtual void SetLeftOut(bool left_out);
  // Puts the model where another engine had the entity, with the joints of its attributes.
  void TakeOver(const Pose& pose, const EntityVelocity& velocity);
  // Does the same for a ghost, in each tick: objects that sleep go on to do so.
  void Haunt(const Pose& pose, const EntityVelocity& velocity);
  // The run begins again: joints, such as the turret, are where the attributes of the entity say.
  void BeginAgain() { FollowAttributes(); }
  // Another engine moves the entity.
  bool IsElsewhere() const { return is_elsewhere_; }
  void SetElsewhere(bool is_elsewhere) { is_elsewhere_ = is_elsewhere; }
  // Returns the velocity of the entity's position.
  EntityVelocity Velocity() const;

  // Returns how far (m) from the main body's centre of mass its links can come; 0 for a model without links.
  virtual double Reach() const { return 0; }
  // Returns the largest speed (m/s) that any part of the outline has or can reach by itself.
  virtual double LargestSpeed() const;
  // Returns the box around the outline.
  virtual Box CurrentBox() const { return scene_.world.BoxOf(MainBody()); }

  int MainBody() const { return bodies_.front().number; }
  const Pose& MainOffset() const { return bodies_.front().in_entity; }

  // Takes the commands of a channel, `values` of its width, finite and in SI units.
  virtual void Command(std::string_view channel, std::span<const double> values);
  // Fills in the readings of a channel, `values` of its width, in SI units.
  virtual void Sense(std::string_view channel, std::span<double> values) const;

  // Called before the first step of a tick: joints are made or removed here.
  virtual void BeginTick() {}
  // Called before each step of `seconds`: controllers apply forces and motor speeds here.
  virtual void BeforeStep(double /*seconds*/) {}
  // Called after each step of `seconds`: integrates angles and sums for the sensors.
  virtual void AfterStep(double /*seconds*/) {}
  // Writes the attributes of the entity after a tick.
  virtual void Report(AttributeReport& /*report*/) const {}

  // Saves the state of the model that is not in its bodies and links.
  virtual void Save(ByteWriter& /*state*/) const {}
  // Restores the state from Save. Throws std::runtime_error if the state is too short.
  virtual void Load(ByteReader& /*state*/) {}
  // Save and restore, beside Save and Load, what the steps of a tick read and write: the commands, and sums for the
  // sensors. So the steps can be made by the same model in another process.
  virtual void SaveTick(ByteWriter& /*state*/) const {}
  virtual void LoadTick(ByteReader& /*state*/) {}
  // Saves and restores the model within a tick, with its bodies and whether it is left out.
  void SaveWithin(ByteWriter& state) const;
  void LoadWithin(ByteReader& state);

protected:
  struct PlacedBody
  {
    int number;
    Pose in_entity;
  };

  void AddBody(const dMass& mass, const Pose& in_entity, EBody kind = EBody::kRobot);
  // Brings the joints of a model at rest to the attributes of the entity.
  virtual void FollowAttributes() {}
  // Gives all bodies the velocity of the entity as one rigid body.
  virtual void SetVelocity(const EntityVelocity& velocity);

  Scene& scene_;
  std::vector<PlacedBody> bodies_;  // the first one gives the entity's pose

private:
  std::uint32_t assembly_;
  bool is_left_out_ = false;
  bool is_elsewhere_ = false;
  bool wakes_ = true;  // placing it wakes objects
};

// Mass distributions about their centres.
dMass CylinderMass(double mass, double radius, double height);  // axis z
dMass BoxMass(double mass, const Vector3& size);
dMass SphereMass(double mass, double radius);
dMass HullMass(double mass, const ConvexHull& hull);
// Returns the same mass, its inertia times `factor`: what a geared motor adds to a part that it turns.
dMass Geared(dMass mass, double factor);

}  // namespace swarmanoid::dynamics3d
