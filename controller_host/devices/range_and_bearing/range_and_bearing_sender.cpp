// Sends the bytes of range and bearing: the message is an attribute of its sender.
#include <algorithm>

#include "common/messages/range_and_bearing_message.h"
#include "controller_host/devices/builtin_devices.h"
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
  void SetMessage(const Message& message) override
  {
    values_[0] = 1;
    PackMessage(message, values_ + 1);
  }
  void StopSending() override { std::fill_n(values_, 3, 0.0); }

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    readings.push_back({"sends", "yes/no", values_[0]});
    if (values_[0] == 0) return;
    const Message message = UnpackedMessage(values_ + 1);
    for (std::size_t i = 0; i < message.size(); ++i)
      readings.push_back({"byte " + std::to_string(i), "", static_cast<double>(message[i])});
  }

private:
  double* values_;
};

class SenderBatch : public ActuatorsOf<AttributeActuator, Sender>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Bind(setup, {"message"});
    byte_noise_ = NoiseFrom(setup.parameters);
    MakeDevices();
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
    RangeAndBearingMessage message = UnpackedMessage(&ValuesOf(k)[1]);
    RandomStream random = streams_.Of(k);
    for (std::uint8_t& byte : message)
      byte = static_cast<std::uint8_t>(std::clamp(byte + byte_noise_.Sample(random) + 0.5, 0.0, 255.0));
    PackMessage(message, &ValuesOf(k)[1]);
  }

  NoiseModel byte_noise_;
};

}  // namespace

void RegisterRangeAndBearingSender() { BindActuator<SenderBatch>("range_and_bearing", "generic_range_and_bearing"); }

}  // namespace swarmanoid
