// The seal at the end of every message that is not of a tick: a number that ascends, and a code that only those can
// make who hold the key of the run. The code goes over the topic, the writer, the message and the number, so that a
// sealed message cannot be said by another writer, on another topic, or again. Used by the bus; knows nothing of DDS.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "common/bus/run_key.h"

namespace swarmanoid
{

// The last bytes of a payload: the number (8), the code (16).
inline constexpr std::size_t kSealBytes = 24;

// Who writes: the GUID of a DDS writer.
using WriterId = std::array<char, 16>;

// `payload` ends with room for the seal.
void Seal(std::span<char> payload, const RunKey& key, std::string_view topic, const WriterId& writer,
          std::uint64_t number);
// The number, if the payload was sealed by the key for that topic and writer.
std::optional<std::uint64_t> NumberUnderSeal(std::span<const char> payload, const RunKey& key, std::string_view topic,
                                             const WriterId& writer);

}  // namespace swarmanoid
