// ProcessLog: the log of one process: a file in the run directory, and its last lines in memory, which stay readable
// when the disk is full.
#pragma once

#include <cstdio>
#include <deque>
#include <memory>
#include <string>
#include <string_view>

namespace swarmanoid
{

class ProcessLog
{
public:
  // Opens a log. With `goes_on` it appends to an existing file. Throws std::runtime_error if the file cannot be made.
  explicit ProcessLog(std::string path, bool goes_on = false);

  // Adds a line. It removes colours, which a process behind ssh sends because it has a terminal.
  void Add(std::string_view line);
  const std::string& Path() const { return path_; }
  // Returns the last lines, at most kLines.
  const std::deque<std::string>& LastLines() const { return last_lines_; }
  // Returns why lines are missing from the file; empty if none are.
  const std::string& Trouble() const { return trouble_; }

  static constexpr std::size_t kLines = 8;

private:
  struct Close
  {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::deque<std::string> last_lines_;
  std::string trouble_;
};

}  // namespace swarmanoid
