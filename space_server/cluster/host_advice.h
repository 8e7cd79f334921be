// HostAdvice: whether controller hosts hear of far more robots than they would if the robots were shared out anew by
// where they are. Used by the main thread of the space_server program.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "common/bus/server_session.h"
#include "space_server/cluster/lockstep.h"

namespace swarmanoid
{

class HostAdvice
{
public:
  using Clock = std::chrono::steady_clock;

  // All outlive it.
  HostAdvice(const ServerSession& session, Lockstep& lockstep, const Experiment& experiment,
             const Assignment& assignment);

  // To be asked now and then; looks each few seconds. What to tell the user, once.
  std::optional<std::string> Take(Clock::time_point now);

private:
  // The farthest one of a host; negative if one hears the state of all.
  double Reach() const;

  const ServerSession& session_;
  Lockstep& lockstep_;
  const Experiment& experiment_;
  const Assignment& assignment_;
  Clock::time_point next_;
  bool is_over_;
};

}  // namespace swarmanoid
