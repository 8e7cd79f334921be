// The random numbers of a device: one stream for each robot of the batch and each quantity that is disturbed, and
// within them one for each other entity, blob or part that a number is about. What is drawn for one of them never
// depends on the others. Used by the batches, in their thread.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/math/random.h"
#include "controller_host/device.h"

namespace swarmanoid
{

class DeviceStreams
{
public:
  DeviceStreams() = default;
  // `quantity` tells those of one device apart: "range", "bearing". The space of the setup must outlive the streams.
  explicit DeviceStreams(const DeviceSetup& setup, std::string_view quantity = {});

  // The stream of robot k of the batch at the StreamTick() of the space.
  RandomStream Of(std::size_t k) const;
  // What robot k draws about `whom`: StreamName(id) of another entity, StreamPart(name, number) of a part.
  RandomStream Of(std::size_t k, std::uint64_t whom) const;
  // What noise.Sample gives call by call with Of(k): several at a time.
  void Sample(const NoiseModel& noise, std::size_t k, std::span<double> samples) const;
  // The same for several robots, as many for each, one robot behind the other: faster than one robot after the other.
  void Sample(const NoiseModel& noise, std::span<const std::uint32_t> ks, std::span<double> samples) const;
  // What it gives once with Of(k, whom) for each of them.
  void Sample(const NoiseModel& noise, std::size_t k, std::span<const std::uint64_t> whoms,
              std::span<double> samples) const;
  // What robot k draws once for the whole run about part `part` of the device.
  RandomStream Once(std::size_t k, std::uint64_t part) const { return {Key(k), 0, part}; }

private:
  const StreamKey& Key(std::size_t k) const
  {
    if (keys_.empty()) MakeKeys();
    return keys_[k];
  }
  void MakeKeys() const;
  // What RandomStream::Centred gives call by call with Of(k).
  void Draw(std::size_t k, std::span<double> numbers) const;

  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> robots_;
  std::uint64_t what_ = 0;
  mutable std::vector<StreamKey> keys_;  // by robot; made by the first draw: most devices have no noise
};

}  // namespace swarmanoid
