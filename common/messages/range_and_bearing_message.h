// The bytes of range and bearing as attributes of their sender: two numbers of five bytes each.
#pragma once

#include "common/control_interface/ci_range_and_bearing.h"

namespace swarmanoid
{

using RangeAndBearingMessage = CCI_RangeAndBearingActuator::Message;

// Five bytes as one number, the first one highest: exact in a double.
inline double PackedBytes(const std::uint8_t* bytes)
{
  std::int64_t number = 0;
  for (std::size_t i = 0; i < 5; ++i) number = number << 8 | bytes[i];
  return static_cast<double>(number);
}

inline void UnpackBytes(double value, std::uint8_t* bytes)
{
  const auto number = static_cast<std::int64_t>(value);
  for (std::size_t i = 0; i < 5; ++i) bytes[i] = static_cast<std::uint8_t>(number >> (8 * (4 - i)));
}

// `values`: two numbers.
inline void PackMessage(const RangeAndBearingMessage& message, double* values)
{
  values[0] = PackedBytes(message.data());
  values[1] = PackedBytes(message.data() + 5);
}

inline RangeAndBearingMessage UnpackedMessage(const double* values)
{
  RangeAndBearingMessage message;
  UnpackBytes(values[0], message.data());
  UnpackBytes(values[1], message.data() + 5);
  return message;
}

}  // namespace swarmanoid
