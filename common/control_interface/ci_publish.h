// Publishes numbers of a controller for the table of a study (docs/studies.md), in which <published name="trips"
// by="controllers"> takes them. They are sent as the report of the tick (ci_functions_channel.h). So the controller
// must list the actuator "report", and must make no other report in that step. Without that actuator nothing happens,
// as on a robot.
//
//   Publish(*GetRobot(), {{"trips", trips_}, {"load", load_kg_}});
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "common/control_interface/ci_functions_channel.h"
#include "common/control_interface/ci_robot.h"

namespace swarmanoid
{

// It holds a published number of any arithmetic type, with its name.
struct CCI_PublishedNumber
{
  template <class Number>
  requires std::is_arithmetic_v<Number> CCI_PublishedNumber(std::string_view of, Number number)
      : name(of), value(static_cast<double>(number))
  {
  }

  std::string_view name;
  double value;
};

// An entry of a report: 16 bits of the name, and the number.
inline constexpr std::size_t kPublishedBytes = sizeof(std::uint16_t) + sizeof(double);
inline constexpr std::size_t kMostPublished = kMaxMessageBytes / kPublishedBytes;

inline std::uint16_t ShortName(std::string_view name) { return static_cast<std::uint16_t>(StreamName(name)); }

// Reports up to three numbers, at most once a step; they hold until the next report. Throws std::length_error for more
// numbers, and std::invalid_argument for two names with equal 16 bits.
inline void Publish(const CCI_Robot& robot, std::initializer_list<CCI_PublishedNumber> numbers)
{
  if (!robot.HasActuator("report")) return;
  if (numbers.size() > kMostPublished)
    throw std::length_error("robot '" + robot.GetId() + "' publishes more than three numbers in a step");
  std::array<std::uint8_t, kMostPublished * kPublishedBytes> bytes;
  std::array<std::uint16_t, kMostPublished> names;
  std::size_t count = 0;
  for (const CCI_PublishedNumber& number : numbers)
  {
    names[count] = ShortName(number.name);
    for (std::size_t i = 0; i < count; ++i)
      if (names[i] == names[count])
        throw std::invalid_argument("robot '" + robot.GetId() + "' publishes '" + std::string(number.name) +
                                    "', whose 16 bits in the report are those of another name; choose another one");
    std::memcpy(&bytes[count * kPublishedBytes], &names[count], sizeof names[count]);
    std::memcpy(&bytes[count * kPublishedBytes + sizeof names[count]], &number.value, sizeof number.value);
    ++count;
  }
  robot.Actuator<CCI_ReportActuator>("report").ReportBytes(std::span(bytes).first(count * kPublishedBytes));
}

// Returns a published number for the table of a study. Returns nullopt if the report does not have the name, or is of
// another form.
inline std::optional<double> PublishedNumberIn(std::span<const std::uint8_t> report, std::string_view name)
{
  if (report.size() % kPublishedBytes != 0) return std::nullopt;
  for (; !report.empty(); report = report.subspan(kPublishedBytes))
  {
    std::uint16_t of = 0;
    double value = 0;
    std::memcpy(&of, report.data(), sizeof of);
    std::memcpy(&value, report.data() + sizeof of, sizeof value);
    if (of == ShortName(name)) return value;
  }
  return std::nullopt;
}

}  // namespace swarmanoid

using swarmanoid::CCI_PublishedNumber;
using swarmanoid::Publish;
