// Problem: step a world so that equal states give equal next states, in piles as well as in sparse swarms.
//
// Method: pairs are sorted by the numbers of their solids. Assemblies that touch or hold each other form islands.
// Islands with objects, mechanisms or spinning wheels are delicate: they are solved one by one with more iterations.
// Everything else is solved at once with few. An object that stayed in place for long enough sleeps if all of its
// island do, and wakes when something that is awake touches it.
//
// Invariants: contacts are in the order of pairs in each call of the solver. The order of constraints follows from the
// number of the step. Source: docs/engines.md, "Model" of `dynamics3d`.
#include "engine_worker/engines/dynamics3d/solver_world.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine_worker/engines/dynamics3d/shuffle.h"

namespace swarmanoid::dynamics3d
{
namespace
{

// ODE shuffles the constraints from the eighth iteration on.
constexpr int kOrderedIterations = 8;
// An object that stays within these bounds for that long is at rest.
constexpr double kRestWay = 4e-3;   // m
constexpr double kRestTurn = 0.03;  // rad
constexpr double kRestTime = 0.5;   // s

bool IsNear(const RawPose& a, const RawPose& b)
{
  double square = 0;
  for (int k = 0; k < 3; ++k) square += (a.position[k] - b.position[k]) * (a.position[k] - b.position[k]);
  double cosine = 0;  // of half the turn
  for (int k = 0; k < 4; ++k) cosine += a.quaternion[k] * b.quaternion[k];
  return square <= kRestWay * kRestWay && std::abs(cosine) >= 1 - kRestTurn * kRestTurn / 8;
}

// The seed depends on the step alone, so that equal islands get equal results wherever they are and whatever else
// exists.
std::uint32_t SeedOf(std::uint64_t step)
{
  std::uint64_t x = step * 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return static_cast<std::uint32_t>(x ^ (x >> 31));
}

}  // namespace

SolverWorld::SolverWorld(OdeWorld& all, std::uint32_t number) : all_(all), settings_(all.Settings()), number_(number)
{
  InitialiseOde();
  world_ = dWorldCreate();
  const Vector3& gravity = settings_.gravity;
  dWorldSetGravity(world_, gravity.x(), gravity.y(), gravity.z());
  // Over-relaxation is off. At few iterations it favours the rows that are solved last, and a resting robot creeps 16
  // mm/s sideways instead of 4 um/s.
  dWorldSetQuickStepW(world_, 1.0);
  dWorldSetERP(world_, 0.2);
  dWorldSetCFM(world_, 1e-7);
  dWorldSetContactMaxCorrectingVel(world_, 1.0);
  dWorldSetContactSurfaceLayer(world_, 1e-4);
  dWorldSetAutoDisableFlag(world_, 0);  // its averages would be state that a checkpoint does not hold
  dWorldSetStepIslandsProcessingMaxThreadCount(world_, 1);
  // The default threading is shared by all worlds of the process and fails when two of them step at the same time.
  threading_ = dThreadingAllocateSelfThreadedImplementation();
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threading_), threading_);
  contact_joints_ = dJointGroupCreate(0);
}

SolverWorld::~SolverWorld()
{
  for (const auto& [solid, geom] : copies_) dGeomDestroy(geom);
  dJointGroupDestroy(contact_joints_);
  dWorldDestroy(world_);
  dThreadingFreeImplementation(threading_);
}

void SolverWorld::SetMembers(std::vector<std::uint32_t> members)
{
  members_ = std::move(members);
  bodies_.clear();
  has_objects_ = has_mechanisms_ = false;
  for (std::uint32_t position = 0; position < members_.size(); ++position)
  {
    Assembly& assembly = all_.AssemblyAt(members_[position]);
    assembly.position = position;
    for (int body = assembly.first_body; body < assembly.end_body; ++body)
    {
      bodies_.push_back(body);
      has_objects_ = has_objects_ || IsObject(body);
      has_mechanisms_ = has_mechanisms_ || IsMechanism(body);
    }
  }
}

void SolverWorld::ForgetNear()
{
  near_.clear();
  near_statics_.clear();
  held_.clear();
}

