// The bytes of range and bearing as attributes of their sender: numbers of five bytes each, two of them, or more if the
// messages of the sender are longer (common/space/message_slots.h).
#pragma once

#include <algorithm>

#include "common/control_interface/ci_range_and_bearing.h"

namespace swarmanoid
{

using RangeAndBearingMessage = CCI_RangeAndBearingActuator::Message;

inline constexpr int kBytesInNumber = 5;

// Five bytes as one number, the first one highest: exact in a double.
inline double PackedBytes(const std::uint8_t* bytes)
{
  std::int64_t number = 0;
  for (std::size_t i = 0; i < kBytesInNumber; ++i) number = number << 8 | bytes[i];
  return static_cast<double>(number);
}

inline void UnpackBytes(double value, std::uint8_t* bytes)
{
  const auto number = static_cast<std::int64_t>(value);
  for (std::size_t i = 0; i < kBytesInNumber; ++i) bytes[i] = static_cast<std::uint8_t>(number >> (8 * (4 - i)));
}

// `values`: two numbers.
inline RangeAndBearingMessage UnpackedMessage(const double* values)
{
  RangeAndBearingMessage message;
  UnpackBytes(values[0], message.data());
  UnpackBytes(values[1], message.data() + kBytesInNumber);
  return message;
}

// Packs bytes of any length. `values` gets one number for each five bytes or fewer.
inline void PackBytes(std::span<const std::uint8_t> bytes, double* values)
{
  for (std::size_t i = 0; i < bytes.size(); i += kBytesInNumber)
  {
    std::array<std::uint8_t, kBytesInNumber> five{};
    std::copy_n(&bytes[i], std::min<std::size_t>(kBytesInNumber, bytes.size() - i), five.begin());
    *values++ = PackedBytes(five.data());
  }
}

inline void UnpackBytes(const double* values, std::span<std::uint8_t> bytes)
{
  for (std::size_t i = 0; i < bytes.size(); i += kBytesInNumber)
  {
    std::array<std::uint8_t, kBytesInNumber> five{};
    UnpackBytes(*values++, five.data());
    std::copy_n(five.begin(), std::min<std::size_t>(kBytesInNumber, bytes.size() - i), &bytes[i]);
  }
}

}  // namespace swarmanoid
