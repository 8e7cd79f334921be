// The devices of Kilobots, with the rules of argos3-kilobot. Messages are those of our range and bearing: a byte that
// says what the sender does, and the bytes of message_t.
//
// Problem: if several robots in range of each other want to send in one step, each of them may with the probability
// 1 / (number of the others + 1) (kilobot_communication_medium.cpp). A robot learns how many others want to send one
// step later. Then it draws, and sends its message in that step. So messages arrive one step later than in ARGoS3,
// unless the medium ignores conflicts.
#include "argos3/plugin/device_parts.h"

#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_communication_actuator.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_communication_sensor.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_led_actuator.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_light_sensor.h>

#undef main

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "argos3/converter/robot_rows.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_light_sensor.h"
#include "common/control_interface/ci_range_and_bearing.h"

namespace swarmanoid::argos3
{
namespace
{

// The bits of the first byte of a message.
constexpr std::uint8_t kWantsToSend = 1;
constexpr std::uint8_t kHasMessage = 2;

constexpr std::size_t kMessageBytes = sizeof(message_t);
static_assert(1 + kMessageBytes == kKilobotBytes);

bool IgnoresConflicts(const DeviceSetup& setup) { return setup.options.GetText("ignore_conflicts", "") == "true"; }

class KilobotLed : public ActuatorBridge, public argos::CCI_KilobotLEDActuator
{
public:
  explicit KilobotLed(const DeviceSetup& setup) : ours_(setup.robot.Actuator<CCI_LedRingActuator>("led_ring")) {}
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Reset() override { SetColor(argos::CColor::BLACK); }
  void Commit() override { ours_.SetColour(0, Lit(m_cColor)); }

private:
  CCI_LedRingActuator& ours_;
};

class KilobotLight : public SensorBridge, public argos::CCI_KilobotLightSensor
{
public:
  explicit KilobotLight(const DeviceSetup& setup) : ours_(setup.robot.Sensor<swarmanoid::CCI_LightSensor>("light")) {}
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Reset() override { m_nReading = 0; }
  void Update() override
  {
    constexpr double kFull = 1024;
    m_nReading = static_cast<SInt16>(std::floor(kFull * ours_.GetAllSensorReadings()[0]));
  }

private:
  const swarmanoid::CCI_LightSensor& ours_;
};

class KilobotSender : public ActuatorBridge, public argos::CCI_KilobotCommunicationActuator
{
public:
  explicit KilobotSender(const DeviceSetup& setup)
      : ours_(setup.robot.HasActuator("range_and_bearing")
                  ? &setup.robot.Actuator<swarmanoid::CCI_RangeAndBearingActuator>("range_and_bearing")
                  : nullptr),
        radio_(setup.kilobot_radio),
        ignores_conflicts_(IgnoresConflicts(setup)),
        channel_(ChannelOf(setup.options))
  {
  }
  argos::CCI_Actuator& Actuator() override { return *this; }
  void Reset() override
  {
    m_ptMessage = nullptr;
    *radio_ = {};
  }
  void Commit() override
  {
    if (m_ptMessage != nullptr) radio_->waiting = *m_ptMessage;
    m_ptMessage = nullptr;
    if (ours_ == nullptr) return;
    if (ignores_conflicts_) radio_->sent = radio_->waiting;
    std::array<std::uint8_t, kKilobotBytes + 1> bytes{};
    bytes[0] = static_cast<std::uint8_t>((radio_->waiting ? kWantsToSend : 0) | (radio_->sent ? kHasMessage : 0));
    if (radio_->sent) std::memcpy(&bytes[1], &*radio_->sent, kMessageBytes);
    bytes.back() = channel_.value_or(0);
    radio_->sent.reset();
    ours_->SetBytes({bytes.data(), kKilobotBytes + (channel_ ? 1U : 0U)});
  }

private:
  swarmanoid::CCI_RangeAndBearingActuator* ours_;  // nullptr if the robot is in no medium
  const std::shared_ptr<KilobotRadio> radio_;
  const bool ignores_conflicts_;
  const std::optional<std::uint8_t> channel_;
};

class KilobotReceiver : public SensorBridge, public argos::CCI_KilobotCommunicationSensor
{
public:
  explicit KilobotReceiver(const DeviceSetup& setup)
      : robot_(setup.robot),
        ours_(robot_.Sensor<swarmanoid::CCI_RangeAndBearingSensor>("range_and_bearing")),
        radio_(setup.kilobot_radio),
        ignores_conflicts_(IgnoresConflicts(setup)),
        channel_(ChannelOf(setup.options)),
        drops_(setup.options.GetNumber("message_drop_prob", 0)),
        noise_mm_(setup.options.GetNumber("radio_noise", 0))
  {
  }
  argos::CCI_Sensor& Sensor() override { return *this; }
  void Reset() override
  {
    m_tPackets.clear();
    m_bMessageSent = false;
  }
  void Update() override
  {
    m_tPackets.clear();
    const auto overhead = TheRunning().overhead_messages.find(robot_.GetId());
    if (overhead != TheRunning().overhead_messages.end()) m_tPackets.push_back({&overhead->second, {0, 0}});
    const auto packets = ours_.GetAllPackets();
    messages_.resize(packets.size());
    std::size_t others = 0;
    for (std::size_t i = 0; i < packets.size(); ++i)
    {
      const auto bytes = BytesOf(packets[i]);
      if (!bytes) continue;
      if (((*bytes)[0] & kWantsToSend) != 0) ++others;
      if (((*bytes)[0] & kHasMessage) == 0) continue;
      if (drops_ > 0 && robot_.GetRandom().Uniform() < drops_) continue;
      std::memcpy(&messages_[i], &(*bytes)[1], kMessageBytes);
      constexpr double kMillimetres = 1000;
      double distance = std::trunc(kMillimetres * packets[i].range_m);
      if (noise_mm_ > 0) distance += robot_.GetRandom().Gaussian(0, noise_mm_);
      m_tPackets.push_back({&messages_[i], {0, static_cast<SInt16>(distance)}});
    }
    m_bMessageSent = radio_->waiting && MaySend(others);
    if (!m_bMessageSent) return;
    if (!ignores_conflicts_) radio_->sent = radio_->waiting;
    radio_->waiting.reset();
  }

private:
  using Bytes = std::array<std::uint8_t, kKilobotBytes>;

