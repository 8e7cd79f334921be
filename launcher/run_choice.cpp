#include "launcher/run_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>
#include <vector>

#include "common/bus/run_directory.h"
#include "common/configuration/wording.h"
#include "launcher/commands.h"

namespace swarmanoid
{
namespace
{

std::string Described(const std::vector<LocalRun>& runs)
{
  std::string text;
  for (const LocalRun& run : runs) text += fmt::format("\n  {} (domain {})", run.experiment, run.domain);
  return text;
}

bool Fits(const LocalRun& run, const std::string& name, std::optional<int> domain)
{
  return (name.empty() || run.experiment == name) && (!domain || run.domain == *domain);
}

}  // namespace

RunChoice AwaitRun(const std::string& name, std::optional<int> domain, double wait_s)
{
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait_s);
  const bool elsewhere = domain && !name.empty();
  for (bool told = false; !elsewhere && std::chrono::steady_clock::now() < deadline; told = true)
  {
    const std::vector<LocalRun> runs = FindLocalRuns();
    if (std::any_of(runs.begin(), runs.end(), [&](const LocalRun& run) { return Fits(run, name, domain); })) break;
    if (!told)
      fmt::print(stderr, "no experiment{} runs on this machine yet; waiting {:g} s for it to start\n",
                 name.empty() ? "" : " " + Quoted(name), wait_s);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  return ChooseRun(name, domain);
}

RunChoice ChooseRun(const std::string& name, std::optional<int> domain)
{
  const std::vector<LocalRun> all = FindLocalRuns();
  std::vector<LocalRun> fitting;
  std::vector<std::string> names;
  for (const LocalRun& run : all)
  {
    names.push_back(run.experiment);
    if (Fits(run, name, domain)) fitting.push_back(run);
  }
  if (fitting.size() == 1) return {fitting[0].experiment, fitting[0].domain, static_cast<int>(fitting[0].server)};
  if (fitting.size() > 1)
    throw UsageError(
        fmt::format("several experiments run on this machine; name one, or its --domain:{}", Described(fitting)));

  // It may run elsewhere.
  if (domain && !name.empty()) return {name, *domain, std::nullopt};
  if (domain)
    throw UsageError("no experiment runs on this machine in that domain; name the experiment if it runs elsewhere");
  if (all.empty())
    throw UsageError(
        "no experiment runs on this machine as a cluster; for one on another machine give its name and --domain");
  throw UsageError(fmt::format("no experiment {} runs on this machine{}; these do:{}", Quoted(name),
                               DidYouMean(name, names), Described(all)));
}

}  // namespace swarmanoid
