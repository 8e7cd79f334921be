// Computes the positions of bytes in a text, for the readers of XML.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

// Computes line and column (from 1, in characters) of byte offsets. Ascending offsets are quick.
class PlaceCounter
{
public:
  PlaceCounter(std::string_view text, std::shared_ptr<const std::string> file)
      : text_(text), place_{std::move(file), 1, 1}
  {
  }

  SourceLocation At(std::size_t offset)
  {
    if (offset < offset_)
    {
      offset_ = 0;
      place_.line = place_.column = 1;
    }
    for (; offset_ < std::min(offset, text_.size()); ++offset_)
    {
      const bool continues = (static_cast<unsigned char>(text_[offset_]) & 0xC0U) == 0x80U;
      if (text_[offset_] == '\n')
      {
        ++place_.line;
        place_.column = 1;
      }
      else if (!continues)
      {
        ++place_.column;
      }
    }
    return place_;
  }

private:
  std::string_view text_;
  std::size_t offset_ = 0;
  SourceLocation place_;
};

}  // namespace swarmanoid
