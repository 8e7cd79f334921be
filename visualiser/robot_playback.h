// RobotPlayback: the readings, states and commands of robots at ticks of the past, for looking back. The journal does
// not store them. The command `swarmanoid inspect` computes them in its own process, since it steps users' controllers,
// which may crash or hang. Renderers make and call it in the thread of Draw and Idle.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "idl/robot_status.h"
#include "visualiser/playback_reader.h"

namespace swarmanoid
{

// The variable with the path of the command, set for the processes that the command starts.
inline constexpr const char* kCommandVariable = "SWARMANOID_COMMAND";

struct RobotPlaybackAnswer
{
  std::uint64_t tick = 0;
  std::vector<RobotStatus> robots;
  std::string error;  // the reason if there are no robots
};

// Returns the robots in the output of `swarmanoid inspect --json`. Throws std::runtime_error for other text.
std::vector<RobotStatus> ReadInspection(const Experiment& experiment, std::uint64_t tick, const std::string& json);

// Returns the command that started this process. It is empty if there is none, or if the run belongs to another user:
// journals of others are not executed.
std::string CommandFor(const std::string& run_folder);

class RobotPlayback
{
public:
  // The function is called in this object's thread.
  using Answered = std::function<void(std::uint64_t client, const RobotPlaybackAnswer&)>;

  // The experiment must outlive the object. If IsPossible is false, it never answers.
  RobotPlayback(const Experiment& experiment, std::string run_folder, Answered answered);
  // Ends the process that computes.
  ~RobotPlayback();
  RobotPlayback(const RobotPlayback&) = delete;
  RobotPlayback& operator=(const RobotPlayback&) = delete;

  // Returns whether the command started this process and the run belongs to this user. Journals of other users are not
  // executed.
  bool IsPossible() const { return !program_.empty(); }
  // Sends a request. Only the newest request of a client counts, after a short delay; the computation of an older one
  // is stopped. Entities without a controller are ignored.
  void Ask(std::uint64_t client, const LookBackRequest& request);
  void Forget(std::uint64_t client);

private:
  struct Wanted
  {
    LookBackRequest request;
    std::uint64_t number = 0;  // the number of the request among all requests
  };

  void Work();
  bool IsWanted(std::uint64_t client, std::uint64_t number);
  RobotPlaybackAnswer Compute(std::uint64_t client, const Wanted& wanted);

  const Experiment& experiment_;
  const std::string run_folder_;
  const std::string program_;
  const Answered answered_;

  std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::map<std::uint64_t, Wanted> wanted_;
  std::uint64_t requests_ = 0;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace swarmanoid
