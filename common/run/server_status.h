// The messages of the space server to its launcher, line by line, on the descriptor of --status-fd. A line is the word
// of its kind and the fields that `Visit` names, in their order (server_status.cpp). A text comes last and may have
// blanks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace swarmanoid
{

template <std::size_t kSize>
struct StatusWord
{
  // NOLINTNEXTLINE(google-explicit-constructor): a text is a word
  consteval StatusWord(const char (&word)[kSize]) { std::copy_n(word, kSize, text); }
  char text[kSize] = {};
};

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
  std::string waiting_for{};  // names of the processes that have not joined

  static constexpr std::string_view word = "state";
  static void Visit(auto& archive, auto& line)
  {
    archive.Choice(line.phase);
    archive.Text(line.waiting_for);
  }
  friend bool operator==(const ServerState&, const ServerState&) = default;
};

struct ServerTick
{
  std::uint64_t tick = 0;
  std::uint64_t max = 0;  // 0 for a run without end
  double real_time_factor = 0;

  static constexpr std::string_view word = "tick";
  static void Visit(auto& archive, auto& line)
  {
    archive.Number(line.tick);
    archive.Number(line.max);
    archive.Number(line.real_time_factor);
  }
  friend bool operator==(const ServerTick&, const ServerTick&) = default;
};

struct ServerStall
{
  double seconds = 0;
  std::string name;

  static constexpr std::string_view word = "stalled";
  static void Visit(auto& archive, auto& line)
  {
    archive.Number(line.seconds);
    archive.Text(line.name);
  }
  friend bool operator==(const ServerStall&, const ServerStall&) = default;
};

// "move MACHINE NAME": a user requests to replace this process by one on that machine ("here": the launcher's machine)
struct ServerMove
{
  std::string machine;  // without blanks
  std::string name;

  static constexpr std::string_view word = "move";
  static void Visit(auto& archive, auto& line)
  {
    archive.Word(line.machine);
    archive.Text(line.name);
  }
  friend bool operator==(const ServerMove&, const ServerMove&) = default;
};

// The line comes before "finished": the run ends and must start again with that seed, paused or not, at that pace.
struct ServerReset
{
  std::uint64_t seed = 0;
  bool paused = false;
  double real_time_factor = 0;

  static constexpr std::string_view word = "reset";
  static void Visit(auto& archive, auto& line)
  {
    archive.Number(line.seed);
    archive.Number(line.paused);
    archive.Number(line.real_time_factor);
  }
  friend bool operator==(const ServerReset&, const ServerReset&) = default;
};

struct ServerFinished
{
  std::uint64_t ticks = 0;
  std::uint64_t entities = 0;
  std::uint64_t hash = 0;
  double wall_s = 0;
  double real_time_factor = 0;
  std::string failure{};  // why the experiment functions ended the run as failed, if they did

  static constexpr std::string_view word = "finished";
  static void Visit(auto& archive, auto& line)
  {
    archive.Number(line.ticks);
    archive.Number(line.entities);
    archive.Hash(line.hash);
    archive.Number(line.wall_s);
    archive.Number(line.real_time_factor);
    archive.Text(line.failure);
  }
  friend bool operator==(const ServerFinished&, const ServerFinished&) = default;
};

template <StatusWord kWord>
struct ServerText
{
  std::string text;

  static constexpr std::string_view word = kWord.text;
  static void Visit(auto& archive, auto& line) { archive.Text(line.text); }
  friend bool operator==(const ServerText&, const ServerText&) = default;
};
using ServerWarning = ServerText<"warning">;  // the run continues, but not as requested
using ServerAsked = ServerText<"asked">;      // which user paused, resumed, stopped or changed the speed, and when
using ServerError = ServerText<"error">;      // why the run fails
using ServerLeft = ServerText<"left">;        // a process, by its name, has reported the end of its work, and ends
using ServerLost = ServerText<"lost">;        // a process has been silent for its lease and must be replaced
// A user requests to assign the robots' controllers to controller hosts on these machines, in the order of the hosts.
// Each name stands for one host; the names are separated by blanks.
using ServerHosts = ServerText<"hosts">;

using ServerStatus = std::variant<ServerState, ServerTick, ServerStall, ServerWarning, ServerAsked, ServerError,
                                  ServerLeft, ServerLost, ServerMove, ServerHosts, ServerReset, ServerFinished>;

// Returns the line, without its end. Line breaks and other control characters in texts become blanks.
std::string ServerStatusLine(const ServerStatus& status);
// Returns nullopt for a line that is not one of these, or has numbers that a run cannot have.
std::optional<ServerStatus> ParseServerStatus(std::string_view line);

}  // namespace swarmanoid
