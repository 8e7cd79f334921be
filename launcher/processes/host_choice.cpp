#include "launcher/processes/host_choice.h"

#include <fmt/format.h>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kSettling = 500ms;  // after a start
constexpr auto kMeasured = 1500ms;
constexpr double kWorthIt = 1.1;  // as fast as with one host fewer, at least

}  // namespace

std::optional<unsigned> HostChoice::Take(std::uint64_t tick, Clock::time_point now)
{
  if (over_) return std::nullopt;
  if (!begun_) begun_ = Begin{now, std::nullopt};
  if (!begun_->tick)
  {
    if (now - begun_->at >= kSettling) begun_ = Begin{now, tick};
    return std::nullopt;
  }
  if (now - begun_->at < kMeasured || tick <= *begun_->tick) return std::nullopt;
  rates_.push_back(static_cast<double>(tick - *begun_->tick) / std::chrono::duration<double>(now - begun_->at).count());
  begun_.reset();
  const auto hosts = static_cast<unsigned>(rates_.size());
  const bool pays = hosts == 1 || rates_[hosts - 1] >= kWorthIt * rates_[hosts - 2];
  chosen_ = pays ? hosts : hosts - 1;
  over_ = !pays || hosts == most_;
  if (over_) return chosen_ == hosts ? std::nullopt : std::optional(chosen_);
  return hosts + 1;
}

std::string HostChoice::Text() const
{
  if (rates_.empty()) return "controller hosts: 1, since no core is free for another one";
  std::string text = fmt::format("controller hosts: {} ({:.0f} ticks a second", chosen_, rates_[chosen_ - 1]);
  const char* before = "; ";
  for (std::size_t k = 0; k < rates_.size(); ++k)
  {
    if (k + 1 == chosen_) continue;
    text += fmt::format("{}{:.0f} with {}", before, rates_[k], k + 1);
    before = ", ";
  }
  return text + ")";
}

}  // namespace swarmanoid
