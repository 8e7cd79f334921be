// PastInside: what robots sensed, thought and commanded at ticks of the past, for those who look back. The journal does
// not have it. The command `swarmanoid inspect` computes it, in a process of its own: it steps controllers of users,
// who may crash or hang it. Made and asked by renderers in the thread of Draw and Idle.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/messages/robot_status.h"
#include "visualiser/playback_reader.h"

namespace swarmanoid
{

// The program of the command, in the environment of what it starts.
inline constexpr const char* kCommandVariable = "SWARMANOID_COMMAND";

struct PastInsideAnswer
{
  std::uint64_t tick = 0;
  std::vector<RobotStatus> robots;
  std::string error;  // why there are none
};

// The robots of what `swarmanoid inspect --json` prints. Throws std::runtime_error if it is something else.
std::vector<RobotStatus> ReadInspection(const Experiment& experiment, std::uint64_t tick, const std::string& json);

class PastInside
{
public:
  // Called in the thread of this.
  using Answered = std::function<void(std::uint64_t client, const PastInsideAnswer&)>;

  // The experiment outlives this. Nothing is ever answered where IsPossible is false.
  PastInside(const Experiment& experiment, std::string run_folder, Answered answered);
  // Ends the process that computes.
  ~PastInside();
  PastInside(const PastInside&) = delete;
  PastInside& operator=(const PastInside&) = delete;

  // Whether the command started this process, and the run is of this user: nobody steps what others wrote.
  bool IsPossible() const { return !program_.empty(); }
  // The newest request of a client counts, once it has stood for a moment; what is computed for an older one is given
  // up. Entities without a controller are ignored.
  void Ask(std::uint64_t client, const LookBackRequest& request);
  void Forget(std::uint64_t client);

private:
  struct Wanted
  {
    LookBackRequest request;
    std::uint64_t number = 0;  // of all requests
  };

  void Work();
  bool IsWanted(std::uint64_t client, std::uint64_t number);
  PastInsideAnswer Compute(std::uint64_t client, const Wanted& wanted);

  const Experiment& experiment_;
  const std::string run_folder_;
  const std::string program_;
  const Answered answered_;

  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::map<std::uint64_t, Wanted> wanted_;
  std::uint64_t requests_ = 0;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace swarmanoid
