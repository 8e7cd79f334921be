#include "visualiser/cluster/synchronous_node.h"

#include <fmt/format.h>
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr double kViewsWhilePaused = 30;  // a second

}  // namespace

SynchronousNode::SynchronousNode(WorkerSession& session, WorkerWorld& replica, std::size_t number,
                                 Visualiser& visualiser, ExperimentControl& control, RemoteMonitor& monitor,
                                 std::uint64_t first_tick)
    : session_(session),
      replica_(replica),
      number_(static_cast<std::uint32_t>(number)),
      visualiser_(visualiser),
      control_(control),
      monitor_(monitor),
      next_(first_tick),
      drawn_(session.GetBus(), session.Scope(TickLimits::DrawnBytes(), 1)),
      states_in_(session.GetBus(), session.Scope(replica.limits->StateBytes(), 1),
                 {[this](const MessageHeader& header) { return PlaceOfState(header); },
                  [this](const MessageHeader& header, SpaceState& state) { StateArrived(header, state); },
                  [this](const MessageHeader& header, const SpaceState& s) { replica_.limits->Check(header, s); }})
{
}

void SynchronousNode::WaitForServer()
{
  session_.WaitUntil([this] { return states_in_.Writers() >= 1 && drawn_.Readers() >= 1; },
                     [] { return std::string("the space server's topics"); });
}

void SynchronousNode::Work()
{
  monitor_.RenewRequests();
  std::unique_lock lock(mutex_);
  if (!fresh_)
  {
    const bool finished = finished_;
    lock.unlock();
    if (!finished) Idle();
    return;
  }
  replica_.space->Apply(state_);
  const bool last = state_.last;
  const std::uint64_t tick = state_.tick;
  lock.unlock();

  answer_.terminate |= visualiser_.Draw();
  lock.lock();
  fresh_ = false;
  next_ = tick + 1;
  session_.SetTick(tick);
  finished_ |= last;
  drawn_.Write(session_.Header(tick, number_), answer_);
  if (last) session_.Finish(tick);
}

void SynchronousNode::Idle()
{
  ShowHeldState();
  // The answer to the last tick is sent already, so a paused run would not receive the request to end in it.
  if (visualiser_.Idle() && !std::exchange(answer_.terminate, true)) control_.Stop();
}

// Shows the next state, which the server holds back while the run is paused. Users may move entities in it. Attached
// visualisers see that state, and so does a visualisation that shows the status of the run.
void SynchronousNode::ShowHeldState()
{
  const bool paused = monitor_.KnownPhase() == RunStatus::Phase::kPaused;
  if (paused == (views_in_ != nullptr))
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(held_fresh_, false) && held_.tick == next_ && !fresh_) replica_.space->Apply(held_);
    return;
  }
  if (!paused)
    views_in_.reset();
  else
    views_in_ = std::make_unique<Subscription<ViewMessage>>(session_.GetBus(), session_.World().experiment,
                                                            [this](const ViewMessage& view)
                                                            {
                                                              if (view.run != session_.World().run) return;
                                                              replica_.limits->Check(view.snapshot);
                                                              const std::lock_guard lock(mutex_);
                                                              held_ = view.snapshot;
                                                              held_fresh_ = true;
                                                              session_.Notify();
                                                            });
  monitor_.RequestViews(paused ? kViewsWhilePaused : 0);
}

SpaceState* SynchronousNode::PlaceOfState(const MessageHeader& header)
{
  if (header.run != session_.World().run) return nullptr;
  const std::lock_guard lock(mutex_);
  if (header.tick > next_)
    throw BadMessage(
        fmt::format("the state of the space server is of tick {}, but tick {} has to come first", header.tick, next_));
  return header.tick == next_ && !fresh_ ? &state_ : &repeated_;
}

void SynchronousNode::StateArrived(const MessageHeader& header, SpaceState& state)
{
  const std::lock_guard lock(mutex_);
  if (&state == &state_)
  {
    fresh_ = true;
    session_.Notify();
    return;
  }
  if (header.tick + 1 != next_ || fresh_ || finished_) return;
  // If the last drawn tick comes again, the run has ended, or our answer was lost.
  if (state.last)
  {
    finished_ = true;
    session_.Finish(header.tick);
  }
  else
    drawn_.Write(session_.Header(header.tick, number_), answer_);
}

}  // namespace swarmanoid
