// A closed 2D world of rigid outlines that move as they are told (first order: velocities, no masses), bounce off each
// other elastically and without friction, and grip preys. Knows nothing of the simulator. Used by the kinematic engine
// in its worker's thread. All lengths in metres, angles in radians, times in seconds.
//
// Everything that decides about the next step is in the saved state or set anew each tick; the order of all work
// follows from positions and body numbers, so that equal states give equal bits.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/math/zeroed_vector.h"
#include "common/messages/regions.h"
#include "common/serialisation/bytes.h"
#include "engine_worker/engines/kinematics2d/broad_phase.h"
#include "engine_worker/engines/kinematics2d/collision_model.h"
#include "engine_worker/engines/kinematics2d/contact_solver.h"
#include "engine_worker/engines/kinematics2d/motion.h"
#include "engine_worker/engines/kinematics2d/motion_limiter.h"
#include "engine_worker/engines/kinematics2d/verlet_list.h"

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
  std::size_t held_back = 0;  // bodies that could not go or turn as far as they would
};

class KinematicWorld
{
public:
  // 1 gives a collision's whole approach back, 0 none of it.
  explicit KinematicWorld(double elasticity = 1);
  ~KinematicWorld();
  KinematicWorld(KinematicWorld&&) noexcept;
  KinematicWorld& operator=(KinematicWorld&&) noexcept;

  // Building: models, then bodies (numbered from 0) and static shapes, then Start.
  std::uint32_t AddModel(CollisionModel model);
  // A model of followers only; it must stay within the circle that the first one filled.
  void ReplaceModel(std::uint32_t model, CollisionModel outline);
  // A follower is moved from outside (Follow) and pushes without being pushed.
  std::uint32_t AddBody(std::uint32_t model, const Pose2& pose, bool follower = false);
  void AddStatic(CollisionModel shape);  // in the coordinates of the plane
  // `area` is where most bodies will be. `threads` work together, those of `pool` if there is one; their number changes
  // no bit of the results.
  void Start(Bounds area, unsigned threads = 1, WorkerPool* pool = nullptr);

  // Each tick: what the bodies do until they are told otherwise.
  void SetTwist(std::uint32_t body, const Twist& twist) { twists_.Set(body, twist); }
  // The turret turns against the body at this rate (rad/s); while its body grips, it is locked.
  void SetTurretRate(std::uint32_t body, double rate);
  // Bodies that are not present touch nothing. All are at first.
  void SetPresent(std::uint32_t body, bool present);
  // Where a follower will be at the end of the next Advance; `present` tells whether it is in the plane at all.
  void Follow(std::uint32_t body, const Pose2& pose, bool present);
  // Puts a body elsewhere at once. Its grips stay: those whom it grips, and who grip it, are to be put there with it.
  void Place(std::uint32_t body, const Pose2& pose);
  // Moves everything by `seconds`, in at least `steps` equal steps. Fast bodies make it use more, so that nothing
  // passes through anything. No two parts of outlines overlap deeper afterwards than allowed_, or than they did
  // before, but for followers: these may come into a body that has no room to give way.
  // Throws std::runtime_error for speeds beyond all sense.
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
  double OverlapForTest(std::uint32_t a, std::uint32_t b) const;
  double StaticOverlapForTest(std::uint32_t body) const;
  // The arc that the body's centre drove forward (m) and its turn (rad) in the last Advance, collisions included.
  // Only kept after KeepTravel().
  void KeepTravel() { keeps_travel_ = true; }
  double TravelForward(std::uint32_t body) const { return travel_forward_[body]; }
  double TravelTurn(std::uint32_t body) const { return travel_turn_[body]; }
  const WorldStatistics& Statistics() const { return statistics_; }
  double AllowedOverlapForTest() const { return allowed_; }

  // After Start: from now on the regions of the team do what Advance is to do. Each computes some blocks of the plane
  // (MoveCuts; at first region 0 has all), and all bodies go bit by bit as before, wherever the cuts are. `team`
  // outlives the world.
  void Divide(RegionTeam& team);
  // Blocks of cells, row by row: what a plane can be cut along.
  std::uint32_t BlockColumns() const { return broad_.BlockColumns(); }
  std::uint32_t BlockCount() const { return broad_.BlockCount(); }
  // How many bodies are in each of them.
  std::vector<std::uint32_t> BodiesInBlocks() const;
  // region_of_block[k] has block k, from the next Advance on. Throws std::runtime_error for what is no cut.
  void MoveCuts(std::span<const std::uint8_t> region_of_block);

