#include "common/bus/shown_text.h"

#include <algorithm>
#include <cstdint>

namespace swarmanoid
{
namespace
{

// The length of the character at the start of `text`, 0 where it is none that may be shown.
std::size_t CharacterLength(std::string_view text)
{
  const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(text[k]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80U) return (lead >= 0x20U && lead != 0x7fU) || lead == '\n' || lead == '\t' ? 1 : 0;
  const std::size_t length = lead < 0xc2U ? 0 : lead < 0xe0U ? 2 : lead < 0xf0U ? 3 : lead < 0xf5U ? 4 : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xc0U) != 0x80U) return 0;
  const std::uint8_t second = byte(1);
  if (lead == 0xc2U && second < 0xa0U) return 0;                                           // control characters
  if ((lead == 0xe0U && second < 0xa0U) || (lead == 0xf0U && second < 0x90U)) return 0;    // longer than needed
  if ((lead == 0xedU && second >= 0xa0U) || (lead == 0xf4U && second >= 0x90U)) return 0;  // no characters
  return length;
}

}  // namespace

bool IsShowable(std::string_view text)
{
  while (!text.empty())
  {
    const std::size_t length = CharacterLength(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string Showable(std::string_view text, std::size_t most_bytes)
{
  std::string shown;
  while (!text.empty())
  {
    const std::size_t length = CharacterLength(text);
    const std::string_view next = length == 0 ? std::string_view("?") : text.substr(0, length);
    if (shown.size() + next.size() > most_bytes) break;
    shown += next;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return shown;
}

}  // namespace swarmanoid
