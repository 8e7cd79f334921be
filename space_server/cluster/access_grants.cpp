#include "space_server/cluster/access_grants.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/bus/security/derived_key.h"
#include "common/configuration/wording.h"
#include "common/errors/print_error.h"
#include "common/messages/control_verbs.h"
#include "common/run/access/addresses.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr std::size_t kMostGrants = 16;   // limit for grants at a time
constexpr std::size_t kMostEnded = 64;    // limit for ended grants that are remembered
constexpr std::size_t kMostWaiting = 64;  // messages of holders; a flood is dropped beyond this
constexpr auto kRenewWatched = 1s;
constexpr auto kWatchedTime = 3s;  // a request that is not repeated ends after this time
// Endpoints are deleted when no process has joined for this time. Fast DDS 2.9 tells a process that joins about all
// endpoints, in a thread of its own. If the process leaves meanwhile, and endpoints were deleted, that thread and the
// one that removes the process wait for each other for ever (its pull request 5432).
constexpr auto kQuietTime = 2s;

// Returns a client name that includes the grant, so that the holder of a grant cannot use another client's name.
std::string ClientBy(const std::string& client, const AccessGrant& grant)
{
  return fmt::format("{} by {}", client, grant.Name());
}

// The order is without error (OrderError).
AccessGrant GrantOf(const ControlOrder& order)
{
  return {order.Get<std::string>("grant"), GrantRoleOf(order.Get<std::string>("role")).value_or(GrantRole::kWatcher),
          order.Get<std::int64_t>("ends")};
}

std::string EndText(const AccessGrant& grant)
{
  return grant.ends == 0 ? std::string("with the run") : UtcText(grant.ends);
}

}  // namespace

AccessGrants::AccessGrants(ServerSession& session, const BusOptions& options, Callbacks callbacks)
    : session_(session), options_(options), callbacks_(std::move(callbacks))
{
}

void AccessGrants::Stop()
{
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  robots_in_.reset();
  sides_.clear();
  open_ = 0;
}

void AccessGrants::Restore(const std::vector<ControlOrder>& grants)
{
  for (const ControlOrder& order : grants) Add(GrantOf(order), "an earlier space server of this run");
}

void AccessGrants::Ask(const ControlRequestMessage& request)
{
  {
    const std::lock_guard lock(mutex_);
    inbox_.of_members.push_back(request);
    of_members_.emplace_back(request.client, request.number);
    if (of_members_.size() > kMostWaiting) of_members_.pop_front();
  }
  callbacks_.woken();
}

void AccessGrants::Replied(const ControlReplyMessage& reply)
{
  if (open_ == 0) return;
  {
    const std::lock_guard lock(mutex_);
    // Replies about grants go to members only.
    if (std::ranges::find(of_members_, std::pair(reply.client, reply.number)) != of_members_.end()) return;
    inbox_.replies.push_back(reply);
  }
  callbacks_.woken();
}

template <class Message>
void AccessGrants::Keep(std::deque<Heard<Message>>& queue, const std::string& grant, const Message& message)
{
  {
    const std::lock_guard lock(mutex_);
    if (stopped_ || queue.size() >= kMostWaiting) return;
    queue.push_back({grant, message});
  }
  callbacks_.woken();
}

AccessGrants::Side* AccessGrants::Find(const std::string& id)
{
  const auto found = std::ranges::find_if(sides_, [&](const auto& side) { return side->grant.id == id; });
  return found == sides_.end() ? nullptr : found->get();
}

void AccessGrants::Add(const AccessGrant& grant, const std::string& by)
{
  Side& side = *sides_.emplace_back(std::make_unique<Side>());
  side.grant = grant;
  side.by = by;
  ++open_;
}

