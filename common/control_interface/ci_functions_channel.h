// The channel between a controller and the experiment functions: reports to them, instructions from them, each a small
// message once a tick. Type labels "report" (actuator) and "instruction" (sensor). The other end:
// space_server/robot_messages.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

// The size of the largest message, bytes.
inline constexpr unsigned kMaxMessageBytes = 30;

class CCI_ReportActuator : public CCI_ActuatorOf<CCI_ReportActuator>
{
public:
  // Sets the report of this tick; the last call in a tick counts. The functions get it in their PostStep of the tick.
  // Throws std::length_error for more than kMaxMessageBytes.
  virtual void ReportBytes(std::span<const std::uint8_t> bytes) = 0;
  // Reports a number, an enumeration, or a struct of these without pointers.
  template <class Message>
  void Report(const Message& message)
  {
    static_assert(std::is_trivially_copyable_v<Message> && sizeof(Message) <= kMaxMessageBytes);
    std::array<std::uint8_t, sizeof(Message)> bytes;
    std::memcpy(bytes.data(), &message, sizeof(Message));
    ReportBytes(bytes);
  }

  static void Declare(Declaration& columns)
  {
    columns.Set({{"reporting", "yes/no", 0, 1}, {"length", "", 0, kMaxMessageBytes}, ByteColumn()}, &SetNumbers,
                kMaxMessageBytes);
  }

private:
  // Sends a report in each step while values[0] is above 0.5. The next value is the count of bytes, and the bytes
  // follow.
  static void SetNumbers(CCI_ReportActuator& report, std::span<const double> values)
  {
    if (values[0] > 0.5)
      SendNumbers<kMaxMessageBytes>(values.subspan(1), [&](auto bytes) { report.ReportBytes(bytes); });
  }
};

class CCI_InstructionSensor : public CCI_SensorOf<CCI_InstructionSensor>
{
public:
  // Returns whether an instruction arrived in this tick; the last one stays readable.
  virtual bool IsNew() const = 0;
  // Returns the last instruction; empty before the first one. Valid until the next control step.
  virtual std::span<const std::uint8_t> GetBytes() const = 0;
  // Returns the same as a message; nullopt if it has another size.
  template <class Message>
  std::optional<Message> Get() const
  {
    static_assert(std::is_trivially_copyable_v<Message> && sizeof(Message) <= kMaxMessageBytes);
    if (GetBytes().size() != sizeof(Message)) return std::nullopt;
    Message message;
    std::memcpy(&message, GetBytes().data(), sizeof(Message));
    return message;
  }

  static void Declare(Declaration& columns)
  {
    columns.Add({"new", "yes/no", 0, 1}, &CCI_InstructionSensor::IsNew)
        .Add({"length", "", 0, kMaxMessageBytes},
             [](const CCI_InstructionSensor& sensor) { return sensor.GetBytes().size(); })
        .Add(ByteColumn(), &CCI_InstructionSensor::GetBytes, kMaxMessageBytes);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_InstructionSensor;
using swarmanoid::CCI_ReportActuator;
