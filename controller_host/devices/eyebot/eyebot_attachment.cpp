// The magnet of the eyebot: 1 (attach) or 0 (detach) to the engine on channel "eyebot_attach".
#include "common/control_interface/eyebot/ci_eyebot_attachment_actuator.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class Magnet : public CommandsOf<CCI_EyeBotAttachmentActuator>
{
public:
  using CommandsOf::CommandsOf;
  void Attach() override { *values_ = 1; }
  void Detach() override { *values_ = 0; }
};

}  // namespace

const DeviceCode kEyebotAttachmentCode(
    [] { BindActuator<ChannelCommands<Magnet, 1, 1>>("eyebot_attachment", "dummy_eyebot_attachment"); });

}  // namespace swarmanoid
