// A closed 2D world of rigid outlines that move as they are told (first order: velocities, no masses), bounce off each
// other elastically and without friction, and grip preys. Knows nothing of the simulator. Used by the kinematic engine
// in its worker's thread. All lengths in metres, angles in radians, times in seconds.
//
// Everything that decides about the next step is in the saved state or set anew each tick; the order of all work
// follows from positions and body numbers, so that equal states give equal bits.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/serialisation/bytes.h"
#include "engine_worker/engines/kinematics2d/broad_phase.h"
#include "engine_worker/engines/kinematics2d/collision_model.h"
#include "engine_worker/engines/kinematics2d/contact_solver.h"
#include "engine_worker/engines/kinematics2d/motion.h"

namespace swarmanoid::kinematics2d
{

// A body held by another one: they move as one rigid whole.
struct Grip
{
  std::uint32_t body = 0;  // the one that grips
  std::uint32_t prey = 0;
  Pose2 relative;  // of the body in the frame of the prey
};

struct WorldStatistics
{
  int substeps = 0;
  std::size_t pairs = 0;  // of the last substep
  std::size_t contacts = 0;
  std::size_t held_back = 0;  // bodies that could not go where they would
};

class KinematicWorld
{
public:
  // 1 gives a collision's whole approach back, 0 none of it.
  explicit KinematicWorld(double elasticity = 1) : elasticity_(elasticity) {}

  // Building: models, then bodies (numbered from 0) and static shapes, then Start.
  std::uint32_t AddModel(CollisionModel model);
  // A model of followers only; it must stay within the circle that the first one filled.
  void ReplaceModel(std::uint32_t model, CollisionModel outline);
  // A follower is moved from outside (Follow) and pushes without being pushed.
  std::uint32_t AddBody(std::uint32_t model, const Pose2& pose, bool follower = false);
  void AddStatic(CollisionModel shape);  // in the coordinates of the plane
  // `area` is where most bodies will be. `threads` work together; their number changes no bit of the results.
  void Start(Bounds area, unsigned threads = 1);

  // Each tick: what the bodies do until they are told otherwise.
  void SetTwist(std::uint32_t body, const Twist& twist) { twists_.Set(body, twist); }
  // The turret turns against the body at this rate (rad/s); while its body grips, it is locked.
  void SetTurretRate(std::uint32_t body, double rate);
  // Bodies that are not present touch nothing. All are at first.
  void SetPresent(std::uint32_t body, bool present) { present_[body] = present ? 1 : 0; }
  // Where a follower will be at the end of the next Advance; `present` tells whether it is in the plane at all.
  void Follow(std::uint32_t body, const Pose2& pose, bool present);
  // Puts a body elsewhere at once. Its grips stay: those whom it grips, and who grip it, are to be put there with it.
  void Place(std::uint32_t body, const Pose2& pose) { now_.Set(body, pose); }
  // Moves everything by `seconds`, in at least `steps` equal steps. Fast bodies make it use more, so that nothing
  // passes through anything. Throws std::runtime_error for speeds beyond all sense.
  void Advance(double seconds, int steps);

  // The prey must be a free body or the prey of other grips, the body must not be gripping or gripped.
  void AddGrip(std::uint32_t body, std::uint32_t prey);
  void RemoveGrip(std::uint32_t body);
  // Ends the grips for which `ends(grip)` is true.
  template <class Ends>
  void RemoveGripsIf(const Ends& ends)
  {
    if (std::erase_if(grips_, ends) > 0) RebuildGroups();
  }
  void SetTurretAngle(std::uint32_t body, double angle);
  const Grip* FindGrip(std::uint32_t body) const;
  const std::vector<Grip>& Grips() const { return grips_; }

  std::size_t BodyCount() const { return count_; }
  const PoseStore& Poses() const { return now_; }
  Twist TwistOf(std::uint32_t body) const { return twists_.Get(body); }
  Pose2 PoseOf(std::uint32_t body) const { return now_.Get(body); }
  double TurretAngle(std::uint32_t body) const { return turret_angle_[body]; }
  const CollisionModel& ModelOf(std::uint32_t body) const { return models_[model_[body]]; }
  Placed PlacedAt(std::uint32_t body) const { return PlaceAt(body, now_); }
  // The deepest overlap of two bodies, or of a body and the static shapes.
  double OverlapOf(std::uint32_t a, std::uint32_t b) const;
  double StaticOverlapOf(std::uint32_t body) const;
  // The arc that the body's centre drove forward (m) and its turn (rad) in the last Advance, collisions included.
  // Only kept after KeepTravel().
  void KeepTravel() { keeps_travel_ = true; }
  double TravelForward(std::uint32_t body) const { return travel_forward_[body]; }
  double TravelTurn(std::uint32_t body) const { return travel_turn_[body]; }
  const WorldStatistics& Statistics() const { return statistics_; }

