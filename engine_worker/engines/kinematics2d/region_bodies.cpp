// Problem: each region needs the bodies near its blocks, bit by bit as their owners have them, while bodies drive from
// block to block.
//
// Method: contacts reach one cell beyond a block. A region holds more rows of cells (the halo), so that the sets of
// held bodies last until a body may have gone as far as the other rows are wide. Until then owners send only the bodies
// of the border. After that, and when a body is put elsewhere, the owner of a body sends it to all regions that are to
// hold it: so bodies migrate. Bodies that are not bound to a place (followers, members of groups, large ones) are held
// by all regions.
//
// Invariants: bodies are in the order of their numbers in the whole plane, so that all regions work in one order. The
// owner of a body follows from its cell when a substep begins, so all holders agree on it without a message. Two
// regions have the same list of common bodies, and refer to a body by its index in it.
#include "engine_worker/engines/kinematics2d/region_bodies.h"

#include <algorithm>
#include <cstring>

namespace swarmanoid::kinematics2d
{
namespace
{

// The part of the width of a cell that a body may go; rounding takes the rest.
constexpr double kWayThatLasts = 0.999;

}  // namespace

RegionBodies::RegionBodies(PlaneState& plane, std::vector<std::uint32_t> followers, unsigned number,
                           RegionExchange& exchange, unsigned halo)
    : plane_(plane),
      bodies_(plane.bodies),
      broad_(plane.contacts.broad),
      number_(number),
      halo_(halo),
      mail_(number, exchange),
      numbers_(std::move(followers)),
      is_own_(plane.bodies.count, 0),
      common_(exchange.RegionCount())
{
  SetCuts(std::vector<std::uint8_t>(broad_.BlockCount(), 0));
  FindCells();
  FindCommon();
}

void RegionBodies::SetCuts(std::span<const std::uint8_t> region_of_block)
{
  CheckCuts(broad_, region_of_block, mail_.RegionCount());
  const PlaneCells<double>& cells = broad_.Cells();
  owner_.assign(cells.Count(), 0);
  holders_.assign(cells.Count(), 0);
  std::vector<std::uint32_t>& blocks = plane_.contacts.blocks;
  blocks.clear();
  for (std::uint32_t block = 0; block < region_of_block.size(); ++block)
  {
    const std::uint8_t region = region_of_block[block];
    if (region == number_) blocks.push_back(block);
    broad_.FillBlock(block, region, owner_);
    broad_.FillBlock(block, Bit(region), holders_);
  }
  plane_.contacts.of_blocks.resize(blocks.size());

  // A region that has one of the nine cells around holds what is in the middle; once for each row of the halo.
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
    broad_.ForEachRowOf(block,
                        [&](std::uint32_t first, std::uint32_t last)
                        {
                          for (std::uint32_t cell = first; cell <= last; ++cell)
                            is_held |= (holders_[cell] & Bit(number_)) != 0;
                        });
    if (is_held) held_blocks_.push_back(block);
  }
  is_shared_out_ = false;
}

void RegionBodies::SetGrips(std::vector<Grip> grips)
{
  const std::size_t bytes = grips.size() * sizeof(Grip);
  if (grips.size() == grips_.size() && (bytes == 0 || std::memcmp(grips.data(), grips_.data(), bytes) == 0)) return;
  is_shared_out_ = false;
  grips_ = std::move(grips);
}

std::uint32_t RegionBodies::Find(std::uint32_t number_in_whole) const
{
  const auto found = std::lower_bound(numbers_.begin(), numbers_.end(), number_in_whole);
  return found == numbers_.end() || *found != number_in_whole ? kNobody
                                                              : static_cast<std::uint32_t>(found - numbers_.begin());
}

std::uint32_t RegionBodies::FindOwn(std::uint32_t number_in_whole) const
{
  const std::uint32_t body = Find(number_in_whole);
  if (body == kNobody || !IsOwn(body)) RefuseRegion("a task is about a body that the region does not compute");
  return body;
}

std::span<const std::uint32_t> RegionBodies::ListOwn()
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

RegionBodies::Regions RegionBodies::HoldersOf(std::uint32_t body) const
{
  return is_everywhere_[body] != 0 ? mail_.Others() | Bit(number_) : holders_[cells_[body]];
}

