#include "launcher/processes/process_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "common/configuration/output_file.h"

namespace swarmanoid
{

ProcessLog::ProcessLog(std::string path, bool goes_on) : path_(std::move(path)), file_(OpenOutputFile(path_, goes_on))
{
  if (!file_) throw std::runtime_error(fmt::format("cannot write the log '{}': {}", path_, std::strerror(errno)));
}

void ProcessLog::Add(std::string_view line)
{
  last_lines_.emplace_back(line);
  if (last_lines_.size() > kLines) last_lines_.pop_front();
  if (!trouble_.empty()) return;
  std::fwrite(line.data(), 1, line.size(), file_.get());
  std::fputc('\n', file_.get());
  if (std::fflush(file_.get()) != 0) trouble_ = std::strerror(errno);
}

}  // namespace swarmanoid
