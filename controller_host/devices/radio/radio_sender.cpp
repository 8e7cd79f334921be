// Sends packets by radio, one in a tick at most and no more bytes than the bandwidth has; the others wait in a short
// queue.
#include <algorithm>
#include <stdexcept>

#include "common/control_interface/ci_radio.h"
#include "common/space/packet_attribute.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostWaiting = 16;
static_assert(CCI_RadioActuator::MAX_BYTES == kMostPacketBytes);

class Radio : public CCI_RadioActuator
{
public:
  struct Queue
  {
    std::array<AttributePacket, kMostWaiting> packets{};
    std::uint32_t first = 0, count = 0;
    double budget = MAX_BYTES;  // bytes that may be sent now
  };

  explicit Radio(double*) {}
  void SetMostWaiting(std::uint32_t most) { most_waiting_ = most; }

  bool Send(std::span<const std::uint8_t> bytes) override
  {
    if (bytes.size() > MAX_BYTES)
      throw std::length_error("a radio packet of " + std::to_string(bytes.size()) + " bytes; it has at most " +
                              std::to_string(MAX_BYTES));
    if (queue.count >= most_waiting_) return false;
    queue.packets[(queue.first + queue.count++) % kMostWaiting] = AttributePacket(bytes);
    return true;
  }
  unsigned GetWaiting() const override { return queue.count; }

  Queue queue;

private:
  std::uint32_t most_waiting_ = kMostWaiting;
};

class RadioSender : public ActuatorsOf<AttributeActuator, Radio>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Bind(setup, {"radio"});
    byte_noise_ = NoiseFrom(setup.parameters);
    bytes_per_tick_ = setup.parameters.Number("bandwidth") * setup.space.GetTickSeconds();
    MakeDevices();
    for (Radio& radio : devices_) radio.SetMostWaiting(static_cast<std::uint32_t>(setup.parameters.Integer("queue")));
  }
  void Commit(const ChannelView& channel, AttributeChanges& changes) override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
      if (space_->IsPresent(robots_[k])) Transmit(k);
    AttributeActuator::Commit(channel, changes);
  }
  // The packets that wait. The numbers of the attribute are no settings: one counts the packets sent.
  void Expose(std::size_t k, ExposedValues& values) override
  {
    values.SetList(devices_[k].queue.count, &devices_[k].queue,
                   [](void* of, std::span<const std::uint8_t> kept)
                   {
                     auto& queue = *static_cast<Radio::Queue*>(of);
                     queue.count = 0;
                     for (std::uint32_t i = 0; i < kept.size(); ++i)
                       if (kept[i] != 0)
                         queue.packets[(queue.first + queue.count++) % kMostWaiting] =
                             queue.packets[(queue.first + i) % kMostWaiting];
                   });
  }
  void SaveState(std::size_t k, ByteWriter& state) const override
  {
    AttributeActuator::SaveState(k, state);
    state.Put(devices_[k].queue);
  }
  void LoadState(std::size_t k, ByteReader& state) override
  {
    AttributeActuator::LoadState(k, state);
    devices_[k].queue = state.Get<Radio::Queue>();
  }

private:
  void Transmit(std::size_t k)
  {
    Radio::Queue& queue = devices_[k].queue;
    const bool is_limited = bytes_per_tick_ > 0;
    const bool may_send = queue.count > 0 && (!is_limited || queue.budget >= queue.packets[queue.first].length);
    if (may_send)
    {
      AttributePacket packet = queue.packets[queue.first];
      queue.first = (queue.first + 1) % kMostWaiting;
      --queue.count;
      queue.budget -= packet.length;
      if (byte_noise_.IsActive()) Disturb(packet, streams_.Of(k));
      double* values = ValuesOf(k);
      values[0] += 1;
      PackPacket(packet, values + 1);
    }
    // The unused rate is saved up to at most the longest packet.
    const double most = std::max<double>(CCI_RadioActuator::MAX_BYTES, bytes_per_tick_);
    queue.budget = is_limited ? std::min(queue.budget + bytes_per_tick_, most) : most;
  }

  void Disturb(AttributePacket& packet, RandomStream random) const
  {
    for (std::uint32_t i = 0; i < packet.length; ++i)
      packet.bytes[i] =
          static_cast<std::uint8_t>(std::clamp(packet.bytes[i] + byte_noise_.Sample(random) + 0.5, 0.0, 255.0));
  }

  NoiseModel byte_noise_;
  double bytes_per_tick_ = 0;  // 0: no limit
};

}  // namespace

const DeviceCode kRadioSenderCode([] { BindActuator<RadioSender>("radio", "generic_radio"); });

}  // namespace swarmanoid
