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

private:
  double* values_;
};

class SenderBatch : public ActuatorsOf<AttributeActuator, Sender>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Bind(setup, {"message"});
    MakeDevices();
  }
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
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e)
      if (const CSwarmanoidSpaceEntity& entity = setup.space.GetEntity(e); IsRobot(entity.GetKind()))
        message_slots_[e] = entity.SlotOf("message");
  }
  CCI_Sensor* Sensor(std::size_t k) override { return &receivers_[k]; }

  void Update(const ChannelView&) override
  {
    world_->Refresh();
    // In the order of the grid's cells: neighbours stay in the cache. Every robot has a body.
    for (const std::uint32_t entity : world_->Grid().Sorted())
      if (const std::int32_t k = place_of_entity_[entity]; k >= 0) Receive(static_cast<std::size_t>(k));
  }

private:
  Vector3 AntennaOf(std::uint32_t robot) const
  {
    const PoseArrays& poses = world_->Space().Poses();
    if (IsUpright(poses, robot)) return {poses.x[robot], poses.y[robot], poses.z[robot] + kAntennaHeight};
    return world_->Space().GetPose(robot).Apply({0, 0, kAntennaHeight});
  }

  void Receive(std::size_t k)
  {
    const CSwarmanoidSpace& space = world_->Space();
    const std::span<const double> attributes = space.Attributes();
    const std::uint32_t robot = robots_[k];
    const Vector3 antenna = AntennaOf(robot);
    const double* const z = space.Poses().z.data();
    const bool all_upright = world_->Grid().AllUpright();
    const double square_range = range_ * range_;
    lines_->LookFrom(robot, antenna, range_);
    heard_.resize(lines_->Around().size());
    std::size_t count = 0;
    for (const SightLines::Neighbour& other : lines_->Around())
    {
      const std::uint32_t slot = message_slots_[other.entity];
      if (slot == kNoSlot || attributes[slot] == 0) continue;
      const Vector3 offset = all_upright ? Vector3(other.x, other.y, z[other.entity] - z[robot])
                                         : Vector3(AntennaOf(other.entity) - antenna);
      const double square = offset.squaredNorm();
      if (square > square_range) continue;
      lines_->AddPoint(offset, other.entity);
      heard_[count++] = {offset, square, slot};
    }
    const std::span<const char> seen = lines_->Solve();

    RandomStream random = StreamOf(space, robot, stream_);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i)
      if (seen[i] && !(loss_ > 0 && random.Uniform() < loss_)) heard_[kept++] = heard_[i];
    heard_.resize(kept);
    MakePackets(k, random);
  }

  void MakePackets(std::size_t k, RandomStream& random)
  {
    const CSwarmanoidSpace& space = world_->Space();
    const std::span<const double> attributes = space.Attributes();
    const Pose pose = space.GetPose(robots_[k]);
    const Eigen::Matrix3d to_body = pose.orientation.toRotationMatrix().transpose();
    const std::size_t count = heard_.size();
    for (std::vector<double>* values : {&place_x_, &place_y_, &place_z_, &flat_, &bearing_, &elevation_})
      if (values->size() < count) values->resize(count);
    bool is_flat = true;
    for (std::size_t i = 0; i < count; ++i)
    {
      const Vector3 place(to_body * heard_[i].offset);
      place_x_[i] = place.x();
      place_y_[i] = place.y();
      place_z_[i] = place.z();
      flat_[i] = __builtin_sqrt(place.x() * place.x() + place.y() * place.y());
      is_flat &= place.z() == 0;
    }
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
      if (range_noise_.IsActive()) packet.range_m = std::max(packet.range_m + range_noise_.Sample(random), 0.0);
      if (bearing_noise_.IsActive()) packet.bearing_rad = WrapAngle(packet.bearing_rad + bearing_noise_.Sample(random));
      Unpack(attributes[heard_[i].slot + 1], packet.message.data());
      Unpack(attributes[heard_[i].slot + 2], packet.message.data() + kHalf);
    }
  }

  struct Heard
  {
    Vector3 offset;
    double square;
    std::uint32_t slot;
  };

  std::shared_ptr<SensorWorld> world_;
  std::unique_ptr<SightLines> lines_;
  std::vector<std::uint32_t> robots_;
  std::uint32_t stream_ = 0;
  double range_ = 0, loss_ = 0;
  NoiseModel range_noise_, bearing_noise_;
  std::vector<std::uint32_t> message_slots_;   // by entity
  std::vector<std::int32_t> place_of_entity_;  // k of an entity, or -1
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
  AddActuatorPlugin<SenderBatch>(sender);

  PluginDescription receiver = sender;
  receiver.brief = "receives the bytes of all in sight within 3 m, with distance and direction";
  receiver.parameters = ReceiverBatch::ParameterTable();
  AddSensorPlugin<ReceiverBatch>(receiver);
}

}  // namespace swarmanoid
