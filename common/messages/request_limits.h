// The limits of a control request. Every place that makes one, and the run control that carries it out, checks them
// with the same function, so that a request that cannot be sent or written down is refused by a reply.
#pragma once

#include <string>

#include "common/messages/control_request.h"

namespace swarmanoid
{

inline constexpr std::size_t kMostRequestNumbers = 6;  // a position and three angles

// Returns why the verb, the entity or the numbers of the request are no part of a message; empty if they are.
std::string RequestLimitError(const ControlRequestMessage& request);

}  // namespace swarmanoid
