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

// Five bytes as one number, exact in a double.
double Packed(const std::uint8_t* bytes)
{
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < kHalf; ++i) number = number << 8 | bytes[i];
  return static_cast<double>(number);
}

void Unpack(double value, std::uint8_t* bytes)
{
  auto number = static_cast<std::uint64_t>(value);
  for (std::size_t i = kHalf; i-- > 0; number >>= 8) bytes[i] = static_cast<std::uint8_t>(number & 0xff);
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
    message_slots_.assign(setup.space.Size(), kNoSlot);
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e)
      if (const CSwarmanoidSpaceEntity& entity = setup.space.GetEntity(e); IsRobot(entity.GetKind()))
        message_slots_[e] = entity.SlotOf("message");
  }
  CCI_Sensor* Sensor(std::size_t k) override { return &receivers_[k]; }

  void Update(const ChannelView&) override
  {
    world_->Refresh();
    for (std::size_t k = 0; k < robots_.size(); ++k) Receive(k);
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
    lines_->LookFrom(robot, antenna, range_);
    heard_.clear();
    for (const std::uint32_t other : lines_->Around())
    {
      const std::uint32_t slot = message_slots_[other];
      if (slot == kNoSlot || attributes[slot] == 0) continue;
      const Vector3 offset = AntennaOf(other) - antenna;
      const double square = offset.squaredNorm();
      if (square > range_ * range_) continue;
      lines_->AddPoint(offset, other);
      heard_.push_back({offset, square, slot});
    }
    const std::span<const char> seen = lines_->Solve();

    auto& packets = receivers_[k].packets;
    packets.clear();
    const bool upright = IsUpright(space.Poses(), robot);
    const Heading heading = HeadingOf(space.Poses(), robot);
    const Quaternion to_body = space.GetPose(robot).orientation.conjugate();
    RandomStream random = StreamOf(space, robot, stream_);
    for (std::size_t i = 0; i < heard_.size(); ++i)
    {
      if (!seen[i] || (loss_ > 0 && random.Uniform() < loss_)) continue;
      const Vector3& offset = heard_[i].offset;
      const Vector3 place = upright ? Vector3(heading.cos * offset.x() + heading.sin * offset.y(),
                                              heading.cos * offset.y() - heading.sin * offset.x(), offset.z())
                                    : Vector3(to_body * offset);
      CCI_RangeAndBearingSensor::Packet& packet = packets.emplace_back();
      packet.range_m = __builtin_sqrt(heard_[i].square);
      packet.bearing_rad = Atan2(place.y(), place.x());
      if (place.z() != 0)
        packet.vertical_bearing_rad = Atan2(place.z(), __builtin_sqrt(place.x() * place.x() + place.y() * place.y()));
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
  std::vector<std::uint32_t> message_slots_;  // by entity
  std::vector<Heard> heard_;
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
