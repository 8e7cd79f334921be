// Messages arrive in threads of the bus and are stored in the heard_… members, which `mutex_` guards. Each reader
// copies them to members of the main thread, so a reference that it returns stays valid while further messages arrive.
// Requests are repeated once a second, since the space server forgets observers that are silent. An answer that the
// server repeats is one note only.
#include "visualiser/cluster/remote_monitor.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/run/access/run_directory.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr std::size_t kNotesKept = 100;
constexpr auto kRenewRequests = 1s;

}  // namespace

RemoteMonitor::RemoteMonitor(Bus& bus, const WorldMessage& world, bool every_tick)
    : bus_(bus), partition_(world.experiment), run_(world.run), entities_(world.entities.size())
{
  requests_.client = ProcessId();
  requests_.run = world.run;
  requests_.every_tick = every_tick;
}

const RunStatus& RemoteMonitor::Status()
{
  if (statuses_in_ == nullptr)
    statuses_in_ = std::make_unique<Subscription<RunStatusMessage>>(bus_, partition_,
                                                                    [this](const RunStatusMessage& message)
                                                                    {
                                                                      const std::lock_guard lock(mutex_);
                                                                      if (message.run == run_ && !over_)
                                                                        heard_status_ = message.status;
                                                                    });
  const std::lock_guard lock(mutex_);
  status_ = heard_status_;
  return status_;
}

std::span<const RunNote> RemoteMonitor::Notes()
{
  if (replies_in_ == nullptr)
    replies_in_ = std::make_unique<Subscription<ControlReplyMessage>>(
        bus_, partition_,
        [this](const ControlReplyMessage& reply)
        {
          const std::lock_guard lock(mutex_);
          // The server sends an answer again if the sender of the request did not receive it.
          const auto same = [&](const RunNote& note)
          { return note.from == reply.client && note.number == reply.number && note.text == reply.text; };
          if (std::ranges::any_of(heard_notes_, same)) return;
          AddNote({reply.tick, reply.ok, reply.text, reply.client, reply.number});
        });
  const std::lock_guard lock(mutex_);
  notes_ = heard_notes_;
  return notes_;
}

void RemoteMonitor::AddNote(RunNote note)
{
  heard_notes_.push_back(std::move(note));
  if (heard_notes_.size() > kNotesKept) heard_notes_.erase(heard_notes_.begin());
}

void RemoteMonitor::NoteRefusal(const std::string& text)
{
  const std::lock_guard lock(mutex_);
  AddNote({.tick = heard_status_.tick, .done = false, .text = text, .from = ProcessId()});
}

std::string RemoteMonitor::RunFolder() { return FolderOfRun(partition_, run_); }

void RemoteMonitor::Watch(std::span<const std::uint32_t> robots)
{
  if (std::ranges::equal(robots, requests_.robots)) return;
  requests_.robots.assign(robots.begin(), robots.end());
  if (robots_in_ == nullptr)
    robots_in_ = std::make_unique<Subscription<RobotStatusMessage>>(bus_, partition_,
                                                                    [this](const RobotStatusMessage& message)
                                                                    {
                                                                      if (message.run == run_) Heard(message);
                                                                    });
  // The status of robots that were not watched for a while is outdated.
  const auto unwatched = [&](const auto& robot) { return std::ranges::find(robots, robot.first) == robots.end(); };
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(heard_robots_, unwatched);
  }
  std::erase_if(robots_, unwatched);
  SendRequests();
}

void RemoteMonitor::Heard(const RobotStatusMessage& message)
{
  for (const RobotStatus& robot : message.robots)
    if (robot.entity >= entities_)
      throw BadMessage(fmt::format("robots.entity: there is no entity {} of {}", robot.entity, entities_));
  const std::lock_guard lock(mutex_);
  for (const RobotStatus& robot : message.robots)
  {
    RobotStatus& heard = heard_robots_[robot.entity] = robot;
    heard.tick = message.tick;
  }
}

const RobotStatus* RemoteMonitor::Robot(std::uint32_t robot)
{
  if (std::ranges::find(requests_.robots, robot) == requests_.robots.end()) return nullptr;
  const std::lock_guard lock(mutex_);
  const auto heard = heard_robots_.find(robot);
  if (heard == heard_robots_.end()) return nullptr;
  RobotStatus& own = robots_[robot];
  if (own.tick != heard->second.tick || own.controller.empty()) own = heard->second;
  return &own;
}

RunStatus::Phase RemoteMonitor::KnownPhase()
{
  const std::lock_guard lock(mutex_);
  return heard_status_.phase;
}

void RemoteMonitor::RequestViews(double views)
{
  if (requests_.views == views) return;
  requests_.views = views;
  SendRequests();
}

void RemoteMonitor::SendRequests()
{
  if (requests_out_ == nullptr) requests_out_ = std::make_unique<Publisher<ViewRequestMessage>>(bus_, partition_);
  requests_out_->Write(requests_);
  requested_ = Clock::now();
}

void RemoteMonitor::RenewRequests()
{
  if (requests_out_ == nullptr || Clock::now() - requested_ < kRenewRequests) return;
  if (requests_.views > 0 || !requests_.robots.empty()) SendRequests();
}

void RemoteMonitor::ServerIsLost()
{
  const std::lock_guard lock(mutex_);
  heard_status_.phase = RunStatus::Phase::kWaiting;
  for (ProcessStatus& process : heard_status_.processes) process.late_s = 0;
}

void RemoteMonitor::FollowRun(std::uint64_t run)
{
  run_ = requests_.run = run;
  if (requests_out_ != nullptr) SendRequests();
}

void RemoteMonitor::RunIsOver(const std::string& why)
{
  const std::lock_guard lock(mutex_);
  over_ = true;
  if (heard_status_.phase == RunStatus::Phase::kFinished) return;
  heard_status_.phase = RunStatus::Phase::kFinished;
  for (ProcessStatus& process : heard_status_.processes) process.late_s = 0;
  heard_status_.ended = why;
}

}  // namespace swarmanoid
