// LineWriter: composes one line without allocation or locks, for signal handlers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace swarmanoid
{

class LineWriter
{
public:
  static constexpr std::size_t kSize = 1024;

  LineWriter& Add(std::string_view text)
  {
    // Space is kept for the end of the line and a final zero.
    for (const char c : text)
      if (length_ + 2 < kSize) text_[length_++] = c == '\n' ? ' ' : c;
    return *this;
  }

  LineWriter& Add(std::uint64_t number, unsigned base = 10)
  {
    char digits[24];
    std::size_t first = sizeof digits;
    do {
      digits[--first] = "0123456789abcdef"[number % base];
      number /= base;
    } while (number != 0);
    return Add(std::string_view(digits + first, sizeof digits - first));
  }

  LineWriter& AddSigned(std::int64_t number)
  {
    if (number < 0) Add("-");
    return Add(static_cast<std::uint64_t>(number < 0 ? -number : number));
  }

  std::string_view Text() const { return {text_, length_}; }

private:
  char text_[kSize] = {};
  std::size_t length_ = 0;
};

}  // namespace swarmanoid
