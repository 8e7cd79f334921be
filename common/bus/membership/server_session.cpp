#include "common/bus/membership/server_session.h"

#include <fmt/format.h>
#include <cstdio>
#include <tuple>
#include <utility>

#include "common/activity/print_error.h"

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

std::optional<RunKey> KeyOfRun(const BusOptions& options)
{
  if (options.insecure) return std::nullopt;
  const auto given = GivenKey(options);
  return given ? given : NewRunKey();
}

BusOptions WithKey(BusOptions options, const std::optional<RunKey>& key)
{
  options.key = key;
  return options;
}

}  // namespace

ServerSession::ServerSession(const BusOptions& options, WorldMessage world, std::vector<std::string> expected,
                             Callbacks callbacks)
    : world_(std::move(world)),
      expected_(std::move(expected)),
      callbacks_(std::move(callbacks)),
      key_(KeyOfRun(options)),
      directory_((RefuseSecondServer(world_.experiment, options.domain), world_.experiment), world_.run),
      bus_(WithKey(options, key_), "space server")
{
  for (const std::string& name : expected_) state_.Lock()->members[name];
  directory_.Announce(world_.experiment, options.domain, key_,
                      {options.network_interface, options.peers, options.discovery_server});
  world_.host = MachineName();
  const std::string process = ProcessId();
  world_.pid = static_cast<std::uint32_t>(std::stoul(process.substr(process.rfind(':') + 1)));
  world_.spread = options.Spread();

  const std::string& partition = world_.experiment;
  leave_ = std::make_unique<Publisher<LeaveMessage>>(bus_, partition);
  replies_ = std::make_unique<Publisher<ControlReplyMessage>>(bus_, partition);
  worlds_ = std::make_unique<Publisher<WorldMessage>>(bus_, partition);
  blocks_ = std::make_unique<Publisher<RecoveryBlockMessage>>(bus_, partition);
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
                                                              const auto state = state_.Lock();
                                                              const auto member = state->members.find(status.name);
                                                              if (member != state->members.end())
                                                                member->second.status = status;
                                                            });
  requests_ = std::make_unique<Subscription<ControlRequestMessage>>(
      bus_, partition, [this](const ControlRequestMessage& request) { Asked(request); });
  recoveries_ = std::make_unique<Subscription<RecoveryRequestMessage>>(
      bus_, partition,
      [this](const RecoveryRequestMessage& request)
      {
        if (request.run != world_.run) return;
        {
          const auto state = state_.Lock();
          const auto member = state->members.find(request.name);
          if (member == state->members.end() || member->second.process != request.process) return;
          state->recoveries.push_back(request);
        }
        callbacks_.changed();
      });
  worlds_->Write(world_);
}

void ServerSession::SayWorldAgain() { worlds_->Write(world_); }

