// Messages of range and bearing that have more bytes than the attribute "message" of a kind has room for. A robot whose
// actuator sends more has further slots of that attribute behind all that its kind has, of five bytes each.
#pragma once

#include "common/experiment/experiment.h"

namespace swarmanoid
{

// Bytes of a message of this robot: CCI_RangeAndBearingActuator::NUM_BYTES, or as many as its actuator says.
int MessageBytes(const Experiment& experiment, const EntityConfiguration& robot);
// 0 for all whose messages fit.
int FurtherMessageSlots(const Experiment& experiment, const EntityConfiguration& entity);

}  // namespace swarmanoid