void RegionBodies::MarkEverywhere()
{
  is_everywhere_.assign(bodies_.count, 0);
  for (const Follower& follower : bodies_.followers) is_everywhere_[follower.body] = 1;
  for (const std::uint32_t body : broad_.Large()) is_everywhere_[body] = 1;
  for (const Grip& grip : grips_)
    for (const std::uint32_t body : {Find(grip.body), Find(grip.prey)})
      if (body != kNobody) is_everywhere_[body] = 1;
}

void RegionBodies::FindCells()
{
  const PoseStore& now = bodies_.now;
  cells_.resize(bodies_.count);
  broad_.Cells().FindCells({now.x.data(), bodies_.count}, {now.y.data(), bodies_.count}, cells_.data());
}

void RegionBodies::Share()
{
  way_ += plane_.lengths.reach;
  // One row of the halo is needed in each substep.
  const double lasting = kWayThatLasts * (static_cast<double>(halo_) - 1);
  if (way_ * broad_.Cells().columns.inverse_edge >= lasting) is_shared_out_ = false;
  if (is_shared_out_) return ShareBorder();
  ShareOut();
  is_shared_out_ = true;
  way_ = 0;
}

void RegionBodies::ShareOut()
{
  FindCells();
  MarkEverywhere();
  gone_.clear();
  for (std::uint32_t body = 0; body < bodies_.count; ++body)
  {
    if (IsInner(body) || bodies_.IsFollower(body)) continue;
    const Regions holders = IsOwn(body) ? HoldersOf(body) : 0;
    if ((holders & Bit(number_)) == 0) gone_.push_back(body);
    ForEachBit(holders & mail_.Others(),
               [&](unsigned region) { PutBody(bodies_, body, numbers_[body], mail_.To(region)); });
  }
  SwapBodies();
  TakeArrived();

  std::vector<Grip>& held = plane_.groups.grips;
  const bool had_groups = !held.empty();
  held.clear();
  for (Grip grip : grips_)
  {
    grip.body = Find(grip.body);
    grip.prey = Find(grip.prey);
    if (grip.body == kNobody || grip.prey == kNobody) RefuseRegion("a body that grips or is gripped was not sent");
    held.push_back(grip);
  }
  if (had_groups || !grips_.empty()) plane_.groups.Rebuild(bodies_);
}

// Sends the bodies of the border to the regions that hold them already.
void RegionBodies::ShareBorder()
{
  ForEachBit(mail_.Others(),
             [&](unsigned region)
             {
               for (const std::uint32_t body : common_[region])
                 if (IsOwn(body)) PutBody(bodies_, body, numbers_[body], mail_.To(region));
             });
  SwapBodies();
  const auto foreign = std::ranges::count_if(border_, [&](std::uint32_t body) { return !IsOwn(body); });
  if (arrived_.size() != static_cast<std::size_t>(foreign)) RefuseRegion("bodies of the border were not sent");
  for (const BodyMessage& arrived : arrived_)
  {
    const std::uint32_t body = Find(arrived.body.number);
    if (body == kNobody || IsOwn(body)) RefuseRegion("a body was sent by a region that does not compute it");
    Settle(body, arrived);
  }
  for (const std::uint32_t body : border_)
    is_own_[body] = owner_[broad_.Cells().CellOf(bodies_.now.x[body], bodies_.now.y[body])] == number_ ? 1 : 0;
}

void RegionBodies::TakeBodies(ByteReader& message)
{
  arrived_.clear();
  while (!message.AtEnd()) arrived_.push_back(GetBody(bodies_, message));
  std::ranges::sort(arrived_, {}, [](const BodyMessage& body) { return body.body.number; });
  gone_.clear();
  FindCells();
  TakeArrived();
}

void RegionBodies::SwapBodies()
{
  arrived_.clear();
  mail_.Swap([](unsigned, ByteWriter&) {},
             [&](unsigned, ByteReader& message)
             {
               while (!message.AtEnd()) arrived_.push_back(GetBody(bodies_, message));
             });
  std::ranges::sort(arrived_, {}, [](const BodyMessage& body) { return body.body.number; });
}

