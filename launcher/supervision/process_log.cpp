#include "launcher/supervision/process_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "common/configuration/output_file.h"

namespace swarmanoid
{
namespace
{

// Removes the escape sequences of terminals (ECMA-48, 5.4). Each has the introducer, parameters, and a final byte.
std::string WithoutEscapes(std::string line)
{
  for (std::size_t start = line.find('\x1b'); start != std::string::npos; start = line.find('\x1b', start))
  {
    std::size_t end = start + 1;
    if (end < line.size() && line[end] == '[')
    {
      ++end;
      while (end < line.size() && line[end] >= 0x20 && line[end] < 0x40) ++end;
    }
    line.erase(start, std::min(end + 1, line.size()) - start);
  }
  return line;
}

}  // namespace

ProcessLog::ProcessLog(std::string path, bool goes_on) : path_(std::move(path)), file_(OpenOutputFile(path_, goes_on))
{
  if (!file_) throw std::runtime_error(fmt::format("cannot write the log '{}': {}", path_, std::strerror(errno)));
}

void ProcessLog::Add(std::string_view line)
{
  last_lines_.push_back(WithoutEscapes(std::string(line)));
  const std::string& added = last_lines_.back();
  if (last_lines_.size() > kLines) last_lines_.pop_front();
  if (!trouble_.empty()) return;
  std::fwrite(added.data(), 1, added.size(), file_.get());
  std::fputc('\n', file_.get());
  if (std::fflush(file_.get()) != 0) trouble_ = std::strerror(errno);
}

}  // namespace swarmanoid
