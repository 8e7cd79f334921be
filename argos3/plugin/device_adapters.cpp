// Each adapter is a device of ARGoS3's interface on top of one of ours. Sensors copy our readings before a control
// step, with ARGoS3's units (cm, degrees or rad, bytes) and its response: its infrared sensors answer to a distance by
// curves that were fitted to the robots, ours linearly, so our reading is turned back to a distance first. Noise that
// our devices do not have is added to the copy and drawn from the robot's stream. Commands are passed on after the
// step; a device whose command was not given keeps the last one, as in ARGoS3.
#include "argos3/plugin/device_adapters.h"

#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_proximity_sensor.h>
#include <argos3/plugins/robots/eye-bot/control_interface/ci_eyebot_light_sensor.h>
#include <argos3/plugins/robots/eye-bot/control_interface/ci_eyebot_proximity_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_battery_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_light_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_positioning_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_proximity_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "argos3/converter/battery.h"
#include "argos3/converter/robot_rows.h"
#include "argos3/plugin/device_noise.h"
#include "argos3/plugin/device_parts.h"
#include "common/control_interface/ci_battery_sensor.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_light_sensor.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/ci_proximity_sensor.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/eyebot/ci_eyebot_light_sensor.h"
#include "common/math/elementary.h"

namespace swarmanoid::argos3
{
namespace
{

// A robot with a ring of LEDs only.
class RingLeds : public ActuatorBridge, public argos::CCI_LEDsActuator
{
public:
  RingLeds(const DeviceSetup& setup, const char* type) : ring_(setup.robot.Actuator<CCI_LedRingActuator>(type))
  {
    m_tSettings.resize(ring_.GetNumLeds(), argos::CColor::BLACK);
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Reset() override { SetAllColors(argos::CColor::BLACK); }
  void Commit() override
  {
    if (!last_.Differs(m_tSettings)) return;
    for (unsigned led = 0; led < m_tSettings.size(); ++led) ring_.SetColour(led, Lit(m_tSettings[led]));
  }

private:
  LastColours last_;
  CCI_LedRingActuator& ring_;
};

// Return the response of ARGoS3's infrared sensors (generic, eye-bot) to a distance in m.
double GenericResponse(double distance) { return std::exp(-distance); }
double EyeBotResponse(double distance)
{
  constexpr double kTouching = 0.009889556;
  return distance < kTouching ? 1 : 0.0100527 / (distance + 0.000163144);
}

class Light : public SensorBridge, public argos::CCI_LightSensor
{
public:
  explicit Light(const DeviceSetup& setup) : ours_(setup.robot.Sensor<swarmanoid::CCI_LightSensor>("light"))
  {
    m_tReadings.resize(ours_.GetAllSensorReadings().size());
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void BeforeStep() override { OnDemand(); }
  void Update() override { std::ranges::copy(ours_.GetAllSensorReadings(), m_tReadings.begin()); }

private:
  const swarmanoid::CCI_LightSensor& ours_;
};

class Positioning : public SensorBridge, public argos::CCI_PositioningSensor
{
public:
  explicit Positioning(const DeviceSetup& setup)
      : robot_(setup.robot),
        axis_low_(setup.options.GetNumber("axis_noise_low", 0)),
        axis_high_(setup.options.GetNumber("axis_noise_high", 0)),
        translation_(setup.translation),
        ours_(setup.robot.Sensor<swarmanoid::CCI_PositioningSensor>("positioning"))
  {
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void BeforeStep() override { OnDemand(axis_low_ != axis_high_); }
  void Update() override
  {
    m_sReading.Position = translation_.Argos3Position(ours_.GetPosition());
    m_sReading.Orientation = Argos3Orientation(ours_.GetOrientation());
    if (axis_low_ == axis_high_) return;
    // The result may have another length, as in ARGoS3.
    argos::CRadians angle;
    argos::CVector3 axis;
    m_sReading.Orientation.ToAngleAxis(angle, axis);
    const auto noise = [this] { return robot_.GetRandom().Uniform(axis_low_, axis_high_); };
    for (UInt32 i = 0; i < 3; ++i) axis[i] += noise();
    m_sReading.Orientation.FromAngleAxis(angle, axis);
  }

private:
  CCI_Robot& robot_;
  const double axis_low_, axis_high_;
  const Translation& translation_;
  const swarmanoid::CCI_PositioningSensor& ours_;
};

// Discharges like our battery; loop functions may recharge it.
class Battery : public SensorBridge, public argos::CCI_BatterySensor
{
public:
  explicit Battery(const DeviceSetup& setup)
      : robot_(setup.robot),
        ours_(setup.robot.Sensor<swarmanoid::CCI_BatterySensor>("battery")),
        charge_{setup.options.GetNumber("start_charge", 1), setup.options.GetNumber("full_charge", 1),
                setup.options.GetNumber("start_charge", 1)},
        noise_low_(setup.options.GetNumber("battery_noise_low", 0)),
        noise_high_(setup.options.GetNumber("battery_noise_high", 0))
  {
    // The sensor reads 0 until its first reading.
    if (ours_.GetCharge() > 0) spent_ = Spent();
    TheRunning().batteries[robot_.GetId()] = &charge_;
  }
  ~Battery() override { TheRunning().batteries.erase(robot_.GetId()); }
  argos::CCI_Sensor& Sensor() override { return *this; }
  // Our battery is reset, too.
  void Reset() override
  {
    charge_.available = charge_.start;
    spent_ = 0;
    m_sReading = SReading();
  }
  void Update() override
  {
    const double spent = Spent();
    charge_.available = std::max(0.0, charge_.available - (spent - spent_) * charge_.full);
    spent_ = spent;
    const Real before = m_sReading.AvailableCharge;
    m_sReading.AvailableCharge = charge_.available / charge_.full;
    if (noise_low_ < noise_high_)
      m_sReading.AvailableCharge =
          std::clamp(m_sReading.AvailableCharge + robot_.GetRandom().Uniform(noise_low_, noise_high_), 0.0, 1.0);
    const Real used = before - m_sReading.AvailableCharge;
    m_sReading.TimeLeft =
        std::abs(used) > 1e-6 ? before * robot_.GetTickSeconds() / used : std::numeric_limits<double>::infinity();
  }

private:
  // Returns the spent charge in full batteries of ARGoS3.
  double Spent() const { return (1 - ours_.GetCharge()) * kBatteries; }

