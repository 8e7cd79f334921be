#include "common/bus/membership/control_client.h"

#include <algorithm>
#include <random>
#include <string>

#include "common/bus/participant.h"
#include "common/messages/control_verbs.h"

namespace swarmanoid
{

using namespace std::chrono_literals;

namespace
{

constexpr auto kRepeat = 250ms;
constexpr auto kStatusTime = 1s;
constexpr double kLate_s = 0.5;
// For a space server that was heard and has gone: on a busy machine another one takes its time to go on with the run.
constexpr auto kRestartTime = 15s;

}  // namespace

// Process ids come again: requests of another process of our number must not be taken for repetitions of ours.
ControlClient::ControlClient(Bus& bus, const std::string& experiment, std::uint64_t run)
    : bus_(bus),
      experiment_(experiment),
      run_(run),
      number_(std::random_device()()),
      requests_(bus, experiment),
      replies_(bus, experiment,
               [this](const ControlReplyMessage& reply)
               {
                 const std::lock_guard lock(mutex_);
                 if (reply.client != ProcessId() || reply.number != number_) return;
                 reply_ = reply;
                 answered_.notify_all();
               })
{
}

std::optional<ControlReplyMessage> ControlClient::Ask(const ControlOrder& order, double timeout_s,
                                                      const std::function<bool()>& given_up)
{
  ControlRequestMessage request = RequestOf(order);
  if (const std::string error = OrderError(order); !error.empty())
    return ControlReplyMessage{.client = request.client, .text = error};
  const AtEnd at_end = FindControlVerb(order.verb)->at_end;
  if (statuses_ == nullptr)
    statuses_ = std::make_unique<Subscription<RunStatusMessage>>(
        bus_, experiment_, [this](const RunStatusMessage& message) { Heard(message); });
  const auto patience = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_s));
  std::unique_lock lock(mutex_);
  got_on_ = Clock::now();
  const auto start = Clock::now();
  bool is_gone = false;  // who was asked
  // The bus calls us while it holds locks that it takes for these questions, too: none of ours may be held meanwhile.
  const auto without_lock = [&](const auto& call)
  {
    lock.unlock();
    const auto answer = call();
    lock.lock();
    return answer;
  };
  const auto is_patient = [&]
  {
    if (given_up && without_lock(given_up)) return false;
    return Clock::now() < got_on_ + (is_gone ? std::max<Clock::duration>(patience, kRestartTime) : patience);
  };
  while (without_lock([this] { return requests_.Readers() == 0 || replies_.Writers() == 0; }))
    if (answered_.wait_for(lock, 2ms), !is_patient()) return std::nullopt;
  // A grant that has ended tells nothing of the run any more, and refuses whatever is asked.
  const bool by_grant = bus_.Internals().grant.has_value();
  while (run_ == 0 && !(by_grant && Clock::now() - start > kStatusTime))
    if (answered_.wait_for(lock, 2ms), !is_patient()) return std::nullopt;
  reply_.reset();
  request.number = ++number_;
  request.run = run_;
  // We may know the server before it knows us: then its answer finds nobody, and the same request is answered again.
  while (!reply_ && is_patient())
  {
    const bool is_heard = without_lock(
        [&]
        {
          requests_.Write(request);
          return requests_.Readers() > 0;
        });
    answered_.wait_for(lock, kRepeat, [this] { return reply_.has_value(); });
    is_gone = !is_heard && status_ && status_->phase != RunStatus::Phase::kFinished;
    // A run that ends upon the request may be gone before its answer finds us.
    if (reply_ || is_heard) continue;
    const bool finished = status_ && status_->phase == RunStatus::Phase::kFinished;
    if (at_end != AtEnd::kCauses && !finished) continue;
    reply_ = ControlReplyMessage{.client = request.client, .number = request.number, .text = {}};
    reply_->ok = at_end != AtEnd::kRefused;
    reply_->tick = finished ? status_->tick : 0;
    reply_->text = at_end == AtEnd::kCauses ? order.verb + " was done" : RunEndedText(reply_->tick);
  }
  return reply_;
}

// A run that is slow because it is told to be has nobody who is late.
void ControlClient::Heard(const RunStatusMessage& message)
{
  const std::lock_guard lock(mutex_);
  const RunStatus& status = message.status;
  run_ = message.run;
  answered_.notify_all();
  const bool waits =
      std::ranges::any_of(status.processes, [](const ProcessStatus& process) { return process.late_s > kLate_s; });
  if (!waits || !status_ || status.tick != status_->tick) got_on_ = Clock::now();
  status_ = status;
}

void ControlClient::FollowRun(std::uint64_t run)
{
  const std::lock_guard lock(mutex_);
  run_ = run;
}

std::optional<RunStatus> ControlClient::LatestStatus()
{
  const std::lock_guard lock(mutex_);
  return status_;
}

ControlRequestMessage ControlClient::RequestOf(const ControlOrder& order)
{
  ControlRequestMessage request{order};
  request.client = ProcessId();
  request.user = UserName();
  return request;
}

std::string ControlClient::Send(const ControlOrder& order)
{
  if (std::string error = OrderError(order); !error.empty()) return error;
  ControlRequestMessage request = RequestOf(order);
  {
    const std::lock_guard lock(mutex_);
    request.number = ++number_;
    request.run = run_;
  }
  requests_.Write(request);
  return {};
}

}  // namespace swarmanoid
