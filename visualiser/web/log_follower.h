// Reads new lines from the logs of a run's processes, for the page's log. web_render calls it periodically in the
// thread of Draw and Idle.
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
  // Reads the lines since the last call, at most 64 KiB of each log. If a log grows faster, the middle is left out,
  // with a message.
  void Read(const OnLine& on_line);

private:
  void ReadFile(const std::filesystem::path& path, std::uintmax_t size, const OnLine& on_line);

  std::filesystem::path folder_;                          // empty: none
  std::map<std::filesystem::path, std::uintmax_t> read_;  // by log: the bytes that were read
};

}  // namespace swarmanoid
