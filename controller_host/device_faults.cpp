// A fault is a function of the experiment, the tick, the robot, the values of its device and, for stuck, drop and
// delay, earlier values. Devices expose their numbers and lists (ExposedValues); the columns of their interfaces say
// which numbers are quantities, and their ranges.
//
// Invariants: random numbers are named by the fault, the robot, the device and the tick. What is remembered depends on
// the ticks since the fault began alone, so that saved states need no further counters. Ticks count from the latest
// BeginAgain, as for random numbers.
#include "controller_host/device_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/configuration/configuration_tree.h"
#include "common/space/space.h"
#include "controller_host/device.h"
#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{
namespace
{

using enum DeviceFaultKind;

bool ChangesQuantities(DeviceFaultKind kind) { return kind == kScale || kind == kBias || kind == kNoise; }

bool IsQuantity(const CCI_Column& column)
{
  if (column.unit == "colour" || column.unit == "yes/no") return false;
  return !column.unit.empty() || std::isfinite(column.minimum) || std::isfinite(column.maximum);
}

}  // namespace

DeviceFaults::DeviceFaults(const CSwarmanoidSpace& space, std::size_t robots)
    : space_(space), switched_off_(robots, nullptr)
{
}

std::uint64_t DeviceFaults::Tick() const { return space_.GetTick() - space_.FirstTick(); }

void DeviceFaults::Begin(const FaultConfiguration& fault) { rows_.push_back({.fault = &fault}); }

void DeviceFaults::BeginEmptyBatteries(const FaultConfiguration& fault, std::function<bool(std::size_t)> is_off)
{
  rows_.push_back({.fault = &fault, .is_off = std::move(is_off)});
}

void DeviceFaults::Expose(const Device& device)
{
  values_.Clear();
  if (device.sensor != nullptr)
    device.sensor->Expose(device.k, values_);
  else
    device.actuator->Expose(device.k, values_);
}

std::vector<DeviceFaults::Column> DeviceFaults::ColumnsOf(const Device& device) const
{
  const std::vector<CCI_Column> columns = device.sensor != nullptr ? device.sensor->Sensor(device.k)->Columns()
                                                                   : device.actuator->Actuator(device.k)->Columns();
  std::vector<Column> known(values_.Numbers().size(), {false, 0, 0});
  // Settings are set by their columns, which must be all numbers of the device.
  if (columns.size() > known.size() || (device.actuator != nullptr && columns.size() != known.size())) return known;
  for (std::size_t i = 0; i < columns.size(); ++i)
    known[i] = {IsQuantity(columns[i]), columns[i].minimum, columns[i].maximum};
  return known;
}

std::size_t DeviceFaults::RememberedTicks(const FaultConfiguration& fault)
{
  if (fault.kind == kDelay) return static_cast<std::size_t>(fault.value);
  return fault.kind == kStuck || fault.kind == kDrop ? 1 : 0;
}

