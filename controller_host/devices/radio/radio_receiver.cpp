// Receive the packets of all radios in range, some time after they were sent: all of them, or those that get through a
// channel that all radios share.
#include <algorithm>
#include <memory>
#include <optional>

#include "common/control_interface/ci_radio.h"
#include "common/math/elementary.h"
#include "common/space/attributes.h"
#include "common/space/packet_attribute.h"
#include "common/space/space.h"
#include "common/space/space_query.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/radio/shared_channel.h"

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
    range_ = RangeOf(setup);
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
    active_.clear();
    for (std::size_t s = 0; s < senders_.size(); ++s)
    {
      const double count = space_->Attributes()[senders_[s].slot];
      if (count == sent_[s]) continue;
      sent_[s] = count;
      // The count of a robot that on_failure stops goes back to 0. That is no packet.
      if (count > 0 && space_->IsPresent(senders_[s].entity)) active_.push_back(&senders_[s]);
    }
    SpreadAll(active_);
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

protected:
  struct Sender
  {
    std::uint32_t entity, slot;
    std::uint64_t name;
  };
  // Returns the distance (m) to which packets are looked for.
  virtual double RangeOf(const DeviceSetup& setup) { return setup.parameters.Number("range"); }
  // Sends the packets of a tick to the robots.
  virtual void SpreadAll(std::span<const Sender* const> senders)
  {
    for (const Sender* sender : senders)
      ForEachInRange(*sender,
                     [&](std::size_t k, double square_m2)
                     {
                       const double square = std::max(square_m2, kNearest * kNearest);
                       if (!IsLost(*sender, k)) Send(*sender, k, -10 / kLog10 * Log(square));
                     });
  }
  // Calls use(k, squared distance) for the robots of the batch near a sender, except itself.
  template <class Use>
  void ForEachInRange(const Sender& sender, Use use)
  {
    const Vector3 place = space_->GetPose(sender.entity).position;
    for (const std::uint32_t entity : query_->FindWithin(place, range_))
    {
      const std::int32_t place_of_robot = place_of_entity_[entity];
      if (place_of_robot < 0 || entity == sender.entity) continue;
      use(static_cast<std::size_t>(place_of_robot), (space_->GetPose(entity).position - place).squaredNorm());
    }
  }
  bool IsLost(const Sender& sender, std::size_t k) const
  {
    return loss_ > 0 && loss_streams_.Of(k, sender.name).Uniform() < loss_;
  }
  // Puts a packet on its way to robot k.
  void Send(const Sender& sender, std::size_t k, double signal_db)
  {
    if (noise_.IsActive()) signal_db += noise_.Sample(noise_streams_.Of(k, sender.name));
    flying_[k].push_back({space_->GetTick() + latency_, sender.entity, 0, signal_db,
                          UnpackedPacket(&space_->Attributes().Values()[sender.slot + 1])});
  }
  const CSwarmanoidSpace& Space() const { return *space_; }
  std::span<const std::uint32_t> RobotsOfBatch() const { return robots_; }

private:
  // A packet on its way to one robot.
  struct Flying
  {
    std::uint64_t due;  // tick
    std::uint32_t sender;
    std::uint32_t unused = 0;  // no bytes of a saved state are left to chance
    double signal;
    AttributePacket packet;
  };

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
  std::vector<const Sender*> active_;        // in this tick
  std::vector<double> sent_;                 // by sender: how many packets it had sent
  std::vector<std::vector<Flying>> flying_;  // by robot
  std::vector<RobotReceiver> receivers_;
};

// Receives what gets through a channel that all radios share.
class SharedRadioReceiver : public RadioReceiver
{
protected:
  double RangeOf(const DeviceSetup& setup) override
  {
    channel_.emplace(setup.parameters, setup.space, "radio");
    arrivals_.resize(setup.robots.size());
    for (const std::uint32_t robot : setup.robots) names_.push_back(StreamName(setup.space.GetEntity(robot).GetId()));
    return channel_->Reach();
  }
  void SpreadAll(std::span<const Sender* const> senders) override
  {
    for (auto& of_robot : arrivals_) of_robot.clear();
    for (std::size_t s = 0; s < senders.size(); ++s)
    {
      const Sender& sender = *senders[s];
      const std::uint32_t slot = channel_->SlotOf(sender.name);
      ForEachInRange(
          sender,
          [&](std::size_t k, double square_m2) {
            arrivals_[k].push_back({sender.entity, slot, channel_->Signal_dB(sender.name, names_[k], square_m2), s});
          });
    }
    for (std::size_t k = 0; k < arrivals_.size(); ++k)
    {
      if (arrivals_[k].empty()) continue;
      // The senders are in the order of the entities.
      const std::uint32_t robot = RobotsOfBatch()[k];
      const auto own = std::ranges::lower_bound(senders, robot, {}, &Sender::entity);
      std::optional<std::uint32_t> own_slot;
      if (own != senders.end() && (*own)->entity == robot) own_slot = channel_->SlotOf(names_[k]);
      channel_->Receive(arrivals_[k], own_slot);
      for (const SharedChannel::Arrival& arrival : arrivals_[k])
        if (!IsLost(*senders[arrival.index], k)) Send(*senders[arrival.index], k, arrival.signal_db);
    }
  }

private:
  std::optional<SharedChannel> channel_;
  std::vector<std::uint64_t> names_;                           // of the robots of the batch
  std::vector<std::vector<SharedChannel::Arrival>> arrivals_;  // by robot
};

}  // namespace

const DeviceCode kRadioReceiverCode(
    []
    {
      BindSensor<RadioReceiver>("radio", "generic_radio");
      BindSensor<SharedRadioReceiver>("radio", "shared_radio");
    });

}  // namespace swarmanoid
