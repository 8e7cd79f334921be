// The random numbers of a device. Each robot of the batch has one stream for each disturbed quantity, and in it one for
// each other entity, blob or part. The numbers of one stream never depend on other streams. Used by the batches, in
// their thread.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/math/random.h"
#include "controller_host/device.h"
#include "controller_host/devices/noise.h"

namespace swarmanoid
{

class DeviceStreams
{
public:
  DeviceStreams() = default;
  // `quantity` distinguishes the quantities of one device: "range", "bearing". The space of the setup must outlive the
  // streams.
  explicit DeviceStreams(const DeviceSetup& setup, std::string_view quantity = {});

  // Returns the stream of robot k of the batch at the StreamTick() of the space.
  RandomStream Of(std::size_t k) const;
  // Returns the stream of robot k for `other`: StreamName(id) of another entity, or StreamPart(name, number) of a part.
  RandomStream Of(std::size_t k, std::uint64_t other) const;
  // Fills `samples` with the results of successive calls of noise.Sample with Of(k), several at a time.
  void Sample(const NoiseModel& noise, std::size_t k, std::span<double> samples) const;
  // Does the same for several robots, with equal counts and one robot after the other in `samples`. It is faster than
  // calls for single robots.
  void Sample(const NoiseModel& noise, std::span<const std::uint32_t> ks, std::span<double> samples) const;
  // Fills `samples` with one result of noise.Sample with Of(k, other) for each of `others`.
  void Sample(const NoiseModel& noise, std::size_t k, std::span<const std::uint64_t> others,
              std::span<double> samples) const;
  // Returns the stream of robot k for part `part` of the device that is drawn once for the whole run.
  RandomStream Once(std::size_t k, std::uint64_t part) const { return {Key(k), 0, part}; }

private:
  const StreamKey& Key(std::size_t k) const
  {
    if (keys_.empty()) MakeKeys();
    return keys_[k];
  }
  void MakeKeys() const;
  // Fills `numbers` with the results of successive calls of RandomStream::Centred with Of(k).
  void Draw(std::size_t k, std::span<double> numbers) const;

  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> robots_;
  std::uint64_t what_ = 0;
  mutable std::vector<StreamKey> keys_;  // by robot; made by the first draw: most devices have no noise
};

}  // namespace swarmanoid