  // Poses, turrets and grips; twists and followers' goals are commands and not part of it.
  void SaveState(ByteWriter& state) const;
  void LoadState(ByteReader& state);

private:
  friend class PlaneRegion;
  class Region;
  class Division;

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
    Pose2 before;  // where the substep began, or where it ended: see SwapFollowers
  };
  // What one thread finds in some of the blocks.
  struct Part
  {
    std::span<const std::uint32_t> blocks;  // a piece of blocks_
    PairList pairs;
    ContactList contacts;
    ContactList of_groups;  // contacts of bodies that are led by another one
    LimitList limits;
    std::vector<std::uint32_t> open;  // numbers of pairs that limit nobody so far
  };
  // A part of an outline where the substep began, and what its leader wants to do.
  struct Side
  {
    const Placed* start = nullptr;
    std::size_t part = 0;
    double x = 0, y = 0;                // of the body
    double centre_x = 0, centre_y = 0;  // of the part
    double cos = 1, sin = 0;
    std::uint32_t leader = 0;
    bool can_move = false;
    double way_x = 0, way_y = 0;
    double turn = 0;
    double from_x = 0, from_y = 0;              // to the body, from the leader, which is the axis
    double centre_way_x = 0, centre_way_y = 0;  // by which turning moves the part's centre, about

    // nullptr if the part is a circle.
    const Polygon* OwnPolygon() const
    {
      const auto circles = static_cast<std::size_t>(start->model->circles);
      return part < circles ? nullptr : &start->model->polygons[part - circles];
    }
  };
  // Of a part, along a direction.
  struct Extent
  {
    double at_start;
    double turn_rate;
  };
  struct Plane
  {
    double gap;   // and the overlap that is allowed
    double left;  // of it after all motions
    std::array<Approach, 4> approaches;
  };
  // Pairs that can meet, where the substep began.
  struct NearPairs
  {
    PairBatch batch;
    std::array<Pair, kDoubleLanes> pairs;
    std::array<Placed, kDoubleLanes> first, second;
    std::array<double, kDoubleLanes> margins;

    void Add(const Pair& pair, const Placed& a, const Placed& b)
    {
      const std::size_t lane = batch.Count();
      pairs[lane] = pair;
      first[lane] = a;
      second[lane] = b;
      batch.Add(first[lane], second[lane]);
    }
  };

  Placed PlaceAt(std::uint32_t body, const PoseStore& poses) const
  {
    const Rotor heading{poses.z[body], poses.w[body]};
    return {poses.x[body],   poses.y[body],     CosOf(heading),        SinOf(heading),
            TurretCos(body), turret_sin_[body], &models_[model_[body]]};
  }
  std::uint32_t NumberOf(const Placed& placed) const { return static_cast<std::uint32_t>(&placed - placed_.data()); }
  Placed PlaceBefore(std::uint32_t body) const
  {
    const Rotor heading{before_.z[body], before_.w[body]};
    return {before_.x[body],
            before_.y[body],
            CosOf(heading),
            SinOf(heading),
            turret_cos_before_.empty() ? 1 : turret_cos_before_[body],
            turret_sin_before_[body],
            &models_[model_[body]]};
  }
  double TurretCos(std::uint32_t body) const { return turret_cos_.empty() ? 1 : turret_cos_[body]; }
  double RadiusOf(std::uint32_t body) const { return models_[model_[body]].bounding_radius; }
  // Each body leads itself and can be pushed.
  bool EveryoneIsFree() const { return grips_.empty() && followers_.empty(); }
  // Of a body, or of static shapes.
  std::uint32_t LeaderOf(std::uint32_t body) const
  {
    return leader_[std::min(body, static_cast<std::uint32_t>(count_))];
  }
  bool IsFollower(std::uint32_t body) const { return follower_[body] != 0; }
  double CoreLimitOf(const CollisionModel& model) const;
  void MakeRoom(const PlaneGrid& grid, unsigned threads, WorkerPool* pool);
  void RebuildGroups();
  void FindEffectiveTwists();
  Twist GroupTwist(std::span<const Grip> members) const;
  std::vector<Turret>::iterator FindTurret(std::uint32_t body);

  int Substeps(double seconds, int steps);
  void Substep(double seconds, double fraction);
  void Move(double seconds, double fraction);
  void SwapFollowers();
  WorkerPool* Pool() const { return IfItShares(pool_); }
  // Calls act(part) with all that have blocks, each in a thread of its own.
  template <class Act>
  void ForEachPart(const Act& act)
  {
    if (Pool() == nullptr || parts_[0].blocks.size() == blocks_.size()) return act(parts_[0]);
    pool_->Run([&](unsigned k) { act(parts_[k]); });
  }
  void FindContacts();
  void FindContacts(const PairList& pairs, ContactBlock* blocks, ContactList& contacts, ContactList& of_groups) const;
  void AddContacts(PairBatch& batch, ContactList& contacts, ContactList& of_groups) const;
  bool ListContactsByColour();
  std::span<const Grip> GroupOf(std::uint32_t prey) const;
  void LimitMotions(double seconds);
  void LimitPushes();
  void LimitPushesOfGroups(double seconds);
  void LimitWay(std::uint32_t leader, double most);
  double ArcOf(const Grip& grip, double seconds) const;
  void FindWays(std::size_t begin, std::size_t end);
  void Involve(std::uint32_t leader, std::atomic<bool>& more);
  bool IsInvolved(std::uint32_t leader);
  void FindOverlaps(std::span<const Pair> pairs, std::atomic<bool>& more);
  bool CirclesMeet(std::uint32_t a, std::uint32_t b) const;
  void FindLimits(std::span<const Pair> pairs, bool first, std::vector<std::uint32_t>& open, double seconds,
                  LimitList& limits, std::atomic<bool>& more);
  void AddLimits(NearPairs& near, double seconds, LimitList& limits, std::atomic<bool>& more);
  bool CanMeet(std::uint32_t a, std::uint32_t b) const;
  // What a leader wants to turn by in this substep.
  double TurnOf(std::uint32_t leader, double seconds) const
  {
    return (grips_.empty() ? twists_ : effective_).turn[leader] * seconds;
  }
  double OutlineWay(std::uint32_t body, double seconds) const;
  Side SideOf(std::uint32_t body, const Placed& start, std::size_t part, double seconds) const;
  Plane BestPlane(const Side& first, const Side& second, double x, double y, const Plane& shortest) const;
  Plane PlaneAlong(const Side& first, const Side& second, double x, double y) const;
  static Extent ExtentAlong(const Side& side, double x, double y);
  void MoveInPart(std::uint32_t leader, double seconds);
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
  ZeroedVector<double> turret_angle_, turret_sin_;
  ZeroedVector<double> turret_sin_before_;              // when the substep began
  std::vector<double> turret_cos_, turret_cos_before_;  // none while no turret was ever turned: all are 1
  ZeroedVector<double> turret_way_;                     // rad in this substep
  std::vector<double> way_;                             // metres that a body wants to go in this substep
  std::vector<double> inverse_limit_;                   // 1 / metres that a body may go in one substep
  ZeroedVector<double> travel_forward_, travel_turn_;
  bool keeps_travel_ = false;

  // A body of its own leads itself, one that grips is led by its prey. One more entry than bodies: the static world.
  std::vector<std::uint32_t> leader_;
  std::vector<double> mobility_;
  std::vector<Grip> grips_;                 // by prey, then body
  std::vector<std::uint32_t> group_start_;  // of each group in grips_, and the end

  std::vector<Turret> turrets_;      // those that turn, by body
  std::vector<Follower> followers_;  // by body

  std::unique_ptr<WorkerPool> own_pool_;
  WorkerPool* pool_ = nullptr;  // none for one thread
  std::vector<Part> parts_;     // one for each thread
  BroadPhase broad_;
  VerletList verlet_list_;
  std::vector<std::uint32_t> blocks_;  // those of this region, ascending
  PairList pairs_of_large_;
  std::vector<ContactBlock> block_contacts_;  // of each of them
  ContactList shared_contacts_;               // of large bodies and of groups: they may reach into many blocks
  // The last one is that of the shared contacts.
  std::array<std::vector<ContactBlock>, BroadPhase::kColours + 1> colours_;
  ContactSolver solver_;
  MotionLimiter limiter_;
  std::vector<std::uint8_t> is_involved_;        // of each leader: it may be limited in this substep
  std::vector<ContactBlock> contacts_of_large_;  // of each part of pairs_of_large_
  LimitList limits_of_large_;
  std::vector<std::uint32_t> open_of_large_;
  double reach_ = 0;           // nobody gets further than this from where a substep began
  double contact_margin_ = 0;  // outlines nearer than this are contacts
  double allowed_ = 0;         // overlap that is left alone
  double smallest_limit_ = 0;
  double median_core_ = 0;
  WorldStatistics statistics_;
  std::unique_ptr<Division> division_;  // none if the world does it all by itself
  std::unique_ptr<Region> region_;      // none for the whole world
};

// One of the regions of a plane that is divided. It knows nothing before the first task, which tells it all. It holds
// the bodies in its blocks and in the cells around them, at most `halo` cells away, with numbers of its own; followers,
// members of groups and bodies that are too large for the cells it holds wherever they are. One cell of halo is enough,
// but then who holds whom is found in each substep.
class PlaneRegion final : public EngineRegion
{
public:
  static constexpr unsigned kHalo = 2;
  // It speaks to the others by `exchange`, which outlives it. Throws std::runtime_error if there is no such region.
  PlaneRegion(unsigned region, RegionExchange& exchange, unsigned halo = kHalo);
  ~PlaneRegion() override;
  // Throws std::runtime_error for what is no task.
  void Work(std::span<const char> task, ByteWriter& result) override;
  // How many bodies it holds.
  std::size_t BodyCount() const;

private:
  const unsigned number_;
  RegionExchange& exchange_;
  const unsigned halo_;
  std::vector<char> plan_;  // as far as it is told
  std::unique_ptr<KinematicWorld> world_;
};

}  // namespace swarmanoid::kinematics2d
