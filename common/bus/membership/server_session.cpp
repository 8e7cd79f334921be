// Threads of the bus report each message to the membership under the lock of state_, and the callbacks run without it.
// The membership collects what the main thread has to do, until that takes it (TakeLeft, TakeLost, TakeReplaced,
// AnswerLeaves).
//
// Invariant: a request of a client is carried out once. Clients repeat requests that are not answered, so the last
// kRequestsKept requests are kept with their replies.
#include "common/bus/membership/server_session.h"

#include <fmt/format.h>
#include <cstdio>
#include <random>
#include <utility>

#include "common/errors/print_error.h"

namespace swarmanoid
{

namespace
{

constexpr double kLeaveTime_s = 1.0;

// Throws if the experiment runs already. Two experiments of one name in one domain would hear each other.
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

std::uint64_t NewRun()
{
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) | device();
}

ServerSession::ServerSession(const BusOptions& options, WorldMessage world, std::vector<std::string> expected,
                             Callbacks callbacks)
    : world_(std::move(world)),
      expected_(std::move(expected)),
      callbacks_(std::move(callbacks)),
      key_(KeyOfRun(options)),
      state_(State{ServerMembership(world_.run, expected_)}),
      directory_((RefuseSecondServer(world_.experiment, options.domain), world_.experiment), world_.run),
      bus_(WithKey(options, key_), "space server")
{
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
  bus_.OnProcessGone([this](const std::string& gone, const std::string&, bool died) { Missed(gone, died); });
  bus_.OnBadMessage([this](const BadMessageReport& report) { return FailedBy(report); });
  joins_ =
      std::make_unique<Subscription<JoinMessage>>(bus_, partition, [this](const JoinMessage& join) { Joined(join); });
  leaves_ = std::make_unique<Subscription<LeaveMessage>>(bus_, partition,
                                                         [this](const LeaveMessage& leave) { MemberLeft(leave); });
  statuses_ = std::make_unique<Subscription<StatusMessage>>(bus_, partition,
                                                            [this](const StatusMessage& status)
                                                            {
                                                              if (status.run == world_.run)
                                                                state_.Lock()->membership.Heard(status);
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
          const auto* const member = state->membership.Find(request.name);
          if (member == nullptr || member->process != request.process) return;
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

void ServerSession::Joined(const JoinMessage& join)
{
  if (join.protocol != kProtocolVersion)
    return Refuse(
        join,
        fmt::format("{} ({}) speaks protocol version {}, the space server version {}; use programs of one release",
                    join.name, join.process, join.protocol, kProtocolVersion));
  if (join.run != world_.run) return;
  const ServerMembership::Verdict verdict = state_.Lock()->membership.Heard(join);
  if (verdict == ServerMembership::Verdict::kTaken) callbacks_.changed();
  if (verdict == ServerMembership::Verdict::kNameTaken)
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
  state_.Lock()->membership.Heard(leave);
  callbacks_.changed();
}

std::vector<std::string> ServerSession::TakeLeft()
{
  return std::exchange(state_.Lock()->membership.Latest().left, {});
}

std::vector<std::string> ServerSession::TakeLost()
{
  return std::exchange(state_.Lock()->membership.Latest().lost, {});
}

std::vector<std::pair<std::string, std::uint32_t>> ServerSession::TakeReplaced()
{
  return std::exchange(state_.Lock()->membership.Latest().replaced, {});
}

void ServerSession::Release(const std::string& name) { state_.Lock()->membership.Release(name); }

std::string ServerSession::ProcessOf(const std::string& name) const
{
  return state_.Lock()->membership.Of(name).process;
}

std::string ServerSession::MachineOf(const std::string& name) const
{
  return state_.Lock()->membership.Of(name).machine;
}

double ServerSession::ReachOf(const std::string& name) const { return state_.Lock()->membership.Of(name).reach; }

std::uint32_t ServerSession::Incarnation(const std::string& name) const
{
  return state_.Lock()->membership.Of(name).incarnation;
}

std::vector<RecoveryRequestMessage> ServerSession::TakeRecoveryRequests()
{
  return std::exchange(state_.Lock()->recoveries, {});
}

void ServerSession::AnswerLeaves()
{
  // The answers are not written in the reading thread, because this process receives them too.
  for (const LeaveMessage& answer : std::exchange(state_.Lock()->membership.Latest().answers, {}))
    leave_->Write(answer);
}

void ServerSession::Missed(const std::string& process, bool died)
{
  state_.Lock()->membership.Missed(process, died);
  callbacks_.gone(process);
  callbacks_.changed();
}

// Returns whether a member ends the run by a bad message. Messages of other senders are dropped.
bool ServerSession::FailedBy(const BadMessageReport& report)
{
  const std::string what = fmt::format("sent a bad {} at tick {}: {}", report.topic, report.tick, report.what);
  if (!state_.Lock()->membership.HeardBad(report.process, what)) return false;
  callbacks_.changed();
  return true;
}

std::vector<std::string> ServerSession::Missing() const
{
  const auto state = state_.Lock();
  std::vector<std::string> missing;
  for (const std::string& name : expected_)
    if (state->membership.Of(name).phase == ServerMembership::Phase::kAwaited) missing.push_back(name);
  if (!missing.empty()) return missing;
  // All processes have joined; some are still matching each other.
  for (const std::string& name : expected_)
    if (state->membership.Of(name).phase == ServerMembership::Phase::kJoined) missing.push_back(name);
  return missing;
}

std::optional<std::string> ServerSession::Failure() const { return state_.Lock()->membership.Failure(); }

std::string ServerSession::Status(const std::string& name, std::uint64_t tick) const
{
  const auto state = state_.Lock();
  const auto* const member = state->membership.Find(name);
  return member == nullptr || member->status.tick != tick ? std::string() : member->status.text;
}

std::vector<ProcessStatus> ServerSession::Processes() const
{
  const auto state = state_.Lock();
  std::vector<ProcessStatus> processes;
  for (const std::string& name : expected_) processes.push_back({name, state->membership.Of(name).process, 0, 0, {}});
  for (const auto& [process, name] : state->membership.Attached()) processes.push_back({name, process, 0, 0, {}});
  return processes;
}

std::optional<std::string> ServerSession::FirstLeft() const
{
  const auto state = state_.Lock();
  for (const std::string& name : expected_)
    if (state->membership.Of(name).HasLeft()) return name;
  return std::nullopt;
}

std::vector<std::string> ServerSession::NotLeft() const
{
  const auto state = state_.Lock();
  std::vector<std::string> names;
  for (const auto& [name, member] : state->membership.Members())
    if (!member.HasLeft() && member.phase != ServerMembership::Phase::kAwaited) names.push_back(name);
  return names;
}

void ServerSession::Asked(const ControlRequestMessage& request)
{
  // A request that an earlier server accepted is only answered again.
  const bool is_known = state_.Lock()->FindRequest(request) != nullptr;
  if (key_ && request.run != world_.run && !is_known) throw ForeignMessage("it was asked of another run");
  Ask(request);
}

// Clients repeat a request that is not answered in time.
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
  state_.Lock()->membership.End();
  replies_->WaitUntilRead(kLeaveTime_s);
}

void ServerSession::Leave(std::uint64_t tick, const std::string& error)
{
  state_.Lock()->membership.End();
  leave_->Write({world_.run, tick, "space server", "", error});
  // No request is answered afterwards.
  if (leave_->WaitUntilRead(kLeaveTime_s)) replies_->WaitUntilRead(kLeaveTime_s);
}

}  // namespace swarmanoid