void AccessGrants::Open(Side& side)
{
  side.is_new = false;
  side.channel = ChannelOf(*session_.Key(), side.grant);
  Bus& bus = session_.GetBus();
  WorldMessage world = session_.World();
  // An observer first gets a whole view.
  world.checkpoint.clear();
  const std::string partition = world.experiment;
  const auto& channel = side.channel;
  side.leave = std::make_unique<Publisher<LeaveMessage>>(bus, partition, channel);
  side.views = std::make_unique<Publisher<ViewMessage>>(bus, partition, channel);
  side.statuses = std::make_unique<Publisher<RunStatusMessage>>(bus, partition, channel);
  side.worlds = std::make_unique<Publisher<WorldMessage>>(bus, partition, channel);
  const AccessGrant& grant = side.grant;
  if (grant.role == GrantRole::kOpenView)
  {
    side.worlds->Write(world);
    return;
  }
  side.replies = std::make_unique<Publisher<ControlReplyMessage>>(bus, partition, channel);
  side.robots = std::make_unique<Publisher<RobotStatusMessage>>(bus, partition, channel);
  side.requests = std::make_unique<Subscription<ControlRequestMessage>>(
      bus, partition, [this, id = grant.id](const ControlRequestMessage& r) { Keep(inbox_.requests, id, r); }, channel);
  side.leaves = std::make_unique<Subscription<LeaveMessage>>(
      bus, partition, [this, id = grant.id](const LeaveMessage& l) { Keep(inbox_.leaves, id, l); }, channel);
  side.view_requests = std::make_unique<Subscription<ViewRequestMessage>>(
      bus, partition, [this, &side](const ViewRequestMessage& request) { ViewRequested(side, request); }, channel);
  side.worlds->Write(world);
}

// An error of a grant ends the grant, not the run.
void AccessGrants::TryToOpen(Side& side, std::uint64_t tick)
{
  try
  {
    Open(side);
  }
  catch (const BusError& error)
  {
    End(side, tick, fmt::format("{} could not be opened: {}", side.grant.Name(), error.what()));
  }
}

// Ends a grant. Afterwards its key seals refusals only, and a holder who comes late finds no run.
void AccessGrants::End(Side& side, std::uint64_t tick, const std::string& why)
{
  side.ended = why;
  side.is_over = true;
  --open_;
  if (side.worlds != nullptr) side.worlds->Forget();
  if (side.leave != nullptr) side.leave->Write({session_.World().run, tick, "space server", "", why});
  PrintError("space server: {}\n", why);
}

void AccessGrants::Tidy()
{
  if (sides_.size() == open_ || session_.GetBus().SinceLastJoin() < kQuietTime) return;
  const auto is_over = [](const auto& side) { return side->is_over.load(); };
  while (static_cast<std::size_t>(std::ranges::count_if(sides_, is_over)) > kMostEnded)
    sides_.erase(std::ranges::find_if(sides_, is_over));
  for (const auto& side : sides_)
  {
    if (!side->is_over || side->worlds == nullptr) continue;
    side->view_requests.reset();
    side->views.reset();
    side->statuses.reset();
    side->robots.reset();
    side->worlds.reset();
  }
}

void AccessGrants::Work(std::uint64_t tick)
{
  const auto now = Clock::now();
  Inbox inbox;
  {
    const std::lock_guard lock(mutex_);
    std::swap(inbox, inbox_);
  }
  for (const ControlRequestMessage& request : inbox.of_members) Execute(request, tick);
  for (const auto& side : sides_)
  {
    if (side->ended.empty() && side->grant.HasEnded())
      End(*side, tick, fmt::format("{} has ended", side->grant.Name()));
    else if (side->is_new && side->ended.empty())
      TryToOpen(*side, tick);
  }
  for (const auto& [id, request] : inbox.requests)
    if (Side* const side = Find(id)) Forward(*side, request, tick);
  for (const auto& [id, leave] : inbox.leaves)
    if (Side* const side = Find(id); side != nullptr && leave.run == session_.World().run && side->leave != nullptr)
      side->leave->Write(side->ended.empty() ? LeaveMessage{leave.run, leave.tick, "space server", leave.process, ""}
                                             : LeaveMessage{leave.run, tick, "space server", "", side->ended});
  for (const auto& side : sides_)
  {
    if (!side->ended.empty() || side->is_new || side->replies == nullptr) continue;
    for (ControlReplyMessage reply : inbox.replies)
    {
      const std::string own = ClientBy("", side->grant);
      if (reply.client.ends_with(own)) reply.client.resize(reply.client.size() - own.size());
      side->replies->Write(reply);
    }
    for (const auto& [host, robots] : inbox.robots) side->robots->Write(robots);
  }
  RenewRobots(now);
  Tidy();
}

AccessGrants::Action AccessGrants::ActionOf(const std::string& verb)
{
  static const std::map<std::string_view, Action> actions{
      {"share", &AccessGrants::Make}, {"shares", &AccessGrants::List}, {"revoke", &AccessGrants::Revoke}};
  return actions.at(verb);
}

