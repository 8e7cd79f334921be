#include "space_server/cluster/audience.h"

#include <algorithm>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr double kMostViews = 30;  // a second
constexpr auto kStatusPeriod = 100ms;
constexpr auto kWishTime = 3s;  // after which a wish that is not repeated is void

Audience::Clock::duration Period(double rate)
{
  return std::chrono::duration_cast<Audience::Clock::duration>(std::chrono::duration<double>(1 / rate));
}

}  // namespace

Audience::Audience(ServerSession& session, std::function<void()> woken)
    : session_(session),
      woken_(std::move(woken)),
      views_(session.GetBus(), session.World().experiment),
      statuses_(session.GetBus(), session.World().experiment),
      wishes_in_(std::make_unique<Subscription<WishesMessage>>(session.GetBus(), session.World().experiment,
                                                               [this](const WishesMessage& w) { Wished(w); }))
{
  view_.run = status_.run = session.World().run;
}

Audience::~Audience() { wishes_in_.reset(); }

void Audience::Wished(const WishesMessage& wishes)
{
  if (wishes.run != session_.World().run) return;
  {
    const std::lock_guard lock(mutex_);
    Wish& wish = wishes_[wishes.client];
    const bool same = wish.views == wishes.views;
    wish = {wishes.views, Clock::now()};
    if (same) return;
  }
  woken_();
}

void Audience::Gone(const std::string& process)
{
  const std::lock_guard lock(mutex_);
  wishes_.erase(process);
}

// The pace of the one who wishes for most. Readers that have told no wish get the most there is.
Audience::Clock::duration Audience::ViewPeriod(Clock::time_point now) const
{
  const std::lock_guard lock(mutex_);
  double rate = 0;
  unsigned viewers = 0;
  for (const auto& [client, wish] : wishes_)
  {
    if (now - wish.heard < kWishTime) rate = std::max(rate, wish.views);
    if (wish.views > 0) ++viewers;
  }
  if (viewers_ > viewers) rate = kMostViews;
  if (rate <= 0) return 1h;
  return std::max(Period(std::min(rate, kMostViews)), shortest_period_);
}

bool Audience::ViewIsDue(std::uint64_t tick, Clock::time_point now)
{
  const unsigned readers = views_.Readers();
  const bool newcomers = readers > viewers_;
  viewers_ = readers;
  if (readers == 0) return false;
  if (newcomers) return true;
  if (tick == viewed_tick_ && !changed_) return false;
  return now >= viewed_ + ViewPeriod(now);
}

void Audience::SendView(SpaceSnapshot& snapshot, Clock::time_point now)
{
  std::swap(view_.snapshot, snapshot);
  views_.Write(view_);
  std::swap(view_.snapshot, snapshot);
  changed_ = false;
  viewed_tick_ = snapshot.tick;
  viewed_ = now;
  // At most a tenth of the time goes into views.
  shortest_period_ = 10 * (Clock::now() - now);
}

bool Audience::StatusIsDue(RunStatus::Phase phase, Clock::time_point now)
{
  const unsigned readers = statuses_.Readers();
  const bool newcomers = readers > status_readers_;
  status_readers_ = readers;
  if (readers == 0) return false;
  return newcomers || phase != said_phase_ || now >= said_ + kStatusPeriod;
}

void Audience::SendStatus(const RunStatus& status, Clock::time_point now)
{
  status_.status = status;
  statuses_.Write(status_);
  said_phase_ = status.phase;
  said_ = now;
}

Audience::Clock::time_point Audience::Next() const
{
  Clock::time_point next = Clock::time_point::max();
  if (viewers_ > 0) next = viewed_ + ViewPeriod(Clock::now());
  if (status_readers_ > 0) next = std::min(next, said_ + kStatusPeriod);
  return next;
}

}  // namespace swarmanoid
