// Lines of comma-separated values according to RFC 4180, for all code that writes or reads them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swarmanoid
{

// Returns a text as one field: in quotes if it holds a comma, a quote or a line end.
std::string CsvField(std::string_view text);

// Returns the fields of one line, without their quotes.
std::vector<std::string> CsvFields(std::string_view line);

}  // namespace swarmanoid
