// What the space server tells the launcher, line by line: state, tick, stalled, error, finished.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace swarmanoid
{

// "state loading|waiting NAMES|running|paused"
struct ServerState
{
  enum Phase
  {
    kLoading,
    kWaiting,
    kRunning,
    kPaused
  };
  Phase phase = kLoading;
  std::string waiting_for;  // the names of those who have not joined
};

// "tick T MAX RTF"; MAX is 0 for a run without end.
struct ServerTick
{
  std::uint64_t tick = 0;
  std::uint64_t max = 0;
  double real_time_factor = 0;
};

// "stalled NAME SECONDS"
struct ServerStall
{
  std::string name;
  double seconds = 0;
};

// "error TEXT"
struct ServerError
{
  std::string text;
};

// "finished TICKS ENTITIES HASH WALL RTF"
struct ServerFinished
{
  std::uint64_t ticks = 0;
  std::uint64_t entities = 0;
  std::uint64_t hash = 0;
  double wall_s = 0;
  double real_time_factor = 0;
};

using ServerStatus = std::variant<ServerState, ServerTick, ServerStall, ServerError, ServerFinished>;

// nullopt for a line that is none of these.
std::optional<ServerStatus> ParseServerStatus(std::string_view line);

}  // namespace swarmanoid
