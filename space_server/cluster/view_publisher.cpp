#include "space_server/cluster/view_publisher.h"

#include <algorithm>
#include <utility>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr double kMostViews = 30;  // each second
// An unchanged state is sent again for a while. Fast DDS may lose messages while a new reader is matched. A client that
// sent a request cannot tell which views are newer than the reply.
constexpr auto kTimeOfRepeats = 10s;
constexpr auto kTimeUntilNews = 10ms;  // a view may be sent, but the state is the one that was sent before
constexpr int kLeastViews = 4;
constexpr auto kStatusPeriod = 100ms;
constexpr auto kRequestTime = 3s;  // a request that is not repeated ends after this time

ViewPublisher::Clock::duration Period(double rate)
{
  return std::chrono::duration_cast<ViewPublisher::Clock::duration>(std::chrono::duration<double>(1 / rate));
}

}  // namespace

ViewPublisher::ViewPublisher(ServerSession& session, AccessGrants& grants, std::function<void()> woken)
    : session_(session),
      grants_(grants),
      woken_(std::move(woken)),
      views_(session.GetBus(), session.World().experiment),
      statuses_(session.GetBus(), session.World().experiment),
      requests_in_(std::make_unique<Subscription<ViewRequestMessage>>(
          session.GetBus(), session.World().experiment, [this](const ViewRequestMessage& w) { Requested(w); }))
{
  view_.run = status_.run = session.World().run;
}

ViewPublisher::~ViewPublisher() { requests_in_.reset(); }

void ViewPublisher::Requested(const ViewRequestMessage& request)
{
  if (request.run != session_.World().run) return;
  {
    const std::lock_guard lock(mutex_);
    const auto [client_request, is_new] = requests_.try_emplace(request.client);
    const bool same = client_request->second.views == request.views;
    client_request->second = {request.views, Clock::now()};
    if (is_new && request.views > 0) asked_first_ = true;
    if (same) return;
  }
  woken_();
}

void ViewPublisher::Lost(const std::string& process)
{
  const std::lock_guard lock(mutex_);
  requests_.erase(process);
}

// Returns the period of the fastest client. Readers that have sent no request get the highest rate.
ViewPublisher::Clock::duration ViewPublisher::ViewPeriod(Clock::time_point now) const
{
  const std::lock_guard lock(mutex_);
  double rate = 0;
  unsigned viewers = 0;
  for (const auto& [client, client_request] : requests_)
  {
    if (now - client_request.heard < kRequestTime) rate = std::max(rate, client_request.views);
    if (client_request.views > 0) ++viewers;
  }
  if (viewers_ > viewers) rate = kMostViews;
  if (rate <= 0) return 1h;
  return std::max(Period(std::min(rate, kMostViews)), shortest_period_);
}

bool ViewPublisher::ViewIsDue(std::uint64_t tick, Clock::time_point now)
{
  const unsigned readers = Viewers();
  const bool newcomers = TakeAskedFirst() || readers > viewers_;
  viewers_ = readers;
  if (readers == 0) return false;
  if (changed_.exchange(false) || newcomers)
  {
    repeats_until_ = now + kTimeOfRepeats;
    views_left_ = kLeastViews;
  }
  if (newcomers) return true;
  const bool sends = tick != viewed_tick_ || views_left_ > 0 || now < repeats_until_;
  return sends && now >= viewed_ + ViewPeriod(now);
}

bool ViewPublisher::TakeAskedFirst()
{
  const std::lock_guard lock(mutex_);
  return std::exchange(asked_first_, false);
}

void ViewPublisher::SendView(SpaceSnapshot& snapshot, Clock::time_point now)
{
  std::swap(view_.snapshot, snapshot);
  views_.Write(view_);
  grants_.Write(view_);
  std::swap(view_.snapshot, snapshot);
  if (views_left_ > 0) --views_left_;
  viewed_tick_ = snapshot.tick;
  viewed_ = now;
  // Views take at most a tenth of the time.
  shortest_period_ = 10 * (Clock::now() - now);
}

bool ViewPublisher::StatusIsDue(RunStatus::Phase phase, Clock::time_point now)
{
  const unsigned readers = statuses_.Readers() + grants_.StatusReaders();
  const bool newcomers = readers > status_readers_;
  status_readers_ = readers;
  if (readers == 0) return false;
  return newcomers || phase != said_phase_ || now >= said_ + kStatusPeriod;
}

void ViewPublisher::SendStatus(const RunStatus& status, Clock::time_point now)
{
  status_.status = status;
  statuses_.Write(status_);
  grants_.Write(status_);
  said_phase_ = status.phase;
  said_ = now;
}

// A stopped observer reads neither topic, so wait for it only once.
void ViewPublisher::WaitUntilRead(double seconds)
{
  if (views_.WaitUntilRead(seconds)) statuses_.WaitUntilRead(seconds);
}

ViewPublisher::Clock::time_point ViewPublisher::Next(Clock::time_point now) const
{
  Clock::time_point next = Clock::time_point::max();
  if (viewers_ > 0) next = viewed_ + ViewPeriod(now);
  if (status_readers_ > 0) next = std::min(next, said_ + kStatusPeriod);
  return next > now ? next : now + kTimeUntilNews;
}

}  // namespace swarmanoid
