// The experiment functions' end of the channel to controllers (common/control_interface/ci_functions_channel.h).
// Functions, and programs around a CSimulator, use it between two ticks.
#pragma once

#include <cstring>
#include <optional>
#include <string_view>
#include <type_traits>

#include "common/space/packet_attribute.h"
#include "space_server/experiment_functions.h"

namespace swarmanoid
{

// Sends a robot an instruction for its next control step. Throws std::invalid_argument for an unknown id, and for an
// entity that takes no instructions.
template <class Message>
void Instruct(SpaceEditor& space, std::string_view robot, const Message& message)
{
  static_assert(std::is_trivially_copyable_v<Message> && sizeof(Message) <= kMostPacketBytes);
  AttributePacket packet;
  packet.length = sizeof(Message);
  std::memcpy(packet.bytes.data(), &message, sizeof(Message));
  double values[kPacketSlots - 1];
  PackPacket(packet, values);
  for (std::size_t i = 0; i < kPacketSlots - 1; ++i)
    space.SetAttribute(robot, "instruction", values[i], static_cast<int>(i) + 1);
  space.SetAttribute(robot, "instruction", space.GetSpace().FindEntity(robot)->GetAttribute("instruction") + 1);
}

// Returns the number of reports that a robot has made, and the last one. ReportOf returns nullopt if there is no
// report, or one of another size.
inline double ReportsOf(const CSwarmanoidSpaceEntity& robot) { return robot.GetAttribute("report"); }
template <class Message>
std::optional<Message> ReportOf(const CSwarmanoidSpaceEntity& robot)
{
  static_assert(std::is_trivially_copyable_v<Message> && sizeof(Message) <= kMostPacketBytes);
  double values[kPacketSlots - 1];
  for (std::size_t i = 0; i < kPacketSlots - 1; ++i) values[i] = robot.GetAttribute("report", static_cast<int>(i) + 1);
  const AttributePacket packet = UnpackedPacket(values);
  if (packet.length != sizeof(Message)) return std::nullopt;
  Message message;
  std::memcpy(&message, packet.bytes.data(), sizeof(Message));
  return message;
}

}  // namespace swarmanoid
