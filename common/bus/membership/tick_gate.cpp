// One flag for each part says whether its message of this tick is here. Another one says whether its message of the
// next tick has come early; only parts with `may_lead` may send it.
//
// Invariants: missing_ is the number of parts that are not here; a part never skips a tick; a message of an earlier
// incarnation than the newest one of its part is dropped.
#include "common/bus/membership/tick_gate.h"

#include <fmt/ranges.h>
#include <algorithm>
#include <span>

#include "common/bus/bus.h"

namespace swarmanoid
{

TickGate::TickGate(std::vector<Part> parts, std::uint64_t first_tick)
    : parts_(std::move(parts)),
      here_(parts_.size(), 0),
      ahead_(parts_.size(), 0),
      incarnations_(parts_.size(), 0),
      missing_(parts_.size()),
      tick_(first_tick)
{
}

TickGate::Verdict TickGate::Offer(std::size_t part, std::uint64_t tick) const
{
  if (tick == tick_) return here_[part] ? Verdict::kDrop : Verdict::kExpected;
  if (tick + 1 == tick_) return Verdict::kBefore;
  if (tick < tick_) return Verdict::kDrop;
  if (tick == tick_ + 1 && parts_[part].may_lead) return ahead_[part] ? Verdict::kDrop : Verdict::kExpected;
  throw BadMessage(fmt::format("the {} is of tick {}, but tick {} has to come first", parts_[part].name, tick, tick_));
}

bool TickGate::Arrived(std::size_t part, std::uint64_t tick)
{
  if (tick == tick_ + 1)
    ahead_[part] = 1;
  else if (!here_[part])
  {
    here_[part] = 1;
    --missing_;
  }
  return missing_ == 0;
}

void TickGate::Next()
{
  here_.swap(ahead_);
  std::fill(ahead_.begin(), ahead_.end(), char{0});
  missing_ = static_cast<std::size_t>(std::count(here_.begin(), here_.end(), char{0}));
  ++tick_;
}

void TickGate::Withdraw(const std::string& name, std::uint32_t incarnation)
{
  for (std::size_t part = 0; part < parts_.size(); ++part)
  {
    if (parts_[part].name != name) continue;
    incarnations_[part] = std::max(incarnations_[part], incarnation);
    ahead_[part] = 0;
    if (!here_[part]) continue;
    here_[part] = 0;
    ++missing_;
  }
}

bool TickGate::IsReplaced(std::size_t part, std::uint32_t incarnation)
{
  if (incarnation < incarnations_[part]) return true;
  incarnations_[part] = incarnation;
  return false;
}

std::vector<std::string> TickGate::Missing() const
{
  std::vector<std::string> names;
  for (std::size_t part = 0; part < parts_.size(); ++part)
    if (!here_[part]) names.push_back(parts_[part].name);
  return names;
}

std::string Joined(const std::vector<std::string>& names)
{
  constexpr std::size_t kMostNamed = 6;
  const std::size_t named = names.size() <= kMostNamed + 1 ? names.size() : kMostNamed;
  const std::string text = fmt::to_string(fmt::join(std::span(names).first(named), ", "));
  return named == names.size() ? text : fmt::format("{} and {} others", text, names.size() - named);
}

}  // namespace swarmanoid
