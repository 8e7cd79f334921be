// LED rings of all robots and kinds, beacons of footbot and handbot: colours as attributes of the robots. Generic.
#include <algorithm>
#include <stdexcept>

#include "common/control_interface/ci_directional_leds_actuator.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_leds_actuator.h"
#include "common/control_interface/footbot/ci_footbot_beacon_actuator.h"
#include "common/control_interface/footbot/ci_footbot_leds_actuator.h"
#include "common/control_interface/handbot/ci_handbot_beacon_actuator.h"
#include "common/control_interface/handbot/ci_handbot_leds_actuator.h"
#include "common/math/elementary.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/kind_of_batch.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint32_t kColourBits = 0xffffff;

template <class Interface>
class RingOf : public CommandsOf<Interface>
{
public:
  RingOf(double* colours, unsigned leds) : CommandsOf<Interface>(colours), leds_(leds) {}
  void SetAllColours(std::uint32_t colour) override { std::fill_n(this->values_, leds_, colour & kColourBits); }
  void SetColour(unsigned led, std::uint32_t colour) override
  {
    if (led >= leds_) throw std::out_of_range("LED " + std::to_string(led) + " of a ring of " + std::to_string(leds_));
    this->values_[led] = colour & kColourBits;
  }

protected:
  unsigned leds_;
};

template <class Interface>
class Ring : public RingOf<Interface>
{
public:
  static constexpr const char* kAttribute = "led";
  explicit Ring(double* colours) : RingOf<Interface>(colours, Interface::NUM_LEDS) {}
};

// The LEDs of any kind of robot.
class AnyRing : public RingOf<CCI_LedRingActuator>
{
public:
  using RingOf::RingOf;
  unsigned GetNumLeds() const override { return leds_; }
};

class DirectionalRing : public RingOf<CCI_DirectionalLedsActuator>
{
public:
  DirectionalRing(double* colours, unsigned leds, double observable_angle)
      : RingOf(colours, leds), observable_angle_(observable_angle)
  {
  }
  unsigned GetNumLeds() const override { return leds_; }
  double GetObservableAngle() const override { return observable_angle_; }

private:
  double observable_angle_;
};

// The cameras decide who sees them, by LedConesOf.
class DirectionalRingActuator : public AttributeActuator
{
public:
  void Init(const DeviceSetup& setup) override
  {
    const auto leds = static_cast<unsigned>(KindOfBatch(setup).leds->places.size());
    Bind(setup, {"led"});
    colour_noise_ = NoiseFrom(setup.parameters);
    const double angle = DegreesToRadians(setup.parameters.Number("observable_angle"));
    for (std::size_t k = 0; k < Robots(); ++k) rings_.emplace_back(ValuesOf(k), leds, angle);
  }
  DirectionalRing* Actuator(std::size_t k) override { return &rings_[k]; }

private:
  std::vector<DirectionalRing> rings_;
};

class AnyRingActuator : public AttributeActuator
{
public:
  void Init(const DeviceSetup& setup) override
  {
    const auto leds = static_cast<unsigned>(KindOfBatch(setup).leds->places.size());
    Bind(setup, {"led"});
    colour_noise_ = NoiseFrom(setup.parameters);
    for (std::size_t k = 0; k < Robots(); ++k) rings_.emplace_back(ValuesOf(k), leds);
  }
  AnyRing* Actuator(std::size_t k) override { return &rings_[k]; }

private:
  std::vector<AnyRing> rings_;
};

template <class Interface>
class Beacon : public CommandsOf<Interface>
{
public:
  static constexpr const char* kAttribute = "beacon";
  using CommandsOf<Interface>::CommandsOf;
  void SetColour(std::uint32_t colour) override { *this->values_ = colour & kColourBits; }
};

template <class Device>
class LightActuator : public ActuatorsOf<AttributeActuator, Device>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    this->Bind(setup, {Device::kAttribute});
    this->colour_noise_ = NoiseFrom(setup.parameters);
    this->MakeDevices();
  }
};

}  // namespace

const DeviceCode kLedsCode(
    []
    {
      BindActuator<LightActuator<Ring<CCI_FootBotLedsActuator>>>("footbot_leds", "generic_footbot_leds");
      BindActuator<LightActuator<Beacon<CCI_FootBotBeaconActuator>>>("footbot_beacon", "generic_footbot_beacon");
      BindActuator<LightActuator<Ring<CCI_EyeBotLedsActuator>>>("eyebot_leds", "generic_eyebot_leds");
      BindActuator<LightActuator<Beacon<CCI_HandBotBeaconActuator>>>("handbot_beacon", "generic_handbot_beacon");
      BindActuator<LightActuator<Ring<CCI_HandBotLedsActuator>>>("handbot_leds", "generic_handbot_leds");
      BindActuator<AnyRingActuator>("led_ring", "generic_led_ring");
      BindActuator<DirectionalRingActuator>("directional_leds", "generic_directional_leds");
    });

}  // namespace swarmanoid
