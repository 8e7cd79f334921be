#include "common/experiment/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostDiagnostics = 1000;

}  // namespace

void Diagnostics::Add(const SourceLocation& location, std::string message)
{
  ++count_;
  if (found_.size() < kMostDiagnostics) found_.push_back({location, std::move(message)});
}

bool Diagnostics::IsLost(std::string_view name) const
{
  if (lost_.contains(name)) return true;
  const std::size_t number = name.find_last_not_of("0123456789") + 1;
  return number > 1 && number < name.size() && name[number - 1] == '_' && lost_.contains(name.substr(0, number - 1));
}

std::vector<Diagnostic> Diagnostics::Take(const std::string& experiment_file)
{
  const auto key = [&](const Diagnostic& diagnostic)
  {
    const std::string* file = diagnostic.location.file.get();
    const bool is_own = file == nullptr || *file == experiment_file || experiment_file.empty();
    return std::tuple(is_own, is_own ? std::string_view() : std::string_view(*file), diagnostic.location.line,
                      diagnostic.location.column);
  };
  std::stable_sort(found_.begin(), found_.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
  if (count_ > found_.size())
  {
    Diagnostic rest;
    rest.location.file = found_.front().location.file;
    rest.message = fmt::format("and {} more mistakes", count_ - found_.size());
    found_.push_back(std::move(rest));
  }
  count_ = 0;
  return std::exchange(found_, {});
}

}  // namespace swarmanoid
