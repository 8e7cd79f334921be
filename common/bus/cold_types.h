// Conversion between plain messages and the types that fastddsgen makes from the IDL. Included by the bus alone.
#pragma once

#include "common/bus/messages.h"
#include "swarmanoid.h"
#include "swarmanoidPubSubTypes.h"

namespace swarmanoid
{

// Wire::Type, its type support and topic name.
template <class Message>
struct ColdTraits;

#define SWARMANOID_COLD_TYPE(MESSAGE, NAME)      \
  template <>                                    \
  struct ColdTraits<MESSAGE>                     \
  {                                              \
    using Wire = wire::NAME;                     \
    using Support = wire::NAME##PubSubType;      \
    static constexpr const char* kTopic = #NAME; \
  };

SWARMANOID_COLD_TYPE(WorldMessage, World)
SWARMANOID_COLD_TYPE(HelloMessage, Hello)
SWARMANOID_COLD_TYPE(ViewMessage, View)
SWARMANOID_COLD_TYPE(ControlRequestMessage, ControlRequest)
SWARMANOID_COLD_TYPE(ControlReplyMessage, ControlReply)
SWARMANOID_COLD_TYPE(StatusMessage, Status)
SWARMANOID_COLD_TYPE(SavedStateMessage, SavedState)
SWARMANOID_COLD_TYPE(WishesMessage, Wishes)
SWARMANOID_COLD_TYPE(RunStatusMessage, RunStatus)
SWARMANOID_COLD_TYPE(RobotStatusMessage, RobotStatus)
SWARMANOID_COLD_TYPE(ByeMessage, Bye)
#undef SWARMANOID_COLD_TYPE

void ToWire(const WorldMessage& message, wire::World& wire);
void ToWire(const HelloMessage& message, wire::Hello& wire);
void ToWire(const ViewMessage& message, wire::View& wire);
void ToWire(const ControlRequestMessage& message, wire::ControlRequest& wire);
void ToWire(const ControlReplyMessage& message, wire::ControlReply& wire);
void ToWire(const StatusMessage& message, wire::Status& wire);
void ToWire(const SavedStateMessage& message, wire::SavedState& wire);
void ToWire(const WishesMessage& message, wire::Wishes& wire);
void ToWire(const RunStatusMessage& message, wire::RunStatus& wire);
void ToWire(const RobotStatusMessage& message, wire::RobotStatus& wire);
void ToWire(const ByeMessage& message, wire::Bye& wire);

void FromWire(wire::World& wire, WorldMessage& message);
void FromWire(wire::Hello& wire, HelloMessage& message);
void FromWire(wire::View& wire, ViewMessage& message);
void FromWire(wire::ControlRequest& wire, ControlRequestMessage& message);
void FromWire(wire::ControlReply& wire, ControlReplyMessage& message);
void FromWire(wire::Status& wire, StatusMessage& message);
void FromWire(wire::SavedState& wire, SavedStateMessage& message);
void FromWire(wire::Wishes& wire, WishesMessage& message);
void FromWire(wire::RunStatus& wire, RunStatusMessage& message);
void FromWire(wire::RobotStatus& wire, RobotStatusMessage& message);
void FromWire(wire::Bye& wire, ByeMessage& message);

}  // namespace swarmanoid
