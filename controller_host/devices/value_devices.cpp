#include "controller_host/devices/value_devices.h"

#include <algorithm>

#include "common/messages/attribute_changes.h"
#include "common/space/attributes.h"
#include "common/space/message_slots.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"

namespace swarmanoid
{
namespace
{

// Returns all slots of some attributes, robot after robot.
std::vector<std::uint32_t> SlotsOf(const DeviceSetup& setup, const std::vector<std::string>& attributes)
{
  std::vector<std::uint32_t> slots;
  for (const std::uint32_t robot : setup.robots)
  {
    const CSwarmanoidSpaceEntity& entity = setup.space.GetEntity(robot);
    for (const AttributeSpec& spec : AttributesOf(entity.GetKind()))
      if (std::find(attributes.begin(), attributes.end(), spec.name) != attributes.end())
        for (int element = 0; element < spec.count; ++element) slots.push_back(entity.SlotOf(spec.name, element));
    if (std::find(attributes.begin(), attributes.end(), "message") == attributes.end()) continue;
    const int first = FindAttribute(entity.GetKind(), "message")->count;
    const int further = FurtherMessageSlots(setup.space.GetExperiment(), entity.GetConfiguration());
    for (int element = first; element < first + further; ++element) slots.push_back(entity.SlotOf("message", element));
  }
  return slots;
}

}  // namespace

void DeviceValues::Reset(const DeviceSetup& setup, std::size_t width)
{
  space_ = &setup.space;
  robots_ = setup.robots;
  streams_ = DeviceStreams(setup);
  width_ = width;
  values_.assign(robots_.size() * width, 0);
}

void ValueActuator::SaveState(std::size_t k, ByteWriter& state) const
{
  for (std::size_t i = 0; i < width_; ++i) state.Put(values_[k * width_ + i]);
}

void ValueActuator::LoadState(std::size_t k, ByteReader& state)
{
  for (std::size_t i = 0; i < width_; ++i) ValuesOf(k)[i] = state.Get<double>();
}

void ChannelActuator::Commit(const ChannelView& channel, AttributeChanges&)
{
  for (std::size_t k = 0; k < robots_.size(); ++k)
  {
    const double* values = ValuesOf(k);
    double* target = &channel.values[channel.offsets[k] + first_];
    std::copy_n(values, width_, target);
    if (!noise_.IsActive()) continue;
    RandomStream random = streams_.Of(k);
    for (std::size_t i = 0; i < width_; ++i)
    {
      const double noise = noise_.Sample(random);
      if (target[i] != 0) target[i] = std::clamp(target[i] + noise, least_, most_);
    }
  }
}

void AttributeActuator::Bind(const DeviceSetup& setup, const std::vector<std::string>& attributes)
{
  slots_ = SlotsOf(setup, attributes);
  Reset(setup, setup.robots.empty() ? 0 : slots_.size() / setup.robots.size());
  for (std::size_t i = 0; i < slots_.size(); ++i) values_[i] = setup.space.Attributes()[slots_[i]];
}

void AttributeActuator::Commit(const ChannelView&, AttributeChanges& changes)
{
  if (colour_noise_.IsActive()) return CommitWithNoise(changes);
  ReportChanges(slots_, values_, space_->Attributes(), changes);
}

void AttributeActuator::CommitWithNoise(AttributeChanges& changes) const
{
  std::vector<double> shown(values_.size());
  for (std::size_t k = 0; k < robots_.size(); ++k)
  {
    const std::span<const double> wanted(&values_[k * width_], width_);
    for (std::size_t i = 0; i < width_; ++i)
    {
      // LEDs that were set to one colour keep one colour after noise, since cameras make one blob of them.
      const auto same = static_cast<std::size_t>(std::find(wanted.begin(), wanted.end(), wanted[i]) - wanted.begin());
      double* its = &shown[k * width_];
      its[i] =
          same < i ? its[same] : Disturbed(static_cast<std::uint32_t>(wanted[i]), streams_.Of(k, StreamPart(0, i)));
    }
  }
  ReportChanges(slots_, shown, space_->Attributes(), changes);
}

std::uint32_t AttributeActuator::Disturbed(std::uint32_t colour, RandomStream random) const
{
  if (colour == 0) return 0;
  std::uint32_t disturbed = 0;
  for (const int shift : {16, 8, 0})
  {
    const double part = (colour >> shift & 0xff) + colour_noise_.Sample(random);
    disturbed |= static_cast<std::uint32_t>(std::clamp(part + 0.5, 0.0, 255.0)) << shift;
  }
  return disturbed;
}

void ValueSensor::AddNoise()
{
  if (!noise_.IsActive()) return;
  while (all_.size() < robots_.size()) all_.push_back(static_cast<std::uint32_t>(all_.size()));
  AddNoise(all_);
}

void ValueSensor::AddNoise(std::size_t k)
{
  const auto number = static_cast<std::uint32_t>(k);
  AddNoise({&number, 1});
}

void ValueSensor::AddNoise(std::span<const std::uint32_t> ks)
{
  constexpr std::size_t kAtOnce = 16;  // robots, whose samples stay in the cache
  for (std::size_t first = 0; first < ks.size(); first += kAtOnce)
  {
    const auto some = ks.subspan(first, std::min(kAtOnce, ks.size() - first));
    samples_.resize(some.size() * width_);
    streams_.Sample(noise_, some, samples_);
    const double* sample = samples_.data();
    for (const std::uint32_t k : some)
      for (std::size_t i = 0; i < width_; ++i) ValuesOf(k)[i] += *sample++;
  }
}

void ChannelSensor::Update(const ChannelView& channel)
{
  for (std::size_t k = 0; k < robots_.size(); ++k)
    std::copy_n(&channel.values[channel.offsets[k]], width_, ValuesOf(k));
  AddNoise();
}

void AttributeSensor::Bind(const DeviceSetup& setup, const std::vector<std::string>& attributes)
{
  slots_ = SlotsOf(setup, attributes);
  Reset(setup, setup.robots.empty() ? 0 : slots_.size() / setup.robots.size());
}

void AttributeSensor::Update(const ChannelView&)
{
  const SparseVector<double>& attributes = space_->Attributes();
  for (std::size_t i = 0; i < slots_.size(); ++i) values_[i] = attributes[slots_[i]];
  AddNoise();
}

}  // namespace swarmanoid
