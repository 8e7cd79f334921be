// Range and bearing of all robots: the message is an attribute of its sender; receivers within range and in line of
// sight get it one tick later with the place of the sender.
#include <algorithm>
#include <memory>

#include "common/control_interface/ci_range_and_bearing.h"
#include "common/math/elementary.h"
#include "controller_host/devices/builtin_devices.h"
#include "controller_host/devices/device_kit.h"
#include "controller_host/devices/sight_lines.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kHalf = CCI_RangeAndBearingActuator::NUM_BYTES / 2;
constexpr double kAntennaHeight = 0.1;  // m above the base (ARGoS3, foot-bot)
constexpr std::uint32_t kNoSlot = 0xffffffff;

// Five bytes as one number, the first one highest: exact in a double.
double Packed(const std::uint8_t* bytes)
{
  std::int64_t number = 0;
  for (std::size_t i = 0; i < kHalf; ++i) number = number << 8 | bytes[i];
  return static_cast<double>(number);
}

void Unpack(double value, std::uint8_t* bytes)
{
  const auto number = static_cast<std::int64_t>(value);
  for (std::size_t i = 0; i < kHalf; ++i) bytes[i] = static_cast<std::uint8_t>(number >> (8 * (kHalf - 1 - i)));
}

class Sender : public CCI_RangeAndBearingActuator
{
public:
  explicit Sender(double* values) : values_(values) {}
  void SetMessage(const Message& message) override
  {
    values_[0] = 1;
    values_[1] = Packed(message.data());
    values_[2] = Packed(message.data() + kHalf);
  }
  void StopSending() override { std::fill_n(values_, 3, 0.0); }

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    readings.push_back({"sends", "yes/no", values_[0]});
    if (values_[0] == 0) return;
    Message message{};
    Unpack(values_[1], message.data());
    Unpack(values_[2], message.data() + kHalf);
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
    stream_ = ActuatorStream(setup.stream);
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
    CCI_RangeAndBearingActuator::Message message;
    Unpack(ValuesOf(k)[1], message.data());
    Unpack(ValuesOf(k)[2], message.data() + kHalf);
    RandomStream random = StreamOf(*space_, robots_[k], stream_);
    for (std::uint8_t& byte : message)
      byte = static_cast<std::uint8_t>(std::clamp(byte + byte_noise_.Sample(random) + 0.5, 0.0, 255.0));
    ValuesOf(k)[1] = Packed(message.data());
    ValuesOf(k)[2] = Packed(message.data() + kHalf);
  }

  NoiseModel byte_noise_;
};

class Receiver : public CCI_RangeAndBearingSensor
{
public:
  std::span<const Packet> GetAllPackets() const override { return packets; }
  std::vector<Packet> packets;
};

class ReceiverBatch : public SensorBatch
{
public:
  static std::vector<ParameterSpec> ParameterTable()
  {
    return Joined(Joined({{.name = "range",
                           .unit = "m",
                           .default_value = "3",
                           .description = "Distance from which packets are received.",
                           .minimum = 0.001},
                          {.name = "loss_probability",
                           .default_value = "0",
                           .description = "Share of the packets that get lost.",
                           .minimum = 0,
                           .maximum = 1}},
                         NoiseParameters("each range", "m", "range_")),
                  NoiseParameters("each bearing", "rad", "bearing_"));
  }

  void Init(const DeviceSetup& setup) override
  {
    world_ = SensorWorld::Of(setup.space);
    robots_ = setup.robots;
    stream_ = setup.stream;
    range_ = setup.parameters.Number("range");
    loss_ = setup.parameters.Number("loss_probability");
    range_noise_ = NoiseFrom(setup.parameters, "range_");
    bearing_noise_ = NoiseFrom(setup.parameters, "bearing_");
    lines_ = std::make_unique<SightLines>(*world_, range_);
    receivers_.resize(robots_.size());
    place_of_entity_.assign(setup.space.Size(), -1);
    for (std::size_t k = 0; k < robots_.size(); ++k) place_of_entity_[robots_[k]] = static_cast<std::int32_t>(k);
    message_slots_.assign(setup.space.Size(), kNoSlot);
    messages_.assign(setup.space.Size(), {});
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e)
      if (const CSwarmanoidSpaceEntity& entity = setup.space.GetEntity(e); IsRobot(entity.GetKind()))
        message_slots_[e] = entity.SlotOf("message");
  }
  CCI_Sensor* Sensor(std::size_t k) override { return &receivers_[k]; }

  void Update(const ChannelView&) override
  {
    world_->Refresh();
    ReadMessages();
    // In the order of the grid's cells: neighbours stay in the cache. Every robot has a body.
    for (const std::uint32_t entity : world_->Grid().Sorted())
      if (const std::int32_t k = place_of_entity_[entity]; k >= 0) Receive(static_cast<std::size_t>(k));
  }

