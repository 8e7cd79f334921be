// Slots for messages of range and bearing that are longer than the attribute "message" of a kind. A robot whose
// actuator sends more bytes has further slots of that attribute after all slots of its kind, five bytes each.
#pragma once

#include <optional>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

// Returns the bytes of a message of this robot: CCI_RangeAndBearingActuator::NUM_BYTES, or the number given for its
// actuator.
int MessageBytes(const Experiment& experiment, const EntityConfiguration& robot);
// Returns the range (m) that is given for its actuator.
std::optional<double> MessageRange(const Experiment& experiment, const EntityConfiguration& robot);
// Returns the number of further slots, 0 if the messages of the entity fit.
int FurtherMessageSlots(const Experiment& experiment, const EntityConfiguration& entity);

}  // namespace swarmanoid
