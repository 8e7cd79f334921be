// The magnet of the eyebot: 1 (attach) or 0 (detach) to the engine on channel "eyebot_attach".
#include "common/control_interface/eyebot/ci_eyebot_attachment_actuator.h"
#include "controller_host/devices/builtin_devices.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class Magnet : public CCI_EyeBotAttachmentActuator
{
public:
  explicit Magnet(double* on) : on_(on) {}
  void Attach() override { *on_ = 1; }
  void Detach() override { *on_ = 0; }

  void Describe(std::vector<CCI_Reading>& readings) const override { readings.push_back({"attached", "yes/no", *on_}); }

private:
  double* on_;
};

}  // namespace

void RegisterEyebotAttachment()
{
  BindActuator<ChannelCommands<Magnet, 1, 1>>("eyebot_attachment", "dummy_eyebot_attachment");
}

}  // namespace swarmanoid
