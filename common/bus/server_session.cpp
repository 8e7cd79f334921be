#include "common/bus/server_session.h"

#include <fmt/format.h>
#include <cstdio>

namespace swarmanoid
{

namespace
{

constexpr double kLeaveTime_s = 1.0;

// Two experiments of one name in one domain would hear each other.
void RefuseSecondServer(const std::string& experiment, int domain)
{
  for (const LocalRun& run : FindLocalRuns())
    if (run.experiment == experiment && run.domain == domain)
      throw BusError(
          fmt::format("experiment '{}' runs already in domain {} (space server: process {}); choose another --domain",
                      experiment, domain, run.server));
}

}  // namespace

ServerSession::ServerSession(const BusOptions& options, WorldMessage world, std::vector<std::string> expected,
                             Callbacks callbacks)
    : world_(std::move(world)),
      expected_(std::move(expected)),
      callbacks_(std::move(callbacks)),
      directory_((RemoveDeadRuns(), RefuseSecondServer(world_.experiment, options.domain), world_.experiment),
                 world_.run),
      bus_(options, "space server")
{
  for (const std::string& name : expected_) members_[name];
  directory_.Announce(world_.experiment, options.domain);
  world_.host = MachineName();
  const std::string process = ProcessId();
  world_.pid = static_cast<std::uint32_t>(std::stoul(process.substr(process.rfind(':') + 1)));
  world_.spread = options.Spread();

  const std::string& partition = world_.experiment;
  leave_ = std::make_unique<Publisher<LeaveMessage>>(bus_, partition);
  replies_ = std::make_unique<Publisher<ControlReplyMessage>>(bus_, partition);
  worlds_ = std::make_unique<Publisher<WorldMessage>>(bus_, partition);
}

void ServerSession::Open()
{
  const std::string& partition = world_.experiment;
  bus_.OnProcessGone([this](const std::string& gone, const std::string&, bool died) { Lost(gone, died); });
  bus_.OnBadMessage([this](const BadMessageReport& report) { return FailedBy(report); });
  joins_ =
      std::make_unique<Subscription<JoinMessage>>(bus_, partition, [this](const JoinMessage& join) { Joined(join); });
  leaves_ = std::make_unique<Subscription<LeaveMessage>>(bus_, partition,
                                                         [this](const LeaveMessage& leave) { MemberLeft(leave); });
  statuses_ = std::make_unique<Subscription<StatusMessage>>(bus_, partition,
                                                            [this](const StatusMessage& status)
                                                            {
                                                              if (status.run != world_.run) return;
                                                              const std::lock_guard lock(mutex_);
                                                              const auto member = members_.find(status.name);
                                                              if (member != members_.end())
                                                                member->second.status = status;
                                                            });
  requests_ = std::make_unique<Subscription<ControlRequestMessage>>(
      bus_, partition, [this](const ControlRequestMessage& request) { Asked(request); });
  worlds_->Write(world_);
}

void ServerSession::Close()
{
  bus_.OnBadMessage(nullptr);
  bus_.OnProcessGone(nullptr);
  requests_.reset();
  statuses_.reset();
  leaves_.reset();
  joins_.reset();
}

ServerSession::~ServerSession() { Close(); }

HotScope ServerSession::Scope(std::size_t capacity, unsigned writers) const
{
  return {world_.experiment, directory_.Path(), world_.spread, capacity, writers};
}

void ServerSession::Joined(const JoinMessage& join)
{
  if (join.protocol != kProtocolVersion)
    return Refuse(
        join,
        fmt::format("{} ({}) speaks protocol version {}, the space server version {}; use programs of one release",
                    join.name, join.process, join.protocol, kProtocolVersion));
  if (join.run != world_.run) return;
  {
    const std::lock_guard lock(mutex_);
    const auto member = members_.find(join.name);
    if (member == members_.end())
    {
      attached_[join.process] = join.name;
      return;
    }
    if (member->second.process.empty() || member->second.process == join.process)
    {
      member->second.process = join.process;
      member->second.ready = join.ready;
      callbacks_.changed();
      return;
    }
  }
  Refuse(join, fmt::format("{} runs already; process {} is one too many", join.name, join.process));
}

void ServerSession::Refuse(const JoinMessage& join, const std::string& reason)
{
  fmt::print(stderr, "space server: refused: {}\n", reason);
  leave_->Write({join.run, 0, "space server", join.process, reason});
}

void ServerSession::MemberLeft(const LeaveMessage& leave)
{
  if (leave.run != world_.run || leave.name == "space server") return;
  {
    const std::lock_guard lock(mutex_);
    const auto member = members_.find(leave.name);
    if (member == members_.end()) return;
    member->second.left = true;
    if (!over_ && !leave.error.empty())
      Fail(fmt::format("{} failed at tick {}: {}", leave.name, leave.tick, leave.error));
  }
  callbacks_.changed();
}

void ServerSession::Lost(const std::string& process, bool died)
{
  {
    const std::lock_guard lock(mutex_);
    attached_.erase(process);
    for (auto& [name, member] : members_)
    {
      if (member.process != process) continue;
      if (!member.left && !over_)
        Fail(fmt::format("{} {} (process {})", name, died ? "does not answer any more" : "has left", process));
      member.left = true;
    }
  }
  callbacks_.gone(process);
  callbacks_.changed();
}

void ServerSession::Fail(const std::string& text)
{
  if (!failure_) failure_ = text;
}

// Whoever is in the run ends it by what he sends; anybody else is not heard.
bool ServerSession::FailedBy(const BadMessageReport& report)
{
  {
    const std::lock_guard lock(mutex_);
    const auto sender = std::find_if(members_.begin(), members_.end(),
                                     [&](const auto& member) { return member.second.process == report.process; });
    if (report.process.empty() || sender == members_.end()) return false;
    if (!over_)
      Fail(fmt::format("{} sent a bad {} at tick {}: {}", sender->first, report.topic, report.tick, report.what));
  }
  callbacks_.changed();
  return true;
}

std::vector<std::string> ServerSession::Missing() const
{
  const std::lock_guard lock(mutex_);
  std::vector<std::string> missing;
  for (const std::string& name : expected_)
    if (members_.at(name).process.empty()) missing.push_back(name);
  if (!missing.empty()) return missing;
  // All have come; some still meet each other.
  for (const std::string& name : expected_)
    if (!members_.at(name).ready) missing.push_back(name);
  return missing;
}

std::optional<std::string> ServerSession::Failure() const
{
  const std::lock_guard lock(mutex_);
  return failure_;
}

std::string ServerSession::Status(const std::string& name, std::uint64_t tick) const
{
  const std::lock_guard lock(mutex_);
  const auto member = members_.find(name);
  return member == members_.end() || member->second.status.tick != tick ? std::string() : member->second.status.text;
}

std::vector<ProcessStatus> ServerSession::Processes() const
{
  const std::lock_guard lock(mutex_);
  std::vector<ProcessStatus> processes;
  for (const std::string& name : expected_) processes.push_back({name, members_.at(name).process, 0, 0, {}});
  for (const auto& [process, name] : attached_) processes.push_back({name, process, 0, 0, {}});
  return processes;
}

bool ServerSession::AllLeft() const
{
  const std::lock_guard lock(mutex_);
  for (const auto& [name, member] : members_)
    if (!member.left && !member.process.empty()) return false;
  return true;
}

// Askers repeat what is not answered in time: it is done once, and answered each time.
void ServerSession::Asked(const ControlRequestMessage& request)
{
  std::unique_lock lock(mutex_);
  if (Request* known = FindRequest(request))
  {
    const std::optional<ControlReplyMessage> reply = known->reply;
    lock.unlock();
    if (reply) replies_->Write(*reply);
    return;
  }
  requests_seen_.push_back({request.client, request.number, std::nullopt});
  if (requests_seen_.size() > kRequestsKept) requests_seen_.pop_front();
  lock.unlock();
  callbacks_.asked(request);
}

ServerSession::Request* ServerSession::FindRequest(const ControlRequestMessage& request)
{
  const auto same = [&](const Request& r) { return r.client == request.client && r.number == request.number; };
  const auto found = std::find_if(requests_seen_.begin(), requests_seen_.end(), same);
  return found == requests_seen_.end() ? nullptr : &*found;
}

void ServerSession::Reply(const ControlRequestMessage& request, bool ok, std::uint64_t tick, const std::string& text)
{
  const ControlReplyMessage reply{request.client, request.number, ok, tick, text};
  {
    const std::lock_guard lock(mutex_);
    if (Request* known = FindRequest(request)) known->reply = reply;
  }
  replies_->Write(reply);
}

void ServerSession::Leave(std::uint64_t tick, const std::string& error)
{
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  leave_->Write({world_.run, tick, "space server", "", error});
  leave_->WaitUntilRead(kLeaveTime_s);
}

}  // namespace swarmanoid
