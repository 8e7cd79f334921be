// ControlClient: sends orders (common/messages/control_verbs.h) to the space server of a running experiment.
// `swarmanoid control` and `share`, Python, and interactive visualisers use it.
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
#include "idl/messages.h"

namespace swarmanoid
{

class ControlClient
{
public:
  // `run`: WorldMessage::run, if known; otherwise Ask learns it.
  ControlClient(Bus& bus, const std::string& experiment, std::uint64_t run = 0);

  // Sends an order and waits for the reply as long as the run makes progress. The reply to a step comes at its end.
  // Returns nullopt if the run was silent for `timeout_s`. The limit is 15 s after the space server has gone, since
  // another one may come. Returns nullopt also if the run waited that long for one of its processes, or if `given_up`
  // returns true. `given_up` is called several times a second. An order with an error (OrderError) is not sent; the
  // reply is made here.
  std::optional<ControlReplyMessage> Ask(const ControlOrder& order, double timeout_s,
                                         const std::function<bool()>& given_up = nullptr);
  // Another space server resumes the run under that number.
  void FollowRun(std::uint64_t run);
  // Returns the status of the run that was received last; nullopt if no Ask has received one.
  std::optional<RunStatus> LatestStatus();
  // Sends without waiting for a reply. Returns why the order is not sent (OrderError); empty if it was sent.
  std::string Send(const ControlOrder& order);

private:
  using Clock = std::chrono::steady_clock;

  static ControlRequestMessage RequestOf(const ControlOrder& order);
  void Heard(const RunStatusMessage& message);

  Bus& bus_;
  std::string experiment_;
  std::uint64_t run_;
  // Guards the five members below and run_.
  std::mutex mutex_;
  std::condition_variable answered_;
  std::optional<RunStatus> status_;
  Clock::time_point got_on_;  // when the run last made progress
  std::uint32_t number_;      // number of the last request
  std::optional<ControlReplyMessage> reply_;
  Publisher<ControlRequestMessage> requests_;
  Subscription<ControlReplyMessage> replies_;
  std::unique_ptr<Subscription<RunStatusMessage>> statuses_;  // made by Ask
};

}  // namespace swarmanoid