dGeomID SolverWorld::GeomOf(const Solid& solid)
{
  if (!solid.make_copy) return solid.geom;
  for (const auto& [original, geom] : copies_)
    if (original == &solid) return geom;
  copies_.emplace_back(&solid, solid.make_copy());
  return copies_.back().second;
}

std::uint32_t SolverWorld::PositionOfEntity(std::uint32_t entity) const
{
  return all_.AssemblyAt(all_.AssemblyOfEntity(entity)).position;
}

bool SolverWorld::IsAwake(const Solid& solid) const { return solid.body >= 0 && !RecordOf(solid.body).rest.asleep; }

bool SolverWorld::IsIgnored(std::uint32_t a, std::uint32_t b) const
{
  return std::ranges::find(held_, std::pair(std::min(a, b), std::max(a, b))) != held_.end();
}

// Returns whether the solver can move a body.
bool SolverWorld::HasToStep() const
{
  bool is_any_awake = false, is_any_moved = false;
  for (const int body : bodies_)
  {
    const BodyRecord& record = RecordOf(body);
    if (record.is_left_out) continue;
    is_any_awake = is_any_awake || !record.rest.asleep;
    is_any_moved = is_any_moved || record.owner.kind != EBody::kMirror;
  }
  return is_any_awake && is_any_moved;
}

// Calls act(a, b) for all solids that may touch, if the boxes around their assemblies overlap.
template <class Act>
void SolverWorld::ForEachNear(const Act& act)
{
  const auto visit = [&](const Solid& a, const Solid& b)
  {
    if (CanMeet(a.layer, b.layer) && !IsIgnored(a.entity, b.entity)) act(a, b);
  };
  const auto visit_all = [&](const Assembly& assembly, const Solid& other)
  {
    for (std::uint32_t k = assembly.first_solid; k < assembly.end_solid; ++k) visit(SolidAt(k), other);
  };
  for (const NearAssemblies& near : near_)
  {
    const Assembly& first = all_.AssemblyAt(near.first);
    const Assembly& second = all_.AssemblyAt(near.second);
    if (all_.IsLeftOut(first) || all_.IsLeftOut(second)) continue;
    if (!Overlap(boxes_[first.position], boxes_[second.position])) continue;
    for (std::uint32_t k = second.first_solid; k < second.end_solid; ++k) visit_all(first, SolidAt(k));
  }
  for (const NearStatic& near : near_statics_)
    if (const Assembly& assembly = all_.AssemblyAt(near.assembly);
        !all_.IsLeftOut(assembly) && Overlap(boxes_[assembly.position], near.solid->box))
      visit_all(assembly, *near.solid);
  for (const Solid* const ground : all_.Grounds())
  {
    for (const std::uint32_t member : members_)
      if (const Assembly& assembly = all_.AssemblyAt(member);
          !all_.IsLeftOut(assembly) && Overlap(boxes_[assembly.position], ground->box))
        visit_all(assembly, *ground);
  }
}

