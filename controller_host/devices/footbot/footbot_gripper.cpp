// Gripper of the footbot: the actuator sends 0 (open) to 1 (closed) to the engine on channel "footbot_gripper"; the
// sensor reads the aperture and the grip that the engine reports as attributes.
#include <algorithm>

#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_sensor.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class Gripper : public CommandsOf<CCI_FootBotGripperActuator>
{
public:
  using CommandsOf::CommandsOf;
  void SetGripper(double closed) override { *values_ = std::clamp(closed, 0.0, 1.0); }
};

class GripperState : public CCI_FootBotGripperSensor
{
public:
  explicit GripperState(const double* values) : values_(values) {}
  double GetAperture() const override { return values_[0]; }
  bool IsGripping() const override { return values_[1] != 0; }
  std::string GetHeldId() const override
  {
    return IsGripping() ? space->GetEntity(static_cast<std::uint32_t>(values_[1]) - 1).GetId() : std::string();
  }

  const CSwarmanoidSpace* space = nullptr;

private:
  const double* values_;  // aperture, held entity
};

class GripperSensor : public SensorsOf<AttributeSensor, GripperState>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Bind(setup, {"gripper_aperture", "gripped"});
    aperture_noise_ = NoiseFrom(setup.parameters);
    MakeDevices();
    for (GripperState& device : devices_) device.space = &setup.space;
  }
  void Update(const ChannelView& channel) override
  {
    AttributeSensor::Update(channel);
    if (!aperture_noise_.IsActive()) return;
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      RandomStream random = streams_.Of(k);
      double& aperture = ValuesOf(k)[0];
      aperture = std::clamp(aperture + aperture_noise_.Sample(random), 0.0, CCI_FootBotGripperSensor::OPEN_APERTURE);
    }
  }

private:
  NoiseModel aperture_noise_;
};

}  // namespace

const DeviceCode kFootbotGripperCode(
    []
    {
      BindActuator<ChannelCommands<Gripper, 1, 1>>("footbot_gripper", "dummy_footbot_gripper");
      BindSensor<GripperSensor>("footbot_gripper", "generic_footbot_gripper");
    });

}  // namespace swarmanoid
