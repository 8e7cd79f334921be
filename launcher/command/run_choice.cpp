#include "launcher/command/run_choice.h"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <thread>
#include <vector>

#include "common/configuration/wording.h"
#include "common/errors/print_error.h"
#include "common/program/interrupts.h"
#include "common/run/access/access_grant.h"
#include "common/run/access/run_directory.h"
#include "launcher/command/sub_command.h"
#include "launcher/system/network_namespace.h"

namespace swarmanoid
{
namespace
{

constexpr std::chrono::milliseconds kLook{200};  // between two looks for a run

std::string Described(const std::vector<LocalRun>& runs)
{
  std::string text;
  for (const LocalRun& run : runs) text += fmt::format("\n  {} (domain {})", run.experiment, run.domain);
  return text;
}

RunChoice ChoiceOf(const LocalRun& run)
{
  return {run.experiment, run.domain, static_cast<int>(run.server), !run.key.has_value(), run.network};
}

// Asks the user at the terminal for one of several runs.
const LocalRun& Ask(const std::vector<LocalRun>& runs)
{
  PrintError("several experiments run on this machine:\n");
  for (std::size_t i = 0; i < runs.size(); ++i)
    PrintError("  {}  {} (domain {})\n", i + 1, runs[i].experiment, runs[i].domain);
  PrintError("which one, 1 to {}? ", runs.size());
  std::string line;
  std::getline(std::cin, line);
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
  if (error != std::errc() || end != line.data() + line.size() || number < 1 || number > runs.size())
    throw UsageError(fmt::format("{} is none of 1 to {}", Quoted(line), runs.size()));
  return runs[number - 1];
}

std::vector<LocalRun> Fitting(const std::string& name, std::optional<int> domain)
{
  std::vector<LocalRun> runs = FindLocalRuns();
  std::erase_if(runs, [&](const LocalRun& run)
                { return (!name.empty() && run.experiment != name) || (domain && run.domain != *domain); });
  return runs;
}

}  // namespace

RunChoice RunOf(const AccessToken& token, const std::string& name)
{
  if (name.empty() || name == token.experiment) return {token.experiment, token.domain, std::nullopt};
  throw UsageError(fmt::format("the access grant in {} is of experiment {}, not of {}; `unset {}` for runs of your own",
                               kTokenVariable, Quoted(token.experiment), Quoted(name), kTokenVariable));
}

void CheckInsecure(const RunChoice& run, const BusOptions& options)
{
  if (!run.server || options.insecure == run.lets_anybody_in) return;
  throw UsageError(
      run.lets_anybody_in
          ? fmt::format("the run of {} lets anybody in, as it was started with --insecure, and understands "
                        "only those who are, too; give --insecure here",
                        Quoted(run.experiment))
          : fmt::format("the run of {} has a key, and understands only those who use it; leave out "
                        "--insecure: the key is found on this machine",
                        Quoted(run.experiment)));
}

void UseNetworkOf(const RunChoice& run, BusOptions& options)
{
  if (!run.server || options.Spread() || !options.peers.empty() || !options.discovery_server.empty()) return;
  options.network_interface = run.network.network_interface;
  options.peers = run.network.peers;
  options.discovery_server = run.network.discovery_server;
  EnterNetworkOf(*run.server);
}

RunChoice AwaitRun(const std::string& name, std::optional<int> domain, double wait_s)
{
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait_s);
  const bool elsewhere = domain && !name.empty();
  for (bool told = false; !elsewhere && std::chrono::steady_clock::now() < deadline; told = true)
  {
    if (!Fitting(name, domain).empty()) break;
    if (!told)
      PrintError("no experiment{} runs on this machine yet; waiting {:g} s for it to start\n",
                 name.empty() ? "" : " " + Quoted(name), wait_s);
    std::this_thread::sleep_for(kLook);
  }
  const std::vector<LocalRun> fitting = Fitting(name, domain);
  const bool terminal = isatty(STDIN_FILENO) != 0 && isatty(STDERR_FILENO) != 0;
  return fitting.size() > 1 && terminal ? ChoiceOf(Ask(fitting)) : ChooseRun(name, domain);
}

std::optional<RunChoice> AwaitNextRun(const RunChoice& run)
{
  while (!Interrupted())
  {
    for (const LocalRun& next : Fitting(run.experiment, std::nullopt))
      if (static_cast<int>(next.server) != run.server) return ChoiceOf(next);
    std::this_thread::sleep_for(kLook);
  }
  return std::nullopt;
}

RunChoice ChooseRun(const std::string& name, std::optional<int> domain)
{
  const std::vector<LocalRun> fitting = Fitting(name, domain);
  if (fitting.size() == 1) return ChoiceOf(fitting[0]);
  if (fitting.size() > 1)
    throw UsageError(
        fmt::format("several experiments run on this machine; name one, or its --domain:{}", Described(fitting)));

  // The experiment may run on another machine.
  if (domain && !name.empty()) return {name, *domain, std::nullopt};
  if (domain)
    throw UsageError("no experiment runs on this machine in that domain; name the experiment if it runs elsewhere");
  const std::vector<LocalRun> all = FindLocalRuns();
  if (all.empty())
    throw UsageError(
        "no experiment runs on this machine as a cluster; for one on another machine give its name and --domain");
  std::vector<std::string> names;
  for (const LocalRun& run : all) names.push_back(run.experiment);
  throw UsageError(fmt::format("no experiment {} runs on this machine{}; these do:{}", Quoted(name),
                               DidYouMean(name, names), Described(all)));
}

}  // namespace swarmanoid
