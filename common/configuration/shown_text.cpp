#include "common/configuration/shown_text.h"

#include <algorithm>
#include <cstdint>

#include "common/configuration/utf8.h"

namespace swarmanoid
{
namespace
{

enum class Lines
{
  kOne,
  kMany
};

// Returns the length of the character at the start of `text`, or 0 if it must not be shown.
std::size_t CharacterLength(std::string_view text, Lines lines)
{
  const auto lead = static_cast<std::uint8_t>(text.front());
  const std::size_t length = Utf8Length(text);
  const bool is_separator = lead == '\n' || lead == '\t';
  if (is_separator) return lines == Lines::kMany ? 1 : 0;
  if (length == 1) return lead >= 0x20U && lead != 0x7fU ? 1 : 0;
  // Control characters have two bytes too.
  return length == 2 && lead == 0xc2U && static_cast<std::uint8_t>(text[1]) < 0xa0U ? 0 : length;
}

bool IsShowable(std::string_view text, Lines lines)
{
  while (!text.empty())
  {
    const std::size_t length = CharacterLength(text, lines);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string Showable(std::string_view text, std::size_t most_bytes, Lines lines)
{
  std::string shown;
  while (!text.empty())
  {
    const std::size_t length = CharacterLength(text, lines);
    const std::string_view next = length == 0 ? std::string_view("?") : text.substr(0, length);
    if (shown.size() + next.size() > most_bytes) break;
    shown += next;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return shown;
}

}  // namespace

bool IsShowable(std::string_view text) { return IsShowable(text, Lines::kMany); }
bool IsShowableLine(std::string_view text) { return IsShowable(text, Lines::kOne); }
std::string Showable(std::string_view text, std::size_t most_bytes) { return Showable(text, most_bytes, Lines::kMany); }
std::string ShowableLine(std::string_view text, std::size_t most_bytes)
{
  return Showable(text, most_bytes, Lines::kOne);
}

}  // namespace swarmanoid
