#include "argos3/converter/our_ids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace swarmanoid::argos3
{
namespace
{

constexpr std::size_t kLongest = 64;  // of our ids

bool IsLetterOrDigit(char c) { return (c & 0x80) == 0 && std::isalnum(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::string OurCharacters(const std::string& id)
{
  std::string ours;
  for (const char c : id)
    if (IsLetterOrDigit(c) || std::string_view("_.:-").find(c) != std::string_view::npos)
      ours += c;
    else if ((c & 0xc0) != 0x80)  // once for each character of UTF-8
      ours += '_';
  ours.resize(std::min(ours.size(), kLongest));
  if (!ours.empty() && !IsLetterOrDigit(ours.front())) ours.front() = '_';
  return ours.empty() ? "_" : ours;
}

std::string Encoded(std::string_view text)
{
  std::string word;
  for (const char c : text)
    if (c > ' ' && c < 0x7f && c != '%')
      word += c;
    else
      word += fmt::format("%{:02x}", static_cast<unsigned char>(c));
  return word;
}

std::string Decoded(std::string_view word)
{
  std::string text;
  for (std::size_t k = 0; k < word.size(); ++k)
  {
    unsigned byte = 0;
    const char* const digits = word.data() + k + 1;
    if (word[k] == '%' && k + 2 < word.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2)
    {
      text += static_cast<char>(byte);
      k += 2;
    }
    else
      text += word[k];
  }
  return text;
}

}  // namespace swarmanoid::argos3
