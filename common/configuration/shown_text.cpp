#include "common/configuration/shown_text.h"

#include <algorithm>
#include <cstdint>

#include "common/configuration/utf8.h"

namespace swarmanoid
{
namespace
{

// The length of the character at the start of `text`, 0 if it is none that may be shown.
std::size_t CharacterLength(std::string_view text)
{
  const auto lead = static_cast<std::uint8_t>(text.front());
  const std::size_t length = Utf8Length(text);
  if (length == 1) return (lead >= 0x20U && lead != 0x7fU) || lead == '\n' || lead == '\t' ? 1 : 0;
  // Control characters have two bytes too.
  return length == 2 && lead == 0xc2U && static_cast<std::uint8_t>(text[1]) < 0xa0U ? 0 : length;
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
