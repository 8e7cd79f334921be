#include "common/bus/membership/control_client.h"

#include <algorithm>
#include <random>
#include <string>

#include "common/bus/topics/participant.h"
#include "common/messages/control_verbs.h"

namespace swarmanoid
{

using namespace std::chrono_literals;

namespace
{

constexpr auto kRepeat = 250ms;
constexpr double kLate_s = 0.5;
// The time for another space server to resume the run after the first has gone. A busy machine needs this long.
constexpr auto kRestartTime = 15s;

}  // namespace

// The system reuses process ids. A request of another process with our id must not be taken for a repetition of ours.
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
  bool is_gone = false;  // the space server has left
  // The bus holds locks when it calls us, and takes the same locks for these questions. So our lock must be released
  // meanwhile.
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
  // The status says which run it is. A grant that has ended carries none, and every request is refused. A server whose
  // grant has not ended waits until we ask with the run.
  const bool by_grant = bus_.Internals().grant.has_value();
  while (run_ == 0 && !by_grant)
    if (answered_.wait_for(lock, 2ms), !is_patient()) return std::nullopt;
  reply_.reset();
  request.number = ++number_;
  request.run = run_;
  // We may discover the server before it discovers us. Its answer is then lost, and the server answers the same request
  // again.
  while (!reply_ && is_patient())
  {
    if (request.run == 0) request.run = run_;
    const bool is_heard = without_lock(
        [&]
        {
          requests_.Write(request);
          return requests_.Readers() > 0;
        });
    answered_.wait_for(lock, kRepeat, [&] { return reply_.has_value() || (request.run == 0 && run_ != 0); });
    is_gone = !is_heard && status_ && status_->phase != RunStatus::Phase::kFinished;
    // If a request ends the run, the run may be gone before its answer arrives.
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

// A process is not late if the run is slow on request.
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
