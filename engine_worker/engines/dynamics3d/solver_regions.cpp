// Problem: the regions of a split engine, in processes of their own, make the steps of a tick with the bits of one
// process, and any of them may be lost at any time.
//
// Method: the engine finds the groups and moves the robots that are free and far from others. Each group becomes a
// unit, and so do the other assemblies of a home that need the solver. A unit goes to one region, with the states of
// its members, the pairs that can meet, grips and ropes. The region has all models of the experiment: it puts the
// members into a world, loads their states, makes all steps that are left, and answers with the states. It needs
// nothing from earlier ticks, since the state of a body says all that decides about its motion.
//
// A unit stops if a body goes too far. The earliest such step of all units ends the steps of all, as in an engine that
// is not split. Units that went on are made again, from their states, up to that step. Then all groups are found again.
//
// Invariants: units do not depend on each other, and their regions decide no bit.
#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>

#include "engine_worker/engines/dynamics3d/solver_groups.h"

namespace swarmanoid::dynamics3d
{
namespace
{

// Objects and joints of limbs need several times as many iterations as robots on wheels.
constexpr std::size_t kDelicateLoad = 3;
// A unit stays in its region until that has so much more than its part of the load.
constexpr double kUneven = 1.05;

[[noreturn]] void Refuse(const char* reason)
{
  throw std::runtime_error(std::string("dynamics3d and its regions do not fit together: ") + reason);
}

}  // namespace

void SolverGroups::UseRegions(RegionTeam& team) { regions_ = std::make_unique<RegionStreams>(team); }

void SolverGroups::AdvanceWithRegions(std::uint64_t first_step)
{
  for (int step = 0; step < steps_;)
  {
    MakeUnits(step);
    step = RunUnits(step, first_step);
    if (step == steps_) break;
    free_robots_.SearchAgain(step);
    Find(step);
  }
}

// Makes the units of the groups and of the assemblies that need the solver without being in a group.
void SolverGroups::MakeUnits(int step)
{
  const OdeWorld& world = scene_.world;
  const auto count = static_cast<std::uint32_t>(models_.size());
  unit_of_.assign(count, kNoGroup);
  unit_count_ = 0;
  const auto is_asleep = [&](std::uint32_t assembly)
  { return world.RestOf(world.Assemblies()[assembly].first_body).asleep; };
  for (std::size_t group = 0; group < group_count_; ++group)
  {
    if (std::ranges::all_of(groups_[group], is_asleep)) continue;
    Unit& unit = AddUnit();
    unit.is_in_plane = is_in_plane_[group] != 0;
    for (const std::uint32_t assembly : groups_[group]) AddMember(unit, assembly);
  }
  Unit* of_home = nullptr;
  std::size_t home = 0;
  std::vector<Model*> solved;
  for (std::uint32_t assembly = 0; assembly < count; ++assembly)
  {
    if (is_owned_[assembly] == 0 || models_[assembly]->IsLeftOut() || GroupOf(assembly) != kNoGroup) continue;
    if (is_asleep(assembly)) continue;
    if (free_robots_.IsFar(assembly) && !free_robots_.BeforeStep({&assembly, 1}, {}, step, solved)) continue;
    if (of_home == nullptr || home != OdeWorld::HomeNumberOf(assembly)) of_home = &AddUnit();
    home = OdeWorld::HomeNumberOf(assembly);
    AddMember(*of_home, assembly);
  }

  const auto unit_of = [&](std::uint32_t assembly) -> Unit*
  { return unit_of_[assembly] == kNoGroup ? nullptr : units_[unit_of_[assembly]].get(); };
  for (const SolverWorld::NearAssemblies& pair : pairs_)
    if (Unit* const unit = unit_of(pair.first)) unit->pairs.push_back(pair);
  for (const SolverWorld::NearStatic& pair : static_pairs_)
    if (Unit* const unit = unit_of(pair.assembly)) unit->statics.push_back({pair.assembly, pair.solid->number});
  for (const kinematics2d::Pair& pair : free_robots_.NearPairs())
    if (Unit* const unit = unit_of(pair.first)) unit->near_pairs.push_back(pair);
}

SolverGroups::Unit& SolverGroups::AddUnit()
{
  if (unit_count_ == units_.size()) units_.push_back(std::make_unique<Unit>());
  Unit& unit = *units_[unit_count_++];
  unit.members.clear();
  unit.pairs.clear();
  unit.statics.clear();
  unit.near_pairs.clear();
  unit.is_in_plane = false;
  unit.load = 0;
  return unit;
}

void SolverGroups::AddMember(Unit& unit, std::uint32_t assembly)
{
  unit.members.push_back(assembly);
  unit_of_[assembly] = static_cast<std::uint32_t>(unit_count_ - 1);
  const OdeWorld& world = scene_.world;
  const EBody kind = world.RecordOf(world.Assemblies()[assembly].first_body).owner.kind;
  unit.load += kind == EBody::kObject || kind == EBody::kMechanism ? kDelicateLoad : 1;
}

// Chooses the region of each unit: that of the last tick, or the one with the least load if that has too much.
void SolverGroups::DealUnits()
{
  unit_order_.resize(unit_count_);
  std::iota(unit_order_.begin(), unit_order_.end(), 0U);
  std::ranges::stable_sort(unit_order_, std::ranges::greater(), [&](std::uint32_t unit) { return units_[unit]->load; });
  std::size_t all = 0;
  for (std::size_t k = 0; k < unit_count_; ++k) all += units_[k]->load;
  const double most = kUneven * static_cast<double>(all) / static_cast<double>(regions_->Count());
  region_of_.resize(models_.size(), kNoGroup);
  regions_->ForgetLoads();
  for (const std::uint32_t k : unit_order_)
  {
    Unit& unit = *units_[k];
    std::uint32_t& region = region_of_[unit.members.front()];
    if (region < regions_->Count() && static_cast<double>(regions_->LoadOf(region) + unit.load) <= most)
      regions_->AddLoad(region, unit.load);
    else
      region = regions_->ChooseRegion(unit.load);
    unit.region = region;
  }
}

// Has the regions make the steps from `step` on. Returns the step after the last one that all units have made.
int SolverGroups::RunUnits(int step, std::uint64_t first_step)
{
  contacts_ = 0;
  if (unit_count_ == 0) return steps_;
  DealUnits();
  ShareWork(IfItShares(pool_), unit_count_,
            [&](std::size_t k)
            {
              units_[k]->state.Clear();
              SaveStates(units_[k]->members, units_[k]->state);
            });
  sent_ = unit_order_;
  SendUnits(step, steps_, first_step);
  const auto end_of = [&](std::uint32_t unit) { return ByteReader(units_[unit]->result).Get<UnitEnd>(); };
  int stop = steps_;
  for (const std::uint32_t unit : sent_)
    if (const UnitEnd end = end_of(unit); end.goes_too_far != 0) stop = std::min(stop, end.step);

  // The results that count are taken before the next ones replace them.
  const auto went_on = [&](std::uint32_t unit) { return end_of(unit).step > stop; };
  ShareWork(IfItShares(pool_), sent_.size(),
            [&](std::size_t k)
            {
              if (!went_on(sent_[k])) TakeUnit(*units_[sent_[k]]);
            });
  for (const std::uint32_t unit : sent_)
    if (!went_on(unit)) Count(*units_[unit]);
  std::erase_if(sent_, [&](std::uint32_t unit) { return !went_on(unit); });
  if (sent_.empty()) return stop;
  SendUnits(step, stop, first_step);
  for (const std::uint32_t unit : sent_)
  {
    TakeUnit(*units_[unit]);
    Count(*units_[unit]);
  }
  return stop;
}

// Has the regions make the steps from `from` up to `to`, and not that one, of the units in sent_.
void SolverGroups::SendUnits(int from, int to, std::uint64_t first_step)
{
  const auto write = [&](bool, std::span<ByteWriter> streams)
  {
    for (std::size_t region = 0; region < streams.size(); ++region)
    {
      ByteWriter& stream = streams[region];
      stream.Put(first_step);
      stream.Put(static_cast<std::int32_t>(from));
      stream.Put(static_cast<std::int32_t>(to));
      stream.Put(free_robots_.IsSearched());
    }
    links_of_.assign(streams.size(), {});
    std::vector<std::uint8_t> is_sent(unit_count_, 0);
    for (const std::uint32_t unit : sent_) is_sent[unit] = 1;
    scene_.links.ForEach(
        [&](const Link& link)
        {
          const std::uint32_t unit = unit_of_[scene_.world.RecordOf(link.Spec().body_a).assembly];
          if (unit != kNoGroup && is_sent[unit] != 0) links_of_[units_[unit]->region].push_back(&link);
        });
    for (std::size_t region = 0; region < streams.size(); ++region)
    {
      streams[region].Put(static_cast<std::uint32_t>(links_of_[region].size()));
      for (const Link* const link : links_of_[region]) LinkTable::SaveLink(*link, streams[region]);
    }
    for (const std::uint32_t k : sent_)
    {
      const Unit& unit = *units_[k];
      ByteWriter& stream = streams[unit.region];
      stream.PutArray(unit.members);
      stream.PutArray(unit.pairs);
      stream.PutArray(unit.statics);
      stream.PutArray(unit.near_pairs);
      stream.Put(unit.is_in_plane);
      stream.PutArray(unit.state.Bytes());
    }
  };
  regions_->Run(write, [] {});
  for (std::size_t region = 0; region < regions_->Count(); ++region)
  {
    ByteReader result(regions_->ResultOf(region));
    for (const std::uint32_t k : sent_)
    {
      if (units_[k]->region != region) continue;
      units_[k]->result = result.GetImage<char>();
      const auto end = ByteReader(units_[k]->result).Get<UnitEnd>();
      if (end.step < from || end.step > to) Refuse("a unit made other steps");
    }
    if (!result.AtEnd()) Refuse("a result does not end");
  }
}

void SolverGroups::Count(const Unit& unit)
{
  const auto end = ByteReader(unit.result).Get<UnitEnd>();
  contacts_ += end.contacts;
  most_parts_ = std::max(most_parts_, static_cast<int>(end.most_parts));
}

// Takes over the states of the members after their steps.
void SolverGroups::TakeUnit(const Unit& unit)
{
  ByteReader result(unit.result);
  result.Get<UnitEnd>();
  LoadStates(unit.members, result);
  while (!result.AtEnd())
  {
    Link* const rope = scene_.links.Find(result.Get<std::uint32_t>());
    if (rope == nullptr) Refuse("a rope does not exist");
    rope->FollowLength(result.Get<double>());
  }
}

void SolverGroups::SaveStates(std::span<const std::uint32_t> members, ByteWriter& state) const
{
  for (const std::uint32_t member : members)
  {
    state.Put(is_searched_[member]);
    if (is_searched_[member] != 0) state.Put(reach_[member]);
    free_robots_.SaveTick(member, state);
    models_[member]->SaveWithin(state);
  }
}

void SolverGroups::LoadStates(std::span<const std::uint32_t> members, ByteReader& state)
{
  for (const std::uint32_t member : members)
  {
    is_searched_[member] = state.Get<std::uint8_t>();
    if (is_searched_[member] != 0) reach_[member] = state.Get<Box>();
    free_robots_.LoadTick(member, state);
    models_[member]->LoadWithin(state);
  }
}

void SolverGroups::Execute(std::span<const char> bytes, ByteWriter& result)
{
  ByteReader stream(bytes);
  const auto first_step = stream.Get<std::uint64_t>();
  const auto from = stream.Get<std::int32_t>();
  const auto to = stream.Get<std::int32_t>();
  if (from < 0 || to <= from || to > steps_) Refuse("a tick has other steps");
  free_robots_.FollowSearch(stream.Get<std::uint8_t>() != 0);
  const auto links = stream.Get<std::uint32_t>();
  scene_.links.Follow(links, stream);

  const std::size_t count = models_.size();
  reach_.resize(count);
  is_searched_.resize(count);
  islands_.Reset(count);
  group_of_.assign(count, kNoGroup);
  pairs_.clear();
  static_pairs_.clear();
  near_pairs_.clear();
  group_count_ = lone_count_ = 0;
  is_in_plane_.clear();
  unit_states_.clear();
  while (!stream.AtEnd()) ReadUnit(stream);
  CheckLinks();
  PlaceGroups();
  MakeTasks(near_pairs_);
  unit_results_.resize(std::max(unit_results_.size(), group_count_));
  ShareWork(IfItShares(pool_), group_count_, [&](std::size_t unit) { ExecuteUnit(unit, from, to, first_step); });
  for (std::size_t unit = 0; unit < group_count_; ++unit) result.PutArray(unit_results_[unit].Bytes());
}

// Reads a unit, which becomes a group.
void SolverGroups::ReadUnit(ByteReader& stream)
{
  if (groups_.size() <= group_count_) groups_.emplace_back();
  std::vector<std::uint32_t>& members = groups_[group_count_];
  stream.GetArray(members);
  if (members.empty() || members.back() >= models_.size() ||
      std::ranges::adjacent_find(members, std::ranges::greater_equal()) != members.end())
    Refuse("a unit has other assemblies");
  for (const std::uint32_t member : members)
  {
    if (group_of_[member] != kNoGroup) Refuse("an assembly comes twice");
    group_of_[member] = static_cast<std::uint32_t>(group_count_);
  }
  const auto is_member = [&](std::uint32_t assembly)
  { return assembly < models_.size() && group_of_[assembly] == group_count_; };
  for (const auto& pair : stream.GetArray<SolverWorld::NearAssemblies>())
  {
    if (!is_member(pair.first) || !is_member(pair.second)) Refuse("two assemblies are not in one unit");
    pairs_.push_back(pair);
  }
  const auto& solids = scene_.world.Solids();
  for (const auto& [assembly, solid] : stream.GetArray<NearSolid>())
  {
    if (!is_member(assembly) || solid >= solids.size() || solids[solid]->body >= 0) Refuse("a solid is another one");
    static_pairs_.push_back({assembly, solids[solid].get()});
  }
  for (const auto& pair : stream.GetArray<kinematics2d::Pair>())
  {
    const bool is_outline = pair.second >= models_.size() && pair.second < free_robots_.OutlineCount();
    if (!is_member(pair.first) || !(is_outline || is_member(pair.second))) Refuse("an outline is another one");
    near_pairs_.push_back(pair);
  }
  is_in_plane_.push_back(stream.Get<std::uint8_t>());
  unit_states_.push_back(stream.GetImage<char>());
  ++group_count_;
}

// Lists the ropes of each unit. Refuses links between units.
void SolverGroups::CheckLinks()
{
  ropes_of_.resize(std::max(ropes_of_.size(), group_count_));
  for (std::vector<const Link*>& ropes : ropes_of_) ropes.clear();
  scene_.links.ForEach(
      [&](const Link& link)
      {
        const LinkSpec& spec = link.Spec();
        const auto unit_of = [&](int body) { return group_of_[scene_.world.RecordOf(body).assembly]; };
        const std::uint32_t unit = unit_of(spec.body_a);
        if (unit == kNoGroup || (spec.body_b >= 0 && unit_of(spec.body_b) != unit)) Refuse("a grip is in no unit");
        if (spec.kind == ELink::kRope) ropes_of_[unit].push_back(&link);
      });
}

void SolverGroups::ExecuteUnit(std::size_t unit, int from, int to, std::uint64_t first_step)
{
  Task& task = tasks_[scene_.world.Homes().size() + unit];
  ByteReader state(unit_states_[unit]);
  LoadStates(groups_[unit], state);
  if (!state.AtEnd()) Refuse("the state of a unit does not end");
  task.most_parts = 1;
  int step = from;
  while (step < to && !task.goes_too_far)
  {
    RunTask(task, step, first_step + static_cast<std::uint64_t>(step));
    if (task.is_done) break;
    ++step;
  }
  ByteWriter& result = unit_results_[unit];
  result.Clear();
  result.Put(UnitEnd{step, task.contacts, task.most_parts, task.goes_too_far ? 1U : 0U});
  SaveStates(groups_[unit], result);
  for (const Link* const rope : ropes_of_[unit])
  {
    result.Put(rope->Serial());
    result.Put(rope->Length());
  }
}

}  // namespace swarmanoid::dynamics3d
