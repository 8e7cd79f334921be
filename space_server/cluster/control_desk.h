// ControlDesk: what users ask of a running experiment, and when the next tick may start: pause, resume, step, speed,
// stop, move. Requests come from threads of the bus; all else is called by the main thread of the space_server program.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <vector>

#include "common/bus/server_session.h"
#include "space_server/space_server.h"

namespace swarmanoid
{

class ControlDesk
{
public:
  using Clock = std::chrono::steady_clock;

  struct Decision
  {
    bool go = false;
    std::uint64_t until = 0;               // with go: hold before this tick is sent; 0: run on
    std::optional<Clock::time_point> due;  // without go: when it will be time, unless paused
  };

  ControlDesk(ServerSession& session, const Experiment& experiment, bool paused, double real_time_factor);

  // From any thread: a request has come.
  void Ask(const ControlRequestMessage& request);

  // The first tick may start.
  void Start(std::uint64_t tick, Clock::time_point now);
  // The run is to hold before the next state is sent: requests wait, or somebody sets the pace.
  bool WantsHold() const;
  // Carries out what was asked; the server is between two ticks.
  void Work(SpaceServer& server);
  Decision Decide(std::uint64_t tick, Clock::time_point now);
  void Stop();
  bool Paused() const { return paused_ && !stop_; }
  // Answers those who still wait for a step.
  void Ended(std::uint64_t tick);

private:
  void Carry(const ControlRequestMessage& request, SpaceServer& server);
  std::string Move(const ControlRequestMessage& request, SpaceServer& server) const;
  void SetPace(std::uint64_t tick, Clock::time_point now);

  ServerSession& session_;
  const Experiment& experiment_;
  mutable std::mutex mutex_;
  std::vector<ControlRequestMessage> requests_;

  bool paused_;
  bool stop_ = false;
  double real_time_factor_;
  std::uint64_t pause_at_ = 0;  // tick at which a step ends; 0: none
  std::optional<ControlRequestMessage> step_;
  bool pace_changed_ = false;
  std::uint64_t pace_tick_ = 0;
  Clock::time_point pace_start_;
};

}  // namespace swarmanoid
