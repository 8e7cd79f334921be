// Receives the packets of all radios in range, some time after they were sent.
#include <algorithm>
#include <memory>

#include "common/control_interface/ci_radio.h"
#include "common/math/elementary.h"
#include "common/space/attributes.h"
#include "common/space/packet_attribute.h"
#include "common/space/query.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"

namespace swarmanoid
{
namespace
{

constexpr double kNearest = 0.01;  // m: nearer radios are as strong as there

struct RobotReceiver : public CCI_RadioSensor
{
  std::span<const Packet> GetAllPackets() const override { return packets; }
  std::vector<Packet> packets;
};

class RadioReceiver : public SensorBatch
{
public:
  void Init(const DeviceSetup& setup) override
  {
    space_ = &setup.space;
    robots_ = setup.robots;
    range_ = setup.parameters.Number("range");
    loss_ = setup.parameters.Number("loss_probability");
    const double ticks = setup.parameters.Number("latency") / setup.space.GetTickSeconds();
    latency_ = static_cast<std::uint64_t>(__builtin_ceil(ticks - 1e-9));
    noise_ = NoiseFrom(setup.parameters);
    noise_streams_ = DeviceStreams(setup, "signal");
    loss_streams_ = DeviceStreams(setup, "loss");
    query_ = std::make_unique<SpaceQuery>(setup.space);
    place_of_entity_.assign(setup.space.Size(), -1);
    for (std::size_t k = 0; k < robots_.size(); ++k) place_of_entity_[robots_[k]] = static_cast<std::int32_t>(k);
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e)
      if (const CSwarmanoidSpaceEntity& entity = setup.space.GetEntity(e);
          AttributeOffset(entity.GetKind(), "radio") >= 0)
        senders_.push_back({e, entity.SlotOf("radio"), StreamName(entity.GetId())});
    sent_.assign(senders_.size(), 0);
    receivers_.resize(robots_.size());
    flying_.resize(robots_.size());
  }
  RobotReceiver* Sensor(std::size_t k) override { return &receivers_[k]; }
  void Expose(std::size_t k, ExposedValues& values) override { values.SetList(receivers_[k].packets); }

  void Update(const ChannelView&) override
  {
    for (RobotReceiver& receiver : receivers_) receiver.packets.clear();
    for (std::size_t s = 0; s < senders_.size(); ++s)
    {
      const double count = space_->Attributes()[senders_[s].slot];
      if (count == sent_[s]) continue;
      sent_[s] = count;
      // The count of a robot that on_failure stops goes back to 0. That is no packet.
      if (count > 0 && space_->IsPresent(senders_[s].entity)) Spread(senders_[s]);
    }
    Deliver();
  }

  void SaveCommon(ByteWriter& state) const override { state.PutArray(sent_); }
  void LoadCommon(ByteReader& state) override
  {
    sent_ = state.GetArray<double>();
    if (sent_.size() != senders_.size()) throw std::runtime_error("saved state: a radio hears other robots");
  }
  void SaveState(std::size_t k, ByteWriter& state) const override { state.PutArray(flying_[k]); }
  void LoadState(std::size_t k, ByteReader& state) override { flying_[k] = state.GetArray<Flying>(); }

private:
  struct Sender
  {
    std::uint32_t entity, slot;
    std::uint64_t name;
  };
  // A packet on its way to one robot.
  struct Flying
  {
    std::uint64_t due;  // tick
    std::uint32_t sender;
    std::uint32_t unused = 0;  // no bytes of a saved state are left to chance
    double signal;
    AttributePacket packet;
  };

  void Spread(const Sender& sender)
  {
    const Vector3 place = space_->GetPose(sender.entity).position;
    const AttributePacket packet = UnpackedPacket(&space_->Attributes().Values()[sender.slot + 1]);
    for (const std::uint32_t entity : query_->FindWithin(place, range_))
    {
      const std::int32_t place_of_robot = place_of_entity_[entity];
      if (place_of_robot < 0 || entity == sender.entity) continue;
      const auto k = static_cast<std::size_t>(place_of_robot);
      if (loss_ > 0 && loss_streams_.Of(k, sender.name).Uniform() < loss_) continue;
      const double square = (space_->GetPose(entity).position - place).squaredNorm();
      double signal = -10 / kLog10 * Log(std::max(square, kNearest * kNearest));
      if (noise_.IsActive()) signal += noise_.Sample(noise_streams_.Of(k, sender.name));
      flying_[k].push_back({space_->GetTick() + latency_, sender.entity, 0, signal, packet});
    }
  }

  void Deliver()
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      std::size_t left = 0;
      for (const Flying& flying : flying_[k])
      {
        if (flying.due > space_->GetTick())
        {
          flying_[k][left++] = flying;
          continue;
        }
        if (!space_->IsPresent(robots_[k])) continue;
        CCI_RadioSensor::Packet packet{
            space_->GetEntity(flying.sender).GetId(), flying.signal, flying.packet.length, {}};
        std::copy_n(flying.packet.bytes.begin(), packet.bytes.size(), packet.bytes.begin());
        receivers_[k].packets.push_back(packet);
      }
      flying_[k].resize(left);
    }
  }

  static constexpr double kLog10 = 2.302585092994046;

  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> robots_;
  std::unique_ptr<SpaceQuery> query_;
  double range_ = 0;  // m
  double loss_ = 0;
  std::uint64_t latency_ = 0;  // ticks
  NoiseModel noise_;
  DeviceStreams noise_streams_, loss_streams_;
  std::vector<std::int32_t> place_of_entity_;
  std::vector<Sender> senders_;
  std::vector<double> sent_;                 // by sender: how many packets it had sent
  std::vector<std::vector<Flying>> flying_;  // by robot
  std::vector<RobotReceiver> receivers_;
};

}  // namespace

const DeviceCode kRadioReceiverCode([] { BindSensor<RadioReceiver>("radio", "generic_radio"); });

}  // namespace swarmanoid
