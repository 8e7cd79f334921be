// Invariants: a robot outside the arena, and one that is switched off, draws nothing. The power attribute is the energy
// that really left the battery in the tick, divided by the tick, so that its sum over the ticks is the energy used,
// also in the tick in which the battery becomes empty.
#include "space_server/batteries.h"

#include <algorithm>

#include "common/space/attributes.h"
#include "common/space/message_slots.h"
#include "common/space/packet_attribute.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr double kContactHeight = 0.1;  // m above or below the station: farther robots fly over it
constexpr std::string_view kLights[] = {"led", "beacon"};

}  // namespace

Batteries::Batteries(const CSwarmanoidSpace& space) : space_(space)
{
  for (std::uint32_t e = 0; e < space.Size(); ++e)
  {
    if (const auto battery = BatteryView::Of(space, e)) AddRobot(e, *battery);
    if (AttributeOffset(space.GetEntity(e).GetKind(), kChargingPower) >= 0) AddStation(e);
  }
  charging_w_.resize(robots_.size());
}

void Batteries::AddRobot(std::uint32_t entity, const BatteryView& battery)
{
  const CSwarmanoidSpaceEntity& robot = space_.GetEntity(entity);
  const auto slots = [&](std::string_view name) -> Slots
  {
    const AttributeSpec* spec = FindAttribute(robot.GetKind(), name);
    if (spec == nullptr) return {0, 0};
    return {robot.SlotOf(name), static_cast<std::uint32_t>(spec->count)};
  };
  Robot added{.entity = entity,
              .battery = battery,
              .lights = {},
              .hands = slots("gripped"),
              .message_slot = kNone,
              .message_bytes = 0,
              .radio_slot = kNone};
  for (const std::string_view name : kLights)
    if (const Slots lights = slots(name); lights.count > 0) added.lights.push_back(lights);
  if (slots("message").count > 0)
  {
    added.message_slot = slots("message").first;
    added.message_bytes = MessageBytes(space_.GetExperiment(), robot.GetConfiguration());
  }
  if (slots("radio").count > 0) added.radio_slot = slots("radio").first;
  robots_.push_back(std::move(added));
}

void Batteries::AddStation(std::uint32_t entity)
{
  const CSwarmanoidSpaceEntity& station = space_.GetEntity(entity);
  const Vector3& size = station.GetSize();
  const bool has_limit = AttributeOffset(station.GetKind(), kChargingLimit) >= 0;
  // A disc of the floor has its radius in x and 0 in y; an upright cylinder has its radius in both.
  const bool is_disc = size.y() == 0 || DescriptionOf(station.GetKind()).form == BodyForm::kCylinder;
  stations_.push_back({entity, station.SlotOf(kChargingPower), has_limit ? station.SlotOf(kChargingLimit) : kNone,
                       is_disc, is_disc ? size.x() : size.x() / 2, size.y() / 2});
}

void Batteries::BeginTick()
{
  for (Robot& robot : robots_)
    if (robot.radio_slot != kNone) robot.packets_before = space_.Attributes()[robot.radio_slot];
}

bool Batteries::IsOn(const Station& station, std::uint32_t robot) const
{
  const Pose pose = space_.GetPose(station.entity);
  const Vector3 away = pose.orientation.conjugate() * (space_.GetPose(robot).position - pose.position);
  if (__builtin_fabs(away.z()) > kContactHeight) return false;
  if (station.is_disc) return away.x() * away.x() + away.y() * away.y() <= station.half_x * station.half_x;
  return __builtin_fabs(away.x()) <= station.half_x && __builtin_fabs(away.y()) <= station.half_y;
}

void Batteries::Charge()
{
  std::ranges::fill(charging_w_, 0.0);
  for (const Station& station : stations_)
  {
    if (!space_.IsPresent(station.entity)) continue;
    on_station_.clear();
    for (std::size_t k = 0; k < robots_.size(); ++k)
      if (space_.IsPresent(robots_[k].entity) && IsOn(station, robots_[k].entity)) on_station_.push_back(k);
    if (on_station_.empty()) continue;
    double power_w = std::max(space_.Attributes()[station.power_slot], 0.0);
    const double limit_w = station.limit_slot == kNone ? 0 : space_.Attributes()[station.limit_slot];
    if (limit_w > 0) power_w = std::min(power_w, limit_w / static_cast<double>(on_station_.size()));
    for (const std::size_t k : on_station_) charging_w_[k] += power_w;
  }
}

double Batteries::CountNotZero(const Slots& slots) const
{
  double count = 0;
  for (std::uint32_t slot = slots.first; slot < slots.first + slots.count; ++slot)
    count += space_.Attributes()[slot] != 0 ? 1 : 0;
  return count;
}

double Batteries::Demand(const Robot& robot) const
{
  const BatteryModel& model = robot.battery.Model();
  double lit = 0;
  for (const Slots& lights : robot.lights) lit += CountNotZero(lights);
  const SparseVector<double>& attributes = space_.Attributes();
  double bytes = 0;
  if (robot.message_slot != kNone && attributes[robot.message_slot] != 0) bytes += robot.message_bytes;
  if (robot.radio_slot != kNone)
  {
    // The count of a robot that on_failure stops goes back to 0. That is no packet.
    const double packets = attributes[robot.radio_slot];
    if (packets > 0 && packets != robot.packets_before) bytes += attributes[robot.radio_slot + 1];
  }
  return model.idle_w + model.led_w * lit + model.gripper_w * CountNotZero(robot.hands) +
         model.sent_j_per_byte * bytes / space_.GetTickSeconds() +
         attributes[robot.battery.Slot(BatterySlots::kReported)];
}

void Batteries::Advance(const Robot& robot, double charging_w, const Change& change) const
{
  const BatteryView& battery = robot.battery;
  const BatteryModel& model = battery.Model();
  const double tick_s = space_.GetTickSeconds();
  const bool draws = space_.IsPresent(robot.entity) && !battery.IsOff() &&
                     space_.Attributes()[battery.Slot(BatterySlots::kReported)] >= 0;
  const double before_j = battery.Charge_J();
  const double wanted_w = draws ? Demand(robot) : 0;
  // A station feeds the robot while it charges.
  const double used_j = std::min(wanted_w * tick_s, before_j + charging_w * tick_s);
  const double charge_j = std::clamp(before_j - used_j + charging_w * tick_s, 0.0, model.capacity_j);
  change(battery.Slot(BatterySlots::kCharge), charge_j);
  change(battery.Slot(BatterySlots::kPower), used_j == wanted_w * tick_s ? wanted_w : used_j / tick_s);
  if (!model.stops) return;
  const bool is_off = battery.IsOff() ? charge_j == 0 || charge_j < model.restart * model.capacity_j : charge_j == 0;
  change(battery.Slot(BatterySlots::kOff), is_off ? 1 : 0);
}

void Batteries::Advance(const Change& change)
{
  if (robots_.empty()) return;
  Charge();
  for (std::size_t k = 0; k < robots_.size(); ++k) Advance(robots_[k], charging_w_[k], change);
}

void Batteries::Reset(const Change& change) const
{
  for (const Robot& robot : robots_)
  {
    const std::vector<double> slots = FullBattery(robot.battery.Model());
    for (std::uint32_t part = 0; part < slots.size(); ++part) change(robot.battery.Slot(part), slots[part]);
  }
}

}  // namespace swarmanoid