void DeviceFaults::Add(const Device& device, std::uint32_t entity, const DeviceConfiguration& configuration)
{
  Row& row = rows_.back();
  const FaultConfiguration& fault = *row.fault;
  Expose(device);
  const char* const what = device.sensor != nullptr ? "sensor" : "actuator";
  const auto refuse = [&](const std::string& reason)
  {
    throw ConfigurationError(fault.location,
                             fmt::format("the fault '{}' cannot change the {} <{}> ({}): {}", fault.id, what,
                                         configuration.type, configuration.implementation, reason));
  };
  const std::size_t count = values_.Numbers().size();
  if (count == 0 && !values_.HasList())
    refuse(std::string("it does not show its values; its class must override Expose") +
           (row.is_off ? ", or the battery has empty=\"ignore\"" : ", or name other devices"));
  const std::string named = fault.device.empty() ? "; name the devices of the fault one by one" : "";
  if (values_.HasList() && fault.kind != kDead && fault.kind != kOff && fault.kind != kDrop)
    refuse(fmt::format("it has a list, for which there is no '{}'; choose dead or drop{}", fault.kind_name, named));
  auto& targets = device.sensor != nullptr ? row.sensors : row.actuators;
  // Robots of a batch share the columns. The robot before is near the end.
  const auto same = std::find_if(targets.rbegin(), targets.rend(),
                                 [&](const Target& other) {
                                   return other.device.sensor == device.sensor &&
                                          other.device.actuator == device.actuator && other.count == count;
                                 });
  const std::size_t first = same != targets.rend() ? same->columns : columns_.size();
  if (same == targets.rend())
    for (const Column& column : ColumnsOf(device)) columns_.push_back(column);
  const std::span<const Column> columns(columns_.data() + first, count);
  if (ChangesQuantities(fault.kind) && std::ranges::none_of(columns, &Column::is_quantity))
    refuse(fmt::format("it has no numbers for '{}'; choose dead, stuck, delay or drop{}", fault.kind_name, named));

  const std::uint64_t stream =
      device.sensor != nullptr ? SensorStream(configuration.type) : ActuatorStream(configuration.type);
  const StreamKey key(space_.GetExperiment().seed, StreamName(space_.GetEntity(entity).GetId()),
                      MixedBits(stream ^ StreamName("fault " + fault.id)));
  const std::size_t length = RememberedTicks(fault) * count;
  targets.push_back({device, entity, key, first, count, memory_.size(), length});
  memory_.resize(memory_.size() + length);
}

template <class Change>
void DeviceFaults::ForEachTarget(std::vector<Target> Row::*targets, Change change)
{
  const std::uint64_t tick = Tick();
  for (Row& row : rows_)
  {
    // A sample lost in the first tick leaves the one before, which is remembered then.
    const bool comes = row.fault->kind == kDrop && tick + 1 == row.fault->from;
    if (!row.is_off && !row.fault->IsActive(tick) && !comes) continue;
    for (const Target& target : row.*targets)
      if (space_.IsPresent(target.entity) && (!row.is_off || row.is_off(target.device.robot)))
        change(*row.fault, target, tick);
  }
}

void DeviceFaults::ChangeNumbers(const FaultConfiguration& fault, const Target& target, std::uint64_t tick)
{
  const std::span<const ExposedValues::Number> numbers = values_.Numbers();
  if (numbers.size() != target.count) throw std::logic_error("a device shows other numbers than before");
  now_.clear();
  for (const ExposedValues::Number& number : numbers) now_.push_back(*number.place);
  const std::span<const Column> columns(columns_.data() + target.columns, target.count);
  double* const memory = memory_.data() + target.memory;
  RandomStream random(target.key, space_.StreamTick());
  // Infinity means that nothing was found.
  const auto change_quantities = [&](auto change)
  {
    for (std::size_t i = 0; i < now_.size(); ++i)
      if (columns[i].is_quantity && std::isfinite(now_[i]))
        now_[i] = std::clamp(change(now_[i]), columns[i].minimum, columns[i].maximum);
  };
  switch (fault.kind)
  {
    case kDead:
    case kOff:
      for (std::size_t i = 0; i < now_.size(); ++i) now_[i] = numbers[i].when_dead;
      return;
    case kScale:
      return change_quantities([&](double number) { return number * fault.value; });
    case kBias:
      return change_quantities([&](double number) { return number + fault.value; });
    case kNoise:
      return change_quantities(
          [&](double number)
          {
            // An actuator that is not used stands still, as with other noise.
            const double noise = random.Gaussian(0, fault.value);
            return number == 0 && target.device.actuator != nullptr ? 0 : number + noise;
          });
    case kStuck:
      if (tick == fault.from)
        std::ranges::copy(now_, memory);
      else
        std::copy_n(memory, now_.size(), now_.begin());
      return;
    case kDrop:
    {
      if (tick == 0) std::fill_n(memory, now_.size(), 0.0);
      const bool arrives = !fault.IsActive(tick) || random.Uniform() >= fault.value;
      if (arrives)
        std::ranges::copy(now_, memory);
      else
        std::copy_n(memory, now_.size(), now_.begin());
      return;
    }
    case kDelay:
    {
      const auto ticks = static_cast<std::uint64_t>(fault.value);
      const std::uint64_t since = tick - fault.from;
      double* const slot = memory + since % ticks * now_.size();
      // Until the first values arrive, those of the first tick stay.
      if (since < ticks)
      {
        std::ranges::copy(now_, slot);
        std::copy_n(memory, now_.size(), now_.begin());
        return;
      }
      std::swap_ranges(now_.begin(), now_.end(), slot);
      return;
    }
  }
}

