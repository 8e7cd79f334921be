// The messages of the space server to its launcher, line by line, on the descriptor of --status-fd: state, tick,
// stalled, warning, asked, error, left, lost, move, hosts, reset, finished. Writer and reader of each kind follow from
// one description (server_status.cpp).
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
  std::string waiting_for;  // names of the processes that have not joined

  friend bool operator==(const ServerState&, const ServerState&) = default;
};

// "tick T MAX RTF"; MAX is 0 for a run without end.
struct ServerTick
{
  std::uint64_t tick = 0;
  std::uint64_t max = 0;
  double real_time_factor = 0;

  friend bool operator==(const ServerTick&, const ServerTick&) = default;
};

// "stalled NAME SECONDS"
struct ServerStall
{
  std::string name;
  double seconds = 0;

  friend bool operator==(const ServerStall&, const ServerStall&) = default;
};

// "warning TEXT": the run continues, but not as requested
struct ServerWarning
{
  std::string text;

  friend bool operator==(const ServerWarning&, const ServerWarning&) = default;
};

// "asked TEXT": which user paused, resumed, stopped or changed the speed of the run, and when
struct ServerAsked
{
  std::string text;

  friend bool operator==(const ServerAsked&, const ServerAsked&) = default;
};

// "error TEXT"
struct ServerError
{
  std::string text;

  friend bool operator==(const ServerError&, const ServerError&) = default;
};

// "left NAME": a process reported the end of its work, and ends
struct ServerLeft
{
  std::string name;

  friend bool operator==(const ServerLeft&, const ServerLeft&) = default;
};

// "lost NAME": a process has been silent for its lease and must be replaced
struct ServerLost
{
  std::string name;

  friend bool operator==(const ServerLost&, const ServerLost&) = default;
};

// "move MACHINE NAME": a user requests to replace this process by one on that machine ("here": the launcher's machine)
struct ServerMove
{
  std::string machine;  // without blanks
  std::string name;

  friend bool operator==(const ServerMove&, const ServerMove&) = default;
};

// "reset SEED 0|1 RTF", before "finished": the run ends and must start again with that seed, paused or not, at that
// pace
struct ServerReset
{
  std::uint64_t seed = 0;
  bool paused = false;
  double real_time_factor = 0;

  friend bool operator==(const ServerReset&, const ServerReset&) = default;
};

// "hosts MACHINES": a user requests to assign the robots' controllers to controller hosts on these machines, in the
// order of the hosts. Each name stands for one host.
struct ServerHosts
{
  std::string machines;  // separated by blanks

  friend bool operator==(const ServerHosts&, const ServerHosts&) = default;
};

// "finished TICKS ENTITIES HASH WALL RTF"
struct ServerFinished
{
  std::uint64_t ticks = 0;
  std::uint64_t entities = 0;
  std::uint64_t hash = 0;
  double wall_s = 0;
  double real_time_factor = 0;

  friend bool operator==(const ServerFinished&, const ServerFinished&) = default;
};

using ServerStatus = std::variant<ServerState, ServerTick, ServerStall, ServerWarning, ServerAsked, ServerError,
                                  ServerLeft, ServerLost, ServerMove, ServerHosts, ServerReset, ServerFinished>;

// Returns the line, without its end. Line breaks and other control characters in texts become blanks.
std::string ServerStatusLine(const ServerStatus& status);
// Returns nullopt for a line that is not one of these, or has numbers that a run cannot have.
std::optional<ServerStatus> ParseServerStatus(std::string_view line);

}  // namespace swarmanoid
