// LatestMessage: keeps the latest message of a topic, for tests that look at a run from outside.
#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "common/bus/bus.h"

namespace swarmanoid
{

template <class Message>
class LatestMessage
{
public:
  LatestMessage(Bus& bus, const std::string& experiment)
      : subscription_(bus, experiment,
                      [this](const Message& message)
                      {
                        const std::lock_guard lock(mutex_);
                        message_ = message;
                        ++count_;
                      })
  {
  }
  std::optional<Message> Get() const
  {
    const std::lock_guard lock(mutex_);
    return message_;
  }
  int Count() const
  {
    const std::lock_guard lock(mutex_);
    return count_;
  }

private:
  // Guards message_ and count_.
  mutable std::mutex mutex_;
  std::optional<Message> message_;
  int count_ = 0;
  Subscription<Message> subscription_;
};

}  // namespace swarmanoid
