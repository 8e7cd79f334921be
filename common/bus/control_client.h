// ControlClient: asks the space server of a running experiment to pause, resume, step, change speed, stop or move an
// entity. Used by `swarmanoid control` and by interactive visualisers.
#pragma once

#include <condition_variable>
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
  ControlClient(Bus& bus, const std::string& experiment);

  // Sends a request (ControlRequest in idl/swarmanoid.idl) and waits for the answer. nullopt where none came in time,
  // for instance because no such experiment runs.
  std::optional<ControlReplyMessage> Ask(const std::string& verb, const std::string& entity,
                                         const std::vector<double>& numbers, double timeout_s);
  // Sends without waiting for an answer.
  void Tell(const std::string& verb, const std::string& entity, const std::vector<double>& numbers);

private:
  std::mutex mutex_;
  std::condition_variable answered_;
  std::uint32_t number_;  // of the last request
  std::optional<ControlReplyMessage> reply_;
  Publisher<ControlRequestMessage> requests_;
  Subscription<ControlReplyMessage> replies_;
};

}  // namespace swarmanoid
