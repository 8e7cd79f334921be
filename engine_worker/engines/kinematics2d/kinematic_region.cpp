// KinematicWorld::Region: which bodies a region holds, and how they come and go. The rest is in
// kinematic_region_contacts.cpp.
#include "engine_worker/engines/kinematics2d/kinematic_region.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "common/math/elementary.h"
#include "common/math/lanes.h"

namespace swarmanoid::kinematics2d
{
namespace
{

// Of the width of a cell, less what rounding takes.
constexpr double kWayThatLasts = 0.999;

// Gives back what far more bodies took, before cuts moved.
template <class Values>
void Trim(Values& values)
{
  if (values.capacity() > 2 * values.size()) values.shrink_to_fit();
}

// Moves runs of values to their new places. What lies between them is left over from before.
template <class Runs, class Values>
void MoveRuns(const Runs& runs, std::size_t size, typename Values::value_type behind, Values& values)
{
  const std::size_t bodies = runs.empty() ? 0 : runs.back().to + runs.back().count;
  values.resize(std::max({values.size(), size, bodies}), behind);
  // First together at the front, then, from the last one, apart.
  std::size_t end = 0;
  for (const auto& run : runs)
  {
    if (end != run.from) std::copy_n(values.begin() + run.from, run.count, values.begin() + static_cast<long>(end));
    end += run.count;
  }
  for (auto run = runs.rbegin(); run != runs.rend(); ++run)
  {
    const std::size_t begin = end - run->count;
    if (begin != run->to)
      std::copy_backward(values.begin() + static_cast<long>(begin), values.begin() + static_cast<long>(end),
                         values.begin() + run->to + run->count);
    end = begin;
  }
  values.resize(size, behind);
  Trim(values);
}

}  // namespace

void CheckCuts(const BroadPhase& broad, std::span<const std::uint8_t> region_of_block, unsigned regions)
{
  if (region_of_block.size() != broad.BlockCount())
    throw std::runtime_error("cuts of a plane: there must be a region for each of its " +
                             std::to_string(broad.BlockCount()) + " blocks");
  for (const std::uint8_t region : region_of_block)
    if (region >= regions) throw std::runtime_error("cuts of a plane: there is no region " + std::to_string(region));
}

void KinematicWorld::Region::Refuse(const char* what)
{
  throw std::runtime_error(std::string("the regions of a plane do not agree: ") + what);
}

KinematicWorld::Region::Region(KinematicWorld& world, std::vector<std::uint32_t> followers, unsigned number,
                               RegionExchange& exchange, unsigned halo)
    : number_(number), halo_(halo), exchange_(exchange), numbers_(std::move(followers))
{
  const unsigned regions = exchange.RegionCount();
  others_ = static_cast<Regions>((std::uint64_t{1} << regions) - 1) & ~Bit(number);
  out_.resize(regions);
  in_.resize(regions);
  common_.resize(regions);
  is_own_.assign(world.count_, 0);
  SetCuts(world, std::vector<std::uint8_t>(world.broad_.BlockCount(), 0));
  FindCells(world);
  arrived_.clear();
  TakeArrived(world);
}

void KinematicWorld::Region::SetCuts(KinematicWorld& world, std::span<const std::uint8_t> region_of_block)
{
  const BroadPhase& broad = world.broad_;
  CheckCuts(broad, region_of_block, exchange_.RegionCount());
  const PlaneCells<double>& cells = broad.Cells();
  owner_.assign(cells.Count(), 0);
  holders_.assign(cells.Count(), 0);
  world.blocks_.clear();
  for (std::uint32_t block = 0; block < region_of_block.size(); ++block)
  {
    const std::uint8_t region = region_of_block[block];
    if (region == number_) world.blocks_.push_back(block);
    broad.ForEachRowOf(block,
                       [&](std::uint32_t first, std::uint32_t last)
                       {
                         std::fill(owner_.begin() + first, owner_.begin() + last + 1, region);
                         std::fill(holders_.begin() + first, holders_.begin() + last + 1, Bit(region));
                       });
  }
  world.block_contacts_.resize(world.blocks_.size());

  // Whoever has one of the nine cells around holds what is in the middle; once for each cell of the halo.
  for (unsigned k = 0; k < halo_; ++k)
  {
    const std::vector<Regions> nearer = holders_;
    for (std::uint32_t row = 0; row < cells.rows.Count(); ++row)
      for (std::uint32_t column = 0; column < cells.columns.Count(); ++column)
      {
        const std::uint32_t cell = cells.Cell(column, row);
        for (const std::uint32_t middle : {cell - cells.stride, cell, cell + cells.stride})
          holders_[cell] |= nearer[middle - 1] | nearer[middle] | nearer[middle + 1];
      }
  }
  inner_.resize(cells.Count());
  for (std::size_t cell = 0; cell < inner_.size(); ++cell) inner_[cell] = holders_[cell] == Bit(number_) ? 1 : 0;

  held_blocks_.clear();
  for (std::uint32_t block = 0; block < region_of_block.size(); ++block)
  {
    bool is_held = false;
    broad.ForEachRowOf(block,
                       [&](std::uint32_t first, std::uint32_t last)
                       {
                         is_held |= std::any_of(holders_.begin() + first, holders_.begin() + last + 1,
                                                [&](Regions holders) { return (holders & Bit(number_)) != 0; });
                       });
    if (is_held) held_blocks_.push_back(block);
  }
  is_shared_out_ = false;
}

std::uint32_t KinematicWorld::Region::FindBody(std::uint32_t number_in_whole) const
{
  const auto found = std::lower_bound(numbers_.begin(), numbers_.end(), number_in_whole);
  return found == numbers_.end() || *found != number_in_whole ? kNobody
                                                              : static_cast<std::uint32_t>(found - numbers_.begin());
}

std::span<const std::uint32_t> KinematicWorld::Region::FindOwn()
{
  own_.resize(is_own_.size());
  std::size_t count = 0;
  for (std::uint32_t body = 0; body < is_own_.size(); ++body)
  {
    own_[count] = body;
    count += is_own_[body];
  }
  return {own_.data(), count};
}

KinematicWorld::Region::Regions KinematicWorld::Region::HoldersOf(std::uint32_t body) const
{
  return is_everywhere_[body] != 0 ? others_ | Bit(number_) : holders_[cells_[body]];
}

void KinematicWorld::Region::MarkEverywhere(const KinematicWorld& world)
{
  is_everywhere_.assign(world.count_, 0);
  for (const Follower& follower : world.followers_) is_everywhere_[follower.body] = 1;
  for (const std::uint32_t body : world.broad_.Large()) is_everywhere_[body] = 1;
  for (const std::uint32_t number : grouped_)
  {
    const std::uint32_t body = FindBody(number);
    if (body != kNobody) is_everywhere_[body] = 1;
  }
}

void KinematicWorld::Region::Swap()
{
  exchange_.Swap(out_, in_);
  for (ByteWriter& message : out_) message.Clear();
}

void KinematicWorld::Region::FindCells(const KinematicWorld& world)
{
  cells_.resize(world.count_);
  world.broad_.Cells().FindCells({world.now_.x.data(), world.count_}, {world.now_.y.data(), world.count_},
                                 cells_.data());
}

void KinematicWorld::Region::ShareMaxima(std::initializer_list<double*> numbers)
{
  ForEachOther(
      [&](unsigned region)
      {
        for (const double* number : numbers) out_[region].Put(*number);
      });
  Swap();
  ForEachOther(
      [&](unsigned region)
      {
        ByteReader message(in_[region]);
        for (double* number : numbers) *number = std::max(*number, message.Get<double>());
      });
}

void KinematicWorld::Region::SetGrips(std::vector<Grip> grips)
{
  const std::size_t bytes = grips.size() * sizeof(Grip);
  if (grips.size() == grips_.size() && (bytes == 0 || std::memcmp(grips.data(), grips_.data(), bytes) == 0)) return;
  is_shared_out_ = false;
  grips_ = std::move(grips);
  grouped_.clear();
  for (const Grip& grip : grips_) grouped_.insert(grouped_.end(), {grip.body, grip.prey});
  std::sort(grouped_.begin(), grouped_.end());
  grouped_.erase(std::unique(grouped_.begin(), grouped_.end()), grouped_.end());
}

void KinematicWorld::Region::ShareBodies(KinematicWorld& world)
{
  way_ += world.reach_;
  // Of the halo one cell is needed in each substep.
  const double lasting = kWayThatLasts * (static_cast<double>(halo_) - 1);
  if (way_ * world.broad_.Cells().columns.inverse_edge >= lasting) is_shared_out_ = false;
  if (is_shared_out_) return TellBorder(world);
  ShareOut(world);
  is_shared_out_ = true;
  way_ = 0;
}

void KinematicWorld::Region::ShareOut(KinematicWorld& world)
{
  FindCells(world);
  MarkEverywhere(world);
  gone_.clear();
  for (std::uint32_t body = 0; body < world.count_; ++body)
  {
    if (IsInner(body) || world.IsFollower(body)) continue;
    const Regions holders = IsOwn(body) ? HoldersOf(body) : 0;
    if ((holders & Bit(number_)) == 0) gone_.push_back(body);
    ForEachBit(holders & others_, [&](unsigned region) { PutBody(world, body, numbers_[body], out_[region]); });
  }
  Swap();
  ReadBodies(world);
  TakeArrived(world);

  const bool had_groups = !world.grips_.empty();
  world.grips_.clear();
  for (Grip grip : grips_)
  {
    grip.body = FindBody(grip.body);
    grip.prey = FindBody(grip.prey);
    if (grip.body == kNobody || grip.prey == kNobody) Refuse("a body that grips or is gripped was not sent");
    world.grips_.push_back(grip);
  }
  if (had_groups || !grips_.empty()) world.RebuildGroups();
}

// To those who hold them already.
void KinematicWorld::Region::TellBorder(KinematicWorld& world)
{
  ForEachOther(
      [&](unsigned region)
      {
        for (const std::uint32_t body : common_[region])
          if (IsOwn(body)) PutBody(world, body, numbers_[body], out_[region]);
      });
  Swap();
  ReadBodies(world);
  const auto foreign = std::ranges::count_if(border_, [&](std::uint32_t body) { return !IsOwn(body); });
  if (arrived_.size() != static_cast<std::size_t>(foreign)) Refuse("bodies of the border were not told");
  for (const ArrivedBody& arrived : arrived_)
  {
    const std::uint32_t body = FindBody(arrived.body.number);
    if (body == kNobody || IsOwn(body)) Refuse("a body was sent by one that does not compute it");
    Settle(world, body, arrived);
  }
  for (const std::uint32_t body : border_)
    is_own_[body] = owner_[world.broad_.Cells().CellOf(world.now_.x[body], world.now_.y[body])] == number_ ? 1 : 0;
}

// Who holds which body from now on.
void KinematicWorld::Region::TakeArrived(KinematicWorld& world)
{
  const bool others = Merge(world);
  if (others) Rearrange(world);
  for (std::size_t k = 0; k < arrived_.size(); ++k) Settle(world, places_[k], arrived_[k]);
  if (others)
  {
    std::vector<double> radii(world.count_);
    for (std::uint32_t body = 0; body < world.count_; ++body) radii[body] = world.RadiusOf(body);
    world.broad_.SetBodies(radii);
    world.verlet_list_.Forget();
    world.grips_.clear();
    world.RebuildGroups();
  }
  FindCommon(world);
}

void KinematicWorld::Region::TakeBodies(KinematicWorld& world, ByteReader& bodies)
{
  arrived_.clear();
  ReadBodies(world, bodies);
  SortArrived();
  FindCells(world);
  TakeArrived(world);
}

void KinematicWorld::Region::PutBody(const KinematicWorld& world, std::uint32_t body, std::uint32_t number,
                                     ByteWriter& message)
{
  const auto turret = std::lower_bound(world.turrets_.begin(), world.turrets_.end(), body,
                                       [](const Turret& t, std::uint32_t b) { return t.body < b; });
  const double rate = turret != world.turrets_.end() && turret->body == body ? turret->rate : 0;
  const double angle = world.turret_angle_[body];
  const bool has_turret = rate != 0 || angle != 0;
  message.Put(Arrival{number, world.model_[body] & 0x3fffffffU, world.present_[body] != 0, has_turret,
                      world.now_.Get(body), world.twists_.Get(body)});
  if (has_turret) message.Put(TurretState{angle, rate});
  if (world.keeps_travel_) message.Put(Travel{world.travel_forward_[body], world.travel_turn_[body]});
}

void KinematicWorld::Region::ReadBodies(const KinematicWorld& world)
{
  arrived_.clear();
  ForEachOther(
      [&](unsigned region)
      {
        ByteReader message(in_[region]);
        ReadBodies(world, message);
      });
  SortArrived();
}

// All that follow.
void KinematicWorld::Region::ReadBodies(const KinematicWorld& world, ByteReader& message)
{
  while (!message.AtEnd())
  {
    ArrivedBody& arrived = arrived_.emplace_back();
    arrived.body = message.Get<Arrival>();
    if (arrived.body.has_turret) arrived.turret = message.Get<TurretState>();
    if (world.keeps_travel_) arrived.travel = message.Get<Travel>();
    if (arrived.body.model >= world.models_.size()) Refuse("a body of an unknown model was sent");
  }
}

void KinematicWorld::Region::SortArrived()
{
  std::sort(arrived_.begin(), arrived_.end(),
            [](const ArrivedBody& a, const ArrivedBody& b) { return a.body.number < b.body.number; });
}

// Who of those that are gone arrived again, and who came to be held. Returns whether bodies are to be numbered anew.
bool KinematicWorld::Region::Merge(const KinematicWorld& world)
{
  places_.resize(arrived_.size());
  removed_.clear();
  stayed_.clear();
  added_.clear();
  auto gone = gone_.begin();
  for (std::uint32_t n = 0; n < arrived_.size(); ++n)
  {
    const std::uint32_t number = arrived_[n].body.number;
    if (n > 0 && arrived_[n - 1].body.number == number) Refuse("a body was sent by two of them");
    for (; gone != gone_.end() && numbers_[*gone] < number; ++gone) removed_.push_back(*gone);
    if (gone != gone_.end() && numbers_[*gone] == number)
    {
      stayed_.push_back(n);
      places_[n] = *gone++;
      continue;
    }
    if (FindBody(number) != kNobody) Refuse("a body was sent by one that does not compute it");
    added_.push_back(n);
  }
  removed_.insert(removed_.end(), gone, gone_.end());
  if (removed_.empty() && added_.empty()) return false;
  FindRuns(static_cast<std::uint32_t>(world.count_));
  return true;
}

// Where the bodies go between which some are removed and added.
void KinematicWorld::Region::FindRuns(std::uint32_t count)
{
  runs_.clear();
  auto removed = removed_.begin();
  auto added = added_.begin();
  const auto place_of_next = [&]
  {
    const auto at = std::lower_bound(numbers_.begin(), numbers_.end(), arrived_[*added].body.number);
    return static_cast<std::uint32_t>(at - numbers_.begin());
  };
  std::uint32_t next_added = added != added_.end() ? place_of_next() : count;
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  while (true)
  {
    const std::uint32_t stop = std::min(removed != removed_.end() ? *removed : count, next_added);
    if (stop > from)
    {
      runs_.push_back({from, to, stop - from});
      to += stop - from;
      from = stop;
    }
    if (added != added_.end() && next_added == from)
    {
      places_[*added++] = to++;
      next_added = added != added_.end() ? place_of_next() : count;
    }
    else if (removed != removed_.end() && *removed == from)
    {
      ++from;
      ++removed;
    }
    else
      break;
  }
  new_count_ = to;
}

// Numbers the bodies of the world anew. Those that arrived get their values in Settle.
void KinematicWorld::Region::Rearrange(KinematicWorld& world)
{
  const std::size_t count = new_count_;
  const std::size_t padded = PaddedCount(count);
  constexpr std::uint32_t kGone = kNobody;
  std::vector<std::uint32_t> place_of(world.count_, kGone);
  for (const Run& run : runs_) std::iota(place_of.begin() + run.from, place_of.begin() + run.from + run.count, run.to);
  for (const std::uint32_t n : stayed_) places_[n] = place_of[places_[n]];

  for (std::vector<double>* of_bodies :
       {&world.now_.x, &world.now_.y, &world.now_.z, &world.twists_.forward, &world.twists_.left, &world.twists_.turn})
    MoveRuns(runs_, padded, 0.0, *of_bodies);
  for (std::vector<double>* of_bodies : {&world.now_.w, &world.inverse_limit_})
    MoveRuns(runs_, padded, 1.0, *of_bodies);
  for (ZeroedVector<double>* of_bodies :
       {&world.turret_angle_, &world.turret_sin_, &world.travel_forward_, &world.travel_turn_})
    MoveRuns(runs_, count, 0.0, *of_bodies);
  if (!world.turret_cos_.empty()) MoveRuns(runs_, count, 1.0, world.turret_cos_);
  for (std::vector<std::uint32_t>* of_bodies : {&world.model_, &numbers_, &cells_})
    MoveRuns(runs_, count, 0U, *of_bodies);
  for (std::vector<std::uint8_t>* of_bodies : {&world.follower_, &world.present_, &is_own_})
    MoveRuns(runs_, count, std::uint8_t{0}, *of_bodies);
  world.before_.Resize(padded);
  // Behind the bodies is what stands for the static shapes, and what vector loops may read.
  for (std::size_t k = count; k < padded; ++k)
  {
    world.now_.Set(k, {});
    world.before_.Set(k, {});
    world.twists_.Set(k, {});
    world.inverse_limit_[k] = 1;
  }

  const auto is_gone = [&](const auto& of_body) { return place_of[of_body.body] == kGone; };
  std::erase_if(world.turrets_, is_gone);
  for (Turret& turret : world.turrets_) turret.body = place_of[turret.body];
  for (Follower& follower : world.followers_) follower.body = place_of[follower.body];

  world.turret_cos_before_ = world.turret_cos_;
  world.turret_sin_before_ = world.turret_sin_;
  world.turret_way_.assign(count, 0);
  world.way_.resize(padded);
  for (PoseStore* poses : {&world.now_, &world.before_})
    for (std::vector<double>* values : {&poses->x, &poses->y, &poses->z, &poses->w}) Trim(*values);
  Trim(world.way_);
  Trim(world.turret_way_);
  world.placed_.resize(count);
  Trim(world.placed_);
  for (const CollisionModel& shape : world.statics_) world.placed_.push_back({.model = &shape});
  world.leader_.resize(count + 1);
  world.leader_[count] = static_cast<std::uint32_t>(count);
  world.mobility_.resize(count + 1);
  world.mobility_[count] = 0;
  world.is_involved_.resize(count + 1);
  Trim(world.leader_);
  Trim(world.mobility_);
  world.solver_.Configure(count, static_cast<unsigned>(world.parts_.size()));
  world.limiter_.Clear();
  world.limiter_.MakeRoom(count + 1);
  world.count_ = count;
}

void KinematicWorld::Region::Settle(KinematicWorld& world, std::uint32_t body, const ArrivedBody& arrived)
{
  numbers_[body] = arrived.body.number;
  cells_[body] = world.broad_.Cells().CellOf(arrived.body.pose.x, arrived.body.pose.y);
  is_own_[body] = 0;
  world.now_.Set(body, arrived.body.pose);
  world.twists_.Set(body, arrived.body.twist);
  world.model_[body] = arrived.body.model;
  world.follower_[body] = 0;
  world.present_[body] = arrived.body.is_present;
  const CollisionModel& model = world.models_[arrived.body.model];
  world.inverse_limit_[body] = 1 / world.CoreLimitOf(model);
  world.travel_forward_[body] = arrived.travel.forward;
  world.travel_turn_[body] = arrived.travel.turn;
  world.SetTurretRate(body, arrived.turret.rate);
  world.SetTurretAngle(body, arrived.turret.angle);
}

// Who computes which body in the substep that begins, and who holds it.
void KinematicWorld::Region::FindCommon(const KinematicWorld& world)
{
  MarkEverywhere(world);
  for (std::vector<std::uint32_t>& bodies : common_) bodies.clear();
  border_.clear();
  for (std::uint32_t body = 0; body < world.count_; ++body)
  {
    if (IsInner(body) || world.IsFollower(body)) continue;
    is_own_[body] = owner_[cells_[body]] == number_ ? 1 : 0;
    const Regions others = HoldersOf(body) & others_;
    if (others != 0) border_.push_back(body);
    ForEachBit(others, [&](unsigned region) { common_[region].push_back(body); });
  }
}

}  // namespace swarmanoid::kinematics2d
