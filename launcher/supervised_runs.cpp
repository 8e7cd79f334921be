#include "launcher/supervised_runs.h"

#include <unistd.h>

#include <cmath>

namespace swarmanoid
{
namespace
{

constexpr int kPatience_ms = 1000;

}  // namespace

std::optional<SupervisedRun> ReadSupervisedRun(const nlohmann::json& message)
{
  const auto text = [&](const char* name)
  { return message.contains(name) && message[name].is_string() ? message[name].get<std::string>() : std::string(); };
  const auto number = [&](const char* name)
  { return message.contains(name) && message[name].is_number() ? message[name].get<double>() : std::nan(""); };
  SupervisedRun run{text("experiment"), text("folder"), 0, 0, 0, std::nullopt, 0};
  const double domain = number("domain");
  const double supervisor = number("supervisor");
  const double launcher = number("launcher");
  if (run.experiment.empty() || run.folder.empty() || !(domain >= 0 && domain <= 232) ||
      !(supervisor > 0 && supervisor < 1e9) || !(launcher >= 0 && launcher < 1e9))
    return std::nullopt;
  run.domain = static_cast<int>(domain);
  run.supervisor = static_cast<pid_t>(supervisor);
  run.launcher = static_cast<pid_t>(launcher);
  if (const double since = number("orphaned_s"); since >= 0) run.orphaned_s = since;
  if (const double left = number("ends_in_s"); left >= 0) run.ends_in_s = left;
  return run;
}

std::vector<SupervisedRun> FindSupervisedRuns()
{
  RemoveDeadConsoles();
  // All are asked before the first answer is waited for.
  std::vector<ConsoleLink> links;
  for (const std::string& path : ConsoleSockets())
  {
    auto link = ConsoleLink::To(path);
    if (!link || link->GetPeer().user != geteuid() || !link->Send({{"ask", "state"}})) continue;
    links.push_back(std::move(*link));
  }
  std::vector<SupervisedRun> runs;
  for (ConsoleLink& link : links)
  {
    if (!link.Wait(kPatience_ms)) continue;
    const auto received = link.Receive();
    if (!received || !received->message) continue;
    if (auto run = ReadSupervisedRun(*received->message)) runs.push_back(std::move(*run));
  }
  return runs;
}

}  // namespace swarmanoid