void SolverWorld::CollectPairs()
{
  pairs_.clear();
  boxes_.resize(members_.size());
  for (const std::uint32_t member : members_)
    if (const Assembly& assembly = all_.AssemblyAt(member); !all_.IsLeftOut(assembly))
      boxes_[assembly.position] = all_.BoxOf(assembly.first_body);
  ForEachNear(
      [&](const Solid& a, const Solid& b)
      {
        if (Overlap(BoxOf(a), BoxOf(b)))
          pairs_.push_back({std::min(a.number, b.number), std::max(a.number, b.number), false});
      });
  std::sort(pairs_.begin(), pairs_.end(),
            [](const Pair& x, const Pair& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
}

void SolverWorld::Step(double seconds, std::uint64_t number)
{
  InitialiseOde();
  step_seconds_ = seconds;
  contacts_.clear();
  if (!HasToStep()) return;
  CollectPairs();
  FindContacts();
  FindDelicateIslands();
  SolveOthers(seconds, number);
  SolveDelicateIslands(seconds, number);
  RestObjects(seconds);
}

// A sleeping object has contacts only with bodies that are awake, and such a contact wakes it.
void SolverWorld::FindContacts()
{
  contacts_.clear();
  for (const auto& [low, high] : held_)
    for (const std::uint32_t entity : {low, high}) all_.Wake(all_.AssemblyAt(all_.AssemblyOfEntity(entity)).first_body);
  bool woken = false;
  bool again = false;
  do {
    woken = false;
    for (std::uint32_t k = 0; k < pairs_.size(); ++k)
    {
      Pair& pair = pairs_[k];
      const Solid& a = SolidAt(pair.a);
      const Solid& b = SolidAt(pair.b);
      if (pair.done || !(IsAwake(a) || IsAwake(b))) continue;
      pair.done = true;
      const std::size_t before = contacts_.size();
      MakeContacts(a, b, k);
      if (contacts_.size() == before) continue;
      for (const int body : {a.body, b.body}) woken |= body >= 0 && all_.Wake(body);
    }
    again = again || woken;
  } while (woken);
  if (again)
    std::stable_sort(contacts_.begin(), contacts_.end(),
                     [](const Contact& x, const Contact& y) { return x.pair < y.pair; });
}

// Iterations that are shuffled depend on all that is solved at once, so that all islands are delicate then.
void SolverWorld::FindDelicateIslands()
{
  island_bodies_.clear();
  island_contacts_.clear();
  const bool are_all_shuffled = settings_.iterations > kOrderedIterations;
  const bool has_spinning = std::any_of(contacts_.begin(), contacts_.end(), std::mem_fn(&Contact::is_spinning));
  if (!has_objects_ && !has_mechanisms_ && !has_spinning && !are_all_shuffled) return;
  islands_.Reset(members_.size());
  for (const Contact& contact : contacts_)
    if (contact.body_a >= 0 && contact.body_b >= 0)
      islands_.Join(PositionOf(contact.body_a), PositionOf(contact.body_b));
  for (const auto& [low, high] : held_) islands_.Join(PositionOfEntity(low), PositionOfEntity(high));
  const auto island_of = [&](int body) { return islands_.Of(PositionOf(body)); };
  const auto island_of_contact = [&](const Contact& contact)
  { return island_of(contact.body_a >= 0 ? contact.body_a : contact.body_b); };

  is_delicate_.assign(members_.size(), are_all_shuffled);
  const auto mark = [&](int body)
  {
    if (body >= 0 && IsObject(body)) is_delicate_[island_of(body)] = true;
  };
  for (const Contact& contact : contacts_)
  {
    mark(contact.body_a);
    mark(contact.body_b);
    if (contact.is_spinning) is_delicate_[island_of_contact(contact)] = true;
  }
  for (const auto& [low, high] : held_)
    for (const std::uint32_t entity : {low, high}) mark(all_.AssemblyAt(all_.AssemblyOfEntity(entity)).first_body);
  for (const int body : bodies_)
    if (IsMechanism(body)) is_delicate_[island_of(body)] = true;
  if (std::find(is_delicate_.begin(), is_delicate_.end(), true) == is_delicate_.end()) return;

  for (const int body : bodies_)
    if (const std::uint32_t island = island_of(body); is_delicate_[island] && !RecordOf(body).is_left_out)
      island_bodies_.push_back({island, static_cast<std::uint32_t>(body)});
  for (std::uint32_t k = 0; k < contacts_.size(); ++k)
    if (const std::uint32_t island = island_of_contact(contacts_[k]); is_delicate_[island])
      island_contacts_.push_back({island, k});
  const auto by_island = [](const IslandMember& x, const IslandMember& y)
  { return x.island != y.island ? x.island < y.island : x.number < y.number; };
  std::sort(island_bodies_.begin(), island_bodies_.end(), by_island);
  std::sort(island_contacts_.begin(), island_contacts_.end(), by_island);
}

void SolverWorld::Attach(const Contact& contact)
{
  const auto body = [&](int number) { return number < 0 ? nullptr : all_.Body(number); };
  dJointAttach(dJointCreateContact(world_, contact_joints_, &contact.joint), body(contact.body_a),
               body(contact.body_b));
}

void SolverWorld::Solve(double seconds, int iterations, std::uint64_t number)
{
  dWorldSetQuickStepNumIterations(world_, iterations);
  if (iterations > kOrderedIterations) SeedShuffle(SeedOf(number));
  dWorldQuickStep(world_, seconds);
  dJointGroupEmpty(contact_joints_);
}

// Solves all that is in no delicate island.
void SolverWorld::SolveOthers(double seconds, std::uint64_t number)
{
  const auto present = std::ranges::count_if(bodies_, [&](int body) { return !RecordOf(body).is_left_out; });
  if (static_cast<std::size_t>(present) == island_bodies_.size()) return;
  for (const IslandMember& member : island_bodies_) dBodyDisable(all_.Body(static_cast<int>(member.number)));
  is_in_island_.assign(contacts_.size(), false);
  for (const IslandMember& member : island_contacts_) is_in_island_[member.number] = true;
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    if (!is_in_island_[k]) Attach(contacts_[k]);
  Solve(seconds, settings_.iterations, number);
}

// In a pile, support travels up by one object in an iteration, so tall piles get more iterations. So do robots with
// joints: a handbot counts as twelve objects, or it would creep.
int SolverWorld::DelicateIterations(int objects) const
{
  return settings_.object_iterations * std::min(20 + objects, 80) / 20;
}

// Each island is solved by itself, so that its result depends on no other one.
void SolverWorld::SolveDelicateIslands(double seconds, std::uint64_t number)
{
  if (island_bodies_.empty()) return;
  for (const int body : bodies_) dBodyDisable(all_.Body(body));
  auto contact = island_contacts_.begin();
  for (auto first = island_bodies_.begin(); first != island_bodies_.end();)
  {
    const auto last = std::find_if(first, island_bodies_.end(),
                                   [&](const IslandMember& member) { return member.island != first->island; });
    int objects = 0;
    for (auto member = first; member != last; ++member)
    {
      const int body = static_cast<int>(member->number);
      dBodyEnable(all_.Body(body));
      objects += IsObject(body) ? 1 : IsMechanism(body) ? 3 : 0;
    }
    for (; contact != island_contacts_.end() && contact->island == first->island; ++contact)
      Attach(contacts_[contact->number]);
    Solve(seconds, std::max(settings_.iterations, DelicateIterations(objects)), number);
    for (auto member = first; member != last; ++member) dBodyDisable(all_.Body(static_cast<int>(member->number)));
    first = last;
  }
  for (const int body : bodies_)
    if (const BodyRecord& record = RecordOf(body); !record.rest.asleep && !record.is_left_out) dBodyEnable(record.body);
}

void SolverWorld::RestObjects(double seconds)
{
  if (!has_objects_) return;
  const auto long_enough = static_cast<std::uint32_t>(std::ceil(kRestTime / seconds - 1e-9));
  for (const int object : bodies_)
  {
    BodyRecord& record = RecordOf(object);
    Rest& rest = record.rest;
    if (record.owner.kind != EBody::kObject || rest.asleep || record.is_left_out) continue;
    const RawPose now = RawPoseOf(record.body);
    if (is_delicate_[islands_.Of(PositionOf(object))] && IsNear(now, rest.reference))
    {
      rest.steps = std::min(rest.steps + 1, long_enough);
      continue;
    }
    rest.reference = now;
    rest.steps = 0;
  }
  for (auto first = island_bodies_.begin(); first != island_bodies_.end();)
  {
    const auto last = std::find_if(first, island_bodies_.end(),
                                   [&](const IslandMember& member) { return member.island != first->island; });
    const bool rests = std::all_of(first, last,
                                   [&](const IslandMember& member)
                                   {
                                     const BodyRecord& record = RecordOf(static_cast<int>(member.number));
                                     return record.owner.kind == EBody::kObject && record.rest.steps >= long_enough;
                                   });
    for (; first != last; ++first)
      if (rests) PutToSleep(static_cast<int>(first->number));
  }
}

void SolverWorld::PutToSleep(int body)
{
  RecordOf(body).rest.asleep = true;
  Stop(all_.Body(body));
  dBodyDisable(all_.Body(body));
}

}  // namespace swarmanoid::dynamics3d
