// ControlClient: asks the space server of a running experiment to pause, resume, step, change speed or stop, or to
// move, add or remove an entity. Used by `swarmanoid control` and by interactive visualisers.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.h"

namespace swarmanoid
{

class ControlClient
{
public:
  // `run`: WorldMessage::run, where it is known; otherwise Ask learns it.
  ControlClient(Bus& bus, const std::string& experiment, std::uint64_t run = 0);

  // Sends a request (ControlRequest in idl/swarmanoid.idl) and waits for the answer, as long as the run gets on: the
  // answer to a step comes at its end. nullopt if the run told nothing for `timeout_s` (15 s once its space
  // server has gone, and another one may come), or stood still that long and waits for one of its processes, or
  // `given_up` returns true, which is called several times a second. A request beyond the limits of a message
  // (request_limits.h) is not sent: it is refused by a reply that is made here.
  std::optional<ControlReplyMessage> Ask(const std::string& verb, const std::string& entity,
                                         const std::vector<double>& numbers, double timeout_s,
                                         const std::function<bool()>& given_up = nullptr);
  // Another space server goes on with the run, under that number.
  void FollowRun(std::uint64_t run);
  // How the run went when it was heard last; nullopt if no Ask has heard of it.
  std::optional<RunStatus> LatestStatus();
  // Sends without waiting for an answer. Returns why the request cannot be sent (request_limits.h); empty if it was.
  std::string Send(const std::string& verb, const std::string& entity, const std::vector<double>& numbers);

private:
  using Clock = std::chrono::steady_clock;

  void Heard(const RunStatusMessage& message);

  Bus& bus_;
  std::string experiment_;
  std::uint64_t run_;
  std::mutex mutex_;
  std::condition_variable answered_;
  std::optional<RunStatus> status_;
  Clock::time_point got_on_;  // when the run was last seen to get on
  std::uint32_t number_;      // of the last request
  std::optional<ControlReplyMessage> reply_;
  Publisher<ControlRequestMessage> requests_;
  Subscription<ControlReplyMessage> replies_;
  std::unique_ptr<Subscription<RunStatusMessage>> statuses_;  // made by Ask, for those who wait
};

}  // namespace swarmanoid
