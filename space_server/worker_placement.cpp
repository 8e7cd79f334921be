// A worker is moved by replacing it at another machine, so only runs whose processes can be replaced have places. A
// drained machine's workers go one by one to the machine that has the fewest then.
#include "space_server/worker_placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "common/configuration/wording.h"
#include "common/messages/assignment.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kServer = "space server";

// A region is named as "ground/2".
std::string RegionOf(const std::string& which)
{
  const std::size_t sign = which.rfind('/');
  return sign == std::string::npos
             ? std::string()
             : fmt::format("region {} of engine '{}'", which.substr(sign + 1), which.substr(0, sign));
}

}  // namespace

WorkerPlacement::WorkerPlacement(std::vector<std::string> machines, const std::vector<std::string>& places)
    : machines_(std::move(machines))
{
  for (const std::string& place : places)
  {
    const std::size_t sign = place.rfind('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == place.size())
      throw std::invalid_argument(fmt::format("{} is no place; write WORKER=MACHINE", Quoted(place)));
    places_[place.substr(0, sign)] = place.substr(sign + 1);
  }
}

void WorkerPlacement::Put(const Move& move)
{
  if (const auto place = places_.find(move.worker); place != places_.end() && HasMachine(move.machine))
    place->second = move.machine;
}

bool WorkerPlacement::HasMachine(const std::string& machine) const
{
  return std::ranges::find(machines_, machine) != machines_.end();
}

void WorkerPlacement::RequireMachine(const std::string& machine) const
{
  if (HasMachine(machine)) return;
  throw std::invalid_argument(fmt::format(
      "the run has no machine {}; it has {}{}; name others in the file of --hosts, as machines = alpha beta",
      Quoted(machine), Listed(machines_), DidYouMean(machine, machines_)));
}

std::string WorkerPlacement::Text() const
{
  RequireMoves();
  std::map<std::string, std::vector<std::string>> workers;
  for (const auto& [worker, place] : places_) workers[place].push_back(worker);
  std::string text;
  for (const std::string& machine : machines_)
  {
    const std::vector<std::string>& there = workers[machine];
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", machine,
                        there.empty() ? "no process" : fmt::format("{}", fmt::join(there, ", ")));
  }
  return text;
}

void WorkerPlacement::RequireMoves() const
{
  if (places_.empty())
    throw std::invalid_argument(
        "no process of this run can be moved: it is one process, its processes are not replaced, or its processes were "
        "started by hand");
}

bool WorkerPlacement::ServerMayStartAgain() const
{
  const auto server = places_.find(kServer);
  return server != places_.end() && server->second == kHere;
}

std::vector<std::string> WorkerPlacement::ReadHosts(const ControlOrder& order, std::size_t most) const
{
  RequireMoves();
  if (!ServerMayStartAgain())
    throw std::invalid_argument(
        "all processes start again for it, and the space server cannot: it is on another machine than the launcher");
  const auto machine = order.Get<std::string>("machine");
  if (!machine.empty()) RequireMachine(machine);
  std::vector<std::string> hosts;
  for (auto place = places_.find(HostName(0)); place != places_.end(); place = places_.find(HostName(hosts.size())))
    hosts.push_back(place->second);
  const auto more = order.Get<std::int64_t>("change");
  if (more == 0 && hosts.size() == 1)
    throw std::invalid_argument("the run has one controller host, and that has all robots");
  const std::vector<std::string> before = hosts;
  if (static_cast<std::int64_t>(before.size()) + more > static_cast<std::int64_t>(most))
    throw std::invalid_argument(fmt::format(
        "the run has {} controller host{}, and can have {}: as many as robots with a controller, and not more "
        "than 1000",
        before.size(), before.size() == 1 ? "" : "s", most));
  for (std::int64_t k = 0; k < more; ++k) hosts.push_back(machine.empty() ? kHere : machine);
  for (std::int64_t k = 0; k < -more; ++k)
  {
    const auto last = machine.empty() ? hosts.rbegin() : std::find(hosts.rbegin(), hosts.rend(), machine);
    if (last == hosts.rend())
      throw std::invalid_argument(
          fmt::format("so many controller hosts are not at {}; they are at {}", Quoted(machine), Listed(before)));
    if (hosts.size() == 1)
      throw std::invalid_argument(fmt::format("the run has {} controller host{}, and one must remain", before.size(),
                                              before.size() == 1 ? "" : "s"));
    hosts.erase(std::next(last).base());
  }
  return hosts;
}

std::vector<WorkerPlacement::Move> WorkerPlacement::ReadHostMove(const ControlOrder& order) const
{
  return MoveOf({HostName(static_cast<std::size_t>(order.Get<std::int64_t>("host")))}, order);
}

std::vector<WorkerPlacement::Move> WorkerPlacement::ReadEngineMove(const ControlOrder& order) const
{
  const auto engine = order.Get<std::string>("engine");
  return MoveOf({fmt::format("engine '{}'", engine), RegionOf(engine)}, order);
}

std::vector<WorkerPlacement::Move> WorkerPlacement::MoveOf(const std::vector<std::string>& workers,
                                                           const ControlOrder& order) const
{
  RequireMoves();
  const auto worker = std::ranges::find_if(workers, [&](const std::string& name) { return places_.contains(name); });
  if (worker == workers.end())
  {
    std::vector<std::string> others;
    for (const auto& [other, place] : places_)
      if (other != kServer) others.push_back(other);
    throw std::invalid_argument(fmt::format("the run has no {}; it has {}", workers.front(), fmt::join(others, ", ")));
  }
  const auto machine = order.Get<std::string>("machine", places_.at(*worker));
  RequireMachine(machine);
  return {{*worker, machine}};
}

std::vector<WorkerPlacement::Move> WorkerPlacement::ReadDrain(const ControlOrder& order) const
{
  RequireMoves();
  const auto machine = order.Get<std::string>("machine");
  RequireMachine(machine);
  if (const auto server = places_.find(kServer); server != places_.end() && server->second == machine)
    throw std::invalid_argument(
        fmt::format("the space server is at {}, and cannot be moved; move the others one by one", Quoted(machine)));
  std::map<std::string, std::size_t> loads;
  for (const std::string& other : machines_)
    if (other != machine) loads[other] = 0;
  if (loads.empty())
    throw std::invalid_argument(
        fmt::format("the workers at {} have nowhere to go: the run has no other machine; name some in the file of "
                    "--hosts, as machines = alpha beta",
                    Quoted(machine)));
  for (const auto& [worker, place] : places_)
    if (const auto load = loads.find(place); load != loads.end()) ++load->second;
  std::vector<Move> moves;
  for (const auto& [worker, place] : places_)
  {
    if (place != machine) continue;
    const auto least = std::ranges::min_element(loads, {}, &std::pair<const std::string, std::size_t>::second);
    ++least->second;
    moves.push_back({worker, least->first});
  }
  return moves;
}

}  // namespace swarmanoid