  // Returns nullopt for messages of other robots.
  std::optional<Bytes> BytesOf(const swarmanoid::CCI_RangeAndBearingSensor::Packet& packet) const
  {
    constexpr std::size_t kCommon = swarmanoid::CCI_RangeAndBearingActuator::NUM_BYTES;
    const std::span<const std::uint8_t> further = ours_.GetFurtherBytes(packet);
    if (further.size() != kKilobotBytes - kCommon + (channel_ ? 1 : 0)) return std::nullopt;
    if (channel_ && further.back() != *channel_) return std::nullopt;
    Bytes bytes{};
    std::ranges::copy(packet.message, bytes.begin());
    std::copy_n(further.begin(), kKilobotBytes - kCommon, bytes.begin() + kCommon);
    return bytes;
  }

  bool MaySend(std::size_t others) const
  {
    return ignores_conflicts_ || others == 0 || robot_.GetRandom().Uniform() < 1 / (static_cast<double>(others) + 1);
  }

  CCI_Robot& robot_;
  const swarmanoid::CCI_RangeAndBearingSensor& ours_;
  const std::shared_ptr<KilobotRadio> radio_;
  const bool ignores_conflicts_;
  const std::optional<std::uint8_t> channel_;
  const double drops_;     // probability
  const double noise_mm_;  // standard deviation
  std::vector<message_t> messages_;
};

}  // namespace

std::unique_ptr<SensorBridge> MakeKilobotSensor(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "kilobot_light") return std::make_unique<KilobotLight>(setup);
  if (tag == "kilobot_communication") return std::make_unique<KilobotReceiver>(setup);
  return nullptr;
}

std::unique_ptr<ActuatorBridge> MakeKilobotActuator(const std::string& tag, const DeviceSetup& setup)
{
  if (tag == "kilobot_led") return std::make_unique<KilobotLed>(setup);
  if (tag == "kilobot_communication") return std::make_unique<KilobotSender>(setup);
  return nullptr;
}

}  // namespace swarmanoid::argos3
