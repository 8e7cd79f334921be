// Reads what the logs of a run's folder gain: the lines of its processes, for the page's log. Used by web_render in the
// thread of Draw and Idle, now and then.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace swarmanoid
{

class LogFollower
{
public:
  // Follows nothing if the folder is not that of a run.
  explicit LogFollower(const std::filesystem::path& folder);

  using OnLine = std::function<void(const std::string& process, const std::string& line)>;
  // The lines since the last call, at most 64 KiB of each log: of one that grows faster the middle is left out, and
  // said so.
  void Read(const OnLine& on_line);

private:
  void ReadFile(const std::filesystem::path& path, std::uintmax_t size, const OnLine& on_line);

  std::filesystem::path folder_;                          // empty: none
  std::map<std::filesystem::path, std::uintmax_t> read_;  // bytes of each log
};

}  // namespace swarmanoid
