// The thread of the run sends everything, between two ticks. Threads of the bus only leave requests and wake it. While
// no program watches, a tick costs the reading of a clock.
#include "launcher/bus/run_on_bus.h"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

#include "common/bus/membership/server_session.h"
#include "common/bus/membership/worker_world.h"
#include "common/checkpoint/library_builds.h"
#include "common/errors/print_error.h"
#include "common/messages/control_verbs.h"
#include "common/run/access/digest.h"
#include "controller_host/watched_robots.h"
#include "space_server/cluster/view_publisher.h"
#include "space_server/event_log.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kPeriod = 10ms;         // between two looks at what is due
constexpr double kLastViewTime_s = 1;  // observers may be stopped

}  // namespace

struct RunOnBus::Parts
{
  Parts(const BusOptions& options, WorldMessage world, const Roles& roles, RunOnBus& link)
      : session(options, std::move(world), {},
                {[this, &link](const ControlRequestMessage& request)
                 {
                   const ControlVerb* const verb = FindControlVerb(request.verb);
                   if (verb != nullptr && verb->who == Asker::kOwner) return grants.Ask(request);
                   link.Ask(request);
                 },
                 [&link] { link.woken_ = true; }, [this](const std::string& process) { views.Lost(process); },
                 [this](const ControlReplyMessage& reply)
                 {
                   grants.Replied(reply);
                   views.Renew();
                 }}),
        grants(session, options,
               {[this](const ViewRequestMessage& request) { views.Requested(request); },
                [&link](const ControlRequestMessage& note) { link.Note(note); }, [&link] { link.woken_ = true; }}),
        views(session, grants, [&link] { link.woken_ = true; }),
        watched(roles.host.Layout().robots),
        robots(session.GetBus(), session.World().experiment),
        requests(session.GetBus(), session.World().experiment,
                 [this, &link](const ViewRequestMessage& request)
                 {
                   if (request.run != session.World().run || !watched.Requested(request, Clock::now())) return;
                   link.robots_due_ = true;
                   link.woken_ = true;
                 })
  {
    session.GetBus().OnRefused(
        [&link](const BadMessageReport& report)
        {
          PrintError("refused a {} message of {}: {}\n", report.topic, report.sender, report.what);
          link.Note(NoteOf(kRefusedMessage, report.topic, report.sender));
        });
    robot_status.run = session.World().run;
    session.Open();
  }
  ~Parts()
  {
    grants.Stop();
    session.Close();
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  ServerSession session;
  AccessGrants grants;
  ViewPublisher views;
  WatchedRobots watched;
  SpaceSnapshot snapshot;
  RobotStatusMessage robot_status;
  Publisher<RobotStatusMessage> robots;
  Subscription<ViewRequestMessage> requests;
};

RunOnBus::RunOnBus(const PreparedRun& run, const std::optional<RunKey>& key) : run_(run)
{
  constexpr double kForEver_s = 3600;  // an observer that a debugger has stopped is not dead
  options_.domain = run.request->domain.value_or(options_.domain);
  options_.lease_s = run.request->lease_s > 0 ? run.request->lease_s : kForEver_s;
  options_.serves_discovery = true;
  options_.key = key;
  options_.insecure = !key;
}

RunOnBus::~RunOnBus() = default;

void RunOnBus::Open(const Roles& roles)
{
  roles_.emplace(roles);
  try
  {
    WorldMessage world = DescribeWorld(roles.server.Space(), NewRun(), run_.request->file, roles.assignment.table);
    world.recorded = run_.request->journal;
    ForEachLibrary(*run_.experiment,
                   [&](const std::string& name, const std::string& file, bool)
                   {
                     if (!file.empty()) world.libraries.push_back({name, DigestOfFile(file)});
                   });
    parts_ = std::make_unique<Parts>(options_, std::move(world), roles, *this);
    if (run_.request->journal)
      parts_->session.AnnounceFolder(std::filesystem::absolute(run_.folder.Path()).lexically_normal());
  }
  catch (const BusError& error)
  {
    parts_.reset();
    PrintError("no visualiser can be attached to this run: {}\n", error.what());
  }
}

void RunOnBus::Detach()
{
  const std::lock_guard lock(mutex_);
  roles_.reset();
}

void RunOnBus::Ask(const ControlRequestMessage& request)
{
  const std::lock_guard lock(mutex_);
  if (roles_) roles_->ask(request);
}

void RunOnBus::Note(const ControlRequestMessage& note)
{
  const std::lock_guard lock(mutex_);
  if (roles_) roles_->note(note);
}

void RunOnBus::Try(const std::function<void()>& code)
{
  try
  {
    code();
  }
  catch (const BusError& error)
  {
    if (!has_complained_) PrintError("attached visualisers miss something of the run: {}\n", error.what());
    has_complained_ = true;
  }
}

void RunOnBus::Publish(RunMonitor& run)
{
  const auto now = Clock::now();
  if (!woken_.exchange(false) && now < due_) return;
  due_ = now + kPeriod;
  Try([&] { Send(run, false); });
}

void RunOnBus::Send(RunMonitor& run, bool last)
{
  SpaceServer& server = roles_->server;
  tick_ = server.Space().GetTick();
  parts_->session.AnswerLeaves();
  parts_->grants.Work(tick_);
  const auto now = Clock::now();
  const RunStatus& status = run.Status();
  if (last || parts_->views.ViewIsDue(tick_, now))
  {
    SpaceSnapshot& snapshot = parts_->snapshot;
    server.Draw();
    server.WriteSnapshot(snapshot);
    snapshot.drawing = server.Space().GetDrawing();
    snapshot.real_time_factor = status.real_time_factor;
    if (last) snapshot.last = true;
    parts_->views.SendView(snapshot, now);
  }
  if (parts_->watched.AreAny()) SendRobots(robots_due_.exchange(false));
  if (last || parts_->views.StatusIsDue(status.phase, now)) parts_->views.SendStatus(status, now);
}

void RunOnBus::SendRobots(bool at_once)
{
  const std::vector<std::uint32_t> robots = parts_->watched.TakeDue(Clock::now(), at_once);
  if (robots.empty()) return;
  RobotStatusMessage& message = parts_->robot_status;
  message.robots.resize(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) roles_->host.Describe(robots[i], message.robots[i]);
  message.tick = message.robots.front().tick;
  parts_->robots.Write(message);
}

void RunOnBus::Reply(const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text)
{
  if (!IsOpen()) return;
  woken_ = true;
  Try([&] { parts_->session.Reply(request, done, tick, text); });
  const ControlVerb* const verb = FindControlVerb(request.verb);
  const bool is_announced = done && verb != nullptr && verb->announced && !request.client.empty();
  if (is_announced && !run_.request->quiet) PrintError("{}: {}\n", AskerOf(request), text);
}

std::vector<ProcessStatus> RunOnBus::Attached() const
{
  return IsOpen() ? parts_->session.Processes() : std::vector<ProcessStatus>();
}

void RunOnBus::Close(RunMonitor& run, bool begins_again)
{
  if (!IsOpen()) return;
  Try(
      [&]
      {
        if (!begins_again) Send(run, true);
        parts_->views.WaitUntilRead(kLastViewTime_s);
        parts_->grants.Leave(tick_, "", kLastViewTime_s);
        if (begins_again)
          parts_->session.LeaveToNext();
        else
          parts_->session.Leave(tick_, "");
      });
  parts_.reset();
}

void RunOnBus::Fail(const std::string& why)
{
  if (!IsOpen()) return;
  Try(
      [&]
      {
        parts_->grants.Leave(tick_, why, kLastViewTime_s);
        parts_->session.Leave(tick_, why);
      });
  parts_.reset();
}

}  // namespace swarmanoid
