// The wording of all errors about experiment files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swarmanoid
{

// Returns the text in single quotes, shortened and without control characters, since files may hold any bytes.
std::string Quoted(std::string_view text);
// Returns "a, b, c", or "none".
std::string Listed(const std::vector<std::string>& names);
// Returns the candidate nearest to a misspelt name by edit distance, empty if none is near.
std::string NearestName(std::string_view name, const std::vector<std::string>& candidates);
// Returns "; did you mean 'x'?", or an empty text if no candidate is near.
std::string DidYouMean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace swarmanoid
