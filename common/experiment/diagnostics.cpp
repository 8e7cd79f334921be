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

std::vector<Diagnostic> Diagnostics::Take()
{
  std::stable_sort(found_.begin(), found_.end(),
                   [](const Diagnostic& a, const Diagnostic& b) {
                     return std::tie(a.location.line, a.location.column) < std::tie(b.location.line, b.location.column);
                   });
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