private:
  struct Heard
  {
    Vector3 offset;
    double square;        // m^2
    std::uint32_t place;  // of the sender in the grid
  };

  void ReadMessages()
  {
    const std::span<const double> attributes = world_->Space().Attributes();
    const std::span<const std::uint32_t> senders = world_->Grid().Sorted();
    std::size_t sent = 0;
    for (std::size_t place = 0; place < senders.size(); ++place)
    {
      const std::uint32_t slot = message_slots_[senders[place]];
      Sent& message = messages_[place];
      message.is_sent = slot != kNoSlot && attributes[slot] != 0;
      sent += message.is_sent;
      if (!message.is_sent) continue;
      Unpack(attributes[slot + 1], message.bytes.data());
      Unpack(attributes[slot + 2], message.bytes.data() + kHalf);
    }
    look_at_all_ = 2 * sent > senders.size() && world_->Grid().AllUpright();
  }

  Vector3 AntennaOf(std::uint32_t robot) const
  {
    const PoseArrays& poses = world_->Space().Poses();
    if (IsUpright(poses, robot)) return {poses.x[robot], poses.y[robot], poses.z[robot] + kAntennaHeight};
    return world_->Space().GetPose(robot).Apply({0, 0, kAntennaHeight});
  }

  void Receive(std::size_t k)
  {
    const std::uint32_t robot = robots_[k];
    antenna_ = AntennaOf(robot);
    lines_->LookFrom(robot, antenna_, range_);
    const std::span<const std::int32_t> around = lines_->PlacesAround();
    if (heard_.size() < around.size()) heard_.resize(2 * around.size());
    // Where most send and many hide one another it is quicker to look at all first.
    std::size_t count = 0;
    if (look_at_all_)
    {
      lines_->AddPointsAround();
      const std::span<const char> seen = lines_->Solve();
      for (std::size_t i = 0; i < around.size(); ++i)
        if (seen[i] && IsInRange(around[i], robot, heard_[count])) ++count;
    }
    else
    {
      for (const std::int32_t place : around)
        if (IsInRange(place, robot, heard_[count]))
          lines_->AddPoint(heard_[count++].offset, world_->Grid().Sorted()[static_cast<std::size_t>(place)]);
      const std::span<const char> seen = lines_->Solve();
      std::size_t kept = 0;
      for (std::size_t i = 0; i < count; ++i)
      {
        heard_[kept] = heard_[i];
        kept += seen[i] != 0;
      }
      count = kept;
    }

    RandomStream random = StreamOf(world_->Space(), robot, stream_);
    if (loss_ > 0)
    {
      const auto end = heard_.begin() + static_cast<std::ptrdiff_t>(count);
      count = static_cast<std::size_t>(
          std::remove_if(heard_.begin(), end, [&](const Heard&) { return random.Uniform() < loss_; }) - heard_.begin());
    }
    MakePackets(k, count, random);
  }

  // Whether a robot around sends and is near enough; then where it is.
  bool IsInRange(std::int32_t place, std::uint32_t robot, Heard& heard) const
  {
    const NeighbourGrid& grid = world_->Grid();
    const PoseArrays& poses = world_->Space().Poses();
    const auto p = static_cast<std::uint32_t>(place);
    if (!messages_[p].is_sent) return false;
    heard.place = p;
    heard.offset = grid.AllUpright() ? Vector3(grid.OriginX()[p] - poses.x[robot], grid.OriginY()[p] - poses.y[robot],
                                               grid.OriginZ()[p] - poses.z[robot])
                                     : Vector3(AntennaOf(grid.Sorted()[p]) - antenna_);
    const Vector3& offset = heard.offset;
    heard.square = offset.x() * offset.x() + offset.y() * offset.y() + offset.z() * offset.z();
    return heard.square <= range_ * range_;
  }

  void MakePackets(std::size_t k, std::size_t count, RandomStream& random)
  {
    for (std::vector<double>* values : {&place_x_, &place_y_, &place_z_, &flat_, &bearing_, &elevation_})
      if (values->size() < count) values->resize(2 * count);
    const bool is_flat = TurnToBody(k, count);
    Atan2Each({place_y_.data(), count}, {place_x_.data(), count}, {bearing_.data(), count});
    if (is_flat)
      std::fill_n(elevation_.begin(), count, 0.0);
    else
      Atan2Each({place_z_.data(), count}, {flat_.data(), count}, {elevation_.data(), count});

    auto& packets = receivers_[k].packets;
    packets.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      CCI_RangeAndBearingSensor::Packet& packet = packets[i];
      packet.range_m = __builtin_sqrt(heard_[i].square);
      packet.bearing_rad = bearing_[i];
      packet.vertical_bearing_rad = elevation_[i];
      packet.message = messages_[heard_[i].place].bytes;
    }
    if (!range_noise_.IsActive() && !bearing_noise_.IsActive()) return;
    for (CCI_RangeAndBearingSensor::Packet& packet : packets)
    {
      if (range_noise_.IsActive()) packet.range_m = std::max(packet.range_m + range_noise_.Sample(random), 0.0);
      if (bearing_noise_.IsActive()) packet.bearing_rad = WrapAngle(packet.bearing_rad + bearing_noise_.Sample(random));
    }
  }

  // The places of the senders in the frame of the robot. True where all are as high as the robot.
  bool TurnToBody(std::size_t k, std::size_t count)
  {
    const CSwarmanoidSpace& space = world_->Space();
    bool is_flat = true;
    if (IsUpright(space.Poses(), robots_[k]))
    {
      const Heading heading = HeadingOf(space.Poses(), robots_[k]);
      for (std::size_t i = 0; i < count; ++i)
      {
        const Vector3& offset = heard_[i].offset;
        place_x_[i] = heading.cos * offset.x() + heading.sin * offset.y();
        place_y_[i] = heading.cos * offset.y() - heading.sin * offset.x();
        place_z_[i] = offset.z();
        is_flat &= offset.z() == 0;
      }
    }
    else
    {
      const Eigen::Matrix3d to_body = space.GetPose(robots_[k]).orientation.toRotationMatrix().transpose();
      is_flat = false;
      for (std::size_t i = 0; i < count; ++i)
      {
        const Vector3 place(to_body * heard_[i].offset);
        place_x_[i] = place.x();
        place_y_[i] = place.y();
        place_z_[i] = place.z();
      }
    }
    if (!is_flat)
      for (std::size_t i = 0; i < count; ++i)
        flat_[i] = __builtin_sqrt(place_x_[i] * place_x_[i] + place_y_[i] * place_y_[i]);
    return is_flat;
  }

  struct Sent
  {
    bool is_sent = false;
    CCI_RangeAndBearingActuator::Message bytes{};
  };

  std::shared_ptr<SensorWorld> world_;
  std::unique_ptr<SightLines> lines_;
  std::vector<std::uint32_t> robots_;
  std::uint32_t stream_ = 0;
  double range_ = 0, loss_ = 0;
  NoiseModel range_noise_, bearing_noise_;
  std::vector<std::uint32_t> message_slots_;   // by entity
  std::vector<Sent> messages_;                 // by place in the grid, of this tick
  std::vector<std::int32_t> place_of_entity_;  // k of an entity, or -1
  bool look_at_all_ = false;
  Vector3 antenna_ = Vector3::Zero();
  std::vector<Heard> heard_;
  std::vector<double> place_x_, place_y_, place_z_, flat_, bearing_, elevation_;  // of those heard
  std::vector<Receiver> receivers_;
};

}  // namespace

void RegisterRangeAndBearing()
{
  PluginDescription sender;
  sender.label = "range_and_bearing";
  sender.implementation = "generic_range_and_bearing";
  sender.brief = "broadcasts 10 bytes to all in sight";
  sender.robots = {"footbot", "eyebot", "handbot"};
  sender.parameters = NoiseParameters("each byte of the message", "1/255");
  AddActuatorPlugin<SenderBatch>(sender);

  PluginDescription receiver = sender;
  receiver.brief = "receives the bytes of all in sight within 3 m, with distance and direction";
  receiver.parameters = ReceiverBatch::ParameterTable();
  AddSensorPlugin<ReceiverBatch>(receiver);
}

}  // namespace swarmanoid
