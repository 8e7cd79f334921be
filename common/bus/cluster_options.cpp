#include "common/bus/cluster_options.h"

#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <csignal>
#include <cstdio>

#include "common/activity/failure_report.h"
#include "common/activity/limits.h"
#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

namespace
{

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

void AddBusOptions(CLI::App& app, BusOptions& options)
{
  app.add_option("--domain", options.domain, "DDS domain of the experiment; programs of different domains never meet")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  app.add_option(
      "--interface", options.network_interface,
      "network to use: lo (this machine only), all, or the name or IPv4 address of an interface. With --peers or "
      "--discovery-server: all");
  app.add_option("--peers", options.peers, "machines that take part, where the network has no multicast: A,B,...")
      ->delimiter(',');
  app.add_option("--discovery-server", options.discovery_server,
                 "ADDRESS:PORT where the space server listens for the others, where the network has no multicast; the "
                 "same for all");
  app.add_option("--lease", options.lease_s, "seconds of silence after which a process is taken for dead")
      ->check(CLI::Range(0.2, 3600.0))
      ->capture_default_str();
  app.add_option("--datagram", options.datagram_bytes, "largest datagram in bytes; 1440 on networks that lose packets")
      ->check(CLI::Range(1024, 65500))
      ->capture_default_str();
}

int ParseCommandLine(CLI::App& app, int argc, char** argv)
{
  try
  {
    app.parse(argc, argv);
    return -1;
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error) == 0 ? kExitDone : kExitUsage;
  }
}

int RunProgram(const std::string& program, int (*run)(int argc, char** argv), int argc, char** argv)
{
  ReportDeaths(program);
  ApplyLimits(LimitsOfEnvironment());
  try
  {
    return run(argc, argv);
  }
  catch (const ConfigurationError& error)
  {
    NoteEnd(EndReason::kInvalid, 0, error.what(), true);
    fmt::print(stderr, "{}\n", error.what());
    return kExitInvalidFile;
  }
  catch (const std::exception& error)
  {
    NoteEnd(Interrupted() ? EndReason::kInterrupted : EndReason::kFailed, 0, error.what(), true);
    fmt::print(stderr, "{}: {}\n", program, error.what());
    return Interrupted() ? kExitInterrupted : kExitProcessFailed;
  }
}

void CatchInterrupts()
{
  struct sigaction action
  {
  };
  action.sa_handler = [](int) { interrupted = 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

bool Interrupted() { return interrupted != 0; }

}  // namespace swarmanoid
