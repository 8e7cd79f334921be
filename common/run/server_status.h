// What the space server tells whoever started it, line by line, on the descriptor of --status-fd: state, tick, stalled,
// warning, asked, error, left, lost, move, hosts, reset, finished. Writer and reader of each kind come from one
// description (server_status.cpp).
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

// "warning TEXT": the run goes on, but not as asked
struct ServerWarning
{
  std::string text;

  friend bool operator==(const ServerWarning&, const ServerWarning&) = default;
};

// "asked TEXT": who had the run paused, resumed, stopped or told another speed, and when
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

// "left NAME": a process said that its work is done, and ends
struct ServerLeft
{
  std::string name;

  friend bool operator==(const ServerLeft&, const ServerLeft&) = default;
};

// "lost NAME": a process has been silent for its lease; another one has to take its place
struct ServerLost
{
  std::string name;

  friend bool operator==(const ServerLost&, const ServerLost&) = default;
};

// "move MACHINE NAME": a user asks that another process takes the place of this one, on that machine ("here": that of
// the launcher)
struct ServerMove
{
  std::string machine;  // without blanks
  std::string name;

  friend bool operator==(const ServerMove&, const ServerMove&) = default;
};

// "reset SEED 0|1 RTF", before "finished": the run ends, and is to begin again with that seed, paused or not, at that
// pace
struct ServerReset
{
  std::uint64_t seed = 0;
  bool paused = false;
  double real_time_factor = 0;

  friend bool operator==(const ServerReset&, const ServerReset&) = default;
};

// "hosts MACHINES": a user asks that the robots' controllers are shared out among as many controller hosts as are
// named, on these machines, in the order of the hosts
struct ServerHosts
{
  std::string machines;  // with blanks between them

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

// The line, without its end. Line breaks and other control characters in texts become blanks.
std::string ServerStatusLine(const ServerStatus& status);
// nullopt for a line that is none of these, whole and with numbers that a run can have.
std::optional<ServerStatus> ParseServerStatus(std::string_view line);

}  // namespace swarmanoid
