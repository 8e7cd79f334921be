// Turret of the footbot: its motor (channel "footbot_turret", rad/s), its encoder (attribute turret_angle) and the
// torque sensor between body and turret (channel "footbot_turret_torque": traction ahead, traction to the left, torque,
// each -1..1 of the engine's range).
#include <algorithm>

#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_encoder_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_torque_sensor.h"
#include "common/math/elementary.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class Turret : public CommandsOf<CCI_FootBotTurretActuator>
{
public:
  using CommandsOf::CommandsOf;
  void SetTurretAngularVelocity(double velocity) override { *values_ = std::clamp(velocity, -limit, limit); }

  double limit = 0;  // rad/s
};

class TurretActuator : public ChannelCommands<Turret, 1>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    ChannelCommands::Init(setup);
    for (Turret& turret : devices_) turret.limit = setup.parameters.Number("max_speed");
  }
};

class TurretAngle : public CCI_FootBotTurretEncoderSensor
{
public:
  explicit TurretAngle(const double* angle) : angle_(angle) {}
  double GetTurretAngle() const override { return WrapAngle(*angle_); }

private:
  const double* angle_;
};

class TurretEncoder : public SensorsOf<AttributeSensor, TurretAngle>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Bind(setup, {"turret_angle"});
    noise_ = NoiseFrom(setup.parameters);
    MakeDevices();
  }
};

class TorqueSensor : public ChannelReadings<CCI_FootBotTurretTorqueSensor, 3>
{
public:
  void Update(const ChannelView& channel) override
  {
    ChannelReadings::Update(channel);
    for (double& value : values_) value = std::clamp(value, -1.0, 1.0);
  }
};

}  // namespace

const DeviceCode kFootbotTurretCode(
    []
    {
      BindActuator<TurretActuator>("footbot_turret", "dummy_footbot_turret");
      BindSensor<TurretEncoder>("footbot_turret_encoder", "generic_footbot_turret_encoder");
      BindSensor<TorqueSensor>("footbot_turret_torque", "engine_footbot_turret_torque");
    });

}  // namespace swarmanoid
