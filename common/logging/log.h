// The log of one process: a file in the run directory, and warnings and errors on standard error too. Every program
// uses it; any thread may log. Results do not belong here: they go to standard output or to their own files.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace swarmanoid
{

enum class LogLevel
{
  kDebug,    // for debugging the simulator
  kInfo,     // the course of the run: connected, started, stopped
  kWarning,  // the run continues, but not as requested
  kError     // why the process ends
};

struct LogSettings
{
  std::string process = "swarmanoid";  // its name in records and of the file: "engine_worker-ground"
  std::string folder = "";             // the folder of <process>.log; empty: no file
  LogLevel file_level = LogLevel::kInfo;
  LogLevel stderr_level = LogLevel::kWarning;
};

// Opens the log, once, before other threads start. Until then, warnings and errors go to standard error. Throws
// std::runtime_error, with the path and the cause, if the file cannot be written.
void OpenLog(const LogSettings& settings);

// Writes each record through at once, so that the file of a killed process is complete. A full disk loses records
// (reported once, on standard error), never the run.
void Log(LogLevel level, std::string_view text);

template <class... Arguments>
void LogDebug(fmt::format_string<Arguments...> format, Arguments&&... arguments)
{
  Log(LogLevel::kDebug, fmt::format(format, std::forward<Arguments>(arguments)...));
}
template <class... Arguments>
void LogInfo(fmt::format_string<Arguments...> format, Arguments&&... arguments)
{
  Log(LogLevel::kInfo, fmt::format(format, std::forward<Arguments>(arguments)...));
}
template <class... Arguments>
void LogWarning(fmt::format_string<Arguments...> format, Arguments&&... arguments)
{
  Log(LogLevel::kWarning, fmt::format(format, std::forward<Arguments>(arguments)...));
}
template <class... Arguments>
void LogError(fmt::format_string<Arguments...> format, Arguments&&... arguments)
{
  Log(LogLevel::kError, fmt::format(format, std::forward<Arguments>(arguments)...));
}

}  // namespace swarmanoid
