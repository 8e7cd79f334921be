#include "controller_host/devices/device_streams.h"

namespace swarmanoid
{

DeviceStreams::DeviceStreams(const DeviceSetup& setup, std::string_view quantity)
    : space_(&setup.space),
      robots_(setup.robots),
      what_(quantity.empty() ? setup.stream : MixedBits(setup.stream ^ StreamName(quantity)))
{
}

void DeviceStreams::MakeKeys() const
{
  keys_.reserve(robots_.size());
  for (const std::uint32_t robot : robots_)
    keys_.emplace_back(space_->GetExperiment().seed, StreamName(space_->GetEntity(robot).GetId()), what_);
}

}  // namespace swarmanoid
