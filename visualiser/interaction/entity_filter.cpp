#include "visualiser/interaction/entity_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <sstream>
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

std::string Lower(std::string_view text)
{
  std::string lower(text);
  for (char& letter : lower)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return lower;
}

// Returns whether the word is in one of the lines. "column:part" must be in that column; any other word in any column,
// not in its name.
bool Holds(const std::string& text, const std::string& word)
{
  const std::size_t colon = word.find(':');
  for (std::size_t line = 0; line < text.size(); line = text.find('\n', line) + 1)
  {
    const std::size_t start = text.find(':', line) + 1;
    const std::string_view column(&text[line], start - line);
    const std::string_view value(&text[start], text.find('\n', line) - start);
    const bool named = colon != std::string::npos && column == std::string_view(word).substr(0, colon + 1);
    if (named && value.find(std::string_view(word).substr(colon + 1)) != std::string_view::npos) return true;
    if (value.find(word) != std::string_view::npos) return true;
  }
  return false;
}

}  // namespace

EntityFilter::EntityFilter(const CSwarmanoidSpace& space, const Assignment& assignment)
{
  for (std::size_t e = 0; e < space.Size(); ++e)
  {
    const EntityConfiguration& configuration = space.GetEntity(e).GetConfiguration();
    texts_.push_back(Lower(fmt::format("id:{}\nkind:{}\ncontroller:{}\nengine:{}\nhost:{}\n", configuration.id,
                                       TagName(configuration.kind), configuration.controller,
                                       OwnerName(space.GetExperiment(), assignment, e), HostNameOf(assignment, e))));
  }
  matching_.resize(texts_.size());
  std::iota(matching_.begin(), matching_.end(), 0U);
}

const std::vector<std::uint32_t>& EntityFilter::Matching(std::string_view filter)
{
  if (filter == filter_) return matching_;
  filter_ = filter;
  std::vector<std::string> words;
  std::istringstream stream(Lower(filter));
  for (std::string word; stream >> word;) words.push_back(word);
  matching_.clear();
  for (std::uint32_t e = 0; e < texts_.size(); ++e)
  {
    const auto found = [&](const std::string& word) { return Holds(texts_[e], word); };
    if (std::all_of(words.begin(), words.end(), found)) matching_.push_back(e);
  }
  return matching_;
}

}  // namespace swarmanoid