void RegionBodies::TakeArrived()
{
  const bool others = Merge();
  if (others)
  {
    bodies_.Renumber(runs_, new_count_);
    for (std::vector<std::uint32_t>* values : {&numbers_, &cells_})
      MoveRuns(runs_, new_count_, new_count_, 0U, *values);
    MoveRuns(runs_, new_count_, new_count_, std::uint8_t{0}, is_own_);
  }
  for (std::size_t k = 0; k < arrived_.size(); ++k) Settle(arrived_at_[k], arrived_[k]);
  if (others)
  {
    plane_.contacts.broad.SetBodies(bodies_.Radii());
    plane_.contacts.verlet_list.Forget();
    plane_.BodiesChanged();
  }
  FindCommon();
}

// Merges the bodies that stay with those that arrived, by number. Returns whether other bodies are held than before.
bool RegionBodies::Merge()
{
  runs_.clear();
  new_count_ = 0;
  arrived_at_.clear();
  auto gone = gone_.begin();
  bool others = false;
  std::uint32_t body = 0;
  const auto keep = [&]
  {
    const auto goes_on = [&](const Run& run)
    { return run.from + run.count == body && run.to + run.count == new_count_; };
    if (runs_.empty() || !goes_on(runs_.back())) runs_.push_back({body, new_count_, 0});
    ++runs_.back().count;
    ++body;
    ++new_count_;
  };
  // Keeps or removes the bodies with a smaller number than the one that arrives next.
  const auto keep_before = [&](std::uint32_t number)
  {
    while (body < numbers_.size() && numbers_[body] < number)
    {
      if (gone == gone_.end() || *gone != body)
      {
        keep();
        continue;
      }
      ++gone;
      ++body;
      others = true;
    }
  };
  for (const BodyMessage& arrived : arrived_)
  {
    const std::uint32_t number = arrived.body.number;
    if (&arrived != arrived_.data() && (&arrived)[-1].body.number == number)
      RefuseRegion("a body was sent by two of them");
    keep_before(number);
    arrived_at_.push_back(new_count_);
    if (body == numbers_.size() || numbers_[body] != number)
    {
      ++new_count_;
      others = true;
      continue;
    }
    if (gone == gone_.end() || *gone != body) RefuseRegion("a body was sent by a region that does not compute it");
    ++gone;
    keep();
  }
  keep_before(kNobody);
  return others;
}

// Sets all values of a body that arrived.
void RegionBodies::Settle(std::uint32_t body, const BodyMessage& arrived)
{
  const BodyMessage::Fixed& fixed = arrived.body;
  numbers_[body] = fixed.number;
  cells_[body] = broad_.Cells().CellOf(fixed.pose.x, fixed.pose.y);
  is_own_[body] = 0;
  bodies_.now.Set(body, fixed.pose);
  bodies_.twists.Set(body, fixed.twist);
  bodies_.model[body] = fixed.model;
  bodies_.is_follower[body] = 0;
  bodies_.is_present[body] = fixed.is_present;
  bodies_.inverse_limit[body] = 1 / bodies_.LimitOf(bodies_.models[fixed.model]);
  bodies_.travel_forward[body] = arrived.travel.forward;
  bodies_.travel_turn[body] = arrived.travel.turn;
  bodies_.SetTurretRate(body, arrived.turret.rate);
  bodies_.SetTurretAngle(body, arrived.turret.angle);
}

// Finds the owners of the bodies in the substep that begins, and the bodies that two regions hold.
void RegionBodies::FindCommon()
{
  MarkEverywhere();
  for (std::vector<std::uint32_t>& bodies : common_) bodies.clear();
  border_.clear();
  for (std::uint32_t body = 0; body < bodies_.count; ++body)
  {
    if (IsInner(body) || bodies_.IsFollower(body)) continue;
    is_own_[body] = owner_[cells_[body]] == number_ ? 1 : 0;
    const Regions others = HoldersOf(body) & mail_.Others();
    if (others != 0) border_.push_back(body);
    ForEachBit(others, [&](unsigned region) { common_[region].push_back(body); });
  }
}

}  // namespace swarmanoid::kinematics2d
