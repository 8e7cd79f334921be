// Finds the ends of characters in UTF-8. It allocates nothing, so signal handlers may use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace swarmanoid
{

// Returns the bytes of the well-formed character at the front of `text`, which is not empty; 0 if the bytes are no
// character (Unicode 15, table 3-7).
inline std::size_t Utf8Length(std::string_view text)
{
  const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(text[k]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80U) return 1;
  const std::size_t length = lead < 0xc2U ? 0 : lead < 0xe0U ? 2 : lead < 0xf0U ? 3 : lead < 0xf5U ? 4 : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xc0U) != 0x80U) return 0;
  const std::uint8_t second = byte(1);
  if ((lead == 0xe0U && second < 0xa0U) || (lead == 0xf0U && second < 0x90U)) return 0;    // longer than needed
  if ((lead == 0xedU && second >= 0xa0U) || (lead == 0xf4U && second >= 0x90U)) return 0;  // no characters
  return length;
}

}  // namespace swarmanoid
