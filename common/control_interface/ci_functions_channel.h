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

  // A report in each step while it is reporting: so many of the bytes behind that.
  std::vector<CCI_Column> Columns() const override
  {
    std::vector<CCI_Column> columns{{"reporting", "yes/no", 0, 1}, {"length", "", 0, kMaxMessageBytes}};
    for (CCI_Column& byte : NumberedColumns(kMaxMessageBytes, "byte ", {{}, {}, 0, 255}))
      columns.push_back(std::move(byte));
    return columns;
  }
  void SetColumns(std::span<const double> values) override
  {
    if (!(values[0] > 0.5)) return;
    std::array<std::uint8_t, kMaxMessageBytes> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<std::uint8_t>(std::clamp(values[2 + i], 0.0, 255.0));
    const auto length = static_cast<std::size_t>(std::clamp(values[1], 0.0, double{kMaxMessageBytes}));
    ReportBytes(std::span(bytes).first(length));
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

  std::vector<CCI_Column> Columns() const override
  {
    std::vector<CCI_Column> columns{{"new", "yes/no", 0, 1}, {"length", "", 0, kMaxMessageBytes}};
    for (CCI_Column& byte : NumberedColumns(kMaxMessageBytes, "byte ", {{}, {}, 0, 255}))
      columns.push_back(std::move(byte));
    return columns;
  }
  void ReadColumns(std::vector<double>& values) const override
  {
    const std::span<const std::uint8_t> bytes = GetBytes();
    values.insert(values.end(), {IsNew() ? 1.0 : 0.0, static_cast<double>(bytes.size())});
    values.insert(values.end(), bytes.begin(), bytes.end());
    values.insert(values.end(), kMaxMessageBytes - bytes.size(), 0.0);
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
