// A step of OdeWorld: pairs, contacts, islands, the solver, and objects that come to rest.
#include <algorithm>
#include <cmath>
#include <mutex>

#include "engine_worker/engines/dynamics3d/ode_world.h"

namespace swarmanoid::dynamics3d
{
namespace
{

// From the eighth iteration on ODE shuffles the constraints.
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

// ODE's generator belongs to the whole process.
std::mutex& ShuffleMutex()
{
  static std::mutex mutex;
  return mutex;
}

// The seed depends on the step alone, so that equal islands get equal results wherever they are and whatever else
// exists.
unsigned long SeedOf(std::uint64_t step)
{
  std::uint64_t x = step * 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return static_cast<unsigned long>((x ^ (x >> 31)) & 0xffffffffU);
}

}  // namespace

void OdeWorld::NearCallback(void* world, dGeomID first, dGeomID second)
{
  if (dGeomIsSpace(first) || dGeomIsSpace(second))
  {
    dSpaceCollide2(first, second, world, &NearCallback);
    return;
  }
  const auto solid = [](dGeomID geom) -> const Solid& { return *static_cast<const Solid*>(dGeomGetData(geom)); };
  static_cast<OdeWorld*>(world)->CollectPair(solid(first), solid(second));
}

void OdeWorld::CollectPair(const Solid& first, const Solid& second)
{
  if (!ignored_.empty() && IsIgnored(first.entity, second.entity)) return;
  pairs_.push_back({std::min(first.number, second.number), std::max(first.number, second.number), false});
}

void OdeWorld::Step(double seconds, std::uint64_t number)
{
  InitialiseOde();
  step_seconds_ = seconds;
  contacts_.clear();
  if (left_out_count_ == bodies_.size()) return;

  // The space reports pairs in an order that depends on its history: contacts follow the numbers of the solids instead.
  pairs_.clear();
  dSpaceCollide(space_, this, &NearCallback);
  std::sort(pairs_.begin(), pairs_.end(),
            [](const Pair& x, const Pair& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  FindContacts();

  FindObjectIslands();
  SolveOthers(seconds, number);
  SolveObjectIslands(seconds, number);
  RestObjects(seconds);
}

// A sleeping object has contacts only with bodies that are awake, and such a contact wakes it.
void OdeWorld::FindContacts()
{
  contacts_.clear();
  for (const IgnoredPair& held : ignored_)
  {
    Wake(held.low);
    Wake(held.high);
  }
  bool woken = false;
  bool again = false;
  do {
    woken = false;
    for (std::uint32_t k = 0; k < pairs_.size(); ++k)
    {
      Pair& pair = pairs_[k];
      const Solid& a = *solids_[pair.a];
      const Solid& b = *solids_[pair.b];
      if (pair.done || !(IsAwake(a) || IsAwake(b))) continue;
      pair.done = true;
      const std::size_t before = contacts_.size();
      MakeContacts(a, b, k);
      if (contacts_.size() == before) continue;
      for (const std::uint32_t entity : {a.entity, b.entity}) woken |= Wake(entity);
    }
    again = again || woken;
  } while (woken);
  if (again)
    std::stable_sort(contacts_.begin(), contacts_.end(),
                     [](const Contact& x, const Contact& y) { return x.pair < y.pair; });
}

void OdeWorld::FindObjectIslands()
{
  island_bodies_.clear();
  island_contacts_.clear();
  if (objects_.empty()) return;
  islands_.Reset(object_of_.size());
  for (const Contact& contact : contacts_)
    if (contact.body_a >= 0 && contact.body_b >= 0) islands_.Join(EntityOf(contact.body_a), EntityOf(contact.body_b));
  for (const IgnoredPair& held : ignored_) islands_.Join(held.low, held.high);

  has_object_.assign(object_of_.size(), false);
  const auto mark = [&](int body)
  {
    if (body >= 0 && IsObject(body)) has_object_[islands_.Of(EntityOf(body))] = true;
  };
  for (const Contact& contact : contacts_)
  {
    mark(contact.body_a);
    mark(contact.body_b);
  }
  for (const IgnoredPair& held : ignored_)
    for (const std::uint32_t entity : {held.low, held.high}) mark(object_of_[entity]);
  if (std::find(has_object_.begin(), has_object_.end(), true) == has_object_.end()) return;

  for (int body = 0; body < static_cast<int>(bodies_.size()); ++body)
    if (const std::uint32_t island = islands_.Of(EntityOf(body)); has_object_[island])
      island_bodies_.push_back({island, static_cast<std::uint32_t>(body)});
  for (std::uint32_t k = 0; k < contacts_.size(); ++k)
  {
    const Contact& contact = contacts_[k];
    const std::uint32_t island = islands_.Of(EntityOf(contact.body_a >= 0 ? contact.body_a : contact.body_b));
    if (has_object_[island]) island_contacts_.push_back({island, k});
  }
  const auto by_island = [](const Member& x, const Member& y)
  { return x.island != y.island ? x.island < y.island : x.number < y.number; };
  std::sort(island_bodies_.begin(), island_bodies_.end(), by_island);
  std::sort(island_contacts_.begin(), island_contacts_.end(), by_island);
}

void OdeWorld::Attach(const Contact& contact)
{
  const auto body = [&](int number) { return number < 0 ? nullptr : Body(number); };
  dJointAttach(dJointCreateContact(world_, contact_joints_, &contact.joint), body(contact.body_a),
               body(contact.body_b));
}

void OdeWorld::Solve(double seconds, int iterations, std::uint64_t number)
{
  dWorldSetQuickStepNumIterations(world_, iterations);
  if (iterations > kOrderedIterations)
  {
    const std::lock_guard<std::mutex> lock(ShuffleMutex());
    dRandSetSeed(SeedOf(number));
    dWorldQuickStep(world_, seconds);
  }
  else
    dWorldQuickStep(world_, seconds);
  dJointGroupEmpty(contact_joints_);
}

// All that is in no island with objects.
void OdeWorld::SolveOthers(double seconds, std::uint64_t number)
{
  for (const Member& member : island_bodies_) dBodyDisable(Body(static_cast<int>(member.number)));
  is_in_island_.assign(contacts_.size(), false);
  for (const Member& member : island_contacts_) is_in_island_[member.number] = true;
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    if (!is_in_island_[k]) Attach(contacts_[k]);
  Solve(seconds, settings_.iterations, number);
}

// In a pile, support travels up by one object in an iteration.
int OdeWorld::ObjectIterations(int objects) const
{
  return settings_.object_iterations * std::min(20 + objects, 80) / 20;
}

// Each island is solved by itself, so that its result depends on no other one.
void OdeWorld::SolveObjectIslands(double seconds, std::uint64_t number)
{
  if (island_bodies_.empty()) return;
  for (const BodyRecord& record : bodies_) dBodyDisable(record.body);
  auto contact = island_contacts_.begin();
  for (auto first = island_bodies_.begin(); first != island_bodies_.end();)
  {
    const auto last =
        std::find_if(first, island_bodies_.end(), [&](const Member& member) { return member.island != first->island; });
    int objects = 0;
    for (auto member = first; member != last; ++member)
    {
      const int body = static_cast<int>(member->number);
      dBodyEnable(Body(body));
      objects += IsObject(body) ? 1 : 0;
    }
    for (; contact != island_contacts_.end() && contact->island == first->island; ++contact)
      Attach(contacts_[contact->number]);
    Solve(seconds, std::max(settings_.iterations, ObjectIterations(objects)), number);
    for (auto member = first; member != last; ++member) dBodyDisable(Body(static_cast<int>(member->number)));
    first = last;
  }
  for (const BodyRecord& record : bodies_)
    if (!record.rest.asleep && !record.is_left_out) dBodyEnable(record.body);
}

void OdeWorld::RestObjects(double seconds)
{
  const auto long_enough = static_cast<std::uint32_t>(std::ceil(kRestTime / seconds - 1e-9));
  for (const int object : objects_)
  {
    Rest& rest = RecordOf(object).rest;
    if (rest.asleep) continue;
    const RawPose now = RawPoseOf(Body(object));
    if (has_object_[islands_.Of(EntityOf(object))] && IsNear(now, rest.reference))
    {
      rest.steps = std::min(rest.steps + 1, long_enough);
      continue;
    }
    rest.reference = now;
    rest.steps = 0;
  }
  for (auto first = island_bodies_.begin(); first != island_bodies_.end();)
  {
    const auto last =
        std::find_if(first, island_bodies_.end(), [&](const Member& member) { return member.island != first->island; });
    const bool rests = std::all_of(first, last,
                                   [&](const Member& member)
                                   {
                                     const BodyRecord& record = bodies_[member.number];
                                     return record.owner.kind == EBody::kObject && record.rest.steps >= long_enough;
                                   });
    for (; first != last; ++first)
      if (rests) PutToSleep(static_cast<int>(first->number));
  }
}

bool OdeWorld::IsAwake(const Solid& solid) const
{
  const dBodyID body = dGeomGetBody(solid.geom);
  return body != nullptr && !bodies_[static_cast<std::size_t>(NumberOf(body))].rest.asleep;
}

void OdeWorld::SetRest(int body, const Rest& rest)
{
  RecordOf(body).rest = rest;
  if (rest.asleep)
    dBodyDisable(Body(body));
  else
    dBodyEnable(Body(body));
}

void OdeWorld::PutToSleep(int body)
{
  RecordOf(body).rest.asleep = true;
  Stop(Body(body));
  dBodyDisable(Body(body));
}

bool OdeWorld::Wake(std::uint32_t entity)
{
  const int body = entity < object_of_.size() ? object_of_[entity] : -1;
  if (body < 0 || !RecordOf(body).rest.asleep) return false;
  RecordOf(body).rest = {RawPoseOf(Body(body)), 0, false};
  dBodyEnable(Body(body));
  return true;
}

void OdeWorld::WakeAll()
{
  for (const int object : objects_) Wake(EntityOf(object));
}

std::size_t OdeWorld::SleeperCount() const
{
  return static_cast<std::size_t>(
      std::count_if(bodies_.begin(), bodies_.end(), [](const BodyRecord& record) { return record.rest.asleep; }));
}

}  // namespace swarmanoid::dynamics3d
