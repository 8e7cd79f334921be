// Ids of ARGoS3 may have any characters, ours may not. The converter and the plug-in share these functions.
#pragma once

#include <string>
#include <string_view>

namespace swarmanoid::argos3
{

// Returns the id with '_' for each character that ours may not have. The same text always has the same result.
std::string OurCharacters(const std::string& id);

// Write any text as one word without blanks, and read it again.
std::string Encoded(std::string_view text);
std::string Decoded(std::string_view word);

}  // namespace swarmanoid::argos3
