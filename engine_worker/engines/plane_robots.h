// The parts of robots on a plane other than their drive: the handbot's head, arms, wrists, hands and rope, the links of
// robots on wheels, and the magnets of flying robots, as kinematic models. Shared by kinematics2d and dynamics2d, in
// their engine's thread.
//
// Joints turn at their commanded speeds within their ranges. A hand that closes takes the nearest block or prey of the
// engine within its reach in the space. Hand and object then move as one rigid body on the plane. A handbot holds one
// object at a time, with one hand or both. The rope goes straight up to the ceiling. Its winch sets the height of the
// robot above the plane, and that of a held object. Objects released in the air fall freely. Collisions are those of
// the plane at any height. Wind carries flying robots along: their commands are velocities in the air.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "common/messages/assignment.h"
#include "common/messages/tick_messages.h"
#include "common/plugin_descriptions/robot_parts.h"
#include "common/serialisation/bytes.h"
#include "common/space/entity.h"
#include "common/space/shape.h"
#include "common/space/wind.h"
#include "engine_worker/engines/near_objects.h"
#include "engine_worker/engines/plane_frame.h"
#include "engine_worker/physics_engine.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

// Values are in metres, radians and seconds, and equal those of HandbotShape in dynamics3d if both have them.
struct PlaneHandbot : HandbotParts
{
  static constexpr double kWidestArm = 1.0472;
  static constexpr double kWidestWrist = 1.5708;
  static constexpr double kWidestHand = 3.1416;
  static constexpr double kHandSpeed = 3;
  static constexpr double kReach = 0.03;  // from the tip of a hand to what it can take
  static constexpr double kLongestRope = 5;
  static constexpr double kShortestRope = 0.05;
  static constexpr double kWinchSpeed = 0.15;
};

// The questions and requests of the model to its engine.
class PlaneGrips
{
public:
  virtual ~PlaneGrips() = default;
  // Makes robot and object one rigid whole. Returns false if the object may not be held, since that would close a loop.
  virtual bool Hold(std::uint32_t robot, std::uint32_t object) = 0;
  // Ends the hold of a robot, if it has one.
  virtual void LetGo(std::uint32_t robot) = 0;
  // Returns whether the robot holds an object.
  virtual bool Holds(std::uint32_t robot) const = 0;
};

class PlaneRobots
{
public:
  // Prepares the model. The references outlive it. AddOwned then gets the entities that the engine moves, in entity
  // order.
  void Init(const CSwarmanoidSpace& space, const PlaneFrame& frame, PlaneGrips& grips);
  void AddOwned(const CSwarmanoidSpaceEntity& entity);

  // Returns true for a channel of this model. Throws std::runtime_error for values that are not finite.
  bool Command(const ChannelBlock& block, std::span<const double> values);
  // Fills in the readings of a channel of this model; leaves those of other channels.
  void Sense(const ChannelBlock& block, std::span<double> values) const;
  // Is called before the plane's motion. First hands and ropes grip and release; then all joints and heights become
  // those at the end of the tick.
  void Advance(double seconds);
  // Returns the velocity (m/s, forward and left) with which the wind carries a flying robot along in this tick, in
  // which it turns by `yaw_rate` (rad/s).
  Vector2 Drift(std::uint32_t entity, double yaw_rate) const;
  // Flying robots that hang on the ceiling, and do not move.
  const std::vector<std::uint32_t>& Attached() const { return attached_; }
  // An entity was put elsewhere from outside. It stands on the plane there, and the space says what it holds and what
  // holds it.
  void Moved(std::uint32_t entity);

  // The engine moves an entity from now on, or another engine does (CPhysicsEngine::TakeOver). `height` (m) is that
  // above the plane.
  void TakeOver(std::uint32_t entity, double height, const EntityVelocity& velocity);
  void HandOver(std::uint32_t entity);

  // Raises poses (EngineUpdate::poses, of `owned`) by the heights of their entities above where they stand.
  void Raise(std::span<const std::uint32_t> owned, std::span<double> poses) const;
  void Report(AttributeChanges& changes) const;

  void SaveState(ByteWriter& state) const;
  void LoadState(ByteReader& state);

private:
  struct Handbot
  {
    std::uint32_t entity = 0;
    double rates[5] = {};  // commands, rad/s: head, arms, wrists
    bool close[2] = {};
    bool has_hands = false;  // a controller commands them
    bool launch = false;
    double winch = 0;  // m/s

    double head = 0, arm[2] = {}, wrist[2] = {}, aperture[2] = {};  // rad
    std::uint32_t held[2] = {};                                     // 1 + entity, 0: none
    bool is_hanging = false;
    double rope = 0;  // m
  };
  // The magnet of a flying robot.
  struct Magnet
  {
    std::uint32_t entity = 0;
    double reach = 0;  // m, above the base of the robot
    bool attach = false;
  };
  // A robot on wheels with links on joints, which touch nothing.
  struct Jointed
  {
    std::uint32_t entity = 0;
    const std::vector<MovingLink>* links = nullptr;
    std::vector<JointCommand> commands{};
    std::vector<double> positions{};  // rad or m
    std::vector<double> speeds{};     // rad/s or m/s, in the last tick
  };
  // An entity that can be in the air.
  struct Lifted
  {
    std::uint32_t entity = 0;
    double height = 0;         // m, above where it stands on the plane
    double fall = 0;           // m/s
    std::uint32_t bearer = 0;  // 1 + the handbot that holds it, 0: none
    double above_bearer = 0;   // m
  };

  Handbot& HandbotOf(std::uint32_t entity);
  Lifted& LiftedOf(std::uint32_t entity);
  bool Hangs(std::uint32_t entity) const;
  void UseHands(Handbot& handbot);
  void Release(Handbot& handbot, std::size_t hand);
  std::uint32_t ObjectAt(const Handbot& handbot, std::size_t hand) const;
  void UseRope(Handbot& handbot, double seconds);
  void TurnJoints(Handbot& handbot, double seconds) const;

  const CSwarmanoidSpace* space_ = nullptr;
  const PlaneFrame* frame_ = nullptr;
  PlaneGrips* grips_ = nullptr;
  std::unique_ptr<Wind> wind_;  // nullptr: calm
  Vector3 up_ = Vector3::UnitZ();
  double ceiling_ = 0;  // m above the plane; 0: none
  std::vector<Handbot> handbots_;
  std::vector<Magnet> magnets_;
  std::vector<Jointed> jointed_;
  std::vector<std::uint32_t> attached_;
  std::vector<Lifted> lifted_;  // handbots, blocks and preys, by entity; none if there is no handbot
  std::vector<std::uint32_t> objects_;
  std::vector<std::uint32_t> elsewhere_;  // of these, those that other engines move, ascending
  mutable NearObjects near_objects_;      // by place in objects_
};

}  // namespace swarmanoid
