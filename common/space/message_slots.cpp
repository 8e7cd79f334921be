#include "common/space/message_slots.h"

#include <algorithm>

#include "common/messages/range_and_bearing_message.h"
#include "common/space/attributes.h"

namespace swarmanoid
{

namespace
{

// Returns the parameters of the robot's sender of range and bearing, or a handle that does not exist.
TConfigurationTree SenderOf(const Experiment& experiment, const EntityConfiguration& robot)
{
  const ControllerConfiguration* controller =
      robot.controller.empty() ? nullptr : experiment.FindController(robot.controller);
  if (controller == nullptr || AttributeOffset(robot.kind, "message") < 0) return {};
  const auto sender = std::ranges::find(controller->actuators, "range_and_bearing", &DeviceConfiguration::type);
  return sender == controller->actuators.end() ? TConfigurationTree() : sender->tree;
}

}  // namespace

int MessageBytes(const Experiment& experiment, const EntityConfiguration& robot)
{
  constexpr int kFewest = CCI_RangeAndBearingActuator::NUM_BYTES;
  return static_cast<int>(SenderOf(experiment, robot).GetInteger("bytes", kFewest));
}

std::optional<double> MessageRange(const Experiment& experiment, const EntityConfiguration& robot)
{
  const TConfigurationTree sender = SenderOf(experiment, robot);
  if (!sender.Value("range")) return std::nullopt;
  return sender.GetNumber("range");
}

int FurtherMessageSlots(const Experiment& experiment, const EntityConfiguration& entity)
{
  const int further = MessageBytes(experiment, entity) - static_cast<int>(CCI_RangeAndBearingActuator::NUM_BYTES);
  return (std::max(further, 0) + kBytesInNumber - 1) / kBytesInNumber;
}

}  // namespace swarmanoid
