// Packets of bytes as an attribute of an entity: the number of packets so far, the length of the last one, and its
// bytes, five in each slot. Radios and the channel between controllers and experiment functions use it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace swarmanoid
{

inline constexpr std::size_t kBytesOfSlot = 5;  // exact in a double
inline constexpr std::size_t kPacketSlots = 8;
inline constexpr std::size_t kMostPacketBytes = (kPacketSlots - 2) * kBytesOfSlot;

struct AttributePacket
{
  std::uint32_t length = 0;
  std::uint32_t unused = 0;  // so that saved states have no gaps
  std::array<std::uint8_t, 32> bytes{};

  AttributePacket() = default;
  // Takes at most kMostPacketBytes bytes.
  explicit AttributePacket(std::span<const std::uint8_t> given) : length(static_cast<std::uint32_t>(given.size()))
  {
    std::copy(given.begin(), given.end(), bytes.begin());
  }
  std::span<const std::uint8_t> Bytes() const { return {bytes.data(), length}; }
};

// `values` are those of the slots after the count.
inline void PackPacket(const AttributePacket& packet, double* values)
{
  values[0] = packet.length;
  for (std::size_t slot = 1; slot < kPacketSlots - 1; ++slot)
  {
    std::int64_t number = 0;
    for (std::size_t i = 0; i < kBytesOfSlot; ++i) number = number << 8 | packet.bytes[(slot - 1) * kBytesOfSlot + i];
    values[slot] = static_cast<double>(number);
  }
}

inline AttributePacket UnpackedPacket(const double* values)
{
  AttributePacket packet;
  packet.length = static_cast<std::uint32_t>(std::min(values[0], static_cast<double>(kMostPacketBytes)));
  for (std::size_t slot = 1; slot < kPacketSlots - 1; ++slot)
  {
    const auto number = static_cast<std::int64_t>(values[slot]);
    for (std::size_t i = 0; i < kBytesOfSlot; ++i)
      packet.bytes[(slot - 1) * kBytesOfSlot + i] = static_cast<std::uint8_t>(number >> (8 * (kBytesOfSlot - 1 - i)));
  }
  return packet;
}

}  // namespace swarmanoid
