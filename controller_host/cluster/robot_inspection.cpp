#include "controller_host/cluster/robot_inspection.h"

namespace swarmanoid
{

RobotInspection::RobotInspection(WorkerSession& session, const ControllerHost& role, std::uint32_t host,
                                 std::mutex& step)
    : session_(session),
      role_(role),
      step_(step),
      watched_(role.Layout().robots),
      statuses_(session.GetBus(), session.World().experiment)
{
  message_.run = session.World().run;
  message_.source = host;
  requests_in_ = std::make_unique<Subscription<ViewRequestMessage>>(
      session.GetBus(), session.World().experiment, [this](const ViewRequestMessage& w) { Requested(w); });
}

RobotInspection::~RobotInspection() { requests_in_.reset(); }

void RobotInspection::Requested(const ViewRequestMessage& request)
{
  if (request.run != session_.World().run || !watched_.Requested(request, WatchedRobots::Clock::now())) return;
  const std::lock_guard step(step_);
  Publish(true);
}

void RobotInspection::Publish(bool at_once)
{
  const std::vector<std::uint32_t> robots = watched_.TakeDue(WatchedRobots::Clock::now(), at_once);
  if (robots.empty()) return;
  message_.robots.resize(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) role_.Describe(robots[i], message_.robots[i]);
  message_.tick = message_.robots.front().tick;
  try
  {
    statuses_.Write(message_);
  }
  catch (const BusError&)
  {
    // An observer misses one message, and the run goes on.
  }
}

}  // namespace swarmanoid
