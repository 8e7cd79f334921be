#include "bt_numbers.h"

#include <charconv>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>

void BTSaveNumber(std::ostream& state, double value)
{
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  state << std::string_view(text, static_cast<std::size_t>(end - text)) << ' ';
}

double BTLoadNumber(std::istream& state)
{
  std::string text;
  state >> text;
  double value = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc())
    throw std::runtime_error("the saved state of a behaviour is damaged");
  return value;
}