  CCI_Robot& robot_;
  const swarmanoid::CCI_BatterySensor& ours_;
  BatteryCharge charge_;
  double noise_low_, noise_high_;
  double spent_ = 0;
};

class RangeAndBearingSender : public ActuatorBridge, public argos::CCI_RangeAndBearingActuator
{
public:
  explicit RangeAndBearingSender(const DeviceSetup& setup)
      : ours_(!setup.robot.HasActuator("range_and_bearing")
                  ? nullptr
                  : &setup.robot.Actuator<swarmanoid::CCI_RangeAndBearingActuator>("range_and_bearing")),
        channel_(ChannelOf(setup.options))
  {
    m_cData.Resize(static_cast<size_t>(setup.options.GetInteger("rab_data_size", 10)));
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Reset() override { ClearData(); }
  void Commit() override
  {
    // Our actuator sends the same bytes until others are set.
    if (ours_ == nullptr || (has_sent_ && m_cData == sent_)) return;
    sent_ = m_cData;
    has_sent_ = true;
    bytes_.assign(m_cData.ToCArray(), m_cData.ToCArray() + m_cData.Size());
    if (channel_) bytes_.push_back(*channel_);
    ours_->SetBytes(bytes_);
  }

private:
  swarmanoid::CCI_RangeAndBearingActuator* ours_;  // nullptr if the robot is in no medium
  const std::optional<std::uint8_t> channel_;
  bool has_sent_ = false;
  argos::CByteArray sent_;           // the data in the last message
  std::vector<std::uint8_t> bytes_;  // scratch
};

class RangeAndBearingReceiver : public SensorBridge, public argos::CCI_RangeAndBearingSensor
{
public:
  explicit RangeAndBearingReceiver(const DeviceSetup& setup)
      : robot_(setup.robot),
        noise_m_(setup.options.GetNumber("radio_noise", 0)),
        ours_(setup.robot.Sensor<swarmanoid::CCI_RangeAndBearingSensor>("range_and_bearing")),
        channel_(ChannelOf(setup.options)),
        data_size_(static_cast<size_t>(setup.options.GetInteger("rab_data_size", 10))),
        size_(data_size_ + (channel_ ? 1 : 0)),
        further_(size_ - std::min<size_t>(size_, swarmanoid::CCI_RangeAndBearingActuator::NUM_BYTES))
  {
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void BeforeStep() override { OnDemand(noise_m_ > 0); }
  void Update() override
  {
    const auto packets = ours_.GetAllPackets();
    SetCount(packets.size());
    std::size_t count = 0;
    for (const auto& ours : packets)
    {
      // Messages of another length are ignored.
      std::span<const std::uint8_t> further;
      if (ours.further != 0) further = ours_.GetFurtherBytes(ours);
      if (further.size() != further_) continue;
      if (channel_ && (further.empty() ? ours.message[size_ - 1] : further.back()) != *channel_) continue;
      SPacket& packet = m_tReadings[count++];
      packet.Range = kCentimetres * ours.range_m;
      packet.HorizontalBearing.SetValue(ours.bearing_rad);
      packet.VerticalBearing.SetValue(ours.vertical_bearing_rad);
      if (noise_m_ > 0) Disturb(ours, packet);
      if (packet.Data.Size() != data_size_) packet.Data.Resize(data_size_);
      UInt8* const bytes = packet.Data.ToCArray();
      if (first_bytes_ == sizeof ours.message)
        std::memcpy(bytes, ours.message.data(), sizeof ours.message);
      else
        std::copy_n(ours.message.begin(), first_bytes_, bytes);
      if (data_size_ > first_bytes_) std::copy_n(further.begin(), data_size_ - first_bytes_, bytes + first_bytes_);
    }
    SetCount(count);
  }

private:
  // Packets that are left out keep their memory for later steps.
  void SetCount(std::size_t count)
  {
    for (; m_tReadings.size() > count; m_tReadings.pop_back()) spare_.push_back(std::move(m_tReadings.back()));
    for (; m_tReadings.size() < count && !spare_.empty(); spare_.pop_back())
      m_tReadings.push_back(std::move(spare_.back()));
    m_tReadings.resize(count);
  }
  void Disturb(const swarmanoid::CCI_RangeAndBearingSensor::Packet& ours, SPacket& theirs) const
  {
    const SinCos bearing = SinCosOf(ours.bearing_rad);
    const SinCos vertical = SinCosOf(ours.vertical_bearing_rad);
    Vector3 to_sender = ours.range_m * Vector3(vertical.cos * bearing.cos, vertical.cos * bearing.sin, vertical.sin);
    DisturbDirection(robot_.GetRandom(), noise_m_, to_sender);
    theirs.Range = kCentimetres * to_sender.norm();
    theirs.HorizontalBearing.SetValue(Atan2(to_sender.y(), to_sender.x()));
    theirs.VerticalBearing.SetValue(Atan2(to_sender.z(), to_sender.head<2>().norm()));
  }

  CCI_Robot& robot_;
  const double noise_m_;
  const swarmanoid::CCI_RangeAndBearingSensor& ours_;
  const std::optional<std::uint8_t> channel_;
  const size_t data_size_;
  const size_t size_;                                                  // with the byte of the channel
  const size_t further_;                                               // bytes behind the common ones
  const size_t first_bytes_ = std::min(data_size_, size_ - further_);  // of the data, in the common ones
  TReadings spare_;
};

bool IsGeneric(const CCI_Robot& robot)
{
  const RobotRow* row = RobotOfKind(robot.GetKind());
  return row != nullptr && row->is_generic;
}

}  // namespace

std::unique_ptr<SensorBridge> MakeSensor(const std::string& tag, const DeviceSetup& setup)
{
  if (auto own = MakeEPuckSensor(tag, setup)) return own;
  if (tag == "proximity") return std::make_unique<Proximity<argos::CCI_ProximitySensor>>(setup, GenericResponse);
  if (tag == "epuck_proximity")
    return std::make_unique<Proximity<argos::CCI_EPuckProximitySensor>>(setup, EPuckResponse);
  if (tag == "eyebot_proximity")
    return std::make_unique<Proximity<argos::CCI_EyeBotProximitySensor>>(setup, EyeBotResponse);
  if (tag == "eyebot_light")
    return std::make_unique<Ring<argos::CCI_EyeBotLightSensor, CCI_EyeBotLightSensor>>(setup, tag.c_str());
  if (tag == "colored_blob_perspective_camera") return MakePerspectiveCamera(setup);
  if (tag == "light") return std::make_unique<Light>(setup);
  if (tag == "positioning") return std::make_unique<Positioning>(setup);
  if (tag == "battery") return std::make_unique<Battery>(setup);
  if (tag == "range_and_bearing") return std::make_unique<RangeAndBearingReceiver>(setup);
  return IsGeneric(setup.robot) ? MakeGenericSensor(tag, setup) : MakeFootBotSensor(tag, setup);
}

std::unique_ptr<ActuatorBridge> MakeActuator(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "leds" && setup.robot.GetKind() == "eyebot") return std::make_unique<RingLeds>(setup, "eyebot_leds");
  if (tag == "leds" && IsGeneric(setup.robot))
    return std::make_unique<RingLeds>(setup,
                                      setup.robot.HasActuator("directional_leds") ? "directional_leds" : "led_ring");
  if (tag == "range_and_bearing") return std::make_unique<RangeAndBearingSender>(setup);
  if (auto flies = MakeEyeBotActuator(tag, setup)) return flies;
  return IsGeneric(setup.robot) ? MakeGenericActuator(tag, setup) : MakeFootBotActuator(tag, setup);
}

}  // namespace swarmanoid::argos3
