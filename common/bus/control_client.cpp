#include "common/bus/control_client.h"

#include <chrono>

namespace swarmanoid
{

using namespace std::chrono_literals;

ControlClient::ControlClient(Bus& bus, const std::string& experiment)
    : requests_(bus, experiment),
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

std::optional<ControlReplyMessage> ControlClient::Ask(const std::string& verb, const std::string& entity,
                                                      const std::vector<double>& numbers, double timeout_s)
{
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  std::unique_lock lock(mutex_);
  while (requests_.Readers() == 0 || replies_.Writers() == 0)
    if (answered_.wait_for(lock, 2ms), std::chrono::steady_clock::now() > deadline) return std::nullopt;
  reply_.reset();
  Send(verb, entity, numbers);
  answered_.wait_until(lock, deadline, [this] { return reply_.has_value(); });
  return reply_;
}

void ControlClient::Tell(const std::string& verb, const std::string& entity, const std::vector<double>& numbers)
{
  const std::lock_guard lock(mutex_);
  Send(verb, entity, numbers);
}

std::uint32_t ControlClient::Send(const std::string& verb, const std::string& entity,
                                  const std::vector<double>& numbers)
{
  requests_.Write({ProcessId(), ++number_, verb, entity, numbers});
  return number_;
}

}  // namespace swarmanoid
