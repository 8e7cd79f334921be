#include "controller_host/battery_reports.h"

#include <algorithm>

#include "common/control_interface/ci_radio.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/space/space.h"
#include "controller_host/device.h"
#include "controller_host/device_faults.h"
#include "controller_host/powered_device.h"

namespace swarmanoid
{
namespace
{

constexpr double kSwitchedOff = -1;

// The channels of wheels have two angular velocities in rad/s.
bool IsOfWheels(const ChannelBlock& block) { return block.name == "footbot_wheels" || block.name == "wheels"; }

}  // namespace

std::unique_ptr<BatteryReports> BatteryReports::Of(const CSwarmanoidSpace& space, const HostLayout& layout)
{
  const bool has_battery = std::ranges::any_of(
      layout.robots, [&](std::uint32_t entity) { return BatteryView::Of(space, entity).has_value(); });
  return has_battery ? std::unique_ptr<BatteryReports>(new BatteryReports(space, layout)) : nullptr;
}

BatteryReports::BatteryReports(const CSwarmanoidSpace& space, const HostLayout& layout) : space_(space)
{
  for (const std::uint32_t entity : layout.robots)
  {
    batteries_.push_back(BatteryView::Of(space, entity));
    const auto& drive = DescriptionOf(space.GetEntity(entity).GetKind()).wheels;
    robots_.push_back({kNone, drive ? drive->radius_m : 0});
  }
  for (const ChannelBlock& block : layout.commands)
    if (IsOfWheels(block))
      for (std::size_t n = 0; n < block.entities.size(); ++n)
      {
        const auto robot = std::ranges::lower_bound(layout.robots, block.entities[n]) - layout.robots.begin();
        robots_[static_cast<std::size_t>(robot)].wheels = block.offset + n * static_cast<std::size_t>(block.width);
      }
}

void BatteryReports::AddPowered(std::size_t robot, const PoweredDevice* device, std::size_t k)
{
  if (device != nullptr) robots_[robot].powered.push_back({device, k});
}

void BatteryReports::Add(std::size_t robot, SensorBatch& batch, std::size_t k)
{
  if (!batteries_[robot]) return;
  AddPowered(robot, dynamic_cast<const PoweredDevice*>(&batch), k);
  if (batteries_[robot]->Model().received_j_per_byte == 0) return;
  const CCI_Sensor* const sensor = batch.Sensor(k);
  if (const auto* radio = dynamic_cast<const CCI_RadioSensor*>(sensor)) robots_[robot].radios.push_back(radio);
  if (const auto* receiver = dynamic_cast<const CCI_RangeAndBearingSensor*>(sensor))
    robots_[robot].receivers.push_back(receiver);
}

void BatteryReports::Add(std::size_t robot, ActuatorBatch& batch, std::size_t k)
{
  if (batteries_[robot]) AddPowered(robot, dynamic_cast<const PoweredDevice*>(&batch), k);
}

void BatteryReports::ReadReceivers()
{
  for (std::size_t k = 0; k < robots_.size(); ++k)
  {
    Robot& robot = robots_[k];
    robot.bytes_received = 0;
    if (!batteries_[k] || IsOff(k)) continue;
    for (const CCI_RadioSensor* radio : robot.radios)
      for (const CCI_RadioSensor::Packet& packet : radio->GetAllPackets()) robot.bytes_received += packet.length;
    for (const CCI_RangeAndBearingSensor* receiver : robot.receivers)
      for (const CCI_RangeAndBearingSensor::Packet& packet : receiver->GetAllPackets())
        robot.bytes_received += static_cast<double>(packet.message.size() + receiver->GetFurtherBytes(packet).size());
  }
}

double BatteryReports::Power(std::size_t k, std::span<const double> commands) const
{
  const Robot& robot = robots_[k];
  const BatteryModel& model = batteries_[k]->Model();
  double power_w = model.received_j_per_byte * robot.bytes_received / space_.GetTickSeconds();
  if (robot.wheels != kNone)
  {
    const double left = __builtin_fabs(commands[robot.wheels]), right = __builtin_fabs(commands[robot.wheels + 1]);
    power_w += model.wheels_j_per_m * robot.wheel_radius_m * (left + right) / 2;
  }
  for (const Powered& powered : robot.powered) power_w += powered.device->Power(powered.k);
  return power_w;
}

void BatteryReports::Report(std::span<const double> commands, const DeviceFaults* faults, AttributeChanges& changes)
{
  reports_.Clear();
  for (std::size_t k = 0; k < robots_.size(); ++k)
  {
    if (!batteries_[k]) continue;
    const std::uint32_t slot = batteries_[k]->Slot(BatterySlots::kReported);
    const bool is_off = faults != nullptr && faults->SwitchedOff(k) != nullptr;
    reports_.Add(slot, is_off ? kSwitchedOff : Power(k, commands));
  }
  ReportChanges(reports_.slots, reports_.values, space_.Attributes(), changes);
}

}  // namespace swarmanoid
