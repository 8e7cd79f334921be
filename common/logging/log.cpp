#include "common/logging/log.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "common/configuration/output_file.h"
#include "common/configuration/shown_text.h"

namespace swarmanoid
{
namespace
{

spdlog::level::level_enum SpdlogLevel(LogLevel level)
{
  switch (level)
  {
    case LogLevel::kDebug:
      return spdlog::level::debug;
    case LogLevel::kInfo:
      return spdlog::level::info;
    case LogLevel::kWarning:
      return spdlog::level::warn;
    case LogLevel::kError:
      return spdlog::level::err;
  }
  return spdlog::level::err;
}

std::shared_ptr<spdlog::logger> MakeLogger(const std::string& process, std::vector<spdlog::sink_ptr> sinks)
{
  auto logger = std::make_shared<spdlog::logger>(process, sinks.begin(), sinks.end());
  logger->set_level(spdlog::level::debug);  // each sink has its own level
  logger->flush_on(spdlog::level::debug);
  logger->set_error_handler(
      [process](const std::string& message)
      {
        static std::atomic<bool> said = false;
        if (!said.exchange(true)) std::fprintf(stderr, "%s: records are lost: %s\n", process.c_str(), message.c_str());
      });
  return logger;
}

spdlog::sink_ptr StderrSink(LogLevel level)
{
  auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  sink->set_level(SpdlogLevel(level));
  sink->set_pattern("%n: %l: %v");
  return sink;
}

// The logger lives to the end of the process, since destructors of static objects may log.
std::shared_ptr<spdlog::logger>& CurrentLogger()
{
  static auto* logger = new std::shared_ptr<spdlog::logger>(MakeLogger("swarmanoid", {StderrSink(LogLevel::kWarning)}));
  return *logger;
}

}  // namespace

void OpenLog(const LogSettings& settings)
{
  std::vector<spdlog::sink_ptr> sinks{StderrSink(settings.stderr_level)};
  if (!settings.folder.empty())
  {
    const std::string path = (std::filesystem::path(settings.folder) / (settings.process + ".log")).string();
    // The file is opened here first, because spdlog tries five times and then reports no cause.
    std::FILE* file = OpenOutputFile(path, true);
    if (file == nullptr)
      throw std::runtime_error("cannot write the log " + path + ": " + std::generic_category().message(errno));
    std::fclose(file);
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(path);
    sink->set_level(SpdlogLevel(settings.file_level));
    sink->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
    sinks.push_back(std::move(sink));
  }
  CurrentLogger() = MakeLogger(settings.process, std::move(sinks));
}

// Control characters are replaced, since controllers log any text and a log may be read on a terminal.
void Log(LogLevel level, std::string_view text)
{
  if (!IsShowable(text)) return Log(level, Showable(text));
  CurrentLogger()->log(SpdlogLevel(level), spdlog::string_view_t(text.data(), text.size()));
}

}  // namespace swarmanoid
