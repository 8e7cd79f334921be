// The command-line options that all programs of a cluster share.
#pragma once

#include <string>

#include "common/bus/bus.h"

namespace CLI
{
class App;
}

namespace swarmanoid
{

// Adds --domain, --interface, --peers, --discovery-server, --lease and --datagram.
void AddBusOptions(CLI::App& app, BusOptions& options);

// Exit codes of all programs.
inline constexpr int kExitDone = 0;
inline constexpr int kExitExperimentFailed = 1;
inline constexpr int kExitUsage = 2;
inline constexpr int kExitInvalidFile = 3;
inline constexpr int kExitProcessFailed = 4;
inline constexpr int kExitOthersFailed = 6;  // of a process of a cluster: the run failed elsewhere
inline constexpr int kExitInterrupted = 130;

// Parses; the exit code where the program is to end at once (help, usage error), else -1.
int ParseCommandLine(CLI::App& app, int argc, char** argv);

// Calls `run` and turns what it throws into a message on standard error and an exit code.
int RunProgram(const std::string& program, int (*run)(int argc, char** argv), int argc, char** argv);

// Set by SIGINT and SIGTERM after CatchInterrupts.
void CatchInterrupts();
bool Interrupted();

}  // namespace swarmanoid
