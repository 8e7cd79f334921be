#include "space_server/cluster/late_processes.h"

#include <algorithm>

namespace swarmanoid
{
namespace
{

constexpr std::string_view kWaits = "waits for ";
constexpr double kLate_s = 0.25;  // shorter waits are part of a slow tick

std::vector<std::string> SplitNames(const std::string& names)
{
  std::vector<std::string> split;
  for (std::size_t start = 0; start < names.size();)
  {
    const std::size_t end = std::min(names.find(", ", start), names.size());
    split.push_back(names.substr(start, end - start));
    start = end + 2;
  }
  return split;
}

}  // namespace

std::vector<LateProcess> LateProcesses(const ServerSession& session, const std::vector<std::string>& missing,
                                       std::uint64_t tick)
{
  std::vector<LateProcess> late;
  const auto add = [&](const std::string& name, const std::string& doing)
  {
    const auto same = [&](const LateProcess& known) { return known.name == name; };
    if (std::none_of(late.begin(), late.end(), same)) late.push_back({name, doing});
  };
  for (const std::string& name : missing)
  {
    const std::string status = session.Status(name, tick);
    if (!status.starts_with(kWaits))
    {
      add(name, status);
      continue;
    }
    for (const std::string& other : SplitNames(status.substr(kWaits.size())))
    {
      const std::string further = session.Status(other, tick);
      add(other, further.starts_with(kWaits) ? std::string() : further);
    }
  }
  return late;
}

std::vector<ProcessStatus> ProcessesNow(const ServerSession& session, std::uint64_t tick,
                                        const std::vector<std::string>& missing, double waited_s)
{
  std::vector<ProcessStatus> processes{{"space server", ProcessId(), tick, 0, {}}};
  for (ProcessStatus& process : session.Processes())
  {
    process.tick = tick;
    if (std::find(missing.begin(), missing.end(), process.name) != missing.end() && tick > 0) process.tick = tick - 1;
    processes.push_back(std::move(process));
  }
  if (waited_s < kLate_s) return processes;
  for (const LateProcess& late : LateProcesses(session, missing, tick))
    for (ProcessStatus& process : processes)
    {
      if (process.name != late.name) continue;
      process.tick = tick > 0 ? tick - 1 : 0;
      process.late_s = waited_s;
      process.doing = late.doing;
    }
  return processes;
}

}  // namespace swarmanoid
