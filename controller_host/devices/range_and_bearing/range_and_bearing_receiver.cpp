// The receivers of range and bearing, for all robots. A robot within range and line of sight of a sender gets its
// message one tick later, with the position of the sender.
#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "common/math/elementary.h"
#include "common/messages/range_and_bearing_message.h"
#include "common/space/message_slots.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/noise.h"
#include "controller_host/devices/radio/shared_channel.h"
#include "controller_host/devices/range_and_bearing/heard_senders.h"
#include "controller_host/devices/sensing/sight_lines.h"
#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint32_t kNoSlot = 0xffffffff;
constexpr std::size_t kFirstBytes = CCI_RangeAndBearingActuator::NUM_BYTES;

class Receiver : public CCI_RangeAndBearingSensor
{
public:
  // The bytes after the first ten, for senders that have more.
  using Further = std::vector<std::vector<std::uint8_t>>;

  Receiver(OnDemandSensor& batch, std::size_t k, const Further& further) : batch_(batch), k_(k), further_(further) {}
  std::span<const Packet> GetAllPackets() const override
  {
    batch_.Want(k_);
    return {packets.data(), count};
  }
  unsigned GetMostFurtherBytes() const override
  {
    std::size_t most = 0;
    for (const auto& bytes : further_) most = std::max(most, bytes.size());
    return static_cast<unsigned>(most);
  }
  std::span<const std::uint8_t> GetFurtherBytes(const Packet& packet) const override
  {
    if (packet.further == 0) return {};
    return further_.at(packet.further - 1);
  }
  Packet* MakeRoom(std::size_t room)
  {
    if (packets.size() < room) packets.resize(2 * room);
    return packets.data();
  }

  std::vector<Packet> packets;  // the first `count` of them
  std::size_t count = 0;

private:
  OnDemandSensor& batch_;
  std::size_t k_;
  const Further& further_;
};

class ReceiverBatch : public SensorBatch, public OnDemandSensor
{
public:
  void Init(const DeviceSetup& setup) override
  {
    world_ = SensorWorld::Of(setup.space);
    robots_ = setup.robots;
    loss_streams_ = DeviceStreams(setup, "loss");
    range_streams_ = DeviceStreams(setup, "range");
    bearing_streams_ = DeviceStreams(setup, "bearing");
    vertical_bearing_streams_ = DeviceStreams(setup, "vertical_bearing");
    MakeChannel(setup, channel_);
    range_ = channel_ ? channel_->Reach() : setup.parameters.Number("range");
    loss_ = setup.parameters.Number("loss_probability");
    needs_sight_ = setup.parameters.Boolean("line_of_sight");
    antenna_m_ = setup.parameters.Number("antenna");
    range_noise_ = NoiseFrom(setup.parameters, "range_");
    bearing_noise_ = NoiseFrom(setup.parameters, "bearing_");
    vertical_bearing_noise_ = NoiseFrom(setup.parameters, "vertical_bearing_");
    has_noise_ = range_noise_.IsActive() || bearing_noise_.IsActive() || vertical_bearing_noise_.IsActive();
    if (has_noise_ || loss_ > 0 || channel_) names_ = world_->Names();
    lines_ = std::make_unique<SightLines>(*world_, range_);
    InitDemand(robots_.size());
    receivers_.reserve(robots_.size());
    for (std::size_t k = 0; k < robots_.size(); ++k) receivers_.emplace_back(*this, k, further_bytes_);
    place_of_entity_.assign(setup.space.Size(), -1);
    for (std::size_t k = 0; k < robots_.size(); ++k) place_of_entity_[robots_[k]] = static_cast<std::int32_t>(k);
    message_slots_.assign(setup.space.Size(), kNoSlot);
    messages_.assign(setup.space.Size(), {});
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e)
      if (const CSwarmanoidSpaceEntity& entity = setup.space.GetEntity(e);
          Carries(entity.GetKind(), "range_and_bearing"))
      {
        message_slots_[e] = entity.SlotOf("message");
        const Experiment& experiment = setup.space.GetExperiment();
        if (const auto range = MessageRange(experiment, entity.GetConfiguration()))
        {
          square_ranges_.resize(setup.space.Size(), std::numeric_limits<double>::infinity());
          square_ranges_[e] = *range * *range;
        }
        if (FurtherMessageSlots(experiment, entity.GetConfiguration()) == 0) continue;
        const int further = MessageBytes(experiment, entity.GetConfiguration()) - static_cast<int>(kFirstBytes);
        further_bytes_.emplace_back(static_cast<std::size_t>(further));
        further_slots_.push_back(entity.SlotOf("message", 3));
        further_of_entity_.resize(setup.space.Size(), 0);
        further_of_entity_[e] = static_cast<std::uint32_t>(further_bytes_.size());
      }
  }
  Receiver* Sensor(std::size_t k) override { return &receivers_[k]; }

  void RefreshShared(WorkerPool* pool) override
  {
    world_->Refresh(pool);
    messages_are_read_ = false;
  }
  void Update(const ChannelView&) override { MakeAhead(); }
  // The antenna of a tilted robot is beside its origin, for receiver and sender.
  double Reach() const override { return range_ + 2 * antenna_m_; }
  void Expose(std::size_t k, ExposedValues& values) override
  {
    values.SetList(receivers_[k].count, &receivers_[k],
                   [](void* of, std::span<const std::uint8_t> kept)
                   {
                     auto& receiver = *static_cast<Receiver*>(of);
                     receiver.count = 0;
                     for (std::size_t i = 0; i < kept.size(); ++i)
                       if (kept[i] != 0) receiver.packets[receiver.count++] = receiver.packets[i];
                   });
  }

