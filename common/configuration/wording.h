// The wording that all errors about experiment files share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swarmanoid
{

// The text in single quotes, shortened and without control characters: files may hold anything.
std::string Quoted(std::string_view text);
// "a, b, c", or "none".
std::string Listed(const std::vector<std::string>& names);
// The candidate nearest to a misspelt name by edit distance, empty if none is near.
std::string NearestName(std::string_view name, const std::vector<std::string>& candidates);
// "; did you mean 'x'?", or nothing if no candidate is near.
std::string DidYouMean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace swarmanoid
