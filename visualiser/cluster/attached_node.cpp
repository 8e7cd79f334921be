#include "visualiser/cluster/attached_node.h"
#include "common/space/space.h"

namespace swarmanoid
{

AttachedNode::AttachedNode(WorkerSession& session, WorkerWorld& replica, Visualiser& visualiser, RemoteMonitor& monitor,
                           double rate)
    : session_(session),
      replica_(replica),
      visualiser_(visualiser),
      monitor_(monitor),
      // The server keeps the pace, so a state may be drawn a little earlier than the rate says.
      period_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(0.8 / rate))),
      run_(session.World().run),
      views_in_(session.GetBus(), session.World().experiment,
                [this](const ViewMessage& view)
                {
                  if (view.run != run_) return;
                  replica_.limits->Check(view.snapshot);
                  const std::lock_guard lock(mutex_);
                  snapshot_ = view.snapshot;
                  fresh_ = true;
                  session_.Notify();
                })
{
  monitor_.RequestViews(rate);
}

void AttachedNode::Work()
{
  monitor_.RenewRequests();
  std::unique_lock lock(mutex_);
  const bool last = fresh_ && snapshot_.last;
  const bool draw = fresh_ && (last || Clock::now() - drawn_ >= period_);
  if (draw)
  {
    fresh_ = false;
    drawn_ = Clock::now();
    replica_.space->Apply(snapshot_);
  }
  lock.unlock();
  terminated_ = draw ? visualiser_.Draw() : visualiser_.Idle();
  if (terminated_ || last) session_.Finish(replica_.space->GetTick());
}

}  // namespace swarmanoid
