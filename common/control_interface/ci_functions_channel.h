// The channel between a controller and the experiment functions: reports to them, instructions from them, each a small
// message once a tick. Type labels "report" (actuator) and "instruction" (sensor). The other end:
// space_server/robot_messages.h.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

// The largest message, bytes.
inline constexpr unsigned kMaxMessageBytes = 30;

class CCI_ReportActuator : public CCI_Actuator
{
public:
  // The report of this tick; the last one counts. The functions have it in their PostStep of the tick. Throws
  // std::length_error for more than kMaxMessageBytes.
  virtual void ReportBytes(std::span<const std::uint8_t> bytes) = 0;
  // A number, an enumeration, a struct of those without pointers.
  template <class Message>
  void Report(const Message& message)
  {
    static_assert(std::is_trivially_copyable_v<Message> && sizeof(Message) <= kMaxMessageBytes);
    std::array<std::uint8_t, sizeof(Message)> bytes;
    std::memcpy(bytes.data(), &message, sizeof(Message));
    ReportBytes(bytes);
  }
};

class CCI_InstructionSensor : public CCI_Sensor
{
public:
  // Whether an instruction arrived in this tick; the last one stays readable.
  virtual bool IsNew() const = 0;
  // The last instruction; empty before the first one. Valid until the next control step.
  virtual std::span<const std::uint8_t> GetBytes() const = 0;
  // The same as a message; nullopt if it has another size.
  template <class Message>
  std::optional<Message> Get() const
  {
    static_assert(std::is_trivially_copyable_v<Message> && sizeof(Message) <= kMaxMessageBytes);
    if (GetBytes().size() != sizeof(Message)) return std::nullopt;
    Message message;
    std::memcpy(&message, GetBytes().data(), sizeof(Message));
    return message;
  }

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    readings.push_back({"new", "yes/no", IsNew() ? 1.0 : 0.0});
    readings.push_back({"bytes", "", static_cast<double>(GetBytes().size())});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_InstructionSensor;
using swarmanoid::CCI_ReportActuator;
