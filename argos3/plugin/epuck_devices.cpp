// The devices that e-pucks of argos3-epuck alone have, with its responses. A message carries all that the 12 emitters
// send, and the heading of the sender. So the receiver knows which emitter looked at it.
#include "argos3/plugin/device_parts.h"

#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_base_leds_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_ground_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_light_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_proximity_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_range_and_bearing_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_rgb_leds_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_wheels_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_ground_sensor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "argos3/converter/robot_rows.h"
#include "argos3/plugin/device_noise.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_light_sensor.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/control_interface/footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "common/math/elementary.h"

namespace swarmanoid::argos3
{
namespace
{

constexpr unsigned kRedLeds = 8, kColouredLeds = 3;

class EPuckWheels : public ActuatorBridge, public argos::CCI_EPuckWheelsActuator
{
public:
  explicit EPuckWheels(const DeviceSetup& setup)
      : robot_(setup.robot),
        wheels_(robot_.Actuator<CCI_WheelsActuator>("wheels")),
        told_(setup.told_wheels),
        deviation_(setup.options.GetNumber("wheel_noise", 0))
  {
    TheRunning().wheels[robot_.GetId()] = told_.get();
  }
  ~EPuckWheels() override { TheRunning().wheels.erase(robot_.GetId()); }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Reset() override
  {
    *told_ = {};
    wheels_.SetLinearVelocity(0, 0);
  }
  // Each command has its own noise, in proportion to the speed.
  void SetLinearVelocity(Real left, Real right) override
  {
    const auto disturbed = [&](double speed)
    { return deviation_ > 0 ? speed * (1 + robot_.GetRandom().Gaussian(0, deviation_)) : speed; };
    told_->left = disturbed(left);
    told_->right = disturbed(right);
    wheels_.SetLinearVelocity(told_->left / kCentimetres, told_->right / kCentimetres);
  }

private:
  CCI_Robot& robot_;
  CCI_WheelsActuator& wheels_;
  const std::shared_ptr<WheelSpeeds> told_;
  const double deviation_;
};

class EPuckColouredLeds : public ActuatorBridge, public argos::CCI_EPuckRGBLEDsActuator
{
public:
  explicit EPuckColouredLeds(const DeviceSetup& setup) : ours_(setup.robot.Actuator<CCI_LedRingActuator>("led_ring")) {}
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Reset() override { SetColors(argos::CColor::BLACK); }
  void Commit() override
  {
    for (unsigned led = 0; led < kColouredLeds; ++led) ours_.SetColour(kRedLeds + led, Lit(m_tLEDSettings[led]));
  }

private:
  CCI_LedRingActuator& ours_;
};

class EPuckRedLeds : public ActuatorBridge, public argos::CCI_EPuckBaseLEDsActuator
{
public:
  explicit EPuckRedLeds(const DeviceSetup& setup) : ours_(setup.robot.Actuator<CCI_LedRingActuator>("led_ring")) {}
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Reset() override { SwitchLEDs(false); }
  // Theirs are numbered clockwise, ours counter-clockwise.
  void Commit() override
  {
    constexpr std::uint32_t kRed = 0xff0000;
    for (unsigned led = 0; led < kRedLeds; ++led)
      ours_.SetColour(kRedLeds - 1 - led, (m_unLEDSettings >> led & 1U) != 0 ? kRed : 0);
  }

private:
  CCI_LedRingActuator& ours_;
};

// The angles that controllers of the plug-in see, rad: those of the real robot. The simulated infrared sensors look a
// little beside them.
constexpr std::array<double, 8> kDivisors{10.5884, 3.5999, 2, 1.2, 0.8571, 0.6667, 0.5806, 0.5247};

template <class Readings>
void SetEPuckAngles(Readings& readings)
{
  for (std::size_t i = 0; i < kDivisors.size(); ++i) readings[i].Angle.SetValue(std::numbers::pi / kDivisors[i]);
}

class DemiurgeProximity : public Proximity<argos::CCI_EPuckProximitySensor>
{
public:
  DemiurgeProximity(const DeviceSetup& setup, double (*response)(double)) : Proximity(setup, response)
  {
    SetEPuckAngles(m_tReadings);
  }
};

class EPuckLight : public SensorBridge, public argos::CCI_EPuckLightSensor
{
public:
  explicit EPuckLight(const DeviceSetup& setup) : ours_(setup.robot.Sensor<swarmanoid::CCI_LightSensor>("light"))
  {
    m_tReadings.resize(kDivisors.size());
    SetEPuckAngles(m_tReadings);
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    const auto readings = ours_.GetAllSensorReadings();
    for (std::size_t i = 0; i < readings.size(); ++i) m_tReadings[i].Value = readings[i];
  }

private:
  const swarmanoid::CCI_LightSensor& ours_;
};

class EPuckGround : public SensorBridge, public argos::CCI_EPuckGroundSensor
{
public:
  explicit EPuckGround(const DeviceSetup& setup) : generic_(MakeGenericSensor("ground", setup))
  {
    ours_ = dynamic_cast<argos::CCI_GroundSensor*>(&generic_->Sensor());
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Reset() override { m_sReadings.Reset(); }
  // Our points begin at the right.
  void Update() override
  {
    generic_->Update();
    for (std::size_t i = 0; i < 3; ++i) m_sReadings[2 - i] = ours_->GetReadings()[i];
  }

private:
  const std::unique_ptr<SensorBridge> generic_;
  const argos::CCI_GroundSensor* ours_;
};

class EPuckCamera : public SensorBridge, public argos::CCI_EPuckOmnidirectionalCameraSensor
{
public:
  explicit EPuckCamera(const DeviceSetup& setup)
      : robot_(setup.robot),
        deviation_m_(setup.options.GetNumber("camera_noise", 0)),
        ours_(robot_.Sensor<CCI_FootBotOmnidirectionalCameraSensor>("footbot_omnidirectional_camera"))
  {
    Disable();
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Update() override
  {
    m_sReadings.BlobList.clear();
    if (IsDisabled()) return;
    const auto blobs = ours_.GetAllBlobs();
    if (blobs_.size() < blobs.size()) blobs_.resize(blobs.size());
    for (std::size_t i = 0; i < blobs.size(); ++i)
    {
      double distance_m = blobs[i].distance_m;
      double angle_rad = blobs[i].angle_rad;
      // The noise is a vector of Gaussian length, whatever the distance.
      if (deviation_m_ > 0)
        DisturbBlob(robot_.GetRandom(), deviation_m_ / std::max(distance_m, 1e-9), distance_m, angle_rad);
      blobs_[i].Color = argos::CColor(0xff000000U | blobs[i].colour);
      blobs_[i].Angle.SetValue(angle_rad);
      blobs_[i].Distance = kCentimetres * distance_m;
      blobs_[i].Area = static_cast<UInt32>(95.644 * std::exp(-0.11 * blobs_[i].Distance));
      m_sReadings.BlobList.push_back(&blobs_[i]);
    }
    ++m_sReadings.Counter;
  }

private:
  CCI_Robot& robot_;
  const double deviation_m_;
  const CCI_FootBotOmnidirectionalCameraSensor& ours_;
  std::vector<SBlob> blobs_;
};

// The bytes of a message: the enabled emitters as bits, their data, and the heading.
using Emitters = argos::CCI_EPuckRangeAndBearingActuator;
constexpr std::size_t kData = Emitters::MAX_BYTES_SENT;
constexpr std::size_t kHeadingAt = 2 + Emitters::NUM_EMITTERS * kData;
static_assert(kHeadingAt + sizeof(double) == kDemiurgeEPuckBytes);

class EPuckSender : public ActuatorBridge, public argos::CCI_EPuckRangeAndBearingActuator
{
public:
  explicit EPuckSender(const DeviceSetup& setup)
      : ours_(setup.robot.HasActuator("range_and_bearing")
                  ? &setup.robot.Actuator<swarmanoid::CCI_RangeAndBearingActuator>("range_and_bearing")
                  : nullptr),
        place_(ours_ == nullptr ? nullptr : &setup.robot.Sensor<swarmanoid::CCI_PositioningSensor>("positioning")),
        channel_(ChannelOf(setup.options))
  {
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Commit() override
  {
    if (ours_ == nullptr) return;
    std::array<std::uint8_t, kDemiurgeEPuckBytes + 1> bytes{};
    for (std::size_t i = 0; i < NUM_EMITTERS; ++i)
    {
      const SEmitter& emitter = m_sDesiredData.Emitter[i];
      if (!emitter.Enabled) continue;
      bytes[i / 8] = static_cast<std::uint8_t>(bytes[i / 8] | 1U << i % 8);
      std::copy_n(emitter.Data, kData, &bytes[2 + i * kData]);
    }
    const double heading = place_->GetHeading();
    std::memcpy(&bytes[kHeadingAt], &heading, sizeof heading);
    bytes.back() = channel_.value_or(0);
    ours_->SetBytes({bytes.data(), kDemiurgeEPuckBytes + (channel_ ? 1U : 0U)});
  }

private:
  swarmanoid::CCI_RangeAndBearingActuator* ours_;  // nullptr if the robot is in no medium
  const swarmanoid::CCI_PositioningSensor* place_;
  const std::optional<std::uint8_t> channel_;
};

// Returns the value of a table at `x`, linear between its points.
double Interpolated(const std::array<std::array<double, 2>, 9>& table, double x)
{
  if (x <= table.front()[0]) return table.front()[1];
  for (std::size_t i = 1; i < table.size(); ++i)
    if (x <= table[i][0])
    {
      const double share = (x - table[i - 1][0]) / (table[i][0] - table[i - 1][0]);
      return table[i - 1][1] + share * (table[i][1] - table[i - 1][1]);
    }
  return table.back()[1];
}

class EPuckReceiver : public SensorBridge, public argos::CCI_EPuckRangeAndBearingSensor
{
public:
  explicit EPuckReceiver(const DeviceSetup& setup)
      : robot_(setup.robot),
        ours_(robot_.Sensor<swarmanoid::CCI_RangeAndBearingSensor>("range_and_bearing")),
        place_(robot_.Sensor<swarmanoid::CCI_PositioningSensor>("positioning")),
        channel_(ChannelOf(setup.options)),
        noise_m_(setup.options.GetNumber("radio_noise", 0)),
        loss_(setup.options.GetNumber("radio_loss", 0)),
        most_(setup.options.GetInteger("max_packets", std::numeric_limits<std::int64_t>::max())),
        bytes_(static_cast<std::size_t>(setup.options.GetInteger("radio_data_size", kData))),
        has_real_noise_(setup.options.GetText("real_range_noise", "") == "true")
  {
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Reset() override { ClearPackets(); }
  void Update() override
  {
    ClearPackets();
    const auto packets = ours_.GetAllPackets();
    order_.resize(packets.size());
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = i;
    // The order is random, since the first ones alone may count.
    if (most_ < static_cast<long long>(packets.size()))
      for (std::size_t i = order_.size(); i > 1; --i)
        std::swap(order_[i - 1],
                  order_[static_cast<std::size_t>(robot_.GetRandom().Uniform() * static_cast<double>(i))]);
    received_.resize(packets.size());
    long long left = most_;
    for (const std::size_t i : order_)
    {
      if (left <= 0) break;
      if (!ReadPacket(packets[i], received_[i])) continue;
      --left;
      if (loss_ > 0 && robot_.GetRandom().Uniform() < loss_) continue;
      m_tPackets.push_back(&received_[i]);
    }
  }

private:
  using Packet = swarmanoid::CCI_RangeAndBearingSensor::Packet;

  // Returns false for messages of other robots, and if the emitter that looks here is off.
  bool ReadPacket(const Packet& packet, SReceivedPacket& received)
  {
    constexpr std::size_t kCommon = swarmanoid::CCI_RangeAndBearingActuator::NUM_BYTES;
    const std::span<const std::uint8_t> further = ours_.GetFurtherBytes(packet);
    if (further.size() != kDemiurgeEPuckBytes - kCommon + (channel_ ? 1 : 0)) return false;
    if (channel_ && further.back() != *channel_) return false;
    std::array<std::uint8_t, kDemiurgeEPuckBytes> bytes{};
    std::ranges::copy(packet.message, bytes.begin());
    std::copy_n(further.begin(), kDemiurgeEPuckBytes - kCommon, bytes.begin() + kCommon);

    const SinCos bearing = SinCosOf(packet.bearing_rad);
    const SinCos vertical = SinCosOf(packet.vertical_bearing_rad);
    Vector3 to_sender = packet.range_m * Vector3(vertical.cos * bearing.cos, vertical.cos * bearing.sin, vertical.sin);
    DisturbDirection(robot_.GetRandom(), noise_m_, to_sender);
    double heading = 0;
    std::memcpy(&heading, &bytes[kHeadingAt], sizeof heading);
    const std::size_t emitter = EmitterTowards(Atan2(-to_sender.y(), -to_sender.x()) + place_.GetHeading() - heading);
    if ((bytes[emitter / 8] >> emitter % 8 & 1U) == 0) return false;
    received.Bearing.SetValue(Atan2(to_sender.y(), to_sender.x()));
    constexpr double kBodies = 2 * 3.5;  // cm
    received.Range = kCentimetres * to_sender.norm() - kBodies;
    if (has_real_noise_) received.Range = Measured(received.Range);
    for (std::size_t i = 0; i < kData; ++i) received.Data[i] = i < bytes_ ? bytes[2 + emitter * kData + i] : 0;
    return true;
  }

  // Each emitter covers 30 degrees, the first one -15 to 15. `angle`: in the frame of the sender.
  static std::size_t EmitterTowards(double angle)
  {
    constexpr double kWidth = std::numbers::pi / 6;
    const double turns = (angle + kWidth / 2) / (2 * std::numbers::pi);
    const auto emitter = static_cast<std::size_t>((turns - std::floor(turns)) * Emitters::NUM_EMITTERS);
    return std::min<std::size_t>(emitter, Emitters::NUM_EMITTERS - 1);
  }

  // Returns the distance (cm) that a real robot measures: it receives a power of a lognormal distribution, and computes
  // the distance from it (epuck_range_and_bearing_default_sensor.cpp).
  double Measured(double distance) const
  {
    constexpr std::array<std::array<double, 2>, 9> kMeans{{{0, 7.646890},
                                                           {2, 7.596525},
                                                           {5, 7.249550},
                                                           {10, 7.084636},
                                                           {15, 6.984497},
                                                           {30, 6.917447},
                                                           {45, 6.823188},
                                                           {60, 6.828551},
                                                           {80, 6.828551}}};
    constexpr std::array<std::array<double, 2>, 9> kDeviations{{{0, 0.3570609},
                                                                {2, 0.3192310},
                                                                {5, 0.1926492},
                                                                {10, 0.1529397},
                                                                {15, 0.1092330},
                                                                {30, 0.1216533},
                                                                {45, 0.1531546},
                                                                {60, 0.1418425},
                                                                {80, 0.1418425}}};
    const double logarithm =
        robot_.GetRandom().Gaussian(Interpolated(kMeans, distance), Interpolated(kDeviations, distance));
    return std::exp(9.06422181283387 - 0.00565074879677167 * std::exp(logarithm));
  }

  CCI_Robot& robot_;
  const swarmanoid::CCI_RangeAndBearingSensor& ours_;
  const swarmanoid::CCI_PositioningSensor& place_;
  const std::optional<std::uint8_t> channel_;
  const double noise_m_;
  const double loss_;  // probability
  const long long most_;
  const std::size_t bytes_;
  const bool has_real_noise_;
  std::vector<std::size_t> order_;
  std::vector<SReceivedPacket> received_;
};

}  // namespace

std::unique_ptr<SensorBridge> MakeEPuckSensor(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "epuck_proximity" && setup.robot.GetKind() == kDemiurgeEPuck)
    return std::make_unique<DemiurgeProximity>(setup, EPuckResponse);
  if (tag == "epuck_light") return std::make_unique<EPuckLight>(setup);
  if (tag == "epuck_ground") return std::make_unique<EPuckGround>(setup);
  if (tag == "epuck_omnidirectional_camera") return std::make_unique<EPuckCamera>(setup);
  if (tag == "epuck_range_and_bearing") return std::make_unique<EPuckReceiver>(setup);
  return nullptr;
}

std::unique_ptr<ActuatorBridge> MakeEPuckActuator(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "epuck_wheels") return std::make_unique<EPuckWheels>(setup);
  if (tag == "epuck_rgb_leds") return std::make_unique<EPuckColouredLeds>(setup);
  if (tag == "epuck_base_leds") return std::make_unique<EPuckRedLeds>(setup);
  if (tag == "epuck_range_and_bearing") return std::make_unique<EPuckSender>(setup);
  return nullptr;
}

}  // namespace swarmanoid::argos3