void AccessGrants::Execute(const ControlRequestMessage& request, std::uint64_t tick)
{
  try
  {
    if (const std::string error = OrderError(request); !error.empty()) throw std::invalid_argument(error);
    session_.Reply(request, true, tick, (this->*ActionOf(request.verb))(request, tick));
    if (FindControlVerb(request.verb)->effect != Effect::kQuery) callbacks_.noted(request);
  }
  catch (const std::exception& error)
  {
    session_.Reply(request, false, tick, error.what());
  }
}

// Replies with what the token needs beside the key, which the asker can derive.
std::string AccessGrants::Make(const ControlRequestMessage& request, std::uint64_t)
{
  if (!session_.Key()) throw std::invalid_argument("the run lets anybody in (--insecure): there is nothing to share");
  if (open_ >= kMostGrants)
    throw std::invalid_argument(
        fmt::format("{} access grants of this run are open; revoke one of them first", kMostGrants));
  const AccessGrant grant = GrantOf(request);
  if (!IsGrantId(grant.id))
    throw std::invalid_argument(fmt::format("{} is no id of an access grant", Quoted(grant.id)));
  if (Find(grant.id) != nullptr)
    throw std::invalid_argument(fmt::format("there is an access grant {} already", grant.id));
  if (grant.HasEnded()) throw std::invalid_argument("the access grant would have ended already");
  const std::string address =
      options_.discovery_server.empty() ? ReachableAddress(options_) : options_.discovery_server;
  if (grant.role == GrantRole::kOpenView)
    for (const auto& side : sides_)
      if (side->grant.role == grant.role && !side->is_over)
        throw std::invalid_argument(fmt::format("the run has an open view already: {}", side->grant.id));
  Add(grant, AskerOf(request));
  return fmt::format("{} for those who reach {}", grant.Name(), address);
}

std::string AccessGrants::List(const ControlRequestMessage&, std::uint64_t)
{
  std::string text;
  for (const auto& side : sides_)
  {
    const AccessGrant& grant = side->grant;
    const std::string state = !side->ended.empty() ? side->ended
                                                   : fmt::format("ends {}, {} looking", EndText(grant),
                                                                 side->views == nullptr ? 0 : side->views->Readers());
    text += fmt::format("{}{}  {:9}  {}; made by {}", text.empty() ? "" : "; ", grant.id, RoleName(grant.role), state,
                        side->by);
  }
  return text;
}

std::string AccessGrants::Revoke(const ControlRequestMessage& request, std::uint64_t tick)
{
  const auto id = request.Get<std::string>("grant");
  Side* const side = Find(id);
  if (side == nullptr)
  {
    std::vector<std::string> known;
    for (const auto& other : sides_) known.push_back(other->grant.id);
    throw std::invalid_argument(
        fmt::format("there is no access grant {}{}; `swarmanoid share --list` tells those of the run", Quoted(id),
                    DidYouMean(id, known)));
  }
  if (!side->ended.empty()) throw std::invalid_argument(side->ended);
  End(*side, tick, fmt::format("{} was revoked by {}", side->grant.Name(), AskerOf(request)));
  return side->ended;
}

void AccessGrants::Forward(Side& side, ControlRequestMessage request, std::uint64_t tick)
{
  if (!side.ended.empty()) return Refuse(side, request, tick, side.ended);
  // The holder has not heard a status of the run yet, and asks again when it has.
  if (request.run == 0) return;
  if (request.run != session_.World().run) return Refuse(side, request, tick, "it was asked of another run");
  if (side.grant.role != GrantRole::kOperator)
    return Refuse(side, request, tick, fmt::format("{} may only look", side.grant.Name()));
  if (FindControlVerb(request.verb, Asker::kOperator) == nullptr)
    return Refuse(
        side, request, tick,
        fmt::format("{} may not ask for {}; members of the run may", side.grant.Name(), Quoted(request.verb)));
  request.client = ClientBy(request.client, side.grant);
  session_.Ask(request);
}

void AccessGrants::Refuse(Side& side, const ControlRequestMessage& request, std::uint64_t tick, const std::string& why)
{
  if (side.replies == nullptr) return;
  side.replies->Write({request.client, request.number, false, tick, why});
  if (std::exchange(side.told, true)) return;
  const ControlRequestMessage refused = NoteOf(
      kRefusedMessage, "ControlRequest", fmt::format("{}@{}", request.user, ClientBy(request.client, side.grant)));
  PrintError("space server: refused '{}' of {}: {}; further ones are not told\n", TextOf(request), refused.client, why);
  callbacks_.noted(refused);
}

