#include "launcher/processes/server_status.h"

#include <charconv>
#include <vector>

namespace swarmanoid
{
namespace
{

// The word before the next blank, taken from the front of the text.
std::string_view TakeWord(std::string_view& text)
{
  const std::size_t end = text.find(' ');
  const std::string_view word = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  return word;
}

bool Read(std::string_view& text, std::uint64_t& value, int base = 10)
{
  const std::string_view word = TakeWord(text);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base);
  return error == std::errc() && end == word.data() + word.size();
}

bool Read(std::string_view& text, double& value)
{
  const std::string_view word = TakeWord(text);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

std::optional<ServerStatus> ParseState(std::string_view text)
{
  const std::string_view phase = TakeWord(text);
  if (phase == "loading") return ServerState{ServerState::kLoading, {}};
  if (phase == "waiting") return ServerState{ServerState::kWaiting, std::string(text)};
  if (phase == "running") return ServerState{ServerState::kRunning, {}};
  if (phase == "paused") return ServerState{ServerState::kPaused, {}};
  return std::nullopt;
}

// The name may hold blanks ("controller_host 0"); the seconds are the last word.
std::optional<ServerStatus> ParseStall(std::string_view text)
{
  const std::size_t blank = text.rfind(' ');
  if (blank == std::string_view::npos) return std::nullopt;
  ServerStall stall{std::string(text.substr(0, blank)), 0};
  std::string_view seconds = text.substr(blank + 1);
  if (!Read(seconds, stall.seconds)) return std::nullopt;
  return stall;
}

}  // namespace

std::optional<ServerStatus> ParseServerStatus(std::string_view line)
{
  const std::string_view verb = TakeWord(line);
  if (verb == "state") return ParseState(line);
  if (verb == "stalled") return ParseStall(line);
  if (verb == "error") return ServerError{std::string(line)};
  if (verb == "tick")
  {
    ServerTick tick;
    if (Read(line, tick.tick) && Read(line, tick.max) && Read(line, tick.real_time_factor) && line.empty()) return tick;
  }
  if (verb == "finished")
  {
    ServerFinished finished;
    if (Read(line, finished.ticks) && Read(line, finished.entities) && Read(line, finished.hash, 16) &&
        Read(line, finished.wall_s) && Read(line, finished.real_time_factor) && line.empty())
      return finished;
  }
  return std::nullopt;
}

}  // namespace swarmanoid
