// One step of a plane of bodies that move as they are told (first order: velocities, no masses): the state, and the
// stages over it. Each stage is a free function; the file named with it has the derivation.
//
// Whatever decides about the next step is in the saved state or is set again in each tick. The order of all work
// follows from positions and body numbers. So equal states give equal bits, with any number of threads and regions.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "common/threads/worker_pool.h"
#include "engine_worker/engines/kinematics2d/broad_phase.h"
#include "engine_worker/engines/kinematics2d/contact_solver.h"
#include "engine_worker/engines/kinematics2d/gripped_groups.h"
#include "engine_worker/engines/kinematics2d/motion_limiter.h"
#include "engine_worker/engines/kinematics2d/plane_bodies.h"
#include "engine_worker/engines/kinematics2d/verlet_list.h"

namespace swarmanoid::kinematics2d
{

struct WorldStatistics
{
  int substeps = 0;
  std::size_t pairs = 0;  // of the last substep
  std::size_t contacts = 0;
  std::size_t held_back = 0;  // bodies that could not go or turn as far as they would
};

// Where outlines are near each other, and the contacts of a substep.
struct Contacts
{
  // The finds in some of the blocks.
  struct Part
  {
    std::span<const std::uint32_t> blocks;  // a piece of Contacts::blocks
    PairList pairs;
    ContactList contacts;
    ContactList of_groups;  // contacts of bodies that are led by another one
  };

  double elasticity = 1;  // the part of a collision's approach that is given back
  BroadPhase broad;
  VerletList verlet_list;
  bool is_listed = false;               // the Verlet list has the pairs of this substep
  std::vector<std::uint32_t> blocks;    // the blocks that this process computes, ascending
  std::vector<ContactBlock> of_blocks;  // one for each of them
  std::vector<Part> parts;              // PlaneState::PartCount, then one for bodies too large for the cells
  std::vector<ContactBlock> of_large;   // one for each part of the pairs of large bodies
  ContactList shared;                   // contacts of large bodies and of groups: they may reach into many blocks
  // The blocks are sorted by colour; the shared contacts are the last colour.
  std::array<std::vector<ContactBlock>, BroadPhase::kColours + 1> colours;
  ContactSolver solver;

  PairList& PairsOfLarge() { return parts.back().pairs; }
};

// How far leaders may go and turn.
struct Limits
{
  struct Part
  {
    LimitList limits;
    std::vector<std::uint32_t> open;  // numbers of pairs that have not limited a leader
  };

  std::vector<double> way;                // m that a body wants to go in this substep
  std::vector<std::uint8_t> is_involved;  // by leader: it may be limited in this substep
  std::vector<Part> parts;                // as Contacts::parts
  MotionLimiter limiter;
};

// Lengths (m) that hold in all stages of a step.
struct StepLengths
{
  double reach = 0;           // no body gets further than this from where a substep began
  double contact_margin = 0;  // outlines nearer than this are contacts
  double allowed = 0;         // overlap that is left alone
};

struct PlaneState
{
  Bodies bodies;
  Groups groups;
  Contacts contacts;
  Limits limits;
  StepLengths lengths;
  WorldStatistics statistics;

  unsigned threads = 1;
  std::unique_ptr<WorkerPool> own_pool;
  WorkerPool* pool = nullptr;  // nullptr for one thread

  // Is called after all bodies and shapes were added. The threads of `shared_pool` work, or those of a pool of its own.
  void Start(const PlaneGrid& grid, unsigned thread_count, WorkerPool* shared_pool);
  // Ends all grips. Is called after bodies came, went or got other numbers.
  void BodiesChanged();

  WorkerPool* Pool() const { return IfItShares(pool); }
  // Returns the number of parts that threads take one after the other.
  unsigned PartCount() const { return pool == nullptr ? 1 : pool->Parts(); }
  // Each body leads itself and can be pushed.
  bool EachIsFree() const { return groups.grips.empty() && bodies.followers.empty(); }
  // Returns the angle that a leader wants to turn by.
  double TurnOf(std::uint32_t leader, double seconds) const { return groups.Twists(bodies).turn[leader] * seconds; }
  // Calls act(k) for each of the Contacts::parts that has blocks, in all threads.
  template <class Act>
  void ForEachPart(const Act& act)
  {
    if (Pool() == nullptr || contacts.parts[0].blocks.size() == contacts.blocks.size()) return act(0U);
    pool->Run(PartCount(), act);
  }
};

struct Region;
// Moves all bodies by `seconds`, in at least `steps` equal substeps. `region`: nullptr for a plane that is not cut.
// Throws std::runtime_error for speeds that would need too many substeps.
void Advance(PlaneState& plane, double seconds, int steps, Region* region = nullptr);

// The longest way of a tick (m), and the largest way against the limit of its body.
struct LongestWay
{
  double metres = 0;
  double limits = 0;
};

// A tick begins with the twists of groups (FindGroupTwists) and the number of substeps (substeps.cpp).
LongestWay FindLongestWay(const Bodies& bodies, const Groups& groups, double seconds);
int ChooseSubsteps(const LongestWay& way, double seconds, int steps, const Bodies& bodies, StepLengths& lengths);

// The stages of a substep of `seconds`, in order. It ends at a fraction (0 to 1) of the tick.
// 1. Moves all bodies as they are told, wherever others are (move_bodies.cpp).
void MoveBodies(PlaneState& plane, double seconds, double fraction);
// 2. Finds the pairs of bodies in these blocks that can meet (find_contacts.cpp).
void FindNearPairs(PlaneState& plane, std::span<const std::uint32_t> held_blocks);
// 3. Finds where the outlines of these pairs touch.
void FindContacts(PlaneState& plane);
// 4. Lists the contacts by the colour of their blocks. Returns whether any overlap; if not, stage 10 is next.
bool SortContactsByColour(Contacts& contacts);
// 5. ContactSolver::Solve pushes the leaders of contacts apart (contact_solver.cpp).
// 6. Shortens the ways of leaders that were pushed beyond the reach (limit_motions.cpp).
void LimitPushes(PlaneState& plane, double seconds);
// 7. Involves the leaders of bodies that still overlap. Returns whether there are any; if not, stage 10 is next.
bool FindOverlaps(PlaneState& plane);
// 8. Puts planes between involved bodies and their neighbours. AddLimits is called until it involves no more leaders.
void BeginLimits(PlaneState& plane, double seconds);
bool AddLimits(PlaneState& plane, double seconds, bool is_first);
// 9. Does the parts of all motions that these planes allow, and those of other regions if there are any.
void LimitMotions(PlaneState& plane, double seconds, const LimitList* of_others);
// 10. Adds up how each body travelled (move_bodies.cpp).
void MeasureTravel(PlaneState& plane, double seconds);

}  // namespace swarmanoid::kinematics2d
