// The hint "did you mean" is the known name with the smallest edit distance: insertions, deletions, changes and
// exchanges of neighbours count one each (F. J. Damerau, "A technique for computer detection and correction of spelling
// errors", Communications of the ACM 7(3), 1964). The more letters a name has, the more mistakes are forgiven. Long
// names are skipped, since the time grows with the product of the lengths.
#include "common/configuration/wording.h"

#include <algorithm>
#include <cctype>

namespace swarmanoid
{
namespace
{

constexpr std::size_t kLongestQuote = 60;
constexpr std::size_t kLongestGuess = 64;
constexpr std::size_t kLeastBeginning = 4;  // letters that make the beginning of a name a hint

// Returns the Levenshtein distance with exchanges of neighbours. Letters are compared without case.
std::size_t EditDistance(std::string_view a, std::string_view b)
{
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string Quoted(std::string_view text)
{
  std::string quoted = "'";
  std::size_t end = std::min(text.size(), kLongestQuote);
  // The cut is not within a UTF-8 character.
  while (end < text.size() && end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  for (const char c : text.substr(0, end)) quoted += std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
  return quoted + (end < text.size() ? "…'" : "'");
}

std::string Listed(const std::vector<std::string>& names)
{
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none" : list;
}

std::string NearestName(std::string_view name, const std::vector<std::string>& candidates)
{
  if (name.size() > kLongestGuess) return {};
  std::string nearest;
  // Distances count in halves, so that of two candidates at equal distance the one of equal length is nearer.
  std::size_t least = 2 * std::max<std::size_t>(1, name.size() / 3) + 2;
  for (const std::string& candidate : candidates)
  {
    if (candidate.size() > kLongestGuess) continue;
    std::size_t distance = 2 * EditDistance(name, candidate) + (name.size() == candidate.size() ? 0 : 1);
    const bool begun = std::min(name.size(), candidate.size()) >= kLeastBeginning &&
                       (candidate.starts_with(name) || name.starts_with(candidate));
    if (begun) distance = std::min<std::size_t>(distance, 3);
    if (distance >= least || distance >= 2 * name.size()) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string DidYouMean(std::string_view name, const std::vector<std::string>& candidates)
{
  const std::string nearest = NearestName(name, candidates);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace swarmanoid
