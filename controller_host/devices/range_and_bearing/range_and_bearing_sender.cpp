// Sends the bytes of range and bearing: the message is an attribute of its sender.
#include <algorithm>

#include "common/messages/range_and_bearing_message.h"
#include "common/space/message_slots.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class Sender : public CCI_RangeAndBearingActuator
{
public:
  explicit Sender(double* values) : values_(values) {}
  void SetNumBytes(unsigned bytes, std::size_t numbers)
  {
    bytes_ = bytes;
    numbers_ = numbers;
  }
  unsigned GetNumBytes() const override { return bytes_; }
  void SetMessage(const Message& message) override { SetBytes(message); }
  void SetBytes(std::span<const std::uint8_t> bytes) override
  {
    RequireLength(bytes.size());
    StopSending();
    values_[0] = 1;
    PackBytes(bytes, values_ + 1);
  }
  void StopSending() override { std::fill_n(values_, numbers_, 0.0); }

private:
  void ReadSettings(std::vector<double>& values) const override
  {
    std::vector<std::uint8_t> message(bytes_);
    UnpackBytes(values_ + 1, message);
    values.push_back(values_[0]);
    values.insert(values.end(), message.begin(), message.end());
  }

  double* values_;
  unsigned bytes_ = NUM_BYTES;
  std::size_t numbers_ = 3;  // with that which says whether it sends
};

class SenderBatch : public ActuatorsOf<AttributeActuator, Sender>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Bind(setup, {"message"});
    byte_noise_ = NoiseFrom(setup.parameters);
    MakeDevices();
    if (robots_.empty()) return;
    const CSwarmanoidSpaceEntity& first = setup.space.GetEntity(robots_.front());
    bytes_ = static_cast<unsigned>(MessageBytes(setup.space.GetExperiment(), first.GetConfiguration()));
    for (Sender& sender : devices_) sender.SetNumBytes(bytes_, width_);
  }
  void Commit(const ChannelView& channel, AttributeChanges& changes) override
  {
    if (!byte_noise_.IsActive()) return AttributeActuator::Commit(channel, changes);
    const std::vector<double> wanted = values_;
    for (std::size_t k = 0; k < robots_.size(); ++k)
      if (ValuesOf(k)[0] != 0) Disturb(k);
    AttributeActuator::Commit(channel, changes);
    std::copy(wanted.begin(), wanted.end(), values_.begin());
  }

private:
  void Disturb(std::size_t k)
  {
    std::vector<std::uint8_t> message(bytes_);
    UnpackBytes(&ValuesOf(k)[1], message);
    RandomStream random = streams_.Of(k);
    for (std::uint8_t& byte : message)
      byte = static_cast<std::uint8_t>(std::clamp(byte + byte_noise_.Sample(random) + 0.5, 0.0, 255.0));
    PackBytes(message, &ValuesOf(k)[1]);
  }

  NoiseModel byte_noise_;
  unsigned bytes_ = 0;  // of a message
};

}  // namespace

const DeviceCode kRangeAndBearingSenderCode(
    [] { BindActuator<SenderBatch>("range_and_bearing", "generic_range_and_bearing"); });

}  // namespace swarmanoid
