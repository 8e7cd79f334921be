#include "common/space/message_slots.h"

#include <algorithm>

#include "common/messages/range_and_bearing_message.h"
#include "common/space/attributes.h"

namespace swarmanoid
{

int MessageBytes(const Experiment& experiment, const EntityConfiguration& robot)
{
  constexpr int kFewest = CCI_RangeAndBearingActuator::NUM_BYTES;
  const ControllerConfiguration* controller =
      robot.controller.empty() ? nullptr : experiment.FindController(robot.controller);
  if (controller == nullptr || AttributeOffset(robot.kind, "message") < 0) return kFewest;
  const auto sender = std::ranges::find(controller->actuators, "range_and_bearing", &DeviceConfiguration::type);
  if (sender == controller->actuators.end()) return kFewest;
  return static_cast<int>(sender->tree.GetInteger("bytes", kFewest));
}

int FurtherMessageSlots(const Experiment& experiment, const EntityConfiguration& entity)
{
  const int further = MessageBytes(experiment, entity) - static_cast<int>(CCI_RangeAndBearingActuator::NUM_BYTES);
  return (std::max(further, 0) + kBytesInNumber - 1) / kBytesInNumber;
}

}  // namespace swarmanoid