  // Poses, turrets and grips; twists and followers' goals are commands and not part of it.
  void SaveState(ByteWriter& state) const;
  void LoadState(ByteReader& state);

private:
  enum class Hold : std::uint8_t
  {
    kFree,
    kPosition,  // back where the step began, turned as commanded
    kPose       // all as it was when the step began
  };

  struct Turret
  {
    std::uint32_t body;
    double rate;
    double before;  // angle when the substep began
  };
  struct Follower
  {
    std::uint32_t body;
    Pose2 from, goal;
  };

  Placed PlaceAt(std::uint32_t body, const PoseStore& poses) const
  {
    const Rotor heading{poses.z[body], poses.w[body]};
    return {poses.x[body],     poses.y[body],     CosOf(heading),        SinOf(heading),
            turret_cos_[body], turret_sin_[body], &models_[model_[body]]};
  }
  // To where the body is now; its heading and turret are as they were when the substep's motion ended.
  void MovePlaced(std::uint32_t body)
  {
    placed_[body].x = now_.x[body];
    placed_[body].y = now_.y[body];
  }
  std::uint32_t NumberOf(const Placed& placed) const { return static_cast<std::uint32_t>(&placed - placed_.data()); }
  Placed PlaceBefore(std::uint32_t body) const;
  // Each body leads itself and can be pushed.
  bool EveryoneIsFree() const { return grips_.empty() && followers_.empty(); }
  bool IsFollower(std::uint32_t body) const { return follower_[body] != 0; }
  void RebuildGroups();
  Twist GroupTwist(std::span<const Grip> members) const;
  std::vector<Turret>::iterator FindTurret(std::uint32_t body);

  int Substeps(double seconds, int steps);
  void Substep(double seconds, double fraction);
  void Move(double seconds, double fraction);
  void FindContacts(double margin);
  void FindContacts(double margin, std::size_t begin, std::size_t end, ContactList& contacts) const;
  void FindStaticContacts(double margin, ContactList& contacts) const;
  void AddContacts(PairBatch& batch, double margin, ContactList& contacts) const;
  void HoldBack();
  bool MustNotOverlap(double overlap, double before) const;
  void Enqueue(std::uint32_t leader);
  void ListNearThosePushedFar();
  void EnqueueThosePushedFar();
  template <class Act>
  void ForEachNear(std::uint32_t body, const Act& act) const;
  bool CirclesMeet(std::uint32_t a, std::uint32_t b) const;
  void HoldFromOthers(std::uint32_t body);
  void HoldPair(std::uint32_t a, std::uint32_t b);
  void HoldFromStatic(std::uint32_t body, std::uint32_t shape);
  void RaiseHold(std::uint32_t leader);
  void KeepTravelOf(double seconds, std::size_t begin, std::size_t end);

  double elasticity_;
  std::vector<CollisionModel> models_;
  std::vector<CollisionModel> statics_;
  std::size_t count_ = 0;

  // Of each body.
  PoseStore now_, before_;  // before_: where the substep began
  // Where the substep's motion ended, before collisions; behind the bodies, the static shapes.
  std::vector<Placed> placed_;
  TwistStore twists_;
  TwistStore effective_;  // twists_ with those of groups filled in; used while there are groups
  std::vector<std::uint32_t> model_;
  std::vector<std::uint8_t> follower_, present_;
  std::vector<double> turret_angle_, turret_cos_, turret_sin_;
  std::vector<double> core_limit_, inverse_limit_;  // metres that a body may go in one substep
  std::vector<double> radius_;                      // of the circle around it
  std::vector<double> travel_forward_, travel_turn_;
  bool keeps_travel_ = false;

  // A body of its own leads itself, one that grips is led by its prey. One more entry than bodies: the static world.
  std::vector<std::uint32_t> leader_;
  std::vector<double> mobility_;
  std::vector<Grip> grips_;                 // by prey, then body
  std::vector<std::uint32_t> group_start_;  // of each group in grips_, and the end

  std::vector<Turret> turrets_;      // those that turn, by body
  std::vector<Follower> followers_;  // by body

  std::unique_ptr<WorkerPool> pool_;             // none for one thread
  std::vector<ContactList> contacts_of_others_;  // found by each further thread
  BroadPhase broad_;
  ContactSolver solver_;
  double reach_ = 0;    // no collision pushes a body further than this in one substep
  double allowed_ = 0;  // overlap that is left alone
  double smallest_limit_ = 0;
  std::vector<Hold> hold_;
  std::vector<std::uint32_t> held_;
  std::vector<std::uint8_t> is_queued_;  // leaders that may overlap others
  std::vector<std::uint32_t> queue_;     // a queue
  std::vector<std::uint32_t> far_;       // bodies pushed far
  std::vector<Pair> near_;               // of them and others
  WorldStatistics statistics_;
};

}  // namespace swarmanoid::kinematics2d