void AccessGrants::ViewRequested(const Side& side, const ViewRequestMessage& request)
{
  if (side.is_over || request.run != session_.World().run) return;
  ViewRequestMessage of_grant = request;
  of_grant.client = ClientBy(request.client, side.grant);
  of_grant.every_tick = false;
  of_grant.robots.clear();
  bool changed = false;
  {
    const std::lock_guard lock(mutex_);
    if (stopped_) return;
    if (watched_.size() >= kMostWaiting && watched_.count(of_grant.client) == 0) return;
    Watched& watched = watched_[of_grant.client];
    changed = watched.robots != request.robots;
    watched_changed_ |= changed;
    watched = {request.robots, Clock::now()};
  }
  callbacks_.view_requested(of_grant);
  if (changed) callbacks_.woken();
}

// Controller hosts hear members alone: the server asks for what holders of grants want to see of robots.
void AccessGrants::RenewRobots(Clock::time_point now)
{
  std::vector<std::uint32_t> robots;
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(watched_, [&](const auto& client) { return now - client.second.heard > kWatchedTime; });
    if (!std::exchange(watched_changed_, false) && now - robots_requested_ < kRenewWatched) return;
    for (const auto& [client, watched] : watched_)
      robots.insert(robots.end(), watched.robots.begin(), watched.robots.end());
  }
  robots_requested_ = now;
  std::ranges::sort(robots);
  robots.erase(std::unique(robots.begin(), robots.end()), robots.end());
  if (robots.empty() && robots_wanted_ == nullptr) return;
  const std::string& partition = session_.World().experiment;
  if (robots_wanted_ == nullptr)
  {
    robots_wanted_ = std::make_unique<Publisher<ViewRequestMessage>>(session_.GetBus(), partition);
    robots_in_ = std::make_unique<Subscription<RobotStatusMessage>>(session_.GetBus(), partition,
                                                                    [this](const RobotStatusMessage& message)
                                                                    {
                                                                      if (message.run != session_.World().run) return;
                                                                      {
                                                                        const std::lock_guard lock(mutex_);
                                                                        inbox_.robots[message.source] = message;
                                                                      }
                                                                      callbacks_.woken();
                                                                    });
  }
  robots_wanted_->Write({ProcessId() + " for access grants", session_.World().run, 0, false, std::move(robots)});
}

unsigned AccessGrants::ViewReaders() const
{
  unsigned readers = 0;
  for (const auto& side : sides_) readers += side->is_over || side->views == nullptr ? 0 : side->views->Readers();
  return readers;
}

unsigned AccessGrants::StatusReaders() const
{
  unsigned readers = 0;
  for (const auto& side : sides_) readers += side->is_over || side->statuses == nullptr ? 0 : side->statuses->Readers();
  return readers;
}

void AccessGrants::Write(const ViewMessage& view)
{
  for (const auto& side : sides_)
    if (!side->is_over && side->views != nullptr) side->views->Write(view);
}

void AccessGrants::Write(const RunStatusMessage& status)
{
  for (const auto& side : sides_)
    if (!side->is_over && side->statuses != nullptr) side->statuses->Write(status);
}

void AccessGrants::Leave(std::uint64_t tick, const std::string& error, double patience_s)
{
  const auto end = Clock::now() + std::chrono::duration<double>(patience_s);
  for (const auto& side : sides_)
    if (side->leave != nullptr && side->ended.empty())
      side->leave->Write({session_.World().run, tick, "space server", "", error});
  const auto left = [&] { return std::max(0.0, std::chrono::duration<double>(end - Clock::now()).count()); };
  for (const auto& side : sides_)
  {
    if (!side->is_over && side->views != nullptr) side->views->WaitUntilRead(left());
    if (side->leave != nullptr) side->leave->WaitUntilRead(left());
    // A client that sent a request reads no Leave. These messages tell it that the request was done, or that the run
    // has ended.
    if (side->statuses != nullptr) side->statuses->WaitUntilRead(left());
    if (side->replies != nullptr) side->replies->WaitUntilRead(left());
  }
}

}  // namespace swarmanoid