void ServerSession::Close()
{
  bus_.OnBadMessage(nullptr);
  bus_.OnRefused(nullptr);
  bus_.OnProcessGone(nullptr);
  recoveries_.reset();
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

bool ServerSession::IsOf(const Member& member, const std::string& process)
{
  return member.process.empty() || member.process == process;
}

bool ServerSession::MayJoinAs(const Member& member, const JoinMessage& join) const
{
  if (!awaits_ || member.left) return IsOf(member, join.process);
  return join.incarnation > member.incarnation ||
         (join.incarnation == member.incarnation && IsOf(member, join.process));
}

void ServerSession::Joined(const JoinMessage& join)
{
  if (join.protocol != kProtocolVersion)
    return Refuse(
        join,
        fmt::format("{} ({}) speaks protocol version {}, the space server version {}; use programs of one release",
                    join.name, join.process, join.protocol, kProtocolVersion));
  if (join.run != world_.run) return;
  bool taken = false;
  {
    const auto state = state_.Lock();
    const auto member = state->members.find(join.name);
    if (member == state->members.end())
    {
      state->attached[join.process] = join.name;
      return;
    }
    taken = MayJoinAs(member->second, join);
    if (taken)
    {
      Member& joined = member->second;
      // It is said again until the run begins.
      if (std::tie(joined.process, joined.ready, joined.incarnation) ==
          std::tie(join.process, join.ready, join.incarnation))
        return;
      if (joined.process != join.process)
      {
        joined.status = {};
        joined.released = false;
        joined.done_at.reset();
        // It has not heard who had left before, and may wait for one of them.
        if (join.incarnation > 0)
          for (const auto& [name, other] : state->members)
            if (other.done_at) state->answers.push_back({world_.run, *other.done_at, name, other.process, ""});
      }
      std::tie(joined.process, joined.ready, joined.incarnation) = std::tie(join.process, join.ready, join.incarnation);
      joined.machine = join.machine;
      joined.reach = join.reach;
      if (join.ready && join.incarnation > 0) state->replaced.emplace_back(join.name, join.incarnation);
    }
  }
  if (taken) return callbacks_.changed();
  Refuse(join, fmt::format("{} runs already; process {} is one too many", join.name, join.process));
}

void ServerSession::Refuse(const JoinMessage& join, const std::string& reason)
{
  PrintError("space server: refused: {}\n", reason);
  leave_->Write({join.run, 0, "space server", join.process, reason});
}

void ServerSession::MemberLeft(const LeaveMessage& leave)
{
  if (leave.run != world_.run || leave.name == "space server") return;
  const bool in_order = leave.error.empty();
  {
    const auto state = state_.Lock();
    const auto member = state->members.find(leave.name);
    const bool of_run = member != state->members.end() && IsOf(member->second, leave.process) &&
                        !(member->second.released && !in_order);
    if (of_run && in_order && !member->second.left) state->just_left.push_back(leave.name);
    if (of_run) member->second.left = true;
    if (of_run && in_order && !member->second.released) member->second.done_at = leave.tick;
    if (of_run && !in_order && !state->over)
      state->Fail(fmt::format("{} failed at tick {}: {}", leave.name, leave.tick, leave.error));
    state->answers.push_back({leave.run, leave.tick, "space server", leave.process, ""});
  }
  callbacks_.changed();
}

std::vector<std::string> ServerSession::TakeLeft() { return std::exchange(state_.Lock()->just_left, {}); }

std::vector<std::string> ServerSession::TakeLost() { return std::exchange(state_.Lock()->lost, {}); }

std::vector<std::pair<std::string, std::uint32_t>> ServerSession::TakeReplaced()
{
  return std::exchange(state_.Lock()->replaced, {});
}

void ServerSession::Release(const std::string& name) { state_.Lock()->members.at(name).released = true; }

std::string ServerSession::ProcessOf(const std::string& name) const { return state_.Lock()->members.at(name).process; }

std::string ServerSession::MachineOf(const std::string& name) const { return state_.Lock()->members.at(name).machine; }

double ServerSession::ReachOf(const std::string& name) const { return state_.Lock()->members.at(name).reach; }

std::uint32_t ServerSession::Incarnation(const std::string& name) const
{
  return state_.Lock()->members.at(name).incarnation;
}

std::vector<RecoveryRequestMessage> ServerSession::TakeRecoveryRequests()
{
  return std::exchange(state_.Lock()->recoveries, {});
}

void ServerSession::AnswerLeaves()
{
  // Not in the thread that reads them: what it writes comes to this process too.
  for (const LeaveMessage& answer : std::exchange(state_.Lock()->answers, {})) leave_->Write(answer);
}

void ServerSession::Lost(const std::string& process, bool died)
{
  {
    const auto state = state_.Lock();
    state->attached.erase(process);
    for (auto& [name, member] : state->members)
    {
      if (member.process != process || member.released) continue;
      if (!member.left && !state->over && awaits_)
      {
        state->lost.push_back(name);
        continue;
      }
      if (!member.left && !state->over)
        state->Fail(fmt::format("{} {} (process {})", name, died ? "does not answer any more" : "has left", process));
      member.left = true;
    }
  }
  callbacks_.gone(process);
  callbacks_.changed();
}

void ServerSession::State::Fail(const std::string& text)
{
  if (!failure) failure = text;
}

// Whoever is in the run ends it by what he sends; anybody else is not heard.
bool ServerSession::FailedBy(const BadMessageReport& report)
{
  {
    const auto state = state_.Lock();
    const auto sender = std::find_if(state->members.begin(), state->members.end(),
                                     [&](const auto& member) { return member.second.process == report.process; });
    if (report.process.empty() || sender == state->members.end()) return false;
    if (!state->over)
      state->Fail(
          fmt::format("{} sent a bad {} at tick {}: {}", sender->first, report.topic, report.tick, report.what));
  }
  callbacks_.changed();
  return true;
}

std::vector<std::string> ServerSession::Missing() const
{
  const auto state = state_.Lock();
  std::vector<std::string> missing;
  for (const std::string& name : expected_)
    if (state->members.at(name).process.empty()) missing.push_back(name);
  if (!missing.empty()) return missing;
  // All have come; some still meet each other.
  for (const std::string& name : expected_)
    if (!state->members.at(name).ready) missing.push_back(name);
  return missing;
}

std::optional<std::string> ServerSession::Failure() const { return state_.Lock()->failure; }

std::string ServerSession::Status(const std::string& name, std::uint64_t tick) const
{
  const auto state = state_.Lock();
  const auto member = state->members.find(name);
  return member == state->members.end() || member->second.status.tick != tick ? std::string()
                                                                              : member->second.status.text;
}

std::vector<ProcessStatus> ServerSession::Processes() const
{
  const auto state = state_.Lock();
  std::vector<ProcessStatus> processes;
  for (const std::string& name : expected_) processes.push_back({name, state->members.at(name).process, 0, 0, {}});
  for (const auto& [process, name] : state->attached) processes.push_back({name, process, 0, 0, {}});
  return processes;
}

std::optional<std::string> ServerSession::FirstLeft() const
{
  const auto state = state_.Lock();
  for (const std::string& name : expected_)
    if (state->members.at(name).left) return name;
  return std::nullopt;
}

std::vector<std::string> ServerSession::NotLeft() const
{
  const auto state = state_.Lock();
  std::vector<std::string> names;
  for (const auto& [name, member] : state->members)
    if (!member.left && !member.process.empty()) names.push_back(name);
  return names;
}

void ServerSession::Asked(const ControlRequestMessage& request)
{
  // What the server before this one has taken is only answered again.
  const bool is_known = state_.Lock()->FindRequest(request) != nullptr;
  if (key_ && request.run != world_.run && !is_known) throw ForeignMessage("it was asked of another run");
  Ask(request);
}

// Askers repeat what is not answered in time.
void ServerSession::Ask(const ControlRequestMessage& request)
{
  std::optional<Request> known;
  {
    const auto state = state_.Lock();
    if (const Request* seen = state->FindRequest(request))
      known = *seen;
    else
    {
      state->requests_seen.push_back({request.client, request.number, std::nullopt});
      if (state->requests_seen.size() > kRequestsKept) state->requests_seen.pop_front();
    }
  }
  if (!known) return callbacks_.asked(request);
  if (known->reply) WriteReply(*known->reply);
}

void ServerSession::WriteReply(const ControlReplyMessage& reply)
{
  replies_->Write(reply);
  if (callbacks_.replied) callbacks_.replied(reply);
}

void ServerSession::Remember(const ControlRequestMessage& request, bool waits, const std::string& text)
{
  Request seen{request.client, request.number, std::nullopt};
  if (!waits) seen.reply = ControlReplyMessage{request.client, request.number, true, 0, text};
  const auto state = state_.Lock();
  state->requests_seen.push_back(std::move(seen));
  if (state->requests_seen.size() > kRequestsKept) state->requests_seen.pop_front();
}

ServerSession::Request* ServerSession::State::FindRequest(const ControlRequestMessage& request)
{
  const auto same = [&](const Request& r) { return r.client == request.client && r.number == request.number; };
  const auto found = std::find_if(requests_seen.begin(), requests_seen.end(), same);
  return found == requests_seen.end() ? nullptr : &*found;
}

void ServerSession::Reply(const ControlRequestMessage& request, bool ok, std::uint64_t tick, const std::string& text)
{
  const ControlReplyMessage reply{request.client, request.number, ok, tick, text};
  {
    const auto state = state_.Lock();
    if (Request* known = state->FindRequest(request)) known->reply = reply;
  }
  WriteReply(reply);
}

void ServerSession::LeaveToNext()
{
  state_.Lock()->over = true;
  replies_->WaitUntilRead(kLeaveTime_s);
}

void ServerSession::Leave(std::uint64_t tick, const std::string& error)
{
  state_.Lock()->over = true;
  leave_->Write({world_.run, tick, "space server", "", error});
  // Nobody is answered after it.
  if (leave_->WaitUntilRead(kLeaveTime_s)) replies_->WaitUntilRead(kLeaveTime_s);
}

}  // namespace swarmanoid