void DeviceFaults::ChangeList(const FaultConfiguration& fault, RandomStream& random)
{
  kept_.assign(values_.Length(), 0);
  if (fault.kind == kDrop)
    for (std::uint8_t& kept : kept_) kept = random.Uniform() >= fault.value;
  values_.KeepEntries(kept_);
}

void DeviceFaults::ChangeReadings()
{
  ForEachTarget(&Row::sensors,
                [this](const FaultConfiguration& fault, const Target& target, std::uint64_t tick)
                {
                  if (target.device.on_demand != nullptr) target.device.on_demand->Want(target.device.k);
                  Expose(target.device);
                  if (values_.HasList())
                  {
                    RandomStream random(target.key, space_.StreamTick(), StreamName("list"));
                    if (fault.IsActive(tick)) ChangeList(fault, random);
                  }
                  ChangeNumbers(fault, target, tick);
                  for (std::size_t i = 0; i < now_.size(); ++i) *values_.Numbers()[i].place = now_[i];
                });
}

void DeviceFaults::ChangeSettings()
{
  ForEachTarget(&Row::actuators,
                [this](const FaultConfiguration& fault, const Target& target, std::uint64_t tick)
                {
                  Expose(target.device);
                  if (values_.HasList())
                  {
                    RandomStream random(target.key, space_.StreamTick(), StreamName("list"));
                    if (fault.IsActive(tick)) ChangeList(fault, random);
                  }
                  for (const ExposedValues::Number& number : values_.Numbers())
                    settings_.emplace_back(number.place, *number.place);
                  ChangeNumbers(fault, target, tick);
                  // The device keeps quantities within its limits.
                  if (ChangesQuantities(fault.kind))
                    return target.device.actuator->Actuator(target.device.k)->SetColumns(now_);
                  for (std::size_t i = 0; i < now_.size(); ++i) *values_.Numbers()[i].place = now_[i];
                });
}

void DeviceFaults::RestoreSettings()
{
  // Several faults may have changed one setting.
  for (auto setting = settings_.rbegin(); setting != settings_.rend(); ++setting) *setting->first = setting->second;
  settings_.clear();
}

bool DeviceFaults::SwitchRobots()
{
  const std::uint64_t tick = Tick();
  bool may_switch = false;
  for (Row& row : rows_)
  {
    if (row.off.empty()) continue;
    const bool is_active = row.fault->IsActive(tick);
    may_switch |= row.is_off || is_active != row.is_active;
    row.is_active = is_active;
  }
  if (!may_switch) return false;
  off_before_ = switched_off_;
  std::ranges::fill(switched_off_, nullptr);
  for (const Row& row : rows_)
    for (const std::size_t robot : row.off)
      if (row.is_off ? row.is_off(robot) : row.is_active) switched_off_[robot] = row.fault;
  return switched_off_ != off_before_;
}

void DeviceFaults::SaveState(std::span<ByteWriter> states) const
{
  for (const Row& row : rows_)
    for (const auto* targets : {&row.sensors, &row.actuators})
      for (const Target& target : *targets)
        for (std::size_t i = 0; i < target.memory_length; ++i)
          states[target.device.robot].Put(memory_[target.memory + i]);
}

void DeviceFaults::LoadState(std::span<ByteReader> states)
{
  for (const Row& row : rows_)
    for (const auto* targets : {&row.sensors, &row.actuators})
      for (const Target& target : *targets)
        for (std::size_t i = 0; i < target.memory_length; ++i)
          memory_[target.memory + i] = states[target.device.robot].Get<double>();
}

}  // namespace swarmanoid