protected:
  // Makes the channel that all senders share; none: packets do not disturb each other.
  virtual void MakeChannel(const DeviceSetup&, std::optional<SharedChannel>&) {}

private:
  struct alignas(16) Sent
  {
    RangeAndBearingMessage bytes{};
    bool is_sent = false;
  };
  // The end of the senders that one robot hears, in the list of all.
  struct Reception
  {
    std::size_t k, behind;
  };

  void MakeDue() override
  {
    ReadMessages();
    // The order is that of the grid's cells, so that neighbours stay in the cache. Every robot has a body.
    for (const std::uint32_t entity : world_->Grid().Sorted())
      if (const std::int32_t k = place_of_entity_[entity]; k >= 0 && IsDue(static_cast<std::size_t>(k)))
        Receive(static_cast<std::size_t>(k));
    Deliver();
  }
  bool MakeAlone(std::size_t k) override
  {
    ReadMessages();
    Receive(k);
    Deliver();
    return true;
  }

  void ReadMessages()
  {
    if (std::exchange(messages_are_read_, true)) return;
    const SparseVector<double>& attributes = world_->Space().Attributes();
    const std::span<const std::uint32_t> senders = world_->Grid().Sorted();
    std::size_t sent = 0;
    for (std::size_t place = 0; place < senders.size(); ++place)
    {
      const std::uint32_t slot = message_slots_[senders[place]];
      Sent& message = messages_[place];
      message.is_sent = slot != kNoSlot && attributes[slot] != 0;
      sent += message.is_sent;
      if (message.is_sent) message.bytes = UnpackedMessage(&attributes.Values()[slot + 1]);
      const std::uint32_t further = FurtherOf(senders[place]);
      if (message.is_sent && further != 0)
        UnpackBytes(&attributes.Values()[further_slots_[further - 1]], further_bytes_[further - 1]);
    }
    all_send_ = sent == senders.size();
    look_at_all_ = 2 * sent > senders.size() && world_->Grid().AllUpright() && needs_sight_ && square_ranges_.empty();
  }

  Vector3 AntennaOf(std::uint32_t robot) const
  {
    const PoseArrays& poses = world_->Space().Poses();
    if (IsUpright(poses, robot)) return {poses.x[robot], poses.y[robot], poses.z[robot] + antenna_m_};
    return world_->Space().GetPose(robot).Apply({0, 0, antenna_m_});
  }

  void Receive(std::size_t k)
  {
    const CSwarmanoidSpace& space = world_->Space();
    const std::uint32_t robot = robots_[k];
    const std::size_t first = heard_.count;
    antenna_ = AntennaOf(robot);
    lines_->LookFrom(robot, antenna_, range_);
    heard_.Reserve(lines_->PlacesAround().size());
    if (look_at_all_)
    {
      const std::span<const std::int32_t> seen = PlacesSeen();
      if (loss_ == 0 && !channel_)
      {
        const PoseArrays& poses = space.Poses();
        heard_.Add(seen.size(), world_->Grid(), {poses.x[robot], poses.y[robot], poses.z[robot]},
                   HeadingOf(poses, robot));
        return Close(k);
      }
      Listen(seen, robot);
    }
    else
      ListenThenLook(robot);

    if (channel_)
    {
      KeepSenders(first);
      KeepReceived(first, robot);
    }
    if (loss_ > 0)
    {
      KeepSenders(first);
      KeepOnly(first, [&](std::size_t i) { return loss_streams_.Of(k, SenderOf(i)).Uniform() >= loss_; });
    }
    if (IsUpright(space.Poses(), robot))
      heard_.Turn(first, HeadingOf(space.Poses(), robot));
    else
      heard_.Turn(first, space.GetPose(robot).orientation.toRotationMatrix().transpose());

    Close(k);
  }
  // No more are heard by this one.
  void Close(std::size_t k)
  {
    receptions_.push_back({k, heard_.count});
    constexpr std::size_t kManyAtATime = 128;
    if (heard_.count >= kManyAtATime) Deliver();
  }

  // Checks lines of sight before range. This is faster if most robots send and many hide each other. The places are
  // written behind the list.
  std::span<const std::int32_t> PlacesSeen()
  {
    lines_->LookAtBodiesAround();
    const SeenPoints& seen = lines_->Solve();
    const std::span<const std::int32_t> around = lines_->PlacesAround();
    std::int32_t* const places = heard_.At().place + heard_.count;
    std::size_t count = 0;
    for (std::size_t i = 0; i < around.size(); i += kLanes)
    {
      const Selection selection(seen.Group(i));
      selection.Store(LoadLanes(&around[i]), places + count);
      count += selection.Count();
    }
    return {places, count};
  }

  void ListenThenLook(std::uint32_t robot)
  {
    const std::size_t first = heard_.count;
    Listen(lines_->PlacesAround(), robot);
    KeepSenders(first);
    if (!needs_sight_) return;
    const HeardSenders::Lanes& at = heard_.At();
    for (std::size_t i = first; i < heard_.count; ++i)
      lines_->AddPoint({at.x[i], at.y[i], at.z[i]}, world_->Grid().Sorted()[static_cast<std::size_t>(at.place[i])]);
    const SeenPoints& seen = lines_->Solve();
    KeepOnly(first, [&](std::size_t i) { return seen[i - first]; });
  }

  // Adds the senders at these places. The places may be in the memory that is written.
  void Listen(std::span<const std::int32_t> places, std::uint32_t robot)
  {
    const NeighbourGrid& grid = world_->Grid();
    const HeardSenders::Lanes& at = heard_.At();
    std::int32_t* const place = at.place + heard_.count;
    double* const x = at.x + heard_.count;
    double* const y = at.y + heard_.count;
    double* const z = at.z + heard_.count;
    heard_.count += places.size();
    if (!grid.AllUpright())
    {
      for (std::size_t i = 0; i < places.size(); ++i)
      {
        const Vector3 way = AntennaOf(grid.Sorted()[static_cast<std::size_t>(places[i])]) - antenna_;
        place[i] = places[i];
        x[i] = way.x();
        y[i] = way.y();
        z[i] = way.z();
      }
      return;
    }
    const double* const origin_x = grid.OriginX();
    const double* const origin_y = grid.OriginY();
    const double* const origin_z = grid.OriginZ();
    const PoseArrays& poses = world_->Space().Poses();
    const double own_x = poses.x[robot], own_y = poses.y[robot], own_z = poses.z[robot];
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const auto p = static_cast<std::uint32_t>(places[i]);
      place[i] = places[i];
      x[i] = origin_x[p] - own_x;
      y[i] = origin_y[p] - own_y;
      z[i] = origin_z[p] - own_z;
    }
  }

  // Removes the senders from `first` on for which keep(i) is false.
  template <class Keep>
  void KeepOnly(std::size_t first, Keep&& keep)
  {
    std::size_t kept = first;
    for (std::size_t i = first; i < heard_.count; ++i)
      if (keep(i)) heard_.Move(i, kept++);
    heard_.count = kept;
  }
  // Keeps the robots that send and are near enough, by the ranges of the receiver and the sender.
  void KeepSenders(std::size_t first)
  {
    const HeardSenders::Lanes& at = heard_.At();
    KeepOnly(first,
             [&](std::size_t i)
             {
               const double square = at.x[i] * at.x[i] + at.y[i] * at.y[i] + at.z[i] * at.z[i];
               const auto place = static_cast<std::size_t>(at.place[i]);
               return messages_[place].is_sent && square <= range_ * range_ &&
                      (square_ranges_.empty() || square <= square_ranges_[world_->Grid().Sorted()[place]]);
             });
  }

  // Keeps the senders from `first` on whose packets get through the channel.
  void KeepReceived(std::size_t first, std::uint32_t robot)
  {
    const HeardSenders::Lanes& at = heard_.At();
    arrivals_.clear();
    for (std::size_t i = first; i < heard_.count; ++i)
    {
      const double square = at.x[i] * at.x[i] + at.y[i] * at.y[i] + at.z[i] * at.z[i];
      const std::uint64_t sender = SenderOf(i);
      arrivals_.push_back({world_->Grid().Sorted()[static_cast<std::size_t>(at.place[i])], channel_->SlotOf(sender),
                           channel_->Signal_dB(sender, names_[robot], square), i});
    }
    const std::uint32_t slot = message_slots_[robot];
    const bool sends = slot != kNoSlot && world_->Space().Attributes()[slot] != 0;
    channel_->Receive(arrivals_, sends ? std::optional(channel_->SlotOf(names_[robot])) : std::nullopt);
    std::ranges::sort(arrivals_, {}, &SharedChannel::Arrival::index);
    std::size_t kept = first;
    for (const SharedChannel::Arrival& arrival : arrivals_) heard_.Move(arrival.index, kept++);
    heard_.count = kept;
  }

  // Makes the packets of all robots that have listened since the last call.
  void Deliver()
  {
    heard_.Measure(world_->Grid().AllUpright() && world_->Grid().AllLevel());
    std::size_t first = 0;
    for (const Reception& reception : receptions_)
    {
      if (all_send_)
        MakePackets<true>(receivers_[reception.k], first, reception.behind);
      else
        MakePackets<false>(receivers_[reception.k], first, reception.behind);
      if (!further_bytes_.empty()) AddFurther(reception.k, first, reception.behind);
      if (has_noise_) AddNoise(reception.k, first, reception.behind);
      first = reception.behind;
    }
    receptions_.clear();
    heard_.count = 0;
  }

  // Makes a packet of each robot in the list that sends and is near enough.
  template <bool kAllSend>
  void MakePackets(Receiver& receiver, std::size_t first, std::size_t behind) const
  {
    CCI_RangeAndBearingSensor::Packet* const packets = receiver.MakeRoom(behind - first);
    const HeardSenders::Lanes from = heard_.At();
    const Sent* const sent = messages_.data();
    const double largest = range_ * range_;
    std::size_t count = 0;
    for (std::size_t i = first; i < behind; ++i)
    {
      CCI_RangeAndBearingSensor::Packet& packet = packets[count];
      const Sent& message = sent[from.place[i]];
      packet.range_m = from.range[i];
      packet.bearing_rad = from.bearing[i];
      packet.vertical_bearing_rad = from.elevation[i];
      packet.message = message.bytes;
      count += static_cast<std::size_t>((kAllSend || message.is_sent) & (from.square[i] <= largest));
    }
    receiver.count = count;
  }

  // Returns 1 + the number of the sender's further bytes in the list, or 0 if it has none.
  std::uint32_t FurtherOf(std::uint32_t entity) const
  {
    return further_of_entity_.empty() ? 0 : further_of_entity_[entity];
  }

  // Adds the further bytes to the packets that MakePackets made of the same senders.
  void AddFurther(std::size_t k, std::size_t first, std::size_t behind)
  {
    const HeardSenders::Lanes& from = heard_.At();
    const double largest = range_ * range_;
    std::size_t count = 0;
    for (std::size_t i = first; i < behind; ++i)
    {
      const auto place = static_cast<std::size_t>(from.place[i]);
      if (messages_[place].is_sent && from.square[i] <= largest)
        receivers_[k].packets[count++].further = FurtherOf(world_->Grid().Sorted()[place]);
    }
  }

  // Returns the stream name of a sender in the list.
  std::uint64_t SenderOf(std::size_t i) const
  {
    return names_[world_->Grid().Sorted()[static_cast<std::size_t>(heard_.At().place[i])]];
  }

  // Adds noise to the packets that MakePackets made of the same senders.
  void AddNoise(std::size_t k, std::size_t first, std::size_t behind)
  {
    const HeardSenders::Lanes& from = heard_.At();
    const double largest = range_ * range_;
    senders_.clear();
    for (std::size_t i = first; i < behind; ++i)
      if (messages_[static_cast<std::size_t>(from.place[i])].is_sent && from.square[i] <= largest)
        senders_.push_back(SenderOf(i));
    samples_.resize(senders_.size());
    CCI_RangeAndBearingSensor::Packet* const packets = receivers_[k].packets.data();
    const auto disturb = [&](const NoiseModel& noise, const DeviceStreams& streams, const auto& add)
    {
      if (!noise.IsActive()) return;
      streams.Sample(noise, k, senders_, samples_);
      for (std::size_t i = 0; i < samples_.size(); ++i) add(packets[i], samples_[i]);
    };
    using Packet = CCI_RangeAndBearingSensor::Packet;
    disturb(range_noise_, range_streams_,
            [](Packet& packet, double noise) { packet.range_m = std::max(packet.range_m + noise, 0.0); });
    disturb(bearing_noise_, bearing_streams_,
            [](Packet& packet, double noise) { packet.bearing_rad = WrapAngle(packet.bearing_rad + noise); });
    disturb(vertical_bearing_noise_, vertical_bearing_streams_,
            [](Packet& packet, double noise)
            { packet.vertical_bearing_rad = std::clamp(packet.vertical_bearing_rad + noise, -kPi / 2, kPi / 2); });
  }

  std::shared_ptr<SensorWorld> world_;
  std::unique_ptr<SightLines> lines_;
  std::vector<std::uint32_t> robots_;
  std::span<const std::uint64_t> names_;  // of the entities for random streams; empty if none are drawn
  bool has_noise_ = false;
  DeviceStreams loss_streams_, range_streams_, bearing_streams_, vertical_bearing_streams_;
  double range_ = 0, loss_ = 0;
  bool needs_sight_ = true;
  double antenna_m_ = 0;               // above the base of a robot
  std::vector<double> square_ranges_;  // of senders, m², by entity; empty if no sender has a range
  NoiseModel range_noise_, bearing_noise_, vertical_bearing_noise_;
  std::vector<std::uint32_t> message_slots_;  // by entity
  Receiver::Further further_bytes_;
  std::vector<std::uint32_t> further_slots_;      // the first one of each
  std::vector<std::uint32_t> further_of_entity_;  // empty if no sender has further bytes
  std::vector<Sent> messages_;                    // by place in the grid, of this tick
  bool messages_are_read_ = false;                // in this tick
  std::vector<std::int32_t> place_of_entity_;     // k of an entity, or -1
  std::optional<SharedChannel> channel_;
  std::vector<SharedChannel::Arrival> arrivals_;  // scratch
  bool look_at_all_ = false;
  bool all_send_ = false;
  Vector3 antenna_ = Vector3::Zero();
  HeardSenders heard_;
  std::vector<Reception> receptions_;
  std::vector<std::uint64_t> senders_;  // of packets that are disturbed, by name
  std::vector<double> samples_;
  std::vector<Receiver> receivers_;
};

class SharedReceiverBatch : public ReceiverBatch
{
protected:
  void MakeChannel(const DeviceSetup& setup, std::optional<SharedChannel>& channel) override
  {
    channel.emplace(setup.parameters, setup.space, "range and bearing");
  }
};

}  // namespace

const DeviceCode kRangeAndBearingReceiverCode(
    []
    {
      BindSensor<ReceiverBatch>("range_and_bearing", "generic_range_and_bearing");
      BindSensor<SharedReceiverBatch>("range_and_bearing", "shared_range_and_bearing");
    });

}  // namespace swarmanoid
